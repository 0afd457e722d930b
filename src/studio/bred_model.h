#pragma once
// BredModel: what pages are shown and told of an individual's derivation: its parts, its measures, its score, whether it is
// viable. It depends on the derivation and the project's state alone, so that copies share one.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <studio_types.h>

#include "breed/features.h"
#include "breed/viability.h"
#include "model/expand.h"
#include "score/target.h"
#include "studio/outbox.h"
#include "studio/workbench.h"

namespace espalier::studio {

struct BredModel {
  std::string bytes;             // ESPI of nobody (individual_message.h)
  api::Bred facts;               // but for session, individual and version
  std::vector<double> features;  // breed/features.h
};
using BredModelPtr = std::shared_ptr<const BredModel>;

/// What can be told without targets. `model`: with details and materials.
BredModel bred_model(const GeneratorGraph& graph, const Derivation& derivation, const Model& model,
                     const ViabilityReport& report, std::vector<double> features);

/// The memory of one thread that makes them.
class BredModelMaker {
 public:
  static constexpr std::size_t kMostParts = 100'000;  // of an individual

  /// `setup`: of the project's state; `scored`: whether the scene has targets; limits count in any case.
  BredModelMaker(std::shared_ptr<const Setup> setup, bool scored, const ViabilitySettings& viability);
  BredModelPtr make(const Derivation& derivation);

 private:
  void add_targets(const Derivation& derivation, api::Bred& facts);
  Explanation explain(const Derivation& derivation);

  std::shared_ptr<const Setup> setup_;
  bool scored_;
  Viability viability_;
  Features features_;
  Expander expander_;
  Viability::Scratch scratch_;
  Model model_, view_;
};

/// ESPI with its text.
ModelPacket bred_packet(const BredModel& model, const Bytes& meshes, std::uint32_t table, std::int64_t session,
                        std::int64_t individual, std::uint32_t version);

}  // namespace espalier::studio
