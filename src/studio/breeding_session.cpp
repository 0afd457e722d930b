#include "studio/breeding_session.h"

#include <algorithm>
#include <random>

#include <fmt/format.h>

#include "base/error.h"
#include "base/hash.h"
#include "derivation/encode.h"
#include "breed/variation.h"
#include "search/genesis_encoding.h"
#include "studio/breeding_settings.h"
#include "studio/individual_genes.h"

namespace espalier::studio {
namespace {

constexpr double kLongestLook = 120;      // seconds; longer is a pause
constexpr std::size_t kMostModels = 100;  // kept for coming back to

std::string text_of(double number) { return fmt::format("{}", number); }

/// The members as rows, their derivations among the step's texts.
void add_members(const GeneratorGraph& graph, const std::vector<Member>& members, std::int64_t generation,
                 BreedingStep& step) {
  for (const Member& member : members) {
    std::string text = encode(graph, member.derivation);
    BredRow row;
    row.id = static_cast<std::int64_t>(member.id);
    row.generation = generation;
    row.place = static_cast<std::int64_t>(step.individuals.size());
    row.origin = name_of(member.origin);
    for (const MemberId parent : member.parents) {
      if (parent != 0) row.parents.push_back(static_cast<std::int64_t>(parent));
    }
    row.born = row.derivation = content_hash(text);
    if (member.rated) row.rating = member.rating;
    step.texts.emplace(row.born, std::move(text));
    step.individuals.push_back(std::move(row));
  }
}

std::uint64_t any_seed() {
  std::random_device device;
  return device();
}

std::string name_for(const api::StartBreeding& start, std::size_t sessions) {
  if (start.name && start.name->find_first_not_of(' ') != std::string::npos) return *start.name;
  return fmt::format("Session {}", sessions + 1);
}

}  // namespace

std::int64_t BreedingSession::begin(BreedingStore& store, BreedingBench& bench, std::int64_t project,
                                    const api::StartBreeding& start, const std::vector<std::string>& founders) {
  BreedingRecipe recipe;
  recipe.settings = complete(start.settings);
  if (recipe.settings.method == api::RoomSettingsMethod::classic) {
    const std::string why = why_not_start_draws(bench.graph());
    if (!why.empty()) throw Error("the classic method breeds only genomes that are draws of the start rule: " + why);
  }
  recipe.seed = start.seed ? static_cast<std::uint64_t>(*start.seed) : any_seed();
  recipe.number = 1;
  std::map<std::string, std::string> texts;
  for (const std::string& founder : founders) {
    recipe.parents.push_back({0, content_hash(founder), {}});
    texts.emplace(recipe.parents.back().derivation, founder);
  }
  const MadeGeneration made = make_generation(bench, recipe, [&](const std::string& hash) { return texts.at(hash); });
  BreedingHead head;
  head.summary.name = name_for(start, store.list(project).size());
  head.summary.method = name_of(breed_settings(recipe.settings).method);
  head.seed = static_cast<std::int64_t>(recipe.seed);
  head.settings = settings_text(recipe.settings);
  head.locked = locked_text({});
  BreedingStep step;
  step.texts = std::move(texts);
  step.generation = StoredGeneration{1, 0, "First generation", bench.state(), to_json(recipe)};
  add_members(bench.graph(), made.members, 1, step);
  return store.create(project, head, step);
}

BreedingSession::BreedingSession(BreedingStore& store, BreedingBench& bench, std::int64_t project, std::int64_t session)
    : store_(store), bench_(bench), project_(project), session_(session) {
  reload();
}

void BreedingSession::reload() {
  head_ = store_.open(project_, session_);
  settings_ = read_settings(head_.settings);
  locked_ = read_locked(head_.locked);
  std::vector<RoomIndividual> before;
  before.swap(individuals_);
  bool other = false;
  for (BredRow& row : store_.individuals(session_, head_.generation)) {
    const auto same =
        std::find_if(before.begin(), before.end(), [&](const RoomIndividual& one) { return one.row.id == row.id; });
    if (same != before.end() && same->row.derivation == row.derivation) {
      individuals_.push_back(std::move(*same));
      individuals_.back().row = std::move(row);
      continue;
    }
    individuals_.push_back(find(row.id));
    individuals_.back().version = ++versions_;
    other = true;
  }
  for (const RoomIndividual& one : individuals_) {
    if (!one.derivation || one.model) continue;
    if (const BredModelPtr seen = bench_.seen(*one.derivation)) keep_model(one.row.derivation, seen);
  }
  bench_.forget_seen();
  if (other || before.size() != individuals_.size()) expect_again();
}

void BreedingSession::refresh() {
  individuals_.clear();
  models_.clear();
  reload();
}

RoomIndividual BreedingSession::find(std::int64_t id) const {
  RoomIndividual one;
  one.row = store_.individual(session_, id);
  try {
    one.derivation = bench_.read(store_.text(session_, one.row.derivation));
  } catch (const Error& error) {
    one.missing = error.what();
  }
  const auto known = models_.find(one.row.derivation);
  if (known != models_.end() && one.derivation) one.model = known->second;
  return one;
}

void BreedingSession::keep_model(const std::string& derivation, const BredModelPtr& model) {
  for (RoomIndividual& one : individuals_) {
    if (one.row.derivation == derivation) one.model = model;
  }
  if (models_.size() >= kMostModels) {
    std::erase_if(models_, [&](const auto& kept) {
      return std::none_of(individuals_.begin(), individuals_.end(),
                          [&](const RoomIndividual& one) { return one.row.derivation == kept.first; });
    });
  }
  models_[derivation] = model;
}

RoomIndividual& BreedingSession::shown(std::int64_t id) {
  for (RoomIndividual& one : individuals_) {
    if (one.row.id == id) return one;
  }
  throw Error(fmt::format("individual {} is not one of the generation that is shown", id));
}

double BreedingSession::looked_at() {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - since_).count();
  since_ = now;
  return seconds <= kLongestLook ? seconds : 0;
}

