#pragma once
// What engines see of scoring: a batch of derivations in, their scores out. Threads, models and targets stay behind it.
// Chains, whose proposals change little of their state, may have a session each: it saves time and changes no score.

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "derivation/derivation.h"

namespace espalier {

/// The score of what is not acceptable.
inline constexpr double kNotAcceptable = -std::numeric_limits<double>::infinity();

/// What a scorer remembers of one state of a chain, to score proposals by their difference from it. Not to be used
/// while its scorer scores.
class ScoreSession {
 public:
  virtual ~ScoreSession() = default;
  /// The state is now this one, whatever it was. Before all else.
  virtual void begin(const Derivation& state) = 0;
  /// The proposal that was scored last is the state now; at most once for each, and never for what was not acceptable.
  /// Without it the state stays as it is.
  virtual void commit() = 0;
};

struct ScoreProposal {
  ScoreSession* session = nullptr;  // of the scorer that is asked, begun; null: there is none
  const Derivation* derivation = nullptr;
};

class GrowthPool;
struct GrowingDerivation;
struct GrowthRenumbering;

/// Scores derivations that grow in a pool, shoot by shoot. Each has a place here; what places share is kept once.
class GrowthScorer {
 public:
  virtual ~GrowthScorer() = default;
  /// Forgets all: so many places, all empty; the pool is empty too.
  virtual void begin(std::size_t places) = 0;
  /// The place is empty again.
  virtual void clear(std::size_t place) = 0;
  /// The derivation at this place has a new gene; parents come before children.
  virtual void grown(std::size_t place, const GrowthPool& pool, std::uint32_t shoot) = 0;
  /// The same, where the gene is a copy of one that is known.
  virtual void grown_again(std::size_t place, std::uint32_t shoot, std::uint32_t copy_of) = 0;
  /// Place k takes over what place ancestors[k] has; there are as many places then as ancestors.
  virtual void follow(std::span<const std::uint32_t> ancestors) = 0;
  /// scores[k] = what BatchScorer gives for the derivation at place k, packed.
  virtual void score(const GrowthPool& pool, std::span<const GrowingDerivation> growing, std::span<double> scores) = 0;
  /// promises[k] = what the open slots at place k let hope for, to be added to its score while it grows; 0 where nothing
  /// is known.
  virtual void promise(const GrowthPool& pool, std::span<const GrowingDerivation> growing,
                       std::span<double> promises) = 0;
  /// What this gene added to the score when it came, at the places that have it.
  virtual double worth(std::uint32_t shoot) const = 0;
  /// The pool has forgotten what nobody needs.
  virtual void renumber(const GrowthRenumbering& renumbering) = 0;
};

class BatchScorer {
 public:
  virtual ~BatchScorer() = default;

  /// scores[i] = score of *derivations[i]; higher is better. Finite, or kNotAcceptable (beyond a
  /// hard limit): engines never keep that, but redraw it. The same for any number of threads.
  virtual void score(std::span<const Derivation* const> derivations, std::span<double> scores) = 0;

  /// Null where a session is of no use, or there is no memory left for one. The scorer must outlive it.
  virtual std::unique_ptr<ScoreSession> make_session() { return nullptr; }

  /// scores[i] = score of *proposals[i].derivation: the very same that score() gives. No session may be there twice.
  virtual void score_proposals(std::span<const ScoreProposal> proposals, std::span<double> scores) {
    std::vector<const Derivation*> derivations;
    for (const ScoreProposal& proposal : proposals) derivations.push_back(proposal.derivation);
    score(derivations, scores);
  }

  /// Null where what grows must be scored as a whole. The scorer must outlive it.
  virtual std::unique_ptr<GrowthScorer> make_growth_scorer() { return nullptr; }

  /// The best score that any model could have (it need not be reachable).
  virtual double optimum() const = 0;

  /// For messages: what was not acceptable so far, and by which limits.
  virtual std::string describe_rejections() const { return ""; }
};

}  // namespace espalier
