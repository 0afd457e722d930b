#include "grammar/compiler.h"

#include <algorithm>

#include <fmt/core.h>

#include "base/hash.h"
#include "grammar/body_compiler.h"
#include "grammar/checker.h"
#include "grammar/depth_compiler.h"

namespace espalier {
namespace {

constexpr std::size_t kMostVariants = 256;

class GraphCompiler {
 public:
  GraphCompiler(const CheckedGrammar& grammar, std::string source_hash, Diagnostics& diagnostics)
      : grammar_(grammar), diagnostics_(diagnostics), tables_(grammar, graph_, diagnostics) {
    graph_.source_hash = std::move(source_hash);
  }

  std::shared_ptr<const GeneratorGraph> compile() {
    graph_.name = grammar_.ast.name;
    number_declarations();
    bind_constants();
    Edge way_in;
    way_in.child = tables_.rule_ids.at(grammar_.start);
    way_in.name = grammar_.start;
    graph_.edges.push_back(way_in);
    // The start rule first: its draws are in sight of all others.
    compile_rule(*grammar_.find(grammar_.start));
    for (const ast::Decl& decl : grammar_.ast.decls) {
      if (!grammar_.reachable.count(decl.name)) continue;
      if (decl.kind == ast::DeclKind::rule && decl.name != grammar_.start) compile_rule(decl);
      if (decl.kind == ast::DeclKind::detail) compile_detail(decl);
    }
    if (diagnostics_.has_errors()) return nullptr;
    lay_out_registers();
    return std::make_shared<const GeneratorGraph>(std::move(graph_));
  }

 private:
  void number_declarations() {
    for (const ast::Decl& decl : grammar_.ast.decls) {
      if (!grammar_.reachable.count(decl.name)) continue;
      if (decl.kind == ast::DeclKind::rule) {
        tables_.rule_ids[decl.name] = static_cast<std::uint16_t>(graph_.rules.size());
        Rule& rule = graph_.rules.emplace_back();
        rule.name = decl.name;
        rule.span = decl.name_span;
        rule.limit = decl.limit;
      } else if (decl.kind == ast::DeclKind::detail) {
        tables_.detail_ids[decl.name] = static_cast<std::uint16_t>(graph_.details.size());
        graph_.details.emplace_back();
        graph_.detail_names.push_back(decl.name);
      }
    }
  }

  void bind_constants() {
    for (const auto& [name, attribute] : grammar_.attributes) {
      const StaticValue& value = attribute.value;
      graph_.attributes.push_back({name, attribute.label, value.scalar(), attribute.low, attribute.high,
                                   attribute.step, attribute.ranged, value.kind == Kind::boolean});
      tables_.globals.bind(name, number_value(static_cast<float>(value.scalar()), value.kind));
    }
    for (const ast::Decl& decl : grammar_.ast.decls) bind_declaration(decl);
  }

  // Declarations may stand in any order, so what one names is bound before it. (The checker refuses circles.)
  void bind_declaration(const ast::Decl& decl) {
    const bool wanted = decl.kind == ast::DeclKind::constant || decl.kind == ast::DeclKind::mesh ||
                        decl.kind == ast::DeclKind::material;
    if (!wanted || tables_.globals.find(decl.name)) return;
    if (decl.kind == ast::DeclKind::material && reads_globals(*decl.value)) return;  // written out where it is used
    bind_names_in(*decl.value);
    ProgramBuilder scratch;
    Value value = ExprCompiler(tables_, scratch).compile(*decl.value, tables_.globals);
    const auto exact = grammar_.constants.find(decl.name);
    if (exact != grammar_.constants.end() && value.kind != Kind::mesh && value.kind != Kind::material)
      for (int i = 0; i < value.width(); ++i)
        value.parts[i] = constant_operand(static_cast<float>(exact->second.numbers[i]));
    if (decl.kind == ast::DeclKind::mesh && value.kind == Kind::text) value = mesh_file(decl, value.text);
    if (decl.kind == ast::DeclKind::material && value.constant())
      graph_.materials[static_cast<std::size_t>(value.number())].name = decl.name;
    tables_.globals.bind(decl.name, value);
  }

  /// Draws and lets of the start rule, through functions too.
  bool reads_globals(const ast::Expr& expr) const {
    if (expr.kind == ast::ExprKind::name && grammar_.global_kinds.contains(expr.name)) return true;
    if (expr.kind == ast::ExprKind::call)
      if (const ast::Decl* function = grammar_.find(expr.name, ast::DeclKind::function))
        if (reads_globals(*function->value)) return true;
    const auto reads = [&](const ast::ExprPtr& part) { return reads_globals(*part); };
    return std::any_of(expr.children.begin(), expr.children.end(), reads) ||
           std::any_of(expr.args.begin(), expr.args.end(), [&](const ast::Arg& arg) { return reads(arg.value); });
  }

