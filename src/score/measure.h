#pragma once
// Measure: one number that says how large or how regular a model is. Limits are set on measures (score/limit.h).

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace espalier {

enum class Measure : std::uint8_t {
  genes,      // of the derivation
  depth,      // levels of genes below the start gene: 0 for the start gene alone
  parts,      // instances that the view shows
  triangles,  // of these, as a GLB file holds them
  height,     // extent along y of the parts' positions, m
  spread,     // the larger of the extents along x and z, m
  volume,     // of the parts added up, overlaps counted each time, m3; meshes that are not closed count 0
  balance,    // mean over the genes with two children or more of smallest / largest child subtree, in genes; 1 where
              // there is none (named in ShapeGenetics 2017, section 3, as what a score may ask of a derivation tree)
};
inline constexpr std::size_t kMeasures = 8;
inline constexpr std::array<Measure, kMeasures> kAllMeasures = {
    Measure::genes,  Measure::depth,  Measure::parts,  Measure::triangles,
    Measure::height, Measure::spread, Measure::volume, Measure::balance};

/// What a measure is called, in what it is counted, and the range that its limits may have.
struct MeasureFacts {
  std::string_view name;
  std::string_view unit;  // "m", "genes"; empty for balance
  double lowest, highest;
  bool whole;     // counts: whole numbers
  bool by_genes;  // needs no model
};
const MeasureFacts& facts_of(Measure measure);

/// One number per measure, by its index.
template <class T>
class PerMeasure {
 public:
  T& operator[](Measure measure) { return values_[static_cast<std::size_t>(measure)]; }
  const T& operator[](Measure measure) const { return values_[static_cast<std::size_t>(measure)]; }
  bool operator==(const PerMeasure&) const = default;

 private:
  std::array<T, kMeasures> values_{};
};

}  // namespace espalier
