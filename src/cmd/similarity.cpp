// espalier similarity: how far apart the shapes of models are.
#include <fmt/format.h>

#include "base/error.h"
#include "cmd/attributes.h"
#include "cmd/text_table.h"
#include "cmd/verbs.h"
#include "io/file.h"
#include "io/mesh_import.h"
#include "run/model_files.h"
#include "run/similarity.h"

namespace espalier {
namespace {

constexpr std::size_t kColumns = 12;  // of a matrix side by side

bool read_choice(const char* option, const std::string& text, const char* no, const char* yes) {
  if (text != no && text != yes) throw Error(fmt::format("{} must be {} or {}, got \"{}\"", option, no, yes, text));
  return text == yes;
}

VoxelChoice read_over(const SimilarityOptions& options) {
  return read_choice("--over", options.over, "all", "occupied") ? VoxelChoice::occupied : VoxelChoice::all;
}

SimilarityRequest request_of(const SimilarityOptions& o) {
  SimilarityRequest request;
  request.models = o.models;
  request.grammar = o.grammar, request.attributes = parse_attributes(o.attributes);
  DescriptorSettings& d = request.descriptor;
  d.layers = o.grid, d.pairs = o.pairs, d.bins = o.bins, d.range = o.range, d.seed = o.seed;
  request.shared_box = read_choice("--box", o.box, "own", "shared");
  return request;
}

/// "4 x 4 x 4 voxels of each model's own box, 30 pairs of points in each, 10 bins up to the diagonal, seed 1"
std::string settings_in_words(const SimilarityRequest& request) {
  const DescriptorSettings& d = request.descriptor;
  return fmt::format("{0} x {0} x {0} voxels of {1}, {2} pairs of points in each, {3} bins up to {4}, seed {5}\n",
                     d.layers, request.shared_box ? "one box" : "each model's own box", d.pairs, d.bins,
                     d.range ? fmt::format("{} m", *d.range) : "its diagonal", d.seed);
}

std::string models_table(const SimilarityReport& report) {
  TextTable table({{"model", true}, {"voxels", true}, {"triangles", true}, {"area, m2", true}, {"size, m"}, {"path"}});
  for (std::size_t i = 0; i < report.models.size(); ++i) {
    const ComparedModel& m = report.models[i];
    const Vec3 size = m.box.empty() ? Vec3(0) : m.box.size();
    table.add({fmt::format("{}", i + 1), fmt::format("{}", m.anew.both), fmt::format("{}", m.triangles),
               fmt::format("{:.4g}", m.area), fmt::format("{:.3g} x {:.3g} x {:.3g}", size.x, size.y, size.z), m.path});
  }
  return table.text();
}

void add_row(TextTable& table, const std::string& name, const SampleSummary& s) {
  std::vector<std::string> cells = {name, fmt::format("{}", s.count)};
  for (const double value : {s.median, s.lower, s.upper, s.mean, s.max}) cells.push_back(fmt::format("{:.3f}", value));
  table.add(std::move(cells));
}

void add_rows(TextTable& table, const std::string& name, const ShapeDistance& distance) {
  add_row(table, name + ", all voxels", distance.all);
  if (distance.occupied) add_row(table, name + ", occupied", *distance.occupied);
}

/// Of two models: the set of distances in numbers, beside what chance alone makes.
std::string distance_table(const SimilarityReport& report) {
  const ShapeDistance& d = report.pair(0, 1);
  std::string text = fmt::format("voxels with surface of both {}, only of 1: {}, only of 2: {}, of neither {}\n\n",
                                 d.both, d.only_first, d.only_second, d.neither);
  TextTable table({{"distance"}, {"voxels", true}, {"median", true}, {"lower", true}, {"upper", true}, {"mean", true},
                   {"most", true}});
  add_rows(table, "1 to 2", d);
  add_rows(table, "1 drawn anew", report.models[0].anew);
  add_rows(table, "2 drawn anew", report.models[1].anew);
  return text + table.text();
}

/// Of more than two: medians, as many side by side as lines hold.
std::string matrix_table(const SimilarityReport& report, VoxelChoice choice) {
  const std::size_t n = report.models.size();
  const auto number = [](double value) { return fmt::format("{:.3f}", value); };
  std::string text = fmt::format("medians over {} voxels; anew: a model to itself with other points\n",
                                 choice == VoxelChoice::all ? "all" : "occupied");
  for (std::size_t first = 0; first < n; first += kColumns) {
    const std::size_t last = std::min(first + kColumns, n);
    std::vector<TextColumn> columns = {{"", true}};
    for (std::size_t b = first; b < last; ++b) columns.push_back({fmt::format("{}", b + 1), true});
    if (last == n) columns.push_back({"anew", true});
    TextTable table(std::move(columns));
    for (std::size_t a = 0; a < n; ++a) {
      std::vector<std::string> row = {fmt::format("{}", a + 1)};
      for (std::size_t b = first; b < last; ++b)
        row.push_back(a == b ? "-" : number(median(report.pair(a, b), choice)));
      if (last == n) row.push_back(number(median(report.models[a].anew, choice)));
      table.add(std::move(row));
    }
    text += "\n" + table.text();
  }
  return text;
}

void print_warnings(const SimilarityReport& report) {
  for (const ComparedModel& model : report.models) {
    print_adapted(model.adapted);
    if (model.truncated) fmt::print(stderr, "warning: {}: {}\n", model.path, kTruncated);
    if (model.box.empty()) fmt::print(stderr, "warning: {}: shows nothing; every voxel is empty\n", model.path);
  }
}

}  // namespace

int similarity_verb(const SimilarityOptions& options) {
  const SimilarityRequest request = request_of(options);
  const VoxelChoice choice = read_over(options);
  AssimpMeshSource source;
  const std::unique_ptr<Executor> executor = make_tbb_executor(options.threads);
  const SimilarityReport report = compare_shapes(request, source, *executor);
  print_warnings(report);
  if (!options.csv.empty()) write_file(options.csv, similarity_csv(report, choice));
  if (options.json) {
    fmt::print("{}\n", similarity_json(request, report));
    return kDone;
  }
  fmt::print("{}\n{}\n{}", settings_in_words(request), models_table(report),
             report.models.size() == 2 ? distance_table(report) : matrix_table(report, choice));
  if (!options.csv.empty()) fmt::print("wrote {}\n", options.csv);
  return kDone;
}

}  // namespace espalier
