#pragma once
// What binary messages of the studio are put together with.

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/vec.h"
#include "grammar/material.h"

namespace espalier::studio {

class MessageWriter {
 public:
  /// Of a message that begins with four letters and its version, and of as many bytes as are foreseen.
  MessageWriter(std::string_view letters, std::uint32_t version, std::size_t bytes) {
    static_assert(std::endian::native == std::endian::little);
    out_.reserve(bytes);
    add(letters);
    add(version);
  }
  template <class T>
    requires std::is_arithmetic_v<T>
  void add(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    out_.append(bytes, sizeof(T));
  }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(std::string_view text) { out_ += text; }
  /// kMaterialBytes of them. A texture is not sent: its colours' mean stands for it.
  void add(const Material& material);
  void pad() { out_.append((4 - out_.size() % 4) % 4, '\0'); }
  std::string take() { return std::move(out_); }

  static constexpr std::size_t kMaterialBytes = 48;

 private:
  std::string out_;
};

}  // namespace espalier::studio
