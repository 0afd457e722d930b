#include "grammar/lsystem_steps.h"

#include <algorithm>
#include <cmath>

namespace espalier::lsystem {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

}  // namespace

Steps::Steps(const System& system) : system_(system) {
  collect_species();
  for (Species& s : species_) find_growth(s);
  follow();
  spread_details();
}

void Steps::collect_species() {
  for (std::size_t i = 0; i < system_.productions.size(); ++i) {
    const Production& p = system_.productions[i];
    const auto [place, fresh] = index_.try_emplace({p.symbol, p.params.size()}, species_.size());
    if (fresh) species_.push_back({p.symbol, p.params, {}, {}, false, {}, {}});
    species_[place->second].productions.push_back(i);
  }
}

std::size_t Steps::index_of(const Module& module) const {
  const auto found = index_.find({module.symbol, module.args.size()});
  return found == index_.end() ? kNone : found->second;
}

const Species* Steps::find(const Module& module) const {
  const std::size_t i = index_of(module);
  return i == kNone ? nullptr : &species_[i];
}

Values Steps::values(const Species& species, const Arguments& arguments) const {
  return [this, &species, &arguments](const std::string& name) -> std::optional<double> {
    for (std::size_t i = 0; i < arguments.size(); ++i)
      if (species.params[i] == name) return arguments[i];
    for (const Constant& c : system_.constants)
      if (c.name == name) return c.number;
    return std::nullopt;
  };
}

std::optional<double> Steps::constant(const Expr& expr) const {
  static const Species kNoSpecies;
  return evaluate(expr, values(kNoSpecies, {}));
}

/// One production without guard or chance whose successor is the symbol itself, once or (where uses add up) more often,
/// its argument multiplied by constants.
void Steps::find_growth(Species& species) const {
  const bool adds_up = species.symbol != "!";
  const bool turtle = std::string_view("+-&^\\/!").find(species.symbol[0]) != std::string_view::npos ||
                      draws({species.symbol, {}, {}}) || moves({species.symbol, {}, {}});
  const Production& p = system_.productions[species.productions[0]];
  if (!turtle || species.productions.size() != 1 || p.guard || p.probability || p.params.size() > 1) return;
  if (p.successor.empty() || (p.successor.size() > 1 && !adds_up)) return;
  double growth = 0;
  for (const Module& m : p.successor) {
    if (find(m) != &species) return;
    if (m.args.empty()) {
      growth += 1;
      continue;
    }
    const auto at = [&](double x) { return evaluate(m.args[0], values(species, {x})); };
    const std::optional<double> zero = at(0), one = at(1), two = at(2), seven = at(7);
    if (!zero || !one || !two || !seven || *zero != 0) return;
    if (std::abs(*two - 2 * *one) > 1e-12 * std::abs(*one) || std::abs(*seven - 7 * *one) > 1e-11 * std::abs(*one))
      return;
    growth += *one;
  }
  if (growth > 0) species.growth = growth;
}

bool Steps::reads_params(const Species& species) const {
  for (const std::size_t i : species.productions)
    for (const auto* e : {&system_.productions[i].guard, &system_.productions[i].probability})
      if (*e && std::any_of(species.params.begin(), species.params.end(), [&](const auto& p) { return reads(**e, p); }))
        return true;
  return false;
}

/// The productions that apply to a module: the first whose guard holds, or if that has a probability, all that have.
/// Nothing where a guard has no value.
std::optional<std::set<std::size_t>> Steps::matching(const Species& species, const Arguments& arguments) const {
  std::set<std::size_t> result;
  bool chances = false;
  for (const std::size_t i : species.productions) {
    const Production& p = system_.productions[i];
    if (p.guard) {
      const std::optional<double> holds = evaluate(*p.guard, values(species, arguments));
      if (!holds) return std::nullopt;
      if (*holds == 0) continue;
    }
    if (result.empty()) chances = p.probability.has_value();
    if (!result.empty() && !p.probability) continue;
    result.insert(i);
    if (!chances) break;
  }
  return result;
}

std::optional<Steps::Arguments> Steps::arguments(const Module& module, const Values& values) const {
  Arguments result;
  for (const Expr& arg : module.args) {
    const std::optional<double> value = evaluate(arg, values);
    if (!value) return std::nullopt;
    result.push_back(*value);
  }
  return result;
}

void Steps::follow() {
  const std::size_t steps = static_cast<std::size_t>(system_.iterations);
  modules_.assign(steps + 1, std::vector<std::set<Arguments>>(species_.size()));
  for (Species& s : species_) s.applied.resize(steps), s.occurs.resize(steps);
  for (const Module& m : system_.axiom)
    if (const std::size_t i = index_of(m); i != kNone)
      if (const auto args = arguments(m, values(species_[i], {}))) modules_[0][i].insert(*args);
  Budget budget;
  for (int step = 0; step < system_.iterations; ++step) {
    followed_ = follow_step(step, budget);
    if (!followed_) break;
  }
  for (Species& s : species_) {
    if (reads_params(s)) {
      s.is_detail |= !followed_;  // too many to follow: they decide as the model is built
    } else if (const auto match = matching(s, {})) {
      s.applied.assign(steps, *match);
      s.occurs.assign(steps, 1);
    }
  }
}

/// False where there are too many distinct modules, or values that are not finite.
bool Steps::follow_step(int step, Budget& budget) {
  const std::size_t k = static_cast<std::size_t>(step);
  for (std::size_t i = 0; i < species_.size(); ++i) {
    Species& s = species_[i];
    bool first = true;
    for (const Arguments& args : modules_[k][i]) {
      if (budget.modules == 0) return false;
      --budget.modules;
      const auto match = matching(s, args);
      if (!match) return false;
      if (first) s.applied[k] = *match;
      else if (s.applied[k] != *match) s.is_detail = true;
      first = false;
      s.occurs[k] = 1;
      for (const std::size_t p : *match)
        for (const Module& m : system_.productions[p].successor)
          if (const std::size_t next = index_of(m); next != kNone) {
            if (budget.successors == 0) return false;
            --budget.successors;
            const auto next_args = arguments(m, values(s, args));
            if (!next_args) return false;
            modules_[k + 1][next].insert(*next_args);
          }
    }
    if (!reads_params(s)) continue;
    for (const std::size_t p : s.applied[k])  // chances that depend on parameters cannot be weights of a rule
      for (const std::string& name : s.params)
        if (system_.productions[p].probability && reads(*system_.productions[p].probability, name)) s.is_detail = true;
  }
  return true;
}

/// Details only lead to details.
void Steps::spread_details() {
  for (bool changed = true; changed;) {
    changed = false;
    for (const Species& s : species_) {
      if (!s.is_detail) continue;
      for (const std::size_t p : s.productions)
        for (const Module& m : system_.productions[p].successor)
          if (const std::size_t i = index_of(m); i != kNone && !species_[i].is_detail)
            species_[i].is_detail = changed = true;
    }
  }
}

}  // namespace espalier::lsystem
