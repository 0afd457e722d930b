#pragma once
// Rises: how the best score of a search rose, so that it can be asked for at any time and after any number of
// evaluations. Rises are few however long a search is; of very many, evenly chosen ones are kept.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "run/progress.h"
#include "run/thinned.h"

namespace espalier {

/// What a search spends.
enum class Effort : std::uint8_t { seconds, evaluations };
inline std::string_view name_of(Effort effort) { return effort == Effort::seconds ? "seconds" : "evaluations"; }

class Rises {
 public:
  static constexpr std::size_t kMost = 16'384;  // that are kept, the last aside

  /// Every step of the search, in order.
  void add(const StepReport& report);

  bool empty() const { return rises_.rows().empty(); }
  /// What was spent when the first step ended, and when the last did. Only after a step.
  double first(Effort effort) const { return spent(rises_.rows().front().row, effort); }
  double last(Effort effort) const { return spent(last_, effort); }
  double best() const { return last_.best; }

  /// The best of the steps that had ended when so much was spent; nothing before the first step's end, nor beyond the
  /// last's.
  std::optional<double> at(Effort effort, double so_much) const;
  /// What was spent when the best first came up to `score`; nothing: it never did, or only after more of `limited` than
  /// `most` was spent.
  std::optional<double> reaching(Effort effort, double score, Effort limited, double most) const;

 private:
  struct Rise {
    std::uint64_t evaluations = 0;
    double seconds = 0, best = 0;
  };

  static double spent(const Rise& rise, Effort effort) {
    return effort == Effort::seconds ? rise.seconds : static_cast<double>(rise.evaluations);
  }

  std::uint64_t count_ = 0;
  Thinned<Rise> rises_{kMost};
  Rise last_;
};

}  // namespace espalier
