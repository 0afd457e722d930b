#pragma once
// Writes an L-system as the text of a grammar. Private to the importer.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "grammar/lsystem.h"
#include "grammar/lsystem_import.h"
#include "grammar/lsystem_names.h"
#include "grammar/lsystem_steps.h"

namespace espalier::lsystem {

class Writer {
 public:
  /// `other_steps`: those of the same system with another angle, to see what depends on it.
  Writer(const System& system, const Steps& steps, const Steps& other_steps, const LSystemImport& options,
         Diagnostics& diagnostics)
      : system_(system), steps_(steps), other_steps_(other_steps), options_(options), diagnostics_(diagnostics) {}

  /// Not yet formatted.
  std::string run();

 private:
  using Modules = std::vector<const Module*>;

  /// A rule, for the steps to which the same productions apply.
  struct RuleName {
    std::string name;
    std::set<std::size_t> productions;
    std::vector<char> used;  // by parameter
  };
  struct Plan {
    std::vector<RuleName> rules;  // of a detail: one
    std::string segment;          // the rule that draws it in the end, where it draws and is a rule
    std::vector<char> used;       // by parameter, in any rule
    bool asked_for = false;
  };
  /// The lines of one body, and the names in it.
  struct Body {
    bool in_detail = false;
    bool in_start = false;  // whose lets are seen everywhere
    std::string left;  // steps that are left to its modules
    NameTable names;
    std::map<std::string, std::string> params;  // as in the source, to names here
    std::map<std::string, std::string> lets;    // by expression
    std::vector<std::string> let_lines, lines;
    std::string line;  // begun
  };

  // lsystem_writer.cpp: declarations
  void plan();
  void find_used_params();
  bool mark_used(const Species& species, std::size_t production, std::vector<char>& used) const;
  std::string declarations() const;
  std::string about() const;
  void write(const Species& species);
  void write_rule(const Species& species, const RuleName& rule);
  void write_segment(const Species& species);
  void write_detail(const Species& species);
  std::string alternatives(const std::set<std::size_t>& productions, const Body& empty);
  std::string condition(const Species& species, const std::set<std::size_t>* productions);
  std::string head(const Species& species, const RuleName& rule, Body& body) const;
  void fail(std::string code, const SourceSpan& span, std::string message, std::string help);

  // lsystem_body.cpp: statements
  Modules visible(const std::vector<Module>& modules) const;
  std::string text_of(const Modules& modules, Body body);
  void emit(const Modules& modules, Body& body);
  void emit_command(const Module& module, Body& body);
  std::size_t emit_turns(const Modules& modules, std::size_t at, Body& body);
  void emit_segment(const std::string& length, Body& body);
  void emit_child(const Module& module, const Species& species, Body& body);
  void add(Body& body, const std::string& statement);
  void end_line(Body& body);
  void close_brackets(Body& body);
  std::string length_of(const Module& module, Body& body);
  std::string grown(std::string value, const Module& module, const Body& body);
  std::string named(const std::string& expression, const char* wanted, Body& body);
  std::string spell_in(const Expr& expr, const Body& body);
  std::string factor(const Expr& expr, const Body& body);
  std::string use(const std::string& setting);
  std::string use_constant(const std::string& name);
  bool fits_turns(const Module& module, char axis) const;

  // lsystem_leap_writer.cpp
  void emit_leap(const Module& module, const Species& species, Body& body);
  const std::optional<std::vector<Leap>>& leaps_of(const Species& species, bool scaled);
  std::optional<std::vector<Leap>> find_leaps(const Species& species, bool scaled);
  void emit_way(const Species& species, const std::vector<Leap>& leaps, bool fixed, const std::string& by, Body& body);
  void emit_rotation(const Species& species, const std::vector<Leap>& leaps, Body& body);
  std::string use_step_if(const std::vector<Leap>& leaps);
  std::string table(const std::string& what, const std::vector<std::string>& values);

  const Plan& plan_of(const Species& species) const { return plans_.at(&species); }

  const System& system_;
  const Steps& steps_;
  const Steps& other_steps_;
  const LSystemImport& options_;
  Diagnostics& diagnostics_;
  NameTable globals_;
  std::map<std::string, std::string> constants_;  // by name in the source
  std::map<std::string, std::string> settings_;   // step, turn_angle, ..: by what they are to their names
  std::set<std::string> used_, used_constants_;   // settings and constants that the text reads
  std::map<const Species*, Plan> plans_;
  std::vector<const Species*> wanted_;            // asked for and still to be written
  std::map<std::string, std::string> tables_;     // what functions are for, to names kept free for them
  std::map<std::pair<const Species*, bool>, std::optional<std::vector<Leap>>> leaps_;
  std::set<std::string> written_tables_;
  std::string functions_;
  std::string rules_;
  bool angle_is_fixed_ = false, has_details_ = false;
};

}  // namespace espalier::lsystem
