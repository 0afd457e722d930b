#pragma once
// BreedingStore: sessions of the breeding room in the file of projects. As with the store's own calls, what one has
// changed is on disk when it returns. Safe to use from any thread.
//
// Generations and individuals only ever come; what may change of them, and of the session, is a field that a step of
// undo knows before and after.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "studio/store.h"

namespace espalier::studio {

struct BreedingSummary {
  std::int64_t id = 0;
  std::string name, method;
  std::int64_t generations = 0, individuals = 0;
  double changed = 0;  // seconds since 1970
};

struct BreedingHead {
  BreedingSummary summary;
  std::int64_t project = 0, revision = 0, seed = 0;
  std::string settings, locked;            // JSON
  std::int64_t generation = 0;             // that is shown
  std::int64_t last_individual = 0, last_comparison = 0;  // numbers that are taken, undone ones among them
  std::optional<std::string> undo, redo;   // labels
};

struct StoredGeneration {
  std::int64_t number = 0, parent = 0;  // 0: a first one
  std::string label;
  StoredState state;                    // that it was bred in
  std::string recipe;                   // JSON: all else that it was made from
  double seconds = 0;                   // that it was looked at
  std::optional<double> diversity = {};
};

/// What lists tell of a generation.
struct GenerationSummary {
  std::int64_t number = 0, parent = 0, individuals = 0, rated = 0, edited = 0;
  std::string label;
  double seconds = 0;
  std::optional<double> diversity;
};

struct BredRow {
  std::int64_t id = 0, generation = 0, place = 0;
  std::string origin;
  std::vector<std::int64_t> parents = {};
  std::string born, derivation;  // hashes of texts: as it was bred, as it is
  bool edited = false, present = true;
  std::optional<double> rating = {};
  std::optional<std::string> role = {};
};

inline constexpr double kMostRating = 1000;  // and its negative the least

struct BreedingComparison {
  std::int64_t number = 0, better = 0, worse = 0;  // number counts those of a session from 1
};

/// What a step may change. `subject`: an individual, or a comparison's number, or 0.
enum class BreedingField : std::uint8_t { settings, locked, generation, derivation, edited, rating, present, compared };

struct BreedingChange {
  BreedingField field;
  std::int64_t subject = 0;
  std::optional<std::string> before, after;
};

/// A step, and all that comes with it.
struct BreedingStep {
  std::string label;
  std::string gesture = {};  // steps of one gesture in a row are one; empty: it stands alone
  std::vector<BreedingChange> changes = {};
  std::optional<StoredGeneration> generation = {};
  std::vector<BredRow> individuals = {};
  std::vector<BreedingComparison> comparisons = {};
  std::map<std::string, std::string> texts = {};  // by hash
  double seconds = 0;  // that the generation shown before was looked at since the last step
};

/// A session with all that belongs to it but its steps of undo.
struct WholeBreeding {
  BreedingHead head;
  std::vector<StoredGeneration> generations = {};         // by number, 1, 2, ...
  std::vector<BredRow> individuals = {};                  // by id
  std::vector<BreedingComparison> comparisons = {};
  std::map<std::string, std::string> derivations = {};    // texts by hash
  std::map<std::string, std::string> files = {};          // bytes by hash, of all states
};

class BreedingStore {
 public:
  static constexpr std::int64_t kMostBreedings = 100;  // of a project
  static constexpr std::int64_t kMostGenerations = 500, kMostIndividuals = 10'000, kMostSteps = 500;  // of a session
  static constexpr std::int64_t kMostBytes = 128 << 20;  // of a session's texts

  explicit BreedingStore(Store& store) : store_(store) {}

  std::vector<BreedingSummary> list(std::int64_t project);
  /// A session with its first generation. Throws Error, here and below, for what is not there, or beyond a budget; then
  /// nothing has changed.
  std::int64_t create(std::int64_t project, const BreedingHead& head, const BreedingStep& first);
  /// For export, and what came back from there; returns its number.
  WholeBreeding whole(std::int64_t project, std::int64_t session);
  std::int64_t insert(std::int64_t project, const WholeBreeding& whole);
  void rename(std::int64_t project, std::int64_t session, const std::string& name);
  void remove(std::int64_t project, std::int64_t session);

  BreedingHead open(std::int64_t project, std::int64_t session);
  std::vector<GenerationSummary> generations(std::int64_t session);
  StoredGeneration generation(std::int64_t session, std::int64_t number);
  /// Of one generation in the order of the screen, those that undo took away left out; or of all, by id.
  std::vector<BredRow> individuals(std::int64_t session, std::optional<std::int64_t> generation = {});
  BredRow individual(std::int64_t session, std::int64_t id);
  std::vector<BreedingComparison> comparisons(std::int64_t session);
  std::string text(std::int64_t session, const std::string& hash);

  void take(std::int64_t session, const BreedingStep& step);
  void set_diversity(std::int64_t session, std::int64_t generation, double diversity);
  /// Whether there was something to take back, or to do again.
  bool undo(std::int64_t session) { return move(session, true); }
  bool redo(std::int64_t session) { return move(session, false); }

 private:
  bool move(std::int64_t session, bool back);

  Store& store_;
};

}  // namespace espalier::studio
