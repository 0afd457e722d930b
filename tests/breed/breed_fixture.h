#pragma once
// A shipped grammar, ready to be bred.

#include <functional>
#include <memory>
#include <string>

#include "base/executor.h"
#include "breed/breed_problem.h"
#include "breed/usual_viability.h"
#include "no_files.h"
#include "shipped_grammar.h"

namespace espalier::test {

struct BreedFixture {
  BreedProblem problem;

  explicit BreedFixture(const std::string& grammar, int threads = 1,
                        const std::function<void(ModelAppraiser::Settings&)>& change = {}, BatchScorer* targets = nullptr)
      : executor_(make_thread_executor(threads)) {
    problem.graph = compile_shipped(grammar);
    meshes_ = meshes_of(*problem.graph);
    ModelAppraiser::Settings settings;
    settings.viability = usual_viability(*problem.graph, meshes_);
    if (change) change(settings);
    appraiser_ = std::make_unique<ModelAppraiser>(problem.graph, meshes_, settings, targets, *executor_);
    problem.appraiser = appraiser_.get();
    problem.seed = 5;
  }

  const GeneratorGraph& graph() const { return *problem.graph; }
  const MeshTable& meshes() const { return meshes_; }
  Appraisal appraise(const Derivation& derivation) {
    const Derivation* one[] = {&derivation};
    return problem.appraiser->appraise(one)[0];
  }

 private:
  std::unique_ptr<Executor> executor_;
  MeshTable meshes_;
  std::unique_ptr<ModelAppraiser> appraiser_;
};

}  // namespace espalier::test
