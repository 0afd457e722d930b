#include "grammar/lsystem_writer.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace espalier::lsystem {
namespace {

/// A guard on depth from what has to hold at each step (1), must not (0), or does not matter (-1). A gene for a module
/// of step k has depth k + 1. Empty where it always holds.
std::string depth_condition(const std::vector<int>& wanted, const std::string& iterations) {
  const int last = static_cast<int>(wanted.size()) - 1;  // the step after all rewriting
  std::string text;
  const auto value = [&](int k) { return wanted[static_cast<std::size_t>(k)]; };
  for (int k = 0; k <= last; ++k) {
    if (value(k) != 1) continue;
    int begin = k, end = k;
    while (begin > 0 && value(begin - 1) == -1) --begin;
    while (end < last && value(end + 1) != 0) ++end;
    k = end;
    std::string run;
    if (begin > 0) run = begin == last ? "depth > " + iterations : fmt::format("depth > {}", begin);
    if (end < last)
      run += (run.empty() ? "" : " and ") +
             (end == last - 1 ? "depth <= " + iterations : fmt::format("depth <= {}", end + 1));
    if (run.empty()) return {};
    text += (text.empty() ? "" : " or ") + run;
  }
  return text.empty() ? "depth < 0" : text;
}

std::string indented(const std::string& lines) { return "{\n" + lines + "}"; }

}  // namespace

void Writer::fail(std::string code, const SourceSpan& span, std::string message, std::string help) {
  diagnostics_.error(std::move(code), span, std::move(message), std::move(help));
}

std::string Writer::run() {
  for (const char* name : {"iterations", "step", "turn_angle", "width", "thinner"})
    settings_[name] = globals_.claim(name);
  const std::string start = globals_.claim("Start");
  for (const Constant& c : system_.constants) constants_[c.name] = globals_.claim(c.name);
  plan();
  if (diagnostics_.has_errors()) return {};
  Body body;
  body.in_start = true;
  body.left = settings_["iterations"];
  const Modules axiom = visible(system_.axiom);
  if (axiom.empty())
    fail("L0205", system_.axiom.empty() ? SourceSpan{} : system_.axiom[0].span, "the axiom draws nothing",
         "symbols that draw are F, those that `draw:` lists, and those that are rewritten");
  used_.insert("width");
  const std::string statements = text_of(axiom, body);
  while (!wanted_.empty() && !diagnostics_.has_errors()) {
    const Species* next = wanted_.front();
    wanted_.erase(wanted_.begin());
    write(*next);
  }
  const std::string y = used_.contains("step") ? settings_["step"] : "0";
  return fmt::format("{}start {}\n\nrule {} {{\nsize ({}, {}, {})\n{}}}\n{}", declarations(), start, start,
                     settings_["width"], y, settings_["width"], statements, rules_);
}

/// Names for all rules, in the order of the file.
void Writer::plan() {
  for (const Species& s : steps_.species()) {
    if (s.growth) continue;
    if (std::string_view("+-&^\\/|!").find(s.symbol[0]) != std::string_view::npos)
      return fail("L0204", system_.productions[s.productions[0]].span,
                  fmt::format("`{}` is a turtle command, and may only become itself, times a number", s.symbol),
                  "rewrite a letter instead, such as `T -> +T`");
    Plan plan;
    const std::string name = s.symbol;
    for (const char* table : {"_way", "_path", "_turn", "_axis"}) tables_[name + table] = globals_.claim(name + table);
    std::set<std::set<std::size_t>> sets;
    for (std::size_t k = 0; k < s.applied.size(); ++k)
      if (s.occurs[k] && !s.applied[k].empty()) sets.insert(s.applied[k]);
    if (s.is_detail) {
      plan.rules.push_back({globals_.claim(name), {}, {}});
    } else {
      for (const auto& set : sets) {
        const std::string numbered = sets.size() == 1 ? name : fmt::format("{}_{}", name, plan.rules.size() + 1);
        plan.rules.push_back({globals_.claim(numbered), set, {}});
      }
      if (steps_.draws({s.symbol, {}, {}})) plan.segment = globals_.claim(s.symbol + "_segment");
    }
    plan.used.assign(s.params.size(), 0);
    if (!s.params.empty() && s.is_detail && (steps_.draws({s.symbol, {}, {}}))) plan.used[0] = 1;
    plans_[&s] = std::move(plan);
  }
  find_used_params();
}

