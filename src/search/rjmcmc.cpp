#include "search/rjmcmc.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/check.h"
#include "base/natural_exp.h"
#include "base/natural_log.h"
#include "derivation/nudge.h"
#include "search/acceptance.h"
#include "search/initial_population.h"
#include "search/require.h"

namespace espalier {

RjmcmcEngine::RjmcmcEngine(const SearchProblem& problem, const RjmcmcSettings& settings)
    : problem_(problem),
      settings_(validated(settings)),
      counts_(settings_.temperatures),
      counts_then_(counts_),
      recent_(counts_) {
  CHECK(problem_.scorer != nullptr);
  beta_ = inverse_temperature(settings_.weight, settings_.temperature, problem_.scorer->optimum(), 3000);
}

const Individual& RjmcmcEngine::best() const {
  CHECK(steps_ > 0);
  return best_;
}

double RjmcmcEngine::beta(std::uint32_t rung) const {
  const double coolings = static_cast<double>(steps_ / settings_.anneal_every);
  const double cooled = std::min(natural_exp(natural_log(settings_.anneal) * coolings), settings_.anneal_most);
  if (rung == 0) return beta_ * cooled;
  return beta_ * cooled * natural_exp(-natural_log(settings_.heat) * rung / (settings_.temperatures - 1));
}

void RjmcmcEngine::step() {
  if (steps_ == 0) {
    make_initial_states();
  } else {
    begin_sessions();
    propose();
    score_made();
    decide();
    if (settings_.delayed) {
      propose_delayed();
      score_made();
      decide();
    }
    if (settings_.swap_every > 0 && steps_ % settings_.swap_every == 0) swap_rungs();
  }
  sort_states();
  if (steps_ == 0 || states_.front().score > best_.score) best_ = states_.front();
  if (++steps_ % kGaugeSteps != 0) return;
  recent_ = difference(counts_, counts_then_);
  counts_then_ = counts_;
}

void RjmcmcEngine::make_initial_states() {
  const StartSettings settings = {settings_.chains, settings_.initial_length_min, settings_.initial_length_max,
                                  settings_.genes};
  StartResult made = make_initial_population(problem_, settings, 0, problem_.founders, {});
  states_ = std::move(made.individuals);
  evaluations_ += made.evaluations;
  rejected_starts_ += made.rejected_starts;
  chain_of_.resize(states_.size());
  std::iota(chain_of_.begin(), chain_of_.end(), 0u);
  for (const Individual& state : states_) value_of(state.score);  // refuses what has no ratio
}

void RjmcmcEngine::begin_sessions() {
  if (sessions_begun_) return;
  sessions_begun_ = true;
  sessions_.resize(states_.size());
  session_of_.resize(states_.size());
  for (std::size_t i = 0; i < states_.size(); ++i) {
    session_of_[i] = i;
    if (!sessions_[i]) sessions_[i] = problem_.scorer->make_session();
    if (sessions_[i]) sessions_[i]->begin(states_[i].derivation);
  }
}

ProposalKind RjmcmcEngine::draw_kind(RandomStream& random) const {
  const double shares[] = {settings_.draws, settings_.nudges, settings_.slots, settings_.jumps};
  double rest = random.next_unit() * std::accumulate(std::begin(shares), std::end(shares), 0.0);
  std::size_t kind = 0, last = 3;
  while (shares[last] <= 0) --last;
  while (kind < last && rest >= shares[kind]) rest -= shares[kind++];
  return static_cast<ProposalKind>(kind);
}

bool RjmcmcEngine::within_limits(const Derivation& derivation) const {
  return derivation.size() >= settings_.genes.min && derivation.size() <= settings_.genes.max;
}

void RjmcmcEngine::propose() {
  tries_.resize(states_.size());
  proposals_.resize(states_.size());
  const GeneratorGraph& graph = *problem_.graph;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    Try& one = tries_[i];
    one.random = RandomStream({problem_.seed, Purpose::propose, problem_.lane, chain_of_[i],
                               static_cast<std::uint32_t>(steps_)});
    one.kind = draw_kind(one.random);
    Derivation& next = proposals_[i];
    next = states_[i].derivation;
    const PlaceChoice choice = settings_.choice;
    const std::uint32_t most = settings_.genes.max;
    std::optional<double> ratio;
    if (one.kind == ProposalKind::jumps) {
      ratio = propose_jump(graph, next, problem_.locks, choice, most, one.random);
    } else if (one.kind == ProposalKind::slots) {
      ratio = propose_slot(graph, next, problem_.locks, choice, most, one.random);
    } else {
      const DrawStep step = one.kind == ProposalKind::nudges ? DrawStep::local : DrawStep::fresh;
      ratio = propose_draws(graph, next, problem_.locks, choice, step, one.random, &one.gene);
    }
    one.made = ratio && within_limits(next);
    one.log_ratio = ratio.value_or(0);
    ++count_of(i).proposed;
  }
}

