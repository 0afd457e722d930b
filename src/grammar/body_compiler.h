#pragma once
// BodyCompiler: the statements of a rule (one variant at a time) or of a detail -> program.

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "grammar/expr_compiler.h"

namespace espalier {

/// A statement in one turn of the static loops around it: what has draws, choices and slots of its own.
struct Site {
  const ast::Stmt* statement = nullptr;
  std::vector<int> turns;

  auto operator<=>(const Site&) const = default;
};

/// What the variants of one rule share: its draws, slots and edges in text order, by site.
struct RuleShape {
  RuleId id = 0;
  std::map<Site, std::uint16_t> draws;  // first component
  std::map<Site, std::uint16_t> slots;
  std::map<const ast::Stmt*, EdgeId> edges;
};

/// The choices of one variant, in the order in which they are met.
struct Choices {
  std::vector<std::size_t> taken;
  std::vector<std::size_t> offered;  // filled while compiling
};

class BodyCompiler {
 public:
  /// A rule; `choices` null: every alternative of every `choose` is walked, to find the shape.
  BodyCompiler(GraphTables& tables, const ast::Decl& decl, RuleShape& shape, Choices* choices);
  /// A detail.
  BodyCompiler(GraphTables& tables, const ast::Decl& decl);

  /// The program; `variant` gets its draws, slots and probability (rules).
  Program compile(Variant* variant);

  std::uint32_t locals() const { return builder_.locals(); }
  std::uint32_t saves() const { return builder_.most_saves(); }

 private:
  bool is_rule() const { return shape_ != nullptr; }
  bool finding_shape() const { return is_rule() && !choices_; }

  void bind_parameters(NameScope& scope);
  void block(const ast::Block& block, const NameScope& outer, bool tail);
  void statements(const ast::Block& block, NameScope& scope, bool tail);
  void statement(const ast::Stmt& stmt, NameScope& scope, bool tail);
  void space(const ast::Stmt& stmt, const NameScope& scope);
  void resize(const ast::Stmt& stmt, const NameScope& scope, OpCode along_axis, OpCode all);
  void move_along(int axis, const Operand& distance);
  void turn_about(int axis, const Operand& angle);
  void aim(const ast::Stmt& stmt, const NameScope& scope);
  void extrude(const Operand& depth);

  void draw(const ast::Stmt& stmt, NameScope& scope);
  Value draw_value(const ast::Stmt& stmt, const NameScope& scope, const std::string& name);
  Operand draw_component(OpCode code, const Operand& x, const Operand& y, const Operand& z, const Operand* high,
                         int component, const std::string& name);
  Value draw_vector(const Value& low, const Value& high, const std::string& name);
  Value pick(const ast::Expr& call, const NameScope& scope, const std::string& name);
  void register_draw(const Site& site, const std::string& name, int components, DrawShape shape, std::uint32_t values);
  void bind(const ast::Stmt& stmt, const Value& value, NameScope& scope);

  void condition(const ast::Stmt& stmt, const NameScope& scope, bool tail);
  void loop(const ast::Stmt& stmt, const NameScope& scope);
  void unrolled(const ast::Stmt& stmt, const std::vector<Value>& values, const NameScope& scope);
  void counted(const Operand& count, const std::function<void(const Operand& counter)>& turn);
  void turning(const ast::Stmt& stmt, const Operand& first, const Operand& count, const NameScope& scope);
  void around(const ast::Stmt& stmt, const NameScope& scope);
  void mirror(const ast::Stmt& stmt, const NameScope& scope, bool tail);
  void choose(const ast::Stmt& stmt, const NameScope& scope, bool tail);
  void choose_at_random(const ast::Stmt& stmt, const NameScope& scope, bool tail);

  struct SplitLengths;
  void split(const ast::Stmt& stmt, const NameScope& scope);
  Operand split_size(const ast::Case& part, const Operand& whole, const NameScope& scope);
  SplitLengths split_lengths(const ast::Stmt& stmt, const Operand& whole, const NameScope& scope);
  void split_part(const ast::Case& part, int axis, const Operand& centre, const Operand& length,
                  const NameScope& scope);
  void comp(const ast::Stmt& stmt, const NameScope& scope);

  void emit(const ast::Stmt& stmt, const NameScope& scope);
  void bone(const ast::Stmt& stmt, const NameScope& scope);
  void spawn(const ast::Stmt& stmt, const NameScope& scope);
  EdgeId edge_of(const ast::Stmt& stmt, const NameScope& scope);
  std::uint16_t slot_of(const ast::Stmt& stmt);
  std::uint16_t call_site(const ast::Ref& ref, const NameScope& scope);
  std::vector<Operand> arguments(const ast::Ref& ref, const NameScope& scope);
  std::uint32_t name_of_site(const std::string& text);

  /// The spawn that a stretch of statements exists for alone: jumped over where its slot is not filled.
  const ast::Stmt* sole_spawn(const ast::Block& block, std::size_t from) const;

  GraphTables& tables_;
  const ast::Decl& decl_;
  RuleShape* shape_ = nullptr;
  Choices* choices_ = nullptr;
  ProgramBuilder builder_;
  ExprCompiler expressions_;
  Variant* variant_ = nullptr;
  std::vector<int> turns_;                       // of the static loops around
  std::map<Site, std::uint16_t> variant_draws_;  // first component, counted in the variant
  std::map<Site, std::uint16_t> variant_slots_;
  std::map<Site, std::size_t> decided_;
  Site draw_site_;
  std::map<std::string, int> site_ordinals_;
  std::map<std::pair<const void*, std::vector<int>>, int> ordinals_;
  int nesting_ = 0;
};

/// A 32-bit name for keys: FNV-1a.
std::uint32_t name_hash(const std::string& text);

}  // namespace espalier
