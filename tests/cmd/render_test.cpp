// espalier render from outside: what it takes, what it writes, what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cmd/child.h"
#include "run/fixtures.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::ChildResult;
using testing::read_text;
using testing::read_tree;
using testing::run_program;
using testing::TemporaryFolder;
using testing::write_pile;
using testing::write_text;

namespace fs = std::filesystem;

class RenderVerb : public ::testing::Test {
 protected:
  RenderVerb() {
    write_pile(folder_);
    EXPECT_EQ(espalier({"run", "scene.toml", "--out", "made", "--threads", "1"}).exit_code, 0);
  }

  ChildResult espalier(std::vector<std::string> arguments) {
    testing::ChildOptions options;
    options.folder = folder_.path();
    return run_program(arguments, scratch_ / "child", options);
  }
  ChildResult render(std::vector<std::string> options, const std::string& file = "made") {
    options.insert(options.begin(), {"render", file});
    return espalier(options);
  }
  std::string bytes(const std::string& name) { return read_text(folder_ / name); }

  /// Width, height and colour type (2: rgb, 6: rgba) of a PNG.
  std::vector<int> form(const std::string& name) {
    const std::string png = bytes(name);
    if (png.size() < 26) return {};
    const auto number = [&](std::size_t at) {
      int value = 0;
      for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(png[at + k]);
      return value;
    };
    return {number(16), number(20), png[25]};
  }

  TemporaryFolder folder_, scratch_;
};

TEST_F(RenderVerb, DrawsTheSameModelFromAnyFileOfIt) {
  const ChildResult first = render({"-o", "a.png", "--size", "64x48"});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.out, "wrote a.png\n");
  EXPECT_EQ(form("a.png"), (std::vector<int>{64, 48, 2}));
  for (const char* file : {"made/best.derivation.json", "made/best.glb", "made/best.obj", "made/best.png", "a.png"}) {
    EXPECT_EQ(render({"-o", "b.png", "--size", "64x48"}, file).exit_code, 0) << file;
    EXPECT_EQ(bytes("b.png"), bytes("a.png")) << file;
  }
  EXPECT_EQ(render({"-o", "b.png", "--size", "64x48"}, "made/alternatives/01.glb").exit_code, 0);
  EXPECT_NE(bytes("b.png"), bytes("a.png"));
}

