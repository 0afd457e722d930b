#include "run/search_session.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/random.h"
#include "run/run_folders.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::pile_scene;
using testing::TemporaryFolder;
using testing::write_pile;

constexpr std::uint64_t kSteps = 70;

/// A pile that also has hard limits which reject, so that their totals have to be carried on.
const std::string kScene = pile_scene() + "[limits.height]\nmax = 3\n";

class Sessions : public ::testing::TestWithParam<std::string_view> {
 protected:
  Sessions() {
    write_pile(folder_, kScene);
    AssimpMeshSource source;
    const SceneOverrides chosen = {
        {"search.engine=" + std::string(GetParam()), "engine.hybrid.turn=200",
         "engine.hybrid.start_evaluations=300", "engine.sosmc.particles=200", "engine.smc.particles=30", "engine.ga.restart_after=12",
         "engine.ga.population=150", "volume.overlap_weight=0.1234567"},
        {}};
    setup_ = set_up(load_scene(folder_ / "scene.toml", chosen), source);
  }

  TemporaryFolder folder_;
  std::unique_ptr<espalier::Setup> setup_;
};

void step_to(SearchSession& session, std::uint64_t step) {
  while (session.last().step < step) session.step();
}

std::string saved(const SearchSession& session) {
  std::ostringstream out;
  session.save(out);
  return out.str();
}

void load(SearchSession& session, const std::string& state) {
  std::istringstream in(state);
  session.load(in);
}

void expect_same_log(const SearchLog& a, const SearchLog& b) {
  const auto steps_a = a.steps(), steps_b = b.steps();
  ASSERT_EQ(steps_a.size(), steps_b.size());
  for (std::size_t i = 0; i < steps_a.size(); ++i) {
    EXPECT_EQ(steps_a[i].step, steps_b[i].step);
    EXPECT_EQ(steps_a[i].evaluations, steps_b[i].evaluations);
    EXPECT_EQ(steps_a[i].best, steps_b[i].best);
    EXPECT_EQ(steps_a[i].mean, steps_b[i].mean);
  }
  EXPECT_EQ(a.gauge_names(), b.gauge_names());
  ASSERT_EQ(a.gauge_rows().size(), b.gauge_rows().size());
  for (std::size_t i = 0; i < a.gauge_rows().size(); ++i) {
    EXPECT_THAT(a.gauge_rows()[i].row.values,
                ::testing::Pointwise(::testing::NanSensitiveDoubleEq(), b.gauge_rows()[i].row.values));
  }
}

void expect_same_result(const SearchResult& a, const SearchResult& b) {
  EXPECT_EQ(a.best.derivation, b.best.derivation);
  EXPECT_EQ(a.best.score, b.best.score);
  ASSERT_EQ(a.alternatives.size(), b.alternatives.size());
  for (std::size_t i = 0; i < a.alternatives.size(); ++i) {
    EXPECT_EQ(a.alternatives[i].derivation, b.alternatives[i].derivation);
  }
  EXPECT_EQ(a.spread, b.spread);
  EXPECT_EQ(a.diagnostics, b.diagnostics);
  ASSERT_EQ(a.rejections.size(), b.rejections.size());
  for (std::size_t i = 0; i < a.rejections.size(); ++i) {
    EXPECT_EQ(a.rejections[i].count, b.rejections[i].count);
    EXPECT_EQ(a.rejections[i].lowest, b.rejections[i].lowest);
    EXPECT_EQ(a.rejections[i].highest, b.rejections[i].highest);
  }
  EXPECT_EQ(a.evaluations, b.evaluations);
  expect_same_log(a.log, b.log);
}

TEST_P(Sessions, LoadedAnywhereGoOnAsIfNeverStopped) {
  const auto one = make_serial_executor(), two = make_tbb_executor(2);
  SearchSession whole(*setup_, *one);
  step_to(whole, kSteps);
  const SearchResult expected = whole.finish("steps");
  ASSERT_GT(expected.rejections.at(1).count, 0u);
  std::string state;
  double seconds = 0;
  for (const std::uint64_t stop : {1, 2, 11, 29, 30, 48, 69, 70}) {
    SearchSession part(*setup_, stop % 2 ? *two : *one);
    if (!state.empty()) load(part, state);
    EXPECT_GE(part.last().seconds, seconds) << "times go on too";
    step_to(part, stop);
    seconds = part.last().seconds;
    state = saved(part);
  }
  SearchSession last(*setup_, *one);
  load(last, state);
  EXPECT_EQ(last.last().step, kSteps);
  expect_same_result(last.finish("steps"), expected);
}

TEST_P(Sessions, SavingDoesNotDisturb) {
  const auto executor = make_serial_executor();
  SearchSession session(*setup_, *executor);
  step_to(session, 20);
  const std::string once = saved(session);
  EXPECT_EQ(saved(session).size(), once.size());
  SearchSession again(*setup_, *executor);
  load(again, once);
  const std::string twice = saved(again);
  EXPECT_EQ(twice.substr(24), once.substr(24)) << "all but the seconds before it";
}

TEST_P(Sessions, DamagedStatesAreRefused) {
  const auto executor = make_serial_executor();
  SearchSession session(*setup_, *executor);
  step_to(session, 12);
  const std::string state = saved(session);
  RandomStream random({7, Purpose::initial, 0, 0, 0});
  for (int i = 0; i < 60; ++i) {
    SearchSession other(*setup_, *executor);
    EXPECT_THROW(load(other, state.substr(0, random.below(static_cast<std::uint32_t>(state.size())))), Error);
  }
  SearchSession longer(*setup_, *executor);
  EXPECT_THROW(load(longer, state + "x"), Error);
  // Any byte may be another: an Error, or (a score, a draw) a state that could have been.
  for (int i = 0; i < 200; ++i) {
    std::string flipped = state;
    flipped[random.below(static_cast<std::uint32_t>(state.size()))] ^= static_cast<char>(1 + random.below(255));
    SearchSession other(*setup_, *executor);
    try {
      load(other, flipped);
    } catch (const Error&) {
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Run, Sessions, ::testing::ValuesIn(testing::kGrowingEngines),
                         [](const auto& engine) { return std::string(engine.param); });

TEST(SearchSession, OfAnotherSearchAreRefused) {
  const TemporaryFolder folder;
  write_pile(folder, kScene);
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  const auto setup_with = [&](const std::string& setting) {
    return set_up(load_scene(folder / "scene.toml", {{setting}, {}}), source);
  };
  const auto setup = setup_with("seed=3");
  SearchSession session(*setup, *executor);
  step_to(session, 3);
  const std::string state = saved(session);
  for (const std::string other : {"seed=4", "search.engine=rjmcmc", "search.elitism=5", "limits.height.max=6",
                                  "volume.mesh.0.fill=2"}) {
    const auto other_setup = setup_with(other);
    SearchSession another(*other_setup, *executor);
    EXPECT_THROW(load(another, state), Error) << other;
  }
}

}  // namespace
}  // namespace espalier
