#include "search/state_stream.h"

#include <bit>
#include <istream>
#include <ostream>

#include <fmt/format.h>

#include "base/error.h"

namespace espalier {
namespace {

constexpr std::uint64_t kMostText = 4096;
constexpr std::uint64_t kMostItems = 64'000'000;

}  // namespace

void StateWriter::u64(std::uint64_t value) {
  char bytes[8];
  for (int i = 0; i < 8; ++i) bytes[i] = static_cast<char>(value >> 8 * i & 0xff);
  out_.write(bytes, 8);
}

void StateWriter::f64(double value) { u64(std::bit_cast<std::uint64_t>(value)); }

void StateWriter::text(std::string_view value) {
  u64(value.size());
  out_.write(value.data(), static_cast<std::streamsize>(value.size()));
}

void StateWriter::derivation(const Derivation& value) {
  u64(value.detail_seed);
  u64(value.genes.size()), u64(value.slots.size()), u64(value.draws.size());
  for (const GeneRecord& gene : value.genes) {
    u64(gene.edge | std::uint64_t{gene.variant} << 16 | std::uint64_t{gene.genes_below} << 32);
    u64(gene.slots_below | std::uint64_t{gene.draws_below} << 32);
  }
  for (const SlotState slot : value.slots) out_.put(static_cast<char>(slot));
  for (const std::uint32_t draw : value.draws) {
    for (int i = 0; i < 4; ++i) out_.put(static_cast<char>(draw >> 8 * i & 0xff));
  }
}

std::uint64_t StateReader::u64() {
  unsigned char bytes[8];
  if (!in_.read(reinterpret_cast<char*>(bytes), 8)) throw Error("saved state: the stream ends too early");
  std::uint64_t value = 0;
  for (int i = 0; i < 8; ++i) value |= std::uint64_t{bytes[i]} << 8 * i;
  return value;
}

std::uint64_t StateReader::u64_at_most(std::uint64_t most, std::string_view what) {
  const std::uint64_t value = u64();
  if (value > most) throw Error(fmt::format("saved state: {} must be at most {}, got {}", what, most, value));
  return value;
}

double StateReader::f64() { return std::bit_cast<double>(u64()); }

std::string StateReader::text() {
  std::string value(u64_at_most(kMostText, "length of a text"), '\0');
  if (!in_.read(value.data(), static_cast<std::streamsize>(value.size()))) {
    throw Error("saved state: the stream ends too early");
  }
  return value;
}

Derivation StateReader::derivation() {
  Derivation value;
  value.detail_seed = u64();
  const std::uint64_t genes = u64_at_most(kMostItems, "number of genes");
  const std::uint64_t slots = u64_at_most(kMostItems, "number of slots");
  const std::uint64_t draws = u64_at_most(kMostItems, "number of draws");
  // Grown item by item: a false length must not take memory that the stream does not back.
  for (std::uint64_t i = 0; i < genes; ++i) {
    const std::uint64_t low = u64(), high = u64();
    value.genes.push_back({static_cast<EdgeId>(low & 0xffff), static_cast<std::uint16_t>(low >> 16 & 0xffff),
                           static_cast<std::uint32_t>(low >> 32), static_cast<std::uint32_t>(high & 0xffffffff),
                           static_cast<std::uint32_t>(high >> 32)});
  }
  for (std::uint64_t i = 0; i < slots; ++i) {
    const int byte = in_.get();
    if (byte < 0 || byte > static_cast<int>(SlotState::absent)) {
      throw Error(fmt::format("saved state: a slot state must be 0 to 3, got {}", byte));
    }
    value.slots.push_back(static_cast<SlotState>(byte));
  }
  for (std::uint64_t i = 0; i < draws; ++i) {
    unsigned char bytes[4];
    if (!in_.read(reinterpret_cast<char*>(bytes), 4)) throw Error("saved state: the stream ends too early");
    value.draws.push_back(static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8 |
                          static_cast<std::uint32_t>(bytes[2]) << 16 | static_cast<std::uint32_t>(bytes[3]) << 24);
  }
  return value;
}

}  // namespace espalier
