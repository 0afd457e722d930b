#pragma once
// compare.html: one page that shows a comparison: curves over time and over evaluations, tables, the best of each
// variant side by side, settings, and how to make it again. Self-contained, as report.html is.

#include <string>
#include <vector>

#include "render/render.h"
#include "run/compare.h"

namespace espalier {

struct ComparePageParts {
  std::string command;
  const InputFiles* inputs = nullptr;
  // By variant; empty and null where a variant found nothing.
  std::vector<std::string> settings;
  std::vector<const Picture*> pictures;
};

std::string compare_page(const Contest& contest, const CompareResult& result, const ComparePageParts& parts);

}  // namespace espalier
