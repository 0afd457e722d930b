#include "studio/breeding_file.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/error.h"
#include "base/hash.h"
#include "breed/member.h"
#include "studio/breeding_recipe.h"
#include "studio/breeding_settings.h"
#include "studio/shipped.h"
#include "studio/web_guard.h"

namespace espalier::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostText = 16u << 20, kMostGrammarBytes = 1'000'000;
constexpr std::size_t kMostKnownFiles = 2 * Store::kMostFiles;
constexpr int kMostDepth = 80;

[[noreturn]] void fail(const std::string& what) { throw Error("the breeding file is damaged: " + what); }

void require(bool holds, const std::string& what) {
  if (!holds) fail(what);
}

std::string text_in(const Json& json, const char* key, std::size_t most = kMostText) {
  std::string text = json.at(key).get<std::string>();
  require(text.size() <= most, fmt::format("{} has more than {} bytes", key, most));
  return text;
}

const Json& list_in(const Json& json, const char* key, std::int64_t most) {
  const Json& list = json.at(key);
  require(list.is_array(), fmt::format("{} is no list", key));
  require(static_cast<std::int64_t>(list.size()) <= most, fmt::format("{} has more than {} items", key, most));
  return list;
}

Json state_json(const StoredState& state) {
  Json json = {{"grammar", state.grammar}, {"scene", state.scene}, {"files", Json::array()}};
  for (const StoredFile& file : state.files) json["files"].push_back({{"path", file.path}, {"hash", file.hash}});
  return json;
}

/// What is known of files by path and hash: to look into one takes a while.
using KnownFiles = std::map<std::pair<std::string, std::string>, StoredFile>;

StoredState read_state(const Json& json, const std::map<std::string, std::string>& bytes, KnownFiles& known) {
  StoredState state;
  state.grammar = text_in(json, "grammar", kMostGrammarBytes);
  state.scene = text_in(json, "scene", kMostGrammarBytes);
  require(Json::accept(state.scene), "a scene is no JSON");
  for (const Json& item : list_in(json, "files", static_cast<std::int64_t>(Store::kMostFiles))) {
    const std::string path = text_in(item, "path", 200);
    require(is_plain_path(path), fmt::format("a file \"{}\" leads elsewhere", path));
    const std::string hash = text_in(item, "hash", 64);
    const auto content = bytes.find(hash);
    require(content != bytes.end(), fmt::format("the bytes of {} are not there", path));
    auto at = known.find({path, hash});
    if (at == known.end()) {
      require(known.size() < kMostKnownFiles, fmt::format("it has more than {} files", kMostKnownFiles));
      at = known.emplace(std::pair(path, hash), describe_file(path, content->second)).first;
    }
    state.files.push_back(at->second);
  }
  return state;
}

StoredGeneration read_generation(const Json& json, const std::vector<StoredState>& states, std::int64_t number) {
  StoredGeneration one;
  one.number = json.at("number").get<std::int64_t>();
  one.parent = json.at("parent").get<std::int64_t>();
  require(one.number == number && one.parent >= 0 && one.parent < number, fmt::format("generation {}", number));
  one.label = text_in(json, "label", 200);
  one.state = states.at(json.at("state").get<std::size_t>());
  one.recipe = text_in(json, "recipe");
  const BreedingRecipe recipe = parse_recipe(one.recipe);
  require(recipe.number == number, fmt::format("the recipe of generation {} is of generation {}", number, recipe.number));
  require(one.parent > 0 || recipe.kind == RecipeKind::first, fmt::format("generation {} comes from nowhere", number));
  one.seconds = json.at("seconds").get<double>();
  if (json.contains("diversity")) one.diversity = json.at("diversity").get<double>();
  return one;
}

BredRow read_individual(const Json& json, const WholeBreeding& whole) {
  BredRow row;
  row.id = json.at("id").get<std::int64_t>();
  const std::int64_t before = whole.individuals.empty() ? 0 : whole.individuals.back().id;
  const std::string name = fmt::format("individual {}", row.id);
  require(row.id > before, name);
  row.generation = json.at("generation").get<std::int64_t>();
  require(row.generation >= 1 && row.generation <= static_cast<std::int64_t>(whole.generations.size()), name);
  row.place = json.at("place").get<std::int64_t>();
  row.origin = name_of(origin_named(text_in(json, "origin", 20)));
  for (const Json& parent : list_in(json, "parents", Member::kMostParents)) {
    row.parents.push_back(parent.get<std::int64_t>());
    require(std::ranges::binary_search(whole.individuals, row.parents.back(), {}, &BredRow::id),
            name + " has an unknown parent");
  }
  row.born = text_in(json, "born", 64);
  row.derivation = text_in(json, "derivation", 64);
  require(whole.derivations.count(row.born) != 0 && whole.derivations.count(row.derivation) != 0,
          name + " has no derivation");
  row.edited = json.at("edited").get<bool>();
  row.present = json.at("present").get<bool>();
  if (json.contains("rating")) {
    row.rating = json.at("rating").get<double>();
    require(std::abs(*row.rating) <= kMostRating, fmt::format("{}'s rating must be {} .. {}", name, -kMostRating, kMostRating));
  }
  if (json.contains("role")) row.role = text_in(json, "role", 20);
  return row;
}

void require_parents(const WholeBreeding& whole) {
  for (const StoredGeneration& generation : whole.generations) {
    for (const std::string& named : texts_of(parse_recipe(generation.recipe))) {
      require(whole.derivations.count(named) != 0,
              fmt::format("generation {} was made from a derivation that is not there", generation.number));
    }
  }
}

}  // namespace

