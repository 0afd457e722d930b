#include "io/file.h"

#include <sys/stat.h>

#include <gtest/gtest.h>

#include "test_models.h"

namespace espalier {
namespace {

TEST(File, ReadsWhatWasWritten) {
  const TemporaryFolder folder;
  std::string bytes(100'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i);
  write_file(folder / "a", bytes);
  EXPECT_EQ(read_file(folder / "a"), bytes);
  write_file(folder / "a", "");
  EXPECT_EQ(read_file(folder / "a"), "");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(File, SaysWhyItCannotRead) {
  const TemporaryFolder folder;
  const std::string missing = folder / "missing", whole = folder / "", pipe = folder / "pipe", big = folder / "big";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  write_file(big, "12345");
  EXPECT_EQ(error_of([&] { read_file(missing); }), missing + ": cannot read: No such file or directory");
  EXPECT_EQ(error_of([&] { read_file(whole); }), whole + ": cannot read: it is a folder");
  EXPECT_EQ(error_of([&] { read_file(pipe); }), pipe + ": cannot read: it is not a regular file");
  EXPECT_EQ(error_of([&] { read_file(big, 4); }), big + ": cannot read: it is larger than 4 bytes");
  EXPECT_EQ(read_file(big, 5), "12345");
}

TEST(File, SaysWhyItCannotWrite) {
  const TemporaryFolder folder;
  const std::string missing = folder / "no/such/file", long_name = folder / std::string(300, 'x');
  write_file(folder / "plain", "");
  const std::string below_file = folder / "plain/file", here = folder / "";
  EXPECT_EQ(error_of([&] { write_file(missing, "x"); }), missing + ": cannot write: No such file or directory");
  EXPECT_EQ(error_of([&] { write_file(below_file, "x"); }), below_file + ": cannot write: Not a directory");
  EXPECT_EQ(error_of([&] { write_file(here, "x"); }), here + ": cannot write: Is a directory");
  EXPECT_EQ(error_of([&] { write_file(long_name, "x"); }), long_name + ": cannot write: File name too long");
  EXPECT_EQ(error_of([&] { write_file("/dev/full", "x"); }), "/dev/full: cannot write: No space left on device");
  EXPECT_EQ(folder.file_count(), 1u) << "a temporary file was left behind";
}

/// Gives up root's rights, which know no permissions, for as long as it lives.
class AsNobody {
 public:
  AsNobody() : user_(::geteuid()) {
    EXPECT_TRUE(user_ != 0 || ::seteuid(65534) == 0);
  }
  ~AsNobody() {
    EXPECT_TRUE(user_ != 0 || ::seteuid(0) == 0);
  }

 private:
  uid_t user_;
};

TEST(File, RefusesFoldersAndFilesWithoutPermission) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "locked");
  write_file(folder / "fixed", "old");
  ASSERT_EQ(::chmod((folder / "").c_str(), 0755), 0);
  ASSERT_EQ(::chmod((folder / "locked").c_str(), 0555), 0);
  ASSERT_EQ(::chmod((folder / "fixed").c_str(), 0444), 0);
  const AsNobody nobody;
  for (const char* name : {"locked/a", "fixed"}) {
    EXPECT_EQ(error_of([&] { write_file(folder / name, "x"); }), (folder / name) + ": cannot write: Permission denied");
  }
  EXPECT_EQ(read_file(folder / "fixed"), "old");
}

TEST(File, WritesThroughLinksAndKeepsTheMode) {
  const TemporaryFolder folder;
  write_file(folder / "real", "old");
  ASSERT_EQ(::chmod((folder / "real").c_str(), 0640), 0);
  std::filesystem::create_symlink("real", folder / "link");
  write_file(folder / "link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "real"), "new");
  struct stat info {};
  ASSERT_EQ(::stat((folder / "real").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0640u);
}

TEST(File, StagedFilesLeaveNothingUnlessCommitted) {
  const TemporaryFolder folder;
  { const StagedFile staged(folder / "a", "x"); }
  EXPECT_EQ(folder.file_count(), 0u);
}

}  // namespace
}  // namespace espalier
