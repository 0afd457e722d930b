// The figures of reversible-jump Markov chain Monte Carlo: counts and gauges.
#include <algorithm>

#include <fmt/format.h>

#include "search/gauges.h"
#include "search/rjmcmc.h"

namespace espalier {
namespace {

constexpr const char* kKinds[kProposalKinds] = {"draws", "nudges", "slots", "jumps", "delayed nudges"};

ProposalCount difference(const ProposalCount& after, const ProposalCount& before) {
  return {after.proposed - before.proposed, after.accepted - before.accepted};
}

}  // namespace

RjmcmcCounts difference(const RjmcmcCounts& after, const RjmcmcCounts& before) {
  RjmcmcCounts result = after;
  for (std::size_t rung = 0; rung < after.proposals.size(); ++rung) {
    for (std::size_t kind = 0; kind < kProposalKinds; ++kind) {
      result.proposals[rung][kind] = difference(after.proposals[rung][kind], before.proposals[rung][kind]);
    }
  }
  for (std::size_t rung = 0; rung < after.swaps.size(); ++rung) {
    result.swaps[rung] = difference(after.swaps[rung], before.swaps[rung]);
  }
  return result;
}

std::vector<NamedCount> RjmcmcEngine::diagnostics() const {
  std::vector<NamedCount> all;
  const auto add = [&](const std::string& name, const ProposalCount& count) {
    all.push_back({name, count.proposed});
    all.push_back({name + " accepted", count.accepted});
  };
  for (std::size_t kind = 0; kind < kProposalKinds; ++kind) {
    ProposalCount sum;
    for (const auto& of_rung : counts_.proposals) {
      sum.proposed += of_rung[kind].proposed, sum.accepted += of_rung[kind].accepted;
    }
    add(kKinds[kind], sum);
  }
  for (std::size_t rung = 0; rung < counts_.proposals.size(); ++rung) {
    ProposalCount sum;
    for (const ProposalCount& one : counts_.proposals[rung]) sum.proposed += one.proposed, sum.accepted += one.accepted;
    add(fmt::format("rung {}", rung), sum);
  }
  for (std::size_t rung = 0; rung < counts_.swaps.size(); ++rung)
    add(fmt::format("swaps {}-{}", rung, rung + 1), counts_.swaps[rung]);
  all.push_back({"rejected starts", rejected_starts_});
  return all;
}

std::vector<NamedGauge> RjmcmcEngine::gauges() const {
  std::vector<NamedGauge> all = {{"distinct", share_distinct(states_)}, {"temperature", 1 / beta(0)}};
  const auto add = [&](std::string name, const ProposalCount& count) {
    all.push_back({std::move(name), share_of(count.accepted, count.proposed)});
  };
  const std::size_t rungs = std::min(recent_.proposals.size(), kGaugeRungs);
  for (std::size_t kind = 0; kind < kProposalKinds; ++kind) {
    for (std::size_t rung = 0; rung < rungs; ++rung) {
      add(fmt::format("accepted {}, rung {}", kKinds[kind], rung), recent_.proposals[rung][kind]);
    }
  }
  for (std::size_t rung = 0; rung + 1 < rungs; ++rung) {
    add(fmt::format("accepted swaps {}-{}", rung, rung + 1), recent_.swaps[rung]);
  }
  return all;
}

}  // namespace espalier
