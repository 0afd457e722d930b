// Saving and loading sessions.
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "run/search_session.h"
#include "search/engine_state.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMagic = 0x0a53'5345'5350'5345ull;  // the bytes "ESPSESS\n"
constexpr std::uint64_t kStateVersion = 2;

void write_archive(StateWriter& writer, const DiverseArchive& archive) {
  writer.u64(archive.members().size());
  for (const Individual& member : archive.members()) write_individual(writer, member);
}

/// `open`: they may have open slots, as a matter of course.
std::vector<Individual> read_archive(StateReader& reader, const Setup& setup, std::size_t most, bool open) {
  std::vector<Individual> members(reader.u64_at_most(most, "alternatives"));
  double least = std::numeric_limits<double>::infinity();
  for (Individual& member : members) {
    member = open ? read_individual(reader, setup.graph())
                  : read_finished_individual(reader, setup.graph(), setup.scene.search.ga.genes);
    if (member.score > least) throw Error("saved state: the alternatives are out of order");
    least = member.score;
  }
  return members;
}

std::string in_words(const Rejections& rejections) {
  return fmt::format("limits.{} {}", rejections.name, rejections.bound);
}

void write_rejections(StateWriter& writer, const std::vector<Rejections>& all) {
  writer.u64(all.size());
  for (const Rejections& one : all) {
    writer.text(in_words(one));
    writer.u64(one.count);
    writer.f64(one.lowest);
    writer.f64(one.highest);
  }
}

/// `now`: of the scorer that goes on, whose limits are the same.
std::vector<Rejections> read_rejections(StateReader& reader, std::vector<Rejections> now) {
  if (const std::uint64_t got = reader.u64(); got != now.size()) {
    throw Error(fmt::format("saved state: hard limits must be {}, got {}", now.size(), got));
  }
  for (Rejections& one : now) {
    if (const std::string limit = reader.text(); limit != in_words(one)) {
      throw Error(fmt::format("saved state: a hard limit must be {}, got {}", in_words(one), limit));
    }
    one.count = reader.u64();
    one.lowest = reader.f64(), one.highest = reader.f64();
    if (one.count > 0 && !(one.lowest <= one.highest)) {
      throw Error(fmt::format("saved state: what limits.{} rejected must have a range, got {} to {}", one.name,
                              one.lowest, one.highest));
    }
  }
  return now;
}

}  // namespace

void SearchSession::save(std::ostream& out) const {
  CHECK(!finished_ && last_.step > 0);
  StateWriter writer(out);
  writer.u64(kMagic);
  writer.u64(kStateVersion);
  writer.f64(watch_.seconds());
  log_.save(writer);
  write_archive(writer, archive_);
  write_rejections(writer, scorer_.rejections());
  engine_->save(out);
}

void SearchSession::load(std::istream& in) {
  CHECK(!finished_ && last_.step == 0);
  StateReader reader(in);
  if (reader.u64() != kMagic) throw Error("saved state: this is no saved state of a search");
  if (const std::uint64_t got = reader.u64(); got != kStateVersion) {
    throw Error(fmt::format("saved state: version must be {}, got {}", kStateVersion, got));
  }
  const double seconds = reader.f64();
  if (!std::isfinite(seconds) || seconds < 0) throw Error("saved state: seconds must be a number from 0");
  log_.load(reader);
  archive_.restore(read_archive(reader, setup_, archive_.capacity(), engine_->leaves_open()));
  scorer_.count_in(read_rejections(reader, scorer_.rejections()));
  engine_->load(in);
  if (in.peek() != std::istream::traits_type::eof()) throw Error("saved state: more follows after its end");
  const std::vector<StepReport> steps = log_.steps();
  if (steps.empty()) throw Error("saved state: its log is empty");
  last_ = steps.back();
  watch_.set(seconds);
  check_loaded();
}

/// Parts that are sound each may still not belong together.
void SearchSession::check_loaded() const {
  if (last_.step == 0 || last_.step != engine_->steps() || last_.evaluations != engine_->evaluations() ||
      last_.best != engine_->best().score) {
    throw Error("saved state: log and engine tell different steps");
  }
  if (!log_.gauge_rows().empty() && log_.gauge_rows().back().number >= last_.step) {
    throw Error("saved state: the log has gauges of steps to come");
  }
  const std::vector<NamedGauge> now = gauges();
  if (log_.gauge_names().size() != (log_.gauge_rows().empty() ? 0 : now.size())) {
    throw Error(fmt::format("saved state: gauges must be {}, got {}", now.size(), log_.gauge_names().size()));
  }
  for (std::size_t i = 0; i < log_.gauge_names().size(); ++i) {
    if (log_.gauge_names()[i] == now[i].name) continue;
    throw Error(fmt::format("saved state: a gauge must be \"{}\", got \"{}\"", now[i].name, log_.gauge_names()[i]));
  }
}

}  // namespace espalier
