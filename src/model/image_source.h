#pragma once
// ImageSource: where image files come from. Implemented by io/image_import; tests give images of their own.

#include <string>

#include "model/image.h"

namespace espalier {

struct ImageFile {
  Image image;
  std::string bytes;   // of the file, as it is
  std::string ending;  // "png" or "jpg", by what the file holds
};

class ImageSource {
 public:
  virtual ~ImageSource() = default;
  /// Throws Error naming the file when it is missing, unreadable, neither PNG nor JPG, damaged or beyond Image's
  /// limits.
  virtual ImageFile load(const std::string& path) = 0;
};

}  // namespace espalier
