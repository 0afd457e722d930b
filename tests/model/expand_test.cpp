#include "model/expand.h"

#include <set>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiled.h"
#include "derivation/moves.h"
#include "derivation/sample.h"
#include "grammar/checker.h"
#include "grammar/compiler.h"
#include "grammar/parser.h"
#include "model/reference_expander.h"
#include "shipped_grammar.h"

namespace espalier {
namespace {

using test::compiled;

struct Parsed {
  CheckedGrammar checked;
  std::shared_ptr<const GeneratorGraph> graph;
};

Parsed parse_all(const std::string& text) {
  Diagnostics diagnostics;
  auto checked = check(parse(text, diagnostics), {}, diagnostics);
  EXPECT_TRUE(checked) << render(diagnostics, "test.esp", text);
  return {std::move(*checked), compiled(text)};
}

Derivation sampled(const GeneratorGraph& graph, std::uint32_t index) {
  RandomStream random({77, Purpose::test, 0, index});
  return sample(graph, random, 2000).derivation;
}

Model expand(const GeneratorGraph& graph, const Derivation& derivation, ExpandTo phase = ExpandTo::parts,
             const ExpandLimits& limits = {}) {
  Model model;
  Expander(graph, limits).expand(derivation, phase, model);
  return model;
}

// Same parts per gene, whatever the order in which genes are visited; numbers within float of the reference's doubles.
void expect_equal_models(const Model& model, const GeneratorGraph& graph, const reference::Expander& expected) {
  ASSERT_EQ(model.instances.size(), expected.parts.size());
  ASSERT_EQ(model.bones.size(), expected.bones.size());
  std::vector<bool> taken(expected.parts.size());
  double size = 1;
  for (const auto& part : expected.parts) size = std::max({size, glm::length(part.origin), glm::length(part.basis[0])});
  const auto distance = [&](const Instance& i, const reference::Part& p) {
    double d = glm::length(glm::dvec3(i.model_from_mesh.origin) - p.origin) + std::abs(i.top - p.top);
    for (int c = 0; c < 3; ++c) d += glm::length(glm::dvec3(i.model_from_mesh.basis[c]) - p.basis[c]);
    return d;
  };
  for (const Instance& instance : model.instances) {
    double best = 1e9;
    std::size_t at = 0;
    for (std::size_t i = 0; i < expected.parts.size(); ++i) {
      if (taken[i] || expected.parts[i].gene != instance.gene) continue;
      if (expected.parts[i].mesh != graph.meshes[instance.mesh].kind) continue;
      if (const double d = distance(instance, expected.parts[i]); d < best) best = d, at = i;
    }
    ASSERT_LT(best, 2e-4 * size) << "gene " << instance.gene;
    taken[at] = true;
  }
  std::vector<bool> bone_taken(expected.bones.size());
  for (const Bone& bone : model.bones) {
    bool found = false;
    for (std::size_t i = 0; i < expected.bones.size() && !found; ++i) {
      if (bone_taken[i] || expected.bones[i].gene != bone.gene) continue;
      found = glm::length(glm::dvec3(bone.from) - expected.bones[i].from) +
                  glm::length(glm::dvec3(bone.to) - expected.bones[i].to) < 2e-4 * size;
      if (found) bone_taken[i] = true;
    }
    ASSERT_TRUE(found) << "bone of gene " << bone.gene;
  }
}

void hold_against_reference(const std::string& text, std::uint32_t samples) {
  const Parsed parsed = parse_all(text);
  ASSERT_TRUE(parsed.graph);
  std::size_t parts = 0;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const Derivation derivation = sampled(*parsed.graph, i);
    reference::Expander expected(parsed.checked, *parsed.graph, derivation);
    expected.run();
    expect_equal_models(expand(*parsed.graph, derivation), *parsed.graph, expected);
    parts += expected.parts.size();
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(parts, samples / 2) << "the grammar made next to nothing";
}

TEST(Expand, AgreesWithTheReferenceOnShippedGrammars) {
  for (const char* name : {"spaceship.esp", "spaceship-2016.esp", "citadel.esp"}) {
    SCOPED_TRACE(name);
    hold_against_reference(test::text_of(test::grammar_folder() / name), 200);
  }
}

TEST(Expand, AgreesWithTheReferenceOnEveryConstruct) {
  hold_against_reference(R"(grammar everything 1
const step = 0.4
fn twice(a) = a + a
attr tall = 1.5
mesh trunk = cone(top: 0.6, sides: 16)
start S
rule S {
  wide ~ uniform(0.5, 1.5)
  let big = wide * 2
  size (wide, tall, 1)  emit box
  for k in 0..2 { turn y 120deg * k  move (step * k, 0.1, -0.2)  maybe 0.6 spawn A(wide, (1, k, 2)) }
  spawn B
}
rule A(w, v) when depth < 5 {
  spin ~ angle()
  n ~ integer(1, 4)
  bent ~ normal(10deg, 20deg, -30deg, 50deg)
  long ~ loguniform(0.1, 10)
  cut ~ chance(0.4)
  what ~ pick(box, 2: sphere, trunk)
  k ~ uniform((0.5, w / 4, 0.5), vec(twice(w)))
  turn (1, 0.5, big) spin  turn x bent
  resize k  move y scope.y / 2 + n * 0.1
  emit what
  if cut { move x long  emit wedge } else { pitch 20deg  emit pyramid }
  around z n + 2 { move x 1 + scope.z  scale (0.5, 1, 0.25)  emit cone(top: w / 3, sides: 8) }
  bone (0, -scope.y / 2, 0) -> v * 0.1
  choose {
    1: { scale y 0.5  move z length(v) * 0.1  maybe 0.5 spawn A(w * 0.9, cross(v, (0, 1, 0))) }
    2: { mirror x { move x clamp(w, 0.2, 0.7)  yaw 15deg  maybe 0.5 spawn A(w, v + 0.5) } }
    depth + 1: { reflect y  aim y toward (v.x, 1, v.z + n) by 0.5  emit cylinder }
  }
  maybe 0.3 spawn B
}
rule B when depth(A) < 3 {
  t ~ uniform(0, 1)
  aim z at (big, 2, mix(-1, 1, t))
  roll 360deg * t  forward 0.3  extrude 0.4 * t - 0.2
  emit sphere
  if childless and depth > 1 { emit box }
  maybe 0.4 spawn B
}
)", 400);
}

TEST(Expand, AgreesWithTheReferenceOnSplitAndComp) {
  hold_against_reference(R"(grammar boxes 1
start S
rule S {
  wide ~ uniform(0.5, 12)
  deep ~ uniform(0, 8)
  thin ~ uniform(0.3, 3)
  turn y 30deg  scale (1, 2, 0.5)  size (wide, 6, deep)
  spawn Cut(thin)
  comp { right: { extrude 0.2  emit wedge  spawn Cut(thin) } sides: { maybe 0.5 spawn Cut(2 * thin) } all: { emit quad } }
}
rule Cut(tile) when depth < 5 {
  share ~ uniform(0, 3)
  which ~ integer(0, 3)
  lean ~ uniform(-20deg, 20deg)
  split x {
    0.7: { emit box }
    ~share: { turn z lean  emit pyramid }
    repeat tile: { split y { 10%: { emit wedge } repeat tile: { emit cylinder  maybe 0.3 spawn Cut(tile * 0.7) } } }
    ~1: { bone (0, 0, 0) -> scope  emit sphere }
    20%: { if which > 0 { emit cone } }
  }
  split z { 1.5: { emit box } 2: { maybe 0.4 spawn Cut(tile) } 3 - which: { emit pyramid } }
  comp { top: { emit quad  split y { ~1: { emit leaf } ~2: {} } } bottom: { roll 10deg  extrude -0.3  emit box } }
}
)", 300);
}

// One gene whose split is cut from a scope of `size` along x; the lengths of the parts in order.
std::vector<float> split_of(const std::string& size, const std::string& parts) {
  const auto graph = compiled("grammar s 1\nstart S\nrule S { size (" + size + ", 1, 1)  split x { " + parts + " } }\n");
  std::vector<float> lengths;
  for (const Instance& i : expand(*graph, sampled(*graph, 0)).instances) lengths.push_back(i.model_from_mesh.basis[0].x);
  return lengths;
}

TEST(Expand, SplitSharesOutTheScope) {
  using testing::ElementsAre;
  const auto near = [](float x) { return testing::FloatNear(x, 1e-5f); };
  EXPECT_THAT(split_of("10", "2: { emit box } ~1: { emit box } 30%: { emit box } ~4: { emit box }"),
              ElementsAre(near(2), near(1), near(3), near(4)));
  // Fixed sizes too large shrink together; what has no length is not run.
  EXPECT_THAT(split_of("3", "2: { emit box } ~1: { emit box } 4: { emit box } repeat 1: { emit box }"),
              ElementsAre(near(1), near(2)));
  // Beside floating parts tiles keep their size; alone they stretch to fill, and there is at least one.
  EXPECT_THAT(split_of("5", "~1: { emit box } repeat 2: { emit box } ~3: { emit box }"),
              ElementsAre(near(0.25f), near(2), near(2), near(0.75f)));
  EXPECT_THAT(split_of("5", "1: { emit box } repeat 1.2: { emit box }"),
              ElementsAre(near(1), near(4.f / 3), near(4.f / 3), near(4.f / 3)));
  EXPECT_THAT(split_of("1", "repeat 7: { emit box }"), ElementsAre(near(1)));
  EXPECT_THAT(split_of("0.9", "~1: { emit box } repeat 1: { emit box }"), ElementsAre(near(0.9f)));
  // 0.3 = 3 * 0.1, whatever single precision makes of it.
  EXPECT_EQ(split_of("0.3", "repeat 0.1: { emit box } ~1: { }").size(), 3u);
}

TEST(Expand, TooManyTilesAreReported) {
  const auto graph = compiled("grammar s 1\nstart S\nrule S { size 1e6  split x { repeat 1: { emit box } } }\n");
  const Model model = expand(*graph, sampled(*graph, 0));
  EXPECT_EQ(model.instances.size(), 100'000u);
  EXPECT_TRUE(model.truncated);
}

TEST(Expand, FacesLookOutwardsInMirroredScopesToo) {
  for (const char* reflected : {"", "reflect x"}) {
    const auto graph = compiled(std::string("grammar c 1\nstart S\nrule S { size (2, 3, 4)  move (5, 6, 7)  ") +
                               reflected + "  comp { all: { extrude 0.5  emit box } } }\n");
    const Model model = expand(*graph, sampled(*graph, 0));
    ASSERT_EQ(model.instances.size(), 6u);
    float volume = 0;
    for (const Instance& i : model.instances) {
      EXPECT_GT(glm::dot(i.model_from_mesh.origin - Vec3(5, 6, 7), i.model_from_mesh.basis[2]), 0);
      volume += std::abs(glm::determinant(i.model_from_mesh.basis));
    }
    EXPECT_NEAR(volume, 2 * 0.5 * (6 + 8 + 12), 1e-4);
  }
}

// The three phases: bones of rules; their parts; details, with what open slots show instead of children.
TEST(Expand, EachPhaseAddsToTheOneBefore) {
  const auto graph = compiled(R"(grammar p 1
start S
rule S { spawn A otherwise detail Bud }
rule A {
  bend ~ uniform(-30deg, 30deg)
  turn z bend  bone (0, 0, 0) -> (0, 1, 0)
  emit cylinder  detail Bark
  move y 1  maybe 0.7 spawn A else detail Leaf otherwise detail Bud
}
detail Bark { emit box }
detail Leaf { emit leaf }
detail Bud { emit sphere }
)");
  const auto count = [&](const Model& model, MeshKind kind) {
    return std::count_if(model.instances.begin(), model.instances.end(),
                         [&](const Instance& i) { return graph->meshes[i.mesh].kind == kind; });
  };
  for (std::uint32_t i = 0; i < 20; ++i) {
    RandomStream random({5, Purpose::test, 0, i});
    const Derivation unfinished = sample(*graph, random, 4).derivation;  // at most 4 genes; the next slot stays open
    const Model bones = expand(*graph, unfinished, ExpandTo::bones), parts = expand(*graph, unfinished);
    const Model full = expand(*graph, unfinished, ExpandTo::full);
    EXPECT_TRUE(bones.instances.empty());
    const auto chain = static_cast<std::ptrdiff_t>(unfinished.size()) - 1;
    for (const Model* model : {&bones, &parts, &full}) ASSERT_EQ(std::ssize(model->bones), chain);
    EXPECT_EQ(std::ssize(parts.instances), chain);
    EXPECT_EQ(count(parts, MeshKind::cylinder), chain);
    EXPECT_EQ(count(full, MeshKind::cylinder), chain);
    EXPECT_EQ(count(full, MeshKind::box), chain);
    const bool open = std::count(unfinished.slots.begin(), unfinished.slots.end(), SlotState::open) > 0;
    EXPECT_EQ(count(full, MeshKind::sphere), open ? 1 : 0);
    EXPECT_EQ(count(full, MeshKind::leaf), open ? 0 : 1);
  }
}

TEST(Expand, TilesShareGenesButNotDetails) {
  const auto graph = compiled(R"(grammar t 1
start S
rule S { size (3, 1, 1)  split x { repeat 1: { spawn Tile } } }
rule Tile { k ~ uniform(0.1, 0.9)  resize y k  emit box  detail Look }
detail Look { j ~ uniform(0.1, 0.9)  resize y j  emit sphere }
)");
  const Derivation derivation = sampled(*graph, 0);
  EXPECT_EQ(derivation.size(), 2u);
  std::set<float> shared, own;
  for (const Instance& i : expand(*graph, derivation, ExpandTo::full).instances)
    (i.layer == Layer::detail ? own : shared).insert(i.model_from_mesh.basis[1].y);
  EXPECT_EQ(shared.size(), 1u);
  EXPECT_EQ(own.size(), 3u);
}

TEST(Expand, HandComputedBody) {
  const auto graph = compiled(test::text_of(test::grammar_folder() / "spaceship.esp"));
  RandomStream random({1, Purpose::test});
  Derivation ship = seedling(*graph, random);
  close_open_slots(*graph, ship, random);
  ASSERT_EQ(ship.size(), 2u);
  ship.draws = {1u << 31, 0, 1u << 30};  // k = (1.05, 0.6, 0.825)
  const Model model = expand(*graph, ship);
  ASSERT_EQ(model.instances.size(), 1u);
  const Frame& m = model.instances[0].model_from_mesh;
  EXPECT_FLOAT_EQ(m.basis[0].x, 1.05f);
  EXPECT_FLOAT_EQ(m.basis[1].y, 0.6f);
  EXPECT_FLOAT_EQ(m.basis[2].z, 0.825f);
  EXPECT_FLOAT_EQ(m.origin.z, 0.4125f);
  EXPECT_EQ(model.instances[0].gene, 1u);
}

TEST(Expand, MirroredCopiesShareTheirGeneAndFlip) {
  const auto graph = compiled(R"(grammar m 1
start S
rule S { emit box  mirror x { move x 2  spawn W } }
rule W { t ~ uniform(0, 1)  move y t  emit wedge  detail D }
detail D { r ~ uniform(0, 1)  move z r  emit sphere }
)");
  const Model model = expand(*graph, sampled(*graph, 1), ExpandTo::full);
  ASSERT_EQ(model.instances.size(), 5u);
  std::vector<Instance> spheres;
  for (const Instance& i : model.instances)
    if (i.layer == Layer::detail) spheres.push_back(i);
  ASSERT_EQ(spheres.size(), 2u);
  EXPECT_EQ(spheres[0].gene, 1u);
  EXPECT_EQ(spheres[1].gene, 1u);
  EXPECT_EQ(spheres[0].model_from_mesh.origin.x, -spheres[1].model_from_mesh.origin.x);
  EXPECT_EQ(spheres[0].model_from_mesh.origin.z, spheres[1].model_from_mesh.origin.z) << "details of copies are equal";
}

constexpr const char* kDetailed = R"(grammar d 1
start S
rule S { emit box  for k in 0..4 { move x k * 3  spawn A } }
rule A { t ~ uniform(1, 2)  size t  emit box as proxy  maybe 0.5 spawn A  for i in [1, 2] { detail D(i * t) } }
detail D(w) {
  r ~ uniform(0, w)
  for i in 0..floor(r * 2) { a ~ uniform(0, 1)  move (a, i, r)  emit sphere }
  choose { 1: { emit box } 2: { b ~ uniform(0, 1)  move y b  emit cone } }
}
)";

TEST(Expand, LayersTellProxiesFromDetails) {
  const auto graph = compiled(kDetailed);
  const Derivation derivation = sampled(*graph, 3);
  const Model parts = expand(*graph, derivation), full = expand(*graph, derivation, ExpandTo::full);
  EXPECT_TRUE(graph->uses_proxies);
  EXPECT_EQ(std::count_if(parts.instances.begin(), parts.instances.end(), in_full), 1) << "only the box of S";
  EXPECT_GT(std::count_if(full.instances.begin(), full.instances.end(), in_full), 20);
  EXPECT_EQ(std::count_if(full.instances.begin(), full.instances.end(), in_parts),
            std::count_if(parts.instances.begin(), parts.instances.end(), in_parts));
}

// What a subtree's details look like depends on its own genes, its address and the seed, not on its siblings.
TEST(Expand, EditsElsewhereReshuffleNoDetail) {
  const auto graph = compiled(kDetailed);
  Derivation before = sampled(*graph, 5);
  Derivation after = before;
  const auto last_gene = static_cast<std::uint32_t>(after.size() - 1);
  after.draws.back() ^= 0x80000000u;
  const auto collect = [&](const Derivation& d) {
    std::multiset<std::tuple<std::uint32_t, float, float, float>> places;
    for (const Instance& i : expand(*graph, d, ExpandTo::full).instances)
      if (i.layer == Layer::detail && i.gene != last_gene)
        places.insert({i.gene, i.model_from_mesh.origin.x, i.model_from_mesh.origin.y, i.model_from_mesh.origin.z});
    return places;
  };
  EXPECT_EQ(collect(before), collect(after));
  after.detail_seed ^= 1;
  EXPECT_NE(collect(before), collect(after));
}

TEST(Expand, SiblingsHaveTheirOwnDetails) {
  const auto graph = compiled(kDetailed);
  std::set<float> heights;
  int details = 0;
  for (const Instance& i : expand(*graph, sampled(*graph, 5), ExpandTo::full).instances)
    if (i.layer == Layer::detail && graph->meshes[i.mesh].kind == MeshKind::sphere) heights.insert(i.model_from_mesh.origin.z), ++details;
  EXPECT_GT(details, 10);
  EXPECT_GT(heights.size(), 5u);
}

TEST(Expand, OpenSlotsShowTheirOtherwise) {
  const auto graph = compiled(R"(grammar o 1
start S
rule S { maybe 0.5 spawn A else detail Empty otherwise detail Open  move x 5  maybe 0.5 spawn A else detail Empty }
rule A { emit box }
detail Empty { emit sphere }
detail Open { emit wedge }
)");
  RandomStream random({1, Purpose::test});
  Derivation d = seedling(*graph, random);
  const auto kinds = [&] {
    std::multiset<MeshKind> found;
    for (const Instance& i : expand(*graph, d, ExpandTo::full).instances) found.insert(graph->meshes[i.mesh].kind);
    return found;
  };
  EXPECT_EQ(kinds(), (std::multiset<MeshKind>{MeshKind::wedge, MeshKind::sphere})) << "without otherwise: the else";
  d.slots = {SlotState::empty, SlotState::empty};
  EXPECT_EQ(kinds(), (std::multiset<MeshKind>{MeshKind::sphere, MeshKind::sphere}));
}

TEST(Expand, BudgetsThinDetailsEvenly) {
  const auto graph = compiled(R"(grammar b 1
start S
rule S { for k in 0..3 { move x k * 10  detail Tree(12) } }
detail Tree(n) { emit box  if n > 0 { for i in [0, 1] { move y i + 1  detail Tree(n - 1) } } }
)");
  const Model model = expand(*graph, sampled(*graph, 0), ExpandTo::full, {.most_parts = 1000});
  EXPECT_TRUE(model.truncated);
  EXPECT_LE(model.instances.size(), 1000u);
  int per_tree[4] = {};
  for (const Instance& i : model.instances) ++per_tree[static_cast<int>(i.model_from_mesh.origin.x / 10 + 0.5f)];
  // First come, first served: no tree is more than one level ahead of another.
  for (const int count : per_tree) {
    EXPECT_GE(2 * count + 1, per_tree[0]);
    EXPECT_LE(count, 2 * per_tree[0] + 1);
  }
  EXPECT_FALSE(expand(*graph, sampled(*graph, 0), ExpandTo::full).truncated);
}

TEST(Expand, EndlessLoopsOfDetailsAreCut) {
  const auto graph = compiled(R"(grammar l 1
start S
rule S { detail D(1000) }
detail D(n) { for i in 1..n { for j in 1..n { for k in 1..n { move x 1 } } } }
)");
  EXPECT_TRUE(expand(*graph, sampled(*graph, 0), ExpandTo::full).truncated);
}

TEST(Expand, LoopsOfDetailsHaveManyTurns) {
  const auto graph = compiled("grammar l 1\nstart S\nrule S { detail D(3000) }\n"
                             "detail D(n) { for i in 1..n { move x 2  emit box } }\n");
  const Model model = expand(*graph, sampled(*graph, 0), ExpandTo::full);
  EXPECT_EQ(model.instances.size(), 3000u);
  EXPECT_FALSE(model.truncated);
}

// Every mirror doubles what stands below it: 2^40 copies of the last gene.
TEST(Expand, MirrorsWithinMirrorsAreCut) {
  for (const char* last : {"", "move y 1"}) {  // a child that takes its parent's place, and one that waits
    const auto graph = compiled(std::string("grammar m 1\nstart S\nrule S { spawn A }\n"
                                           "rule A when depth < 40 { move x 1  bone (0, 0, 0) -> (0, 1, 0)  "
                                           "mirror x { spawn A }  ") + last + " }\n");
    const Model model = expand(*graph, sampled(*graph, 0), ExpandTo::bones, {.most_copies = 5000});
    EXPECT_TRUE(model.truncated);
    EXPECT_EQ(model.bones.size(), 5000u);
  }
}

TEST(Expand, NumbersThatAreNoneStayOutOfModels) {
  const auto graph = compiled(R"(grammar n 1
material red = surface("#ff0000")
material blue = surface("#0000ff")
start S
rule S {
  w ~ uniform(-2, -1)
  emit cone(top: sqrt(w))
  paint mix(red, blue, sqrt(w))  emit box
}
)");
  const Model model = expand(*graph, sampled(*graph, 0));
  ASSERT_EQ(model.instances.size(), 1u);
  EXPECT_EQ(model.dropped, 1u);
  ASSERT_LT(model.instances[0].material, graph->materials.size());
  EXPECT_EQ(graph->materials[model.instances[0].material].color, Vec3(1, 0, 0));
}

TEST(Expand, BrokenNumbersEmitNothingAndSaySo) {
  const auto graph = compiled(R"(grammar n 1
start S
rule S { a ~ uniform(0, 1)  emit box  { size x -1 - a  emit box  spawn A } { move x 1 / (a - a)  emit box  spawn A } }
rule A { emit sphere }
)");
  const Model model = expand(*graph, sampled(*graph, 0));
  EXPECT_EQ(model.instances.size(), 1u);
  EXPECT_GE(model.dropped, 4u);
}

TEST(Expand, StartDrawsAreSeenEverywhere) {
  const auto graph = compiled(R"(grammar g 1
start S
rule S { spawn A  hue ~ uniform(2, 3)  let twice = hue * 2 }
rule A { size twice  emit box  detail D }
detail D { size hue  emit sphere }
)");
  const Model model = expand(*graph, sampled(*graph, 0), ExpandTo::full);
  ASSERT_EQ(model.instances.size(), 2u);
  EXPECT_EQ(model.instances[0].model_from_mesh.basis[0].x, 2 * model.instances[1].model_from_mesh.basis[0].x);
  EXPECT_GE(model.instances[1].model_from_mesh.basis[0].x, 2.0f);
}

}  // namespace
}  // namespace espalier
