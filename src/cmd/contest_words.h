#pragma once
// What compare and sweep share on the command line: what each search may spend, and words of a command given again.

#include <string>

#include "cmd/options.h"
#include "run/contest_plan.h"
#include "run/contest_progress.h"

namespace espalier {

ContestWords contest_words(const ContestOptions& options);
/// The options that are given, each after a blank, as one would type them.
std::string options_again(const ContestOptions& options);
/// A word as a shell takes it.
std::string shell_word(const std::string& word);

/// A line that says how many searches came to nothing: at the end, where it is not missed.
std::string failed_in_words(std::size_t failed);

std::unique_ptr<ContestObserver> make_contest_observer(bool json);
/// out/NAME-WHAT, where nothing else is asked for.
std::string contest_folder(const ContestOptions& options, const char* what);

}  // namespace espalier
