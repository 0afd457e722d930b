// The statements that a successor becomes.

#include <algorithm>

#include <fmt/core.h>

#include "grammar/lsystem_writer.h"

namespace espalier::lsystem {
namespace {

constexpr std::string_view kTurns = "+-&^\\/";

bool is_simple(std::string_view text) { return text.find(' ') == std::string_view::npos; }

struct Turn {
  std::string_view statement;
  int sign;
};

/// The turtle of the book and ours: heading +y, up +z, left -x.
Turn turn_of(char symbol) {
  switch (symbol) {
    case '+': return {"yaw", 1};
    case '-': return {"yaw", -1};
    case '^': return {"pitch", 1};
    case '&': return {"pitch", -1};
    case '/': return {"roll", 1};
    default: return {"roll", -1};
  }
}

/// Splits what stands between brackets from what follows; drops what shows nothing and turns that nothing follows.
class Pruner {
 public:
  Pruner(const Steps& steps, const std::vector<Module>& modules) : steps_(steps), modules_(modules) {}

  std::vector<const Module*> sequence() {
    std::vector<const Module*> result;
    std::size_t shown = 0;  // how much of it is not in vain
    for (; at_ < modules_.size(); ++at_) {
      const Module& m = modules_[at_];
      if (m.symbol == "]") break;
      if (m.symbol == "[") {
        ++at_;
        const auto inner = sequence();
        if (inner.empty()) continue;
        result.push_back(&m);
        result.insert(result.end(), inner.begin(), inner.end());
        result.push_back(&modules_[at_]);
        shown = result.size();
        continue;
      }
      const Species* species = steps_.find(m);
      const bool child = species && !species->growth;
      const bool command = kTurns.find(m.symbol[0]) != std::string_view::npos || m.symbol == "|" || m.symbol == "!" ||
                           steps_.moves(m);
      if (!child && !command && !steps_.draws(m)) continue;
      result.push_back(&m);
      if (child || steps_.draws(m)) shown = result.size();
    }
    result.resize(shown);
    return result;
  }

