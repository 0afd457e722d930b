#include "run/preview.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/counted.h"
#include "base/version.h"
#include "model/expand.h"
#include "run/curve_marks.h"
#include "run/explanation_json.h"
#include "run/model_files.h"
#include "run/overlays.h"
#include "run/scene_scorer.h"

namespace espalier {
namespace {

using nlohmann::ordered_json;

std::string at(const Vec3& v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x + 0.0f, v.y + 0.0f, v.z + 0.0f); }

/// Samples that nobody would see anything of.
void warn_of_samples(Preview& preview) {
  const Setup& setup = *preview.setup;
  for (const SilhouetteTarget* target : setup.silhouettes) {
    std::uint32_t unseen = 0;
    const auto scratch = target->make_scratch();
    for (const PreviewSample& sample : preview.samples)
      unseen += target->counts(sample.model.instances, *scratch).covered == 0;
    if (unseen > 0)
      preview.warnings.push_back(fmt::format("{}: {} of {} never reach the frame", target->name(), unseen,
                                             counted(preview.samples.size(), "sample")));
  }
  std::uint32_t truncated = 0;
  for (const PreviewSample& sample : preview.samples) truncated += sample.model.truncated;
  if (truncated > 0) preview.warnings.push_back(fmt::format("{} of the samples are {}", truncated, kTruncated));
}

std::string silhouette_text(const Preview& preview, std::size_t index) {
  const SilhouetteTarget& target = *preview.setup->silhouettes[index];
  const SceneSilhouette& scene = preview.setup->scene.silhouettes[index];
  const DrawingCounts counts = count_drawing(target.settings().image);
  return fmt::format(
      "{}: {} x {} pixels, {} wanted, {} to be left free, {} do not matter\n  {}\n"
      "  at best {:.6g}{}{}\n",
      target.name(), target.settings().image.width, target.settings().image.height, counts.wanted, counts.to_avoid,
      counts.indifferent, camera_in_words(scene), target.optimum(),
      scene.weight == 1 ? "" : fmt::format(", weight {:g}", scene.weight),
      counts.wanted == 0 ? ""
                         : fmt::format("; {} grown for a look cover {:.0f} % of what is wanted",
                                       counted(preview.reach.models, "model"),
                                       100 * preview.reach.silhouettes[index]));
}

std::string volume_text(const Preview& preview) {
  const VolumeTarget& target = *preview.setup->volume;
  std::string text = fmt::format("{}: {}, {:.6g} at best\n", target.name(), grid_in_words(target.grid()),
                                 target.optimum());
  for (std::size_t i = 0; i < target.settings().meshes.size(); ++i) {
    const VolumeMesh& mesh = target.settings().meshes[i];
    text += fmt::format("  {}: {} voxels, fill {:g}, spill {:g}; {} grown for a look cover {:.0f} % of it\n", mesh.name,
                        target.target_voxels(i), mesh.fill, *mesh.spill, counted(preview.reach.models, "model"),
                        100 * preview.reach.meshes[i]);
  }
  return text;
}

std::string curves_text(const CurveTarget& target, double weight) {
  const CurveSettings& settings = target.cost().settings();
  std::string text;
  for (std::uint32_t i = 0; i < settings.curves.size(); ++i)
    text += fmt::format("{}\n  {}\n", curve_in_words(target, i), settings_in_words(settings.curves[i]));
  for (const std::string& extra : extras_in_words(settings)) text += fmt::format("curves: {}\n", extra);
  if (weight != 1) text += fmt::format("curves: weight {:g}\n", weight);
  return text;
}

ordered_json vector_json(const Vec3& v) { return {v.x, v.y, v.z}; }

ordered_json silhouette_json(const Preview& preview, std::size_t index) {
  const SilhouetteTarget& target = *preview.setup->silhouettes[index];
  const DrawingCounts counts = count_drawing(target.settings().image);
  return {{"kind", "silhouette"},
          {"name", target.name()},
          {"size", {target.settings().image.width, target.settings().image.height}},
          {"wanted", counts.wanted},
          {"to_avoid", counts.to_avoid},
          {"indifferent", counts.indifferent},
          {"camera", camera_in_words(preview.setup->scene.silhouettes[index])},
          {"optimum", target.optimum()},
          {"weight", preview.setup->scene.silhouettes[index].weight},
          {"reach", preview.reach.silhouettes[index]}};
}

ordered_json volume_json(const Preview& preview) {
  const VolumeTarget& target = *preview.setup->volume;
  const VoxelGrid& grid = target.grid();
  ordered_json meshes = ordered_json::array();
  for (std::size_t i = 0; i < target.settings().meshes.size(); ++i) {
    const VolumeMesh& mesh = target.settings().meshes[i];
    meshes.push_back({{"name", mesh.name},
                      {"voxels", target.target_voxels(i)},
                      {"fill", mesh.fill},
                      {"spill", *mesh.spill},
                      {"reach", preview.reach.meshes[i]}});
  }
  return {{"kind", "volume"},
          {"name", target.name()},
          {"cells", {grid.cells[0], grid.cells[1], grid.cells[2]}},
          {"min", vector_json(grid.min)},
          {"max", vector_json(grid.max)},
          {"meshes", meshes},
          {"optimum", target.optimum()}};
}

ordered_json curves_json(const CurveTarget& target, double weight) {
  const CurveSettings& settings = target.cost().settings();
  ordered_json curves = ordered_json::array();
  for (std::uint32_t i = 0; i < settings.curves.size(); ++i) {
    const GuidingCurve& guide = settings.curves[i];
    ordered_json points = ordered_json::array();
    for (const Vec3& point : guide.curve.points) points.push_back(vector_json(point));
    curves.push_back({{"points", points},
                      {"length", length_to(guide.curve, 1)},
                      {"segments", target.cost().segments(i)},
                      {"distance", guide.distance},
                      {"alignment", guide.alignment},
                      {"offset", guide.offset},
                      {"utilisation", guide.utilisation},
                      {"thickness", guide.thickness}});
  }
  ordered_json density;
  if (settings.density) {
    const BoneDensity& d = *settings.density;
    density = {{"min", vector_json(d.min)}, {"max", vector_json(d.max)}, {"cell", d.cell},
               {"wanted", d.wanted},        {"cost", d.cost}};
  }
  return {{"kind", "curves"},  {"name", target.name()},   {"curves", curves},
          {"blend", settings.blend}, {"density", density}, {"weight", weight}};
}

}  // namespace

