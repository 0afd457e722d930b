#include "studio/model_message.h"

#include <algorithm>

#include "derivation/sweep.h"
#include "model/parts.h"
#include "model/primitives.h"
#include "studio/message_writer.h"

namespace espalier::studio {
namespace {

Mesh box_of(const Bounds& bounds) {
  Mesh box = make_primitive(MeshKind::box, 1, 0);
  for (Vec3& p : box.positions) p = bounds.centre() + p * bounds.size();
  return box;
}

/// Of a cylinder with more it is not said that it is a twig.
constexpr std::uint16_t kMostSidesOfTwig = 5;

/// What a page may take for granted of a mesh.
std::uint32_t kind_of(const MeshRef& ref) {
  switch (ref.kind) {
    case MeshKind::cone: return 1;
    case MeshKind::leaf: return 2;
    case MeshKind::cylinder: return ref.sides <= kMostSidesOfTwig ? 3 : 0;
    default: return 0;
  }
}

void add_mesh(MessageWriter& out, const Mesh& seen, std::uint32_t kind) {
  const Mesh mesh = with_normals(seen);
  out.add(static_cast<std::uint32_t>(mesh.positions.size()));
  out.add(static_cast<std::uint32_t>(mesh.triangles.size()));
  out.add(kind);
  for (const Vec3& p : mesh.positions) out.add(p);
  for (const Vec3& n : mesh.normals) out.add(n);
  for (const Triangle& t : mesh.triangles) out.add(t[0]), out.add(t[1]), out.add(t[2]);
}

void add_genes(MessageWriter& out, const GeneratorGraph& graph, const Derivation& derivation) {
  GeneSweep sweep;
  sweep.begin(graph, derivation);
  while (sweep.next()) {
    out.add(std::uint32_t{graph.edges[sweep.gene().edge].child});
    out.add(sweep.parent() == GeneSweep::kNoParent ? std::int32_t{-1} : static_cast<std::int32_t>(sweep.parent()));
  }
}

}  // namespace

std::string mesh_message(std::uint32_t table, const MeshTable& meshes) {
  MessageWriter out("ESPG", 1, 1 << 16);
  out.add(table);
  out.add(static_cast<std::uint32_t>(meshes.size()));
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    triangles += meshes.mesh(i).triangles.size();
    add_mesh(out, triangles > kMostSentTriangles ? box_of(meshes.mesh_bounds(i)) : meshes.mesh(i),
             kind_of(meshes.ref(i)));
  }
  return out.take();
}

std::string mesh_message(std::uint32_t table, const Mesh& mesh, std::uint64_t most_triangles) {
  MessageWriter out("ESPG", 1, 24 * mesh.positions.size() + 12 * mesh.triangles.size() + 28);
  out.add(table);
  out.add(std::uint32_t{1});
  add_mesh(out, mesh.triangles.size() > most_triangles ? box_of(bounds(mesh)) : mesh, 0);
  return out.take();
}

SentModel model_message(std::uint32_t number, std::uint32_t table, const GeneratorGraph& graph,
                        const Derivation& derivation, const Model& model) {
  SentModel sent;
  std::vector<const Instance*> shown;
  for (const Instance& instance : model.instances) {
    if (!can_be_shown(instance.model_from_mesh)) continue;
    if (shown.size() == kMostSentParts) {
      sent.truncated = true;
      break;
    }
    shown.push_back(&instance);
  }
  sent.parts = shown.size();
  std::uint32_t bones = 0;
  const auto finite = [](const Vec3& p) { return can_be_shown({Mat3(1.0f), p}); };
  const std::size_t most_bones = std::min(model.bones.size(), kMostSentParts);
  const std::size_t materials = graph.materials.size() + model.materials.size();
  MessageWriter out("ESPM", 1, 32 + 64 * shown.size() + 32 * most_bones + MessageWriter::kMaterialBytes * materials +
                                   8 * derivation.size());
  out.add(number);
  out.add(static_cast<std::uint32_t>(shown.size()));
  bones = static_cast<std::uint32_t>(most_bones);
  out.add(bones);
  out.add(static_cast<std::uint32_t>(materials));
  out.add(static_cast<std::uint32_t>(derivation.size()));
  out.add(table);
  for (const Instance* instance : shown) {
    const Frame& frame = instance->model_from_mesh;
    for (int c = 0; c < 3; ++c) out.add(frame.basis[c]);
    out.add(frame.origin);
    out.add(instance->top);
    out.add(instance->gene);
    out.add(instance->mesh);
    out.add(instance->material);
    out.add(static_cast<std::uint32_t>(instance->layer));
  }
  for (std::size_t i = 0; i < most_bones; ++i) {
    // Bones that lead nowhere stay in their places, since others name them as their parents.
    const Bone& bone = model.bones[i];
    const bool good = finite(bone.from) && finite(bone.to);
    out.add(good ? bone.from : Vec3(0));
    out.add(good ? bone.to : Vec3(0));
    out.add(bone.gene);
    out.add(bone.parent);
  }
  for (const Material& material : graph.materials) out.add(material);
  for (const MadeMaterial& made : model.materials) out.add(graph.recipes[made.recipe].material(made.steps));
  add_genes(out, graph, derivation);
  sent.bytes = out.take();
  return sent;
}

std::string cloud_message(std::string_view rule, const std::vector<CloudPoint>& points) {
  MessageWriter out("ESPC", 1, rule.size() + 16 * points.size() + 16);
  out.add(static_cast<std::uint32_t>(rule.size()));
  out.add(static_cast<std::uint32_t>(points.size()));
  out.add(rule);
  out.pad();
  for (const CloudPoint& point : points) {
    out.add(point.at);
    out.add(point.kind);
  }
  return out.take();
}

}  // namespace espalier::studio
