#pragma once
// A slow, obviously right expansion: walks the syntax tree of a grammar gene by gene, recursively, in double precision.
// Rules only (no details). Knows nothing of programs, registers or operands.

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "derivation/derivation.h"
#include "grammar/checked.h"
#include "grammar/graph_tables.h"

namespace espalier::reference {

using Vec = glm::dvec3;
using Mat = glm::dmat3;

struct Value {
  Vec v{0};
  bool vector = false;
  MeshKind mesh = MeshKind::box;
  double x() const { return v.x; }
};

struct Part {
  Mat basis;
  Vec origin;
  MeshKind mesh;
  double top;
  std::uint32_t gene;
};

struct BoneLine {
  Vec from, to;
  std::uint32_t gene;
};

class Expander {
 public:
  Expander(const CheckedGrammar& grammar, const GeneratorGraph& graph, const Derivation& derivation)
      : grammar_(grammar), graph_(graph), derivation_(derivation) {}

  void run() {
    State state;
    Names names;
    GenePosition root;
    gene(root, state, {}, 0);
  }

  std::vector<Part> parts;
  std::vector<BoneLine> bones;

 private:
  struct State {
    Mat a{1.0};
    Vec t{0}, s{1};
  };
  using Names = std::map<std::string, Value>;
  using Site = std::pair<const ast::Stmt*, std::vector<int>>;
  struct Gene {
    GenePosition at;
    const ast::Decl* decl;
    std::uint32_t depth;
    std::vector<std::size_t> choices;
    std::map<Site, std::size_t> chosen;
    std::map<Site, std::uint32_t> draws, slots;
    std::uint32_t draw_count = 0, slot_count = 0;
    std::vector<GenePosition> children;
    std::vector<int> turns;
    bool childless = true;
    int nesting = 0;
  };

  void gene(GenePosition at, const State& state, const std::vector<Value>& args, std::uint32_t depth) {
    const GeneRecord& record = derivation_.genes[at.gene];
    const Variant& variant = variant_of(graph_, record);
    Gene g;
    g.at = at;
    g.depth = depth;
    g.decl = grammar_.find(rule_of(graph_, record).name);
    std::string number;
    for (const char c : variant.name + ",") {
      if (c != ',') number += c;
      else if (!number.empty()) g.choices.push_back(static_cast<std::size_t>(std::stoi(number)) - 1), number.clear();
    }
    GenePosition next{at.gene + 1, at.slot + std::uint32_t(variant.slots.size()),
                      at.draw + std::uint32_t(variant.draws.size())};
    for (std::size_t i = 0; i < variant.slots.size(); ++i) {
      g.children.push_back(next);
      if (derivation_.slots[at.slot + i] != SlotState::filled) continue;
      g.childless = false;
      const GeneRecord& child = derivation_.genes[next.gene];
      const Variant& cv = variant_of(graph_, child);
      next.gene += 1 + child.genes_below;
      next.slot += std::uint32_t(cv.slots.size()) + child.slots_below;
      next.draw += std::uint32_t(cv.draws.size()) + child.draws_below;
    }
    Names names = globals_;
    for (std::size_t i = 0; i < args.size(); ++i) names[g.decl->params[i].name] = args[i];
    State inner = state;
    statements(g.decl->body, g, inner, names);
  }

  void block(const ast::Block& body, Gene& g, State state, Names names) {
    ++g.nesting;
    statements(body, g, state, names);
    --g.nesting;
  }
  void statements(const ast::Block& body, Gene& g, State& state, Names& names) {
    for (const auto& stmt : body.statements) statement(*stmt, g, state, names);
  }

  void bind(const ast::Stmt& stmt, Gene& g, Names& names, const Value& value) {
    names[stmt.name] = value;
    if (g.decl->name == grammar_.start && g.nesting == 0) globals_[stmt.name] = value;
  }

