// What runs that go on do with the folder they find: they take nothing on trust, and remove only what is theirs.
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/resume_point.h"
#include "run/resuming.h"

namespace espalier {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::read_text;
using testing::Telling;
using testing::write_text;

namespace fs = std::filesystem;

constexpr const char* kLeft = "out.partial-aaaaaa";

class ResumingFolders : public testing::Resuming {
 protected:
  ResumingFolders() { leave(kLeft, 12); }
  std::string at(const std::string& name) const { return folder_ / (std::string(kLeft) + "/" + name); }

  template <typename Change>
  void forge(const Change& change) {
    Checkpoint checkpoint = read_checkpoint(at("checkpoint"));
    change(checkpoint);
    write_text(at("checkpoint"), encode_checkpoint(checkpoint));
  }
};

TEST_F(ResumingFolders, AlwaysKeepCheckpoints) {
  for (const double seconds : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(error_of({.folder = "out", .checkpoint_seconds = seconds}), HasSubstr("must be above 0, got "));
    EXPECT_THAT(error_of({.folder = "whole", .budget = {.generations = 50}, .checkpoint_seconds = seconds}),
                HasSubstr("must be above 0"));
  }
  EXPECT_EQ(step_in("whole"), 40u);
  EXPECT_TRUE(fs::exists(at("checkpoint")));
}

TEST_F(ResumingFolders, KeepWhatNoRunWrote) {
  write_text(at("notes"), "dear");
  write_text(at("inputs/mine/notes"), "dear");
  write_text(at("alternatives/notes"), "dear");
  write_text(at("alternatives/01.png"), "stale");
  Telling observer;
  resume({.folder = "out"}, observer);
  EXPECT_THAT(observer.warnings, AllOf(HasSubstr("holds what no run wrote, 3 in all: alternatives/notes; it comes"),
                                       HasSubstr("into " + (folder_ / "out"))));
  for (const char* name : {"out/notes", "out/inputs/mine/notes", "out/alternatives/notes"}) {
    EXPECT_EQ(read_text(folder_ / name), "dear") << name;
    fs::remove(folder_ / name);
  }
  testing::expect_same_results(folder_ / "out", folder_ / "whole");
}

TEST_F(ResumingFolders, GoneElsewhereTheyLeaveWhatNoRunWrote) {
  write_text(at("notes"), "dear");
  Telling observer;
  resume({.folder = "out"}, observer, "other");
  EXPECT_THAT(observer.warnings, HasSubstr("holds what no run wrote, 1 in all: notes; it stays there"));
  EXPECT_EQ(testing::read_tree(folder_ / kLeft), (std::map<std::string, std::string>{{"notes", "dear"}}));
  testing::expect_same_results(folder_ / "other", folder_ / "whole");
}

TEST_F(ResumingFolders, NeverFollowLinksOut) {
  for (const char* name : {"inputs", "alternatives"}) {
    write_text(folder_ / "victim/01.png", "dear");
    write_text(folder_ / "victim/.espalier-1-1.tmp", "dear");
    fs::remove_all(folder_ / "real");
    if (fs::exists(at(name))) fs::rename(at(name), folder_ / "real");
    if (fs::exists(folder_ / "real")) fs::copy(folder_ / "real", folder_ / "victim", fs::copy_options::recursive);
    fs::create_directory_symlink(folder_ / "victim", at(name));
    const auto before = testing::read_tree(folder_ / "victim");
    EXPECT_THAT(error_of({.folder = "out"}), HasSubstr(std::string("/") + name + ": is a symbolic link")) << name;
    EXPECT_EQ(testing::read_tree(folder_ / "victim"), before) << name;
    fs::remove(at(name));
    if (fs::exists(folder_ / "real")) fs::rename(folder_ / "real", at(name));
  }
  resume({.folder = "out"});
  testing::expect_same_results(folder_ / "out", folder_ / "whole");
}

TEST_F(ResumingFolders, TouchNothingWhereTheNameIsTaken) {
  write_text(folder_ / "out/photo.jpg", "dear");
  write_text(at("alternatives/01.png"), "stale");
  const auto before = testing::read_tree(folder_ / kLeft);
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("out: holds other files"));
  auto after = testing::read_tree(folder_ / kLeft);
  after.erase(".lock");
  auto expected = before;
  expected.erase(".lock");
  EXPECT_EQ(after, expected);
}

