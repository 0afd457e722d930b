#include "run/run_folder.h"

#include <fcntl.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <cstdio>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "run/fixtures.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::read_text;
using testing::TemporaryFolder;
using testing::write_text;

namespace fs = std::filesystem;

std::size_t entries(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string error_of(const std::string& path) {
  try {
    RunFolder folder(path, "run.toml");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(RunFolder, AppearsOnCommitAlone) {
  const TemporaryFolder temporary;
  {
    RunFolder folder(temporary / "deep/out/", "run.toml");
    write_text(folder.staging() + "/run.toml", "x");
    EXPECT_FALSE(fs::exists(temporary / "deep/out"));
    folder.commit();
  }
  EXPECT_EQ(read_text(temporary / "deep/out/run.toml"), "x");
  EXPECT_EQ(entries(temporary / "deep"), 1u);
}

TEST(RunFolder, WithoutCommitLeavesNothing) {
  const TemporaryFolder temporary;
  {
    RunFolder folder(temporary / "out", "run.toml");
    write_text(folder.staging() + "/sub/file", "x");
  }
  EXPECT_EQ(entries(temporary.path()), 0u);
}

TEST(RunFolder, KeptItStaysUnderItsOwnName) {
  const TemporaryFolder temporary;
  std::string staging;
  {
    RunFolder folder(temporary / "out", "run.toml");
    write_text(folder.staging() + "/file", "x");
    folder.keep();
    staging = folder.staging();
  }
  EXPECT_FALSE(fs::exists(temporary / "out"));
  EXPECT_EQ(read_text(staging + "/file"), "x");
}

TEST(RunFolder, ReplacesAnEarlierOneWhole) {
  const TemporaryFolder temporary;
  write_text(temporary / "out/run.toml", "old");
  write_text(temporary / "out/extra", "old");
  RunFolder folder(temporary / "out", "run.toml");
  write_text(folder.staging() + "/run.toml", "new");
  EXPECT_EQ(read_text(temporary / "out/run.toml"), "old");
  folder.commit();
  EXPECT_EQ(read_text(temporary / "out/run.toml"), "new");
  EXPECT_FALSE(fs::exists(temporary / "out/extra"));
  EXPECT_EQ(entries(temporary.path()), 1u);
}

TEST(RunFolder, ThereIsAWholeFolderOfTheNameAtAnyMoment) {
  const TemporaryFolder temporary;
  write_text(temporary / "out/run.toml", "old");
  fs::create_directories(temporary / "probe/a"), fs::create_directories(temporary / "probe/b");
  const std::string a = temporary / "probe/a", b = temporary / "probe/b";
  if (::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) != 0) {
    GTEST_SKIP() << "this file system cannot exchange names";
  }
  RunFolder folder(temporary / "out", "run.toml");
  write_text(folder.staging() + "/run.toml", "new");
  const int events = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  ASSERT_GE(events, 0);
  ASSERT_GE(::inotify_add_watch(events, temporary.path().c_str(), IN_MOVED_FROM | IN_MOVED_TO | IN_DELETE), 0);
  folder.commit();
  alignas(inotify_event) char buffer[8192];
  const ssize_t size = ::read(events, buffer, sizeof buffer);
  ::close(events);
  std::vector<std::pair<std::string, bool>> moves;  // of "out": whether there is one after it
  for (ssize_t i = 0; i < size;) {
    const auto* event = reinterpret_cast<const inotify_event*>(buffer + i);
    if (event->len > 0 && std::string(event->name) == "out") moves.emplace_back("out", event->mask & IN_MOVED_TO);
    i += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
  }
  // Exchanged: the new one came in the step in which the old one went, and the kernel tells of it first.
  ASSERT_FALSE(moves.empty());
  EXPECT_TRUE(moves.front().second) << "the earlier folder was moved away before the new one came";
  EXPECT_EQ(read_text(temporary / "out/run.toml"), "new");
  EXPECT_EQ(entries(temporary.path()), 2u);
}

TEST(RunFolder, TakesAnEmptyFolder) {
  const TemporaryFolder temporary;
  fs::create_directory(temporary / "out");
  RunFolder folder(temporary / "out", "run.toml");
  folder.commit();
  EXPECT_TRUE(fs::is_directory(temporary / "out"));
  EXPECT_EQ(entries(temporary.path()), 1u);
}

TEST(RunFolder, MayBeNamedRelativeToHere) {
  const TemporaryFolder temporary;
  const fs::path before = fs::current_path();
  fs::current_path(temporary.path());
  EXPECT_NO_THROW(RunFolder("out", "run.toml").commit());
  fs::current_path(before);
  EXPECT_TRUE(fs::is_directory(temporary / "out"));
}

TEST(RunFolder, NeverTakesWhatIsNotOurs) {
  const TemporaryFolder temporary;
  write_text(temporary / "photos/a.png", "dear");
  write_text(temporary / "file", "dear");
  EXPECT_THAT(error_of(temporary / "photos"), HasSubstr("holds other files"));
  EXPECT_THAT(error_of(temporary / "file"), HasSubstr("is no folder"));
  EXPECT_THAT(error_of(temporary / "file/out"), HasSubstr("cannot make"));
  EXPECT_THAT(error_of("/proc/espalier/out"), HasSubstr("cannot make"));
  EXPECT_THAT(error_of(""), HasSubstr("must name a folder"));
  EXPECT_THAT(error_of("/"), HasSubstr("folder of its own"));
  EXPECT_THAT(error_of("."), HasSubstr("folder of its own"));
  EXPECT_EQ(read_text(temporary / "photos/a.png"), "dear");
  EXPECT_EQ(entries(temporary.path()), 2u);
}

}  // namespace
}  // namespace espalier
