#include "score/combined_objective.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"

namespace espalier {
namespace {

constexpr double kRejected = -std::numeric_limits<double>::infinity();

void append(std::string& text, const std::string& more) {
  if (!text.empty() && !more.empty()) text += "; ";
  text += more;
}

}  // namespace

Objective::Scratch::Scratch(const Objective& objective) {
  for (const Entry& entry : objective.targets_) targets_.push_back(entry.target->make_scratch());
  scores_.resize(targets_.size());
}

Objective::Session::Session(const Objective& objective) {
  for (const Entry& entry : objective.targets_) targets_.push_back(entry.target->make_session());
}

void Objective::Session::begin(const Model& state) {
  state_ = state.instances;
  scored_ = false;
  for (const auto& target : targets_) {
    if (target) target->restart();
  }
}

void Objective::Session::commit() {
  CHECK(scored_);
  scored_ = false;
  const auto first = state_.begin() + static_cast<std::ptrdiff_t>(first_);
  const std::size_t in_place = std::min(removed_, added_.size());
  const auto middle = std::copy_n(added_.begin(), in_place, first);
  if (removed_ > in_place) state_.erase(middle, middle + static_cast<std::ptrdiff_t>(removed_ - in_place));
  else state_.insert(middle, added_.begin() + static_cast<std::ptrdiff_t>(in_place), added_.end());
  for (const auto& target : targets_) {
    if (target) target->commit();
  }
}

bool Objective::Session::counted_change() const {
  return std::all_of(targets_.begin(), targets_.end(), [](const auto& t) { return !t || t->counted_change(); });
}

void Objective::add(std::unique_ptr<const Target> target, double weight) {
  CHECK(target != nullptr);
  if (!std::isfinite(weight) || weight < 0) {
    throw Error(fmt::format("target {}: weight must be finite and >= 0, got {}", target->name(), weight));
  }
  targets_.push_back({std::move(target), weight});
}

TargetView Objective::view() const {
  TargetView view = TargetView::genes;
  for (const Entry& entry : targets_) view = std::max(view, entry.target->view());
  return view;
}

/// score_target(i) = score of target i.
template <class ScoreTarget>
double Objective::sum_up(Scratch& scratch, const ScoreTarget& score_target) const {
  DCHECK(scratch.targets_.size() == targets_.size());
  // A rejection spares the other targets, which may cost much more.
  for (const bool may_reject : {true, false}) {
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      if (targets_[i].target->may_reject() != may_reject) continue;
      scratch.scores_[i] = score_target(i);
      if (scratch.scores_[i] == kRejected) return kRejected;
    }
  }
  double sum = 0;
  for (std::size_t i = 0; i < targets_.size(); ++i) sum += targets_[i].weight * scratch.scores_[i];
  return sum;
}

double Objective::score(const Derivation& derivation, const Model& model, Scratch& scratch) const {
  return sum_up(scratch, [&](std::size_t i) {
    return targets_[i].target->score(derivation, model, scratch.targets_[i].get());
  });
}

double Objective::score(const Derivation& derivation, const Model& model, Scratch& scratch, Session& session) const {
  CHECK(session.targets_.size() == targets_.size());
  const ModelChange change = find_change(session.state_, model.instances);
  const double score = sum_up(scratch, [&](std::size_t i) {
    TargetScratch* const memory = scratch.targets_[i].get();
    if (!session.targets_[i]) return targets_[i].target->score(derivation, model, memory);
    return session.targets_[i]->score(derivation, model, change, memory);
  });
  session.scored_ = score != kRejected;
  session.first_ = change.first;
  session.removed_ = change.removed.size();
  session.added_.assign(change.added.begin(), change.added.end());
  return score;
}

std::size_t Objective::session_bytes() const {
  std::size_t bytes = 0;
  for (const Entry& entry : targets_) bytes += entry.target->session_bytes();
  return bytes;
}

double Objective::optimum() const {
  double sum = 0;
  for (const Entry& entry : targets_) {
    if (entry.weight > 0 && !entry.target->bounded()) return 0;
    sum += entry.weight * entry.target->optimum();
  }
  return sum;
}

Explanation Objective::explain(const Derivation& derivation, const Model& model, Scratch& scratch) const {
  CHECK(scratch.targets_.size() == targets_.size());
  Explanation all;
  all.optimum = optimum();
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    Explanation one = targets_[i].target->explain(derivation, model, scratch.targets_[i].get());
    one.weight = targets_[i].weight;
    if (one.score != kRejected) all.score += one.weight * one.score;
    for (Term term : one.terms) {
      term.weight *= one.weight;
      term.value *= one.weight;
      all.terms.push_back(std::move(term));
    }
    append(all.words, one.words);
    append(all.rejected, one.rejected);
    all.targets.push_back(std::move(one));
  }
  if (!all.rejected.empty()) {
    all.score = kRejected;
  } else {
    all.percent = percent_of(all.score, all.optimum);
  }
  return all;
}

std::vector<Rejections> Objective::rejections(const Scratch& scratch) const {
  std::vector<Rejections> all;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    for (Rejections& one : targets_[i].target->rejections(scratch.targets_[i].get())) all.push_back(std::move(one));
  }
  return all;
}

}  // namespace espalier
