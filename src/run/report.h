#pragma once
// Report: one page that shows a run: pictures, the model to turn, how the score came about and what it is made of, the
// alternatives, the settings, and how to make it all again. Self-contained: it asks no network and no other file.
// The same bytes for the same results, but for the lines with times (kTimesLine, kSpeedClass).

#include <optional>
#include <string>
#include <vector>

#include "io/provenance.h"
#include "run/report_model.h"
#include "run/report_targets.h"
#include "run/search_loop.h"
#include "run/setup.h"

namespace espalier {

/// A page about a run that goes on: it loads itself anew.
struct LiveNote {
  double refresh_seconds = 5;
  std::string final_folder;  // relative URL of the folder that the finished run will have
};

struct ReportInput {
  const Setup& setup;
  const SearchResult& result;
  Provenance provenance;                     // of the best; its `settings` are shown
  ReportPicture best;
  std::vector<ReportPicture> targets;
  std::vector<ReportPicture> outcomes;       // of the best, as outcome_names() has them; may be empty
  std::vector<std::string> alternatives;     // PNGs, in the order of result.alternatives
  ReportModel model;                         // of the best
  std::optional<LiveNote> live;              // none: the run has ended
};

/// The lines of the page that hold times begin with one of these (after white space).
inline constexpr const char* kTimesLine = "\"seconds\":";
inline constexpr const char* kSpeedClass = "<p class=\"speed\">";

std::string report_page(const ReportInput& input);

/// Sections of the page (report_sections.cpp).
std::string pictures_html(const ReportInput& input);
std::string score_html(const Explanation& explanation);
std::string alternatives_html(const ReportInput& input);
std::string provenance_html(const ReportInput& input);

/// "Block x 12, Wing x 4": the rules of a derivation's genes, most frequent first.
std::string genes_in_words(const GeneratorGraph& graph, const Derivation& derivation);

}  // namespace espalier
