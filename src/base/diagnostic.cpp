#include "base/diagnostic.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "base/check.h"

namespace espalier {
namespace {

constexpr std::size_t kWidestLine = 160;  // bytes of a source line shown around the caret

std::string_view line_at(std::string_view source, std::size_t offset) {
  offset = std::min(offset, source.size());
  const std::size_t before = offset == 0 ? std::string_view::npos : source.rfind('\n', offset - 1);
  const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
  const std::size_t end = std::min(source.find('\n', offset), source.size());
  return source.substr(begin, end - begin);
}

}  // namespace

void Diagnostics::error(std::string code, const SourceSpan& span, std::string message, std::string help) {
  if (++errors_ <= kMostErrors)
    items_.push_back({Severity::error, std::move(code), std::move(message), span, std::move(help)});
}

void Diagnostics::warning(std::string code, const SourceSpan& span, std::string message, std::string help) {
  if (items_.size() < 2 * kMostErrors)
    items_.push_back({Severity::warning, std::move(code), std::move(message), span, std::move(help)});
}

std::string render(const Diagnostic& d, std::string_view file_name, std::string_view source) {
  const char* severity = d.severity == Severity::error ? "error" : "warning";
  if (d.span.line == 0) return fmt::format("{}: {}[{}]: {}\n", file_name, severity, d.code, d.message);
  std::string text =
      fmt::format("{}:{}:{}: {}[{}]: {}\n", file_name, d.span.line, d.span.column, severity, d.code, d.message);

  std::string_view line = line_at(source, d.span.offset);
  std::size_t column = d.span.column - 1;
  if (line.size() > kWidestLine) {
    const std::size_t cut = column > kWidestLine / 2 ? column - kWidestLine / 2 : 0;
    line = line.substr(std::min(cut, line.size()), kWidestLine);
    column -= cut;
  }
  column = std::min(column, line.size());
  std::string shown(line), pad;
  for (char& c : shown)
    if (c != '\t' && static_cast<unsigned char>(c) < ' ') c = '?';
  for (std::size_t i = 0; i < column; ++i) pad += line[i] == '\t' ? '\t' : ' ';
  const std::size_t room = line.size() > column ? line.size() - column : 1;
  const std::size_t carets = std::clamp<std::size_t>(d.span.length, 1, std::max<std::size_t>(room, 1));
  text += fmt::format("{:5} | {}\n      | {}{}\n", d.span.line, shown, pad, std::string(carets, '^'));
  if (!d.help.empty()) text += fmt::format("      = help: {}\n", d.help);
  return text;
}

std::string line_of(const SourceSpan& place, const SourceSpan& from, std::span<const std::string> files) {
  if (place.file == from.file || place.file >= files.size()) return fmt::format("line {}", place.line);
  return fmt::format("line {} of {}", place.line, files[place.file]);
}

std::string render(const Diagnostics& diagnostics, std::string_view file_name, std::string_view source) {
  const SourceText only{std::string(file_name), std::string(source)};
  return render(diagnostics, std::span(&only, 1));
}

std::string render(const Diagnostics& diagnostics, std::span<const SourceText> sources) {
  CHECK(!sources.empty());
  std::vector<Diagnostic> sorted = diagnostics.items();
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { 
                     return std::pair(a.span.file, a.span.offset) < std::pair(b.span.file, b.span.offset);
                    });
  std::string text;
  std::size_t warnings = 0;
  for (const Diagnostic& d : sorted) {
    const SourceText& source = sources[std::min<std::size_t>(d.span.file, sources.size() - 1)];
    text += render(d, source.name, source.text);
    warnings += d.severity == Severity::warning;
  }
  const std::size_t errors = diagnostics.error_count();
  if (errors > Diagnostics::kMostErrors)
    text += fmt::format("({} further errors not shown)\n", errors - Diagnostics::kMostErrors);
  if (errors + warnings > 0)
    text += fmt::format("{}: {} error{}, {} warning{}\n", sources[0].name, errors, errors == 1 ? "" : "s", warnings,
                        warnings == 1 ? "" : "s");
  return text;
}

}  // namespace espalier
