#pragma once
// All genes of an individual that have draws, as the breeding room's sliders want them, and how one is set. Draws are
// named by their index among those of the gene's rule, so that a name means the same in every individual.

#include <vector>

#include <studio_types.h>

#include "breed/draw_locks.h"
#include "run/setup.h"

namespace espalier::studio {

inline constexpr std::size_t kMostAskedDraws = 2000;

/// Genes from the start on, with what `held` holds of them; `truncated` where there are more draws.
std::vector<api::BredGene> individual_genes(const Setup& setup, const Derivation& derivation, const Held& held,
                                            bool& truncated);

/// Throws Error where the derivation has no such draw.
void set_draw(const GeneratorGraph& graph, Derivation& derivation, const api::DrawSetting& setting);

/// Throws Error where no derivation of the graph has a draw there.
void require_place(const GeneratorGraph& graph, const api::DrawPlace& place);

}  // namespace espalier::studio
