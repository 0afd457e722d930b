// What a session of the breeding room makes of all that was said in it.
#include <algorithm>

#include "base/error.h"
#include "breed/screen.h"
#include "studio/breeding_session.h"
#include "studio/breeding_settings.h"

namespace espalier::studio {
namespace {

constexpr std::size_t kMostOpinions = 600;  // the latest; what a taste model learns from at most

}  // namespace

/// All that was rated, each derivation once, as it was rated last; copies have the rating of what they are copies of.
void BreedingSession::add_opinions(BreedingRecipe& recipe) const {
  const std::vector<BredRow> rows = store_.individuals(session_);
  std::map<std::string, std::size_t> known;
  for (const BredRow& row : rows) {
    if (!row.rating || !row.present) continue;
    const auto [at, is_new] = known.emplace(row.derivation, recipe.opinions.size());
    if (is_new) recipe.opinions.push_back({row.derivation, *row.rating});
    else recipe.opinions[at->second].rating = *row.rating;
  }
  if (recipe.opinions.size() > kMostOpinions) {
    recipe.opinions.erase(recipe.opinions.begin(), recipe.opinions.end() - static_cast<std::ptrdiff_t>(kMostOpinions));
  }
  const auto text_of = [&](std::int64_t id) {
    const auto row = std::ranges::lower_bound(rows, id, {}, &BredRow::id);
    return row != rows.end() && row->id == id ? row->derivation : std::string();
  };
  for (const BreedingComparison& one : store_.comparisons(session_)) {
    std::string better = text_of(one.better), worse = text_of(one.worse);
    if (!better.empty() && !worse.empty()) recipe.comparisons.push_back({std::move(better), std::move(worse)});
  }
  if (recipe.comparisons.size() > kMostOpinions) {
    recipe.comparisons.erase(recipe.comparisons.begin(),
                             recipe.comparisons.end() - static_cast<std::ptrdiff_t>(kMostOpinions));
  }
}

void BreedingSession::expect_again() {
  reflected_ = false;
  forecasts_.clear();
  said_.reset();
  strangers_.clear();
}

/// A little at each call: somebody may want to rate meanwhile.
bool BreedingSession::reflect() {
  if (reflected_) return false;
  try {
    if (!bench_.draw_random_features()) return false;
  } catch (const Error&) {  // nothing grows freely from this grammar
    reflected_ = true;
    return false;
  }
  if (!said_) {
    said_ = BreedingRecipe{.settings = settings_};
    if (settings_.taste.value()) add_opinions(*said_);
  }
  const ReadText read_text = [&](const std::string& hash) { return store_.text(session_, hash); };
  for (const std::string& hash : texts_of(*said_)) {
    if (bench_.knows_features(hash) || strangers_.count(hash) != 0) continue;
    try {
      bench_.features(hash, read_text);
    } catch (const Error&) {  // of another text of the grammar
      strangers_.insert(hash);
    }
    return false;
  }
  const BreedingRecipe said = std::move(*said_);
  expect_again();
  reflected_ = true;
  std::vector<std::vector<double>> features;
  for (const RoomIndividual& one : individuals_) {
    if (one.model) features.push_back(one.model->features);
  }
  if (features.size() < 2) return true;
  store_.set_diversity(session_, head_.generation, diversity(features, bench_.random_features()));
  if (!uses_taste(said)) return true;
  const std::optional<Taste> taste = learn_taste(bench_, said, read_text);
  if (!taste) return true;
  for (const RoomIndividual& one : individuals_) {
    if (!one.model) continue;
    const Forecast forecast = taste->forecast(one.model->features);
    api::Taste& text = forecasts_[one.row.id];
    text.mean = forecast.rating;
    text.sd = forecast.deviation;
    std::string why = taste->reasons(one.model->features, bench_.feature_names());
    if (!why.empty()) text.why.push_back(std::move(why));
  }
  return true;
}

}  // namespace espalier::studio
