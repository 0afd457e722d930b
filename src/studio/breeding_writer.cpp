#include "studio/breeding_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>

#include <fmt/format.h>

#include "base/error.h"
#include "base/hash.h"

namespace espalier::studio {
namespace {

constexpr std::array<const char*, 8> kFields = {"settings", "locked",   "generation", "derivation",
                                                "edited",   "rating",   "present",    "compared"};

double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

double number_in(const std::string& text) {
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

const char* name_of(BreedingField field) { return kFields[static_cast<std::size_t>(field)]; }

BreedingField breeding_field(const std::string& name) {
  const auto field = std::find(kFields.begin(), kFields.end(), name);
  if (field == kFields.end()) throw Error(fmt::format("a step of a breeding session is damaged: it changes {}", name));
  return static_cast<BreedingField>(field - kFields.begin());
}

std::int64_t add_session(Database& database, std::int64_t project, const BreedingHead& head) {
  Statement ask = database.prepare("select count(*) from breeding_session where project = ?");
  if (ask.bind(project).step() && ask.whole(0) >= BreedingStore::kMostBreedings) {
    throw Error(fmt::format("a project has at most {} breeding sessions", BreedingStore::kMostBreedings));
  }
  database
      .prepare(
          "insert into breeding_session (project, name, method, changed, revision, seed, settings, locked, generation, "
          "step, bytes) values (?, ?, ?, ?, 1, ?, ?, ?, ?, 0, 0)")
      .bind(project)
      .bind(head.summary.name)
      .bind(head.summary.method)
      .bind(now())
      .bind(head.seed)
      .bind(head.settings)
      .bind(head.locked)
      .bind(std::max<std::int64_t>(head.generation, 1))
      .run();
  return database.last_row();
}

std::int64_t BreedingWriter::head_step() const {
  Statement ask = database_.prepare("select step from breeding_session where id = ?");
  if (!ask.bind(session_).step()) throw Error(fmt::format("there is no breeding session {}", session_));
  return ask.whole(0);
}

std::int64_t BreedingWriter::count(const char* statement) const {
  Statement ask = database_.prepare(statement);
  return ask.bind(session_).step() ? ask.whole(0) : 0;
}

void BreedingWriter::keep_text(const std::string& hash, const std::string& text) {
  {
    Statement ask = database_.prepare("select 1 from breeding_text where session = ? and hash = ?");
    if (ask.bind(session_).bind(hash).step()) return;
  }
  const std::int64_t since = count("select count(*) from breeding_generation where session = ?");
  database_.prepare("insert into breeding_text values (?, ?, ?, ?)")
      .bind(session_)
      .bind(hash)
      .bind(since)
      .bind_blob(text)
      .run();
  database_.prepare("update breeding_session set bytes = bytes + ? where id = ?")
      .bind(static_cast<std::int64_t>(text.size())).bind(session_).run();
}

/// A derivation that a gesture went through, unless something names it.
void BreedingWriter::forget_text(const std::string& hash) {
  Statement ask = database_.prepare(
      "select length(bytes) from breeding_text where session = ?1 and hash = ?2 and since = (select count(*) from "
      "breeding_generation where session = ?1) and not exists (select 1 from breeding_individual where session = ?1 "
      "and "
      "(derivation = ?2 or born = ?2)) and not exists (select 1 from breeding_change where session = ?1 and "
      "(before = ?2 or after = ?2))");
  if (!ask.bind(session_).bind(hash).step()) return;
  const std::int64_t bytes = ask.whole(0);
  database_.prepare("delete from breeding_text where session = ? and hash = ?").bind(session_).bind(hash).run();
  database_.prepare("update breeding_session set bytes = bytes - ? where id = ?").bind(bytes).bind(session_).run();
}

void BreedingWriter::add_generation(const StoredGeneration& one) {
  if (one.number > BreedingStore::kMostGenerations) {
    throw Error(fmt::format("a session has at most {} generations: begin another one from your favourites",
                            BreedingStore::kMostGenerations));
  }
  const std::string files = to_json(one.state.files);
  const std::array<std::string, 3> texts = {one.state.grammar, one.state.scene, files};
  std::array<std::string, 3> hashes;
  for (std::size_t i = 0; i < texts.size(); ++i) keep_text(hashes[i] = content_hash(texts[i]), texts[i]);
  Statement insert = database_.prepare(
      "insert into breeding_generation (session, number, parent, label, grammar, scene, files, "
      "recipe, seconds, diversity) values (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(session_).bind(one.number).bind(one.parent).bind(one.label);
  for (const std::string& hash : hashes) insert.bind(hash);
  insert.bind_blob(one.recipe).bind(one.seconds);
  if (one.diversity) insert.bind(*one.diversity);
  else insert.bind_maybe({});
  insert.run();
  database_.prepare("update breeding_session set bytes = bytes + ? where id = ?")
      .bind(static_cast<std::int64_t>(one.recipe.size())).bind(session_).run();
}

void BreedingWriter::add_individual(const BredRow& row) {
  if (row.id > BreedingStore::kMostIndividuals) {
    throw Error(fmt::format("a session has at most {} individuals: begin another one from your favourites",
                            BreedingStore::kMostIndividuals));
  }
  Statement insert = database_.prepare("insert into breeding_individual values (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(session_)
      .bind(row.id)
      .bind(row.generation)
      .bind(row.place)
      .bind(row.origin)
      .bind(row.born)
      .bind(row.derivation)
      .bind(std::int64_t{row.edited})
      .bind(std::int64_t{row.present})
      .bind_maybe(row.role)
      .run();
  for (std::size_t i = 0; i < row.parents.size(); ++i) {
    database_.prepare("insert into breeding_lineage values (?, ?, ?, ?)")
        .bind(session_).bind(row.id).bind(static_cast<std::int64_t>(i)).bind(row.parents[i]).run();
  }
  if (row.rating) {
    database_.prepare("insert into breeding_rating values (?, ?, ?)")
        .bind(session_)
        .bind(row.id)
        .bind(*row.rating)
        .run();
  }
}

void BreedingWriter::apply(BreedingField field, std::int64_t subject, const std::optional<std::string>& value) {
  const std::string text = value.value_or("");
  const auto set_session = [&](const char* statement) { database_.prepare(statement).bind(text).bind(session_).run(); };
  const auto set_individual = [&](const char* statement) {
    database_.prepare(statement).bind(text).bind(session_).bind(subject).run();
  };
  switch (field) {
    case BreedingField::settings: return set_session("update breeding_session set settings = ? where id = ?");
    case BreedingField::locked: return set_session("update breeding_session set locked = ? where id = ?");
    case BreedingField::generation:
      return set_session("update breeding_session set generation = cast(? as integer) where id = ?");
    case BreedingField::derivation:
      return set_individual("update breeding_individual set derivation = ? where session = ? and id = ?");
    case BreedingField::edited:
      return set_individual("update breeding_individual set edited = cast(? as integer) where session = ? and id = ?");
    case BreedingField::present:
      return set_individual("update breeding_individual set present = cast(? as integer) where session = ? and id = ?");
    case BreedingField::compared:
      return set_individual(
          "update breeding_comparison set present = cast(? as integer) where session = ? and number = ?");
    case BreedingField::rating:
      if (!value) {
        database_.prepare("delete from breeding_rating where session = ? and individual = ?")
            .bind(session_)
            .bind(subject)
            .run();
      } else {
        database_.prepare("insert or replace into breeding_rating values (?, ?, ?)")
            .bind(session_).bind(subject).bind(number_in(text)).run();
      }
  }
}

void BreedingWriter::touch(std::int64_t step) {
  database_.prepare("update breeding_session set step = ?, changed = ?, revision = revision + 1 where id = ?")
      .bind(step).bind(now()).bind(session_).run();
}

/// The step joins the one before, which is of the same gesture: of each field it knows the first before and the last
/// after.
void BreedingWriter::join(std::int64_t number, const BreedingStep& step) {
  for (const BreedingChange& change : step.changes) {
    std::int64_t place = -1;
    std::optional<std::string> old;
    {
      Statement ask = database_.prepare(
          "select number, after from breeding_change where session = ? and step = ? and field = ? "
          "and subject = ?");
      ask.bind(session_).bind(number).bind(name_of(change.field)).bind(change.subject);
      if (ask.step()) place = ask.whole(0), old = ask.maybe_text(1);
    }
    if (place < 0) {
      add_change(number, change);
      continue;
    }
    database_.prepare("update breeding_change set after = ? where session = ? and step = ? and number = ?")
        .bind_maybe(change.after).bind(session_).bind(number).bind(place).run();
    if (change.field == BreedingField::derivation && old) forget_text(*old);
  }
  database_.prepare("update breeding_step set label = ? where session = ? and number = ?")
      .bind(step.label).bind(session_).bind(number).run();
}

void BreedingWriter::add_change(std::int64_t step, const BreedingChange& change) {
  database_.prepare("insert into breeding_change select ?1, ?2, coalesce(max(number), -1) + 1, ?3, ?4, ?5, ?6 "
                    "from breeding_change where session = ?1 and step = ?2")
      .bind(session_).bind(step).bind(name_of(change.field)).bind(change.subject)
      .bind_maybe(change.before).bind_maybe(change.after).run();
}

void BreedingWriter::forget_steps(const char* which, std::int64_t number) {
  for (const auto& [table, column] : {std::pair{"breeding_change", "step"}, std::pair{"breeding_step", "number"}}) {
    database_.prepare(fmt::format("delete from {} where session = ? and {} {} ?", table, column, which))
        .bind(session_).bind(number).run();
  }
}

void BreedingWriter::add(const BreedingStep& step) {
  for (const auto& [hash, text] : step.texts) keep_text(hash, text);
  if (step.generation) add_generation(*step.generation);
  for (const BredRow& row : step.individuals) add_individual(row);
  for (const BreedingComparison& one : step.comparisons) {
    database_.prepare("insert into breeding_comparison values (?, ?, ?, ?, 1)")
        .bind(session_).bind(one.number).bind(one.better).bind(one.worse).run();
  }
  if (count("select bytes from breeding_session where id = ?") > BreedingStore::kMostBytes) {
    throw Error(fmt::format(
        "the derivations and texts of a session have at most {} bytes: begin another one from your favourites",
        BreedingStore::kMostBytes));
  }
}

void BreedingWriter::take(const BreedingStep& step) {
  const std::int64_t head = head_step();
  {
    // Before anything else: what was looked at is the generation that was shown until now.
    database_.prepare("update breeding_generation set seconds = seconds + ? where session = ? and number = "
                      "(select generation from breeding_session where id = ?)")
        .bind(step.seconds).bind(session_).bind(session_).run();
  }
  add(step);
  for (const BreedingChange& change : step.changes) apply(change.field, change.subject, change.after);
  bool joins = false;
  if (!step.gesture.empty()) {
    Statement ask = database_.prepare(
        "select gesture from breeding_step where session = ?1 and number = ?2 and not exists ("
        "select 1 from breeding_step where session = ?1 and number > ?2)");
    joins = ask.bind(session_).bind(head).step() && ask.text(0) == step.gesture;
  }
  if (joins) {
    join(head, step);
    touch(head);
  } else {
    forget_steps(">", head);
    forget_steps("<=", head + 1 - BreedingStore::kMostSteps);
    database_.prepare("insert into breeding_step values (?, ?, ?, ?)")
        .bind(session_).bind(head + 1).bind(step.label).bind(step.gesture).run();
    for (const BreedingChange& change : step.changes) add_change(head + 1, change);
    touch(head + 1);
  }
}

}  // namespace espalier::studio
