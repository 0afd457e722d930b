// The statements of an L-system file: settings, constants, the axiom, productions.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/core.h>

#include "grammar/lsystem_cursor.h"
#include "grammar/lsystem_statements.h"

namespace espalier::lsystem {
namespace {

class FileParser {
 public:
  FileParser(std::string_view source, Diagnostics& diagnostics) : source_(source), diagnostics_(diagnostics) {}

  System run() {
    for (const Statement& s : statements(source_)) {
      if (diagnostics_.error_count() >= Diagnostics::kMostErrors) break;
      try {
        statement(s);
      } catch (const SyntaxError&) {
        continue;
      }
    }
    if (!has_axiom_ && !diagnostics_.has_errors())
      diagnostics_.error("L0106", {}, "there is no axiom", "write `axiom: F`");
    return std::move(system_);
  }

 private:
  static std::size_t find_top(std::string_view text, std::string_view wanted) {
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (depth == 0 && text.substr(i, wanted.size()) == wanted) return i;
      if (text[i] == '(') ++depth;
      if (text[i] == ')') --depth;
    }
    return std::string_view::npos;
  }
  Cursor cursor(const Statement& s, std::size_t begin, std::size_t end = std::string::npos) {
    const std::string_view part = std::string_view(s.text).substr(begin, end == std::string::npos ? end : end - begin);
    return Cursor(part, Cursor(s.text, s.span, diagnostics_).span(begin, 1), diagnostics_);
  }
  static std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
  }

  void statement(const Statement& s) {
    const std::string_view text = s.text;
    if (text.starts_with("#define ") || text.starts_with("const ")) return constant(s, text.find(' '));
    const std::size_t arrow = find_top(text, "->"), utf8_arrow = find_top(text, "\xe2\x86\x92");
    if (arrow != std::string_view::npos) return production(s, arrow, 2);
    if (utf8_arrow != std::string_view::npos) return production(s, utf8_arrow, 3);
    const std::size_t mark = text.find_first_of(":=");
    if (mark == std::string_view::npos)
      cursor(s, 0).fail("L0101", s.span, "a statement is `setting: value`, `const name = value` or `A -> successor`");
    const std::string key(trimmed(text.substr(0, mark)));
    if (setting(s, key, mark + 1)) return;
    const std::string_view value = trimmed(text.substr(mark + 1));
    const bool number = !value.empty() && (value[0] == '.' || (value[0] >= '0' && value[0] <= '9'));
    if (text[mark] == '=' && (key.size() == 1 || key.find('(') != std::string::npos) && !number)
      return production(s, mark, 1);
    if (text[mark] == '=') return constant(s, 0);
    cursor(s, 0).fail("L0101", s.span, fmt::format("there is no setting `{}`", key.substr(0, kLongestName)),
                      "settings are axiom, iterations, angle, step, width, thinner, draw and move");
  }

  double number(const Statement& s, std::size_t begin, double low, double high, std::string_view what) {
    Cursor at = cursor(s, begin);
    const SourceSpan where = at.here();
    const Expr expr = at.expression();
    if (!at.at_end()) at.fail("L0101", at.here(), "expected the end of the value");
    const std::optional<double> value = evaluate(expr, values());
    if (!value) at.fail("L0102", where, fmt::format("{} has no value: a name is unknown, or it is not finite", what));
    if (!(*value >= low && *value <= high))
      at.fail("L0102", where, fmt::format("{} lies in {}..{}, got {}", what, low, high, *value));
    return *value;
  }

