#include "search/engine.h"

#include "search/gauges.h"

namespace espalier {

double Engine::mean_score() const { return espalier::mean_score(population()); }

}  // namespace espalier
