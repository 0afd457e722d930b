#pragma once
// Target: one wish about a model, giving a number and an explanation for people. Open for more kinds (silhouettes,
// curves): one header per kind; the cost of the virtual call is per model.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "derivation/derivation.h"
#include "model/model.h"
#include "score/model_change.h"

namespace espalier {

/// What a target reads, each including those before: the derivation; bones; emits of rules; emits of details too.
enum class TargetView : std::uint8_t { genes, bones, parts, full };

/// One line of an explanation: value = weight * (what the form makes of count, often count or S(count / of)).
struct Term {
  std::string name;   // "inside hull.obj", "overlap"
  double weight = 0;  // as it enters the score: subtracted weights are negative
  double count = 0;   // in `unit`s
  double of = 0;      // the count's natural scale (0 = none): target voxels, covered voxels, ...
  double value = 0;   // what it adds to the score
  std::string unit;   // "voxels", "genes"
};

/// A score taken apart. The values of the terms add up to the score (but for rounding).
struct Explanation {
  std::string name;  // of the target; empty for the whole objective
  double weight = 1; // of the target in its objective; score, optimum and terms are before it
  double score = 0;
  double optimum = 0;
  std::optional<double> percent;  // 100 * score / optimum; none unless optimum > 0
  std::string rejected;  // why the model is not acceptable; then the score is -infinity, and terms tell the rest of it
  std::vector<Term> terms;
  std::string words;              // "81 % filled, 6 % spilled, 2 % overlap"
  std::vector<Explanation> targets;  // the objective's: one per target
};

/// Memory that one thread scores with; made by the target that uses it.
class TargetScratch {
 public:
  virtual ~TargetScratch() = default;
};

/// What a target remembers of one state of a search, to score proposals that differ little from it by the difference.
/// Of one thread at a time.
class TargetSession {
 public:
  virtual ~TargetSession() = default;
  /// The very score that the target gives to the model. `change` is from the state to the model; `scratch` comes from
  /// the target's make_scratch.
  virtual double score(const Derivation& derivation, const Model& model, const ModelChange& change,
                       TargetScratch* scratch) = 0;
  /// What was scored last is the state now; at most once for each. Without it the state stays.
  virtual void commit() = 0;
  /// The state is now another one.
  virtual void restart() = 0;
  /// For tests: the last score was got by the difference, and not by scoring the whole model.
  virtual bool counted_change() const = 0;
};

/// What one hard bound has rejected so far.
struct Rejections {
  std::string name;   // of what was measured: "height"
  std::string bound;  // "at most 6 m"
  std::string unit;
  std::uint64_t count = 0;
  double lowest = 0, highest = 0;  // of the values rejected; only where count > 0
};

class Target {
 public:
  virtual ~Target() = default;
  virtual const std::string& name() const = 0;
  virtual TargetView view() const = 0;
  /// For one thread; may be kept for any number of models. Null where none is needed.
  virtual std::unique_ptr<TargetScratch> make_scratch() const { return nullptr; }
  /// Null where whole models must be scored. The target must outlive it.
  virtual std::unique_ptr<TargetSession> make_session() const { return nullptr; }
  /// The most memory that one session takes, in bytes; 0 where there are none.
  virtual std::size_t session_bytes() const { return 0; }
  /// Whether it may find a model not acceptable. Such targets are asked first, and rejected models scored no further.
  virtual bool may_reject() const { return false; }
  /// Higher is better; finite, or -infinity: not acceptable. `scratch` comes from make_scratch of this very target.
  virtual double score(const Derivation& derivation, const Model& model, TargetScratch* scratch) const = 0;
  /// The best score that any model could have (it need not be reachable).
  virtual double optimum() const = 0;
  /// False where no bound on scores is known; optimum() is 0 then.
  virtual bool bounded() const { return true; }
  virtual Explanation explain(const Derivation& derivation, const Model& model, TargetScratch* scratch) const = 0;
  /// What `score` rejected with this scratch: one entry per hard bound, always the same ones.
  virtual std::vector<Rejections> rejections(const TargetScratch*) const { return {}; }
};

/// 100 * score / optimum where that says something.
inline std::optional<double> percent_of(double score, double optimum) {
  if (!(optimum > 0)) return std::nullopt;
  return 100 * score / optimum;
}

}  // namespace espalier
