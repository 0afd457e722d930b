#pragma once
// BreedingBench: what a project's state is for breeding: its grammar, what judges candidates, and the way from texts of
// derivations to such as the grammar can show. Of one thread at a time.

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <studio_types.h>

#include "base/executor.h"
#include "breed/breed_problem.h"
#include "run/scene_scorer.h"
#include "studio/bred_model.h"
#include "studio/workbench.h"

namespace espalier::studio {

class BreedingBench {
 public:
  static constexpr std::uint32_t kMostGenes = 20'000;  // of an individual

  /// `executor` must outlive it.
  BreedingBench(ReadBlob read_blob, Executor& executor);
  ~BreedingBench();

  /// Throws Error for a state that is not right; then the one before stays.
  void take(const StoredState& state);
  bool ready() const { return setup_ != nullptr; }
  /// Only when ready, as all that follows.
  const std::shared_ptr<const Setup>& setup() const { return setup_; }
  const GeneratorGraph& graph() const { return setup_->graph(); }
  bool has_targets() const { return has_targets_; }
  /// Per gene, as the scene wants them of Genesis; none: by the kinds of the draws.
  const std::vector<std::uint32_t>& genesis_bits() const { return genesis_bits_; }
  const StoredState& state() const { return state_; }
  std::string as_named(const std::string& text) const { return bench_.as_named(text); }

  /// The derivation as the grammar can show it, adapted where it is of an older text. Throws Error saying why it
  /// cannot.
  Derivation read(const std::string& encoded) const;
  /// Locks that lead nowhere in this grammar hold nothing, and are left out.
  Held held(const std::vector<api::DrawPlace>& locked) const;
  /// What is usual for the grammar, with the limits of these settings. What it costs is paid when the grammar's text is
  /// new.
  ViabilitySettings viability(const api::RoomSettings& settings);
  /// What is bred here, judged by these settings. It is good until the next call of this or of take.
  BreedProblem problem(const api::RoomSettings& settings, std::uint64_t seed,
                       const std::vector<api::DrawPlace>& locked);
  /// The model of one that was judged for the problem last posed; null where none was kept: there are targets, or no
  /// room for more.
  BredModelPtr seen(const Derivation& derivation) const;
  void forget_seen();

  /// Of a derivation by the hash of its text. Kept, as long as the state stays.
  const std::vector<double>& features(const std::string& hash,
                                      const std::function<std::string(const std::string&)>& read_text);
  bool knows_features(const std::string& hash) const { return features_.count(hash) != 0; }
  const std::vector<std::string>& feature_names() { return looker().feature_names(); }
  /// Of what the grammar grows at random: one more at each call, until it says that all are there.
  bool draw_random_features();
  const std::vector<std::vector<double>>& random_features() const { return random_; }

 private:
  Executor& executor_;
  Workbench bench_;
  StoredState state_;
  std::shared_ptr<const Setup> setup_;
  bool has_targets_ = false;  // the setup
  std::vector<std::uint32_t> genesis_bits_;
  std::optional<ViabilitySettings> usual_;  // of ...
  std::string usual_of_;                    // this text
  bool usual_is_exact_ = false;             // and of this very state
  std::unique_ptr<SceneScorer> scorer_;
  void watch(const Sighting& sighting);
  ModelAppraiser& looker();

  struct Seen {
    Derivation derivation;
    BredModelPtr model;
  };
  std::mutex seen_mutex_;  // while candidates are judged
  std::unordered_multimap<std::uint64_t, Seen> seen_;  // by the derivation's hash
  std::size_t seen_bytes_ = 0;
  std::unique_ptr<ModelAppraiser> appraiser_;
  std::unique_ptr<ModelAppraiser> looker_;  // for features, whatever is viable
  std::map<std::string, std::vector<double>> features_;
  std::vector<std::vector<double>> random_;
};

}  // namespace espalier::studio