 private:
  const Steps& steps_;
  const std::vector<Module>& modules_;
  std::size_t at_ = 0;
};

}  // namespace

Writer::Modules Writer::visible(const std::vector<Module>& modules) const {
  Modules result = Pruner(steps_, modules).sequence();
  const auto wrapped = [&] {  // in brackets as a whole
    int depth = 0;
    for (std::size_t i = 0; i + 1 < result.size(); ++i) {
      depth += result[i]->symbol == "[" ? 1 : result[i]->symbol == "]" ? -1 : 0;
      if (depth == 0) return false;
    }
    return !result.empty();
  };
  while (result.size() > 1 && wrapped()) result = Modules(result.begin() + 1, result.end() - 1);
  return result;
}

/// Lines of statements; `body` comes empty, with its names.
std::string Writer::text_of(const Modules& modules, Body body) {
  emit(modules, body);
  end_line(body);
  std::string text;
  for (const std::string& line : body.let_lines) text += line + "\n";
  for (const std::string& line : body.lines) text += line + "\n";
  return text;
}

void Writer::add(Body& body, const std::string& statement) {
  body.line += (body.line.empty() ? "" : "  ") + statement;
}

void Writer::end_line(Body& body) {
  if (!body.line.empty()) body.lines.push_back(std::move(body.line));
  body.line.clear();
}

void Writer::emit(const Modules& modules, Body& body) {
  for (std::size_t i = 0; i < modules.size(); ++i) {
    const Module& m = *modules[i];
    const Species* species = steps_.find(m);
    if (m.symbol == "[" || m.symbol == "]") {
      end_line(body);
      if (m.symbol == "]") close_brackets(body);
      else body.lines.push_back("{");
    } else if (species && !species->growth) {
      emit_child(m, *species, body);
      if (i + 1 < modules.size() && modules[i + 1]->symbol != "]") emit_leap(m, *species, body);
    } else if (steps_.draws(m)) {
      end_line(body);
      emit_segment(length_of(m, body), body);
    } else if (kTurns.find(m.symbol[0]) != std::string_view::npos) {
      i = emit_turns(modules, i, body);
    } else {
      emit_command(m, body);
    }
  }
}

/// A bracket with one short line stays on a line.
void Writer::close_brackets(Body& body) {
  constexpr std::size_t kShort = 84;
  const std::size_t n = body.lines.size();
  if (n >= 2 && body.lines[n - 2] == "{" && body.lines[n - 1] != "}" && body.lines[n - 1].size() <= kShort) {
    const std::string line = "{ " + body.lines[n - 1] + " }";
    body.lines.resize(n - 2);
    body.lines.push_back(line);
  } else {
    body.lines.push_back("}");
  }
}

void Writer::emit_command(const Module& m, Body& body) {
  if (steps_.moves(m)) return add(body, "forward " + length_of(m, body));
  if (m.symbol == "|") return add(body, "yaw 180deg");
  if (m.args.empty()) {
    const std::string by = use("thinner");
    return add(body, fmt::format("resize ({}, 1, {})", by, by));
  }
  const std::string width = named(grown(spell_in(m.args[0], body), m, body), "wide", body);
  add(body, fmt::format("size x {}  size z {}", width, width));
}

bool Writer::fits_turns(const Module& m, char axis) const {
  return turn_of(m.symbol[0]).statement == turn_of(axis).statement && m.args.empty() && !steps_.find(m) &&
         kTurns.find(m.symbol[0]) != std::string_view::npos;
}

/// A turn, or several about one axis by the common angle. Returns the last.
std::size_t Writer::emit_turns(const Modules& modules, std::size_t at, Body& body) {
  const Module& m = *modules[at];
  const Turn turn = turn_of(m.symbol[0]);
  if (!fits_turns(m, m.symbol[0])) {
    const bool literal = !m.args.empty() && m.args[0].op == Op::number && !steps_.find(m);
    const std::string angle = literal        ? spell(m.args[0].value) + "deg"
                              : m.args.empty() ? use("turn_angle")
                                               : "1deg * " + factor(m.args[0], body);
    add(body, fmt::format("{} {}{}", turn.statement, turn.sign < 0 ? "-" : "", grown(angle, m, body)));
    return at;
  }
  int count = 0;
  std::size_t last = at;
  for (std::size_t i = at; i < modules.size() && fits_turns(*modules[i], m.symbol[0]); last = i++)
    count += turn_of(modules[i]->symbol[0]).sign;
  if (count == 1 || count == -1)
    add(body, fmt::format("{} {}{}", turn.statement, count < 0 ? "-" : "", use("turn_angle")));
  else if (count != 0) add(body, fmt::format("{} {} * {}", turn.statement, count, use("turn_angle")));
  return last;
}

void Writer::emit_segment(const std::string& length, Body& body) {
  if (!body.in_detail) add(body, fmt::format("bone (0, 0, 0) -> (0, {}, 0)", length));
  add(body, fmt::format("size y {}  move y {} / 2  emit cylinder  move y {} / 2", length, length, length));
  end_line(body);
}

/// A module that is rewritten: a child, or a call of a detail.
void Writer::emit_child(const Module& m, const Species& species, Body& body) {
  Plan& plan = plans_.at(&species);
  if (!plan.asked_for) {
    plan.asked_for = true;
    wanted_.push_back(&species);
  }
  const auto call = [&](const std::string& name, const std::vector<std::string>& values) {
    std::string list;
    for (const std::string& value : values) list += (list.empty() ? "" : ", ") + value;
    return name + (list.empty() ? "" : "(" + list + ")");
  };
  if (species.is_detail && !body.in_detail) use("iterations");
  for (const RuleName& rule : plan.rules) {
    std::vector<std::string> args;
    if (species.is_detail) args.push_back(body.left);
    for (std::size_t i = 0; i < m.args.size(); ++i)
      if (rule.used[i]) args.push_back(spell_in(m.args[i], body));
    add(body, (species.is_detail ? "detail " : "spawn ") + call(rule.name, args));
  }
  if (!plan.segment.empty()) {
    std::vector<std::string> lengths;
    if (!m.args.empty()) lengths.push_back(spell_in(m.args[0], body));
    add(body, "spawn " + call(plan.segment, lengths));
  }
  end_line(body);
}

std::string Writer::length_of(const Module& m, Body& body) {
  const std::string base = m.args.empty()   ? use("step")
                           : steps_.find(m) ? factor(m.args[0], body)
                                            : spell_in(m.args[0], body);
  return named(grown(base, m, body), "len", body);
}

/// A value of a symbol that only multiplies, as it is after the steps that are left.
std::string Writer::grown(std::string value, const Module& m, const Body& body) {
  const Species* species = steps_.find(m);
  if (!species || !species->growth || *species->growth == 1) return value;
  if (!body.in_detail) use("iterations");
  const std::string left = is_simple(body.left) ? body.left : "(" + body.left + ")";
  return fmt::format("{} * {} ^ {}", value, spell(*species->growth), left);
}

/// A name for an expression that is used several times; numbers and names stand for themselves.
std::string Writer::named(const std::string& expression, const char* wanted, Body& body) {
  if (is_simple(expression) && expression[0] != '-') return expression;
  const auto known = body.lets.find(expression);
  if (known != body.lets.end()) return known->second;
  const std::string name = (body.in_start ? globals_ : body.names).claim(wanted);
  body.let_lines.push_back(fmt::format("let {} = {}", name, expression));
  return body.lets[expression] = name;
}

std::string Writer::spell_in(const Expr& expr, const Body& body) {
  return spell(expr, [&](const std::string& name) {
    const auto param = body.params.find(name);
    return param != body.params.end() ? param->second : use_constant(name);
  });
}

/// As a factor of a product.
std::string Writer::factor(const Expr& expr, const Body& body) {
  const std::string text = spell_in(expr, body);
  const bool product = expr.op == Op::multiply || expr.op == Op::divide || expr.op == Op::power;
  return product || (is_simple(text) && expr.op != Op::negate) ? text : "(" + text + ")";
}

/// The name of a setting, which is then declared.
std::string Writer::use(const std::string& setting) {
  used_.insert(setting);
  return settings_.at(setting);
}

std::string Writer::use_constant(const std::string& name) {
  if (used_constants_.insert(name).second)
    for (const Constant& c : system_.constants)
      if (c.name == name) spell(c.value, [&](const std::string& inner) { return use_constant(inner); });
  return constants_.at(name);
}

}  // namespace espalier::lsystem