  void statement(const ast::Stmt& stmt, Gene& g, State& state, Names& names) {
    const auto eval = [&](std::size_t i) { return evaluate(*stmt.exprs[i], g, state, names); };
    const auto wide = [&](std::size_t i) {
      const Value value = eval(i);
      return value.vector ? value.v : Vec(value.v.x);
    };
    const int axis = stmt.axis ? static_cast<int>(*stmt.axis) : -1;
    switch (stmt.kind) {
      case ast::StmtKind::draw: bind(stmt, g, names, draw(stmt, g, state, names)); break;
      case ast::StmtKind::let: bind(stmt, g, names, eval(0)); break;
      case ast::StmtKind::block: block(stmt.blocks[0], g, state, names); break;
      case ast::StmtKind::if_:
        if (eval(0).x() != 0) block(stmt.blocks[0], g, state, names);
        else if (stmt.blocks.size() > 1) block(stmt.blocks[1], g, state, names);
        break;
      case ast::StmtKind::for_: loop(stmt, g, state, names); break;
      case ast::StmtKind::choose: {
        const auto [it, fresh] = g.chosen.try_emplace({&stmt, g.turns}, g.chosen.size());
        block(stmt.cases[g.choices[it->second]].block, g, state, names);
        break;
      }
      case ast::StmtKind::mirror: {
        block(stmt.blocks[0], g, state, names);
        State other = state;
        other.a[axis] = -other.a[axis];
        block(stmt.blocks[0], g, other, names);
        break;
      }
      case ast::StmtKind::around: {
        const int n = std::clamp(int(std::floor(eval(0).x() + 0.5)), 1, 1024);
        for (int i = 0; i < n; ++i) {
          State turned = state;
          turned.a = turned.a * rotation(unit(axis), 2 * M_PI * i / n);
          block(stmt.blocks[0], g, turned, names);
        }
        break;
      }
      case ast::StmtKind::split: split(stmt, g, state, names); break;
      case ast::StmtKind::comp: comp(stmt, g, state, names); break;
      case ast::StmtKind::move:
        state.t += state.a * (axis >= 0 ? eval(0).x() * unit(axis) : wide(0));
        break;
      case ast::StmtKind::scale:
        for (int i = 0; i < 3; ++i)
          if (axis < 0) state.a[i] *= wide(0)[i];
          else if (i == axis) state.a[i] *= eval(0).x();
        break;
      case ast::StmtKind::size:
        if (axis >= 0) state.s[axis] = eval(0).x();
        else state.s = wide(0);
        break;
      case ast::StmtKind::resize:
        if (axis >= 0) state.s[axis] *= eval(0).x();
        else state.s *= wide(0);
        break;
      case ast::StmtKind::turn:
        if (axis >= 0) state.a = state.a * rotation(unit(axis), eval(0).x());
        else if (glm::dot(wide(0), wide(0)) > 0) state.a = state.a * rotation(wide(0), eval(1).x());
        break;
      case ast::StmtKind::reflect: state.a[axis] = -state.a[axis]; break;
      case ast::StmtKind::forward: state.t += state.a[1] * eval(0).x(); break;
      case ast::StmtKind::yaw: state.a = state.a * rotation(unit(2), eval(0).x()); break;
      case ast::StmtKind::pitch: state.a = state.a * rotation(unit(0), eval(0).x()); break;
      case ast::StmtKind::roll: state.a = state.a * rotation(unit(1), eval(0).x()); break;
      case ast::StmtKind::extrude: {
        const double d = eval(0).x();
        state.s.z = std::abs(d);
        state.t += state.a[2] * (d / 2);
        break;
      }
      case ast::StmtKind::aim: aim(stmt, state, wide(0), stmt.exprs.size() > 1 ? eval(1).x() : 1); break;
      case ast::StmtKind::bone:
        if (!sleeping_) bones.push_back({state.a * wide(0) + state.t, state.a * wide(1) + state.t, g.at.gene});
        break;
      case ast::StmtKind::emit: {
        const Value mesh = eval(0);
        Mat m = state.a;
        if (!stmt.as_is) m = Mat(m[0] * state.s.x, m[1] * state.s.y, m[2] * state.s.z);
        if (!sleeping_) parts.push_back({m, state.t, mesh.mesh, mesh.v.y, g.at.gene});
        break;
      }
      case ast::StmtKind::spawn: spawn(stmt, g, state, names); break;
      default: break;  // paint, details: not looked at here
    }
  }

