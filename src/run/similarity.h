#pragma once
// Similarity of models: how far apart the shapes of each two are, by their subdivided D2 (score/shape_descriptor.h).

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/executor.h"
#include "model/mesh_source.h"
#include "run/shown_model.h"
#include "run/statistics.h"
#include "score/shape_descriptor.h"

namespace espalier {

struct SimilarityRequest {
  static constexpr std::size_t kMostModels = 256;

  std::vector<std::string> models;                // paths: see load_shown_model; 2 to kMostModels
  std::string grammar;                            // of derivations; empty: the copy in the folder of the run
  std::map<std::string, std::string> attributes;  // of derivations, set anew
  DescriptorSettings descriptor;
  /// One box around all models, so that a voxel is the same place for all; else each model has its own, so that place
  /// and size do not count and no model's descriptor depends on the others.
  bool shared_box = false;
};

/// Throws Error with rule and value. Reads no file.
void validate(const SimilarityRequest& request);

/// The set of distances of two shapes, voxel by voxel, in numbers.
struct ShapeDistance {
  std::size_t both = 0, only_first = 0, only_second = 0, neither = 0;  // voxels, by whose surface they hold
  SampleSummary all;                      // over all voxels, as published; those that hold nothing count as 0
  std::optional<SampleSummary> occupied;  // over those in which either has surface; none: nothing to compare
};
ShapeDistance distance(const ShapeDescriptor& a, const ShapeDescriptor& b);

struct ComparedModel {
  std::string path;
  bool is_mesh = false, truncated = false;
  AdaptedGenes adapted;
  std::uint64_t triangles = 0;
  double area = 0;  // m2
  Bounds box;       // m; empty: no surface
  ShapeDistance anew;  // to itself with other points: what chance alone makes of no difference
};

struct SimilarityReport {
  std::vector<ComparedModel> models;
  std::vector<ShapeDistance> pairs;  // of models (0, 1), (0, 2) .. (0, n - 1), (1, 2) ..
  std::vector<double> voxels;        // of exactly two models: their distance per voxel, x fastest, then y, then z

  /// Two different models, in either order; only_first is the lower one's.
  const ShapeDistance& pair(std::size_t a, std::size_t b) const;
};

/// Throws Error.
SimilarityReport compare_shapes(const SimilarityRequest& request, MeshSource& source, Executor& executor);

/// Which voxels a median is of.
enum class VoxelChoice : std::uint8_t { all, occupied };
/// 0 where nothing is occupied.
double median(const ShapeDistance& distance, VoxelChoice choice);

/// A JSON object without newline.
std::string similarity_json(const SimilarityRequest& request, const SimilarityReport& report);
/// The matrix of medians, a row and a column per model, named by path; 0 on the diagonal.
std::string similarity_csv(const SimilarityReport& report, VoxelChoice choice);

}  // namespace espalier
