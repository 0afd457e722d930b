#include "studio/breeding_bench.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "breed/newcomer.h"
#include "breed/usual_viability.h"
#include "derivation/adapt.h"
#include "derivation/encode.h"
#include "studio/breeding_settings.h"

namespace espalier::studio {

namespace {

constexpr std::size_t kMostFeatures = 4000;   // kept
constexpr std::uint32_t kRandomModels = 24;  // that diversity is measured by
constexpr std::size_t kMostSeenBytes = 256 << 20;  // of models kept of those judged

}  // namespace

BreedingBench::BreedingBench(ReadBlob read_blob, Executor& executor)
    : executor_(executor), bench_(std::move(read_blob)) {}
BreedingBench::~BreedingBench() = default;

void BreedingBench::take(const StoredState& state) {
  if (ready() && state == state_) return;
  bench_.take(state);
  std::shared_ptr<const Setup> setup = bench_.set_up({});
  appraiser_.reset();
  looker_.reset();
  scorer_.reset();
  setup_ = std::move(setup);
  has_targets_ = bench_.scene().has_targets;
  genesis_bits_ = bench_.scene().scene.search.genesis.bits;
  state_ = state;
  usual_is_exact_ = false;
  features_.clear();
  random_.clear();
  forget_seen();
}

void BreedingBench::forget_seen() {
  seen_.clear();
  seen_bytes_ = 0;
}

void BreedingBench::watch(const Sighting& one) {
  auto model = std::make_shared<const BredModel>(
      bred_model(graph(), one.derivation, one.model, one.report, one.features));
  const std::lock_guard lock(seen_mutex_);
  if (seen_bytes_ + model->bytes.size() > kMostSeenBytes) return;
  seen_bytes_ += model->bytes.size();
  seen_.emplace(hash(one.derivation), Seen{one.derivation, std::move(model)});
}

BredModelPtr BreedingBench::seen(const Derivation& derivation) const {
  const auto [first, last] = seen_.equal_range(hash(derivation));
  const auto same = std::find_if(first, last, [&](const auto& one) { return one.second.derivation == derivation; });
  return same == last ? nullptr : same->second.model;
}

const std::vector<double>& BreedingBench::features(const std::string& hash,
                                                   const std::function<std::string(const std::string&)>& read_text) {
  const auto known = features_.find(hash);
  if (known != features_.end()) return known->second;
  const Derivation derivation = read(read_text(hash));
  const Derivation* const one = &derivation;
  std::vector<Appraisal> looked = looker().appraise({&one, 1});
  if (features_.size() >= kMostFeatures) features_.clear();
  return features_[hash] = std::move(looked[0].features);
}

bool BreedingBench::draw_random_features() {
  if (random_.size() >= kRandomModels) return true;
  RandomStream random({0, Purpose::sample, 0, static_cast<std::uint32_t>(random_.size()), 0});
  const Derivation drawn = draw_newcomer(graph(), random);
  const Derivation* const one = &drawn;
  random_.push_back(std::move(looker().appraise({&one, 1})[0].features));
  return random_.size() >= kRandomModels;
}

ModelAppraiser& BreedingBench::looker() {
  if (!looker_) {
    looker_ = std::make_unique<ModelAppraiser>(setup_->grammar.graph, setup_->meshes, ModelAppraiser::Settings{},
                                               nullptr, executor_);
  }
  return *looker_;
}

ViabilitySettings BreedingBench::viability(const api::RoomSettings& settings) {
  if (!usual_ || usual_of_ != state_.grammar) {
    usual_ = usual_viability(graph(), setup_->meshes);
    usual_of_ = state_.grammar;
    usual_is_exact_ = true;
  }
  ViabilitySettings judged = viability_settings(settings);
  judged.most_below_ground = usual_->most_below_ground;
  judged.most_crowding = usual_->most_crowding;
  return judged;
}

Derivation BreedingBench::read(const std::string& encoded) const {
  std::string why = "it cannot stand in the grammar as it is now";
  try {
    if (auto fitting = adapt(graph(), decode(graph(), encoded, kMostGenes, Fit::adaptable)))
      return std::move(fitting->derivation);
  } catch (const Error& error) {
    why = error.what();
  }
  throw Error("it belongs to another text of the grammar: " + why);
}

Held BreedingBench::held(const std::vector<api::DrawPlace>& locked) const {
  Held held;
  for (const api::DrawPlace& place : locked) {
    Held one;
    try {
      one.draws.push_back({parse_gene_path(graph(), place.path),
                           static_cast<std::uint16_t>(std::clamp<std::int64_t>(place.index, 0, 0xffff))});
      validate(graph(), one);
    } catch (const Error&) {  // of another text of the grammar
      continue;
    }
    held.draws.push_back(std::move(one.draws[0]));
  }
  return held;
}

BreedProblem BreedingBench::problem(const api::RoomSettings& settings, std::uint64_t seed,
                                    const std::vector<api::DrawPlace>& locked) {
  appraiser_.reset();
  if (!scorer_ && setup_->objective.size() > 0) {
    scorer_ = std::make_unique<SceneScorer>(graph(), setup_->objective, executor_);
  }
  ModelAppraiser::Settings judged;
  // What is bred depends on nothing but this state, so that it can be bred again.
  if (!usual_is_exact_) usual_.reset();
  judged.viability = viability(settings);
  forget_seen();
  if (setup_->objective.size() == 0 && !settings.taste.value()) {
    judged.limits.make_materials = true;
    judged.onlooker = [this](const Sighting& sighting) { watch(sighting); };
  }
  appraiser_ =
      std::make_unique<ModelAppraiser>(setup_->grammar.graph, setup_->meshes, judged, scorer_.get(), executor_);
  BreedProblem problem;
  problem.graph = setup_->grammar.graph;
  problem.held = held(locked);
  problem.appraiser = appraiser_.get();
  problem.seed = seed;
  return problem;
}

}  // namespace espalier::studio
