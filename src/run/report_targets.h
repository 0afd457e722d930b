#pragma once
// The pictures that targets contribute to a report: what was asked for, shown beside what came out, and both in one.

#include <string>
#include <vector>

#include "base/executor.h"
#include "render/overlay.h"
#include "run/outcome_pictures.h"
#include "run/setup.h"

namespace espalier {

/// A PNG with words.
struct ReportPicture {
  std::string title, caption;
  std::string png;
  std::vector<LegendRow> legend = {};
};

/// One picture or more per kind of target, in the order in which they are to be read; each kind adds its own here.
/// `look` says how large a picture may be, and how good.
std::vector<ReportPicture> target_pictures(const Setup& setup, const RenderSettings& look, Executor& executor);

ReportPicture report_picture(const OutcomePicture& drawn);
/// How a model does with its targets; a picture per name of outcome_names().
std::vector<ReportPicture> outcome_pictures(const Outcome& outcome, const OutcomeLook& look, Executor& executor);

}  // namespace espalier
