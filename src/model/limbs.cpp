#include "model/limbs.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "model/cell_map.h"
#include "model/parts.h"

namespace espalier {
namespace {

constexpr float kReach = 0.6f;         // tip radii between a tip and the base that goes on there
constexpr float kStraight = 0.2588f;   // the cosine of 75 degrees
constexpr float kThinnest = 0.3f, kThickest = 1.7f;  // base over tip radius of spans that go on
constexpr float kRound = 0.05f;        // how unequal or skew the axes of a span may be
constexpr std::uint32_t kNone = Limbs::kNone;

struct Span {
  Vec3 base, tip, direction;
  float base_radius, tip_radius, length;
  std::uint32_t instance;
  std::uint16_t material;
  std::uint32_t before = kNone, after = kNone;  // spans of its limb

  float radius_at(float share) const { return base_radius + (tip_radius - base_radius) * share; }
};

bool is_round(const Mat3& m, const float (&lengths)[3]) {
  if (!(lengths[0] > 0 && lengths[1] > 0 && lengths[2] > 0)) return false;
  if (std::abs(lengths[0] - lengths[2]) > kRound * lengths[0]) return false;
  const auto skew = [&](int a, int b) { return std::abs(glm::dot(m[a], m[b])) > kRound * lengths[a] * lengths[b]; };
  return !skew(0, 1) && !skew(1, 2) && !skew(0, 2);
}

/// The spans among the instances that are shown, in their order.
std::vector<Span> collect_spans(const Model& model, const MeshTable& meshes, bool full) {
  std::vector<Span> spans;
  for (std::uint32_t i = 0; i < model.instances.size(); ++i) {
    const Instance& instance = model.instances[i];
    const MeshKind kind = meshes.ref(instance.mesh).kind;
    if ((kind != MeshKind::cone && kind != MeshKind::cylinder) || !is_shown(instance, full)) continue;
    const auto& [m, origin] = instance.model_from_mesh;
    const float lengths[] = {glm::length(m[0]), glm::length(m[1]), glm::length(m[2])};
    if (!is_round(m, lengths)) continue;
    Span span;
    span.base = origin - 0.5f * m[1], span.tip = origin + 0.5f * m[1];
    span.direction = m[1] / lengths[1], span.length = lengths[1];
    span.base_radius = 0.25f * (lengths[0] + lengths[2]);
    span.tip_radius = span.base_radius * (kind == MeshKind::cone ? std::max(instance.top, 0.0f) : 1);
    span.instance = i, span.material = instance.material;
    spans.push_back(span);
  }
  return spans;
}

Bounds around(const Vec3& point, float reach) {
  Bounds box;
  box.add(point - Vec3(reach)), box.add(point + Vec3(reach));
  return box;
}

/// Ties every span to the one that goes on from it.
void tie(std::vector<Span>& spans) {
  CellMap bases;
  for (std::uint32_t i = 0; i < spans.size(); ++i) bases.add(i, around(spans[i].base, 0), spans[i].base_radius);
  bases.finish();
  struct Pair {
    float cost;
    std::uint32_t before, after;
  };
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < spans.size(); ++i) {
    const Span& a = spans[i];
    const float reach = kReach * a.tip_radius;
    if (!(reach > 0)) continue;
    bases.visit_near(around(a.tip, reach), kThinnest * a.tip_radius, kThickest * a.tip_radius, [&](std::uint32_t j) {
      const Span& b = spans[j];
      if (j <= i || b.material != a.material) return;
      const float ratio = b.base_radius / a.tip_radius, gap = glm::length(b.base - a.tip);
      const float turn = glm::dot(a.direction, b.direction);
      if (ratio < kThinnest || ratio > kThickest || gap > reach || turn < kStraight) return;
      pairs.push_back({std::abs(1 - ratio) + 0.5f * (1 - turn) + 0.1f * gap / reach, i, j});
    });
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
    if (p.cost != q.cost) return p.cost < q.cost;
    return p.before != q.before ? p.before < q.before : p.after < q.after;
  });
  for (const Pair& pair : pairs) {
    if (spans[pair.before].after != kNone || spans[pair.after].before != kNone) continue;
    spans[pair.before].after = pair.after, spans[pair.after].before = pair.before;
  }
}

Bounds box_of(const Span& span) {
  Bounds box;
  box.add(span.base), box.add(span.tip);
  const float reach = std::max(span.base_radius, span.tip_radius);
  box.min -= Vec3(reach), box.max += Vec3(reach);
  return box;
}

/// Which limb each first span leaves, and how far below that one's surface it begins.
class Hosts {
 public:
  Hosts(const std::vector<Span>& spans, const std::vector<std::uint32_t>& limb_of_span)
      : spans_(spans), limb_of_span_(limb_of_span) {
    for (std::uint32_t i = 0; i < spans.size(); ++i) {
      const float size = std::max({spans[i].length, spans[i].base_radius, spans[i].tip_radius});
      boxes_.add(i, box_of(spans[i]), size);
      least_ = std::min(least_, size), most_ = std::max(most_, size);
    }
    boxes_.finish();
  }

