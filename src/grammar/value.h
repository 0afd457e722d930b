#pragma once
// Value: what an expression of a program stands for while it is compiled: a kind and one operand per float. Values that
// fold to constants stay constants, so loops unroll and conditions decide at compile time.

#include <array>
#include <map>
#include <optional>
#include <string>

#include "grammar/checked.h"
#include "grammar/program.h"

namespace espalier {

struct Value {
  Kind kind = Kind::number;
  /// vector: x, y, z. mesh: index into GeneratorGraph::meshes, and the shape number `top`. texture: index into
  /// GraphTables::textures. Otherwise parts[0].
  std::array<Operand, 3> parts{};
  std::string text;  // Kind::text

  bool constant() const {
    for (int i = 0; i < width(); ++i)
      if (parts[i].coefficient != 0) return false;
    return true;
  }
  int width() const { return kind == Kind::vector ? 3 : kind == Kind::mesh ? 2 : 1; }
  float number() const { return parts[0].bias; }
};

inline Operand constant_operand(float value) { return {0, value, kZeroRegister}; }
inline Operand register_operand(Register reg) { return {1, 0, reg}; }

inline Value number_value(float value, Kind kind = Kind::number) { return {kind, {constant_operand(value)}, {}}; }

/// Names in sight, innermost first.
class NameScope {
 public:
  explicit NameScope(const NameScope* outer = nullptr) : outer_(outer) {}
  void bind(const std::string& name, const Value& value) { names_[name] = value; }
  const Value* find(const std::string& name) const {
    for (const NameScope* scope = this; scope; scope = scope->outer_)
      if (const auto it = scope->names_.find(name); it != scope->names_.end()) return &it->second;
    return nullptr;
  }

 private:
  const NameScope* outer_;
  std::map<std::string, Value> names_;
};

}  // namespace espalier
