#include "studio/breeding_tables.h"

namespace espalier::studio {

// Texts are kept once by their content; `since` says how many generations there were when one came, so that nothing is
// forgotten that a generation was bred from. `step` and `change` are the line of undo: what each step changed, before
// and after.
const char* const kBreedingTables = R"(
create table breeding_session (
  id integer primary key autoincrement, project integer not null references project on delete cascade,
  name text not null, method text not null, changed real not null, revision integer not null, seed integer not null,
  settings text not null, locked text not null, generation integer not null, step integer not null,
  bytes integer not null);
create index breeding_session_project on breeding_session (project);
create table breeding_text (
  session integer not null references breeding_session on delete cascade,
  hash text not null, since integer not null,
  bytes blob not null, primary key (session, hash));
create table breeding_generation (
  session integer not null references breeding_session on delete cascade,
  number integer not null, parent integer not null,
  label text not null, grammar text not null, scene text not null, files text not null, recipe blob not null,
  seconds real not null, diversity real, primary key (session, number)) without rowid;
create table breeding_individual (
  session integer not null references breeding_session on delete cascade,
  id integer not null, generation integer not null,
  place integer not null, origin text not null, born text not null, derivation text not null, edited integer not null,
  present integer not null, role text, primary key (session, id)) without rowid;
create index breeding_individual_generation on breeding_individual (session, generation);
create table breeding_lineage (
  session integer not null references breeding_session on delete cascade,
  child integer not null, place integer not null,
  parent integer not null, primary key (session, child, place)) without rowid;
create table breeding_rating (
  session integer not null references breeding_session on delete cascade,
  individual integer not null, rating real not null,
  primary key (session, individual)) without rowid;
create table breeding_comparison (
  session integer not null references breeding_session on delete cascade,
  number integer not null, better integer not null,
  worse integer not null, present integer not null, primary key (session, number)) without rowid;
create table breeding_step (
  session integer not null references breeding_session on delete cascade,
  number integer not null, label text not null,
  gesture text not null, primary key (session, number)) without rowid;
create table breeding_change (
  session integer not null references breeding_session on delete cascade,
  step integer not null, number integer not null,
  field text not null, subject integer not null, before text, after text, primary key (session, step, number)) without rowid;
pragma user_version = 4;
)";

void copy_breedings(Database& database, std::int64_t project, std::int64_t copy) {
  std::vector<std::int64_t> sessions;
  {
    Statement ask = database.prepare("select id from breeding_session where project = ? order by id");
    ask.bind(project);
    while (ask.step()) sessions.push_back(ask.whole(0));
  }
  for (const std::int64_t session : sessions) {
    database.prepare("insert into breeding_session (project, name, method, changed, revision, seed, settings, locked, "
                     "generation, step, bytes) select ?, name, method, changed, revision, seed, settings, locked, "
                     "generation, step, bytes from breeding_session where id = ?")
        .bind(copy).bind(session).run();
    const std::int64_t twin = database.last_row();
    for (const char* statement :
         {"insert into breeding_text select ?, hash, since, bytes from breeding_text where session = ?",
          "insert into breeding_generation select ?, number, parent, label, grammar, scene, files, recipe, seconds, "
          "diversity "
          "from breeding_generation where session = ?",
          "insert into breeding_individual select ?, id, generation, place, origin, born, derivation, edited, present, "
          "role "
          "from breeding_individual where session = ?",
          "insert into breeding_lineage select ?, child, place, parent from breeding_lineage where session = ?",
          "insert into breeding_rating select ?, individual, rating from breeding_rating where session = ?",
          "insert into breeding_comparison select ?, number, better, worse, present from breeding_comparison where "
          "session = ?",
          "insert into breeding_step select ?, number, label, gesture from breeding_step where session = ?",
          "insert into breeding_change select ?, step, number, field, subject, before, after from breeding_change "
          "where session = ?"}) {
      database.prepare(statement).bind(twin).bind(session).run();
    }
  }
}

std::vector<std::string> breeding_file_lists(Database& database, std::int64_t project) {
  std::vector<std::string> lists;
  Statement ask = database.prepare(
      "select distinct t.bytes from breeding_session s join breeding_generation g on g.session = s.id "
      "join breeding_text t on t.session = s.id and t.hash = g.files where s.project = ?");
  ask.bind(project);
  while (ask.step()) lists.push_back(ask.text(0));
  return lists;
}

}  // namespace espalier::studio
