// Saving and loading of reversible-jump Markov chain Monte Carlo.
#include <algorithm>
#include <istream>
#include <ostream>

#include <fmt/format.h>

#include "base/error.h"
#include "search/engine_state.h"
#include "search/rjmcmc.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMagic = 0x0a4a'5250'5345ull;  // the bytes "ESPRJ\n"
constexpr std::uint64_t kStateVersion = 1;
constexpr const char* kKinds[kProposalKinds] = {"draws", "nudges", "slots", "jumps", "delayed nudges"};

void write(StateWriter& writer, const ProposalCount& count) {
  writer.u64(count.proposed);
  writer.u64(count.accepted);
}

ProposalCount read(StateReader& reader) {
  const std::uint64_t proposed = reader.u64();
  return {proposed, reader.u64_at_most(proposed, "accepted proposals")};
}

}  // namespace

std::vector<NamedCount> RjmcmcEngine::diagnostics() const {
  std::vector<NamedCount> all;
  const auto add = [&](const std::string& name, const ProposalCount& count) {
    all.push_back({name, count.proposed});
    all.push_back({name + " accepted", count.accepted});
  };
  for (std::size_t kind = 0; kind < kProposalKinds; ++kind) {
    ProposalCount sum;
    for (const auto& of_rung : counts_) sum.proposed += of_rung[kind].proposed, sum.accepted += of_rung[kind].accepted;
    add(kKinds[kind], sum);
  }
  for (std::size_t rung = 0; rung < counts_.size(); ++rung) {
    ProposalCount sum;
    for (const ProposalCount& one : counts_[rung]) sum.proposed += one.proposed, sum.accepted += one.accepted;
    add(fmt::format("rung {}", rung), sum);
  }
  for (std::size_t rung = 0; rung < swaps_.size(); ++rung)
    add(fmt::format("swaps {}-{}", rung, rung + 1), swaps_[rung]);
  all.push_back({"rejected starts", rejected_starts_});
  return all;
}

void RjmcmcEngine::save(std::ostream& out) const {
  StateWriter writer(out);
  write_head(writer, kMagic, kStateVersion, fingerprint("rjmcmc", problem_, to_text(settings_)));
  writer.u64(steps_);
  writer.u64(evaluations_);
  writer.u64(rejected_starts_);
  for (const auto& of_rung : counts_) {
    for (const ProposalCount& count : of_rung) write(writer, count);
  }
  for (const ProposalCount& count : swaps_) write(writer, count);
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
  auto counts = counts_;
  auto swaps = swaps_;
  for (auto& of_rung : counts) {
    for (ProposalCount& count : of_rung) count = read(reader);
  }
  for (ProposalCount& count : swaps) count = read(reader);
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
  counts_ = std::move(counts);
  swaps_ = std::move(swaps);
  best_ = std::move(best);
  states_ = std::move(states);
  chain_of_ = std::move(chain_of);
}

}  // namespace espalier
