#include "grammar/growth.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace espalier {

using ast::Decl;

namespace {

constexpr double kFarBelow = 1e6;       // the depth that stands for "in the long run"
constexpr double kCritical = 1 - 1e-9;  // a spectral radius from here on counts as 1
constexpr int kMostIterations = 1000;

}  // namespace

/// Far down inside a component its rules have been seen often, all others once.
StaticScope GrowthCheck::far_below(const Rules& component, double depth) const {
  std::set<std::string_view> inside;
  for (const std::size_t rule : component) inside.insert(context_.decls()[rule].name);
  return samples_.at(depth, [&](const std::string& rule) { return inside.contains(rule) ? depth : 1.0; });
}

double GrowthCheck::mean_children(const SpawnTerm& term, const StaticScope& scope) const {
  double mean = term.copies;
  if (term.spawn->probability) {
    const auto p = evaluate_static(*term.spawn->probability, scope);
    mean *= p ? std::clamp(p->scalar(), 0.0, 1.0) : 0;
  }
  for (std::size_t at = term.chosen; at != ChosenCase::kNone; at = context_.chosen[at].outer) {
    const ChosenCase& chosen = context_.chosen[at];
    StaticScope inner = scope;
    for (const auto& [name, value] : chosen.loops) inner.locals[name] = value;
    double total = 0, own = 0;
    for (std::size_t i = 0; i < chosen.choose->cases.size(); ++i) {
      const auto weight = evaluate_static(*chosen.choose->cases[i].value, inner);
      const double w = weight ? std::max(weight->scalar(), 0.0) : 0;
      total += w;
      if (i == chosen.alternative) own = w;
    }
    mean *= total > 0 ? own / total : 0;
  }
  return mean;
}

bool GrowthCheck::has_cycle(const Rules& component) const {
  if (component.size() > 1) return true;
  const auto& terms = context_.spawns[component[0]];
  return std::any_of(terms.begin(), terms.end(), [&](const SpawnTerm& t) { return t.child == component[0]; });
}

/// Whether the guard of a rule fails in the long run on every way round its cycles. Two depths in a row are tried, for
/// guards like `depth mod 2 == 0`.
bool GrowthCheck::guard_ends(std::size_t rule, const Rules& component) const {
  const ast::ExprPtr& guard = context_.decls()[rule].guard;
  if (!guard) return false;
  for (const double depth : {kFarBelow, kFarBelow + 1}) {
    const auto holds = evaluate_static(*guard, far_below(component, depth));
    if (!holds || !holds->truth()) return true;
  }
  return false;
}

/// Of the matrix of mean children among the rules of a component: power iteration on M + 1, with the bounds of Collatz
/// and Wielandt.
double GrowthCheck::spectral_radius(const Rules& component, bool required_only) const {
  struct Entry {
    std::size_t row, column;
    double mean;
  };
  const StaticScope scope = far_below(component, kFarBelow);
  std::vector<Entry> entries;
  for (std::size_t row = 0; row < component.size(); ++row) {
    for (const SpawnTerm& term : context_.spawns[component[row]]) {
      if (required_only && term.spawn->probability) continue;
      const auto place = std::lower_bound(component.begin(), component.end(), term.child);
      if (place == component.end() || *place != term.child) continue;
      entries.push_back({row, static_cast<std::size_t>(place - component.begin()), mean_children(term, scope)});
    }
  }
  std::vector<double> x(component.size(), 1), y;
  double low = 0, high = 0;
  for (int i = 0; i < kMostIterations; ++i) {
    y = x;
    for (const Entry& e : entries) y[e.row] += e.mean * x[e.column];
    low = INFINITY;
    high = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      low = std::min(low, y[k] / x[k] - 1);
      high = std::max(high, y[k] / x[k] - 1);
    }
    if (low >= kCritical || high < kCritical || high - low < 1e-12) break;
    const double largest = *std::max_element(y.begin(), y.end());
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = std::max(y[k] / largest, 1e-300);
  }
  return low >= kCritical ? low : high < kCritical ? high : (low + high) / 2;
}

/// "`A` -> `B` -> `A`": a shortest way from the first rule of the component back to itself.
std::string GrowthCheck::name_cycle(const Rules& component, bool required_only) const {
  std::vector<std::size_t> from(context_.decls().size(), ChosenCase::kNone);
  for (const std::size_t start : component) {
    std::vector<std::size_t> row = {start};
    std::fill(from.begin(), from.end(), ChosenCase::kNone);
    for (std::size_t next = 0; next < row.size() && from[start] == ChosenCase::kNone; ++next) {
      for (const SpawnTerm& term : context_.spawns[row[next]]) {
        if (required_only && term.spawn->probability) continue;
        if (from[term.child] != ChosenCase::kNone ||
            !std::binary_search(component.begin(), component.end(), term.child))
          continue;
        from[term.child] = row[next];
        row.push_back(term.child);
      }
    }
    if (from[start] == ChosenCase::kNone) continue;  // lies on no cycle of required spawns
    std::string names = fmt::format("`{}`", context_.decls()[start].name);
    int shown = 0;
    for (std::size_t at = from[start]; at != start && shown < 8; at = from[at], ++shown)
      names = fmt::format("`{}` -> {}", context_.decls()[at].name, names);
    return fmt::format("`{}` -> {}{}", context_.decls()[start].name, shown == 8 ? "... -> " : "", names);
  }
  return "";
}

void GrowthCheck::check_cycle(const Rules& component) {
  if (!has_cycle(component)) return;
  const double required = spectral_radius(component, true);
  const double all = required >= kCritical ? required : spectral_radius(component, false);
  if (all < kCritical) return;
  const bool is_required = required >= kCritical;
  context_.diagnostics.error(
      "E0802", context_.decls()[component[0]].name_span,
      fmt::format(
          "{} on the cycle {}, which has no guard and no limit: each turn is expected to make {:.3g} of itself, "
          "and that must be < 1",
          is_required ? "required spawns never end" : "genes become more and more", name_cycle(component, is_required),
          all),
      is_required ? "add a guard, `rule NAME when depth < N`, or write `maybe`"
                  : "lower the probabilities, or add a guard, `rule NAME when depth < N`, or a `limit`");
}

void GrowthCheck::run() {
  std::vector<char> left_out(context_.decls().size(), false);
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    const Decl& decl = context_.decls()[i];
    left_out[i] = decl.kind != ast::DeclKind::rule || !context_.checked.reachable[decl.name];
  }
  bounded_ = left_out;
  can_be_absent_.assign(left_out.size(), false);
  for (const Rules& component : components(left_out)) {
    for (const std::size_t rule : component) {
      can_be_absent_[rule] = guard_ends(rule, component);
      if (can_be_absent_[rule] || context_.decls()[rule].limit) bounded_[rule] = true;
    }
  }
  check_end();
  if (context_.diagnostics.has_errors()) return;
  for (const Rules& component : components(bounded_)) check_cycle(component);
  if (!context_.diagnostics.has_errors()) check_size();
}

void check_growth(CheckContext& context) { GrowthCheck(context).run(); }

}  // namespace espalier
