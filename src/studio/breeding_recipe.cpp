#include "studio/breeding_recipe.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "breed/first_generation.h"
#include "breed/generation.h"
#include "breed/screen.h"
#include "breed/species.h"
#include "studio/breeding_settings.h"
#include "studio/breeding_store.h"

namespace espalier::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> kKinds = {"first", "bred", "like"};
constexpr std::size_t kMostParents = 1000, kMostOpinions = 2000;

double rating_in(const Json& json) {
  const double rating = json.get<double>();
  if (!(std::abs(rating) <= kMostRating)) throw Error(fmt::format("a rating must be {} .. {}", -kMostRating, kMostRating));
  return rating;
}

/// The parents as members; `lost`: how many the grammar has no place for, and why the last of them.
std::vector<Member> members_of(const BreedingBench& bench, const BreedingRecipe& recipe, const ReadText& read_text,
                               std::size_t& lost, std::string& why) {
  std::vector<Member> members;
  for (const RecipeParent& parent : recipe.parents) {
    Member member;
    try {
      member.derivation = bench.read(read_text(parent.derivation));
    } catch (const Error& error) {
      ++lost;
      why = error.what();
      continue;
    }
    member.id = static_cast<MemberId>(parent.id);
    member.rated = parent.rating.has_value();
    member.rating = parent.rating.value_or(0);
    members.push_back(std::move(member));
  }
  return members;
}

/// A copy of the individual, and siblings of it.
MadeGeneration relatives(BreedProblem problem, const BreedingRecipe& recipe, const BreedSettings& settings,
                         const Member& favourite) {
  // Others each time that it is asked for.
  problem.draw = recipe.number;
  SpeciesSettings wanted;
  wanted.count = settings.population - 1;
  wanted.strength = settings.strength;
  Species species = find_species(problem, favourite.derivation, wanted);
  MadeGeneration made;
  Member copy = favourite;
  copy.id = static_cast<MemberId>(recipe.first_id);
  copy.origin = Origin::kept;
  copy.parents = {favourite.id};
  made.members.push_back(std::move(copy));
  for (Derivation& derivation : species.siblings) {
    Member sibling;
    sibling.id = made.members.back().id + 1;
    sibling.derivation = std::move(derivation);
    sibling.origin = Origin::sibling;
    sibling.parents = {favourite.id};
    made.members.push_back(std::move(sibling));
  }
  if (species.siblings.size() < wanted.count) made.notes.push_back(summary(species, wanted));
  return made;
}

/// The founders, relatives of each on two of three of the other places, and on the rest what the grammar grows else.
MadeGeneration first_screen(const BreedProblem& problem, const BreedSettings& settings, MemberId first_id,
                            const std::vector<Member>& parents) {
  std::vector<Derivation> founders;
  for (const Member& parent : parents) founders.push_back(parent.derivation);
  const std::size_t own = std::min<std::size_t>(founders.size(), settings.population);
  std::vector<std::size_t> kin_of;  // of each relative, the founder
  const std::size_t kin = own == 0 ? 0 : (settings.population - own) * 2 / 3;
  for (std::size_t f = 0; f < own && kin > 0; ++f) {
    SpeciesSettings wanted;
    wanted.count = static_cast<std::uint32_t>(kin / own + (f < kin % own));
    wanted.strength = settings.strength;
    if (wanted.count == 0) break;
    BreedProblem of_founder = problem;
    of_founder.draw = static_cast<std::uint32_t>(f);
    for (Derivation& sibling : find_species(of_founder, parents[f].derivation, wanted).siblings) {
      founders.push_back(std::move(sibling));
      kin_of.push_back(f);
    }
  }
  FirstGeneration first = first_generation(problem, settings, founders, first_id);
  for (std::size_t i = 0; i < kin_of.size(); ++i) {
    Member& relative = first.members[parents.size() + i];
    relative.origin = Origin::sibling;
    relative.parents = {first.members[kin_of[i]].id};
  }
  MadeGeneration made;
  made.members = std::move(first.members);
  if (!first.note.empty()) made.notes.push_back(std::move(first.note));
  return made;
}

}  // namespace

