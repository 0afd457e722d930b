// Makes types out of api/studio.json: make_types studio.json OUT writes OUT/studio_types.h, .cpp and .ts.
// The subset of JSON Schema that it understands: objects, arrays, enums, numbers with bounds, texts with a greatest length,
// $ref, anyOf of plain values, additionalProperties (TypeScript only). x-to names who a message goes to; x-json keeps
// an object as JSON text in C++.

#include <cctype>
#include <fstream>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const std::string& text) { throw std::runtime_error(text); }

/// "OpenProject" -> "open_project".
std::string snake(const std::string& name) {
  std::string out;
  for (char c : name) {
    if (std::isupper(static_cast<unsigned char>(c)) && !out.empty()) out += '_';
    out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return out;
}

/// "at_once" -> "AtOnce".
std::string camel(const std::string& name) {
  std::string out;
  bool upper = true;
  for (char c : name) {
    if (c == '_' || c == '-') {
      upper = true;
      continue;
    }
    out += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = false;
  }
  return out;
}

/// An enum's value as a C++ name: "smootherstep-separate" -> "smootherstep_separate"; "const" -> "const_".
std::string identifier(const std::string& value) {
  static const std::set<std::string> kWords = {"bool", "const", "float", "int", "default", "new", "delete", "switch"};
  std::string out = value;
  for (char& c : out)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return kWords.count(out) != 0 ? out + "_" : out;
}

std::string ref_name(const Json& type) {
  const std::string ref = type.at("$ref");
  return ref.substr(ref.rfind('/') + 1);
}

std::string comment(const Json& type, const std::string& before) {
  return type.contains("description") ? fmt::format("{}/// {}\n", before, type.at("description").get<std::string>()) : "";
}

bool is_required(const Json& type, const std::string& key) {
  if (!type.contains("required")) return false;
  for (const Json& name : type.at("required"))
    if (name == key) return true;
  return false;
}

class Maker {
 public:
  explicit Maker(const Json& schema) : defs_(schema.at("$defs")) {
    for (const auto& [name, type] : defs_.items())
      if (type.contains("x-to")) (type.at("x-to") == "server" ? to_server_ : to_page_).push_back(name);
    for (const std::vector<std::string>* side : {&to_server_, &to_page_})
      for (const std::string& name : *side) reach(defs_.at(name));
  }

  std::string header() const;
  std::string source() const;
  std::string typescript() const;

 private:
  /// Marks what C++ needs: all that messages hold, but for what stays JSON.
  void reach(const Json& type) {
    if (type.contains("$ref")) {
      if (needed_.insert(ref_name(type)).second) reach(defs_.at(ref_name(type)));
      return;
    }
    if (type.value("x-json", false)) return;
    if (type.contains("items")) reach(type.at("items"));
    if (type.contains("properties"))
      for (const auto& [key, property] : type.at("properties").items()) reach(property);
  }

  /// Kinds of definitions: structs are objects that C++ knows by their members.
  bool is_struct(const Json& type) const { return type.value("type", "") == "object" && !type.value("x-json", false); }

  std::string cpp(const Json& type, const std::string& enum_name) const {
    if (type.contains("$ref")) return ref_name(type);
    if (type.value("x-json", false)) return "JsonText";
    if (type.contains("enum")) return enum_name;
    if (type.contains("anyOf")) return "std::variant<double, bool, std::string>";
    const std::string kind = type.at("type");
    if (kind == "number") return "double";
    if (kind == "integer") return "std::int64_t";
    if (kind == "boolean") return "bool";
    if (kind == "string") return "std::string";
    if (kind != "array") fail("no C++ type for " + type.dump());
    const std::string item = cpp(type.at("items"), enum_name);
    if (type.contains("minItems") && type.at("minItems") == type.value("maxItems", Json()))
      return fmt::format("std::array<{}, {}>", item, type.at("minItems").get<int>());
    return fmt::format("std::vector<{}>", item);
  }

  std::string ts(const Json& type) const {
    if (type.contains("$ref")) return ref_name(type);
    if (type.contains("enum") || type.contains("anyOf")) {
      std::string out;
      for (const Json& value : type.contains("enum") ? type.at("enum") : type.at("anyOf"))
        out += (out.empty() ? "" : " | ") + (type.contains("enum") ? value.dump() : ts(value));
      return out;
    }
    const std::string kind = type.at("type");
    if (kind == "number" || kind == "integer") return "number";
    if (kind == "boolean" || kind == "string") return kind;
    if (kind == "array") {
      const std::string item = ts(type.at("items"));
      if (type.contains("minItems") && type.at("minItems") == type.value("maxItems", Json())) {
        std::string out;
        for (int i = 0; i < type.at("minItems").get<int>(); ++i) out += (i ? ", " : "") + item;
        return "[" + out + "]";
      }
      return item.find('|') == std::string::npos ? item + "[]" : "(" + item + ")[]";
    }
    if (type.contains("additionalProperties")) return fmt::format("Record<string, {}>", ts(type.at("additionalProperties")));
    fail("no TypeScript type for " + type.dump());
  }

  std::string reader(const std::string& name) const;
  std::string writer(const std::string& name) const;

  const Json& defs_;
  std::vector<std::string> to_server_, to_page_;
  std::set<std::string> needed_;
};

std::string bounds_of(const Json& type) {
  if (type.value("type", "") == "string") return fmt::format(", {}", type.value("maxLength", 10000));
  if (type.value("type", "") != "number" && type.value("type", "") != "integer") return "";
  return fmt::format(", {}, {}", type.value("minimum", -9007199254740991.0), type.value("maximum", 9007199254740991.0));
}

std::string Maker::header() const {
  std::string out =
      "#pragma once\n// Made from api/studio.json by api/make_types.cpp.\n\n#include <array>\n#include <cstdint>\n"
      "#include <optional>\n#include <string>\n#include <string_view>\n#include <variant>\n#include <vector>\n\n"
      "namespace espalier::api {\n\n/// A JSON object as text.\nstruct JsonText {\n  std::string text = \"{}\";\n\n"
      "  bool operator==(const JsonText&) const = default;\n};\n";
  // Definitions stand in an order in which each is known before it is used; messages of both sides come last.
  for (const auto& [name, type] : defs_.items()) {
    const bool message = type.contains("x-to");
    if (!message && needed_.count(name) == 0) continue;
    if (!is_struct(type)) {
      out += fmt::format("\n{}using {} = {};\n", comment(type, ""), name, cpp(type, name));
      continue;
    }
    for (const auto& [key, property] : type.at("properties").items()) {
      if (!property.contains("enum")) continue;
      out += fmt::format("\nenum class {}{} : std::uint8_t {{", name, camel(key));
      for (std::size_t i = 0; i < property.at("enum").size(); ++i)
        out += (i ? ", " : " ") + identifier(property.at("enum")[i]);
      out += " };\n";
    }
    out += fmt::format("\n{}struct {} {{\n", comment(type, ""), name);
    if (message) out += fmt::format("  static constexpr std::string_view kKind = \"{}\";\n  std::optional<std::int64_t> request = {{}};\n", snake(name));
    for (const auto& [key, property] : type.at("properties").items()) {
      const std::string field = cpp(property, name + camel(key));
      out += comment(property, "  ");
      out += is_required(type, key) ? fmt::format("  {} {}{{}};\n", field, key)
                                    : fmt::format("  std::optional<{}> {} = {{}};\n", field, key);
    }
    out += fmt::format("\n  bool operator==(const {}&) const = default;\n}};\n", name);
  }
  out += "\nusing Request = std::variant<";
  for (std::size_t i = 0; i < to_server_.size(); ++i) out += (i ? ", " : "") + to_server_[i];
  out += ">;\n\n/// Of a message from the page. Throws Error that names the place, the rule and the value; `request` is set as soon as\n"
         "/// it is known, for the answer.\nRequest read_request(std::string_view text, std::optional<std::int64_t>& request);\n\n"
         "/// The request again: for tests, and for whoever speaks to a server.\nstd::string to_text(const Request& request);\n\n";
  for (const std::string& name : to_page_) out += fmt::format("std::string to_text(const {}& message);\n", name);
  return out + "\n}  // namespace espalier::api\n";
}

std::string Maker::reader(const std::string& name) const {
  const Json& type = defs_.at(name);
  std::string out = fmt::format("static void read(const Json& json, {}& out, const std::string& path) {{\n", name);
  out += "  require_object(json, path);\n  static constexpr std::string_view kKeys[] = {\"kind\", \"request\"";
  for (const auto& [key, property] : type.at("properties").items()) out += fmt::format(", \"{}\"", key);
  out += "};\n  require_keys(json, kKeys, path);\n";
  if (type.contains("x-to")) out += "  read_request_number(json, out.request);\n";
  for (const auto& [key, property] : type.at("properties").items()) {
    const bool required = is_required(type, key);
    out += fmt::format("  if (const Json* value = member(json, \"{}\", path, {})) ", key, required);
    const std::string target = required ? "out." + key : "out." + key + ".emplace()";
    if (property.contains("enum")) {
      std::string names;
      for (const Json& value : property.at("enum")) names += (names.empty() ? "" : ", ") + value.dump();
      out += fmt::format("read_enum(*value, {}, {{{}}}, path + \".{}\");\n", target, names, key);
    } else {
      out += fmt::format("read(*value, {}, path + \".{}\"{});\n", target, key, bounds_of(property));
    }
  }
  return out + "}\n\n";
}

std::string Maker::writer(const std::string& name) const {
  const Json& type = defs_.at(name);
  std::string out = fmt::format("static Json write(const {}& in) {{\n  Json out = Json::object();\n", name);
  if (type.contains("x-to"))
    out += fmt::format("  out[\"kind\"] = \"{}\";\n  if (in.request) out[\"request\"] = *in.request;\n", snake(name));
  for (const auto& [key, property] : type.at("properties").items()) {
    const bool required = is_required(type, key);
    const std::string value = required ? "in." + key : "*in." + key;
    if (!required) out += fmt::format("  if (in.{}) ", key);
    else out += "  ";
    if (property.contains("enum")) {
      std::string names;
      for (const Json& option : property.at("enum")) names += (names.empty() ? "" : ", ") + option.dump();
      out += fmt::format("out[\"{}\"] = name_of({}, {{{}}});\n", key, value, names);
    } else {
      out += fmt::format("out[\"{}\"] = write({});\n", key, value);
    }
  }
  return out + "  return out;\n}\n\n";
}

std::string Maker::source() const {
  std::string out =
      "// Made from api/studio.json by api/make_types.cpp.\n\n#include \"studio_types.h\"\n\n#include \"studio/api_json.h\"\n\n"
      "namespace espalier::api {\n\n";
  std::set<std::string> read_too;  // what requests hold
  const auto mark = [&](const auto& self, const Json& type) -> void {
    if (type.contains("$ref")) {
      const Json& target = defs_.at(ref_name(type));
      if (is_struct(target) && read_too.insert(ref_name(type)).second) self(self, target);
      return;
    }
    if (type.contains("items")) self(self, type.at("items"));
    if (type.contains("properties"))
      for (const auto& [key, property] : type.at("properties").items()) self(self, property);
  };
  for (const std::string& name : to_server_) mark(mark, defs_.at(name));
  for (const auto& [name, type] : defs_.items()) {
    if (!is_struct(type)) continue;
    const bool server = type.value("x-to", "") == "server";
    if (!type.contains("x-to") && needed_.count(name) == 0) continue;
    if (server || read_too.count(name) != 0) out += reader(name);
    out += writer(name);
  }
  out += "Request read_request(std::string_view text, std::optional<std::int64_t>& request) {\n"
         "  const Json json = parse_object(text);\n  read_request_number(json, request);\n"
         "  const std::string kind = read_kind(json);\n";
  for (const std::string& name : to_server_)
    out += fmt::format("  if (kind == {}::kKind) {{\n    {} out;\n    read(json, out, kind);\n    return out;\n  }}\n", name, name);
  out += "  fail_kind(kind);\n}\n\nstd::string to_text(const Request& request) {\n"
         "  return std::visit([](const auto& message) { return write(message).dump(); }, request);\n}\n\n";
  for (const std::string& name : to_page_)
    out += fmt::format("std::string to_text(const {}& message) {{ return write(message).dump(); }}\n", name);
  return out + "\n}  // namespace espalier::api\n";
}

std::string Maker::typescript() const {
  std::string out = "// Made from api/studio.json by api/make_types.cpp.\n";
  for (const auto& [name, type] : defs_.items()) {
    if (type.value("type", "") != "object") {
      out += fmt::format("\n{}export type {} = {};\n", comment(type, ""), name, ts(type));
      continue;
    }
    out += fmt::format("\n{}export interface {} {{\n", comment(type, ""), name);
    if (type.contains("x-to")) out += fmt::format("  kind: \"{}\";\n  request?: number;\n", snake(name));
    for (const auto& [key, property] : type.at("properties").items())
      out += comment(property, "  ") + fmt::format("  {}{}: {};\n", key, is_required(type, key) ? "" : "?", ts(property));
    if (type.value("x-json", false)) out += "  [key: string]: unknown;\n";
    out += "}\n";
  }
  const auto join = [](const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += "\n  | " + name;
    return text;
  };
  return out + "\nexport type Request =" + join(to_server_) + ";\n\nexport type Message =" + join(to_page_) + ";\n";
}

/// Writes only what changed, so that nothing is built anew for nothing.
void write_file(const std::string& path, const std::string& text) {
  std::ifstream old(path, std::ios::binary);
  if (old && std::string(std::istreambuf_iterator<char>(old), {}) == text) return;
  std::ofstream out(path, std::ios::binary);
  if (!(out << text) || !out.flush()) fail(path + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3) fail("usage: make_types studio.json OUT");
    std::ifstream in(argv[1]);
    if (!in) fail(fmt::format("{}: cannot be read", argv[1]));
    const Json schema = Json::parse(in);
    const Maker maker(schema);
    const std::string out = argv[2];
    write_file(out + "/studio_types.h", maker.header());
    write_file(out + "/studio_types.cpp", maker.source());
    write_file(out + "/studio_types.ts", maker.typescript());
  } catch (const std::exception& error) {
    std::cerr << "make_types: " << error.what() << "\n";
    return 1;
  }
}
