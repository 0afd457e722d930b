// Consts, attrs, functions and materials in an order in which each follows what it reads. Cycles are errors, and so are
// functions that would grow too large or too deep once they are written out where they are called.

#include <algorithm>

#include <fmt/core.h>

#include "grammar/check_context.h"

namespace espalier {
namespace {

using ast::Decl;
using ast::DeclKind;

constexpr std::size_t kMostCalls = 10'000;
constexpr std::size_t kDeepestCalls = 64;

bool is_ordered(const Decl& decl) {
  return decl.kind == DeclKind::constant || decl.kind == DeclKind::attribute || decl.kind == DeclKind::function ||
         decl.kind == DeclKind::material;
}

/// Kahn's algorithm, the earliest declaration first among those that are ready. What is left over reads itself.
std::vector<char> sort_values(CheckContext& context) {
  const std::size_t count = context.decls().size();
  std::vector<std::size_t> waits_for(count, 0), ready;
  std::vector<std::vector<std::size_t>> readers(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_ordered(context.decls()[i])) continue;
    for (const std::size_t read : context.reads[i]) readers[read].push_back(i);
    waits_for[i] = context.reads[i].size();
    if (waits_for[i] == 0) ready.push_back(i);
  }
  std::vector<char> done(count, false);
  for (std::size_t next = 0; next < ready.size(); ++next) {
    done[ready[next]] = true;
    for (const std::size_t reader : readers[ready[next]])
      if (--waits_for[reader] == 0) ready.push_back(reader);
  }
  context.value_order = std::move(ready);
  return done;
}

/// Follows what `from` reads among what is left over until a declaration comes up again; marks the way as reported.
void report_cycle(CheckContext& context, std::vector<char>& done, std::size_t from) {
  std::vector<std::size_t> way;
  std::vector<char> on_way(done.size(), false);
  std::size_t at = from;
  while (!on_way[at] && !done[at]) {
    on_way[at] = true;
    way.push_back(at);
    const auto& reads = context.reads[at];
    const auto next = std::find_if(reads.begin(), reads.end(), [&](std::size_t r) { return !done[r]; });
    if (next == reads.end()) break;
    at = *next;
  }
  const bool cycle = on_way[at];
  for (const std::size_t step : way) done[step] = true;
  if (!cycle) return;  // leads into a cycle that has been reported
  std::string names;
  const auto begin = std::find(way.begin(), way.end(), at);
  constexpr std::ptrdiff_t kShown = 8;
  for (auto step = begin; step != way.end(); ++step) {
    if (step - begin == kShown) names += "... -> ";
    if (step - begin < kShown) names += fmt::format("`{}` -> ", context.decls()[*step].name);
  }
  const Decl& decl = context.decls()[at];
  context.diagnostics.error(
      "E0212", decl.name_span,
      fmt::format("the {} `{}` reads itself: {}`{}`", word_of(decl.kind), decl.name, names, decl.name),
      "repetition is a rule or a detail that refers to itself");
}

/// Sizes of what is left once calls are written out, and what functions read through others. False where too large.
bool follow_calls(CheckContext& context) {
  std::vector<std::size_t> size(context.decls().size(), 1), depth(context.decls().size(), 1);
  bool fits = true;
  for (const std::size_t i : context.value_order) {
    const Decl& decl = context.decls()[i];
    if (decl.kind == DeclKind::attribute) context.reads_attributes[i] = true;
    for (const std::size_t read : context.reads[i]) {
      context.globals_read[i] = std::max(context.globals_read[i], context.globals_read[read]);
      context.reads_attributes[i] |= context.reads_attributes[read];
      if (context.decls()[read].kind != DeclKind::function) continue;
      size[i] = std::min(size[i] + size[read], kMostCalls + 1);
      depth[i] = std::max(depth[i], depth[read] + 1);
    }
    if (decl.kind != DeclKind::function || (size[i] <= kMostCalls && depth[i] <= kDeepestCalls)) continue;
    fits = false;
    context.diagnostics.error(
        "E0213", decl.name_span,
        fmt::format("one call of `{}` may lead to at most {} calls, {} deep", decl.name, kMostCalls, kDeepestCalls));
    size[i] = depth[i] = 1;  // one report for the chain
  }
  return fits;
}

}  // namespace

bool order_values(CheckContext& context) {
  std::vector<char> done = sort_values(context);
  bool ordered = true;
  for (std::size_t i = 0; i < done.size(); ++i) {
    if (done[i] || !is_ordered(context.decls()[i])) continue;
    ordered = false;
    report_cycle(context, done, i);
  }
  return follow_calls(context) && ordered;
}

}  // namespace espalier
