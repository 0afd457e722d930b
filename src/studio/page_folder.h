#pragma once
// The page's files, as they lie in one folder and nowhere else.

#include <optional>
#include <string>
#include <string_view>

#include "studio/web_server.h"

namespace espalier::studio {

/// The file of the page at a path of the server, "/" being index.html; nothing where there is none, or the path leads out
/// of the folder, by links too. Where the folder holds no page at all, "/" is one that says how it is built.
std::optional<HttpResponse> page_file(const std::string& folder, std::string_view path);

}  // namespace espalier::studio
