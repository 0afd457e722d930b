#pragma once
// BreedingRecipe: all that a generation is made from beside the project's state. It is kept with the generation, and a
// generation is only ever made from what was kept: making it again gives the same to the bit.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <studio_types.h>

#include "breed/member.h"
#include "breed/taste.h"
#include "studio/breeding_bench.h"

namespace espalier::studio {

enum class RecipeKind : std::uint8_t {
  first,  // a first screen; parents are founders, shown as they are
  bred,   // the next generation of the parents
  like,   // the one parent, and relatives of it
};

struct RecipeParent {
  std::int64_t id = 0;     // 0: a founder
  std::string derivation;  // hash of its text
  std::optional<double> rating = {};

  bool operator==(const RecipeParent&) const = default;
};

/// What a taste model learns from: what people said of a derivation, wherever in the session it stood; of two, which is
/// better.
struct RecipeOpinion {
  std::string derivation;  // hash of its text
  double rating = 0;

  bool operator==(const RecipeOpinion&) const = default;
};
struct RecipeComparison {
  std::string better, worse;  // hashes

  bool operator==(const RecipeComparison&) const = default;
};

struct BreedingRecipe {
  RecipeKind kind = RecipeKind::first;
  api::RoomSettings settings = {};  // complete
  std::uint64_t seed = 0;
  std::uint32_t number = 0;         // of the generation, from 1
  std::int64_t first_id = 1;        // of its individuals
  std::vector<api::DrawPlace> locked = {};
  std::vector<RecipeParent> parents = {};
  std::vector<double> worst_before = {};  // classic: the least ratings of the generations before, the nearest first
  // With taste alone:
  std::vector<RecipeOpinion> opinions = {};
  std::vector<RecipeComparison> comparisons = {};

  bool operator==(const BreedingRecipe&) const = default;
};

/// JSON, and back. Throws Error.
std::string to_json(const BreedingRecipe& recipe);
BreedingRecipe parse_recipe(std::string_view json);

/// Hashes of all derivations that it names.
std::vector<std::string> texts_of(const BreedingRecipe& recipe);

/// The text of a derivation by its hash. Throws Error.
using ReadText = std::function<std::string(const std::string& hash)>;

/// Whether a taste model chooses: it is wanted, and has something to learn from.
bool uses_taste(const BreedingRecipe& recipe);
/// The taste that the recipe's opinions tell of; nothing where the grammar has a place for none of them.
std::optional<Taste> learn_taste(BreedingBench& bench, const BreedingRecipe& recipe, const ReadText& read_text);

struct MadeGeneration {
  std::vector<Member> members;
  std::vector<std::string> roles;  // with taste: of each, "best", "different", "uncertain", or "" where it was kept
  std::vector<std::string> notes;  // what was short, in words
};

/// Parents that the grammar has no place for are left out. Throws Error where nothing can be made of it.
MadeGeneration make_generation(BreedingBench& bench, const BreedingRecipe& recipe, const ReadText& read_text);

}  // namespace espalier::studio
