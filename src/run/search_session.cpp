#include "run/search_session.h"

#include "base/check.h"
#include "run/make_engine.h"

namespace espalier {
namespace {

// Sketching costs about as much as scoring, and populations change slowly.
constexpr std::uint64_t kStepsPerOffer = 10;

// One place more than are kept: the best takes one.
DiverseArchive make_archive(const Setup& setup) {
  return DiverseArchive(ModelSketcher(setup.graph(), setup.stage, setup.full()),
                        std::size_t{setup.scene.output.keep} + 1, setup.scene.output.distance);
}

}  // namespace

SearchSession::SearchSession(const Setup& setup, Executor& executor, StopwatchClock clock)
    : setup_(setup),
      scorer_(setup.graph(), setup.objective, executor),
      engine_(make_engine(setup.scene.search, {setup.grammar.graph, setup.locks, &scorer_, setup.scene.seed, 0,
                                               setup.founders})),
      archive_(make_archive(setup)),
      watch_(clock) {}

const StepReport& SearchSession::step() {
  CHECK(!finished_);
  watch_.go();
  engine_->step();
  const std::uint64_t idle = engine_->evaluations() == last_.evaluations ? last_.idle + 1 : 0;
  last_ = {engine_->steps(), engine_->evaluations(), watch_.seconds(), engine_->best_score(),
           engine_->mean_score(), idle};
  if (last_.step % kStepsPerOffer == 1) archive_.offer(engine_->population(), engine_->leaves_open());
  log_.add(last_);
  if (log_.wants_gauges(last_.step)) log_.add_gauges(last_, gauges());
  return last_;
}

std::vector<NamedGauge> SearchSession::gauges() const {
  std::vector<NamedGauge> gauges = engine_->gauges();
  gauges.push_back({"alternatives", static_cast<double>(archive_.members().size())});
  gauges.push_back({"spread", archive_.spread()});
  return gauges;
}

SearchResult SearchSession::finish(std::string stopped_by) {
  CHECK(!finished_ && last_.step > 0);
  finished_ = true;
  archive_.offer(engine_->population(), engine_->leaves_open());
  log_.add_gauges(last_, gauges());
  SearchResult result;
  result.best = engine_->best();
  result.explanation = scorer_.explain(result.best.derivation);
  if (setup_.scene.output.keep > 0) {
    result.alternatives = archive_.apart_from(result.best.derivation);
    std::vector<Individual> kept = result.alternatives;
    kept.push_back(result.best);
    result.spread = archive_.spread_of(kept);
  }
  result.log = log_;
  result.diagnostics = engine_->diagnostics();
  result.rejections = scorer_.rejections();
  result.steps = last_.step, result.evaluations = last_.evaluations, result.seconds = watch_.seconds();
  result.stopped_by = std::move(stopped_by);
  return result;
}

}  // namespace espalier