Preview make_preview(const Scene& scene, MeshSource& source) {
  Preview preview;
  preview.setup = set_up(scene, source);
  Setup& setup = *preview.setup;
  preview.reach = find_reach(setup);
  preview.warnings = setup.warnings;
  for (std::string& warning : warn_of_reach(setup, preview.reach)) preview.warnings.push_back(std::move(warning));
  const auto executor = make_serial_executor();
  SceneScorer scorer(setup.graph(), setup.objective, *executor);
  Expander expander(setup.graph(), {.make_materials = false});
  for (std::uint32_t i = 0; i < kPreviewSamples; ++i) {
    PreviewSample& sample = preview.samples.emplace_back();
    sample.derivation = grow_probe(setup.graph(), setup.scene, i);
    expander.expand(sample.derivation, ExpandTo::full, sample.model);
    sample.explanation = scorer.explain(sample.derivation);
  }
  warn_of_samples(preview);
  return preview;
}

Provenance preview_provenance(const Preview& preview) {
  const Setup& setup = *preview.setup;
  Provenance p;
  p.version = kVersion;
  p.made_by = "preview";
  p.seed = setup.scene.seed;
  p.engine = name_of(setup.scene.search.engine);
  p.inputs = setup.inputs.hashes();
  p.optimum = setup.objective.optimum();
  return p;
}

std::string camera_in_words(const SceneSilhouette& silhouette) {
  if (silhouette.shadow) {
    const SceneShadow& s = *silhouette.shadow;
    return fmt::format("shadow of a {} {}, on the plane through {} with normal {}, {:.4g} m from edge to edge",
                       s.lamp ? "lamp at" : "sun along", at(s.light), at(s.centre), at(s.normal), s.tall);
  }
  const SceneCamera& c = silhouette.camera;
  if (c.tall)
    return fmt::format("parallel rays from {} towards {}, {:.4g} m from edge to edge", at(c.eye), at(c.at), *c.tall);
  return fmt::format("pinhole at {} looking at {}, {:.4g} degrees from edge to edge", at(c.eye), at(c.at), c.fov_deg);
}

std::string score_in_words(const Explanation& explanation) {
  if (!explanation.rejected.empty()) return "rejected: " + explanation.rejected;
  std::string text = fmt::format("{:.6g}", explanation.score + 0.0);
  if (explanation.percent) text += fmt::format(" ({:.1f} %)", *explanation.percent + 0.0);
  return text;
}

std::string grid_in_words(const VoxelGrid& grid) {
  const Vec3 cell = grid.cell_size();
  return fmt::format("{} x {} x {} cells of {:.3g} x {:.3g} x {:.3g} m", grid.cells[0], grid.cells[1], grid.cells[2],
                     cell.x, cell.y, cell.z);
}

std::string preview_text(const Preview& preview) {
  const Setup& setup = *preview.setup;
  std::string text = fmt::format("{}, seed {}", setup.graph().name, setup.scene.seed);
  if (setup.objective.optimum() > 0) text += fmt::format(": at best {:.6g}", setup.objective.optimum());
  text += "\n";
  if (setup.volume) text += volume_text(preview);
  for (std::size_t i = 0; i < setup.silhouettes.size(); ++i) text += silhouette_text(preview, i);
  if (setup.curves) text += curves_text(*setup.curves, setup.scene.curves.weight);
  for (std::size_t i = 0; i < preview.samples.size(); ++i) {
    const PreviewSample& sample = preview.samples[i];
    text += fmt::format("sample {}: {}, {}, score {}\n", i + 1, counted(sample.derivation.size(), "gene"),
                        counted(sample.model.instances.size(), "part"), score_in_words(sample.explanation));
    if (!sample.explanation.words.empty()) text += fmt::format("  {}\n", sample.explanation.words);
  }
  return text;
}

std::string preview_json(const Preview& preview, const std::string& picture) {
  const Setup& setup = *preview.setup;
  ordered_json targets = ordered_json::array(), samples = ordered_json::array();
  if (setup.volume) targets.push_back(volume_json(preview));
  for (std::size_t i = 0; i < setup.silhouettes.size(); ++i) targets.push_back(silhouette_json(preview, i));
  if (setup.curves) targets.push_back(curves_json(*setup.curves, setup.scene.curves.weight));
  for (const PreviewSample& sample : preview.samples) {
    samples.push_back({{"genes", sample.derivation.size()},
                       {"parts", sample.model.instances.size()},
                       {"explanation", ordered_json::parse(explanation_json(sample.explanation))}});
  }
  const ordered_json document = {{"grammar", setup.graph().name},
                                 {"seed", setup.scene.seed},
                                 {"optimum", setup.objective.optimum()},
                                 {"probes", preview.reach.models},
                                 {"targets", targets},
                                 {"samples", samples},
                                 {"warnings", preview.warnings},
                                 {"picture", picture}};
  return document.dump(1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace espalier
