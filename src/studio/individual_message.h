#pragma once
// ESPI (docs/studio-protocol.md): the model of an individual of the breeding room. Twenty at a time are to be there at once and
// are looked at from afar, so that a part has 32 bytes: half of what it has in ESPM, and nothing of genes, bones and proxies.

#include <cstdint>
#include <string>

#include "grammar/graph.h"
#include "model/model.h"

namespace espalier::studio {

struct IndividualModel {
  std::string bytes;       // ESPI of nobody: addressed() says whose
  bool truncated = false;  // there are more than kMostSentParts
};

/// `model`: with details and materials. Parts whose frame is not finite are left out. Origins are exact to 1/65535 of the
/// box around them all; axes to 1/2048, but for those shorter than 1/16384 of the model's longest.
IndividualModel individual_model(const GeneratorGraph& graph, const Model& model);

struct IndividualAddress {
  std::uint32_t session = 0, individual = 0, version = 0, table = 0;
};
/// A copy of `bytes` that says whose it is.
std::string addressed(const std::string& bytes, const IndividualAddress& address);

}  // namespace espalier::studio
