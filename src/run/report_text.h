#pragma once
// What pages are made of: texts that are safe inside HTML, bytes as text, and templates with places to fill.

#include <map>
#include <string>
#include <string_view>

#include "render/render.h"

namespace espalier {

/// Safe between tags and inside quoted attributes; control characters that no page may hold become U+FFFD.
std::string escape_html(std::string_view text);

/// JSON (ASCII) that may stand inside <script>: "<", ">" and "&" are escaped, which changes nothing for who parses it.
std::string json_for_script(std::string json);

/// Percent-encodes all but letters, digits and "-._~": one component of a relative URL.
std::string url_component(std::string_view text);

/// "data:image/png;base64,...".
std::string png_url(std::string_view png);

/// Fills every "{{name}}" in one pass: what is filled in is not looked at again. CHECKs that all places have a value.
std::string fill_template(std::string_view text, const std::map<std::string, std::string>& values);

/// "1234567.5" as "1,234,567.5": six digits that matter, grouped; never "-0".
std::string readable_number(double value);

/// The picture made smaller by the least whole factor that brings it to `most` pixels across; means in linear light.
Picture shrunk(const Picture& picture, std::uint32_t most);

}  // namespace espalier