std::string to_json(const BreedingRecipe& recipe) {
  Json json = {{"kind", kKinds[static_cast<std::size_t>(recipe.kind)]}, {"settings", settings_text(recipe.settings)},
               {"seed", recipe.seed}, {"number", recipe.number}, {"first_id", recipe.first_id},
               {"locked", locked_text(recipe.locked)}, {"parents", Json::array()}};
  for (const RecipeParent& parent : recipe.parents) {
    Json item = {{"id", parent.id}, {"derivation", parent.derivation}};
    if (parent.rating) item["rating"] = *parent.rating;
    json["parents"].push_back(std::move(item));
  }
  if (!recipe.worst_before.empty()) json["worst_before"] = recipe.worst_before;
  for (const RecipeOpinion& one : recipe.opinions) json["opinions"].push_back({one.derivation, one.rating});
  for (const RecipeComparison& one : recipe.comparisons) json["comparisons"].push_back({one.better, one.worse});
  return json.dump();
}

BreedingRecipe parse_recipe(std::string_view text) {
  try {
    const Json json = Json::parse(text);
    BreedingRecipe recipe;
    const auto kind = std::find(kKinds.begin(), kKinds.end(), json.at("kind").get<std::string>());
    if (kind == kKinds.end()) throw Error("it is of no kind that is known");
    recipe.kind = static_cast<RecipeKind>(kind - kKinds.begin());
    recipe.settings = read_settings(json.at("settings").get<std::string>());
    recipe.seed = json.at("seed").get<std::uint64_t>();
    recipe.number = json.at("number").get<std::uint32_t>();
    recipe.first_id = json.at("first_id").get<std::int64_t>();
    if (recipe.number < 1 || recipe.number > BreedingStore::kMostGenerations)
      throw Error(fmt::format("its number must be 1 .. {}, got {}", BreedingStore::kMostGenerations, recipe.number));
    if (recipe.first_id < 1 || recipe.first_id > BreedingStore::kMostIndividuals)
      throw Error(fmt::format("its first individual must be 1 .. {}, got {}", BreedingStore::kMostIndividuals, recipe.first_id));
    recipe.locked = read_locked(json.at("locked").get<std::string>());
    if (json.at("parents").size() > kMostParents) throw Error(fmt::format("it has more than {} parents", kMostParents));
    for (const Json& item : json.at("parents")) {
      RecipeParent parent{item.at("id").get<std::int64_t>(), item.at("derivation").get<std::string>(), {}};
      if (item.contains("rating")) parent.rating = rating_in(item.at("rating"));
      recipe.parents.push_back(std::move(parent));
    }
    if (recipe.parents.empty() && recipe.kind != RecipeKind::first) throw Error("it has no parents");
    const Json before = json.value("worst_before", Json::array());
    if (before.size() > BreedingStore::kMostGenerations) throw Error("it remembers more generations than there are");
    for (const Json& one : before) recipe.worst_before.push_back(rating_in(one));
    for (const char* list : {"opinions", "comparisons"}) {
      if (json.contains(list) && json.at(list).size() > kMostOpinions)
        throw Error(fmt::format("it has more than {} {}", kMostOpinions, list));
    }
    for (const Json& one : json.value("opinions", Json::array())) recipe.opinions.push_back({one.at(0), rating_in(one.at(1))});
    for (const Json& one : json.value("comparisons", Json::array()))
      recipe.comparisons.push_back({one.at(0), one.at(1)});
    return recipe;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("the recipe of a generation is damaged: {}", error.what()));
  } catch (const Error& error) {
    throw Error(fmt::format("the recipe of a generation is damaged: {}", error.what()));
  }
}

