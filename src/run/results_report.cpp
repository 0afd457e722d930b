// report.html of a run that has ended.
#include <algorithm>

#include <fmt/format.h>

#include "io/file.h"
#include "io/png.h"
#include "run/output_look.h"
#include "run/report.h"
#include "run/report_text.h"
#include "run/results.h"

namespace espalier {
namespace {

// A page is opened as a whole: pictures larger than a screen shows, or very many, are made smaller.
constexpr std::uint32_t kMostAcross = 1600, kAlternativeAcross = 800, kManyAcross = 400;
constexpr std::size_t kMany = 24;

std::string small_png(const Picture& picture, std::uint32_t most, const char* title) {
  const Picture small = shrunk(picture, most);
  return encode_png(small.width, small.height, small.rgb, "Title", title);
}

/// Of the size of pictures, halved until they are at most kMostAcross across.
RenderSettings page_look(const SceneOutput& output) {
  RenderSettings look = look_of(output);
  while (std::max(look.width, look.height) > kMostAcross)
    look.width = std::max(1u, look.width / 2), look.height = std::max(1u, look.height / 2);
  return look;
}

}  // namespace

void ResultWriter::write_report(const std::string& path) {
  const std::size_t genes = result_.best.derivation.size();
  const std::uint32_t across = size() > kMany ? kManyAcross : kAlternativeAcross;
  ReportInput input{setup_, result_, provenance(0, "."), {}, {}, {}, {}, {}, std::nullopt};
  input.best = {"Best", fmt::format("{} gene{}: {}", genes, genes == 1 ? "" : "s",
                                    genes_in_words(setup_.graph(), result_.best.derivation)),
                small_png(best_picture(), kMostAcross, "espalier: best")};
  input.targets = target_pictures(setup_, page_look(setup_.scene.output), executor_);
  for (const std::string& name : outcome_names(setup_)) {
    OutcomePicture drawn = outcome(name);
    drawn.picture = shrunk(drawn.picture, kMostAcross);
    input.outcomes.push_back(report_picture(drawn));
  }
  for (std::size_t i = 1; i < size(); ++i) {
    input.alternatives.push_back(small_png(small_picture(i), across, "espalier: alternative"));
  }
  input.model = make_report_model(files_.model_of(result_.best.derivation), setup_.meshes, setup_.graph().materials,
                                  setup_.targets);
  write_file(path, report_page(input));
}

}  // namespace espalier
