#include "studio/breeding_text.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/counted.h"
#include "breed/member.h"

namespace espalier::studio {
namespace {

constexpr std::int64_t kTiring = 10;  // generations, after which people are asked to choose

api::BreedingInfo info_of(const BreedingSummary& one) {
  const auto method = one.method == "classic" ? api::BreedingInfoMethod::classic : api::BreedingInfoMethod::free;
  return {one.id, one.name, method, one.generations, one.individuals, one.changed};
}

/// The enums of both messages name the same origins in the same order.
template <class Enum>
Enum origin_of(const BredRow& row) {
  return static_cast<Enum>(origin_named(row.origin));
}
static_assert(static_cast<std::size_t>(api::BredIndividualOrigin::sibling) ==
              static_cast<std::size_t>(Origin::sibling));
static_assert(static_cast<std::size_t>(api::LineageNodeOrigin::sibling) == static_cast<std::size_t>(Origin::sibling));

std::optional<api::BredIndividualRole> role_of(const std::optional<std::string>& role) {
  if (role == "best") return api::BredIndividualRole::best;
  if (role == "different") return api::BredIndividualRole::different;
  if (role == "uncertain") return api::BredIndividualRole::uncertain;
  return std::nullopt;
}

api::BredIndividual individual_text(const RoomIndividual& one, const api::Taste* taste) {
  api::BredIndividual text;
  text.id = one.row.id;
  text.generation = one.row.generation;
  text.origin = origin_of<api::BredIndividualOrigin>(one.row);
  text.parents = one.row.parents;
  text.rating = one.row.rating;
  text.edited = one.row.edited;
  text.version = one.version;
  text.role = role_of(one.row.role);
  if (taste) text.taste = *taste;
  if (!one.derivation) text.missing = one.missing;
  return text;
}

std::string hint_of(std::int64_t depth) {
  if (depth < kTiring) return "";
  return fmt::format("{}: choose one, or branch from an earlier generation",
                     counted(static_cast<std::size_t>(depth), "generation"));
}

}  // namespace

api::Breedings breedings_text(const std::vector<BreedingSummary>& sessions, std::optional<std::int64_t> open) {
  api::Breedings text;
  for (const BreedingSummary& one : sessions) text.sessions.push_back(info_of(one));
  text.open = open;
  return text;
}

api::Breeding breeding_text(const BreedingSession& session, const std::string& problem, const std::string& busy) {
  const BreedingHead& head = session.head();
  api::Breeding text;
  text.session = info_of(head.summary);
  text.revision = head.revision;
  text.settings = session.settings();
  text.seed = head.seed;
  text.locked = session.locked();
  text.generation = head.generation;
  std::map<std::int64_t, std::int64_t> depths;
  for (const GenerationSummary& one : session.generations()) {
    api::GenerationInfo info;
    info.number = one.number;
    if (one.parent != 0) info.parent = one.parent;
    info.depth = depths[one.number] = one.parent == 0 ? 0 : depths[one.parent] + 1;
    info.label = one.label;
    info.individuals = one.individuals;
    info.rated = one.rated;
    info.edited = one.edited;
    info.seconds = one.seconds;
    info.diversity = one.diversity;
    if (one.number == head.generation) text.diversity = one.diversity;
    text.generations.push_back(std::move(info));
  }
  const api::Taste* best = nullptr;
  std::set<std::int64_t> shown;
  for (const RoomIndividual& one : session.individuals()) {
    shown.insert(one.row.id);
    const auto taste = session.forecasts().find(one.row.id);
    const api::Taste* const found = taste == session.forecasts().end() ? nullptr : &taste->second;
    text.individuals.push_back(individual_text(one, found));
    if (found && (!best || found->mean > best->mean)) best = found;
  }
  if (best && !best->why.empty()) text.taste_why = best->why;
  std::vector<api::Comparison> compared;
  for (const BreedingComparison& one : session.comparisons()) {
    if (shown.count(one.better) && shown.count(one.worse)) compared.push_back({one.better, one.worse});
  }
  if (!compared.empty()) text.compared = std::move(compared);
  text.undo = head.undo;
  text.redo = head.redo;
  if (!busy.empty()) text.busy = busy;
  if (!problem.empty()) text.problem = problem;
  if (const std::string hint = hint_of(depths[head.generation] + 1); !hint.empty()) text.hint = hint;
  if (std::vector<std::string> notes = session.notes(); !notes.empty()) text.notes = std::move(notes);
  return text;
}

api::Lineage lineage_text(const BreedingSession& session) {
  api::Lineage text;
  text.session = session.number();
  for (const BredRow& row : session.lineage()) {
    if (!row.present) continue;
    text.individuals.push_back(
        {row.id, row.generation, origin_of<api::LineageNodeOrigin>(row), row.parents, row.rating, row.edited});
  }
  return text;
}

}  // namespace espalier::studio
