#include "run/sample.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/counted.h"
#include "base/error.h"
#include "base/version.h"
#include "derivation/encode.h"
#include "derivation/moves.h"
#include "derivation/sample.h"
#include "io/file.h"
#include "io/image.h"
#include "run/run_folder.h"
#include "run/toml_section.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMostSamples = 1000, kMostColumns = 100;
constexpr const char* kSheet = "samples.png";
// Of the keys of streams: what grows on draws other numbers than what grew its ancestor, also with the same seed.
constexpr std::uint32_t kFromSeedling = 0, kFromAncestor = 1;

}  // namespace

std::string to_toml(const SampleRequest& r) {
  std::string text = fmt::format("espalier_sample = 1\ngrammar = {}\nseed = {}\ncount = {}\n", quote_toml(r.grammar),
                                 r.seed, r.count);
  if (r.grow) text += fmt::format("grow = {}\n", *r.grow);
  if (!r.from.empty()) text += fmt::format("from = {}\n", quote_toml(r.from));
  if (r.genes) text += fmt::format("genes = {}\n", *r.genes);
  text += fmt::format("picture = [{}, {}]\ncell = [{}, {}]\n", r.picture[0], r.picture[1], r.cell[0], r.cell[1]);
  if (r.columns > 0) text += fmt::format("columns = {}\n", r.columns);
  if (!r.attributes.empty()) text += "\n[attributes]\n";
  for (const auto& [name, value] : r.attributes) text += fmt::format("{} = {}\n", quote_toml(name), quote_toml(value));
  return text;
}

SampleRequest parse_sample_request(std::string_view text, const std::string& name, const std::string& folder) {
  const TomlValue root = parse_toml(text, name);
  TomlSection s(root, name, "");
  if (!s.whole("espalier_sample", 1, 1)) s.fail("espalier_sample", "must be 1");
  SampleRequest r;
  r.folder = folder;
  const auto grammar = s.text("grammar");
  if (!grammar) s.fail("grammar", "must be the path of a grammar");
  r.grammar = *grammar;
  r.seed = s.whole("seed", 0, std::uint64_t{1} << 62).value_or(r.seed);
  r.count = static_cast<std::uint32_t>(s.whole("count", 1, kMostSamples).value_or(r.count));
  if (const auto grow = s.whole("grow", 0, 1'000'000)) r.grow = static_cast<std::uint32_t>(*grow);
  if (const auto genes = s.whole("genes", 1, 1'000'000)) r.genes = static_cast<std::uint32_t>(*genes);
  if (r.grow && r.genes) s.fail("genes", "cannot stand beside grow");
  r.from = s.text("from").value_or("");
  if (!r.from.empty() && !r.grow) s.fail("from", "needs grow: how many steps it shall go on growing");
  const auto read_size = [&](const char* key, std::uint64_t most, std::array<std::uint32_t, 2>& size) {
    const auto read = s.wholes(key, 2, 16, most);
    if (read) size = {static_cast<std::uint32_t>((*read)[0]), static_cast<std::uint32_t>((*read)[1])};
  };
  read_size("picture", 8192, r.picture);
  read_size("cell", 1024, r.cell);
  r.columns = static_cast<std::uint32_t>(s.whole("columns", 0, kMostColumns).value_or(0));
  if (const TomlValue* table = s.table("attributes")) {
    TomlSection attributes(*table, name, "attributes");
    for (const auto& [key, value] : table->members) r.attributes[key] = attributes.text(key).value_or("");
  }
  s.finish();
  return r;
}

SampleSet::SampleSet(const SampleRequest& request, MeshSource& source, Executor& executor) : request_(request) {
  grammar_ = load_grammar((fs::path(request.folder) / request.grammar).string(), request.attributes);
  if (!grammar_.warnings.empty()) warnings_.push_back(grammar_.warnings);
  meshes_ = load_meshes(grammar_, source);
  inputs_.add_grammar(grammar_);
  request_.grammar = inputs_.grammar_name();
  if (!request_.from.empty()) read_ancestor();
  settings_ = fmt::format("# Samples drawn by Espalier {}.\n{}", kVersion, to_toml(request_));
  draw();
  RenderSettings look;
  look.width = request_.picture[0], look.height = request_.picture[1];
  files_.emplace(*grammar_.graph, meshes_, load_textures(grammar_), no_ghosts_, look, executor);
}

