#pragma once
// Material: how a surface looks, its texture included; and MaterialRecipe: a material some of whose numbers are made
// when a model is, by draws and other values.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/vec.h"

namespace espalier {

enum class TextureKind : std::uint8_t { none, image, bark, leaf, noise };

/// A texture as a grammar describes it. What the numbers mean says texture_numbers() (surface_arguments.h).
struct TextureRef {
  static constexpr std::size_t kMostNumbers = 7;

  TextureKind kind = TextureKind::none;
  std::string path;                           // image: as written, relative to the grammar's folder
  std::array<Vec3, 2> colors{};               // linear light
  std::array<float, kMostNumbers> numbers{};  // unused ones 0
  SourceSpan span;

  /// The span aside: equal textures make equal pictures.
  friend bool operator==(const TextureRef& a, const TextureRef& b) {
    return a.kind == b.kind && a.path == b.path && a.colors == b.colors && a.numbers == b.numbers;
  }
};

/// A surface; colours are linear-light values of the sRGB hex triple. The texture's colour and alpha are multiplied by
/// `color` and `opacity`.
struct Material {
  std::string name;
  Vec3 color{0.8f};
  float roughness = 0.7f;
  float metal = 0;
  float opacity = 1;
  float glow = 0;           // light sent out, per unit of colour
  float cutout = 0;         // > 0: where opacity is below this there is nothing, elsewhere all is opaque
  bool two_sided = false;   // seen from behind too
  float tiles = 1;          // times that the texture repeats across
  float tiles_up = 0;       // and upwards; 0: as across
  float metres = 0;         // of the surface that `tiles` stand on; 0: the whole part, whatever its size
  TextureRef texture = {};

  bool textured() const { return texture.kind != TextureKind::none; }
  Vec2 repeats() const { return {tiles, tiles_up > 0 ? tiles_up : tiles}; }
  /// The name aside.
  bool looks_like(const Material& other) const;
};

/// What is between two materials, for t in 0..1. Textures of one procedural kind are blended by their arguments; of
/// others the nearer one's is taken.
Material blend(const Material& a, const Material& b, float t);

/// A number of a material that a recipe leaves open. texture + i: number i of its texture.
enum class MaterialField : std::uint8_t { roughness, metal, opacity, glow, cutout, tiles, tiles_up, metres, texture };

struct MaterialRecipe {
  /// A number that varies is one of kSteps + 1 values, so that models have few materials.
  static constexpr int kSteps = 16;
  static constexpr std::size_t kMostSlots = 14;

  struct Slot {
    MaterialField field = MaterialField::roughness;
    float low = 0, per_step = 1;  // step = (value - low) / per_step, unless logarithmic
    bool logarithmic = false;
    std::array<float, kSteps + 1> values{};

    bool operator==(const Slot&) const = default;
    /// The step that is nearest to a value; what lies outside counts as the end of the range, NaN as its beginning.
    int step_of(float value) const;
  };

  Material base;              // its open numbers are those of the middle step
  std::vector<Slot> slots;    // 1..kMostSlots
  std::uint16_t middle = 0;   // index of `base` among the graph's materials

  /// The material for the steps of all slots, packed as digits to the base kSteps + 1, the first slot's the highest.
  Material material(std::uint64_t steps) const;
};

/// A slot for a field whose values run from low to high.
MaterialRecipe::Slot make_slot(MaterialField field, float low, float high, bool logarithmic);

void set_field(Material& material, MaterialField field, float value);

}  // namespace espalier
