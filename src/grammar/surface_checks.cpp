// Arguments of surfaces and textures, where they are constant.

#include <cmath>

#include <fmt/core.h>

#include "grammar/static_checks.h"
#include "grammar/surface_arguments.h"

namespace espalier {
namespace {

std::string range_of(const SurfaceArgument& argument) {
  if (argument.unbounded) return fmt::format(">= {:g}", argument.low);
  return fmt::format("{}in {:g}..{:g}", argument.whole ? "a whole number " : "", argument.low, argument.high);
}

}  // namespace

void StaticChecks::surface(const ast::Expr& expr, const StaticScope& scope) {
  const bool is_surface = expr.name == "surface";
  const std::string code = is_surface ? "E0515" : "E0519";
  const std::string of = is_surface ? "a surface" : fmt::format("`{}`", expr.name);
  for (std::size_t i = 0; i < expr.args.size(); ++i) {
    const SurfaceArgument* argument = surface_argument(expr, i);
    const ast::Expr& place = *expr.args[i].value;
    if (!argument || argument->sort == SurfaceArgument::Sort::texture) continue;
    const Value given = value(place, scope);
    const bool number = argument->sort == SurfaceArgument::Sort::number;
    if (!given && !number) {
      error(code, place, fmt::format("the {} of {} must be constant", argument->name, of),
            argument->sort == SurfaceArgument::Sort::color
                ? "choose among materials with `pick`, or blend two with `mix`" : "");
    } else if (!given || given->kind != kind_of(argument->sort)) {
      continue;  // varies, or has been refused for its kind
    } else if (argument->sort == SurfaceArgument::Sort::color && !parse_color(given->text)) {
      error(code, place, fmt::format("a colour is written \"#rrggbb\", got {}", describe(*given)));
    } else if (argument->sort == SurfaceArgument::Sort::file && given->text.empty()) {
      error(code, place, "an image needs a file name, such as \"bricks.png\"");
    } else if (number) {
      const double x = given->scalar();
      const bool whole = !argument->whole || x == std::floor(x);
      if (!(x >= argument->low && (argument->unbounded || x <= argument->high) && whole))
        error(code, place, fmt::format("the {} of {} must be {}, got {}", argument->name, of, range_of(*argument),
                                       describe(*given)));
    }
  }
}

}  // namespace espalier
