#include "run/make_engine.h"

#include "base/check.h"
#include "search/ga.h"
#include "search/genesis.h"
#include "search/guided.h"
#include "search/hybrid.h"
#include "search/rjmcmc.h"
#include "search/smc.h"

namespace espalier {

std::unique_ptr<Engine> make_engine(const SceneSearch& search, const SearchProblem& problem) {
  switch (search.engine) {
    case EngineKind::ga: return std::make_unique<GaEngine>(problem, search.ga);
    case EngineKind::smc: return std::make_unique<SmcEngine>(problem, search.smc);
    case EngineKind::sosmc: return std::make_unique<SmcEngine>(problem, search.sosmc);
    case EngineKind::rjmcmc: return std::make_unique<RjmcmcEngine>(problem, search.rjmcmc);
    case EngineKind::guided: return std::make_unique<GuidedEngine>(problem, search.guided);
    case EngineKind::genesis: return std::make_unique<GenesisEngine>(problem, search.genesis);
    case EngineKind::hybrid: break;
  }
  HybridSettings hybrid = search.hybrid;
  hybrid.start = search.sosmc, hybrid.middle = search.ga, hybrid.end = search.rjmcmc;
  return std::make_unique<HybridEngine>(problem, hybrid);
}

}  // namespace espalier