  void split(const ast::Stmt& stmt, Gene& g, const State& state, const Names& names) {
    using Sizing = ast::Case::Sizing;
    const int axis = static_cast<int>(*stmt.axis);
    const double whole = state.s[axis];
    struct Stretch {
      const ast::Case* line;
      double size;
    };
    std::vector<Stretch> tiled;  // every tile one
    double fixed = 0, shares = 0;
    const auto size_of = [&](const ast::Case& line) {
      const bool percent = line.value->kind == ast::ExprKind::number && line.value->unit == ast::Unit::percent;
      return percent ? line.value->value / 100 * whole : std::max(0.0, evaluate(*line.value, g, state, names).x());
    };
    for (const ast::Case& line : stmt.cases) {
      if (line.sizing == Sizing::plain) fixed += size_of(line);
      if (line.sizing == Sizing::floating) shares += size_of(line);
    }
    const double room = std::max(0.0, whole - fixed);
    double rest = room;
    for (const ast::Case& line : stmt.cases) {
      if (line.sizing != Sizing::repeat) continue;
      int tiles = 0;
      const double tile = size_of(line);
      if (shares > 0) while ((tiles + 1) * tile <= room * (1 + 1e-9) + 1e-4 * tile) ++tiles;
      else if (room > 0) tiles = std::max(1, int(std::floor(room / tile + 0.5)));
      rest = shares > 0 ? std::max(0.0, room - tiles * tile) : 0;
      for (int i = 0; i < tiles; ++i) tiled.push_back({&line, shares > 0 ? tile : room / tiles});
    }
    std::vector<Stretch> row;
    for (const ast::Case& line : stmt.cases) {
      if (line.sizing == Sizing::plain) row.push_back({&line, size_of(line) * (fixed > whole ? whole / fixed : 1)});
      else if (line.sizing == Sizing::floating) row.push_back({&line, rest * size_of(line) / shares});
      else if (tiled.empty()) row.push_back({&line, 0});
      else row.insert(row.end(), tiled.begin(), tiled.end());
    }
    double at = -whole / 2;
    for (const Stretch& part : row) {
      State inner = state;
      inner.t += state.a[axis] * (at + part.size / 2);
      inner.s[axis] = part.size;
      sleeping_ += !(part.size > 0);  // its genes sleep, but they are there and have their place
      block(part.line->block, g, inner, names);
      sleeping_ -= !(part.size > 0);
      at += part.size;
    }
  }

  void comp(const ast::Stmt& stmt, Gene& g, const State& state, const Names& names) {
    struct Side {
      std::string name;
      bool side;
      Vec outward, up;
    };
    const std::vector<Side> sides = {{"front", true, {0, 0, 1}, {0, 1, 0}},  {"back", true, {0, 0, -1}, {0, 1, 0}},
                                     {"right", true, {1, 0, 0}, {0, 1, 0}},  {"left", true, {-1, 0, 0}, {0, 1, 0}},
                                     {"top", false, {0, 1, 0}, {0, 0, -1}}, {"bottom", false, {0, -1, 0}, {0, 0, 1}}};
    for (const Side& side : sides) {
      for (const ast::Case& line : stmt.cases) {
        if (line.face != side.name && line.face != "all" && !(line.face == "sides" && side.side)) continue;
        const Vec across = glm::cross(side.up, side.outward);
        State inner = state;
        inner.t += state.a * (0.5 * side.outward * state.s);
        inner.a = state.a * Mat(across, side.up, side.outward);
        inner.s = {glm::length(across * state.s), glm::length(side.up * state.s), 0};
        block(line.block, g, inner, names);
        break;
      }
    }
  }

  void aim(const ast::Stmt& stmt, State& state, Vec target, double share) {
    const int axis = static_cast<int>(*stmt.axis);
    if (stmt.at) target -= state.t;
    const Vec from = state.a[axis];
    const double size = glm::length(target) * glm::length(from);
    if (!(size > 0)) return;
    Vec about = glm::cross(from, target);
    const double c = std::clamp(glm::dot(from, target) / size, -1.0, 1.0);
    if (glm::length(about) < 1e-6 * size) {
      if (c > 0) return;
      about = state.a[(axis + 1) % 3];
    }
    state.a = rotation(about, share * std::acos(c)) * state.a;
  }

  void loop(const ast::Stmt& stmt, Gene& g, const State& state, const Names& names) {
    std::vector<Value> values;
    for (const auto& expr : stmt.list.values) values.push_back(evaluate(*expr, g, state, names));
    if (stmt.list.range) {
      const double first = values[0].x(), last = values[1].x();
      values.clear();
      for (double x = first; x <= last + 1e-6; ++x) values.push_back({Vec(x)});
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      Names inner = names;
      inner[stmt.name] = values[i];
      g.turns.push_back(static_cast<int>(i));
      block(stmt.blocks[0], g, state, inner);
      g.turns.pop_back();
    }
  }

  void spawn(const ast::Stmt& stmt, Gene& g, const State& state, const Names& names) {
    const auto [it, fresh] = g.slots.try_emplace({&stmt, g.turns}, g.slot_count);
    if (fresh) ++g.slot_count;
    if (sleeping_ || derivation_.slots[g.at.slot + it->second] != SlotState::filled) return;
    std::vector<Value> args;
    for (const auto& arg : stmt.target->args) args.push_back(evaluate(*arg, g, state, names));
    gene(g.children[it->second], state, args, g.depth + 1);
  }