void RjmcmcEngine::propose_delayed() {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    Try& one = tries_[i];
    if (!one.made) continue;  // it was accepted, or nothing was proposed
    one.made = one.kind == ProposalKind::draws;
    if (!one.made) continue;
    one.kind = ProposalKind::delayed;
    one.rejected_score = one.score;
    proposals_[i] = states_[i].derivation;
    nudge_gene(*problem_.graph, proposals_[i], one.gene, one.random);
    ++count_of(i).proposed;
  }
}

void RjmcmcEngine::score_made() {
  batch_.clear();
  batch_places_.clear();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (!tries_[i].made) continue;
    batch_.push_back({sessions_[session_of_[i]].get(), &proposals_[i]});
    batch_places_.push_back(i);
  }
  scores_.resize(batch_.size());
  if (!batch_.empty()) problem_.scorer->score_proposals(batch_, scores_);
  evaluations_ += batch_.size();
  for (std::size_t k = 0; k < batch_.size(); ++k) {
    CHECK(scores_[k] == kNotAcceptable || std::isfinite(scores_[k]));
    tries_[batch_places_[k]].score = scores_[k];
  }
}

double RjmcmcEngine::log_acceptance(std::size_t place) const {
  const Try& one = tries_[place];
  const double b = beta(rung_of(place)), before = value_of(states_[place].score), after = value_of(one.score);
  const double plain = one.log_ratio + b * (after - before);
  if (one.kind != ProposalKind::delayed || one.score == kNotAcceptable) return plain;
  return plain + log_delayed_ratio(b, before, value_of(one.rejected_score), after);
}

/// Accepts or rejects what was scored; of the accepted, `made` is cleared.
void RjmcmcEngine::decide() {
  for (const std::size_t i : batch_places_) {
    Try& one = tries_[i];
    const double u = one.random.next_unit();
    if (!(u < natural_exp(log_acceptance(i)))) continue;
    std::swap(states_[i].derivation, proposals_[i]);
    states_[i].score = one.score;
    if (ScoreSession* session = sessions_[session_of_[i]].get()) session->commit();
    ++count_of(i).accepted;
    one.made = false;
  }
}

void RjmcmcEngine::swap_rungs() {
  std::vector<std::size_t> place_of(states_.size());
  for (std::size_t i = 0; i < chain_of_.size(); ++i) place_of[chain_of_[i]] = i;
  // Even pairs and odd ones in turn; two rungs are one pair.
  const bool odd = settings_.temperatures > 2 && steps_ / settings_.swap_every % 2 == 1;
  for (std::uint32_t chain = 0; chain + 1 < chain_of_.size(); ++chain) {
    const std::uint32_t rung = chain % settings_.temperatures;
    if ((rung % 2 == 1) != odd || rung + 1 == settings_.temperatures) continue;
    RandomStream random({problem_.seed, Purpose::swap, problem_.lane, chain, static_cast<std::uint32_t>(steps_)});
    std::size_t& cold = place_of[chain];
    std::size_t& hot = place_of[chain + 1];
    const double log_ratio = log_swap_ratio(beta(rung), beta(rung + 1), value_of(states_[cold].score),
                                            value_of(states_[hot].score));
    ++counts_.swaps[rung].proposed;
    if (!(random.next_unit() < natural_exp(log_ratio))) continue;
    ++counts_.swaps[rung].accepted;
    std::swap(chain_of_[cold], chain_of_[hot]);
    std::swap(cold, hot);
  }
}

void RjmcmcEngine::sort_states() {
  best_first_.sort(states_, [this](std::size_t place) { return chain_of_[place]; });
  best_first_.follow(chain_of_, chain_scratch_);
  if (sessions_begun_) best_first_.follow(session_of_, session_scratch_);
}

}  // namespace espalier
