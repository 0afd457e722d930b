#include "studio/zip_reader.h"

#include <algorithm>

#include <fmt/format.h>
#include <zlib.h>

#include "base/error.h"

namespace espalier::studio {
namespace {

constexpr std::uint32_t kFile = 0x04034b50, kEntry = 0x02014b50, kEnd = 0x06054b50;  // "PK" and two numbers
constexpr std::size_t kFileHead = 30, kEntryHead = 46, kEndHead = 22, kMostComment = 0xffff;
constexpr std::uint16_t kStored = 0, kDeflated = 8, kEncrypted = 1;
constexpr std::uint64_t kMostRatio = 1032;  // of deflate: what claims more is a lie
constexpr std::size_t kMostPath = 300;  // bytes

[[noreturn]] void fail_damaged() { throw Error("the zip file is damaged, or cut short"); }

std::string_view part(std::string_view bytes, std::uint64_t from, std::uint64_t size) {
  if (from > bytes.size() || size > bytes.size() - from) fail_damaged();
  return bytes.substr(static_cast<std::size_t>(from), static_cast<std::size_t>(size));
}

std::uint32_t number(std::string_view bytes, std::size_t from, std::size_t size) {
  std::uint32_t value = 0;
  const std::string_view found = part(bytes, from, size);
  for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(found[i]);
  return value;
}
std::uint16_t read16(std::string_view bytes, std::size_t from) {
  return static_cast<std::uint16_t>(number(bytes, from, 2));
}
std::uint32_t read32(std::string_view bytes, std::size_t from) { return number(bytes, from, 4); }

/// The end of the directory lies at the archive's end, before a comment.
std::string_view find_end(std::string_view archive) {
  if (archive.size() < kEndHead) fail_damaged();
  const std::size_t last = archive.size() - kEndHead, least = last > kMostComment ? last - kMostComment : 0;
  for (std::size_t at = last;; --at) {
    const bool ends = read32(archive, at) == kEnd && at + kEndHead + read16(archive, at + 20) == archive.size();
    if (ends) return archive.substr(at);
    if (at == least) fail_damaged();
  }
}

bool leads_elsewhere(std::string_view path) {
  if (path.empty() || path.size() > kMostPath) return true;
  const auto is_odd = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\\' || c == ':'; };
  if (std::any_of(path.begin(), path.end(), is_odd)) return true;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t end = std::min(path.find('/', from), path.size());
    const std::string_view name = path.substr(from, end - from);
    if (name.empty() || name == "." || name == "..") return true;
    from = end + 1;
  }
  return false;
}

std::string inflated(std::string_view packed, std::size_t size, const std::string& path) {
  std::string out(size + 1, '\0');  // one more than there may be
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw Error("no memory to unpack");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int result = inflate(&stream, Z_FINISH);
  const std::size_t got = stream.total_out;
  inflateEnd(&stream);
  if (result != Z_STREAM_END || got != size) throw Error(fmt::format("{} in the zip file is damaged", path));
  out.resize(size);
  return out;
}

/// An entry of the directory; heads of files say the same, or nothing.
struct Entry {
  explicit Entry(std::string_view head)
      : flags(read16(head, 8)), method(read16(head, 10)), sum(read32(head, 16)), packed(read32(head, 20)),
        size(read32(head, 24)), offset(read32(head, 42)), path(part(head, kEntryHead, read16(head, 28))),
        length(kEntryHead + path.size() + read16(head, 30) + read16(head, 32)) {
    if (read32(head, 0) != kEntry) fail_damaged();
  }

  std::uint16_t flags, method;
  std::uint32_t sum, packed, size, offset;
  std::string path;
  std::size_t length;  // of the entry itself
};

std::string unpacked(std::string_view archive, const Entry& entry) {
  const std::string_view head = part(archive, entry.offset, kFileHead);
  if (read32(head, 0) != kFile) fail_damaged();
  const std::uint64_t begin = std::uint64_t{entry.offset} + kFileHead + read16(head, 26) + read16(head, 28);
  const std::string_view body = part(archive, begin, entry.packed);
  if ((entry.flags & kEncrypted) != 0) throw Error(fmt::format("{} in the zip file is encrypted", entry.path));
  const bool plain = entry.method == kStored && entry.packed == entry.size;
  const bool packed = entry.method == kDeflated && entry.size <= (std::uint64_t{entry.packed} + 1) * kMostRatio;
  if (!plain && !packed) throw Error(fmt::format("{} in the zip file is packed in an unknown way", entry.path));
  std::string bytes = plain ? std::string(body) : inflated(body, entry.size, entry.path);
  if (crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) != entry.sum) {
    throw Error(fmt::format("{} in the zip file is damaged", entry.path));
  }
  return bytes;
}

}  // namespace

std::map<std::string, std::string> read_zip(std::string_view archive, const ZipLimits& limits) {
  const std::string_view end = find_end(archive);
  const std::size_t entries = read16(end, 10);
  std::string_view directory = part(archive, read32(end, 16), read32(end, 12));
  std::map<std::string, std::string> files;
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < entries; ++i) {
    const Entry entry(directory);
    directory = part(directory, entry.length, directory.size() - std::min(entry.length, directory.size()));
    if (leads_elsewhere(entry.path.ends_with('/') ? entry.path.substr(0, entry.path.size() - 1) : entry.path)) {
      const std::string path = entry.path.substr(0, kMostPath);
      throw Error(fmt::format("the zip file names a file \"{}\", which leads elsewhere", path));
    }
    if (entry.path.ends_with('/')) continue;
    bytes += entry.size;
    if (files.size() >= limits.files) throw Error(fmt::format("a zip file has at most {} files", limits.files));
    if (bytes > limits.bytes) throw Error(fmt::format("the files of a zip file have at most {} bytes", limits.bytes));
    const bool fresh = files.emplace(entry.path, unpacked(archive, entry)).second;
    if (!fresh) throw Error(fmt::format("the zip file has {} twice", entry.path));
  }
  return files;
}

}  // namespace espalier::studio
