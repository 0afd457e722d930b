#include "studio/breeding_store.h"

#include <array>
#include <chrono>

#include <fmt/format.h>

#include "base/error.h"
#include "studio/breeding_writer.h"

namespace espalier::studio {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

[[noreturn]] void fail_no_session(std::int64_t session) {
  throw Error(fmt::format("there is no breeding session {}", session));
}

BreedingSummary summary_of(const Statement& row) {
  return {row.whole(0), row.text(1), row.text(2), row.whole(3), row.whole(4), row.number(5)};
}

constexpr const char* kSummary =
    "id, name, method, (select count(*) from breeding_generation where session = id), "
    "(select count(*) from breeding_individual i where i.session = breeding_session.id and present), changed";

BredRow row_of(const Statement& row) {
  BredRow one;
  one.id = row.whole(0);
  one.generation = row.whole(1);
  one.place = row.whole(2);
  one.origin = row.text(3);
  one.born = row.text(4);
  one.derivation = row.text(5);
  one.edited = row.whole(6) != 0;
  one.present = row.whole(7) != 0;
  one.role = row.maybe_text(8);
  if (!row.null(9)) one.rating = row.number(9);
  const std::string parents = row.text(10);
  for (std::size_t at = 0; at < parents.size();) {
    const std::size_t end = std::min(parents.find(' ', at), parents.size());
    one.parents.push_back(std::stoll(parents.substr(at, end - at)));
    at = end + 1;
  }
  return one;
}

constexpr const char* kRow =
    "select id, generation, place, origin, born, derivation, edited, present, role, rating, "
    "(select group_concat(parent, ' ') from (select parent from breeding_lineage l where l.session = i.session and "
    "child = id "
    "order by l.place)) from breeding_individual i left join breeding_rating r on r.session = i.session and individual "
    "= id "
    "where i.session = ?";

}  // namespace

std::vector<BreedingSummary> BreedingStore::list(std::int64_t project) {
  std::vector<BreedingSummary> all;
  store_.alone([&](Database& database) {
    Statement ask = database.prepare(
        fmt::format("select {} from breeding_session where project = ? order by changed desc, id desc", kSummary));
    ask.bind(project);
    while (ask.step()) all.push_back(summary_of(ask));
  });
  return all;
}

std::int64_t BreedingStore::create(std::int64_t project, const BreedingHead& head, const BreedingStep& first) {
  std::int64_t session = 0;
  store_.alone([&](Database& database) {
    Transaction transaction(database);
    session = add_session(database, project, head);
    // The first generation is how the session begins, nothing to take back.
    BreedingWriter(database, session).add(first);
    transaction.commit();
  });
  return session;
}

void BreedingStore::rename(std::int64_t project, std::int64_t session, const std::string& name) {
  if (name.find_first_not_of(' ') == std::string::npos) throw Error("a breeding session must have a name");
  open(project, session);
  store_.alone([&](Database& database) {
    database.prepare("update breeding_session set name = ?, changed = ?, revision = revision + 1 where id = ?")
        .bind(name).bind(now()).bind(session).run();
  });
}

void BreedingStore::remove(std::int64_t project, std::int64_t session) {
  open(project, session);
  store_.alone([&](Database& database) {
    database.prepare("delete from breeding_session where id = ?").bind(session).run();
  });
}

BreedingHead BreedingStore::open(std::int64_t project, std::int64_t session) {
  BreedingHead head;
  store_.alone([&](Database& database) {
    Statement ask =
        database.prepare(fmt::format("select {}, project, revision, seed, settings, locked, generation, step, "
                                     "(select coalesce(max(i.id), 0) from breeding_individual i where "
                                     "i.session = breeding_session.id), (select coalesce(max(number), 0) "
                                     "from breeding_comparison where session = breeding_session.id) "
                                     "from breeding_session where id = ? and project = ?",
                                     kSummary));
    if (!ask.bind(session).bind(project).step()) fail_no_session(session);
    head.summary = summary_of(ask);
    head.project = ask.whole(6);
    head.revision = ask.whole(7);
    head.seed = ask.whole(8);
    head.settings = ask.text(9);
    head.locked = ask.text(10);
    head.generation = ask.whole(11);
    const std::int64_t step = ask.whole(12);
    head.last_individual = ask.whole(13);
    head.last_comparison = ask.whole(14);
    Statement steps =
        database.prepare("select number, label from breeding_step where session = ? and number between ? and ?");
    steps.bind(session).bind(step).bind(step + 1);
    while (steps.step()) (steps.whole(0) == step ? head.undo : head.redo) = steps.text(1);
  });
  return head;
}

std::vector<GenerationSummary> BreedingStore::generations(std::int64_t session) {
  std::vector<GenerationSummary> all;
  store_.alone([&](Database& database) {
    Statement ask = database.prepare(
        "select g.number, g.parent, g.label, g.seconds, g.diversity, count(i.id), count(r.rating), "
        "coalesce(sum(i.edited), 0) "
        "from breeding_generation g left join breeding_individual i on i.session = g.session and i.generation = "
        "g.number and "
        "i.present left join breeding_rating r on r.session = i.session and r.individual = i.id where g.session = ? "
        "group by g.number order by g.number");
    ask.bind(session);
    while (ask.step()) {
      GenerationSummary one{ask.whole(0), ask.whole(1), ask.whole(5),  ask.whole(6),
                            ask.whole(7), ask.text(2),  ask.number(3), {}};
      if (!ask.null(4)) one.diversity = ask.number(4);
      all.push_back(std::move(one));
    }
  });
  return all;
}

