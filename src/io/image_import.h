#pragma once
// Image files: PNG and JPG.

#include <cstdint>

#include "model/image_source.h"

namespace espalier {

class FileImageSource final : public ImageSource {
 public:
  ImageFile load(const std::string& path) override;

 private:
  static constexpr std::uint64_t kMostBytes = 256ull << 20;
};

}  // namespace espalier