void BreedingSession::commit(BreedingStep step) {
  step.seconds = looked_at();
  store_.take(session_, step);
  reload();
}

void BreedingSession::set(const api::SetBreeding& change) {
  const api::RoomSettings next = changed(settings_, change.settings);
  if (next == settings_) return;
  if (next.taste != settings_.taste) expect_again();
  commit({.label = "Settings", .gesture = change.gesture.value_or(""),
          .changes = {{BreedingField::settings, 0, head_.settings, settings_text(next)}}});
}

BreedingChange BreedingSession::rating_change(std::int64_t individual, std::optional<double> rating) {
  BreedingChange change{BreedingField::rating, individual, {}, {}};
  const RoomIndividual& one = shown(individual);
  if (one.row.rating) change.before = text_of(*one.row.rating);
  if (rating) change.after = text_of(*rating);
  return change;
}

void BreedingSession::rate(const api::Rate& rate) {
  if (!may_rate(settings_)) throw Error("this session is bred without ratings: its mode is set so");
  if (rate.ratings.size() > kMostRatings) throw Error(fmt::format("at most {} ratings to a request", kMostRatings));
  BreedingStep step{.label = rate.label.value_or(rate.ratings.size() == 1 ? "Rate" : "Rate some"),
                    .gesture = rate.gesture.value_or("")};
  std::map<std::int64_t, std::optional<double>> last;  // of one that is named twice
  for (const api::Rating& one : rate.ratings) last[one.individual] = one.rating;
  for (const auto& [individual, rating] : last) {
    BreedingChange change = rating_change(individual, rating);
    if (change.before != change.after) step.changes.push_back(std::move(change));
  }
  if (!step.changes.empty()) commit(std::move(step));
}

