#include "run/search_loop.h"

#include "run/budget.h"

namespace espalier {
namespace {

// Why to stop, empty: go on.
std::string reason_to_stop(const SearchControl& control, const StepReport& report) {
  if (control.stop && control.stop->load()) return "interrupt";
  if (control.exact_steps) return report.step >= *control.exact_steps ? "steps" : "";
  return budget_spent(control.budget, report);
}

}  // namespace

std::optional<SearchResult> run_search(SearchSession& session, const SearchControl& control) {
  if (session.last().step == 0 && control.stop && control.stop->load()) return std::nullopt;
  std::string reason = session.last().step > 0 ? reason_to_stop(control, session.last()) : "";
  while (reason.empty()) {
    const StepReport report = session.step();
    if (control.observer) control.observer->step(report);
    if (control.observer && session.logged_gauges()) control.observer->gauges(report, session.log().last_gauges());
    if (control.watcher) control.watcher->stepped(report, session.engine().best());
    reason = reason_to_stop(control, report);
    if (control.keeper && reason.empty()) control.keeper->stepped(session);
  }
  if (control.keeper) control.keeper->ending(session);
  return session.finish(std::move(reason));
}

std::optional<SearchResult> run_search(const Setup& setup, const SearchControl& control, Executor& executor) {
  SearchSession session(setup, executor);
  return run_search(session, control);
}

}  // namespace espalier
