#include "score/gauge.h"

#include <algorithm>
#include <functional>
#include <memory>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "model/parts.h"
#include "score/score_models.h"

namespace espalier {
namespace {

using namespace test;

PerMeasure<bool> all_measures() {
  PerMeasure<bool> wanted;
  for (const Measure measure : kAllMeasures) wanted[measure] = true;
  return wanted;
}

PerMeasure<double> measured(const Derivation& derivation, const Model& model, VolumeView view = VolumeView::full) {
  static const MeshTable meshes = test_meshes();
  Gauge::Scratch scratch;
  PerMeasure<double> values;
  Gauge(meshes, view, all_measures()).measure(derivation, model, scratch, values);
  return values;
}

/// A tree of nodes, as the reference walks it.
struct Node {
  std::vector<Node> children;
};

std::size_t size_of(const Node& node) {
  std::size_t n = 1;
  for (const Node& child : node.children) n += size_of(child);
  return n;
}

std::size_t depth_of(const Node& node) {
  std::size_t deepest = 0;
  for (const Node& child : node.children) deepest = std::max(deepest, 1 + depth_of(child));
  return deepest;
}

void collect_balances(const Node& node, std::vector<double>& balances) {
  std::vector<double> sizes;
  for (const Node& child : node.children) {
    sizes.push_back(static_cast<double>(size_of(child)));
    collect_balances(child, balances);
  }
  std::sort(sizes.begin(), sizes.end());
  if (sizes.size() > 1) balances.push_back(sizes.front() / sizes.back());
}

double balance_of(const Node& node) {
  std::vector<double> balances;
  collect_balances(node, balances);
  double sum = 0;
  for (const double balance : balances) sum += balance;
  return balances.empty() ? 1 : sum / static_cast<double>(balances.size());
}

void flatten(const Node& node, Derivation& derivation) {
  const std::size_t at = derivation.genes.size();
  derivation.genes.emplace_back();
  for (const Node& child : node.children) flatten(child, derivation);
  derivation.genes[at].genes_below = static_cast<std::uint32_t>(derivation.genes.size() - at - 1);
}

Derivation flat(const Node& node) {
  Derivation derivation;
  flatten(node, derivation);
  return derivation;
}

Node random_tree(Dice& dice, std::uint32_t nodes) {
  Node node;
  for (std::uint32_t left = nodes - 1; left > 0;) {
    const std::uint32_t share = 1 + dice.below(left);
    node.children.push_back(random_tree(dice, share));
    left -= share;
  }
  return node;
}

TEST(Gauge, DepthAndBalanceByHand) {
  const Node leaf, pair = {{leaf, leaf}}, chain = {{{{leaf}}}};
  const auto of = [](const Node& node) { return measured(flat(node), Model()); };
  EXPECT_EQ(of(leaf)[Measure::genes], 1);
  EXPECT_EQ(of(leaf)[Measure::depth], 0);
  EXPECT_EQ(of(leaf)[Measure::balance], 1);
  EXPECT_EQ(of(chain)[Measure::depth], 2);
  EXPECT_EQ(of(chain)[Measure::balance], 1);  // nothing branches
  EXPECT_EQ(of(pair)[Measure::balance], 1);
  // Children of 3, 1 and 3 genes: 1/3; in the first and last of these two leaves each: 1. Mean of 1/3, 1, 1.
  const Node mixed = {{pair, leaf, pair}};
  EXPECT_EQ(of(mixed)[Measure::genes], 8);
  EXPECT_EQ(of(mixed)[Measure::depth], 2);
  EXPECT_DOUBLE_EQ(of(mixed)[Measure::balance], (1.0 / 3 + 1 + 1) / 3);
  // A chain of 3 beside a leaf: 1/3.
  EXPECT_DOUBLE_EQ(of(Node{{chain, leaf}})[Measure::balance], 1.0 / 3);
}

RC_GTEST_PROP(Gauge, DepthAndBalanceAgreeWithTheReference, (std::uint32_t number)) {
  Dice dice(number);
  const Node tree = random_tree(dice, 1 + dice.below(200));
  const PerMeasure<double> values = measured(flat(tree), Model());
  RC_ASSERT(values[Measure::genes] == static_cast<double>(size_of(tree)));
  RC_ASSERT(values[Measure::depth] == static_cast<double>(depth_of(tree)));
  RC_ASSERT(std::abs(values[Measure::balance] - balance_of(tree)) < 1e-12);
}

TEST(Gauge, AVeryLongChainIsNoDeepRecursion) {
  Derivation chain;
  chain.genes.resize(200'000);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    chain.genes[i].genes_below = static_cast<std::uint32_t>(chain.size() - 1 - i);
  }
  EXPECT_EQ(measured(chain, Model())[Measure::depth], 199'999);
}

Model random_model(Dice& dice) {
  Model model;
  const std::uint32_t parts = dice.below(12);
  for (std::uint32_t i = 0; i < parts; ++i) {
    const float size = dice.chance(0.2) ? 20.0f : 2.0f;
    Instance instance = part(static_cast<std::uint16_t>(dice.below(kShapes)),
                             random_frame(dice, Vec3(-5), Vec3(5), size));
    instance.top = dice.chance(0.2) ? 0 : dice.between(0, 3);
    instance.layer = static_cast<Layer>(dice.below(3));
    model.instances.push_back(instance);
  }
  return model;
}

/// By the way that files are written: every triangle of every part, baked.
struct Reference {
  double parts = 0, triangles = 0, volume = 0;
  Bounds box;

  Reference(const Model& model, bool full) {
    const Parts collected = collect_parts(model, test_meshes(), full);
    for (const Part& part : collected.parts) {
      const espalier::Shape& shape = collected.shapes[part.shape];
      const Mesh mesh = baked(shape, part.model_from_shape);
      ++parts;
      triangles += static_cast<double>(shape.mesh.triangles.size());
      if (!shape.open) volume += std::abs(espalier::volume(mesh));
      box.add(bounds(mesh));
    }
  }
  double extent(int axis) const { return box.empty() ? 0 : static_cast<double>(box.max[axis] - box.min[axis]); }
};

bool near(double a, double b) { return std::abs(a - b) <= 1e-5 * std::max(1.0, std::abs(b)); }

RC_GTEST_PROP(Gauge, PartsAgreeWithWhatFilesHold, (std::uint32_t number, bool full)) {
  Dice dice(number);
  const Model model = random_model(dice);
  const PerMeasure<double> values = measured({}, model, full ? VolumeView::full : VolumeView::parts);
  const Reference expected(model, full);
  RC_ASSERT(values[Measure::parts] == expected.parts);
  RC_ASSERT(values[Measure::triangles] == expected.triangles);
  RC_ASSERT(near(values[Measure::volume], expected.volume));
  RC_ASSERT(near(values[Measure::height], expected.extent(1)));
  RC_ASSERT(near(values[Measure::spread], std::max(expected.extent(0), expected.extent(2))));
}

TEST(Gauge, PartsByHand) {
  Model model;
  model.instances = {part(kBox, box_frame(Vec3(0), Vec3(2, 3, 1))),
                     part(kBox, box_frame(Vec3(1, -1, 0), Vec3(2, 1, 4)))};
  const PerMeasure<double> values = measured({}, model);
  EXPECT_EQ(values[Measure::parts], 2);
  EXPECT_EQ(values[Measure::triangles], 24);
  EXPECT_EQ(values[Measure::height], 4);
  EXPECT_EQ(values[Measure::spread], 4);
  EXPECT_EQ(values[Measure::volume], 6 + 8);  // the overlap counts twice
}

TEST(Gauge, OpenMeshesAndNoModelHaveNoVolume) {
  Model model;
  EXPECT_EQ(measured({}, model)[Measure::height], 0);
  EXPECT_EQ(measured({}, model)[Measure::spread], 0);
  model.instances = {part(kQuad, box_frame(Vec3(0), Vec3(2, 3, 1)))};
  EXPECT_EQ(measured({}, model)[Measure::volume], 0);
  EXPECT_EQ(measured({}, model)[Measure::height], 3);
}

TEST(Gauge, WhatNoFileHoldsIsNotMeasured) {
  Model model;
  model.instances = {part(kBox, box_frame(Vec3(0), Vec3(1))), part(kBox, box_frame(Vec3(0), Vec3(1e20f)))};
  const PerMeasure<double> values = measured({}, model);
  EXPECT_EQ(values[Measure::parts], 1);
  EXPECT_EQ(values[Measure::height], 1);
}

TEST(Gauge, AsksForAModelOnlyWhereItMust) {
  PerMeasure<bool> wanted;
  wanted[Measure::genes] = wanted[Measure::depth] = wanted[Measure::balance] = true;
  EXPECT_FALSE(Gauge(test_meshes(), VolumeView::full, wanted).wants_model());
  wanted[Measure::parts] = true;
  EXPECT_TRUE(Gauge(test_meshes(), VolumeView::full, wanted).wants_model());
}

}  // namespace
}  // namespace espalier
