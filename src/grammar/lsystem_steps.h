#pragma once
// What an L-system does step by step, found by following the distinct modules of every step: which productions apply
// when, whether that depends on parameters alone through the number of the step, and where the turtle stands behind a
// module once it is rewritten. Step k is the string after k rewritings; a module of step k has iterations - k left.

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "grammar/lsystem.h"

namespace espalier::lsystem {

/// A symbol with a number of parameters, and how it is rewritten.
struct Species {
  std::string symbol;
  std::vector<std::string> params;
  std::vector<std::size_t> productions;  // into System::productions
  /// The symbol only multiplies: `F -> FF`, `F(l) -> F(l * 1.1)`, `!(w) -> !(w * 0.7)`. What it does after n more steps
  /// is what it does now, times growth^n.
  std::optional<double> growth;
  bool is_detail = false;                    // decides by parameters, or is reached from one that does
  std::vector<std::set<std::size_t>> applied;  // by step: productions that apply to its modules; all the same ones
  std::vector<char> occurs;                    // by step: whether there are modules that are still to be rewritten
};

/// Where the turtle gets from (0, 0, 0), heading +y: `unit` counts in steps, `fixed` in lengths written out.
struct Leap {
  using Vector = std::array<double, 3>;
  Vector unit{}, fixed{};
  std::array<Vector, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // columns
};

/// Up to rounding.
bool same(const Leap& a, const Leap& b);

class Steps {
 public:
  explicit Steps(const System& system);

  const std::vector<Species>& species() const { return species_; }
  /// Null where the module is no symbol that is rewritten.
  const Species* find(const Module& module) const;
  /// Where modules of a species with `left` steps to go lead, divided by their first argument if `scaled`; nothing
  /// where that differs between them.
  std::optional<Leap> leap(const Species& species, int left, bool scaled) const;
  bool draws(const Module& module) const { return system_.draw.find(module.symbol[0]) != std::string::npos; }
  bool moves(const Module& module) const { return system_.move.find(module.symbol[0]) != std::string::npos; }
  std::optional<double> constant(const Expr& expr) const;

 private:
  using Arguments = std::vector<double>;
  static constexpr std::size_t kMostWork = 2'000'000;
  /// Of following steps: distinct modules, and modules that they are replaced by.
  struct Budget {
    std::size_t modules = 20'000, successors = kMostWork;
  };
  using Key = std::pair<std::size_t, Arguments>;  // species

  void collect_species();
  void find_growth(Species& species) const;
  void follow();
  bool follow_step(int step, Budget& budget);
  void spread_details();
  std::size_t index_of(const Module& module) const;
  Values values(const Species& species, const Arguments& arguments) const;
  std::optional<Arguments> arguments(const Module& module, const Values& values) const;
  std::optional<std::set<std::size_t>> matching(const Species& species, const Arguments& arguments) const;
  bool reads_params(const Species& species) const;

  std::optional<Leap> leap_of(std::size_t species, const Arguments& arguments, int left) const;
  std::optional<Leap> leap_of(const std::vector<Module>& modules, const Values& values, int left) const;
  std::optional<Leap> leap_of(const Module& module, const Values& values, int left) const;

  const System& system_;
  std::vector<Species> species_;
  std::map<std::pair<std::string, std::size_t>, std::size_t> index_;
  std::vector<std::vector<std::set<Arguments>>> modules_;  // by step, by species
  bool followed_ = true;  // to the last step
  mutable std::map<std::pair<Key, int>, std::optional<Leap>> leaps_;
  mutable std::size_t leap_budget_ = kMostWork;  // modules that may still be followed to where they end
};

}  // namespace espalier::lsystem
