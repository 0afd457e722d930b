#include "run/contest_files.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "io/image.h"
#include "run/output_look.h"
#include "run/results.h"

namespace espalier {

namespace fs = std::filesystem;

void keep_best(std::optional<ContestBest>& best, const ContestOutcome& outcome) {
  if (!outcome.problem.empty() || (best && best->individual.score >= outcome.best.score)) return;
  best = {outcome.seed, outcome.step_count, outcome.best};
}

BestFiles::BestFiles(Setup& setup, const ContestVariant& variant, const ContestBest& best, Executor& executor)
    : setup_(setup), executor_(executor) {
  setup_.scene.seed = best.seed;
  setup_.scene.output.keep = variant.scene.output.keep;
  result_.best = best.individual;
  result_.steps = best.steps;
}

std::string BestFiles::settings() const { return settings_text(setup_); }

void BestFiles::write(const std::string& path) const {
  ResultWriter writer(setup_, result_, executor_);
  writer.write_individual(0, path, writer.provenance(0, "."));
}

const Picture& BestFiles::picture() {
  if (!picture_.rgb.empty()) return picture_;
  ModelFiles files(setup_.graph(), setup_.meshes, setup_.textures, setup_.targets,
                   look_of(setup_.scene.output), executor_);
  return picture_ = files.picture(result_.best.derivation);
}

void BestFiles::write_picture(const std::string& path) {
  const ResultWriter writer(setup_, result_, executor_);
  write_png(path, picture().width, picture().height, picture().rgb, writer.provenance(0, "."));
}

void write_folder(RunFolder& folder, const std::vector<FolderFile>& files) {
  std::string problem;
  bool any = false;
  for (const auto& [name, write] : files) {
    try {
      write((fs::path(folder.staging()) / name).string());
      any = true;
    } catch (const Error& error) {
      if (problem.empty()) problem = error.what();
    }
  }
  if (problem.empty()) return folder.commit();
  if (!any) throw Error(problem);
  folder.keep();
  throw Error(fmt::format("{}\nThe results are incomplete; what could be written is kept in {}", problem,
                          folder.staging()));
}

}  // namespace espalier
