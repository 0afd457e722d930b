#pragma once
// Gauge: takes the measures of derivations and models, all that are wanted in one pass over genes and one over parts.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "derivation/derivation.h"
#include "model/model.h"
#include "score/measure.h"
#include "score/volume_view.h"

namespace espalier {

/// A gene whose subtree is being walked.
struct OpenGene {
  std::size_t end = 0;  // index behind its subtree
  std::uint32_t children = 0, smallest = 0, largest = 0;  // of the child subtrees, in genes
};

class Gauge {
 public:
  /// The memory of one thread.
  struct Scratch {
    std::vector<OpenGene> path;
  };

  /// Keeps what it needs of `meshes`. Measures that are not wanted come out as anything.
  Gauge(const MeshTable& meshes, VolumeView view, const PerMeasure<bool>& wanted);

  bool wants_model() const { return wants_model_; }
  /// The model may stay empty where wants_model() is false. No allocation once warm.
  void measure(const Derivation& derivation, const Model& model, Scratch& scratch, PerMeasure<double>& out) const;

  /// Mesh files (as the grammar writes them) that are not closed, and so have no volume.
  const std::vector<std::string>& open_files() const { return open_files_; }

 private:
  /// A mesh of the table, reduced to what measures ask of it. Of cones: with top = 1.
  struct Solid {
    Vec3 centre{0}, half{0};     // of its box
    std::vector<Vec3> corners;   // its positions, each once; empty where the box says it all
    double volume = 0;           // m3 per |det|
    std::uint32_t triangles = 0, pointed = 0;  // those of the second are of a cone with top = 0
    bool cone = false, empty = false, centred = true;  // its box on 0
  };

  struct Sums;

  static Solid make_solid(const MeshTable& meshes, std::size_t i);
  void measure_genes(const Derivation& derivation, Scratch& scratch, PerMeasure<double>& out) const;
  void measure_parts(std::span<const Instance> instances, PerMeasure<double>& out) const;
  bool add_parts(std::span<const Instance> instances, bool check_each, Sums& sums) const;
  double volume_of(const Solid& solid, const Frame& frame, float top) const;

  std::vector<Solid> solids_;
  VolumeView view_;
  PerMeasure<bool> wanted_;
  bool wants_model_ = false;
  std::vector<std::string> open_files_;
};

}  // namespace espalier
