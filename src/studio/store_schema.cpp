// How the file of projects is laid out, and how older layouts become this one.
#include <fmt/format.h>

#include "base/error.h"
#include "studio/breeding_tables.h"
#include "studio/store.h"

namespace espalier::studio {
namespace {

constexpr const char* kVersion1 = R"(
create table project (
  id integer primary key autoincrement, name text not null, changed real not null, head integer not null,
  revision integer not null, shown text not null default '');
create table text (
  project integer not null references project on delete cascade, hash text not null, bytes blob not null,
  primary key (project, hash));
create table blob (
  project integer not null references project on delete cascade, hash text not null, bytes blob not null,
  primary key (project, hash));
create table step (
  project integer not null references project on delete cascade, number integer not null, label text not null,
  gesture text not null, search integer not null, grammar text not null, scene text not null, files text not null,
  model_before text, model_after text, primary key (project, number)) without rowid;
create table favourite (
  id integer primary key autoincrement, project integer not null references project on delete cascade,
  score real not null, genes integer not null, words text not null, derivation blob not null);
create index favourite_project on favourite (project);
pragma user_version = 1;
)";

constexpr const char* kVersion2 = R"(
create table setting (name text primary key, value text not null) without rowid;
pragma user_version = 2;
)";

constexpr const char* kVersion3 = R"(
alter table favourite add column picture blob not null default x'';
pragma user_version = 3;
)";

}  // namespace

void Store::migrate() {
  std::int64_t version = 0;
  {
    Statement ask = database_->prepare("pragma user_version");
    if (ask.step()) version = ask.whole(0);
  }
  if (version > kVersion) {
    throw Error(fmt::format("the projects' file is of version {}, and this program knows up to {}", version, kVersion));
  }
  if (version == kVersion) return;
  Transaction transaction(*database_);
  if (version < 1) database_->run(kVersion1);
  if (version < 2) database_->run(kVersion2);
  if (version < 3) database_->run(kVersion3);
  database_->run(kBreedingTables);
  transaction.commit();
}

}  // namespace espalier::studio
