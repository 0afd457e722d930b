#pragma once
// One gene of a shown model, as the page asks for it.

#include <studio_types.h>

#include "studio/shown_model.h"

namespace espalier::studio {

/// Throws Error where the model has no such gene.
api::Gene gene_text(const ShownModel& shown, std::int64_t gene);
/// The model with one draw of a gene set to a quantile in 0..1. Throws Error where there is no such draw.
Derivation with_draw(const ShownModel& shown, std::int64_t gene, std::int64_t index, double quantile);
/// The number of the gene with a path, as path_of writes it. Throws Error where the model has none there.
std::int64_t gene_at(const ShownModel& shown, const std::string& path);
/// "Trunk/Branch[2]". Throws Error.
std::string path_of(const ShownModel& shown, std::int64_t gene);
/// Whether the gene with one path is that with the other, or somewhere above it on the same branch.
bool stands_on(const std::string& path, const std::string& other);

}  // namespace espalier::studio
