#pragma once
// The pictures that targets contribute to a report: what was asked for, shown beside what came out.

#include <string>
#include <vector>

#include "base/executor.h"
#include "run/setup.h"

namespace espalier {

/// A PNG with words.
struct ReportPicture {
  std::string title, caption;
  std::string png;
};

/// One picture or more per kind of target, in the order in which they are to be read; each kind adds its own here.
/// `size` is what a picture may have at most: width, height.
std::vector<ReportPicture> target_pictures(const Setup& setup, std::array<std::uint32_t, 2> size, Executor& executor);

}  // namespace espalier
