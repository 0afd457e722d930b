#pragma once
// Reversible-jump Markov chain Monte Carlo over derivations (Talton et al. 2011; ShapeGenetics 2017, section 7). Every
// step each chain makes one proposal (derivation/proposal.h) and accepts it with the probability that leaves
//
//     prior(derivation) * exp(beta * score), restricted to what is acceptable (or prior * score^beta),
//
// as it is, where beta = 1 / temperature of its rung. Ladders of temperatures swap their states (parallel tempering):
// the hot move freely, the cold hold on to what is good. Annealing cools all rungs by steps.
//
// Delayed rejection (Tierney and Mira 1999; Green and Mira 2001): when fresh draws of a gene are rejected, a nudge of
// that gene is tried, accepted with the probability that keeps the same distribution (search/acceptance.h).

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "search/best_first.h"
#include "search/engine.h"
#include "search/rjmcmc_settings.h"

namespace espalier {

enum class ProposalKind : std::uint8_t { draws, nudges, slots, jumps, delayed };
inline constexpr std::size_t kProposalKinds = 5;

struct ProposalCount {
  std::uint64_t proposed = 0, accepted = 0;

  bool operator==(const ProposalCount&) const = default;
};

/// Proposals by rung and kind, and tries to swap each rung but the last with the next.
struct RjmcmcCounts {
  explicit RjmcmcCounts(std::size_t rungs = 1) : proposals(rungs), swaps(rungs - 1) {}

  std::vector<std::array<ProposalCount, kProposalKinds>> proposals;
  std::vector<ProposalCount> swaps;
};
/// What came to `before` until `after`.
RjmcmcCounts difference(const RjmcmcCounts& after, const RjmcmcCounts& before);

class RjmcmcEngine final : public Engine {
 public:
  /// Throws Error for bad settings.
  RjmcmcEngine(const SearchProblem& problem, const RjmcmcSettings& settings);
  RjmcmcEngine(const RjmcmcEngine&) = delete;
  RjmcmcEngine& operator=(const RjmcmcEngine&) = delete;

  /// The first throws Error as the genetic algorithm does, where no acceptable individuals can be made.
  void step() override;
  std::uint64_t steps() const override { return steps_; }
  std::uint64_t evaluations() const override { return evaluations_; }
  /// The states of the chains.
  std::span<const Individual> population() const override { return states_; }
  const Individual& best() const override;
  std::vector<NamedCount> diagnostics() const override;
  /// Rates of acceptance are of the last kGaugeSteps steps that are complete, of the kGaugeRungs coldest rungs.
  std::vector<NamedGauge> gauges() const override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;

  /// 1 / temperature of a rung now; rung 0 is the coldest.
  double beta(std::uint32_t rung) const;
  /// The rung of the chain whose state is population()[place].
  std::uint32_t rung_of(std::size_t place) const { return chain_of_[place] % settings_.temperatures; }
  /// Proposals by rung and kind. A proposal that does not exist or breaks a limit counts as rejected.
  const ProposalCount& count(std::uint32_t rung, ProposalKind kind) const {
    return counts_.proposals[rung][static_cast<std::size_t>(kind)];
  }
  /// Tries to swap rung and rung + 1.
  const ProposalCount& swaps(std::uint32_t rung) const { return counts_.swaps[rung]; }

  static constexpr std::uint64_t kGaugeSteps = 1000;
  static constexpr std::size_t kGaugeRungs = 64;

 private:
  /// What a chain does in this step.
  struct Try {
    ProposalKind kind = ProposalKind::draws;
    std::uint32_t gene = 0;   // draws: whose
    double log_ratio = 0;
    double score = 0;         // of the proposal
    double rejected_score = 0;  // delayed: of what was rejected before
    bool made = false;
    RandomStream random{StreamKey{}};
  };

  void make_initial_states();
  void begin_sessions();
  void propose();
  void propose_delayed();
  void score_made();
  double log_acceptance(std::size_t place) const;
  double value_of(double score) const { return log_weight(settings_.weight, score); }
  bool within_limits(const Derivation& derivation) const;
  ProposalKind draw_kind(RandomStream& random) const;
  void decide();
  void swap_rungs();
  void sort_states();
  ProposalCount& count_of(std::size_t place) {
    return counts_.proposals[rung_of(place)][static_cast<std::size_t>(tries_[place].kind)];
  }

  SearchProblem problem_;
  RjmcmcSettings settings_;
  double beta_ = 1;  // of the coldest rung, before annealing
  std::uint64_t steps_ = 0, evaluations_ = 0, rejected_starts_ = 0;
  RjmcmcCounts counts_;
  RjmcmcCounts counts_then_, recent_;  // at the last multiple of kGaugeSteps; in the kGaugeSteps before it
  Individual best_;
  std::vector<Individual> states_;       // best first, equal ones by chain
  std::vector<std::uint32_t> chain_of_;  // of each state

  std::vector<Try> tries_;               // per state
  std::vector<Derivation> proposals_;    // per state
  // One per state where the scorer has them; begun with the states when they are next needed.
  std::vector<std::unique_ptr<ScoreSession>> sessions_;
  std::vector<std::size_t> session_of_;  // of each state
  bool sessions_begun_ = false;
  std::vector<ScoreProposal> batch_;
  std::vector<std::size_t> batch_places_;
  std::vector<double> scores_;
  BestFirst best_first_;
  std::vector<std::uint32_t> chain_scratch_;
  std::vector<std::size_t> session_scratch_;
};

}  // namespace espalier
