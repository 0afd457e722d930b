#pragma once
// ReportModel: a model as a web page takes it: shared shapes, their places and colours, the targets, in one run of
// bytes. All numbers little endian, without gaps, in this order:
//   positions  3 float32 per vertex, shape by shape        normals   4 int16 per vertex, -32767..32767, the last 0
//   triangles  3 uint32 per triangle, within its shape     places    12 float32 per part: three axes, then the origin
//   kinds      2 uint32 per part: shape, material
// The target meshes are the last shapes; no part has them.

#include <cstdint>
#include <string>
#include <vector>

#include "model/model.h"

namespace espalier {

struct ReportModel {
  std::string bytes;
  std::string header;  // JSON: {"shapes": [[vertices, triangles], ...], "parts", "triangles", "materials": [...],
                       //        "targets": [shape, ...], "note"}
  std::uint64_t triangles = 0;  // of all parts together
  std::string note;             // what was left out, in words; empty: nothing
};

/// What a page may hold.
struct ReportBudget {
  std::uint64_t model_bytes = 6'000'000, target_bytes = 1'800'000;
  std::uint64_t triangles = 1'000'000;  // of all parts together, and of the targets
};

/// The parts with details. Where they are too many, the largest that fit; targets that do not fit are left out.
ReportModel make_report_model(const Model& model, const MeshTable& meshes, const std::vector<Material>& materials,
                              const std::vector<Mesh>& targets, const ReportBudget& budget = {});

}  // namespace espalier
