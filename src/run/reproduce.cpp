#include "run/reproduce.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/hash.h"
#include "base/version.h"
#include "io/file.h"
#include "io/provenance.h"
#include "run/picture_file.h"
#include "run/results.h"
#include "run/sample.h"
#include "run/scene_toml.h"
#include "run/temporary_folder.h"
#include "run/toml_value.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

struct Job {
  std::string path;    // the file
  std::string folder;  // of the run
  Provenance provenance;
};

void check_inputs(const Job& job, ReproduceReport& report) {
  for (const auto& [name, hash] : job.provenance.inputs) {
    const std::string path = (fs::path(job.folder) / name).string();
    if (!fs::exists(path)) {
      throw Error(fmt::format("{}: its input {} is missing; name the run's folder with --run", job.path, path));
    }
    if (content_hash(read_file(path)) == hash) {
      report.same.push_back(name);
    } else {
      report.differences.push_back(fmt::format("input {} has changed since", path));
    }
  }
}

// result.json without its times and the reason to stop, which a replay cannot share.
std::string without_times(const std::string& text) {
  std::string kept;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.size(), text.find('\n', at) + 1);
    const std::string line = text.substr(at, (end == 0 ? text.size() : end) - at);
    at += line.size();
    const auto members = {" \"wall_seconds\"", " \"evaluations_per_second\"", " \"stopped_by\""};
    const auto begins = [&](const char* member) { return line.starts_with(member); };
    if (std::none_of(members.begin(), members.end(), begins)) kept += line;
  }
  return kept;
}

// The file that is written together with this one: the .obj of an .mtl and of a texture.
std::string written_with(const std::string& filename) {
  const std::size_t texture = filename.rfind("-texture-");
  if (filename.ends_with(".png") && texture != std::string::npos) return filename.substr(0, texture) + ".obj";
  return filename.ends_with(".mtl") ? fs::path(filename).stem().string() + ".obj" : filename;
}

void compare_bytes(const std::string& filename, const std::string& before, const std::string& after,
                   ReproduceReport& report) {
  if (before == after) {
    report.same.push_back(fmt::format("{} bytes of {}", before.size(), filename));
    return;
  }
  const auto [a, b] = std::mismatch(before.begin(), before.end(), after.begin(), after.end());
  report.differences.push_back(fmt::format("{} differs from byte {} on ({} bytes, made anew {})", filename,
                                           a - before.begin(), before.size(), after.size()));
}

// A picture of `espalier render`: drawn again as its own options say.
void compare_picture(const Job& job, const Derivation& derivation, MeshSource& source, Executor& executor,
                     ReproduceReport& report) {
  const PictureRequest request = parse_picture_request(job.provenance.picture, job.path + " (its picture)");
  const std::string after = picture_again(request, derivation, job.provenance, job.folder, source, executor);
  compare_bytes(fs::path(job.path).filename().string(), read_file(job.path), after, report);
}

// Writes the file again with the set's own writer and compares bytes.
template <typename Set>
void compare_file(const Job& job, Set& set, ReproduceReport& report) {
  const Provenance& p = job.provenance;
  const std::string filename = fs::path(job.path).filename().string();
  const TemporaryFolder temporary;
  const std::string name = p.settings_folder == ".." ? "alternatives/" + filename : filename;
  const std::vector<std::string> names = set.names();
  const std::string target = written_with(filename);
  if (p.made_by != "export" && std::find(names.begin(), names.end(), name) != names.end()) {
    set.write(name, temporary.file(target));
  } else {
    set.write_individual(p.index, temporary.file(target), p);
  }
  std::string before = read_file(job.path), after = read_file(temporary.file(filename));
  if (filename == "result.json") before = without_times(before), after = without_times(after);
  compare_bytes(filename, before, after, report);
}

void compare_derivation(const Job& job, const std::string& made, ReproduceReport& report) {
  if (made == job.provenance.derivation) {
    report.same.push_back("derivation " + made);
  } else {
    report.differences.push_back(fmt::format("the derivation is {}, made anew {}", job.provenance.derivation, made));
  }
}

void replay_run(const Job& job, MeshSource& source, Executor& executor, ReproduceReport& report) {
  const Provenance& p = job.provenance;
  const Scene scene = parse_scene(p.settings, job.path + " (its settings)", job.folder);
  const std::unique_ptr<Setup> setup = set_up(scene, source);
  report.what = fmt::format("run of {}, seed {}, {} steps", setup->graph().name, p.seed, p.steps);
  SearchControl control;
  control.exact_steps = p.steps;
  const std::optional<SearchResult> result = run_search(*setup, control, executor);
  ResultWriter writer(*setup, *result, executor);
  if (p.index >= writer.size()) {
    report.differences.push_back(fmt::format("there is no alternative {}, only {}", p.index, writer.size() - 1));
    return;
  }
  const Derivation& derivation = writer.individual(p.index).derivation;
  compare_derivation(job, hash_text(derivation), report);
  if (p.made_by == "render") return compare_picture(job, derivation, source, executor, report);
  compare_file(job, writer, report);
}

void replay_sample(const Job& job, MeshSource& source, Executor& executor, ReproduceReport& report) {
  const Provenance& p = job.provenance;
  SampleSet samples(parse_sample_request(p.settings, job.path + " (its settings)", job.folder), source, executor);
  report.what = fmt::format("sample {} with seed {}", p.index + 1, p.seed);
  if (p.index >= samples.size()) throw Error(fmt::format("{}: its provenance names no sample of its set", job.path));
  compare_derivation(job, hash_text(samples.derivation(p.index)), report);
  if (p.made_by == "render") return compare_picture(job, samples.derivation(p.index), source, executor, report);
  compare_file(job, samples, report);
}

}  // namespace

ReproduceReport reproduce(const std::string& path, const std::string& run_folder, MeshSource& source,
                          Executor& executor) {
  Job job = {path, run_folder, read_provenance(path)};
  const Provenance& p = job.provenance;
  if (p.settings.empty()) {
    throw Error(fmt::format("{}: holds too little provenance to be made again (an STL file has no room for it, a "
                            "derivation from elsewhere has none); try another file of its run", path));
  }
  if (job.folder.empty()) {
    job.folder = (fs::absolute(path).parent_path() / p.settings_folder).lexically_normal().string();
  }
  ReproduceReport report;
  if (p.version != kVersion) {
    report.notes.push_back(fmt::format("made by version {}, this is {}", p.version, kVersion));
  }
  check_inputs(job, report);
  if (!report.identical()) return report;
  const TomlValue settings = parse_toml(p.settings, path + " (its settings)");
  if (settings.find("espalier_breed")) {
    throw Error(fmt::format("{}: was bred with others; species.json beside it has the command that makes all of them "
                            "again (make_again)", path));
  }
  if (settings.find("espalier_sample")) {
    replay_sample(job, source, executor, report);
  } else {
    replay_run(job, source, executor, report);
  }
  return report;
}

}  // namespace espalier
