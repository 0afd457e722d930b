#include "score/gauge.h"

#include <algorithm>
#include <cmath>

#include "model/parts.h"
#include "model/primitives.h"

namespace espalier {
namespace {

std::vector<Vec3> distinct(std::vector<Vec3> positions) {
  const std::vector<std::uint32_t> welded = weld_by_position(positions);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (welded[i] == i) positions[kept++] = positions[i];
  }
  positions.resize(kept);
  return positions;
}

}  // namespace

Gauge::Solid Gauge::make_solid(const MeshTable& meshes, std::size_t i) {
  const Mesh& mesh = meshes.mesh(i);
  const MeshRef& ref = meshes.ref(i);
  const Bounds& box = meshes.mesh_bounds(i);
  Solid solid;
  solid.cone = ref.kind == MeshKind::cone;
  solid.empty = box.empty();
  solid.centred = box.centre() == Vec3(0);
  if (!solid.empty) solid.centre = box.centre(), solid.half = 0.5f * box.size();
  if (ref.kind != MeshKind::box) solid.corners = distinct(mesh.positions);
  if (open_edges(mesh) == 0) solid.volume = std::abs(espalier::volume(mesh));
  solid.triangles = static_cast<std::uint32_t>(with_normals(mesh).triangles.size());
  solid.pointed = solid.triangles;
  if (solid.cone) {
    solid.pointed = static_cast<std::uint32_t>(with_normals(make_primitive(ref.kind, 0, ref.sides)).triangles.size());
  }
  return solid;
}

Gauge::Gauge(const MeshTable& meshes, VolumeView view, const PerMeasure<bool>& wanted) : view_(view), wanted_(wanted) {
  for (const Measure measure : kAllMeasures) wants_model_ |= wanted[measure] && !facts_of(measure).by_genes;
  if (!wants_model_) return;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    solids_.push_back(make_solid(meshes, i));
    const MeshRef& ref = meshes.ref(i);
    if (ref.kind == MeshKind::file && open_edges(meshes.mesh(i)) > 0) open_files_.push_back(ref.path);
  }
}

void Gauge::measure(const Derivation& derivation, const Model& model, Scratch& scratch,
                    PerMeasure<double>& out) const {
  if (wanted_[Measure::genes]) out[Measure::genes] = static_cast<double>(derivation.size());
  if (wanted_[Measure::depth] || wanted_[Measure::balance]) measure_genes(derivation, scratch, out);
  if (wants_model_) measure_parts(model.instances, out);
}

void Gauge::measure_genes(const Derivation& derivation, Scratch& scratch, PerMeasure<double>& out) const {
  std::vector<OpenGene>& path = scratch.path;
  path.clear();
  std::size_t depth = 0, branching = 0;
  double balance = 0;
  const auto close = [&] {
    const OpenGene& gene = path.back();
    if (gene.children > 1) balance += static_cast<double>(gene.smallest) / gene.largest, ++branching;
    path.pop_back();
  };
  for (std::size_t i = 0; i < derivation.size(); ++i) {
    while (!path.empty() && path.back().end == i) close();
    const std::uint32_t size = derivation.genes[i].genes_below + 1;
    depth = std::max(depth, path.size());
    if (!path.empty()) {
      OpenGene& parent = path.back();
      parent.smallest = parent.children == 0 ? size : std::min(parent.smallest, size);
      parent.largest = std::max(parent.largest, size);
      ++parent.children;
    }
    if (size > 1) path.push_back({i + size, 0, 0, 0});
  }
  while (!path.empty()) close();
  out[Measure::depth] = static_cast<double>(depth);
  out[Measure::balance] = branching == 0 ? 1 : balance / static_cast<double>(branching);
}

}  // namespace espalier
