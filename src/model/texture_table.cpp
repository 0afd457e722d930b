#include "model/texture_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "base/check.h"
#include "grammar/surface_arguments.h"
#include "model/texture.h"

namespace espalier {
namespace {

/// Fills in what the pixels tell.
void look_at(TexturePicture& picture) {
  std::array<std::array<std::uint64_t, 256>, 3> counts{};
  std::uint64_t solid = 0;
  for (std::size_t i = 0; i < picture.image.rgba.size(); i += 4) {
    const std::uint8_t* const pixel = picture.image.rgba.data() + i;
    picture.transparent |= pixel[3] < 255;
    if (pixel[3] < 128) continue;
    ++solid;
    for (std::size_t c = 0; c < 3; ++c) ++counts[c][pixel[c]];
  }
  if (solid == 0) return;
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0;
    for (std::size_t b = 0; b < 256; ++b)
      sum += static_cast<double>(counts[c][b]) * linear_light(static_cast<int>(b));
    picture.mean[static_cast<int>(c)] = static_cast<float>(sum / static_cast<double>(solid));
  }
}

}  // namespace

std::vector<TextureRef> image_textures(const GeneratorGraph& graph) {
  std::vector<TextureRef> out;
  const auto add = [&](const TextureRef& texture) {
    const auto same = [&](const TextureRef& known) { return known.path == texture.path; };
    if (texture.kind == TextureKind::image && std::none_of(out.begin(), out.end(), same)) out.push_back(texture);
  };
  for (const Material& material : graph.materials) add(material.texture);
  for (const MaterialRecipe& recipe : graph.recipes) add(recipe.base.texture);
  return out;
}

void TextureTable::add_file(const std::string& path, ImageFile file) {
  auto picture = std::make_shared<TexturePicture>();
  picture->name = std::filesystem::path(path).stem().string();
  picture->image = std::move(file.image);
  picture->bytes = std::move(file.bytes);
  picture->ending = std::move(file.ending);
  look_at(*picture);
  files_[path] = std::move(picture);
}

TexturePicturePtr TextureTable::picture(const TextureRef& texture, std::uint32_t size) {
  if (texture.kind == TextureKind::image) {
    const auto found = files_.find(texture.path);
    CHECK(found != files_.end());
    return found->second;
  }
  for (const Made& made : made_)
    if (made.picture->image.width == size && made.texture == texture) return made.picture;
  auto picture = std::make_shared<TexturePicture>();
  picture->name = name_of(texture.kind);
  picture->name.resize(picture->name.find('_'));
  picture->image = make_texture(texture, size);
  picture->ending = "png";
  look_at(*picture);
  if (made_.size() >= kMostKept) made_.clear();
  made_.push_back({texture, picture});
  return picture;
}

}  // namespace espalier