/// Which parameters are handed down: those that shape something somewhere below.
void Writer::find_used_params() {
  for (bool changed = true; changed;) {
    changed = false;
    for (auto& [species, plan] : plans_)
      for (const std::size_t p : species->productions) changed |= mark_used(*species, p, plan.used);
  }
  for (auto& [species, plan] : plans_)
    for (RuleName& rule : plan.rules) {
      rule.used.assign(species->params.size(), 0);
      if (species->is_detail) rule.used = plan.used;
      for (const std::size_t p : rule.productions) mark_used(*species, p, rule.used);
    }
}

/// True where it marks more than there were.
bool Writer::mark_used(const Species& species, std::size_t production, std::vector<char>& used) const {
  bool changed = false;
  const auto read = [&](const Expr& expr) {
    for (std::size_t i = 0; i < species.params.size(); ++i)
      if (!used[i] && reads(expr, species.params[i])) used[i] = changed = true;
  };
  const Production& p = system_.productions[production];
  for (const auto* e : {&p.guard, &p.probability})
    if (species.is_detail && *e) read(**e);
  const Modules modules = visible(p.successor);
  for (std::size_t n = 0; n < modules.size(); ++n) {
    const Module& m = *modules[n];
    const Species* child = steps_.find(m);
    const bool to_child = child && !child->growth;
    const bool leaps = to_child && n + 1 < modules.size() && modules[n + 1]->symbol != "]";
    for (std::size_t i = 0; i < m.args.size(); ++i) {
      const bool first = i == 0 && (!to_child || leaps || steps_.draws(m));
      if (first || (to_child && plan_of(*child).used[i])) read(m.args[i]);
    }
  }
  return changed;
}

std::string Writer::about() const {
  std::string text = fmt::format(
      "# Imported from {}, an L-system. One rewriting step is one level of genes: each symbol\n"
      "# that is rewritten is a rule, its alternatives are a `choose`, its successor is what the rule holds.\n",
      options_.file);
  if (!written_tables_.empty())
    text += "# A child gives no frame back, so functions of the steps that are left tell where it ends; for more\n"
            "# iterations import the file again.\n";
  if (angle_is_fixed_) text += "# The angle is a constant, because where children end depends on it.\n";
  if (has_details_)
    text += "# Symbols that decide by their parameters, and all that they lead to, are details: genes decide by\n"
            "# depth and constants alone. A search cannot change them, and they have no bones.\n";
  return text;
}

std::string Writer::declarations() const {
  std::string text = fmt::format("grammar {} 1\n{}", options_.name, about());
  const auto name = [&](const char* key) { return settings_.at(key); };
  if (used_.contains("iterations")) text += fmt::format("const {} = {}\n", name("iterations"), system_.iterations);
  for (const Constant& c : system_.constants)
    if (used_constants_.contains(c.name))
      text += fmt::format("const {} = {}\n", constants_.at(c.name),
                          spell(c.value, [&](const std::string& n) { return constants_.at(n); }));
  if (used_.contains("thinner")) text += fmt::format("const {} = {}\n", name("thinner"), spell(system_.thinner));
  const std::string angle = spell(system_.angle) + "deg";
  const int most = std::abs(system_.angle) <= 180 ? 180 : 360;
  if (used_.contains("turn_angle"))
    text += angle_is_fixed_ ? fmt::format("const {} = {}\n", name("turn_angle"), angle)
                            : fmt::format("attr {} in {}deg..{}deg = {} \"Turtle/Angle\"\n", name("turn_angle"),
                                          system_.angle < 0 ? -most : 0, most, angle);
  const auto length = [&](const char* key, double value, const char* label) {
    text += fmt::format("attr {} in {}..{} = {} \"Turtle/{}\"\n", name(key), fmt::format("{:.6g}", value / 4),
                        fmt::format("{:.6g}", value * 4), spell(value), label);
  };
  if (used_.contains("step")) length("step", system_.step, "Step");
  length("width", system_.width, "Width");
  return text + functions_;
}

void Writer::write(const Species& species) {
  if (species.is_detail) return write_detail(species);
  for (const RuleName& rule : plan_of(species).rules) write_rule(species, rule);
  if (!plan_of(species).segment.empty()) write_segment(species);
}

