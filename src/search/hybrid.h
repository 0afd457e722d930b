#pragma once
// Hybrid: SOSMC for the start, then the genetic algorithm and RJMCMC in turns, each beginning with what the others
// found (handing over is the future work of ShapeGenetics 2017, section 9). SOSMC hands over after its first sweeps or so
// many evaluations. Then whichever of the other two raised the best more per evaluation in its last turn goes on; the
// other is tried again now and then, more rarely each time that it does worse. When neither gains, RJMCMC begins anew
// elsewhere until it has settled, and what it found joins the others. All of it counts evaluations.

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "search/engine.h"
#include "search/hybrid_settings.h"
#include "search/state_stream.h"

namespace espalier {

class HybridEngine final : public Engine {
 public:
  enum class Stage : std::uint8_t { start, middle, end };

  /// Throws Error for bad settings.
  HybridEngine(const SearchProblem& problem, const HybridSettings& settings);
  ~HybridEngine() override;

  /// Throws what the engines throw.
  void step() override;
  std::uint64_t steps() const override { return course_.steps; }
  std::uint64_t evaluations() const override { return course_.evaluations_before + engine_->evaluations(); }
  std::span<const Individual> population() const override { return engine_->population(); }
  const Individual& best() const override;
  /// Of all three, each name with its engine's before it.
  std::vector<NamedCount> diagnostics() const override;
  /// `stage`, and those of all three, each with its engine's name before it: nothing to tell of those that do not run.
  std::vector<NamedGauge> gauges() const override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;

  Stage stage() const { return course_.stage; }
  /// How often an engine has taken over from another, or begun anew.
  std::uint64_t handovers() const { return course_.handovers; }

 private:
  /// What is known of an engine's turns.
  struct Standing {
    bool ran = false;
    double gain = 0;          // of the best per evaluation, in its last turn
    std::uint64_t rests = 0;  // turns of the other since
    std::uint64_t wait = 1;   // of those, before it is tried again
  };

  /// Where the search stands, individuals and counts aside.
  struct Course {
    Stage stage = Stage::start;
    std::uint64_t steps = 0;
    std::uint64_t evaluations_before = 0;  // by engines that are done, and at handing over
    std::uint64_t handovers = 0;
    double turn_best = 0;                  // when the turn began
    std::uint64_t turn_begun = 0;          // evaluations then
    std::uint64_t turn_first_step = 0;     // steps then
    bool on_trial = false;                 // whoever has the turn did worse when it last had one
    std::uint64_t stalled = 0;             // turns in a row in which the best did not rise
    bool afresh = false;                   // RJMCMC runs, begun anew
    double fresh_best = 0;                 // its own, when the turn began
    std::uint64_t settled = 0;             // its turns in a row in which that did not rise
    std::uint64_t fresh_starts = 0;
    std::array<Standing, 3> standings;
  };

  std::unique_ptr<Engine> make_engine(Stage stage, std::vector<Individual> founders) const;
  std::uint32_t lane() const;
  bool turn_is_over() const;
  Stage next_stage();
  void end_turn();
  bool has_settled();
  void begin_afresh();
  void begin_turn();
  void hand_over(Stage to, std::vector<Individual> founders);
  std::vector<Individual> heirs(std::size_t most);
  bool make_heir(Individual& heir, std::size_t place) const;
  void score(const std::vector<std::size_t>& which, std::vector<Individual>& individuals);
  Standing& standing(Stage stage) { return course_.standings[static_cast<std::size_t>(stage)]; }
  std::vector<NamedCount> counts_of(Stage stage) const;
  std::string own_fingerprint() const;
  static constexpr std::uint64_t kMostHandovers = 65'535;  // each has random streams of its own; then nobody takes over
  static constexpr std::uint64_t kLongestWait = 32;        // turns
  static constexpr std::uint64_t kStalledTurns = 10;       // then RJMCMC begins anew
  static constexpr std::uint64_t kSettledTurns = 4;        // then what it found joins the others

  static void write_course(StateWriter& writer, const Course& course);
  static Course read_course(StateReader& reader);
  std::vector<Individual> read_individuals(StateReader& reader, std::string_view what) const;

  SearchProblem problem_;
  HybridSettings settings_;
  Course course_;
  std::unique_ptr<Engine> engine_;
  std::vector<Individual> founders_;        // of the engine that runs
  std::vector<Individual> bred_;            // the genetic algorithm's last population
  std::array<std::vector<NamedCount>, 3> counts_;  // of turns that are over
  std::array<std::vector<NamedGauge>, 3> silent_;  // the gauges of engines that do not run
  Individual best_;
};

}  // namespace espalier
