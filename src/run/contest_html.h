#pragma once
// Pieces of the pages of contests.

#include <string>
#include <vector>

#include "run/compare_summary.h"
#include "run/contest_machine.h"

namespace espalier {

/// "81.2&thinsp;%" of an optimum above 0; else the number; a dash for what is not finite.
std::string score_html(double score, double optimum);
/// "0.008", "< 0.001"; a dash for the best itself.
std::string chance_in_words(double chance);

/// A cell that draws range, quartiles and median within [low, high]. `kind`: class that gives the colour, "s0" to "s7".
std::string spread_cell(const SampleSummary& summary, double low, double high, const std::string& kind);

std::string warning_list(const std::vector<std::string>& warnings);
/// Version, seeds and the hashes of inputs.
std::string contest_provenance(const Contest& contest, const ContestMachine& machine, const InputFiles& inputs);

/// A closed box: what a variant sets, and inside it the settings of its engine, out of a whole settings file.
std::string settings_box(const ContestVariant& variant, const std::string& settings);

/// The class of a variant's colour; eight there are.
std::string kind_of(std::size_t variant);
std::string swatch(std::size_t variant);
/// Buttons that show and hide.
std::string legend(const std::vector<std::string>& names);

/// What chart.js draws: an axis with a curve per variant, and the whole of them, safe inside <script>.
std::string axis_json(const std::string& name, const std::vector<double>& at, const std::vector<CompareCurve>& curves);
/// `labels`: short names, beside the lines.
std::string chart_json(double optimum, const std::vector<std::string>& names, const std::vector<std::string>& labels,
                       const std::vector<std::string>& axes);

/// "ga, smc and rjmcmc".
std::string listed_names(const std::vector<std::string>& names);

}  // namespace espalier
