#pragma once
// Variation: how children are made of one, two or three parents. Every child is a valid, finished derivation, has its
// first parent's detail seed (a mixture its heaviest parent's, a sibling one of its own), and its first parent's values
// of all that is held. Values that a person set are quantiles like all others: children inherit them.

#include <span>

#include "base/random.h"
#include "breed/draw_locks.h"
#include "derivation/derivation.h"

namespace espalier {

/// A child that differs from its parent. `strength` in [0, 1]: at 0 one draw moves by some hundredths of its range,
/// at 1 most move by a third of it and genes come and go. Steps are bell-shaped; continuous quantiles reflect at
/// their ends, circular ones wrap, those of n values go to another value. The parent itself where all is held.
Derivation mutate(const GeneratorGraph& graph, const Derivation& parent, const Held& held, double strength,
                  RandomStream& random);

/// A child of two: where their genes agree, draws come from either, as whole genes of the derivation or draw by draw
/// (single genes); and with chance 3/4 a subtree of the second takes the place of one of the first
/// (derivation/crossover.h). May equal a parent.
Derivation cross(const GeneratorGraph& graph, const Derivation& first, const Derivation& second, const Held& held,
                 RandomStream& random);

/// A mixture of two or three: of draws that all parents have (same path, same rule and variant) the quantile is the
/// weighted mean, that of circular ones along the shorter way round, that of n values the value nearest to the mean;
/// the rest is the heaviest parent's (of equals the first), or where genes are locked the first's. `weights` >= 0,
/// their sum above 0. Draws no random numbers. Held values are those of the first parent.
Derivation blend(const GeneratorGraph& graph, std::span<const Derivation* const> parents,
                 std::span<const double> weights, const Held& held);

/// The child moved by `amount` times the way from `away` to `toward`, in draws that all three have (same path, rule and
/// variant): what people liked in one beside the other, carried over. Continuous quantiles stop at their ends, circular
/// ones go round, those of n values move by the nearest number of values. What is held stays. Draws no random numbers.
void lean(const GeneratorGraph& graph, const Derivation& toward, const Derivation& away, double amount,
          const Held& held, Derivation& child);

/// "More like this": all of a favourite's draws move a little and its subtrees stay, but for one that may change when
/// strength is above 1/2; another detail seed, so its chances fall otherwise.
Derivation make_sibling(const GeneratorGraph& graph, const Derivation& favourite, const Held& held, double strength,
                        RandomStream& random);

/// One quantile, moved by a bell-shaped step of standard deviation `scale` (a share of the range, above 0), as its
/// shape wants it. Draws of n values always change, where n > 1.
std::uint32_t step_quantile(std::uint32_t quantile, const DrawComponent& draw, double scale, RandomStream& random);

}  // namespace espalier
