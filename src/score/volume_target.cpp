#include "score/volume_target.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "score/volume_kernel.h"
#include "score/volume_session.h"
#include "score/voxelise.h"

namespace espalier {

struct VolumeTarget::Parts {
  VolumeSettings settings;  // spill and outside_weight filled in
  VolumeKernel kernel;
  std::vector<std::uint64_t> voxels;  // per target mesh
  std::uint64_t wanted = 0;           // T
  std::vector<std::string> warnings;
};

namespace {

void check_weight(const VolumeSettings& settings, double weight, const char* what, bool may_be_negative) {
  if (!std::isfinite(weight) || (weight < 0 && !may_be_negative)) {
    throw Error(fmt::format("{}: {} must be finite{}, got {}", settings.name, what,
                            may_be_negative ? "" : " and >= 0", weight));
  }
}

void fill_in(VolumeSettings& settings) {
  validate(settings.grid, settings.name.c_str());
  if (settings.meshes.empty()) throw Error(fmt::format("{}: a volume target needs at least one mesh", settings.name));
  double spill = 0;
  for (VolumeMesh& mesh : settings.meshes) {
    if (!mesh.spill) mesh.spill = settings.form == VolumeForm::linear ? -1 : 1;
    check_weight(settings, mesh.fill, "fill", true);
    check_weight(settings, *mesh.spill, "spill", true);
    spill += *mesh.spill;
  }
  if (!settings.outside_weight) settings.outside_weight = spill;
  check_weight(settings, settings.overlap_weight, "overlap weight", false);
  check_weight(settings, *settings.outside_weight, "outside weight", true);
}

double in_voxels(std::uint64_t count) { return static_cast<double>(count); }

/// The linear optimum: every voxel whose weights add up to something positive, covered once.
double linear_optimum(const VolumeSettings& settings, const VolumeKernel& kernel) {
  const std::vector<BitGrid>& targets = kernel.targets();
  const VoxelGrid& grid = settings.grid;
  double nowhere = 0;
  for (const VolumeMesh& mesh : settings.meshes) nowhere += *mesh.spill;
  double sum = std::max(0.0, nowhere) * in_voxels(grid.cell_count() - kernel.union_of_targets().count());
  for (std::uint32_t y = 0; y < grid.cells[1]; ++y) {
    for (std::uint32_t z = 0; z < grid.cells[2]; ++z) {
      for (std::uint32_t x = 0; x < grid.cells[0]; ++x) {
        if (!kernel.union_of_targets().get(x, y, z)) continue;
        double weight = 0;
        for (std::size_t i = 0; i < targets.size(); ++i) {
          weight += targets[i].get(x, y, z) ? settings.meshes[i].fill : *settings.meshes[i].spill;
        }
        sum += std::max(0.0, weight);
      }
    }
  }
  return sum;
}

double step_optimum(const VolumeSettings& settings, double spill) {
  double sum = std::max(0.0, -spill);
  for (const VolumeMesh& mesh : settings.meshes) sum += std::max(0.0, mesh.fill);
  return sum;
}

/// Takes the meshes out of the settings: their voxels are all that is needed.
std::vector<BitGrid> voxelise_targets(VolumeSettings& settings, std::vector<std::string>& warnings) {
  std::vector<BitGrid> targets;
  for (VolumeMesh& mesh : settings.meshes) {
    VoxelisedMesh v = voxelise(mesh.mesh, settings.grid);
    if (v.open_edges > 0) {
      warnings.push_back(fmt::format("{}: {} is not closed ({} open edges); its inside was guessed by a vote of rays "
                                     "along x, y and z", settings.name, mesh.name, v.open_edges));
    }
    if (v.voxels.count() == 0) {
      throw Error(fmt::format("{}: {} covers no voxel: it is flat, thinner than a cell, or outside the grid",
                              settings.name, mesh.name));
    }
    targets.push_back(std::move(v.voxels));
    mesh.mesh = Mesh();
  }
  return targets;
}

}  // namespace

VolumeTarget::VolumeTarget(VolumeSettings settings, const MeshTable& meshes) {
  fill_in(settings);
  std::vector<std::string> warnings;
  std::vector<BitGrid> targets = voxelise_targets(settings, warnings);
  const VoxelGrid grid = settings.grid;
  BitGrid wanted(grid.cells[0], grid.cells[1], grid.cells[2]);
  const bool any_fill = std::any_of(settings.meshes.begin(), settings.meshes.end(), [](auto& m) { return m.fill > 0; });
  std::vector<std::uint64_t> voxels;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    voxels.push_back(targets[i].count());
    if (!any_fill || settings.meshes[i].fill > 0) unite(wanted, targets[i]);
    spill_ += *settings.meshes[i].spill;
  }
  VolumeKernel kernel(grid, make_solids(meshes), std::move(targets));
  optimum_ = settings.form == VolumeForm::linear ? linear_optimum(settings, kernel) : step_optimum(settings, spill_);
  wanted_ = in_voxels(wanted.count());
  parts_ = std::make_unique<const Parts>(
      Parts{std::move(settings), std::move(kernel), std::move(voxels), wanted.count(), std::move(warnings)});
}

VolumeTarget::~VolumeTarget() = default;

const VolumeSettings& VolumeTarget::settings() const { return parts_->settings; }
std::uint64_t VolumeTarget::target_voxels(std::size_t i) const { return parts_->voxels[i]; }
std::uint64_t VolumeTarget::wanted_voxels() const { return parts_->wanted; }
const std::vector<std::string>& VolumeTarget::warnings() const { return parts_->warnings; }

TargetView VolumeTarget::view() const {
  return settings().view == VolumeView::parts ? TargetView::parts : TargetView::full;
}

std::unique_ptr<TargetScratch> VolumeTarget::make_scratch() const {
  return std::make_unique<VolumeScratch>(settings().grid);
}

std::unique_ptr<TargetSession> VolumeTarget::make_session() const {
  return std::make_unique<VolumeSession>(*this, parts_->kernel);
}

std::size_t VolumeTarget::session_bytes() const { return CountingCanvas::bytes(Lattice(grid())); }

void VolumeTarget::counts(std::span<const Instance> instances, TargetScratch& scratch, VolumeCounts& counts) const {
  parts_->kernel.count(instances, settings().view, static_cast<VolumeScratch&>(scratch), counts);
}

VolumeCounts VolumeTarget::counts(std::span<const Instance> instances, TargetScratch& scratch) const {
  VolumeCounts result;
  counts(instances, scratch, result);
  return result;
}

CoveredVoxels VolumeTarget::covered(std::span<const Instance> instances) const {
  VolumeScratch scratch(grid());
  parts_->kernel.draw(instances, settings().view, scratch);
  return {std::move(scratch.canvas.once), std::move(scratch.canvas.twice)};
}

const BitGrid& VolumeTarget::voxels_of(std::size_t i) const { return parts_->kernel.targets()[i]; }

double VolumeTarget::score(const Derivation&, const Model& model, TargetScratch* scratch) const {
  CHECK(scratch != nullptr);
  auto& memory = static_cast<VolumeScratch&>(*scratch);
  counts(model.instances, memory, memory.counts);
  return evaluate(memory.counts);
}

}  // namespace espalier
