#pragma once
// Content hashes: XXH3 with 128 bits, as 32 hex digits. They name inputs in provenance and find equal derivations;
// they are no defence against forgery.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace espalier {

/// The hash of the bytes as 32 lower-case hex digits.
std::string content_hash(std::string_view bytes);

/// 64-bit hash of a few spans of bytes, chained by `seed`.
std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed = 0);

/// A bijection that scatters every bit of x over the whole word (the finaliser of SplitMix64).
constexpr std::uint64_t scatter(std::uint64_t x) {
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

/// The key of a place below `key` called `name`: order matters, chains do not collide in practice.
constexpr std::uint64_t key_below(std::uint64_t key, std::uint64_t name) {
  return scatter(key + 0x9e3779b97f4a7c15u * (name + 1));
}

}  // namespace espalier
