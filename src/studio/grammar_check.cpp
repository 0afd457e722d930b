#include "studio/grammar_check.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/one_line.h"
#include "grammar/parser.h"

namespace espalier::studio {
namespace {

constexpr std::size_t kLongestSignature = 200;

/// Not within a character.
std::string shortened(std::string text) {
  if (text.size() <= kLongestSignature) return text;
  std::size_t end = kLongestSignature;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return text.substr(0, end) + " ..";
}

std::string_view trimmed(std::string_view line) {
  while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
  while (!line.empty() && (line.back() == ' ' || line.back() == '\t' || line.back() == '\r')) line.remove_suffix(1);
  return line;
}

/// The comment on the lines right above `offset`, unless that is the one at the head of the text.
std::string comment_above(std::string_view text, std::size_t offset) {
  std::string comment;
  std::size_t begin = text.rfind('\n', offset > 0 ? offset - 1 : 0);
  while (begin != std::string_view::npos && begin > 0) {
    const std::size_t before = text.rfind('\n', begin - 1);
    const std::size_t from = before == std::string_view::npos ? 0 : before + 1;
    std::string_view line = trimmed(text.substr(from, begin - from));
    if (line.starts_with("grammar ")) return "";
    if (!line.starts_with('#')) break;
    line = trimmed(line.substr(1));
    comment = comment.empty() ? std::string(line) : std::string(line) + "\n" + comment;
    begin = before;
  }
  return comment;
}

api::SymbolKind kind_of(const ast::Decl& decl) {
  switch (decl.kind) {
    case ast::DeclKind::constant: return api::SymbolKind::const_;
    case ast::DeclKind::function: return api::SymbolKind::fn;
    case ast::DeclKind::attribute: return api::SymbolKind::attr;
    case ast::DeclKind::mesh: return api::SymbolKind::mesh;
    case ast::DeclKind::material: return api::SymbolKind::material;
    case ast::DeclKind::rule: return api::SymbolKind::rule;
    case ast::DeclKind::detail: return api::SymbolKind::detail;
    default: return api::SymbolKind::import;
  }
}

std::vector<api::Symbol> symbols_of(const std::string& text, const Utf16Offsets& offsets) {
  std::vector<api::Symbol> symbols;
  Diagnostics ignored;
  const ast::Grammar grammar = parse(text, ignored);
  for (const ast::Decl& decl : grammar.decls) {
    if (decl.kind == ast::DeclKind::start || decl.span.file != 0 || decl.span.line == 0) continue;
    const bool body = decl.kind == ast::DeclKind::rule || decl.kind == ast::DeclKind::detail;
    std::size_t length = decl.span.length;
    if (body && decl.body.span.offset > decl.span.offset) length = decl.body.span.offset - decl.span.offset;
    api::Symbol symbol{kind_of(decl), decl.name, "", {}, offsets.place(decl.span)};
    symbol.signature = shortened(in_one_line(std::string_view(text).substr(decl.span.offset, length)));
    if (std::string comment = comment_above(text, decl.span.offset); !comment.empty()) symbol.comment = std::move(comment);
    symbols.push_back(std::move(symbol));
  }
  return symbols;
}

api::Value value_of(const StaticValue& value) {
  if (value.kind == Kind::boolean) return value.truth();
  if (value.kind == Kind::text) return value.text;
  return value.kind == Kind::angle ? value.scalar() * (180 / kPi) : value.scalar();
}

/// Degrees come back as a person wrote them: 30, not 29.999999999999996.
double rounded(double value) {
  const double step = 1e-9;
  return std::abs(value) < 1e6 ? std::round(value / step) * step : value;
}

api::Attribute attribute_of(const std::string& name, const CheckedAttribute& checked, const std::string& comment) {
  api::Attribute attribute;
  attribute.name = name;
  const bool angle = checked.default_value.kind == Kind::angle;
  attribute.kind = checked.default_value.kind == Kind::boolean ? api::AttributeKind::bool_ : api::AttributeKind::number;
  if (angle) attribute.unit = "deg";
  const auto shown = [&](const StaticValue& value) {
    api::Value result = value_of(value);
    if (angle) result = rounded(std::get<double>(result));
    return result;
  };
  attribute.value = shown(checked.value);
  attribute.standard = shown(checked.default_value);
  const double unit = angle ? 180 / kPi : 1;
  if (checked.ranged) attribute.min = rounded(checked.low * unit), attribute.max = rounded(checked.high * unit);
  if (checked.step > 0) attribute.step = rounded(checked.step * unit);
  if (!checked.label.empty()) attribute.label = checked.label;
  if (!comment.empty()) attribute.comment = comment;
  return attribute;
}

api::Problem problem_of(const Diagnostic& diagnostic, const std::vector<SourceText>& sources, const Utf16Offsets& offsets) {
  api::Problem problem;
  problem.severity = diagnostic.severity == Severity::error ? api::ProblemSeverity::error : api::ProblemSeverity::warning;
  problem.code = diagnostic.code;
  problem.text = diagnostic.message;
  if (!diagnostic.help.empty()) problem.help = diagnostic.help;
  if (diagnostic.span.file != 0 && diagnostic.span.file < sources.size()) problem.file = sources[diagnostic.span.file].name;
  if (diagnostic.span.file == 0 && diagnostic.span.line > 0) problem.at = offsets.place(diagnostic.span);
  return problem;
}

}  // namespace

Utf16Offsets::Utf16Offsets(std::string_view text) {
  units_.reserve(text.size() + 1);
  std::uint32_t units = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    // Bytes within a character stand where it begins.
    if ((byte & 0xc0) == 0x80) {
      units_.push_back(units_.empty() ? 0 : units_.back());
      continue;
    }
    units_.push_back(units);
    units += byte >= 0xf0 ? 2 : 1;
  }
  units_.push_back(units);
}

