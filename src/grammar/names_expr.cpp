// Names in expressions: what they stand for, whether the place may read it, and how many arguments calls take.

#include <algorithm>

#include <fmt/format.h>

#include "grammar/names.h"
#include "grammar/spelling.h"

namespace espalier {

using ast::Decl;
using ast::DeclKind;
using ast::Expr;
using ast::ExprKind;

void NameChecker::value_declaration(const Decl& decl) {
  decl_ = &decl;
  globals_defined_ = context_.globals.size();
  const std::string_view only_constants = "it reads only literals and consts, and functions of those";
  const Reader constant{kConstants, decl.kind == DeclKind::constant ? "a const" : "an attr", only_constants};
  switch (decl.kind) {
    case DeclKind::constant:
    case DeclKind::attribute:
      for (const ast::ExprPtr* expr : {&decl.value, &decl.low, &decl.high, &decl.step})
        if (*expr) read(**expr, constant);
      break;
    case DeclKind::function:
      parameters(decl);
      read(*decl.value, {kConstants | kAttributes | kGlobals | kLocals | kMeshes, "a function",
                         "functions read their parameters, consts, attrs and the start rule's draws"});
      for (const ast::Param& param : decl.params) close(param.name);
      break;
    case DeclKind::mesh:
      read(*decl.value, {kConstants | kAttributes | kMeshes, "a mesh", "it reads only consts and attrs"});
      break;
    case DeclKind::material:
      read(*decl.value, {kConstants | kAttributes | kGlobals | kMeshes, "a material",
                         "it reads consts, attrs and the start rule's draws; `paint surface(...)` reads others too"});
      break;
    default: break;
  }
}

void check_value_names(CheckContext& context) {
  NameChecker names(context);
  for (const Decl& decl : context.decls()) names.value_declaration(decl);
}

void NameChecker::read(const Expr& expr, const Reader& reader) {
  if (expr.kind == ExprKind::name) return read_name(expr, reader);
  if (expr.kind == ExprKind::call) return call(expr, reader);
  for (const ast::ExprPtr& child : expr.children) read(*child, reader);
}

void NameChecker::require(const Expr& expr, unsigned sight, const Reader& reader, std::string_view what) {
  if (reader.sees & sight) return;
  context_.diagnostics.error("E0401", expr.span, fmt::format("{} cannot read {} `{}`", reader.who, what, expr.name),
                             std::string(reader.help));
}

void NameChecker::read_name(const Expr& expr, const Reader& reader) {
  if (const auto local = locals_.find(expr.name); local != locals_.end()) {
    local->second.used = true;
    constexpr std::string_view kWords[] = {"the parameter", "the draw", "the let", "the loop variable"};
    const LocalSort sort = local->second.sort;
    const unsigned sight = sort == LocalSort::loop && in_rule() ? kLoops : kLocals;
    return require(expr, sight, reader, kWords[static_cast<int>(sort)]);
  }
  if (const auto global = context_.globals.find(expr.name); global != context_.globals.end())
    return read_global(expr, global->second, reader);
  if (const Decl* decl = context_.checked.find(expr.name)) return read_declared(expr, *decl, reader);
  if (const Builtin* builtin = find_builtin(expr.name)) return read_builtin(expr, *builtin, reader);
  unknown(expr, false);
}

void NameChecker::read_global(const Expr& expr, CheckContext::Global& global, const Reader& reader) {
  global.used = true;
  if (!in_start()) global.used_outside = true;
  const std::size_t place = global.place;
  if (decl_->kind == DeclKind::function || decl_->kind == DeclKind::material) {
    std::size_t& latest = context_.globals_read[context_.index_of(*decl_)];
    latest = std::max(latest, place + 1);
  } else if (place >= globals_defined_) {
    context_.diagnostics.error("E0205", expr.span, fmt::format("`{}` is read before it is made", expr.name),
                               "move its draw or let further up");
    return;
  }
  require(expr, kGlobals, reader, "the draw or let");
}

void NameChecker::read_declared(const Expr& expr, const Decl& decl, const Reader& reader) {
  const std::size_t index = context_.index_of(decl);
  context_.used[index] = true;
  switch (decl.kind) {
    case DeclKind::constant:
    case DeclKind::attribute: {
      const bool attribute = decl.kind == DeclKind::attribute;
      context_.reads[context_.index_of(*decl_)].push_back(index);
      return require(expr, attribute ? kAttributes : kConstants, reader, attribute ? "the attr" : "the const");
    }
    case DeclKind::mesh: return require(expr, kMeshes, reader, "the mesh");
    case DeclKind::material:
      require(expr, kMeshes, reader, "the material");
      return require_made(expr, index);
    case DeclKind::function:
      context_.diagnostics.error("E0206", expr.span, fmt::format("the function `{}` needs its arguments", expr.name),
                                 fmt::format("write `{}(...)`", expr.name));
      return;
    default:
      context_.diagnostics.error("E0206", expr.span,
                                 fmt::format("the {} `{}` is no value", word_of(decl.kind), expr.name));
  }
}

void NameChecker::read_builtin(const Expr& expr, const Builtin& builtin, const Reader& reader) {
  switch (builtin.sort) {
    case BuiltinSort::value:
      if (expr.name == "scope") return require(expr, kScope, reader, "the size");
      if (expr.name == "depth") return require(expr, kDepth, reader, "the value");
      if (!(reader.sees & kChildless))
        context_.diagnostics.error("E0404", expr.span, "only the condition of an `if` in a rule reads `childless`",
                                   "write `if childless { ... }`");
      return;
    case BuiltinSort::primitive: return require(expr, kMeshes, reader, "the primitive");
    case BuiltinSort::distribution:
      context_.diagnostics.error("E0206", expr.span, fmt::format("`{}` is a distribution", expr.name),
                                 fmt::format("draw from it first: `NAME ~ {}(...)`", expr.name));
      return;
    case BuiltinSort::function:
    case BuiltinSort::surface:
    case BuiltinSort::texture:
      context_.diagnostics.error("E0206", expr.span, fmt::format("`{}` needs its arguments", expr.name),
                                 fmt::format("write `{}(...)`", expr.name));
  }
}

void NameChecker::call(const Expr& expr, const Reader& reader) {
  if (expr.name == "depth") return call_depth(expr, reader);
  if (const Decl* decl = context_.checked.find(expr.name); decl && decl->kind == DeclKind::function)
    return call_function(expr, *decl, reader);
  if (const Builtin* builtin = find_builtin(expr.name)) return call_builtin(expr, *builtin, reader);
  unknown(expr, true);
  for (const ast::Arg& arg : expr.args) read(*arg.value, reader);
}

void NameChecker::call_depth(const Expr& expr, const Reader& reader) {
  require(expr, kDepth, reader, "the value");
  if (!count(expr.span, expr.name, expr.args.size(), 1, 1)) return;
  const Expr& rule = *expr.args[0].value;
  if (rule.kind == ExprKind::name && context_.checked.find(rule.name, DeclKind::rule)) return;
  context_.diagnostics.error("E0206", rule.span, "`depth(R)` counts the genes of a rule R",
                             "name a rule, or write `depth` for all genes above");
}

void NameChecker::call_function(const Expr& expr, const Decl& function, const Reader& reader) {
  const std::size_t index = context_.index_of(function);
  context_.used[index] = true;
  context_.reads[context_.index_of(*decl_)].push_back(index);
  const int params = static_cast<int>(function.params.size());
  count(expr.span, expr.name, expr.args.size(), params, params);
  for (const ast::Arg& arg : expr.args) {
    if (arg.label)
      context_.diagnostics.error("E0303", arg.label->span,
                                 fmt::format("the arguments of `{}` carry no names", expr.name));
    read(*arg.value, reader);
  }
  require_made(expr, index);
}

void NameChecker::require_made(const Expr& expr, std::size_t index) {
  if (in_rule() && context_.globals_read[index] > globals_defined_)
    context_.diagnostics.error(
        "E0205", expr.span, fmt::format("`{}` reads a draw or let of the start rule that is not made yet", expr.name),
        "use it further down");
}

void NameChecker::call_builtin(const Expr& expr, const Builtin& builtin, const Reader& reader) {
  if (builtin.sort == BuiltinSort::value) {
    context_.diagnostics.error("E0206", expr.span, fmt::format("`{}` is a value and takes no arguments", expr.name));
    return;
  }
  if (builtin.sort == BuiltinSort::distribution) {
    context_.diagnostics.error("E0206", expr.span, fmt::format("`{}` is a distribution", expr.name),
                               fmt::format("draw from it first: `NAME ~ {}(...)`", expr.name));
    return;
  }
  if (builtin.sort == BuiltinSort::primitive) require(expr, kMeshes, reader, "the primitive");
  count(expr.span, expr.name, expr.args.size(), builtin.fewest, builtin.most);
  labels(expr, builtin);
  for (const ast::Arg& arg : expr.args) read(*arg.value, reader);
}

/// Names of arguments: known, once each, behind those without.
void NameChecker::labels(const Expr& expr, const Builtin& builtin) {
  std::vector<std::string_view> known, taken;
  for (std::size_t begin = 0; begin < builtin.labels.size();) {
    const std::size_t end = std::min(builtin.labels.find(' ', begin), builtin.labels.size());
    known.push_back(builtin.labels.substr(begin, end - begin));
    begin = end + 1;
  }
  const auto among = [](const std::vector<std::string_view>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  bool named = false;
  for (std::size_t i = 0; i < expr.args.size(); ++i) {
    const ast::Arg& arg = expr.args[i];
    const Expr& place = arg.label ? *arg.label : *arg.value;
    const std::string_view label = arg.label ? std::string_view(arg.label->name) : i < known.size() ? known[i] : "";
    const auto refuse = [&](std::string message, std::string help = {}) {
      context_.diagnostics.error("E0303", place.span, std::move(message), std::move(help));
    };
    if (!arg.label && named) refuse("arguments without a name stand before those with one");
    else if (arg.label && known.empty()) refuse(fmt::format("the arguments of `{}` carry no names", expr.name));
    else if (arg.label && (place.kind != ExprKind::name || !among(known, label)))
      refuse(fmt::format("`{}` has no argument of that name; it has {}", expr.name, fmt::join(known, ", ")),
             did_you_mean(label, known));
    else if (!label.empty() && among(taken, label)) refuse(fmt::format("the argument `{}` is given twice", label));
    named = named || arg.label;
    taken.push_back(label);
  }
}

void NameChecker::draw(const Expr& expr, const Reader& reader) {
  const Builtin* builtin = find_builtin(expr.name);
  if (!builtin || builtin->sort != BuiltinSort::distribution) {
    std::vector<std::string_view> names;
    for (const Builtin& b : builtins())
      if (b.sort == BuiltinSort::distribution) names.push_back(b.name);
    std::string help = did_you_mean(expr.name, names);
    if (help.empty()) help = fmt::format("one of {}; a value without chance is a `let`", fmt::join(names, ", "));
    context_.diagnostics.error("E0201", expr.span, fmt::format("there is no distribution `{}`", expr.name), help);
    return;
  }
  count(expr.span, expr.name, expr.args.size(), builtin->fewest, builtin->most);
  const Reader weight{kConstants | kAttributes | kLoops, "a weight of `pick`", "weights of `pick` are constant"};
  for (const ast::Arg& arg : expr.args) {
    if (arg.label && expr.name == "pick") read(*arg.label, weight);
    else if (arg.label)
      context_.diagnostics.error("E0303", arg.label->span,
                                 fmt::format("the arguments of `{}` carry no names", expr.name));
    read(*arg.value, reader);
  }
}

bool NameChecker::count(const SourceSpan& span, std::string_view name, std::size_t given, int fewest, int most) {
  const int n = static_cast<int>(given);
  if (n >= fewest && n <= most) return true;
  const std::string wanted = fewest == most ? fmt::format("{}", fewest) : fmt::format("{} to {}", fewest, most);
  context_.diagnostics.error(
      "E0301", span, fmt::format("`{}` takes {} argument{}, got {}", name, wanted, wanted == "1" ? "" : "s", given));
  return false;
}

void NameChecker::unknown(const Expr& expr, bool called) {
  std::string help;
  if (context_.diagnostics.error_count() < Diagnostics::kMostErrors)
    help = did_you_mean(expr.name, words_in_sight(called));
  if (help.empty() && expr.name == "width") help = "the size of the part is `scope.x`, `scope.y`, `scope.z`";
  if (help.empty() && expr.name == "pi") help = "half a turn is `180deg`";
  context_.diagnostics.error(
      "E0201", expr.span, fmt::format("there is no {} `{}` in sight", called ? "function" : "value", expr.name), help);
}

std::vector<std::string_view> NameChecker::words_in_sight(bool called) const {
  std::vector<std::string_view> words;
  for (const auto& [name, local] : locals_)
    if (!called) words.push_back(name);
  for (const auto& [name, global] : context_.globals)
    if (!called && global.place < globals_defined_) words.push_back(name);
  for (const auto& [name, index] : context_.checked.declarations) {
    const DeclKind kind = context_.decls()[index].kind;
    const bool value = kind == DeclKind::constant || kind == DeclKind::attribute || kind == DeclKind::mesh ||
                       kind == DeclKind::material;
    if (called ? kind == DeclKind::function : value) words.push_back(name);
  }
  for (const Builtin& b : builtins()) {
    const bool function =
        b.sort == BuiltinSort::function || b.sort == BuiltinSort::surface || b.sort == BuiltinSort::texture;
    if (called ? function : b.sort == BuiltinSort::value || b.sort == BuiltinSort::primitive) words.push_back(b.name);
  }
  return words;
}

}  // namespace espalier
