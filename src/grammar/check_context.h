#pragma once
// What the passes of the checker share, and the passes in their order. Private to the checker.

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "grammar/checked.h"

namespace espalier {

/// One alternative of a `choose` in a rule whose loops are unrolled, inside another one or none.
struct ChosenCase {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t outer = kNone;  // index into CheckContext::chosen
  const ast::Stmt* choose = nullptr;
  std::size_t alternative = 0;
  std::map<std::string, StaticValue, std::less<>> loops{};  // variables of the loops around it
};

/// A `spawn` of the text, with how often it stands in one alternative of its rule.
struct SpawnTerm {
  const ast::Stmt* spawn = nullptr;
  std::size_t child = 0;  // declaration
  std::size_t chosen = ChosenCase::kNone;
  double copies = 0;
};

struct CheckContext {
  CheckedGrammar& checked;
  Diagnostics& diagnostics;
  const std::map<std::string, std::string>& attribute_overrides;

  // All indexed like checked.ast.decls.
  /// Consts, attrs and functions that a value declaration reads.
  std::vector<std::vector<std::size_t>> reads{};
  /// Rules and details that a body refers to.
  std::vector<std::vector<std::size_t>> targets{};
  std::vector<char> used{};
  /// Functions and materials: one more than the place, among the start rule's draws and lets, of the last one that it
  /// reads; 0: none.
  std::vector<std::size_t> globals_read{};
  /// Functions and consts: whether an attr has a say in the value.
  std::vector<char> reads_attributes{};

  /// Consts, attrs and functions, each after what it reads.
  std::vector<std::size_t> value_order{};
  /// A draw or let at the top level of the start rule.
  struct Global {
    std::size_t place;  // in text order
    bool used = false;
    bool used_outside = false;  // by others than the start rule
  };
  std::map<std::string_view, Global> globals{};
  /// Locals and parameters named like one of those.
  struct Hiding {
    std::string_view name;
    SourceSpan span;
  };
  std::vector<Hiding> hidings{};

  /// Rules, like checked.ast.decls: what they spawn.
  std::vector<std::vector<SpawnTerm>> spawns{};
  std::vector<ChosenCase> chosen{};
  /// Conditions of `if`, once loops are unrolled: whether they ever held, failed, or were not known.
  struct Branches {
    bool first = false, second = false, open = false;
  };
  struct TextOrder {
    bool operator()(const ast::Stmt* a, const ast::Stmt* b) const {
      return std::pair(a->span.file, a->span.offset) < std::pair(b->span.file, b->span.offset);
    }
  };
  std::map<const ast::Stmt*, Branches, TextOrder> branches{};

  const std::vector<ast::Decl>& decls() const { return checked.ast.decls; }
  const ast::Decl* start() const { return checked.find(checked.start, ast::DeclKind::rule); }
  /// Index of a declaration of this tree.
  std::size_t index_of(const ast::Decl& decl) const { return static_cast<std::size_t>(&decl - decls().data()); }
};

/// "rule", "const", ...
std::string_view word_of(ast::DeclKind kind);

/// Fills declarations, start and globals; duplicates, missing start, import.
void collect_declarations(CheckContext& context);
/// Resolves the names in consts, attrs, functions, meshes and materials.
void check_value_names(CheckContext& context);
/// Puts value declarations in order. False where they read themselves or functions grow too large: then nothing may be
/// evaluated.
bool order_values(CheckContext& context);
/// Resolves the names in rules and details; unused and unreachable things.
void check_body_names(CheckContext& context);
/// Infers the kind of every expression and parameter.
void check_kinds(CheckContext& context);
/// Evaluates consts, attrs and overrides; looks at meshes and materials.
void evaluate_values(CheckContext& context);
/// What may stand where: rules, details, conditions, lists.
void check_structure(CheckContext& context);
/// Details that call themselves without end.
void check_detail_recursion(CheckContext& context);
/// Values of static expressions, and how large rules become once their loops are unrolled. Fills spawns, chosen,
/// branches.
void check_unrolled(CheckContext& context);
/// What can never come to pass: warnings.
void check_unreachable(CheckContext& context);
/// Whether derivations end, and how large they are expected to be.
void check_growth(CheckContext& context);

}  // namespace espalier
