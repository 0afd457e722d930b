#pragma once
// Engine: a search for derivations that score high. It advances by `step()` alone; when to stop, clocks, threads, files
// and progress are the business of whoever drives it. A pure function of (graph, locks, scorer, settings, seed, lane):
// equal inputs take equal steps, on any machine.

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "derivation/derivation.h"
#include "derivation/locks.h"
#include "score/objective.h"

namespace espalier {

struct Individual {
  Derivation derivation;
  double score = 0;  // higher is better
};

/// What every engine is given. The scorer must outlive the engine.
struct SearchProblem {
  std::shared_ptr<const GeneratorGraph> graph;
  Locks locks;
  BatchScorer* scorer = nullptr;
  std::uint64_t seed = 0;
  std::uint32_t lane = 0;  // of the random streams: engine or island, below 2^24
  /// Individuals to start from, best first: another engine's population, or one that a person likes. Finished, scored
  /// and acceptable, within the gene limits. Where there are locks, they hold for these.
  std::vector<Individual> founders = {};
};

/// One of an engine's own figures: a running total since the first step.
struct NamedCount {
  std::string name;
  std::uint64_t value = 0;

  bool operator==(const NamedCount&) const = default;
};

/// One of an engine's figures of the moment: a rate, a share, an effective number. Finite, or not a number where there
/// is nothing to tell yet.
struct NamedGauge {
  std::string name;
  double value = 0;
};

class Engine {
 public:
  virtual ~Engine() = default;

  /// The first step makes and scores the initial population; each later one makes the next generation.
  virtual void step() = 0;
  /// Steps taken since the start, those before a `load` included.
  virtual std::uint64_t steps() const = 0;
  /// Derivations handed to the scorer so far.
  virtual std::uint64_t evaluations() const = 0;
  /// Best first, equal scores in order of birth; empty before the first step.
  virtual std::span<const Individual> population() const = 0;
  /// The best individual ever scored. Only after the first step.
  virtual const Individual& best() const = 0;
  /// best().score, and the mean of the population's scores; for engines to which individuals cost something to show.
  virtual double best_score() const { return best().score; }
  virtual double mean_score() const;
  /// Individuals may have open slots, as a matter of course: what is shown there is their `otherwise`.
  virtual bool leaves_open() const { return false; }
  /// What happened inside, by name, in a fixed order.
  virtual std::vector<NamedCount> diagnostics() const = 0;
  /// How well it goes. Names and their order are the same over the life of an engine; equal states give equal values, a
  /// loaded state too.
  virtual std::vector<NamedGauge> gauges() const = 0;

  /// Writes the whole state: an engine of the same problem and settings that loads it goes on as if never stopped.
  virtual void save(std::ostream& out) const = 0;
  /// Throws Error for a stream that is cut short, of another version, engine, seed or settings, or that holds what is
  /// no derivation of the graph; the engine is then as before.
  virtual void load(std::istream& in) = 0;
};

}  // namespace espalier