  void settle(Limb& limb, const Span& first, std::uint32_t own) const {
    const Span* host = nullptr;
    float share = 0, radius = 0;
    boxes_.visit_near(around(first.base, 0), least_, most_, [&](std::uint32_t i) {
      const Span& span = spans_[i];
      if (limb_of_span_[i] == own || span.instance >= first.instance) return;
      const float along = glm::dot(first.base - span.base, span.direction) / span.length;
      if (along < -0.1f || along > 1.1f) return;
      const float clamped = std::clamp(along, 0.0f, 1.0f), here = span.radius_at(clamped);
      const float off = glm::length(first.base - (span.base + span.direction * (along * span.length)));
      if (off > 1.05f * here || here <= radius) return;
      host = &span, share = clamped, radius = here;
    });
    if (!host) return;
    const float sine = std::sqrt(std::max(0.0f, 1 - glm::dot(first.direction, host->direction) *
                                                        glm::dot(first.direction, host->direction)));
    const Vec3 axis = host->base + host->direction * (share * host->length), off = first.base - axis;
    limb.host = radius;
    limb.depth = std::max(0.0f, radius - glm::dot(off, first.direction)) / std::max(sine, 0.35f);
  }

 private:
  const std::vector<Span>& spans_;
  const std::vector<std::uint32_t>& limb_of_span_;
  CellMap boxes_;
  float least_ = 1e30f, most_ = 0;
};

/// Spheres that only round a joint off join its limb.
void take_in_spheres(const Model& model, const MeshTable& meshes, bool full, Limbs& out) {
  CellMap joints;
  std::vector<std::pair<std::uint32_t, const LimbJoint*>> all;
  for (std::uint32_t limb = 0; limb < out.limbs.size(); ++limb) {
    for (const LimbJoint& joint : out.limbs[limb].joints) {
      if (!(joint.radius > 0)) continue;
      joints.add(static_cast<std::uint32_t>(all.size()), around(joint.at, 0), joint.radius);
      all.emplace_back(limb, &joint);
    }
  }
  joints.finish();
  for (std::uint32_t i = 0; i < model.instances.size(); ++i) {
    const Instance& instance = model.instances[i];
    if (meshes.ref(instance.mesh).kind != MeshKind::sphere || !is_shown(instance, full)) continue;
    const Mat3& m = instance.model_from_mesh.basis;
    const float lengths[] = {glm::length(m[0]), glm::length(m[1]), glm::length(m[2])};
    const float radius = 0.5f * std::max({lengths[0], lengths[1], lengths[2]});
    if (!(radius > 0)) continue;
    joints.visit_near(around(instance.model_from_mesh.origin, 0.3f * radius), 0.8f * radius, 2 * radius,
                      [&](std::uint32_t k) {
      const auto& [limb, joint] = all[k];
      if (out.limb_of[i] != kNone || out.limbs[limb].material != instance.material) return;
      const float off = glm::length(instance.model_from_mesh.origin - joint->at);
      if (off <= 0.3f * joint->radius && radius <= 1.1f * joint->radius) out.limb_of[i] = limb;
    });
  }
}

}  // namespace

Limbs find_limbs(const Model& model, const MeshTable& meshes, bool full) {
  Limbs out;
  out.limb_of.assign(model.instances.size(), kNone);
  std::vector<Span> spans = collect_spans(model, meshes, full);
  tie(spans);
  std::vector<std::uint32_t> limb_of_span(spans.size(), kNone), first_of;
  for (std::uint32_t i = 0; i < spans.size(); ++i) {
    if (spans[i].before != kNone) continue;
    const auto number = static_cast<std::uint32_t>(out.limbs.size());
    Limb& limb = out.limbs.emplace_back();
    limb.material = spans[i].material;
    limb.joints.push_back({spans[i].base, spans[i].base_radius});
    for (std::uint32_t k = i; k != kNone; k = spans[k].after) {
      limb_of_span[k] = out.limb_of[spans[k].instance] = number;
      limb.parts.push_back(spans[k].instance);
      const std::uint32_t next = spans[k].after;
      // Where two spans meet the limb passes between what each of them says.
      const bool ends = next == kNone;
      limb.joints.push_back(ends ? LimbJoint{spans[k].tip, spans[k].tip_radius}
                                 : LimbJoint{0.5f * (spans[k].tip + spans[next].base),
                                             0.5f * (spans[k].tip_radius + spans[next].base_radius)});
    }
    first_of.push_back(i);
  }
  const Hosts hosts(spans, limb_of_span);
  for (std::uint32_t k = 0; k < out.limbs.size(); ++k) hosts.settle(out.limbs[k], spans[first_of[k]], k);
  take_in_spheres(model, meshes, full, out);
  return out;
}

}  // namespace espalier
