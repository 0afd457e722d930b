#pragma once
// BreedingWriter: what a step of a breeding session does to the tables. Within a transaction of the caller's.

#include <cstdint>
#include <optional>
#include <string>

#include "studio/breeding_store.h"
#include "studio/database.h"

namespace espalier::studio {

/// As the tables write it; the inverse throws Error.
const char* name_of(BreedingField field);
BreedingField breeding_field(const std::string& name);

/// A session with nothing in it; its number. Throws Error where there are too many.
std::int64_t add_session(Database& database, std::int64_t project, const BreedingHead& head);

class BreedingWriter {
 public:
  BreedingWriter(Database& database, std::int64_t session) : database_(database), session_(session) {}

  /// Number of the step that undo takes back. Throws Error where there is no such session.
  std::int64_t head_step() const;
  /// All of it. Throws Error beyond the budgets, as add does.
  void take(const BreedingStep& step);
  /// What comes with it, and nothing that undo would know of.
  void add(const BreedingStep& step);
  void apply(BreedingField field, std::int64_t subject, const std::optional<std::string>& value);
  /// `which`: "<=" or ">".
  void forget_steps(const char* which, std::int64_t number);
  /// The session has changed, and stands behind this step.
  void touch(std::int64_t step);

 private:
  std::int64_t count(const char* statement) const;
  void keep_text(const std::string& hash, const std::string& text);
  void forget_text(const std::string& hash);
  void add_generation(const StoredGeneration& one);
  void add_individual(const BredRow& row);
  void add_change(std::int64_t step, const BreedingChange& change);
  void join(std::int64_t number, const BreedingStep& step);

  Database& database_;
  std::int64_t session_;
};

}  // namespace espalier::studio
