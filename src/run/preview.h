#pragma once
// Preview: what a scene asks for, as it is understood, and how a few models of its grammar do before any search. For
// finding out that a camera looks away or that a grid is too coarse.

#include <memory>
#include <string>
#include <vector>

#include "base/executor.h"
#include "io/provenance.h"
#include "render/render.h"
#include "run/setup.h"

namespace espalier {

inline constexpr std::uint32_t kPreviewSamples = 4;

struct PreviewSample {
  Derivation derivation;
  Model model;  // with details
  Explanation explanation;
};

struct Preview {
  std::unique_ptr<Setup> setup;
  ProbeReach reach;                         // of all probes
  std::vector<PreviewSample> samples;  // the first probes
  std::vector<std::string> warnings;   // for people, all that a run of the scene would start with, and some more
};

/// Throws Error.
Preview make_preview(const Scene& scene, MeshSource& source);

/// One sheet: a row per target, what is wanted on the left and the samples beside it. The first 12 targets are shown.
Picture preview_picture(const Preview& preview, Executor& executor);
Provenance preview_provenance(const Preview& preview);

/// For a terminal, and as a JSON object without newline; `picture`: path of the sheet.
std::string preview_text(const Preview& preview);
std::string preview_json(const Preview& preview, const std::string& picture);

/// Where a silhouette is seen from: "parallel rays from (0, 3.2, 14) towards (0, 3.2, 0), 9 m from edge to edge".
std::string camera_in_words(const SceneSilhouette& silhouette);
/// "1848.57 (14.3 %)", or why the model is rejected.
std::string score_in_words(const Explanation& explanation);
/// "129 x 120 x 129 cells of 0.0625 x 0.0625 x 0.0625 m".
std::string grid_in_words(const VoxelGrid& grid);

}  // namespace espalier
