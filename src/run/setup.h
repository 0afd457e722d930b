#pragma once
// Setup: a scene made ready to run: grammar compiled, meshes loaded and placed, objective built, inputs copied.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/input_files.h"
#include "run/probes.h"
#include "run/scene.h"
#include "score/combined_objective.h"
#include "score/curve_target.h"
#include "score/silhouette_target.h"
#include "search/engine.h"

namespace espalier {

struct Setup {
  Scene scene;  // as it lies in the run folder: its paths name the copies
  LoadedGrammar grammar;
  MeshTable meshes;
  TextureTable textures;
  std::vector<Mesh> targets;  // in model space, order of scene.volume.meshes
  Objective objective;
  const VolumeTarget* volume = nullptr;  // in the objective, if the scene has one
  std::vector<const SilhouetteTarget*> silhouettes;  // in the objective, order of scene.silhouettes
  const CurveTarget* curves = nullptr;  // in the objective, if the scene has some
  std::vector<Individual> founders;  // best first; what the search starts from beside what grows at random
  Locks locks;                       // hold for all founders
  Bounds stage;  // where models are expected: the grid's box, around the curves, or where probes were
  std::optional<Probes> probes;  // where setting up had to grow them, until find_reach uses them up
  InputFiles inputs;
  std::vector<std::string> warnings;

  const GeneratorGraph& graph() const { return *grammar.graph; }
  /// Whether models are shown, counted and exported with their details.
  bool full() const;
};

/// Throws Error. `source` reads the mesh files.
std::unique_ptr<Setup> set_up(const Scene& scene, MeshSource& source);
/// The same where the scene's grammar, with its attributes set, has been loaded already. `like`: an earlier setup whose
/// stage came from probes; they are not grown again where they would be the same.
std::unique_ptr<Setup> set_up(const Scene& scene, LoadedGrammar grammar, MeshSource& source,
                              const Setup* like = nullptr);

/// The mesh in model space: translate * rotate z * rotate y * rotate x * scale; same bits on every machine.
Mesh place_mesh(Mesh mesh, const SceneMesh& placing);

}  // namespace espalier
