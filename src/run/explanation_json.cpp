#include "run/explanation_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace espalier {
namespace {

using nlohmann::ordered_json;

ordered_json percent_of(const Explanation& e) { return e.percent ? ordered_json(*e.percent) : ordered_json(); }

// -infinity is no number of JSON; the reason says more.
ordered_json score_of(const Explanation& e) { return e.rejected.empty() ? ordered_json(e.score) : ordered_json(); }

ordered_json rejected_of(const Explanation& e) {
  return e.rejected.empty() ? ordered_json() : ordered_json(e.rejected);
}

ordered_json target_json(const Explanation& target) {
  ordered_json terms = ordered_json::array();
  for (const Term& term : target.terms) {
    terms.push_back({{"name", term.name},
                     {"weight", term.weight},
                     {"count", term.count},
                     {"of", term.of},
                     {"unit", term.unit},
                     {"value", term.value}});
  }
  return {{"name", target.name},       {"weight", target.weight},       {"score", score_of(target)},
          {"optimum", target.optimum}, {"percent", percent_of(target)}, {"rejected", rejected_of(target)},
          {"words", target.words},     {"terms", terms}};
}

}  // namespace

std::string explanation_json(const Explanation& e) {
  ordered_json targets = ordered_json::array();
  for (const Explanation& target : e.targets) targets.push_back(target_json(target));
  const ordered_json document = {{"score", score_of(e)},
                                 {"optimum", e.optimum},
                                 {"percent", percent_of(e)},
                                 {"rejected", rejected_of(e)},
                                 {"words", e.words},
                                 {"targets", targets}};
  return document.dump(1);
}

std::string explanation_text(const Explanation& e) {
  std::string text = "score ";
  text += e.rejected.empty() ? fmt::format("{:.10g}", e.score) : "rejected: " + e.rejected;
  if (e.rejected.empty() && e.optimum > 0) text += fmt::format(" of at most {:.10g}", e.optimum);
  if (e.percent) text += fmt::format(" ({:.1f} %)", *e.percent);
  const char* before_words = e.rejected.empty() ? ": " : "\n";
  text += e.words.empty() ? "\n" : before_words + e.words + "\n";
  for (const Explanation& target : e.targets) {
    const std::string score = target.rejected.empty() ? fmt::format("{:.10g}", target.score + 0.0) : "rejected";
    text += fmt::format("{}: {} x {:g}\n", target.name, score, target.weight);
    for (const Term& term : target.terms) {
      std::string count = fmt::format("{:.10g}", term.count);
      if (term.of > 0) count += fmt::format(" of {:.10g}", term.of);
      text += fmt::format("  {:<28} {:>30} {:<7} weight {:<8g} adds {:.10g}\n", term.name, count, term.unit,
                          term.weight, term.value + 0.0);  // no -0
    }
  }
  return text;
}

}  // namespace espalier