void BreedingSession::compare(const api::Compare& compare) {
  if (!may_rate(settings_)) throw Error("this session is bred without ratings: its mode is set so");
  if (compare.better == compare.worse) throw Error("an individual cannot be better than itself");
  const std::int64_t number = head_.last_comparison + 1;
  const double better = shown(compare.better).row.rating.value_or(0),
               worse = shown(compare.worse).row.rating.value_or(0);
  commit({.label = "Compare",
          .changes = {{BreedingField::compared, number, "0", "1"}, rating_change(compare.better, better + 1),
                      rating_change(compare.worse, worse - 1)},
          .comparisons = {{number, compare.better, compare.worse}}});
}

void BreedingSession::set_genes(const api::SetGenes& set) {
  if (!may_edit(settings_)) throw Error("this session is bred without edits: its mode is set so");
  if (set.draws.size() > kMostDraws) throw Error(fmt::format("at most {} draws to a request", kMostDraws));
  const RoomIndividual& one = shown(set.individual);
  if (!one.derivation) throw Error(one.missing);
  Derivation changed = *one.derivation;
  for (const api::DrawSetting& draw : set.draws) set_draw(bench_.graph(), changed, draw);
  std::string text = encode(bench_.graph(), changed);
  const std::string hash = content_hash(text);
  if (hash == one.row.derivation) return;
  BreedingStep step{.label = set.label.value_or("Edit"), .gesture = set.gesture.value_or("")};
  step.changes.push_back({BreedingField::derivation, set.individual, one.row.derivation, hash});
  if (!one.row.edited) step.changes.push_back({BreedingField::edited, set.individual, "0", "1"});
  step.texts.emplace(hash, std::move(text));
  commit(std::move(step));
}

void BreedingSession::lock(const api::LockDraws& lock) {
  if (lock.draws.size() > kMostLocked) throw Error(fmt::format("at most {} draws to a request", kMostLocked));
  std::vector<api::DrawPlace> next = locked_;
  for (const api::DrawPlace& place : lock.draws) {
    if (lock.locked) require_place(bench_.graph(), place);
    std::erase(next, place);
    if (lock.locked) next.push_back(place);
  }
  if (next.size() > kMostLocked) throw Error(fmt::format("at most {} draws are locked", kMostLocked));
  if (next == locked_) return;
  commit({.label = lock.locked ? "Lock" : "Unlock",
          .changes = {{BreedingField::locked, 0, head_.locked, locked_text(next)}}});
}

/// The least ratings of the generations that the present one comes from, the nearest first, as far as the scaling window
/// reaches. Who was not rated is neutral.
std::vector<double> BreedingSession::worst_before() const {
  const std::size_t reach = breed_settings(settings_).genesis.window;
  std::map<std::int64_t, std::int64_t> parents;
  for (const GenerationSummary& one : store_.generations(session_)) parents[one.number] = one.parent;
  std::vector<double> worst;
  for (std::int64_t at = parents[head_.generation]; at > 0 && worst.size() < reach; at = parents[at]) {
    double least = kMostRating;
    for (const BredRow& row : store_.individuals(session_, at)) least = std::min(least, row.rating.value_or(0));
    worst.push_back(least);
  }
  return worst;
}

