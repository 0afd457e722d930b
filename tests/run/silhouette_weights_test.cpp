#include "run/silhouette_weights.h"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "io/file.h"
#include "io/png.h"
#include "run/fixtures.h"

namespace espalier {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

constexpr std::int32_t kFull = WeightImage::kFull;

/// One row of greys.
std::string greys(const TemporaryFolder& folder, const std::string& name, const std::vector<std::uint8_t>& values) {
  std::vector<std::uint8_t> rgb;
  for (const std::uint8_t v : values) rgb.insert(rgb.end(), 3, v);
  write_file(folder / name, encode_png(static_cast<std::uint32_t>(values.size()), 1, rgb, "t", ""));
  return folder / name;
}

/// One row of weights.
std::string floats(const TemporaryFolder& folder, const std::string& name, const std::vector<float>& values) {
  std::string bytes = "Pf\n" + std::to_string(values.size()) + " 1\n-1\n";
  const std::size_t header = bytes.size();
  bytes.resize(header + 4 * values.size());
  std::memcpy(bytes.data() + header, values.data(), 4 * values.size());
  write_file(folder / name, bytes);
  return folder / name;
}

TEST(SilhouetteWeights, DarkIsWantedAndLightIsNot) {
  const TemporaryFolder folder;
  const SilhouetteWeights w = load_weights({{greys(folder, "a.png", {0, 255, 128, 51}), {}}}, {});
  EXPECT_EQ(w.full, 1);
  EXPECT_THAT(w.image.degrees, ElementsAre(kFull, -kFull, 0, 39321));  // 0.6
}

TEST(SilhouetteWeights, TwoImagesAddUp) {
  const TemporaryFolder folder;
  const std::string want = greys(folder, "w.png", {0, 255, 255, 0, 204}),
                    avoid = greys(folder, "a.png", {255, 0, 255, 0, 255});
  const auto both = load_weights({{want, ImageMeaning::want}, {avoid, ImageMeaning::avoid}}, {});
  EXPECT_THAT(both.image.degrees, ElementsAre(kFull, -kFull, 0, 0, 13107));
  const auto only = load_weights({{want, ImageMeaning::want}}, {});
  EXPECT_THAT(only.image.degrees, ElementsAre(kFull, 0, 0, kFull, 13107)) << "what is not wanted does not matter";
}

TEST(SilhouetteWeights, WeightsAreMeasuredByTheGreatest) {
  const TemporaryFolder folder;
  const auto w = load_weights({{floats(folder, "a.pfm", {4, -1, 0, 0.5f, -4}), {}}}, {});
  EXPECT_EQ(w.full, 4);
  EXPECT_THAT(w.image.degrees, ElementsAre(kFull, -16384, 0, 8192, -kFull));
  const auto small = load_weights({{floats(folder, "b.pfm", {1e-4f, -1e-4f}), {}}}, {});
  EXPECT_FLOAT_EQ(static_cast<float>(small.full), 1e-4f);
  EXPECT_THAT(small.image.degrees, ElementsAre(kFull, -kFull));
  const auto none = load_weights({{floats(folder, "c.pfm", {0, 0}), {}}}, {});
  EXPECT_EQ(none.full, 1);
}

TEST(SilhouetteWeights, WeightsAndDrawingsMix) {
  const TemporaryFolder folder;
  const auto w = load_weights({{floats(folder, "w.pfm", {2, 0}), ImageMeaning::want},
                               {greys(folder, "a.png", {255, 0}), ImageMeaning::avoid}}, {});
  EXPECT_EQ(w.full, 2);
  EXPECT_THAT(w.image.degrees, ElementsAre(kFull, -32767)) << "a black pixel is one pixel, half of 2";
}

TEST(SilhouetteWeights, SizesMustAgreeUnlessOneIsGiven) {
  const TemporaryFolder folder;
  const std::vector<ImageLayer> layers = {{greys(folder, "w.png", {0, 0, 255, 255}), ImageMeaning::want},
                                          {greys(folder, "a.png", {255, 0}), ImageMeaning::avoid}};
  const auto w = load_weights(layers, std::array<std::uint32_t, 2>{2, 1});
  EXPECT_THAT(w.image.degrees, ElementsAre(kFull, -kFull));
  try {
    load_weights(layers, {});
    FAIL();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("a.png: must have the size of"));
    EXPECT_THAT(e.what(), HasSubstr("4 x 1 pixels"));
  }
}

TEST(SilhouetteWeights, NegativeValuesMeanNothingWhereThereAreTwoImages) {
  const TemporaryFolder folder;
  try {
    load_weights({{floats(folder, "w.pfm", {1, 2, -3}), ImageMeaning::want}}, {});
    FAIL();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("w.pfm: a value must be >= 0 in an image of what is wanted, got -3 in column 2"));
  }
}

}  // namespace
}  // namespace espalier
