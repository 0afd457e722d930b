#pragma once
// Reading and writing whole files.

#include <cstdint>
#include <string>
#include <string_view>

namespace espalier {

/// The whole file. Throws Error naming it when it is missing, a folder, unreadable or larger than `most_bytes`.
std::string read_file(const std::string& path, std::uint64_t most_bytes = 1ull << 30);

/// Writes to a temporary file in the same folder, syncs, and renames; an existing file is replaced whole or not at all.
/// Throws Error naming the file and the system's reason.
void write_file(const std::string& path, std::string_view bytes);

/// A file that is written and synced under a temporary name, and takes its own only on commit: for files that belong
/// together. Without a commit it leaves nothing behind.
class StagedFile {
 public:
  /// Throws Error as write_file does.
  StagedFile(const std::string& path, std::string_view bytes);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  void commit();

 private:
  std::string path_, target_;
  std::string temporary_;  // empty once committed, and for devices, which take their bytes on commit
  std::string for_device_;
};

}  // namespace espalier
