#pragma once
// BitGrid: one bit per voxel of a grid, in tiles that a SIMD register holds: 8 rows in y by 32 voxels in z.
// words[((y / 8) * depth + z / 32) * nx + x][y % 8], bit z % 32; depth = ceil(nz / 32). Padding bits are 0.

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace espalier {

/// Memory that starts on a cache line, so that no tile straddles two.
template <class T>
struct TileAllocator {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};

  TileAllocator() = default;
  template <class U>
  TileAllocator(const TileAllocator<U>&) {}  // NOLINT: allocators convert
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kLine)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, kLine); }
  bool operator==(const TileAllocator&) const { return true; }
};

template <class T>
using TileVector = std::vector<T, TileAllocator<T>>;

class BitGrid {
 public:
  BitGrid() = default;
  BitGrid(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz)
      : nx_(nx), ny_(ny), nz_(nz), depth_((nz + 31) / 32), words_(std::size_t{8} * nx * ((ny + 7) / 8) * depth_) {}

  std::uint32_t nx() const { return nx_; }
  std::uint32_t ny() const { return ny_; }
  std::uint32_t nz() const { return nz_; }
  /// 32-bit words along z, and tiles of 8 rows along y.
  std::uint32_t depth() const { return depth_; }
  std::uint32_t tile_rows() const { return (ny_ + 7) / 8; }

  std::size_t word_index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return ((std::size_t{y / 8} * depth_ + z / 32) * nx_ + x) * 8 + y % 8;
  }
  bool get(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return words_[word_index(x, y, z)] >> (z % 32) & 1u;
  }
  void set(std::uint32_t x, std::uint32_t y, std::uint32_t z) { words_[word_index(x, y, z)] |= 1u << (z % 32); }

  /// Number of set bits.
  std::uint64_t count() const;

  std::uint32_t* data() { return words_.data(); }
  const std::uint32_t* data() const { return words_.data(); }
  std::size_t size() const { return words_.size(); }

  bool operator==(const BitGrid&) const = default;

 private:
  std::uint32_t nx_ = 0, ny_ = 0, nz_ = 0, depth_ = 0;
  TileVector<std::uint32_t> words_;
};

/// a |= b, bit by bit; both of one size.
void unite(BitGrid& a, const BitGrid& b);

}  // namespace espalier