std::map<std::string, Kind> attribute_kinds(const CheckedGrammar& grammar) {
  std::map<std::string, Kind> kinds;
  for (const auto& [name, attribute] : grammar.attributes) kinds[name] = attribute.default_value.kind;
  return kinds;
}

CheckedText check_text(const std::string& grammar, const std::map<std::string, std::string>& attributes,
                       const ReadImport& read_import) {
  CheckedText result;
  const Utf16Offsets offsets(grammar);
  result.symbols = symbols_of(grammar, offsets);
  std::map<std::string, std::string> known;
  for (const api::Symbol& symbol : result.symbols) {
    const auto value = attributes.find(symbol.name);
    if (symbol.kind == api::SymbolKind::attr && value != attributes.end()) known.insert(*value);
  }
  result.compiled = compile_grammar({"grammar.esp", grammar, known, read_import});
  for (const Diagnostic& diagnostic : result.compiled.diagnostics.items()) {
    result.problems.push_back(problem_of(diagnostic, result.compiled.sources, offsets));
  }
  if (!result.compiled.checked) return result;
  result.kinds = attribute_kinds(*result.compiled.checked);
  for (const api::Symbol& symbol : result.symbols) {
    const auto checked = result.compiled.checked->attributes.find(symbol.name);
    if (symbol.kind != api::SymbolKind::attr || checked == result.compiled.checked->attributes.end()) continue;
    result.attributes.push_back(attribute_of(symbol.name, checked->second, symbol.comment.value_or("")));
  }
  // Attributes of imported files have sliders too.
  for (const auto& [name, checked] : result.compiled.checked->attributes) {
    const auto same = [&](const api::Attribute& attribute) { return attribute.name == name; };
    if (std::none_of(result.attributes.begin(), result.attributes.end(), same)) {
      result.attributes.push_back(attribute_of(name, checked, ""));
    }
  }
  return result;
}

std::string first_sentence(std::string_view grammar) {
  std::string words;
  while (!grammar.empty()) {
    const std::size_t end = std::min(grammar.find('\n'), grammar.size());
    const std::string_view line = trimmed(grammar.substr(0, end));
    grammar.remove_prefix(std::min(end + 1, grammar.size()));
    if (line.starts_with("grammar ") || line.starts_with("espalier") || (line.empty() && words.empty())) continue;
    if (!line.starts_with('#')) break;
    words += (words.empty() ? "" : " ") + std::string(trimmed(line.substr(1)));
  }
  for (std::size_t at = 0; (at = words.find('.', at)) != std::string::npos; ++at) {
    if (words.substr(0, at).ends_with(" Fig")) continue;
    if (at + 1 == words.size() || (words[at + 1] == ' ' && at > 0 && !(words[at - 1] >= 'A' && words[at - 1] <= 'Z'))) {
      return words.substr(0, at + 1);
    }
  }
  return words;
}

}  // namespace espalier::studio
