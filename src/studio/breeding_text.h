#pragma once
// What pages are told of the breeding room in texts.

#include <optional>
#include <string>
#include <vector>

#include <studio_types.h>

#include "studio/breeding_session.h"

namespace espalier::studio {

api::Breedings breedings_text(const std::vector<BreedingSummary>& sessions, std::optional<std::int64_t> open);

/// `problem`, `busy`: as the message has them; empty: nothing.
api::Breeding breeding_text(const BreedingSession& session, const std::string& problem, const std::string& busy);

api::Lineage lineage_text(const BreedingSession& session);

}  // namespace espalier::studio
