#include "studio/breeding_replay.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/counted.h"
#include "base/error.h"
#include "base/hash.h"
#include "derivation/encode.h"
#include "studio/breeding_recipe.h"

namespace espalier::studio {
namespace {

/// Whether the members are those of the rows as they were bred: ids, origins, parents and derivations.
bool same(const GeneratorGraph& graph, const std::vector<Member>& members, const std::vector<BredRow>& rows) {
  if (members.size() != rows.size()) return false;
  for (std::size_t i = 0; i < members.size(); ++i) {
    std::vector<std::int64_t> parents;
    for (const MemberId parent : members[i].parents) {
      if (parent != 0) parents.push_back(static_cast<std::int64_t>(parent));
    }
    const bool equal = static_cast<std::int64_t>(members[i].id) == rows[i].id &&
                       name_of(members[i].origin) == rows[i].origin && parents == rows[i].parents &&
                       content_hash(encode(graph, members[i].derivation)) == rows[i].born;
    if (!equal) return false;
  }
  return true;
}

}  // namespace

ReplayReport replay(Store& store, std::int64_t project, std::int64_t session, Executor& executor) {
  BreedingStore breedings(store);
  breedings.open(project, session);
  BreedingBench bench([&](const std::string& hash) { return store.blob(project, hash); }, executor);
  const ReadText read_text = [&](const std::string& hash) { return breedings.text(session, hash); };
  const std::vector<BredRow> all = breedings.individuals(session);
  ReplayReport report;
  for (const GenerationSummary& summary : breedings.generations(session)) {
    try {
      const StoredGeneration generation = breedings.generation(session, summary.number);
      bench.take(generation.state);
      const BreedingRecipe recipe = parse_recipe(generation.recipe);
      const MadeGeneration made = make_generation(bench, recipe, read_text);
      // Others came later by hand: kept blends.
      const std::int64_t end = recipe.first_id + static_cast<std::int64_t>(made.members.size());
      std::vector<BredRow> rows;
      for (const BredRow& row : all) {
        if (row.generation == summary.number && row.id >= recipe.first_id && row.id < end) rows.push_back(row);
      }
      if (!same(bench.graph(), made.members, rows)) report.different.push_back(summary.number);
      report.individuals += static_cast<std::int64_t>(rows.size());
    } catch (const Error& error) {
      throw Error(fmt::format("generation {}: {}", summary.number, bench.as_named(error.what())));
    }
    ++report.generations;
  }
  return report;
}

std::string to_text(const ReplayReport& report) {
  if (!report.different.empty()) {
    return fmt::format("generations that did not come out the same: {}\n", fmt::join(report.different, ", "));
  }
  return fmt::format("{} with {} came out the same\n",
                     counted(static_cast<std::size_t>(report.generations), "generation"),
                     counted(static_cast<std::size_t>(report.individuals), "individual"));
}

}  // namespace espalier::studio