TEST_F(ResumingFolders, HoldWhatIsLoadedAgainstTheCheckpoint) {
  forge([](Checkpoint& c) { c.inputs.clear(); });
  EXPECT_THAT(error_of({.folder = "out"}), AllOf(HasSubstr("inputs/pile.esp was no part of it"),
                                                 HasSubstr("inputs/targets/drawing.png was no part of it")));
  EXPECT_TRUE(fs::exists(at("checkpoint")));
}

TEST_F(ResumingFolders, ErrorsNameTheFileAndAreFitToPrint) {
  const std::string whole = read_text(at("checkpoint"));
  forge([](Checkpoint& c) { c.settings = "espalier = 2\n"; });
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr(at("checkpoint") + ": its settings:1:12: espalier must be "));
  write_text(at("checkpoint"), whole);
  forge([](Checkpoint& c) { c.version = "1\x1b[2J"; });
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("was written by 1\\x1b[2J"));
  write_text(at("checkpoint"), whole);
  forge([](Checkpoint& c) { c.state.replace(c.state.find(" seed 3 "), 8, "\xff\x1b[2J\n\xc3 "); });
  EXPECT_THAT(error_of({.folder = "out"}), AllOf(HasSubstr("it belongs to another search"),
                                                 HasSubstr("\\xff\\x1b[2J\\x0a\\xc3 lane")));
}

TEST_F(ResumingFolders, MayBeNamedFromWithin) {
  const fs::path before = fs::current_path();
  const auto error_here = [](const std::string& named) {
    try {
      find_resume_point(named);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error_here("/"), HasSubstr("--resume must name a folder of its own, got \"/\""));
  EXPECT_THAT(error_here(""), HasSubstr("--resume must name a folder"));
  fs::current_path(folder_ / "whole");
  const ResumePoint here = find_resume_point("."), slash = find_resume_point("./");
  fs::current_path(folder_ / "whole/inputs");
  const ResumePoint above = find_resume_point("..");
  fs::current_path(at(""));
  const ResumePoint left = find_resume_point(".");
  fs::current_path(before);
  const std::string real = fs::canonical(folder_ / "whole").string();
  for (const ResumePoint* point : {&here, &slash, &above}) {
    EXPECT_EQ(point->folder, real);
    EXPECT_TRUE(point->finished());
  }
  EXPECT_EQ(left.path, fs::canonical(folder_.path()).string() + "/out");
  EXPECT_FALSE(left.finished());
}

TEST_F(ResumingFolders, RunsMovedAsideAreTold) {
  write_text(folder_ / "out.replaced-Ab12Cd/run.toml", "x");
  write_text(folder_ / "out.replaced-Ab12Ce/notes", "x");
  write_text(folder_ / "outer.replaced-Ab12Cd/run.toml", "x");
  Telling observer, other;
  resume({.folder = "out"}, observer);
  EXPECT_THAT(observer.warnings, HasSubstr("/out.replaced-Ab12Cd is an earlier run of that name"));
  ASSERT_TRUE(run("out", 0, other));
  EXPECT_EQ(std::count(other.warnings.begin(), other.warnings.end(), '\n'), 1) << other.warnings;
  EXPECT_THAT(other.warnings, HasSubstr("/out.replaced-Ab12Cd is an earlier run of that name"));
  EXPECT_THAT(error_of({.folder = "out"}), HasSubstr("An earlier run of that name is in "));
  EXPECT_TRUE(fs::exists(folder_ / "out.replaced-Ab12Cd/run.toml"));
}

}  // namespace
}  // namespace espalier
