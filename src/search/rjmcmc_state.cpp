// Saving and loading of reversible-jump Markov chain Monte Carlo.
#include <istream>
#include <ostream>

#include <fmt/format.h>

#include "base/error.h"
#include "search/engine_state.h"
#include "search/rjmcmc.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMagic = 0x0a4a'5250'5345ull;  // the bytes "ESPRJ\n"
constexpr std::uint64_t kStateVersion = 2;

void write(StateWriter& writer, const ProposalCount& count) {
  writer.u64(count.proposed);
  writer.u64(count.accepted);
}

ProposalCount read(StateReader& reader) {
  const std::uint64_t proposed = reader.u64();
  return {proposed, reader.u64_at_most(proposed, "accepted proposals")};
}

void write(StateWriter& writer, const RjmcmcCounts& counts) {
  for (const auto& of_rung : counts.proposals) {
    for (const ProposalCount& count : of_rung) write(writer, count);
  }
  for (const ProposalCount& count : counts.swaps) write(writer, count);
}

RjmcmcCounts read(StateReader& reader, std::size_t rungs) {
  RjmcmcCounts counts(rungs);
  for (auto& of_rung : counts.proposals) {
    for (ProposalCount& count : of_rung) count = read(reader);
  }
  for (ProposalCount& count : counts.swaps) count = read(reader);
  return counts;
}

}  // namespace

void RjmcmcEngine::save(std::ostream& out) const {
  StateWriter writer(out);
  write_head(writer, kMagic, kStateVersion, fingerprint("rjmcmc", problem_, to_text(settings_)));
  writer.u64(steps_);
  writer.u64(evaluations_);
  writer.u64(rejected_starts_);
  for (const RjmcmcCounts* counts : {&counts_, &counts_then_, &recent_}) write(writer, *counts);
  if (steps_ == 0) return;
  write_individual(writer, best_);
  for (std::size_t i = 0; i < states_.size(); ++i) {
    writer.u64(chain_of_[i]);
    write_individual(writer, states_[i]);
  }
}

void RjmcmcEngine::load(std::istream& in) {
  StateReader reader(in);
  read_head(reader, kMagic, kStateVersion, fingerprint("rjmcmc", problem_, to_text(settings_)));
  const std::uint64_t steps = reader.u64(), evaluations = reader.u64(), rejected_starts = reader.u64();
  std::array<RjmcmcCounts, 3> counts;
  for (RjmcmcCounts& one : counts) one = read(reader, settings_.temperatures);
  Individual best;
  std::vector<Individual> states;
  std::vector<std::uint32_t> chain_of;
  if (steps > 0) {
    best = read_finished_individual(reader, *problem_.graph, settings_.genes);
    std::vector<char> seen(settings_.chains, 0);
    for (std::uint32_t i = 0; i < settings_.chains; ++i) {
      const std::uint64_t chain = reader.u64_at_most(settings_.chains - 1, "chain");
      if (seen[chain]++) throw Error(fmt::format("saved state: chain {} is there twice", chain));
      chain_of.push_back(static_cast<std::uint32_t>(chain));
      states.push_back(read_finished_individual(reader, *problem_.graph, settings_.genes));
    }
  }

  steps_ = steps, evaluations_ = evaluations, rejected_starts_ = rejected_starts;
  counts_ = std::move(counts[0]), counts_then_ = std::move(counts[1]), recent_ = std::move(counts[2]);
  best_ = std::move(best);
  states_ = std::move(states);
  chain_of_ = std::move(chain_of);
  sessions_begun_ = false;
}

}  // namespace espalier
