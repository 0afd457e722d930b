// Image files and made materials on their way through samples, inputs, reproduce and error messages.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "io/file.h"
#include "io/mesh_import.h"
#include "io/png.h"
#include "run/derivation_file.h"
#include "run/fixtures.h"
#include "run/grammar_file.h"
#include "run/reproduce.h"
#include "run/sample.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

constexpr const char* kGrammar = R"(grammar painted 1
material wall = surface("#ffffff", texture: image_texture("../pictures/wall.png"))
start S
rule S {
  wet ~ uniform(0, 1)
  paint wall  emit box
  paint surface("#ffffff", roughness: wet, texture: noise_texture(warp: wet))  move x 1.2  emit box
}
)";

void write_painted(const TemporaryFolder& folder) {
  write_text(folder / "grammars/painted.esp", kGrammar);
  const std::vector<std::uint8_t> pixels = {250, 10, 10, 255, 10, 10, 250, 255};
  write_text(folder / "pictures/wall.png", encode_png_with_alpha(2, 1, pixels));
}

SampleRequest request_in(const TemporaryFolder& folder) {
  SampleRequest request;
  request.grammar = "grammars/painted.esp";
  request.folder = folder.path();
  request.count = 2;
  request.picture = {64, 48};
  return request;
}

TEST(RunTextures, ImagesAreInputsAndFilesAreMadeAgainFromThem) {
  const TemporaryFolder folder;
  write_painted(folder);
  AssimpMeshSource source;
  const auto executor = make_serial_executor();
  write_samples(request_in(folder), folder / "out", source, *executor);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/inputs/pictures/wall.png"));
  std::filesystem::remove_all(folder / "grammars");
  std::filesystem::remove_all(folder / "pictures");
  for (const char* name : {"out/01.glb", "out/02.png"})
    EXPECT_TRUE(reproduce(folder / name, "", source, *executor).identical()) << name;
  export_derivation({folder / "out/01.derivation.json", "", {}, folder / "out/model.obj"}, source, *executor);
  for (const char* name : {"out/model.obj", "out/model.mtl", "out/model-texture-2.png"})
    EXPECT_TRUE(reproduce(folder / name, "", source, *executor).identical()) << name;
  EXPECT_EQ(read_file(folder / "out/model-texture-1.png"), read_file(folder / "out/inputs/pictures/wall.png"));
}

TEST(RunTextures, AMissingOrDamagedImageIsNamedWithItsPlace) {
  const TemporaryFolder folder;
  write_painted(folder);
  const auto message = [&] {
    try {
      load_textures(load_grammar(folder / "grammars/painted.esp", {}));
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(), "");
  write_text(folder / "pictures/wall.png", "no picture");
  EXPECT_THAT(message(), HasSubstr("painted.esp:2:45: error[E0908]"));
  EXPECT_THAT(message(), HasSubstr("neither PNG nor JPG"));
  std::filesystem::remove(folder / "pictures/wall.png");
  EXPECT_THAT(message(), HasSubstr("painted.esp:2:45: error[E0908]"));
  EXPECT_THAT(message(), HasSubstr("wall.png"));
}

}  // namespace
}  // namespace espalier