  Value draw(const ast::Stmt& stmt, Gene& g, const State& state, const Names& names) {
    const ast::Expr& call = *stmt.exprs[0];
    std::vector<Value> args;
    bool vector = false;
    for (const auto& arg : call.args) {
      args.push_back(evaluate(*arg.value, g, state, names));
      vector |= args.back().vector && call.name != "pick";
    }
    const auto [it, fresh] = g.draws.try_emplace({&stmt, g.turns}, g.draw_count);
    if (fresh) g.draw_count += vector ? 3 : 1;
    const auto u = [&](int i) { return (derivation_.draws[g.at.draw + it->second + i] >> 8) * 0x1p-24; };
    Value value;
    value.vector = vector;
    if (call.name == "angle") value.v.x = 2 * M_PI * u(0);
    else if (call.name == "chance") value.v.x = u(0) < args[0].x();
    else if (call.name == "pick") {
      std::vector<double> weights;
      double total = 0;
      for (const auto& arg : call.args)
        weights.push_back(arg.label ? evaluate(*arg.label, g, state, names).x() : 1), total += weights.back();
      double sum = 0;
      for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += weights[i];
        if (u(0) * total < sum || i + 1 == weights.size()) return args[i];
      }
    } else {
      for (int i = 0; i < (vector ? 3 : 1); ++i) {
        const auto part = [&](std::size_t k) { return args[k].vector ? args[k].v[i] : args[k].v.x; };
        if (call.name == "uniform") value.v[i] = part(0) + (part(1) - part(0)) * u(i);
        if (call.name == "loguniform") value.v[i] = part(0) * std::pow(part(1) / part(0), u(i));
        if (call.name == "integer") value.v[i] = part(0) + std::floor((part(1) - part(0) + 1) * u(i));
        if (call.name == "normal") value.v[i] = normal(part(0), part(1), part(2), part(3), u(i));
      }
    }
    return value;
  }

  // The quantile by bisection on the distribution itself.
  static double normal(double mean, double sd, double low, double high, double u) {
    const auto cdf = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
    const double a = cdf((low - mean) / sd), b = cdf((high - mean) / sd);
    double lo = low, hi = high;
    for (int i = 0; i < 80; ++i) {
      const double mid = 0.5 * (lo + hi);
      (cdf((mid - mean) / sd) < a + (b - a) * u ? lo : hi) = mid;
    }
    return lo;
  }

  Value evaluate(const ast::Expr& e, const Gene& g, const State& state, const Names& names) const;
  static Vec unit(int axis) { return {axis == 0, axis == 1, axis == 2}; }
  static Mat rotation(Vec u, double angle) {
    u = glm::normalize(u);
    Mat m;
    for (int c = 0; c < 3; ++c) {
      const Vec e = unit(c);
      m[c] = e * std::cos(angle) + glm::cross(u, e) * std::sin(angle) + u * (glm::dot(u, e) * (1 - std::cos(angle)));
    }
    return m;
  }

  const CheckedGrammar& grammar_;
  const GeneratorGraph& graph_;
  const Derivation& derivation_;
  Names globals_;
  int sleeping_ = 0;  // blocks of parts without length around
};