std::vector<std::string> texts_of(const BreedingRecipe& recipe) {
  std::vector<std::string> texts;
  for (const RecipeParent& parent : recipe.parents) texts.push_back(parent.derivation);
  for (const RecipeOpinion& one : recipe.opinions) texts.push_back(one.derivation);
  for (const RecipeComparison& one : recipe.comparisons) texts.push_back(one.better), texts.push_back(one.worse);
  return texts;
}

bool uses_taste(const BreedingRecipe& recipe) {
  return recipe.settings.taste.value() && may_rate(recipe.settings) &&
         !(recipe.opinions.empty() && recipe.comparisons.empty());
}

std::optional<Taste> learn_taste(BreedingBench& bench, const BreedingRecipe& recipe, const ReadText& read_text) {
  const auto features_of = [&](const std::string& hash) -> std::optional<std::vector<double>> {
    try {
      return bench.features(hash, read_text);
    } catch (const Error&) {  // of another text of the grammar
      return std::nullopt;
    }
  };
  std::vector<Opinion> opinions;
  for (const RecipeOpinion& one : recipe.opinions) {
    if (auto features = features_of(one.derivation)) opinions.push_back({std::move(*features), one.rating});
  }
  std::vector<Comparison> comparisons;
  for (const RecipeComparison& one : recipe.comparisons) {
    auto better = features_of(one.better), worse = features_of(one.worse);
    if (better && worse) comparisons.push_back({std::move(*better), std::move(*worse)});
  }
  if (opinions.empty() && comparisons.empty()) return std::nullopt;
  return Taste(opinions, comparisons, {});
}

MadeGeneration make_generation(BreedingBench& bench, const BreedingRecipe& recipe, const ReadText& read_text) {
  std::size_t lost = 0;
  std::string why;
  const std::vector<Member> parents = members_of(bench, recipe, read_text, lost, why);
  const BreedProblem problem = bench.problem(recipe.settings, recipe.seed, recipe.locked);
  BreedSettings settings = breed_settings(recipe.settings);
  settings.genesis.bits = bench.genesis_bits();
  const auto first_id = static_cast<MemberId>(recipe.first_id);
  MadeGeneration made;
  if (lost > 0) made.notes.push_back(fmt::format("{} of {} parents: {}", lost, recipe.parents.size(), why));
  if (parents.empty() && !recipe.parents.empty()) throw Error(why);
  if (recipe.kind == RecipeKind::first) {
    MadeGeneration first = first_screen(problem, settings, first_id, parents);
    made.members = std::move(first.members);
    made.notes.insert(made.notes.end(), first.notes.begin(), first.notes.end());
  } else if (recipe.kind == RecipeKind::like) {
    MadeGeneration kin = relatives(problem, recipe, settings, parents.at(0));
    made.members = std::move(kin.members);
    made.notes.insert(made.notes.end(), kin.notes.begin(), kin.notes.end());
  } else if (std::optional<Taste> taste; uses_taste(recipe) && settings.method == BreedMethod::free &&
                                         recipe.kind == RecipeKind::bred &&
                                         (taste = learn_taste(bench, recipe, read_text))) {
    const Screen screen = next_screen(problem, settings, {}, parents, *taste, recipe.number, first_id);
    made.members = screen.generation.members;
    for (const ShownAs shown : screen.shown_as) made.roles.emplace_back(shown == ShownAs::kept ? "" : name_of(shown));
    made.notes.push_back(fmt::format("chosen from {} candidates, {} of them refused", screen.generation.tried,
                                     screen.generation.refused));
    if (!screen.generation.note.empty()) made.notes.push_back(screen.generation.note);
  } else {
    NextGeneration next = next_generation(problem, settings, parents, recipe.number, first_id, recipe.worst_before);
    made.members = std::move(next.members);
    if (next.refused > 0) made.notes.push_back(fmt::format("{} of {} children were refused", next.refused, next.tried));
    if (!next.note.empty()) made.notes.push_back(std::move(next.note));
  }
  if (made.members.empty()) throw Error("nothing viable grows from this grammar within these limits");
  return made;
}

}  // namespace espalier::studio
