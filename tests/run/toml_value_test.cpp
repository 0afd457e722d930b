#include "run/toml_value.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;

std::string error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(TomlValue, KnowsKindsAndPlaces) {
  const TomlValue root = parse_toml("a = 1\n[t]\nb = [true, 2.5, \"x\"]\n", "f.toml");
  ASSERT_NE(root.find("a"), nullptr);
  EXPECT_EQ(root.find("a")->integer, 1);
  EXPECT_EQ(root.find("a")->line, 1u);
  const TomlValue& b = *root.find("t")->find("b");
  EXPECT_EQ(b.line, 3u);
  EXPECT_EQ(b.column, 5u);
  ASSERT_EQ(b.items.size(), 3u);
  EXPECT_TRUE(b.items[0].boolean);
  EXPECT_EQ(b.items[1].real, 2.5);
  EXPECT_EQ(b.items[2].text, "x");
  EXPECT_EQ(root.find("none"), nullptr);
}

TEST(TomlValue, ErrorsNameFileLineAndColumn) {
  EXPECT_THAT(error_of([] { parse_toml("a = 1\nb = = 2\n", "f.toml"); }), HasSubstr("f.toml:2:"));
  EXPECT_THAT(error_of([] { parse_toml("a = 1\na = 2\n", "f.toml"); }), HasSubstr("f.toml:2:"));
  EXPECT_THAT(error_of([] { parse_toml("a = \"\xff\"\n", "f.toml"); }), HasSubstr("f.toml:1:"));
}

TEST(TomlValue, DeepNestingIsRefusedNotFollowed) {
  EXPECT_NE(error_of([] { parse_toml("a = " + std::string(5000, '[') + std::string(5000, ']'), "f"); }), "no error");
}

TEST(TomlValue, SettingsReplaceAddAndAppend) {
  TomlValue root = parse_toml("seed = 1\n[volume]\ncells = 5\n[[volume.mesh]]\nfile = \"a\"\n", "f");
  apply_setting(root, "seed=7");
  apply_setting(root, "search.population = 9");
  apply_setting(root, "volume.mesh.0.file=b/c d.obj");
  apply_setting(root, "volume.mesh.1.file=\"e.obj\"");
  apply_setting(root, "volume.mesh.1.fill=-2");
  EXPECT_EQ(root.find("seed")->integer, 7);
  EXPECT_EQ(root.find("seed")->line, 0u);
  const auto& meshes = root.find("volume")->find("mesh")->items;
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[0].find("file")->text, "b/c d.obj");
  EXPECT_EQ(meshes[1].find("file")->text, "e.obj");
  EXPECT_EQ(meshes[1].find("fill")->integer, -2);
  // The key is taken as written, blanks included.
  EXPECT_NE(root.find("search")->find("population "), nullptr);
}

TEST(TomlValue, SettingsThatMakeNoSenseAreErrors) {
  TomlValue root = parse_toml("a = 1\nl = [1]\n", "f");
  EXPECT_THAT(error_of([&] { apply_setting(root, "a"); }), HasSubstr("must be KEY=VALUE, got \"a\""));
  EXPECT_THAT(error_of([&] { apply_setting(root, "=3"); }), HasSubstr("must be KEY=VALUE"));
  EXPECT_THAT(error_of([&] { apply_setting(root, "a.b=3"); }), HasSubstr("nothing below 1"));
  EXPECT_THAT(error_of([&] { apply_setting(root, "l.5=3"); }), HasSubstr("\"5\" must be an index from 0 to 1"));
  EXPECT_THAT(error_of([&] { apply_setting(root, "a..b=3"); }), HasSubstr("empty"));
}

TEST(TomlValue, TextAndNumbersSurviveWritingAndReading) {
  for (const std::string text : {"plain", "C:\\new \"x\"", "tab\tline\n", "\xc3\xa9", ""}) {
    EXPECT_EQ(parse_toml("v = " + quote_toml(text), "f").find("v")->text, text);
  }
  for (const double number : {0.0, 1.0, -2.5, 0.1, 1e300, 1e-300, 123456789012345680.0,
                              std::numeric_limits<double>::denorm_min()}) {
    const TomlValue value = *parse_toml("v = " + format_toml(number), "f").find("v");
    EXPECT_EQ(value.kind, TomlValue::Kind::real);
    EXPECT_EQ(value.real, number);
  }
}

}  // namespace
}  // namespace espalier