inline Value Expander::evaluate(const ast::Expr& e, const Gene& g, const State& state, const Names& names) const {
  const auto child = [&](std::size_t i) { return evaluate(*e.children[i], g, state, names); };
  const auto arg = [&](std::size_t i) { return evaluate(*e.args[i].value, g, state, names); };
  const auto each = [](const Value& a, const Value& b, auto f) {
    Value out;
    out.vector = a.vector || b.vector;
    for (int i = 0; i < 3; ++i) out.v[i] = f(a.vector ? a.v[i] : a.v.x, b.vector ? b.v[i] : b.v.x);
    return out;
  };
  switch (e.kind) {
    case ast::ExprKind::number: return {Vec(literal_value(e).scalar())};
    case ast::ExprKind::boolean: return {Vec(e.value)};
    case ast::ExprKind::text: return {};
    case ast::ExprKind::vector: return {{child(0).x(), child(1).x(), child(2).x()}, true};
    case ast::ExprKind::member: return {Vec(child(0).v[static_cast<int>(e.axis)])};
    case ast::ExprKind::ternary: return child(child(0).x() != 0 ? 1 : 2);
    case ast::ExprKind::unary: {
      const Value a = child(0);
      if (e.op == ast::Operator::logical_not) return {Vec(a.x() == 0)};
      return {-a.v, a.vector};
    }
    case ast::ExprKind::binary:
      return each(child(0), child(1), [&](double a, double b) -> double {
        switch (e.op) {
          case ast::Operator::add: return a + b;
          case ast::Operator::subtract: return a - b;
          case ast::Operator::multiply: return a * b;
          case ast::Operator::divide: return a / b;
          case ast::Operator::modulo: return a - b * std::floor(a / b);
          case ast::Operator::power: return std::pow(a, b);
          case ast::Operator::less: return a < b;
          case ast::Operator::less_equal: return a <= b;
          case ast::Operator::greater: return a > b;
          case ast::Operator::greater_equal: return a >= b;
          case ast::Operator::equal: return a == b;
          case ast::Operator::not_equal: return a != b;
          case ast::Operator::logical_and: return a != 0 && b != 0;
          default: return a != 0 || b != 0;
        }
      });
    case ast::ExprKind::name: {
      if (e.name == "scope") return {state.s, true};
      if (e.name == "depth") return {Vec(g.depth)};
      if (e.name == "childless") return {Vec(g.childless)};
      if (const auto it = names.find(e.name); it != names.end()) return it->second;
      if (const auto kind = primitive_named(e.name)) return {{0, *kind == MeshKind::cone ? 0 : 1, 0}, false, *kind};
      if (const ast::Decl* decl = grammar_.find(e.name)) {
        if (decl->kind == ast::DeclKind::attribute) return {Vec(grammar_.attributes.at(e.name).value.scalar())};
        if (decl->kind != ast::DeclKind::material) return evaluate(*decl->value, g, state, {});
      }
      return {};
    }
    case ast::ExprKind::call: break;
  }
  if (const auto kind = primitive_named(e.name)) {
    Value mesh{{0, *kind == MeshKind::cone ? 0 : 1, 0}, false, *kind};
    for (std::size_t i = 0; i < e.args.size(); ++i)
      if (e.args[i].label && e.args[i].label->name == "top") mesh.v.y = arg(i).x();
    return mesh;
  }
  if (const ast::Decl* function = grammar_.find(e.name, ast::DeclKind::function)) {
    Names inner = globals_;
    for (std::size_t i = 0; i < e.args.size(); ++i) inner[function->params[i].name] = arg(i);
    return evaluate(*function->value, g, state, inner);
  }
  const Value a = arg(0);
  const double x = a.x();
  const double y = e.args.size() > 1 ? arg(1).x() : 0, z = e.args.size() > 2 ? arg(2).x() : 0;
  if (e.name == "vec") return {a.vector ? a.v : Vec(x), true};
  if (e.name == "length") return {Vec(glm::length(a.v))};
  if (e.name == "normalize") return {glm::normalize(a.v), true};
  if (e.name == "dot") return {Vec(glm::dot(a.v, arg(1).v))};
  if (e.name == "cross") return {glm::cross(a.v, arg(1).v), true};
  if (e.name == "mix") return each(each(a, a, [](double p, double) { return p; }), arg(1), [&](double p, double q) { return p + (q - p) * z; });
  if (e.name == "abs") return {Vec(std::abs(x))};
  if (e.name == "min") return {Vec(std::min(x, y))};
  if (e.name == "max") return {Vec(std::max(x, y))};
  if (e.name == "clamp") return {Vec(std::min(std::max(x, y), z))};
  if (e.name == "floor") return {Vec(std::floor(x))};
  if (e.name == "ceil") return {Vec(std::ceil(x))};
  if (e.name == "round") return {Vec(std::floor(x + 0.5))};
  if (e.name == "sqrt") return {Vec(std::sqrt(x))};
  if (e.name == "exp") return {Vec(std::exp(x))};
  if (e.name == "log") return {Vec(std::log(x))};
  if (e.name == "sin") return {Vec(std::sin(x))};
  if (e.name == "cos") return {Vec(std::cos(x))};
  if (e.name == "tan") return {Vec(std::tan(x))};
  if (e.name == "asin") return {Vec(std::asin(x))};
  if (e.name == "acos") return {Vec(std::acos(x))};
  if (e.name == "atan2") return {Vec(std::atan2(x, y))};
  if (e.name == "smooth") {
    const double t = std::clamp((z - x) / (y - x), 0.0, 1.0);
    return {Vec(t * t * (3 - 2 * t))};
  }
  return {};
}

}  // namespace espalier::reference