void BreedingSession::make(RecipeKind kind, const std::vector<const RoomIndividual*>& parents,
                           const std::string& label) {
  BreedingRecipe recipe{.kind = kind, .settings = settings_, .seed = static_cast<std::uint64_t>(head_.seed)};
  recipe.number = static_cast<std::uint32_t>(head_.summary.generations + 1);
  recipe.first_id = head_.last_individual + 1;
  recipe.locked = locked_;
  if (settings_.taste.value()) add_opinions(recipe);
  if (kind == RecipeKind::bred && settings_.method == api::RoomSettingsMethod::classic) recipe.worst_before = worst_before();
  for (const RoomIndividual* parent : parents)
    recipe.parents.push_back({parent->row.id, parent->row.derivation, parent->row.rating});
  if (recipe.number > BreedingStore::kMostGenerations) {
    throw Error(fmt::format("a session has at most {} generations: begin another one from your favourites",
                            BreedingStore::kMostGenerations));
  }
  // What is made is made of what will be kept.
  const std::string kept = to_json(recipe);
  const MadeGeneration made =
      make_generation(bench_, parse_recipe(kept), [&](const std::string& hash) { return store_.text(session_, hash); });
  BreedingStep step{.label = label,
                    .changes = {{BreedingField::generation, 0, fmt::format("{}", head_.generation),
                                 fmt::format("{}", recipe.number)}}};
  step.generation = StoredGeneration{recipe.number, head_.generation, label, bench_.state(), kept};
  add_members(bench_.graph(), made.members, recipe.number, step);
  for (std::size_t i = 0; i < made.roles.size(); ++i) {
    if (!made.roles[i].empty()) step.individuals[i].role = made.roles[i];
  }
  commit(std::move(step));
  notes_ = made.notes;
  notes_of_ = head_.generation;
}

void BreedingSession::breed() {
  std::vector<const RoomIndividual*> parents;
  for (const RoomIndividual& one : individuals_) parents.push_back(&one);
  make(RecipeKind::bred, parents, "Bred");
}

void BreedingSession::more_like(std::int64_t individual) {
  make(RecipeKind::like, {&shown(individual)}, fmt::format("More like {}", individual));
}

Derivation BreedingSession::blended(const api::Blend& asked) const {
  if (asked.parents.size() < 2 || asked.parents.size() > 3) throw Error("two or three are blended");
  if (asked.weights.size() != asked.parents.size()) throw Error("a blend needs a weight for each parent");
  double sum = 0;
  for (const double weight : asked.weights) {
    if (!(weight >= 0 && weight <= 1e6)) throw Error("the weights of a blend must be 0 .. 1000000");
    sum += weight;
  }
  if (!(sum > 0)) throw Error("the weights of a blend must not all be 0");
  std::vector<Derivation> parents;
  for (const std::int64_t id : asked.parents) {
    RoomIndividual one = find(id);
    if (!one.derivation) throw Error(one.missing);
    parents.push_back(std::move(*one.derivation));
  }
  std::vector<const Derivation*> pointers;
  for (const Derivation& parent : parents) pointers.push_back(&parent);
  return blend(bench_.graph(), pointers, asked.weights, bench_.held(locked_));
}

void BreedingSession::keep_blend(const api::Blend& asked) {
  if (!may_edit(settings_)) throw Error("this session is bred without edits: its mode is set so");
  if (individuals_.size() >= kMostShown)
    throw Error(fmt::format("a generation has at most {} individuals", kMostShown));
  Member child;
  child.id = static_cast<MemberId>(head_.last_individual + 1);
  child.derivation = blended(asked);
  child.origin = Origin::blended;
  for (const std::int64_t parent : asked.parents) child.parents.push_back(static_cast<MemberId>(parent));
  BreedingStep step{.label = "Blend", .changes = {{BreedingField::present, head_.last_individual + 1, "0", "1"}}};
  add_members(bench_.graph(), {child}, head_.generation, step);
  step.individuals[0].place = individuals_.empty() ? 0 : individuals_.back().row.place + 1;
  commit(std::move(step));
}

void BreedingSession::go_to(std::int64_t generation) {
  if (generation == head_.generation) return;
  store_.generation(session_, generation);
  commit({.label = fmt::format("Go to generation {}", generation),
          .changes = {
              {BreedingField::generation, 0, fmt::format("{}", head_.generation), fmt::format("{}", generation)}}});
}

void BreedingSession::undo() {
  if (!store_.undo(session_)) throw Error("there is nothing to undo");
  looked_at();
  reload();
}

void BreedingSession::redo() {
  if (!store_.redo(session_)) throw Error("there is nothing to do again");
  looked_at();
  reload();
}

}  // namespace espalier::studio
