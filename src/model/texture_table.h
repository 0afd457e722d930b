#pragma once
// TextureTable: the pictures of textures: those that files hold, loaded once, and those that are made, kept for the
// next model that shows them.

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "grammar/graph.h"
#include "model/image_source.h"

namespace espalier {

/// A texture as files and pictures want it.
struct TexturePicture {
  std::string name;     // "bark", or the name of its file
  Image image;
  std::string bytes;    // of the image file, as it is; empty for what is made
  std::string ending;   // "png" or "jpg"
  bool transparent = false;  // somewhere
  Vec3 mean{1};              // linear light of what is not transparent
};

using TexturePicturePtr = std::shared_ptr<const TexturePicture>;

/// The image files that a grammar names, each once.
std::vector<TextureRef> image_textures(const GeneratorGraph& graph);

class TextureTable {
 public:
  /// Takes the image of a file; `path` as textures name it.
  void add_file(const std::string& path, ImageFile file);

  /// `size` is that of pictures that are made. Image files must have been added.
  TexturePicturePtr picture(const TextureRef& texture, std::uint32_t size);

 private:
  static constexpr std::size_t kMostKept = 160;  // pictures that are made; then they are forgotten
  struct Made {
    TextureRef texture;
    TexturePicturePtr picture;
  };
  std::map<std::string, TexturePicturePtr> files_;
  std::vector<Made> made_;
};

}  // namespace espalier
