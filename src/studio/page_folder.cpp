#include "studio/page_folder.h"

#include <filesystem>

#include "base/error.h"
#include "io/file.h"
#include "studio/web_guard.h"

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostPageBytes = 64u << 20;

constexpr std::string_view kNoPage = R"(<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Espalier</title>
<body style="font: 16px/1.5 sans-serif; max-width: 40em; margin: 15vh auto; padding: 0 1em">
<h1>The page is not built yet</h1>
<p>The server runs. <code>script/studio</code> builds the page and starts the server; by hand it is
<code>cd web &amp;&amp; npm ci &amp;&amp; npm run build</code>. Then load this page again.</p>
</body></html>
)";

struct Type {
  std::string_view ending, type;
};
constexpr Type kTypes[] = {
    {".html", "text/html; charset=utf-8"}, {".js", "text/javascript; charset=utf-8"}, {".css", "text/css; charset=utf-8"},
    {".svg", "image/svg+xml"}, {".png", "image/png"}, {".jpg", "image/jpeg"}, {".webp", "image/webp"},
    {".ico", "image/x-icon"}, {".woff2", "font/woff2"}, {".json", "application/json"}, {".wasm", "application/wasm"},
    {".txt", "text/plain; charset=utf-8"}};

}  // namespace

std::optional<HttpResponse> page_file(const std::string& folder, std::string_view path) {
  const std::string name = path == "/" ? "index.html" : std::string(path.substr(1));
  if (!is_plain_path(name)) return std::nullopt;
  std::string_view type;
  for (const Type& one : kTypes) {
    if (name.ends_with(one.ending)) type = one.type;
  }
  if (type.empty()) return std::nullopt;
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  const fs::path file = error ? fs::path() : fs::canonical(root / name, error);
  if (error || !fs::is_regular_file(file, error)) {
    if (path != "/") return std::nullopt;
    return HttpResponse{200, "text/html; charset=utf-8", std::string(kNoPage)};
  }
  if (file.lexically_relative(root).begin()->string() == "..") return std::nullopt;
  try {
    return HttpResponse{200, std::string(type), read_file(file.string(), kMostPageBytes)};
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace espalier::studio