Json breeding_json(const WholeBreeding& whole) {
  const BreedingHead& head = whole.head;
  Json json = {{"espalier_breeding", kBreedingFileVersion}, {"name", head.summary.name}, {"seed", head.seed},
               {"settings", head.settings}, {"locked", head.locked}, {"generation", head.generation}};
  json["files"] = Json::object();
  for (const char* list : {"states", "generations", "individuals", "comparisons"}) json[list] = Json::array();
  for (const auto& [hash, bytes] : whole.files) json["files"][hash] = encode_base64(bytes);
  std::vector<const StoredState*> states;
  for (const StoredGeneration& one : whole.generations) {
    std::size_t state = 0;
    while (state < states.size() && !(*states[state] == one.state)) ++state;
    if (state == states.size()) {
      states.push_back(&one.state);
      json["states"].push_back(state_json(one.state));
    }
    json["generations"].push_back({{"number", one.number},
                                   {"parent", one.parent},
                                   {"label", one.label},
                                   {"state", state},
                                   {"recipe", one.recipe},
                                   {"seconds", one.seconds}});
    if (one.diversity) json["generations"].back()["diversity"] = *one.diversity;
  }
  for (const BredRow& row : whole.individuals) {
    Json item = {{"id", row.id}, {"generation", row.generation}, {"place", row.place}, {"origin", row.origin},
                 {"parents", row.parents}, {"born", row.born}, {"derivation", row.derivation}, {"edited", row.edited},
                 {"present", row.present}};
    if (row.rating) item["rating"] = *row.rating;
    if (row.role) item["role"] = *row.role;
    json["individuals"].push_back(std::move(item));
  }
  for (const BreedingComparison& one : whole.comparisons) {
    json["comparisons"].push_back({{"better", one.better}, {"worse", one.worse}});
  }
  json["derivations"] = whole.derivations;
  return json;
}

WholeBreeding parse_breeding(const Json& json) {
  try {
    if (!json.is_object() || !json.contains("espalier_breeding")) throw Error("this is no file of a breeding session");
    if (json["espalier_breeding"] != kBreedingFileVersion) {
      throw Error(fmt::format("the breeding file must be of version {}, got {}", kBreedingFileVersion,
                              json["espalier_breeding"].dump().substr(0, 40)));
    }
    WholeBreeding whole;
    whole.head.summary.name = text_in(json, "name", 200);
    require(whole.head.summary.name.find_first_not_of(' ') != std::string::npos, "it has no name");
    whole.head.seed = json.at("seed").get<std::int64_t>();
    const api::RoomSettings settings = read_settings(text_in(json, "settings"));
    whole.head.settings = settings_text(settings);
    whole.head.summary.method = name_of(breed_settings(settings).method);
    whole.head.locked = locked_text(read_locked(text_in(json, "locked")));
    for (const auto& [hash, text] : json.at("files").items()) {
      std::string bytes = decode_base64(text.get_ref<const std::string&>());
      require(content_hash(bytes) == hash, fmt::format("file {}", hash.substr(0, 64)));
      whole.files.emplace(hash, std::move(bytes));
    }
    std::vector<StoredState> states;
    KnownFiles known;
    for (const Json& item : list_in(json, "states", BreedingStore::kMostGenerations))
      states.push_back(read_state(item, whole.files, known));
    for (const auto& [hash, text] : json.at("derivations").items()) {
      require(content_hash(text.get_ref<const std::string&>()) == hash,
              fmt::format("derivation {}", hash.substr(0, 64)));
      whole.derivations.emplace(hash, text.get<std::string>());
    }
    for (const Json& item : list_in(json, "generations", BreedingStore::kMostGenerations)) {
      whole.generations.push_back(
          read_generation(item, states, static_cast<std::int64_t>(whole.generations.size() + 1)));
    }
    whole.head.generation = json.at("generation").get<std::int64_t>();
    require(whole.head.generation >= 1 && whole.head.generation <= static_cast<std::int64_t>(whole.generations.size()),
            "the generation that is shown");
    for (const Json& item : list_in(json, "individuals", BreedingStore::kMostIndividuals)) {
      whole.individuals.push_back(read_individual(item, whole));
    }
    for (const Json& item : list_in(json, "comparisons", BreedingStore::kMostIndividuals)) {
      const auto number = static_cast<std::int64_t>(whole.comparisons.size() + 1);
      whole.comparisons.push_back(
          {number, item.at("better").get<std::int64_t>(), item.at("worse").get<std::int64_t>()});
      for (const std::int64_t id : {whole.comparisons.back().better, whole.comparisons.back().worse}) {
        require(std::ranges::binary_search(whole.individuals, id, {}, &BredRow::id),
                fmt::format("comparison {} is of an unknown individual", number));
      }
    }
    require_parents(whole);
    return whole;
  } catch (const Json::exception& error) {
    fail(error.what());
  } catch (const std::out_of_range&) {
    fail("a generation names a state that is not there");
  }
}

std::string breeding_file(const WholeBreeding& whole) {
  std::string text = breeding_json(whole).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  if (text.size() > kMostBreedingFileBytes)
    throw Error(fmt::format("a breeding file has at most {} bytes", kMostBreedingFileBytes));
  return text;
}

WholeBreeding parse_breeding_file(std::string_view text) {
  if (text.size() > kMostBreedingFileBytes)
    throw Error(fmt::format("a breeding file has at most {} bytes", kMostBreedingFileBytes));
  const auto bounded = [](int depth, Json::parse_event_t, Json&) {
    if (depth > kMostDepth) throw Error("the breeding file is nested too deep");
    return true;
  };
  return parse_breeding(Json::parse(text, bounded, false));
}

}  // namespace espalier::studio