TEST_F(RenderVerb, IsTheSameBytesForAnyNumberOfThreads) {
  for (const char* threads : {"1", "3"}) {
    const std::string name = std::string("t") + threads;
    const ChildResult made = render({"-o", name + ".png", "--turntable", "5", "--size", "40x30", "--frames",
                                     name, "--threads", threads, "--targets"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
  }
  EXPECT_EQ(bytes("t1.png"), bytes("t3.png"));
  EXPECT_EQ(read_tree(folder_ / "t1"), read_tree(folder_ / "t3"));
  EXPECT_EQ(read_tree(folder_ / "t1").size(), 5u);
}

TEST_F(RenderVerb, WritesStripsAndFrames) {
  EXPECT_EQ(render({"-o", "s.png", "--turntable", "8"}).exit_code, 0);
  EXPECT_EQ(form("s.png"), (std::vector<int>{1600, 600, 2}));
  EXPECT_EQ(render({"-o", "s.png", "--turntable", "6", "--size", "20x30", "--columns", "6"}).exit_code, 0);
  EXPECT_EQ(form("s.png"), (std::vector<int>{120, 30, 2}));
  const ChildResult frames = render({"--turntable", "12", "--frames", "f/g", "--size", "20x30", "--transparent"});
  EXPECT_EQ(frames.exit_code, 0) << frames.err;
  EXPECT_EQ(form("f/g/0012.png"), (std::vector<int>{20, 30, 6}));
  const ChildResult shorter = render({"--turntable", "6", "--frames", "f/g", "--size", "20x30"});
  EXPECT_EQ(shorter.exit_code, 2);
  EXPECT_THAT(shorter.err, HasSubstr("f/g/0007.png: is a frame of a longer turntable"));
}

TEST_F(RenderVerb, PicturesAreReproduced) {
  EXPECT_EQ(render({"-o", "a.png", "--size", "64x48", "--eye", "-3,2,5", "--fov", "40", "--targets"}).exit_code, 0);
  EXPECT_EQ(render({"-o", "s.png", "--size", "32x24", "--turntable", "3", "--light", "model", "--frames", "f",
                    "--background", "#102030", "--no-ground", "--view", "parts", "--samples", "4"}).exit_code, 0);
  EXPECT_EQ(render({"-o", "p.png", "--size", "64x48", "--elevation", "90", "--tall", "6"}).exit_code, 0);
  for (const char* file : {"a.png", "s.png", "f/0002.png", "p.png"}) {
    const ChildResult again = espalier({"reproduce", file});
    EXPECT_EQ(again.exit_code, 0) << again.out << again.err;
    EXPECT_THAT(again.out, HasSubstr("identical"));
  }
  EXPECT_THAT(espalier({"inspect", "a.png"}).out, HasSubstr("eye = [-3.0, 2.0, 5.0]"));
}

TEST_F(RenderVerb, AttributesAreSetAnew) {
  EXPECT_EQ(render({"-o", "a.png", "--size", "64x48"}).exit_code, 0);
  EXPECT_EQ(render({"-o", "b.png", "--size", "64x48", "-D", "widest=3"}).exit_code, 0);
  EXPECT_NE(bytes("a.png"), bytes("b.png"));
  EXPECT_EQ(render({"-o", "c.png", "--size", "64x48", "--grammar", "pile.esp"}, "made/best.derivation.json")
                .exit_code, 0);
  EXPECT_EQ(render({"-o", "x.png", "-D", "widets=3"}).exit_code, 2);
}

TEST_F(RenderVerb, BadArgumentsAreToldAndWriteNothing) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> bad = {
      {{}, "nothing to write"},
      {{"-o", "x.jpg"}, "x.jpg: render writes .png"},
      {{"-o", "x.png", "--size", "12"}, "--size must be WIDTHxHEIGHT, got \"12\""},
      {{"-o", "x.png", "--size", "0x5"}, "--size must be from 1 to 16384, got 0"},
      {{"-o", "x.png", "--size", "16384x16384"}, "--size must be at most"},
      {{"-o", "x.png", "--size", "10x10x10"}, "--size must be WIDTHxHEIGHT"},
      {{"-o", "x.png", "--elevation", "91"}, "--elevation must be from -90 to 90, got 91"},
      {{"-o", "x.png", "--azimuth", "nan"}, "--azimuth must be"},
      {{"-o", "x.png", "--eye", "1,2"}, "--eye must be x,y,z in metres, got \"1,2\""},
      {{"-o", "x.png", "--eye", "1,2,inf"}, "--eye must be"},
      {{"-o", "x.png", "--at", "1,2,3"}, "--at needs --eye"},
      {{"-o", "x.png", "--eye", "1,2,3", "--at", "1,2,3"}, "--eye and --at must differ"},
      {{"-o", "x.png", "--eye", "1,2,3", "--azimuth", "3"}, "--eye and --azimuth exclude each other"},
      {{"-o", "x.png", "--fov", "40", "--tall", "3"}, "--fov and --tall exclude each other"},
      {{"-o", "x.png", "--fov", "180"}, "--fov must be from 0.1 to 170"},
      {{"-o", "x.png", "--tall", "0"}, "--tall must be"},
      {{"-o", "x.png", "--samples", "0"}, "--samples must be from 1 to 256, got 0"},
      {{"-o", "x.png", "--samples", "-1"}, "--samples"},
      {{"-o", "x.png", "--background", "red"}, "--background must be a colour"},
      {{"-o", "x.png", "--background", "#ffffff", "--transparent"}, "exclude each other"},
      {{"-o", "x.png", "--view", "half"}, "--view must be full, parts or bones, got \"half\""},
      {{"-o", "x.png", "--view", "bones"}, "makes no bones"},
      {{"-o", "x.png", "--columns", "3"}, "--columns needs --turntable"},
      {{"-o", "x.png", "--light", "model"}, "--light needs --turntable"},
      {{"-o", "x.png", "--frames", "x"}, "--frames needs --turntable"},
      {{"-o", "x.png", "--turntable", "1"}, "--turntable must be from 2 to 3600, got 1"},
      {{"-o", "x.png", "--turntable", "4", "--columns", "5"}, "--columns must be at most the 4 frames, got 5"},
      {{"-o", "x.png", "--turntable", "0"}, "--turntable must be from 2 to 3600, got 0"},
      {{"-o", "nowhere/x.png"}, "nowhere/x.png: the folder"},
      {{"-o", "f/0001.png", "--turntable", "3", "--frames", "f"}, "f/0001.png: is one of the frames"},
      {{"-o", "x.png", "--turntable", "400", "--size", "2000x2000"}, "a strip of 400 frames must have at most"},
      {{"-o", "none/x.png", "--size", "8x8"}, "none/x.png"},
  };
  const auto before = read_tree(folder_.path());
  for (const auto& [options, message] : bad) {
    const ChildResult result = render(options);
    EXPECT_EQ(result.exit_code, 2) << ::testing::PrintToString(options);
    EXPECT_THAT(result.err, HasSubstr(message)) << ::testing::PrintToString(options);
  }
  EXPECT_EQ(read_tree(folder_.path()), before);
}

TEST_F(RenderVerb, FilesWithoutGenesAreToldAbout) {
  EXPECT_EQ(espalier({"sample", "pile.esp", "-n", "2", "--out", "drawn"}).exit_code, 0);
  fs::create_directory(folder_ / "empty");
  write_text(folder_ / "noise.png", "noise");
  fs::copy(folder_ / "made/best.glb", folder_ / "lost.glb");  // its settings' folder is another now
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"drawn", "drawn: holds many samples; name one of its files"},
      {"empty", "empty: is no folder of a run"},
      {"none.json", "none.json"},
      {"noise.png", "noise.png: holds no provenance"},
      {"lost.glb", "lost.glb: holds no genes, and no .derivation.json"},
  };
  for (const auto& [file, message] : bad) {
    const ChildResult result = render({"-o", "x.png", "--size", "8x8"}, file);
    EXPECT_EQ(result.exit_code, 2) << file;
    EXPECT_THAT(result.err, HasSubstr(message));
  }
  EXPECT_EQ(render({"-o", "x.png", "--size", "8x8"}, "drawn/02.derivation.json").exit_code, 0);
  const ChildResult targets = render({"-o", "y.png", "--targets"}, "drawn/02.derivation.json");
  EXPECT_EQ(targets.exit_code, 2);
  EXPECT_THAT(targets.err, HasSubstr("--targets needs a file of a run"));
  EXPECT_FALSE(fs::exists(folder_ / "y.png"));
}

}  // namespace
}  // namespace espalier