StoredGeneration BreedingStore::generation(std::int64_t session, std::int64_t number) {
  StoredGeneration one;
  std::array<std::string, 3> hashes;
  store_.alone([&](Database& database) {
    Statement ask = database.prepare("select parent, label, grammar, scene, files, recipe, seconds, diversity from "
                                     "breeding_generation where session = ? and number = ?");
    if (!ask.bind(session).bind(number).step()) throw Error(fmt::format("the session has no generation {}", number));
    one.number = number;
    one.parent = ask.whole(0);
    one.label = ask.text(1);
    for (int i = 0; i < 3; ++i) hashes[static_cast<std::size_t>(i)] = ask.text(2 + i);
    one.recipe = ask.text(5);
    one.seconds = ask.number(6);
    if (!ask.null(7)) one.diversity = ask.number(7);
  });
  one.state = {text(session, hashes[0]), text(session, hashes[1]), parse_files(text(session, hashes[2]))};
  return one;
}

std::vector<BredRow> BreedingStore::individuals(std::int64_t session, std::optional<std::int64_t> generation) {
  std::vector<BredRow> all;
  store_.alone([&](Database& database) {
    Statement ask = database.prepare(
        fmt::format("{} {}", kRow, generation ? "and generation = ? and present order by i.place, id" : "order by id"));
    ask.bind(session);
    if (generation) ask.bind(*generation);
    while (ask.step()) all.push_back(row_of(ask));
  });
  return all;
}

BredRow BreedingStore::individual(std::int64_t session, std::int64_t id) {
  std::optional<BredRow> found;
  store_.alone([&](Database& database) {
    Statement ask = database.prepare(fmt::format("{} and id = ?", kRow));
    if (ask.bind(session).bind(id).step()) found = row_of(ask);
  });
  if (!found) throw Error(fmt::format("the session has no individual {}", id));
  return *found;
}

std::vector<BreedingComparison> BreedingStore::comparisons(std::int64_t session) {
  std::vector<BreedingComparison> all;
  store_.alone([&](Database& database) {
    Statement ask = database.prepare(
        "select number, better, worse from breeding_comparison where session = ? and present "
        "order by number");
    ask.bind(session);
    while (ask.step()) all.push_back({ask.whole(0), ask.whole(1), ask.whole(2)});
  });
  return all;
}

std::string BreedingStore::text(std::int64_t session, const std::string& hash) {
  std::optional<std::string> found;
  store_.alone([&](Database& database) {
    Statement ask = database.prepare("select bytes from breeding_text where session = ? and hash = ?");
    if (ask.bind(session).bind(hash).step()) found = ask.text(0);
  });
  if (!found) throw Error(fmt::format("breeding session {} is damaged: a text is missing", session));
  return *found;
}

void BreedingStore::take(std::int64_t session, const BreedingStep& step) {
  store_.alone([&](Database& database) {
    Transaction transaction(database);
    BreedingWriter(database, session).take(step);
    transaction.commit();
  });
}

void BreedingStore::set_diversity(std::int64_t session, std::int64_t generation, double diversity) {
  store_.alone([&](Database& database) {
    database.prepare("update breeding_generation set diversity = ? where session = ? and number = ?")
        .bind(diversity).bind(session).bind(generation).run();
  });
}

bool BreedingStore::move(std::int64_t session, bool back) {
  bool moved = false;
  store_.alone([&](Database& database) {
    Transaction transaction(database);
    BreedingWriter writer(database, session);
    const std::int64_t head = writer.head_step(), number = back ? head : head + 1;
    {
      Statement ask = database.prepare("select 1 from breeding_step where session = ? and number = ?");
      if (!ask.bind(session).bind(number).step()) return;
    }
    std::vector<std::pair<BreedingField, std::pair<std::int64_t, std::optional<std::string>>>> changes;
    {
      Statement ask =
          database.prepare(fmt::format("select field, subject, {} from breeding_change where session = ? and step = ? "
                                       "order by number {}",
                                       back ? "before" : "after", back ? "desc" : "asc"));
      ask.bind(session).bind(number);
      while (ask.step()) {
        changes.push_back({breeding_field(ask.text(0)), {ask.whole(1), ask.maybe_text(2)}});
      }
    }
    for (const auto& [field, value] : changes) writer.apply(field, value.first, value.second);
    // What comes next is a step of its own, whatever gesture it is of.
    database.prepare("update breeding_step set gesture = '' where session = ? and number between ? and ?")
        .bind(session).bind(number - 1).bind(number + 1).run();
    writer.touch(back ? head - 1 : number);
    transaction.commit();
    moved = true;
  });
  return moved;
}

}  // namespace espalier::studio
