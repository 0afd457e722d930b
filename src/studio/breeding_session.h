#pragma once
// BreedingSession: an open session of the breeding room: the individuals of the generation that is shown, and what
// people do to them. What throws Error has changed nothing; what returns is on disk. Of one thread at a time.

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <studio_types.h>

#include "studio/bred_model.h"
#include "studio/breeding_bench.h"
#include "studio/breeding_recipe.h"
#include "studio/breeding_store.h"

namespace espalier::studio {

struct RoomIndividual {
  BredRow row;
  std::optional<Derivation> derivation;  // as the grammar can show it now
  std::string missing;                   // why it cannot
  std::uint32_t version = 0;             // counts its models
  BredModelPtr model;                    // null: not made yet
};

class BreedingSession {
 public:
  static constexpr std::size_t kMostShown = 40;     // individuals of a generation: those bred, and what blends added
  static constexpr std::size_t kMostRatings = 200, kMostDraws = 2000, kMostLocked = 2000;  // of a request; of a session

  /// Makes a session with its first generation; returns its number. `founders`: derivations as JSON.
  static std::int64_t begin(BreedingStore& store, BreedingBench& bench, std::int64_t project,
                            const api::StartBreeding& start, const std::vector<std::string>& founders);
  /// All must outlive it; the bench must be ready. Throws Error where there is no such session.
  BreedingSession(BreedingStore& store, BreedingBench& bench, std::int64_t project, std::int64_t session);

  std::int64_t number() const { return head_.summary.id; }
  const BreedingHead& head() const { return head_; }
  const api::RoomSettings& settings() const { return settings_; }
  const std::vector<api::DrawPlace>& locked() const { return locked_; }
  const std::vector<RoomIndividual>& individuals() const { return individuals_; }
  std::vector<std::string> notes() const { return notes_of_ == head_.generation ? notes_ : std::vector<std::string>(); }
  std::vector<GenerationSummary> generations() const { return store_.generations(number()); }
  std::vector<BreedingComparison> comparisons() const { return store_.comparisons(number()); }
  std::vector<BredRow> lineage() const { return store_.individuals(number()); }

  /// The bench has another state.
  void refresh();
  /// Whatever the store has now: the session has another name.
  void reload();
  /// Any individual of the session. Throws Error.
  RoomIndividual find(std::int64_t id) const;
  /// The model of an individual that is shown, or of one with the same derivation, has been made.
  void keep_model(const std::string& derivation, const BredModelPtr& model);

  /// What is left to do once all models are there, and nobody asks for anything: how different they are, and what the
  /// taste model expects of them. A small part of it at each call; whether there is something new to tell.
  bool reflect();
  bool wants_to_reflect() const { return !reflected_; }
  /// What it expects of one that is shown.
  const std::map<std::int64_t, api::Taste>& forecasts() const { return forecasts_; }

  void set(const api::SetBreeding& change);
  void rate(const api::Rate& rate);
  void compare(const api::Compare& compare);
  void set_genes(const api::SetGenes& set);
  void lock(const api::LockDraws& lock);
  void breed();
  void more_like(std::int64_t individual);
  /// Two or three of the session mixed.
  Derivation blended(const api::Blend& blend) const;
  void keep_blend(const api::Blend& blend);
  void go_to(std::int64_t generation);
  void undo();
  void redo();

 private:
  RoomIndividual& shown(std::int64_t id);
  BreedingChange rating_change(std::int64_t individual, std::optional<double> rating);
  std::vector<double> worst_before() const;
  void make(RecipeKind kind, const std::vector<const RoomIndividual*>& parents, const std::string& label);
  void commit(BreedingStep step);
  void add_opinions(BreedingRecipe& recipe) const;
  void expect_again();
  double looked_at();

  BreedingStore& store_;
  BreedingBench& bench_;
  const std::int64_t project_, session_;
  BreedingHead head_;
  api::RoomSettings settings_;
  std::vector<api::DrawPlace> locked_;
  std::vector<RoomIndividual> individuals_;
  std::vector<std::string> notes_;  // of the generation made last
  std::int64_t notes_of_ = 0;
  std::uint32_t versions_ = 0;
  bool reflected_ = false;                         // on what is shown now
  std::optional<BreedingRecipe> said_;             // what the taste model is to learn from, while that is gathered
  std::set<std::string> strangers_;                // derivations among that which the grammar has no place for
  std::map<std::int64_t, api::Taste> forecasts_;   // by individual
  std::map<std::string, BredModelPtr> models_;  // by derivation
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();  // what is shown is looked at
};

}  // namespace espalier::studio