void SampleSet::read_ancestor() {
  const std::string path = (fs::path(request_.folder) / request_.from).string();
  if (!request_.grow) throw Error(fmt::format("{}: to go on from it, say how many steps it shall grow", path));
  const InputFile& file = inputs_.add_start(path);
  try {
    ancestor_ = decode(*grammar_.graph, file.bytes);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path, error.what()));
  }
  if (is_finished(*ancestor_) && *request_.grow > 0) {
    warnings_.push_back(fmt::format("{} is finished, none of its slots is open: all samples are as it is", path));
  }
  request_.from = file.name;
}

Derivation SampleSet::draw_one(RandomStream& random) {
  const GeneratorGraph& graph = *grammar_.graph;
  if (!request_.grow && !request_.genes) {
    SampleResult result = sample(graph, random);
    truncated_ += result.truncated;
    return std::move(result.derivation);
  }
  Derivation derivation = ancestor_ ? *ancestor_ : seedling(graph, random);
  if (request_.grow) {
    for (std::uint32_t step = 0; step < *request_.grow; ++step) {
      if (grow_open_slot(graph, derivation, random) != GrowthStep::grown) break;
    }
  } else {
    if (!close_open_slots(graph, derivation, random)) throw Error("the start's required slots cannot be grown");
    while (derivation.size() < *request_.genes && espalier::grow(graph, derivation, {}, random)) {}
    short_ += derivation.size() < *request_.genes;
  }
  return derivation;
}

void SampleSet::draw() {
  for (std::uint32_t i = 0; i < request_.count; ++i) {
    RandomStream random({request_.seed, Purpose::sample, 0, i, ancestor_ ? kFromAncestor : kFromSeedling});
    derivations_.push_back(draw_one(random));
  }
  if (truncated_ > 0) {
    warnings_.push_back(fmt::format("{} of {} samples reached the budget of genes; the rest of them stays open",
                                    truncated_, request_.count));
  }
  if (short_ > 0) {
    warnings_.push_back(fmt::format("{} of {} samples could not grow to {} genes", short_, request_.count,
                                    *request_.genes));
  }
}

Provenance SampleSet::provenance(std::size_t index) const {
  return provenance_in_folder("sample", request_.seed, index, inputs_, settings_, derivations_[index]);
}

std::vector<std::string> SampleSet::names(SampleFiles which) const {
  std::vector<std::string> names = {kSampleMarker, "inputs"};
  for (const char* ending : {".derivation.json", ".glb", ".png"}) {
    for (std::size_t i = 0; i < size(); ++i) names.push_back(fmt::format("{:02}{}", i + 1, ending));
    if (which == SampleFiles::genes) return names;
  }
  names.push_back(kSheet);
  return names;
}

void SampleSet::write(const std::string& name, const std::string& path) {
  if (name == kSampleMarker) return write_file(path, settings_);
  if (name == "inputs") return inputs_.write(fs::path(path).parent_path().string());
  if (name == kSheet) return write_sheet(path);
  const std::size_t index = std::stoul(name) - 1;
  write_individual(index, path, provenance(index));
}

void SampleSet::write_individual(std::size_t index, const std::string& path, const Provenance& provenance) {
  files_->write(derivations_[index], path, provenance);
}

void SampleSet::write_sheet(const std::string& path) {
  std::vector<SheetCell> cells;
  for (std::size_t i = 0; i < size(); ++i) {
    cells.push_back({files_->picture(derivations_[i], request_.cell),
                     fmt::format("{}  {}", i + 1, counted(derivations_[i].size(), "gene"))});
    if (files_->model().truncated) warnings_.push_back(fmt::format("sample {} is {}", i + 1, kTruncated));
  }
  const Picture sheet = contact_sheet(cells, fmt::format("{}, seed {}", grammar_.graph->name, request_.seed),
                                      request_.columns);
  write_png(path, sheet.width, sheet.height, sheet.rgb, provenance(0));
}

std::vector<std::string> write_samples(const SampleRequest& request, const std::string& out, MeshSource& source,
                                       Executor& executor, SampleFiles which) {
  SampleSet samples(request, source, executor);
  RunFolder folder(out, kSampleMarker);
  for (const std::string& name : samples.names(which)) samples.write(name, (fs::path(folder.staging()) / name).string());
  folder.commit();
  return samples.warnings();
}

}  // namespace espalier