  void bind_names_in(const ast::Expr& expr) {
    if (expr.kind == ast::ExprKind::name)
      if (const ast::Decl* decl = grammar_.find(expr.name)) bind_declaration(*decl);
    for (const auto& child : expr.children) bind_names_in(*child);
    for (const ast::Arg& arg : expr.args) bind_names_in(*arg.value);
  }

  Value mesh_file(const ast::Decl& decl, const std::string& path) {
    MeshRef file;
    file.kind = MeshKind::file;
    file.path = tables_.path_from_grammar(path, decl.span);
    file.span = decl.value->span;
    return {Kind::mesh, {constant_operand(tables_.mesh_index(file)), constant_operand(1)}, {}};
  }

  void compile_rule(const ast::Decl& decl) {
    const RuleId id = tables_.rule_ids.at(decl.name);
    if (decl.guard) {
      graph_.rules[id].guard = compile_depth_value(*decl.guard, tables_.globals, tables_);
      graph_.rules[id].guarded = true;
    }
    RuleShape shape;
    shape.id = id;
    BodyCompiler(tables_, decl, shape, nullptr).compile(nullptr);
    name_slots(graph_.rules[id]);
    std::vector<std::size_t> next;
    do {
      Choices choices{next, {}};
      BodyCompiler body(tables_, decl, shape, &choices);
      Variant variant;
      variant.program = body.compile(&variant);
      note_sizes(body, variant.program);
      graph_.rules[id].variants.push_back(std::move(variant));
      next = following(choices);
    } while (!next.empty() && graph_.rules[id].variants.size() < kMostVariants && !diagnostics_.has_errors());
  }

  void compile_detail(const ast::Decl& decl) {
    BodyCompiler body(tables_, decl);
    Program program = body.compile(nullptr);
    note_sizes(body, program);
    graph_.details[tables_.detail_ids.at(decl.name)] = std::move(program);
  }

  // The next combination of choices, as an odometer counts; empty after the last.
  static std::vector<std::size_t> following(const Choices& choices) {
    std::vector<std::size_t> next = choices.taken;
    next.resize(choices.offered.size());
    while (!next.empty()) {
      if (++next.back() < choices.offered[next.size() - 1]) return next;
      next.pop_back();
    }
    return next;
  }

  // "Branch", or "Branch[0]", "Branch[1]" where a rule has several.
  static void name_slots(Rule& rule) {
    std::map<std::string, int> total, seen;
    for (const Slot& slot : rule.slots) ++total[slot.name];
    for (Slot& slot : rule.slots) {
      const std::string child = slot.name;
      if (total[child] > 1) slot.name += fmt::format("[{}]", seen[child]++);
    }
  }

  void note_sizes(const BodyCompiler& body, const Program& program) {
    RegisterLayout& layout = graph_.registers;
    most_locals_ = std::max(most_locals_, body.locals());
    layout.save_depth = std::max(layout.save_depth, body.saves());
    layout.parameters = std::max(layout.parameters, program.parameters);
  }

  void lay_out_registers() {
    RegisterLayout& layout = graph_.registers;
    layout.global_base = static_cast<Register>(kFirstDepthOfRegister + GraphTables::kMostCounted);
    layout.local_base = static_cast<Register>(layout.global_base + tables_.global_count());
    layout.count = layout.local_base + std::max<std::uint32_t>(most_locals_, layout.parameters);
    for (Rule& rule : graph_.rules)
      for (Variant& variant : rule.variants) relocate(variant.program, layout.local_base);
    for (Program& detail : graph_.details) relocate(detail, layout.local_base);
  }

  const CheckedGrammar& grammar_;
  Diagnostics& diagnostics_;
  GeneratorGraph graph_;
  GraphTables tables_;
  std::uint32_t most_locals_ = 0;
};

std::string hash_of(const GrammarSource& source, const std::vector<SourceText>& sources) {
  std::string bytes = source.text;
  for (std::size_t i = 1; i < sources.size(); ++i) bytes += fmt::format("\n# import {}\n{}", i, sources[i].text);
  for (const auto& [name, value] : source.attributes) bytes += fmt::format("\n# {} = {}", name, value);
  return content_hash(bytes);
}

}  // namespace

CompileResult compile_grammar(const GrammarSource& source) {
  CompileResult result;
  result.sources.push_back({source.path, source.text});
  ast::Grammar ast = parse_with_imports(result.sources, source.read_import, result.diagnostics);
  if (result.diagnostics.has_errors()) return result;
  auto checked = check(std::move(ast), source.attributes, result.diagnostics);
  if (!checked || result.diagnostics.has_errors()) return result;
  result.checked = std::make_shared<const CheckedGrammar>(std::move(*checked));
  result.graph = GraphCompiler(*result.checked, hash_of(source, result.sources), result.diagnostics).compile();
  return result;
}

}  // namespace espalier
