// espalier score: a derivation's score in a scene, taken apart.
#include <fmt/format.h>

#include "cmd/attributes.h"
#include "cmd/verbs.h"
#include "io/mesh_import.h"
#include "run/derivation_file.h"
#include "run/explanation_json.h"
#include "run/scene_toml.h"

namespace espalier {

int score_verb(const ScoreOptions& options) {
  const Scene scene = load_scene(options.scene, {options.settings, options.attributes});
  AssimpMeshSource source;
  AdaptedGenes adapted;
  const Explanation explanation =
      score_derivation(scene, options.derivation, source, options.attributes.empty() ? nullptr : &adapted);
  print_adapted(adapted);
  fmt::print("{}", options.json ? explanation_json(explanation) + "\n" : explanation_text(explanation));
  return kDone;
}

}  // namespace espalier