  bool setting(const Statement& s, const std::string& key, std::size_t begin) {
    if (key == "axiom") {
      Cursor at = cursor(s, begin);
      if (has_axiom_) at.fail("L0106", s.span, "there is one axiom");
      system_.axiom = at.modules();
      if (!at.at_end()) at.fail("L0101", at.here(), "expected the end of the axiom");
      has_axiom_ = true;
      count_modules(system_.axiom.size(), s.span);
    } else if (key == "iterations") {
      const double value = number(s, begin, 1, kMostIterations, "iterations");
      if (value != std::floor(value)) cursor(s, begin).fail("L0102", s.span, "iterations is a whole number");
      system_.iterations = static_cast<int>(value);
    } else if (key == "angle") {
      system_.angle = number(s, begin, -360, 360, "angle (in degrees)");
    } else if (key == "step") {
      system_.step = number(s, begin, 1e-6, 1e6, "step");
    } else if (key == "width") {
      system_.width = number(s, begin, 1e-6, 1e6, "width");
    } else if (key == "thinner") {
      system_.thinner = number(s, begin, 1e-3, 1e3, "thinner");
    } else if (key == "draw" || key == "move") {
      Cursor at = cursor(s, begin);
      std::string& letters = key == "draw" ? system_.draw : system_.move;
      while (!at.at_end()) {
        const std::string letter = at.letter();
        if (letter.size() != 1) at.fail("L0101", at.here(), fmt::format("`{}` lists letters", key));
        letters += letter;
      }
    } else {
      return false;
    }
    return true;
  }

  Values values() const {
    return [this](const std::string& name) -> std::optional<double> {
      for (const Constant& c : system_.constants)
        if (c.name == name) return c.number;
      return std::nullopt;
    };
  }

  void constant(const Statement& s, std::size_t begin) {
    Cursor at = cursor(s, begin);
    const SourceSpan where = at.here();
    Constant result;
    result.name = at.name("the name of a constant");
    if (values()(result.name)) at.fail("L0105", where, fmt::format("the constant `{}` is there twice", result.name));
    if (!at.accept("=")) at.accept(":");
    result.value = at.expression();
    if (!at.at_end()) at.fail("L0101", at.here(), "expected the end of the constant");
    const std::optional<double> value = evaluate(result.value, values());
    if (!value)
      at.fail("L0102", where,
              fmt::format("`{}` has no value: it reads a name that is not above it, or is not finite", result.name));
    result.number = *value;
    system_.constants.push_back(std::move(result));
    if (system_.constants.size() > kMostConstants)
      at.fail("L0103", where, fmt::format("at most {} constants", kMostConstants));
  }

  void count_modules(std::size_t more, const SourceSpan& where) {
    modules_ += more;
    if (modules_ > kMostModules)
      cursor({" ", where}, 0).fail("L0103", where, fmt::format("at most {} modules in all successors", kMostModules));
  }

  /// A(l) : guard -(p)-> successor : p
  void production(const Statement& s, std::size_t arrow, std::size_t arrow_length) {
    Production result;
    std::size_t left_end = arrow;
    const std::string_view left = std::string_view(s.text).substr(0, arrow);
    const std::size_t trimmed_end = left.find_last_not_of(" \t") + 1;
    const std::size_t dash = find_top(left, "-(");
    if (trimmed_end > 0 && left[trimmed_end - 1] == ')' && dash != std::string_view::npos) {
      Cursor at = cursor(s, dash + 1, arrow);
      result.probability = at.expression();
      if (!at.at_end()) at.fail("L0101", at.here(), "expected `->` after the probability");
      left_end = dash;
    }
    predecessor(s, left_end, result);
    Cursor at = cursor(s, arrow + arrow_length);
    result.successor = at.modules();
    if (at.accept(":")) {
      if (result.probability) at.fail("L0105", at.here(), "the production has two probabilities");
      result.probability = at.expression();
      if (!at.at_end()) at.fail("L0101", at.here(), "expected the end of the production");
    }
    rename_params(result);
    count_modules(result.successor.size(), result.span);
    system_.productions.push_back(std::move(result));
    if (system_.productions.size() > kMostProductions)
      at.fail("L0103", s.span, fmt::format("at most {} productions", kMostProductions));
  }

