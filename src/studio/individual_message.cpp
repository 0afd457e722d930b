#include "studio/individual_message.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>

#include "model/parts.h"
#include "studio/message_writer.h"
#include "studio/model_message.h"

namespace espalier::studio {
namespace {

constexpr std::size_t kAddressAt = 8, kHead = 64;
constexpr float kSteps = 65535;
constexpr float kLargestHalf = 65504;

/// What records are measured by.
struct Measure {
  Vec3 low{0}, span{0};  // box around all origins
  float longest = 0;     // of the axes' components
};

Measure measure_of(const std::vector<const Instance*>& shown) {
  Measure measure;
  if (!shown.empty()) measure.low = shown.front()->model_from_mesh.origin;
  Vec3 high = measure.low;
  for (const Instance* instance : shown) {
    const Frame& frame = instance->model_from_mesh;
    measure.low = glm::min(measure.low, frame.origin);
    high = glm::max(high, frame.origin);
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) measure.longest = std::max(measure.longest, std::abs(frame.basis[c][r]));
    }
  }
  measure.span = high - measure.low;
  return measure;
}

using Record = std::array<std::uint16_t, 16>;

Record record_of(const Instance& instance, const Measure& measure) {
  const Frame& frame = instance.model_from_mesh;
  Record record{};
  for (int i = 0; i < 3; ++i) {
    const float along = measure.span[i] > 0 ? (frame.origin[i] - measure.low[i]) / measure.span[i] : 0.0f;
    record[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(along * kSteps + 0.5f);
  }
  const float unit = measure.longest > 0 ? measure.longest : 1.0f;
  std::size_t at = 3;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) record[at++] = glm::packHalf1x16(frame.basis[c][r] / unit);
  }
  // As pages take it; of what is no cone it says nothing.
  record[12] = glm::packHalf1x16(std::isfinite(instance.top) ? std::clamp(instance.top, 0.0f, kLargestHalf) : 1.0f);
  record[13] = instance.mesh;
  record[14] = instance.material;
  return record;
}

}  // namespace

IndividualModel individual_model(const GeneratorGraph& graph, const Model& model) {
  IndividualModel made;
  std::vector<const Instance*> shown;
  shown.reserve(std::min(model.instances.size(), kMostSentParts));
  for (const Instance& instance : model.instances) {
    if (!is_shown(instance, true)) continue;
    if (shown.size() == kMostSentParts) {
      made.truncated = true;
      break;
    }
    shown.push_back(&instance);
  }
  const Measure measure = measure_of(shown);
  const std::size_t materials = graph.materials.size() + model.materials.size();
  MessageWriter out("ESPI", 2, kHead + sizeof(Record) * shown.size() + MessageWriter::kMaterialBytes * materials);
  for (int i = 0; i < 4; ++i) out.add(std::uint32_t{0});
  out.add(static_cast<std::uint32_t>(shown.size()));
  out.add(static_cast<std::uint32_t>(materials));
  out.add(measure.low);
  out.add(measure.span);
  out.add(measure.longest);
  out.add(std::uint32_t{0});
  for (const Instance* instance : shown) {
    const Record record = record_of(*instance, measure);
    out.add({reinterpret_cast<const char*>(record.data()), sizeof(record)});
  }
  for (const Material& material : graph.materials) out.add(material);
  for (const MadeMaterial& material : model.materials) out.add(graph.recipes[material.recipe].material(material.steps));
  made.bytes = out.take();
  return made;
}

std::string addressed(const std::string& bytes, const IndividualAddress& address) {
  std::string copy = bytes;
  const std::uint32_t words[] = {address.session, address.individual, address.version, address.table};
  std::memcpy(copy.data() + kAddressAt, words, sizeof(words));
  return copy;
}

}  // namespace espalier::studio
