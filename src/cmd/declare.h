#pragma once
// Options that several verbs have, and the verbs that compare, declared for the parser.

#include <functional>
#include <string>
#include <vector>

#include "cmd/options.h"

namespace CLI {
class App;
}

namespace espalier {

void declare_attributes(CLI::App* verb, std::vector<std::string>& attributes);
void declare_grammar(CLI::App* verb, std::string& grammar);
/// --joints and --lod.
void declare_detail(CLI::App* verb, DetailOptions& detail);
void declare_settings(CLI::App* verb, std::vector<std::string>& settings);
void declare_threads(CLI::App* verb, int& threads);

/// For `verb`'s callback. Throws CLI::ValidationError for an option whose value is empty: most likely a variable of a
/// script that was not set, and not the same as an option that was not given.
void refuse_empty_values(const CLI::App* verb);

/// `chosen` becomes the call of the verb when it is asked for. All must outlive the parsing.
void declare_compare(CLI::App& app, CompareOptions& options, std::function<int()>& chosen);
void declare_sweep(CLI::App& app, SweepOptions& options, std::function<int()>& chosen);
void declare_similarity(CLI::App& app, SimilarityOptions& options, std::function<int()>& chosen);

}  // namespace espalier
