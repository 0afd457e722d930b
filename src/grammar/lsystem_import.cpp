#include "grammar/lsystem_import.h"

#include "base/check.h"
#include "grammar/formatter.h"
#include "grammar/lsystem.h"
#include "grammar/lsystem_steps.h"
#include "grammar/lsystem_writer.h"

namespace espalier {

std::optional<std::string> import_lsystem(std::string_view source, const LSystemImport& options,
                                          Diagnostics& diagnostics) {
  std::optional<lsystem::System> system = lsystem::parse(source, diagnostics);
  if (!system) return std::nullopt;
  if (options.iterations) system->iterations = *options.iterations;
  const lsystem::Steps steps(*system);
  lsystem::System other = *system;
  other.angle += 7.3;
  const lsystem::Steps other_steps(other);
  const std::string text = lsystem::Writer(*system, steps, other_steps, options, diagnostics).run();
  if (diagnostics.has_errors()) return std::nullopt;
  Diagnostics ours;
  std::optional<std::string> formatted = format_grammar(text, ours);
  CHECK(formatted);
  return formatted;
}

}  // namespace espalier
