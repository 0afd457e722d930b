#include "io/provenance.h"

#include <string_view>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "io/file.h"
#include "io/glb_container.h"
#include "io/png.h"

namespace espalier {
namespace {

using nlohmann::json;

[[noreturn]] void fail(const std::string& what) { throw Error("provenance: " + what); }

std::string text_member(const json& object, const char* key, bool required = false) {
  const auto it = object.find(key);
  if (it == object.end()) {
    if (required) fail(fmt::format("\"{}\" is missing", key));
    return {};
  }
  if (!it->is_string()) fail(fmt::format("\"{}\" must be a string, got {}", key, it->type_name()));
  return it->get<std::string>();
}

std::uint64_t count_member(const json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end()) return 0;
  if (!it->is_number_unsigned()) fail(fmt::format("\"{}\" must be a whole number >= 0, got {}", key, it->dump()));
  return it->get<std::uint64_t>();
}

std::optional<double> number_member(const json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end() || it->is_null()) return std::nullopt;
  if (!it->is_number()) fail(fmt::format("\"{}\" must be a number, got {}", key, it->type_name()));
  return it->get<double>();
}

Provenance from_json(const json& object) {
  if (!object.is_object()) fail(fmt::format("must be an object, got {}", object.type_name()));
  Provenance p;
  p.version = text_member(object, "version", true);
  p.made_by = text_member(object, "made_by", true);
  p.seed = count_member(object, "seed");
  p.steps = count_member(object, "steps");
  p.index = count_member(object, "index");
  p.engine = text_member(object, "engine");
  p.settings = text_member(object, "settings");
  p.settings_folder = text_member(object, "settings_folder");
  p.derivation = text_member(object, "derivation");
  p.score = number_member(object, "score");
  p.optimum = number_member(object, "optimum");
  p.picture = text_member(object, "picture");
  p.mesh = text_member(object, "mesh");
  if (const auto inputs = object.find("inputs"); inputs != object.end()) {
    if (!inputs->is_object()) fail(fmt::format("\"inputs\" must be an object, got {}", inputs->type_name()));
    for (const auto& [name, hash] : inputs->items()) {
      if (!hash.is_string()) fail(fmt::format("the hash of \"{}\" must be a string, got {}", name, hash.type_name()));
      p.inputs[name] = hash.get<std::string>();
    }
  }
  return p;
}

/// The provenance that a JSON text holds at `pointer`, if it is JSON and holds something there.
std::optional<Provenance> at_pointer(std::string_view text, const char* pointer) {
  const json document = json::parse(text, nullptr, false);
  const json::json_pointer place(pointer);
  if (document.is_discarded() || !document.contains(place)) return std::nullopt;
  return from_json(document.at(place));
}

/// What follows `mark` on the first line that begins with it, looking only at the lines up to `end`.
std::optional<Provenance> in_comment(std::string_view text, std::string_view mark, std::string_view end) {
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.starts_with(mark)) return parse_provenance(std::string(line.substr(mark.size())));
    if (!end.empty() && line == end) break;
  }
  return std::nullopt;
}

/// STL has room for no more than the version and the hash of the derivation.
std::optional<Provenance> in_stl_header(std::string_view bytes) {
  constexpr std::string_view kMark = "espalier ";
  if (bytes.size() < 84 || !bytes.starts_with(kMark)) return std::nullopt;
  // A header, a count, 50 bytes per triangle: other texts may begin with our name too.
  std::uint32_t triangles = 0;
  for (std::size_t i = 84; i-- > 80;) triangles = triangles << 8 | static_cast<unsigned char>(bytes[i]);
  if (bytes.size() != 84 + std::uint64_t{50} * triangles) return std::nullopt;
  std::string header(bytes.substr(0, 80));
  header.erase(std::min(header.size(), header.find('\0')));
  const std::size_t space = header.find(' ', kMark.size());
  Provenance p;
  p.version = header.substr(kMark.size(), space - kMark.size());
  p.made_by = "export";
  if (space != std::string::npos) p.derivation = header.substr(space + 1);
  return p;
}

std::optional<Provenance> find_provenance(std::string_view bytes) {
  if (const auto chunk = find_glb_json(bytes)) return at_pointer(*chunk, "/asset/extras/espalier");
  if (const auto text = find_png_text(bytes, "espalier")) return parse_provenance(*text);
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) {
    return in_comment(bytes, "comment espalier: ", "end_header");
  }
  if (const std::size_t first = bytes.find_first_not_of(" \t\r\n"); first != bytes.npos && bytes[first] == '{') {
    return at_pointer(bytes, "/provenance");
  }
  if (auto p = in_stl_header(bytes)) return p;
  return in_comment(bytes, "# espalier: ", "");
}

}  // namespace

std::string to_json(const Provenance& p) {
  json object = {{"version", p.version}, {"made_by", p.made_by},   {"seed", p.seed},
                 {"steps", p.steps},     {"index", p.index},       {"engine", p.engine},
                 {"inputs", p.inputs},   {"settings", p.settings}, {"settings_folder", p.settings_folder},
                 {"derivation", p.derivation}};
  if (p.score) object["score"] = *p.score;
  if (p.optimum) object["optimum"] = *p.optimum;
  if (!p.picture.empty()) object["picture"] = p.picture;
  if (!p.mesh.empty()) object["mesh"] = p.mesh;
  try {
    return object.dump(-1, ' ', true);  // ASCII, so that it may stand in any comment
  } catch (const json::exception& e) {
    fail(fmt::format("a text is not UTF-8: {}", e.what()));
  }
}

Provenance parse_provenance(const std::string& text) {
  const json object = json::parse(text, nullptr, false);
  if (object.is_discarded()) fail("not JSON");
  return from_json(object);
}

Provenance read_provenance(const std::string& path) {
  const std::string bytes = read_file(path, 4ull << 30);
  try {
    if (auto p = find_provenance(bytes)) return *p;
  } catch (const Error& e) {
    throw Error(fmt::format("{}: {}", path, e.what()));
  }
  throw Error(fmt::format(
      "{}: holds no provenance; Espalier writes it into its GLB, OBJ, MTL, PLY, STL, PNG and JSON files", path));
}

}  // namespace espalier
