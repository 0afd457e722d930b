#include "run/similarity.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "run/csv.h"

namespace espalier {
namespace {

ShownModel load(const SimilarityRequest& request, std::size_t i, MeshSource& source) {
  return load_shown_model(request.models[i], request.grammar, request.attributes, source);
}

/// Around all models. They are read again when they are described: together they may be too large for memory.
Bounds box_around_all(const SimilarityRequest& request, MeshSource& source) {
  Bounds box;
  for (std::size_t i = 0; i < request.models.size(); ++i) box.add(bounds(load(request, i, source).shell));
  return box;
}

/// Loads and describes one model, and measures it against itself.
ShapeDescriptor describe_model(const SimilarityRequest& request, std::size_t i, const std::optional<Bounds>& shared,
                               MeshSource& source, Executor& executor, ComparedModel& model) {
  const ShownModel shown = load(request, i, source);
  model.path = request.models[i];
  model.is_mesh = shown.is_mesh, model.truncated = shown.truncated, model.adapted = shown.adapted;
  model.triangles = triangle_count(shown.shell);
  model.box = bounds(shown.shell);
  const Subdivision grid(shared.value_or(model.box), request.descriptor.layers);
  DescriptorSettings settings = request.descriptor;
  try {
    ShapeDescriptor descriptor = describe(shown.shell, grid, settings, executor);
    model.area = std::accumulate(descriptor.areas.begin(), descriptor.areas.end(), 0.0);
    settings.draw = 1;
    model.anew = distance(descriptor, describe(shown.shell, grid, settings, executor));
    return descriptor;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", model.path, error.what()));
  }
}

/// Where pair (a, b) stands among those of n models, a < b.
std::size_t place_of(std::size_t a, std::size_t b, std::size_t n) { return a * (2 * n - a - 1) / 2 + b - a - 1; }

}  // namespace

void validate(const SimilarityRequest& request) {
  const std::size_t count = request.models.size();
  if (count < 2 || count > SimilarityRequest::kMostModels)
    throw Error(fmt::format("similarity compares from 2 to {} models, got {}", SimilarityRequest::kMostModels, count));
  validate(request.descriptor);
  if (std::all_of(request.models.begin(), request.models.end(), names_mesh)) {
    if (!request.attributes.empty()) throw Error("-D goes with derivations, and all of the models are mesh files");
    if (!request.grammar.empty()) throw Error("--grammar goes with derivations, and all of the models are mesh files");
  }
}

ShapeDistance distance(const ShapeDescriptor& a, const ShapeDescriptor& b) {
  const std::vector<double> voxels = voxel_distances(a, b);
  ShapeDistance result;
  std::vector<double> occupied;
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    const bool first = a.areas[v] > 0, second = b.areas[v] > 0;
    ++(first ? second ? result.both : result.only_first : second ? result.only_second : result.neither);
    if (first || second) occupied.push_back(voxels[v]);
  }
  result.all = summarise(voxels);
  if (!occupied.empty()) result.occupied = summarise(std::move(occupied));
  return result;
}

const ShapeDistance& SimilarityReport::pair(std::size_t a, std::size_t b) const {
  CHECK(a != b && a < models.size() && b < models.size());
  return pairs[place_of(std::min(a, b), std::max(a, b), models.size())];
}

SimilarityReport compare_shapes(const SimilarityRequest& request, MeshSource& source, Executor& executor) {
  validate(request);
  const std::size_t n = request.models.size();
  std::optional<Bounds> shared;
  if (request.shared_box) shared = box_around_all(request, source);
  SimilarityReport report;
  report.models.resize(n);
  std::vector<ShapeDescriptor> descriptors;
  for (std::size_t i = 0; i < n; ++i)
    descriptors.push_back(describe_model(request, i, shared, source, executor, report.models[i]));
  report.pairs.resize(n * (n - 1) / 2);
  executor.for_each(n, [&](std::size_t a, int) {
    for (std::size_t b = a + 1; b < n; ++b) report.pairs[place_of(a, b, n)] = distance(descriptors[a], descriptors[b]);
  });
  if (n == 2) report.voxels = voxel_distances(descriptors[0], descriptors[1]);
  return report;
}

double median(const ShapeDistance& distance, VoxelChoice choice) {
  if (choice == VoxelChoice::all) return distance.all.median;
  return distance.occupied ? distance.occupied->median : 0;
}

std::string similarity_csv(const SimilarityReport& report, VoxelChoice choice) {
  std::string csv = "model";
  for (const ComparedModel& model : report.models) csv += "," + csv_field(model.path);
  csv += "\n";
  for (std::size_t a = 0; a < report.models.size(); ++a) {
    csv += csv_field(report.models[a].path);
    for (std::size_t b = 0; b < report.models.size(); ++b)
      csv += "," + csv_number(a == b ? 0 : median(report.pair(a, b), choice));
    csv += "\n";
  }
  return csv;
}

}  // namespace espalier
