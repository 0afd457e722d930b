// The sheet of a preview.
#include <algorithm>

#include <fmt/format.h>

#include "base/box_corner.h"
#include "base/counted.h"
#include "render/camera.h"
#include "render/font.h"
#include "render/overlay.h"
#include "render/voxel_view.h"
#include "run/curve_view.h"
#include "run/output_look.h"
#include "run/overlays.h"
#include "run/preview.h"
#include "run/silhouette_view.h"

namespace espalier {
namespace {

constexpr std::uint32_t kCell = 400, kGap = 20, kScale = 2, kTitleScale = 3;
constexpr std::uint32_t kLine = (kCellHeight + 2) * kScale;
constexpr std::size_t kLetters = kCell / (kCellWidth * kScale);
constexpr std::size_t kMostRows = 12, kMostWords = 8;  // rows of targets; lines of text below a picture
constexpr Colour kWarn{{176, 48, 10}};

struct Line {
  std::vector<Colour> swatches;
  std::string text;
  Colour ink = kInk;
};

struct Cell {
  Picture picture;  // at most kCell wide
  std::vector<Line> lines;
};

/// Broken between words, but not before "%"; a longer word is cut.
std::vector<std::string> wrapped(const std::string& text, std::size_t letters) {
  std::vector<std::string> lines;
  std::string line;
  for (std::size_t from = 0; from < text.size();) {
    std::size_t to = std::min(text.find_first_of(" \n", from), text.size());
    if (text.compare(to, 2, " %") == 0) to = std::min(text.find_first_of(" \n", to + 1), text.size());
    const std::string word = fit_text(std::string_view(text).substr(from, to - from), letters);
    if (!line.empty() && line.size() + 1 + word.size() > letters) lines.push_back(std::move(line)), line.clear();
    line += (line.empty() ? "" : " ") + word;
    from = to + 1;
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

void add_text(Cell& cell, const std::string& text, const Colour& ink = kInk) {
  for (std::string& line : wrapped(text, kLetters)) {
    if (cell.lines.size() < kMostWords) cell.lines.push_back({{}, std::move(line), ink});
  }
}

void add_legend(Cell& cell, const Colour& colour, std::uint64_t count, const char* what) {
  cell.lines.push_back({{colour}, fmt::format("{} {}", count, what), kInk});
}

Cell drawing_cell(const Preview& preview, std::size_t index) {
  const SilhouetteTarget& target = *preview.setup->silhouettes[index];
  const WeightImage& image = target.settings().image;
  const DrawingCounts counts = count_drawing(image);
  Cell cell{fit_marks(mark_drawing(image), kCell), {}};
  add_text(cell, fmt::format("{}, {} x {}", target.name(), image.width, image.height));
  add_legend(cell, colour_of(Mark::wanted), counts.wanted, "wanted");
  add_legend(cell, colour_of(Mark::to_avoid), counts.to_avoid, "to be left free");
  if (counts.indifferent > 0) add_legend(cell, colour_of(Mark::indifferent), counts.indifferent, "do not matter");
  add_text(cell, camera_in_words(preview.setup->scene.silhouettes[index]), kFaintInk);
  return cell;
}

RenderSettings small_look(const Setup& setup) {
  RenderSettings look = look_of(setup.scene.output);
  look.width = kCell, look.height = kCell * 3 / 4;
  return look;
}

/// The meshes asked for within the box of the grid.
Picture meshes_in_grid(const Setup& setup, Executor& executor) {
  const VoxelGrid& grid = setup.volume->grid();
  RenderSettings look = small_look(setup);
  Bounds all{grid.min, grid.max};
  for (const Mesh& mesh : setup.targets) all.add(bounds(mesh));
  std::vector<Vec3> points;
  for (int k = 0; k < 8; ++k) points.push_back(corner_of(all, k));
  const Camera camera =
      frame_points(points, look.azimuth_deg, look.elevation_deg, look.width, look.height, 0.04f);
  look.place = place_of(camera);
  Picture picture = render(Model(), setup.meshes, setup.graph().materials, setup.targets, look, executor);
  const auto pixel = [&](int k, int axis) {
    const Vec3 p = camera.picture_point(corner_of({grid.min, grid.max}, k));
    return static_cast<std::int64_t>(axis == 0 ? 0.5f * (1 + p.x) * static_cast<float>(look.width)
                                               : 0.5f * (1 - p.y) * static_cast<float>(look.height));
  };
  for (int k = 0; k < 8; ++k) {
    for (int axis = 1; axis < 8; axis *= 2) {
      if (!(k & axis)) draw_line(picture, pixel(k, 0), pixel(k, 1), pixel(k | axis, 0), pixel(k | axis, 1), kInk);
    }
  }
  return picture;
}

Cell volume_cell(const Preview& preview, Executor& executor) {
  const VolumeTarget& target = *preview.setup->volume;
  Cell cell{meshes_in_grid(*preview.setup, executor), {}};
  add_text(cell, grid_in_words(target.grid()));
  for (std::size_t i = 0; i < target.settings().meshes.size(); ++i) {
    const VolumeMesh& mesh = target.settings().meshes[i];
    add_text(cell, fmt::format("{}: {} voxels, fill {:g}", mesh.name, target.target_voxels(i), mesh.fill), kFaintInk);
  }
  return cell;
}

Cell curves_cell(const Preview& preview, Executor& executor) {
  const CurveTarget& target = *preview.setup->curves;
  const std::vector<GuidingCurve>& curves = target.cost().settings().curves;
  Cell cell{curve_view(curve_stage(*preview.setup), small_look(*preview.setup), executor), {}};
  add_text(cell, counted(curves.size(), "curve"));
  for (const std::string& extra : extras_in_words(target.cost().settings())) add_text(cell, extra);
  for (std::uint32_t i = 0; i < curves.size(); ++i) {
    add_text(cell, curve_in_words(target, i));
    const bool last_alike = i + 1 == curves.size() || settings_in_words(curves[i]) != settings_in_words(curves[i + 1]);
    if (last_alike) add_text(cell, settings_in_words(curves[i]), kFaintInk);
  }
  return cell;
}

/// What is wanted of the target at this place in the objective.
Cell wanted_cell(const Preview& preview, std::size_t place, Executor& executor) {
  const Setup& setup = *preview.setup;
  if (setup.volume && place == 0) return volume_cell(preview, executor);
  const std::size_t index = place - (setup.volume ? 1 : 0);
  return index < setup.silhouettes.size() ? drawing_cell(preview, index) : curves_cell(preview, executor);
}

Picture sample_picture(const Setup& setup, std::size_t place, const Model& model, Executor& executor) {
  if (setup.volume && place == 0)
    return voxel_view(mark_voxels(*setup.volume, model.instances), kCell, kCell * 3 / 4, 2, executor);
  const std::size_t index = place - (setup.volume ? 1 : 0);
  if (index < setup.silhouettes.size())
    return fit_marks(mark_silhouette(*setup.silhouettes[index], model.instances), kCell);
  return curve_view(curve_stage(setup), model, setup.graph().materials, small_look(setup), executor);
}

/// One row: what is wanted, then the samples. `place`: of the target in its objective.
std::vector<Cell> row_of(const Preview& preview, std::size_t place, Executor& executor) {
  std::vector<Cell> row = {wanted_cell(preview, place, executor)};
  for (const PreviewSample& sample : preview.samples) {
    Cell cell;
    cell.picture = sample_picture(*preview.setup, place, sample.model, executor);
    const Explanation& told = sample.explanation.targets[place];
    add_text(cell, score_in_words(told));
    add_text(cell, told.words, kFaintInk);
    row.push_back(std::move(cell));
  }
  return row;
}

/// Above the columns: which sample, and its score in all.
std::vector<Cell> heads(const Preview& preview) {
  std::vector<Cell> row(1);
  add_text(row[0], "what is wanted");
  for (std::size_t i = 0; i < preview.samples.size(); ++i) {
    const PreviewSample& sample = preview.samples[i];
    Cell& cell = row.emplace_back();
    add_text(cell, fmt::format("sample {}: {}", i + 1, counted(sample.derivation.size(), "gene")));
    if (sample.explanation.rejected.empty()) add_text(cell, "score " + score_in_words(sample.explanation));
    else add_text(cell, score_in_words(sample.explanation), kWarn);
  }
  return row;
}

std::vector<Line> foot(const Preview& preview, std::size_t rows, std::size_t targets, std::size_t letters) {
  std::vector<Line> lines;
  if (rows < targets) lines.push_back({{}, fmt::format("{} more targets are not shown", targets - rows), kWarn});
  for (const std::string& warning : preview.warnings) {
    for (std::string& line : wrapped("warning: " + warning, letters)) lines.push_back({{}, std::move(line), kWarn});
  }
  return lines;
}

std::uint32_t height_of(const std::vector<Cell>& row) {
  std::uint32_t pictures = 0;
  std::size_t lines = 0;
  for (const Cell& cell : row) {
    pictures = std::max(pictures, cell.picture.height);
    lines = std::max(lines, cell.lines.size());
  }
  return pictures + (pictures > 0 ? kGap / 2 : 0) + static_cast<std::uint32_t>(lines) * kLine;
}

void draw_lines(Picture& sheet, std::uint32_t x, std::uint32_t y, const std::vector<Line>& lines) {
  for (const Line& line : lines) {
    std::uint32_t left = x;
    for (const Colour& colour : line.swatches) {
      fill_box(sheet, left, y, 7 * kScale, 7 * kScale, colour);
      draw_frame(sheet, left, y, 7 * kScale, 7 * kScale, kFaintInk);
      left += 12 * kScale;
    }
    draw_text(sheet, left, y, line.text, kScale, line.ink.rgb);
    y += kLine;
  }
}

/// What the colours of the samples mean: a line for what is covered, one for curves.
using Key = std::vector<std::vector<std::pair<Colour, const char*>>>;
Key key_of(const Setup& setup) {
  Key key;
  if (setup.volume || !setup.silhouettes.empty())
    key.push_back({{colour_of(Mark::hit), "wanted and covered"},
                   {colour_of(Mark::missed), "wanted, not covered"},
                   {colour_of(Mark::spilled), "covered, to be left free"},
                   {colour_of(Mark::covered), "covered, does not matter"}});
  for (const SceneMesh& mesh : setup.scene.volume.meshes) {
    if (key[0].size() == 4 && mesh.fill < 0) key[0].emplace_back(colour_of(VoxelMark::struck), "covered, to be avoided");
  }
  if (setup.curves)
    key.push_back({{colour_of(CurveMark::used), "curve that bones use"},
                   {colour_of(CurveMark::unused), "curve that none uses"},
                   {colour_of(CurveMark::follows), "bone that follows a curve"},
                   {colour_of(CurveMark::strays), "bone that strays"}});
  return key;
}

void draw_key(Picture& sheet, std::uint32_t y, const Key& key) {
  for (const auto& line : key) {
    std::uint32_t x = kGap;
    for (const auto& [colour, what] : line) {
      draw_lines(sheet, x, y, {{{colour}, what, kInk}});
      x += kCell + kGap;
    }
    y += kLine;
  }
}

void draw_row(Picture& sheet, std::uint32_t top, const std::vector<Cell>& row) {
  std::uint32_t pictures = 0, x = kGap;
  for (const Cell& cell : row) pictures = std::max(pictures, cell.picture.height);
  for (const Cell& cell : row) {
    const Picture& picture = cell.picture;
    if (!picture.rgb.empty()) {
      const std::uint32_t left = x + (kCell - picture.width) / 2, above = top + (pictures - picture.height) / 2;
      paste(sheet, picture, left, above);
      draw_frame(sheet, left, above, picture.width, picture.height, kFrame);
    }
    draw_lines(sheet, x, top + pictures + (pictures > 0 ? kGap / 2 : 0), cell.lines);
    x += kCell + kGap;
  }
}

}  // namespace

Picture preview_picture(const Preview& preview, Executor& executor) {
  const Setup& setup = *preview.setup;
  const std::size_t targets = setup.silhouettes.size() + (setup.volume ? 1 : 0) + (setup.curves ? 1 : 0);
  std::vector<std::vector<Cell>> rows = {heads(preview)};
  for (std::size_t i = 0; i < std::min(targets, kMostRows); ++i) rows.push_back(row_of(preview, i, executor));
  const std::uint32_t width = kGap + static_cast<std::uint32_t>(rows[0].size()) * (kCell + kGap);
  const std::vector<Line> last =
      foot(preview, rows.size() - 1, targets, (width - 2 * kGap) / (kCellWidth * kScale));
  const std::uint32_t title = kGap + kCellHeight * kTitleScale + kGap / 2;
  const Key key = key_of(setup);
  std::uint32_t height = title + static_cast<std::uint32_t>(key.size() + last.size()) * kLine + kGap;
  for (const auto& row : rows) height += height_of(row) + kGap;

  Picture sheet = blank(width, height, kPaper);
  std::string words = fmt::format("{}, seed {}: before any search", setup.graph().name, setup.scene.seed);
  if (setup.objective.optimum() > 0) words += fmt::format(". At best {:.6g}", setup.objective.optimum());
  draw_text(sheet, kGap, kGap, fit_text(words, (width - 2 * kGap) / (kCellWidth * kTitleScale)), kTitleScale,
            kInk.rgb);
  std::uint32_t y = title;
  for (const auto& row : rows) draw_row(sheet, y, row), y += height_of(row) + kGap;
  draw_key(sheet, y, key);
  draw_lines(sheet, kGap, y + static_cast<std::uint32_t>(key.size()) * kLine, last);
  return sheet;
}

}  // namespace espalier
