#pragma once
// Scene: what a run is asked for: a grammar, targets, a search, a budget and what to keep. Plain data; docs/scenes.md
// is its file format. Every default of the format is a default here.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "run/start_settings.h"
#include "score/guiding_curve.h"
#include "score/limit.h"
#include "score/silhouette_target.h"
#include "score/volume_target.h"
#include "search/genesis_settings.h"
#include "search/guided_settings.h"
#include "search/hybrid_settings.h"

namespace espalier {

/// When a run ends: whichever comes first. At least one must be given.
struct SceneBudget {
  std::optional<double> seconds = {};
  std::optional<std::uint64_t> evaluations = {};
  std::optional<std::uint64_t> generations = {};  // steps of the engine; the initial population is the first

  bool operator==(const SceneBudget&) const = default;
};

enum class EngineKind : std::uint8_t { ga, smc, sosmc, rjmcmc, hybrid, guided, genesis };
inline constexpr std::array<std::string_view, 7> kEngineNames = {"ga",     "smc",    "sosmc",  "rjmcmc",
                                                                  "hybrid", "guided", "genesis"};
inline std::string_view name_of(EngineKind engine) { return kEngineNames[static_cast<std::size_t>(engine)]; }

/// Settings of all engines; `genes` of each comes from the limits, and an `initial_length` that is not given from `ga`.
struct SceneSearch {
  EngineKind engine = EngineKind::ga;
  std::string preset = "ga-2017";
  GaSettings ga;  // the preset with the scene's own values
  SmcSettings smc = {.order = SlotOrder::depth_first};
  SmcSettings sosmc;
  RjmcmcSettings rjmcmc;
  GuidedSettings guided;
  GenesisSettings genesis;
  HybridSettings hybrid;  // but not those of its engines, which are the ones above

  bool operator==(const SceneSearch&) const = default;
};

struct SceneLimits {
  std::string preset;  // of the ramp on genes (length_term in score/limit.h), resolved in `of`; empty: none
  Limits of;           // without the hard ones on genes: those are search.ga.genes

  bool operator==(const SceneLimits&) const = default;
};

/// A mesh to fill or to avoid: model_from_file = translate * rotate z * rotate y * rotate x * scale.
struct SceneMesh {
  std::string file;
  double fill = 1;
  std::optional<double> spill;  // none: -1 (linear) or 1 (the other forms)
  Vec3 position{0};
  Vec3 scale{1};
  Vec3 rotation_deg{0};

  bool operator==(const SceneMesh&) const = default;
};

struct SceneGrid {
  Vec3 min{0}, max{1};
  std::array<std::uint32_t, 3> cells = {1, 1, 1};

  bool operator==(const SceneGrid&) const = default;
};

struct SceneVolume {
  VolumeForm form = VolumeForm::linear;
  VolumeView view = VolumeView::full;
  OverlapCount overlap = OverlapCount::voxels;
  double overlap_weight = 0;
  std::optional<double> outside_weight;  // none: the sum of the spill weights
  std::uint64_t cells = 2'000'000;       // of the grid around the meshes, where `grid` gives none
  std::optional<SceneGrid> grid;
  std::vector<SceneMesh> meshes;

  bool operator==(const SceneVolume&) const = default;
};

/// A pinhole at `eye`; parallel rays where `tall` gives the height of the picture in metres. `fit`: stands where it
/// sees what the grammar makes, from that side; settled before the search.
struct SceneCamera {
  bool fit = true;
  double azimuth_deg = 0, elevation_deg = 0;
  Vec3 eye{0, 0, 10}, at{0}, up{0, 1, 0};
  double fov_deg = 45, near = 0.1;
  std::optional<double> tall;

  bool operator==(const SceneCamera&) const = default;
};

/// A shadow on a plane, cast by a sun (`light` is where its light goes) or a lamp (where it is).
struct SceneShadow {
  bool lamp = false;
  Vec3 light{0, -1, 0};
  Vec3 centre{0}, normal{0, 1, 0}, up{0, 0, -1};
  double tall = 10;

  bool operator==(const SceneShadow&) const = default;
};

struct SceneSilhouette {
  std::string image;                    // of both what is wanted and what is not; or else
  std::string want_image, avoid_image;  // one for each, at least one of them
  std::optional<std::array<std::uint32_t, 2>> size;  // none: the image's own
  SilhouetteForm form = SilhouetteForm::linear;
  VolumeView view = VolumeView::full;
  double want = 1, avoid = 1, weight = 1;
  SceneCamera camera;
  std::optional<SceneShadow> shadow;  // instead of the camera

  bool operator==(const SceneSilhouette&) const = default;
};

struct SceneCurves {
  CurveSettings settings;  // without curves: no target
  double weight = 1;

  bool operator==(const SceneCurves&) const = default;
};

struct SceneOutput {
  std::uint32_t keep = 8;       // alternatives beside the best
  double distance = 0.2;        // least distance of any two kept (run/diversity.h)
  std::array<std::uint32_t, 2> picture = {1200, 900};
  double azimuth_deg = 35, elevation_deg = 22;  // from which side pictures show the model; 0, 0: from +z

  bool operator==(const SceneOutput&) const = default;
};

struct Scene {
  std::string grammar;  // path, relative to `folder`
  std::uint64_t seed = 1;
  std::map<std::string, std::string> attributes;  // values as the language writes them
  SceneBudget budget;
  SceneSearch search;
  SceneLimits limits;
  SceneVolume volume;  // without meshes: no target
  std::vector<SceneSilhouette> silhouettes;
  SceneCurves curves;
  SceneStart start;
  SceneOutput output;

  // Not part of the scene file's meaning, and never written back:
  std::string folder;  // that paths are relative to
  int threads = 0;     // 0 = one per core; results do not depend on it
  double refresh_seconds = 5, checkpoint_seconds = 0;  // between refreshes of the report, and checkpoints; 0 = none

  bool operator==(const Scene&) const = default;
};

}  // namespace espalier