  /// [name :] A(params) [: guard]
  void predecessor(const Statement& s, std::size_t end, Production& result) {
    std::vector<std::size_t> begins = {0};
    const std::string_view left = std::string_view(s.text).substr(0, end);
    for (std::size_t at; (at = find_top(left.substr(begins.back()), ":")) != std::string_view::npos;)
      begins.push_back(begins.back() + at + 1);
    const auto part = [&](std::size_t i) {
      return cursor(s, begins[i], i + 1 < begins.size() ? begins[i + 1] - 1 : end);
    };
    if (begins.size() > 3) part(3).fail("L0101", part(3).here(), "a production is `name: A(l) : guard -> successor`");
    const bool named =
        begins.size() == 3 || (begins.size() == 2 && is_name(left, begins[1]) && is_module(left.substr(begins[1])));
    Cursor at = part(named ? 1 : 0);
    result.span = at.here();
    result.symbol = at.symbol();
    if (result.symbol == "[" || result.symbol == "]") at.fail("L0101", result.span, "brackets are not rewritten");
    result.params = at.params();
    if (at.peek() == '<' || at.peek() == '>') at.modules();  // refuses it
    if (!at.at_end()) at.fail("L0101", at.here(), "a production rewrites one symbol");
    const std::size_t guard = named ? 2 : 1;
    if (guard >= begins.size()) return;
    Cursor condition = part(guard);
    if (condition.accept("*") || condition.at_end()) return;
    result.guard = condition.expression();
    if (!condition.at_end()) condition.fail("L0101", condition.here(), "expected the end of the guard");
  }

  static bool is_name(std::string_view left, std::size_t end) {
    const std::string_view name = trimmed(left.substr(0, end - 1));
    return !name.empty() &&
           std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  }
  /// Whether a part before the arrow is a predecessor (with a context or not) and no guard.
  static bool is_module(std::string_view part) {
    part = trimmed(part);
    if (part.empty() || std::string_view(".0123456789(*").find(part[0]) != std::string_view::npos) return false;
    const std::size_t open = part.find('('), close = open == 1 ? part.find(')') : 0;
    const std::string_view rest = close == std::string_view::npos ? "" : trimmed(part.substr(close + 1));
    const bool digit =
        rest.size() > 1 && std::string_view(" .0123456789").find(trimmed(rest.substr(1))[0]) != rest.npos;
    return rest.empty() || ((rest[0] == '<' || rest[0] == '>') && !digit);
  }
  /// Productions of one symbol share the names of their parameters: those of the first.
  void rename_params(Production& p) {
    for (const Production& first : system_.productions) {
      if (first.symbol != p.symbol || first.params.size() != p.params.size()) continue;
      const std::vector<std::string> old = p.params;
      p.params = first.params;
      for (auto* e : {&p.guard, &p.probability})
        if (*e) rename(**e, old, p.params);
      for (Module& m : p.successor)
        for (Expr& arg : m.args) rename(arg, old, p.params);
      return;
    }
  }
  static void rename(Expr& expr, const std::vector<std::string>& from, const std::vector<std::string>& to) {
    const auto found = std::find(from.begin(), from.end(), expr.name);
    if (expr.op == Op::name && found != from.end()) expr.name = to[static_cast<std::size_t>(found - from.begin())];
    for (Expr& child : expr.children) rename(child, from, to);
  }

  std::string_view source_;
  Diagnostics& diagnostics_;
  System system_;
  bool has_axiom_ = false;
  std::size_t modules_ = 0;
};

}  // namespace

std::optional<System> parse(std::string_view source, Diagnostics& diagnostics) {
  if (source.size() > kLargestFile) {
    diagnostics.error("L0103", {}, fmt::format("an L-system is at most {} bytes long, this one has {}", kLargestFile,
                                               source.size()));
    return std::nullopt;
  }
  System system = FileParser(source, diagnostics).run();
  if (!diagnostics.has_errors()) check_names(system, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return system;
}

}  // namespace espalier::lsystem
