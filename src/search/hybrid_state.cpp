// Saving and loading of the hybrid engine.
#include <istream>
#include <ostream>
#include <utility>

#include <fmt/format.h>

#include "search/engine_state.h"
#include "search/hybrid.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMagic = 0x0a59'4850'5345ull;  // the bytes "ESPHY\n"
constexpr std::uint64_t kStateVersion = 4;

void write_individuals(StateWriter& writer, const std::vector<Individual>& individuals) {
  writer.u64(individuals.size());
  for (const Individual& one : individuals) write_individual(writer, one);
}

}  // namespace

void HybridEngine::write_course(StateWriter& writer, const Course& course) {
  writer.u64(static_cast<std::uint64_t>(course.stage));
  writer.u64(course.steps);
  writer.u64(course.evaluations_before);
  writer.u64(course.handovers);
  writer.f64(course.turn_best);
  writer.u64(course.turn_begun);
  writer.u64(course.turn_first_step);
  writer.u64(course.on_trial);
  writer.u64(course.stalled);
  writer.u64(course.afresh);
  writer.f64(course.fresh_best);
  writer.u64(course.settled);
  writer.u64(course.fresh_starts);
  for (const Standing& standing : course.standings) {
    writer.u64(standing.ran);
    writer.f64(standing.gain);
    writer.u64(standing.rests);
    writer.u64(standing.wait);
  }
}

HybridEngine::Course HybridEngine::read_course(StateReader& reader) {
  Course course;
  course.stage = static_cast<Stage>(reader.u64_at_most(2, "stage"));
  course.steps = reader.u64();
  course.evaluations_before = reader.u64();
  course.handovers = reader.u64_at_most(kMostHandovers, "handovers");
  course.turn_best = reader.f64();
  course.turn_begun = reader.u64();
  course.turn_first_step = reader.u64();
  course.on_trial = reader.u64_at_most(1, "trial") != 0;
  course.stalled = reader.u64();
  course.afresh = reader.u64_at_most(1, "whether it began anew") != 0;
  course.fresh_best = reader.f64();
  course.settled = reader.u64();
  course.fresh_starts = reader.u64();
  for (Standing& standing : course.standings) {
    standing.ran = reader.u64_at_most(1, "whether an engine ran") != 0;
    standing.gain = reader.f64();
    standing.rests = reader.u64();
    standing.wait = reader.u64_at_most(kLongestWait, "turns to wait");
  }
  return course;
}

std::vector<Individual> HybridEngine::read_individuals(StateReader& reader, std::string_view what) const {
  std::vector<Individual> individuals;
  const std::uint64_t size = reader.u64_at_most(1'000'000, what);
  for (std::uint64_t i = 0; i < size; ++i) {
    individuals.push_back(read_finished_individual(reader, *problem_.graph, settings_.middle.genes));
  }
  return individuals;
}

std::string HybridEngine::own_fingerprint() const {
  return fingerprint("hybrid", problem_,
                     fmt::format("sweeps {} start {} turn {}; {}; {}; {}", settings_.sweeps, settings_.start_evaluations,
                                 settings_.turn, to_text(settings_.start), to_text(settings_.middle),
                                 to_text(settings_.end)));
}

void HybridEngine::save(std::ostream& out) const {
  StateWriter writer(out);
  write_head(writer, kMagic, kStateVersion, own_fingerprint());
  write_course(writer, course_);
  for (const auto& of_stage : counts_) {
    for (const NamedCount& count : of_stage) writer.u64(count.value);
  }
  write_individuals(writer, founders_);
  write_individuals(writer, bred_);
  if (course_.steps > 0) write_individual(writer, best_);
  engine_->save(out);
}

void HybridEngine::load(std::istream& in) {
  StateReader reader(in);
  read_head(reader, kMagic, kStateVersion, own_fingerprint());
  Course course = read_course(reader);
  auto counts = counts_;
  for (auto& of_stage : counts) {
    for (NamedCount& count : of_stage) count.value = reader.u64();
  }
  std::vector<Individual> founders = read_individuals(reader, "founders");
  std::vector<Individual> bred = read_individuals(reader, "individuals that rest");
  Individual best;
  if (course.steps > 0) best = read_finished_individual(reader, *problem_.graph, settings_.middle.genes);
  std::swap(course_, course);  // the engine's random streams depend on it
  std::unique_ptr<Engine> engine;
  try {
    engine = make_engine(course_.stage, founders);
    engine->load(in);
  } catch (...) {
    std::swap(course_, course);
    throw;
  }
  counts_ = std::move(counts);
  founders_ = std::move(founders), bred_ = std::move(bred);
  best_ = std::move(best);
  engine_ = std::move(engine);
}

}  // namespace espalier
