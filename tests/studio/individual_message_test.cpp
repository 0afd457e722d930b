#include "studio/individual_message.h"

#include <cmath>
#include <cstring>
#include <filesystem>

#include <gmock/gmock.h>

#include "breed/newcomer.h"
#include "model/expand.h"
#include "model/parts.h"
#include "run/grammar_file.h"
#include "studio/message_writer.h"

namespace espalier::studio {
namespace {

/// Of a 16-bit float, digit by digit.
double half(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 31, fraction = bits & 1023;
  const double value = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return bits & 0x8000 ? -value : value;
}

template <class T>
T at(const std::string& bytes, std::size_t place) {
  T value;
  std::memcpy(&value, bytes.data() + place, sizeof(T));
  return value;
}

/// One part, as a page reads it.
struct ReadPart {
  DVec3 origin;
  double axes[9];
  double top;
  std::uint16_t mesh, material;
};

ReadPart part_of(const std::string& bytes, std::size_t i) {
  const std::size_t record = 64 + 32 * i;
  ReadPart part;
  for (int k = 0; k < 3; ++k) {
    const std::size_t axis = 4 * static_cast<std::size_t>(k);
    part.origin[k] = at<float>(bytes, 32 + axis) +
                     at<std::uint16_t>(bytes, record + axis / 2) / 65535.0 * at<float>(bytes, 44 + axis);
  }
  for (std::size_t k = 0; k < 9; ++k) part.axes[k] = half(at<std::uint16_t>(bytes, record + 6 + 2 * k)) * at<float>(bytes, 56);
  part.top = half(at<std::uint16_t>(bytes, record + 24));
  part.mesh = at<std::uint16_t>(bytes, record + 26);
  part.material = at<std::uint16_t>(bytes, record + 28);
  return part;
}

Instance box_at(Vec3 origin, float side) {
  Instance instance;
  instance.model_from_mesh = {Mat3(side), origin};
  return instance;
}

TEST(IndividualMessage, EveryPartOfEveryGrammarIsReadBackToWhatItsDigitsHold) {
  for (const char* name : {"gentree", "arboretum", "tree-v1", "spaceship", "city", "cathedral"}) {
    SCOPED_TRACE(name);
    const LoadedGrammar grammar = load_grammar(std::string(ESPALIER_SOURCE_DIR) + "/grammars/" + name + ".esp", {});
    RandomStream random({7, Purpose::sample, 0, 1, 0});
    Model model;
    Expander(*grammar.graph, {.most_parts = 20'000}).expand(draw_newcomer(*grammar.graph, random), ExpandTo::full, model);
    const IndividualModel made = individual_model(*grammar.graph, model);
    EXPECT_FALSE(made.truncated);
    double longest = 0;
    for (const Instance& instance : model.instances) {
      if (!is_shown(instance, true)) continue;
      for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) longest = std::max<double>(longest, std::abs(instance.model_from_mesh.basis[c][r]));
      }
    }
    std::size_t parts = 0;
    for (const Instance& instance : model.instances) {
      if (!is_shown(instance, true)) continue;
      const ReadPart read = part_of(made.bytes, parts++);
      const Frame& frame = instance.model_from_mesh;
      for (int k = 0; k < 3; ++k) {
        const double side = at<float>(made.bytes, 44 + 4 * static_cast<std::size_t>(k));
        ASSERT_NEAR(read.origin[k], frame.origin[k], 0.51 * side / 65535 + 1e-6 * std::abs(frame.origin[k]));
        for (int r = 0; r < 3; ++r) {
          const double axis = frame.basis[k][r];
          ASSERT_NEAR(read.axes[3 * k + r], axis, std::abs(axis) / 2000 + longest * 0x1p-24);
        }
      }
      ASSERT_NEAR(read.top, instance.top, instance.top / 2000 + 1e-7);
      ASSERT_EQ(read.mesh, instance.mesh);
      ASSERT_EQ(read.material, instance.material);
    }
    EXPECT_GT(parts, 10u);
    EXPECT_EQ(at<std::uint32_t>(made.bytes, 24), parts);
    const std::uint32_t materials = at<std::uint32_t>(made.bytes, 28);
    EXPECT_EQ(materials, grammar.graph->materials.size() + model.materials.size());
    EXPECT_EQ(made.bytes.size(), 64 + 32 * parts + MessageWriter::kMaterialBytes * materials);
  }
}

TEST(IndividualMessage, HoldsWhatIsSeenAndNothingElse) {
  Model model;
  for (const Layer layer : {Layer::rule, Layer::proxy, Layer::detail}) {
    model.instances.push_back(box_at({static_cast<float>(model.instances.size()), 0, 0}, 1));
    model.instances.back().layer = layer;
  }
  model.instances.push_back(box_at({std::nanf(""), 0, 0}, 1));
  model.instances.push_back(box_at({0, 0, 0}, INFINITY));
  const IndividualModel made = individual_model(GeneratorGraph{}, model);
  ASSERT_EQ(at<std::uint32_t>(made.bytes, 24), 2u);
  EXPECT_EQ(part_of(made.bytes, 0).origin, DVec3(0));
  EXPECT_EQ(part_of(made.bytes, 1).origin, DVec3(2, 0, 0));
}

TEST(IndividualMessage, ExtremesStayNumbers) {
  const GeneratorGraph graph;
  EXPECT_EQ(individual_model(graph, Model{}).bytes.size(), 64u);
  for (const float side : {0.0f, 1e-44f, 1e18f}) {
    Model model;
    model.instances.push_back(box_at({-1e18f, 3, 0}, side));
    model.instances.push_back(box_at({1e18f, 3, 1e-44f}, side));
    model.instances.back().top = side > 1 ? INFINITY : 1e9f;
    const IndividualModel made = individual_model(graph, model);
    for (std::size_t i = 0; i < 2; ++i) {
      const ReadPart read = part_of(made.bytes, i);
      EXPECT_NEAR(read.origin.x, i == 0 ? -1e18 : 1e18, 1e12);
      EXPECT_EQ(read.origin.y, 3);
      for (int k = 0; k < 9; ++k) EXPECT_NEAR(read.axes[k], k % 4 == 0 ? side : 0, side / 2000);
      EXPECT_TRUE(std::isfinite(read.top));
    }
  }
}

TEST(IndividualMessage, SaysWhoseItIs) {
  Model model;
  model.instances.push_back(box_at({1, 2, 3}, 4));
  const std::string nobody = individual_model(GeneratorGraph{}, model).bytes;
  const std::string bytes = addressed(nobody, {3, 12, 5, 0x8000'0001});
  EXPECT_EQ(bytes.substr(0, 8), std::string("ESPI\2\0\0\0", 8));
  EXPECT_EQ(bytes.substr(24), nobody.substr(24));
  const std::uint32_t words[] = {3, 12, 5, 0x8000'0001};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(at<std::uint32_t>(bytes, 8 + 4 * i), words[i]);
}

}  // namespace
}  // namespace espalier::studio
