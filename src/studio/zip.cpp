#include "studio/zip.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <zlib.h>

#include "base/error.h"
#include "io/file.h"

namespace espalier::studio {
namespace {

constexpr std::uint16_t kNeeded = 20, kDeflate = 8, kStore = 0;
constexpr std::uint16_t kDate = (2020 - 1980) << 9 | 1 << 5 | 1;  // not now: equal files give equal bytes
constexpr std::size_t kMostBytes = std::size_t{1} << 31;

void add16(std::string& out, std::uint16_t value) {
  out += static_cast<char>(value & 0xff);
  out += static_cast<char>(value >> 8);
}

void add32(std::string& out, std::uint32_t value) {
  add16(out, static_cast<std::uint16_t>(value & 0xffff));
  add16(out, static_cast<std::uint16_t>(value >> 16));
}

/// Raw, without a header of zlib's.
std::string deflated(std::string_view bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw Error("no memory to compress");
  }
  std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int result = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END) throw Error("a file could not be compressed");
  return out;
}

}  // namespace

void ZipWriter::add(const std::string& name, std::string_view bytes) {
  if (files_ >= 65'000 || bytes.size() >= kMostBytes || out_.size() >= kMostBytes) throw Error("too much for one zip file");
  std::string packed = deflated(bytes);
  const bool smaller = packed.size() < bytes.size();
  const std::string_view body = smaller ? std::string_view(packed) : bytes;
  const auto offset = static_cast<std::uint32_t>(out_.size());
  std::string facts;
  add16(facts, kNeeded);
  add16(facts, 0);
  add16(facts, smaller ? kDeflate : kStore);
  add16(facts, 0);
  add16(facts, kDate);
  add32(facts, static_cast<std::uint32_t>(
                   crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size())));
  add32(facts, static_cast<std::uint32_t>(body.size()));
  add32(facts, static_cast<std::uint32_t>(bytes.size()));
  add16(facts, static_cast<std::uint16_t>(name.size()));
  add16(facts, 0);
  out_ += "PK\x03\x04" + facts + name;
  out_ += body;
  directory_ += "PK\x01\x02";
  add16(directory_, kNeeded);
  directory_ += facts;
  add16(directory_, 0), add16(directory_, 0), add16(directory_, 0), add32(directory_, 0), add32(directory_, offset);
  directory_ += name;
  ++files_;
}

std::string ZipWriter::finish() {
  const auto begin = static_cast<std::uint32_t>(out_.size());
  out_ += directory_;
  out_ += "PK\x05\x06";
  add32(out_, 0);
  add16(out_, static_cast<std::uint16_t>(files_)), add16(out_, static_cast<std::uint16_t>(files_));
  add32(out_, static_cast<std::uint32_t>(directory_.size())), add32(out_, begin);
  add16(out_, 0);
  std::string result = std::move(out_);
  *this = {};
  return result;
}

std::string zip_of_folder(const std::string& folder, const std::string& stem) {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), folder).generic_string());
  }
  std::sort(files.begin(), files.end());
  ZipWriter zip;
  for (const std::string& file : files) zip.add(stem + "/" + file, read_file((fs::path(folder) / file).string()));
  return zip.finish();
}

}  // namespace espalier::studio