/// "(a, b)" of the parameters that are used, whose names go to `body`.
std::string Writer::head(const Species& species, const RuleName& rule, Body& body) const {
  std::string list;
  if (body.in_detail) list = body.left;
  for (std::size_t i = 0; i < species.params.size(); ++i) {
    if (!rule.used[i]) continue;
    const std::string name = body.names.claim(species.params[i]);
    body.params[species.params[i]] = name;
    list += (list.empty() ? "" : ", ") + name;
  }
  return list.empty() ? "" : "(" + list + ")";
}

/// When a rule is there: at the steps where just these productions apply; null: at the steps where none does.
std::string Writer::condition(const Species& species, const std::set<std::size_t>* productions) {
  std::vector<int> wanted;
  for (std::size_t k = 0; k < species.applied.size(); ++k) {
    const bool same = productions ? species.applied[k] == *productions : species.applied[k].empty();
    wanted.push_back(!species.occurs[k] ? -1 : same ? 1 : 0);
  }
  wanted.push_back(productions ? 0 : 1);
  const std::string text = depth_condition(wanted, settings_.at("iterations"));
  if (text.find(settings_.at("iterations")) != std::string::npos) use("iterations");
  return text.empty() ? "" : " when " + text;
}

void Writer::write_rule(const Species& species, const RuleName& rule) {
  Body body;
  body.names = globals_;
  body.left = settings_.at("iterations") + " - depth";
  const std::string params = head(species, rule, body);
  const std::string text = alternatives(rule.productions, body);
  if (text.find(body.left) != std::string::npos) use("iterations");
  rules_ += fmt::format("\nrule {}{}{} {}\n", rule.name, params, condition(species, &rule.productions), indented(text));
}

/// What a symbol that draws shows once it is rewritten no more.
void Writer::write_segment(const Species& species) {
  Body body;
  body.names = globals_;
  std::string length = species.params.empty() ? use("step") : body.names.claim(species.params[0]);
  const std::string params = species.params.empty() ? "" : "(" + length + ")";
  emit_segment(length, body);
  rules_ += fmt::format("\nrule {}{}{} {}\n", plan_of(species).segment, params, condition(species, nullptr),
                        indented(body.lines[0] + "\n"));
}

/// The statements of one production, or a choice between several.
std::string Writer::alternatives(const std::set<std::size_t>& productions, const Body& empty) {
  std::vector<std::pair<std::string, std::string>> cases;
  for (const std::size_t p : productions) {
    const Production& production = system_.productions[p];
    const std::string text = text_of(visible(production.successor), empty);
    if (!production.probability) return text;
    const std::optional<double> weight = steps_.constant(*production.probability);
    if (weight && *weight < 0)
      fail("L0206", production.span, fmt::format("probabilities are not negative, this is {}", *weight), {});
    if (!weight || *weight > 0) cases.emplace_back(spell_in(*production.probability, empty), text);
  }
  if (cases.empty()) return {};
  if (cases.size() == 1) return cases[0].second;
  std::string result = "choose {\n";
  for (const auto& [weight, text] : cases) result += weight + ": " + indented(text) + "\n";
  return result + "}\n";
}

/// if left > 0 { the first production whose guard holds, or a choice of those with the same guard } else the segment
void Writer::write_detail(const Species& species) {
  has_details_ = true;
  Body body;
  body.in_detail = true;
  body.names = globals_;
  const std::string left = body.names.claim("left");
  body.left = left;
  const std::string params = head(species, plan_of(species).rules[0], body);
  body.left = left + " - 1";
  std::vector<std::pair<std::string, std::set<std::size_t>>> groups;  // by guard
  for (const std::size_t p : species.productions) {
    const Production& production = system_.productions[p];
    std::string guard = left + " > 0";
    if (production.guard) {
      const std::string text = spell_in(*production.guard, body);
      guard += production.guard->op == Op::logical_or ? " and (" + text + ")" : " and " + text;
    }
    if (groups.empty() || groups.back().first != guard) groups.push_back({guard, {}});
    if (groups.back().second.empty() || production.probability) groups.back().second.insert(p);
  }
  std::string text;
  for (const auto& [guard, productions] : groups)
    text += fmt::format("{}if {} {}", text.empty() ? "" : " else ", guard, indented(alternatives(productions, body)));
  if (steps_.draws({species.symbol, {}, {}})) {
    Body end = body;
    emit_segment(species.params.empty() ? use("step") : body.params.at(species.params[0]), end);
    text += " else " + indented(end.lines[0] + "\n");
  }
  rules_ += fmt::format("\ndetail {}{} {}\n", plan_of(species).rules[0].name, params, indented(text + "\n"));
}

}  // namespace espalier::lsystem
