#include "studio/store.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <set>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/hash.h"
#include "studio/breeding_tables.h"

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

double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

[[noreturn]] void fail_no_project(std::int64_t project) { throw Error(fmt::format("there is no project {}", project)); }

/// The file of projects holds the key to the server. SQLite gives the files beside it the same mode.
void keep_private(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) throw Error(fmt::format("{}: cannot be written", path));
  const bool done = fchmod(file, 0600) == 0;
  close(file);
  if (!done) throw Error(fmt::format("{}: cannot be kept from other people's eyes: {}", path, std::strerror(errno)));
  for (const char* beside : {"-wal", "-shm"}) chmod((path + beside).c_str(), 0600);  // left by a server that was killed
}

void check_name(const std::string& name) {
  if (name.find_first_not_of(' ') == std::string::npos) throw Error("a project must have a name");
}

}  // namespace

std::string to_json(const std::vector<StoredFile>& files) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const StoredFile& file : files) {
    list.push_back({{"path", file.path}, {"hash", file.hash}, {"bytes", file.bytes}, {"triangles", file.triangles},
                    {"size", file.size}});
  }
  return list.dump();
}

std::vector<StoredFile> parse_files(std::string_view json) {
  std::vector<StoredFile> files;
  try {
    for (const nlohmann::json& item : nlohmann::json::parse(json)) {
      files.push_back({item.at("path"), item.at("hash"), item.at("bytes"), item.at("triangles"), item.at("size")});
    }
  } catch (const nlohmann::json::exception& error) {
    throw Error(fmt::format("the list of a project's files is damaged: {}", error.what()));
  }
  return files;
}

Store::Store(const std::string& path) {
  const std::string lock = path + ".lock";
  lock_file_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (lock_file_ < 0) throw Error(fmt::format("{}: cannot be written", lock));
  if (flock(lock_file_, LOCK_EX | LOCK_NB) != 0) {
    close(lock_file_);
    throw Error(fmt::format("{}: another studio has these projects open; use its link, or other --data", path));
  }
  try {
    keep_private(path);
    database_.emplace(path);
    migrate();
  } catch (...) {
    close(lock_file_);
    throw;
  }
}

Store::~Store() {
  database_.reset();
  close(lock_file_);
}

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
  database_->run(kBreedingTables);
  transaction.commit();
}

std::vector<StoredProject> Store::projects() {
  const std::lock_guard lock(mutex_);
  std::vector<StoredProject> all;
  Statement ask = database_->prepare("select id, name, changed from project order by changed desc, id desc");
  while (ask.step()) all.push_back({ask.whole(0), ask.text(1), ask.number(2)});
  return all;
}

/// "Tree", or "Tree 2" where there is one.
std::string Store::free_name(const std::string& name) {
  std::set<std::string> taken;
  Statement ask = database_->prepare("select name from project");
  while (ask.step()) taken.insert(ask.text(0));
  std::string free = name;
  for (int n = 2; taken.count(free) != 0; ++n) free = fmt::format("{} {}", name, n);
  if (taken.size() >= kMostProjects) throw Error(fmt::format("there are {} projects already", taken.size()));
  return free;
}

std::int64_t Store::create(const std::string& name, const StoredState& state,
                           const std::map<std::string, std::string>& blobs) {
  check_name(name);
  const std::lock_guard lock(mutex_);
  Transaction transaction(*database_);
  database_->prepare("insert into project (name, changed, head, revision) values (?, ?, 0, 1)")
      .bind(free_name(name)).bind(now()).run();
  const std::int64_t project = database_->last_row();
  const std::string grammar = keep_text(project, state.grammar), scene = keep_text(project, state.scene);
  const std::string files = keep_files(project, state.files, blobs);
  database_->prepare("insert into step values (?, 0, '', '', 0, ?, ?, ?, null, null)")
      .bind(project).bind(grammar).bind(scene).bind(files).run();
  transaction.commit();
  return project;
}

void Store::rename(std::int64_t project, const std::string& name) {
  check_name(name);
  const std::lock_guard lock(mutex_);
  Transaction transaction(*database_);
  const StoredProjectState old = read(project);
  if (old.project.name == name) return;
  database_->prepare("update project set name = ?, changed = ? where id = ?")
      .bind(free_name(name)).bind(now()).bind(project).run();
  transaction.commit();
}

std::int64_t Store::duplicate(std::int64_t project) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(*database_);
  const StoredProjectState old = read(project);
  database_->prepare("insert into project (name, changed, head, revision, shown) "
                     "select ?, ?, head, 1, shown from project where id = ?")
      .bind(free_name(old.project.name + " copy")).bind(now()).bind(project).run();
  const std::int64_t copy = database_->last_row();
  for (const char* statement :
       {"insert into text select ?, hash, bytes from text where project = ?",
        "insert into blob select ?, hash, bytes from blob where project = ?",
        "insert into step select ?, number, label, gesture, search, grammar, scene, files, model_before, model_after "
        "from step where project = ?",
        "insert into favourite (project, score, genes, words, derivation) select ?, score, genes, words, derivation "
        "from favourite where project = ? order by id"}) {
    database_->prepare(statement).bind(copy).bind(project).run();
  }
  copy_breedings(*database_, project, copy);
  transaction.commit();
  return copy;
}

void Store::remove(std::int64_t project) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(*database_);
  head(project);
  database_->prepare("delete from project where id = ?").bind(project).run();
  transaction.commit();
}

StoredProjectState Store::open(std::int64_t project) {
  const std::lock_guard lock(mutex_);
  return read(project);
}

Store::Head Store::head(std::int64_t project) {
  Statement ask = database_->prepare("select number, grammar, scene, files, gesture from step "
                                     "join project on id = project and number = head where id = ?");
  if (!ask.bind(project).step()) fail_no_project(project);
  return {ask.whole(0), ask.text(1), ask.text(2), ask.text(3), ask.text(4)};
}

std::string Store::text(std::int64_t project, const std::string& hash) {
  Statement ask = database_->prepare("select bytes from text where project = ? and hash = ?");
  if (!ask.bind(project).bind(hash).step()) throw Error(fmt::format("project {} is damaged: a text is missing", project));
  return ask.text(0);
}

std::string Store::keep_text(std::int64_t project, const std::string& text) {
  const std::string hash = content_hash(text);
  database_->prepare("insert or ignore into text values (?, ?, ?)").bind(project).bind(hash).bind_blob(text).run();
  return hash;
}

std::string Store::keep_files(std::int64_t project, const std::vector<StoredFile>& files,
                              const std::map<std::string, std::string>& blobs) {
  if (files.size() > kMostFiles) throw Error(fmt::format("a project has at most {} files", kMostFiles));
  for (const auto& [hash, bytes] : blobs) {
    if (bytes.size() > kMostFileBytes) throw Error(fmt::format("a file has at most {} bytes", kMostFileBytes));
    database_->prepare("insert or ignore into blob values (?, ?, ?)").bind(project).bind(hash).bind_blob(bytes).run();
  }
  for (const StoredFile& file : files) {
    Statement ask = database_->prepare("select 1 from blob where project = ? and hash = ?");
    if (!ask.bind(project).bind(file.hash).step()) throw Error(fmt::format("{}: its bytes are missing", file.path));
  }
  if (!blobs.empty()) {
    Statement ask = database_->prepare("select sum(length(bytes)) from blob where project = ?");
    if (ask.bind(project).step() && static_cast<std::uint64_t>(ask.whole(0)) > kMostProjectBytes) {
      throw Error(fmt::format("the files of a project, those that undo brings back among them, have at most {} bytes",
                              kMostProjectBytes));
    }
  }
  return keep_text(project, to_json(files));
}

void Store::touch(std::int64_t project, std::int64_t number) {
  database_->prepare("update project set head = ?, changed = ?, revision = revision + 1 where id = ?")
      .bind(number).bind(now()).bind(project).run();
}

StoredProjectState Store::read(std::int64_t project) {
  const Head at = head(project);
  StoredProjectState result;
  Statement ask = database_->prepare("select name, changed, revision from project where id = ?");
  ask.bind(project).step();
  result.project = {project, ask.text(0), ask.number(1)};
  result.revision = ask.whole(2);
  result.state = {text(project, at.grammar), text(project, at.scene), parse_files(text(project, at.files))};
  Statement steps = database_->prepare("select number, label from step where project = ? and number between ? and ?");
  steps.bind(project).bind(at.number - 1).bind(at.number + 1);
  std::optional<std::string> own;
  while (steps.step()) {
    if (steps.whole(0) == at.number) own = steps.text(1);
    if (steps.whole(0) == at.number - 1) result.undo = "";
    if (steps.whole(0) == at.number + 1) result.redo = steps.text(1);
  }
  if (result.undo) result.undo = own;
  return result;
}

std::string Store::blob(std::int64_t project, const std::string& hash) {
  const std::lock_guard lock(mutex_);
  Statement ask = database_->prepare("select bytes from blob where project = ? and hash = ?");
  if (!ask.bind(project).bind(hash).step()) throw Error("there is no such file");
  return ask.text(0);
}

std::string Store::shown(std::int64_t project) {
  const std::lock_guard lock(mutex_);
  Statement ask = database_->prepare("select shown from project where id = ?");
  if (!ask.bind(project).step()) fail_no_project(project);
  return ask.text(0);
}

void Store::set_shown(std::int64_t project, const std::string& derivation) {
  const std::lock_guard lock(mutex_);
  database_->prepare("update project set shown = ? where id = ?").bind(derivation).bind(project).run();
}

std::vector<StoredFavourite> Store::favourites(std::int64_t project) {
  const std::lock_guard lock(mutex_);
  std::vector<StoredFavourite> all;
  Statement ask = database_->prepare("select id, score, genes, words, derivation from favourite where project = ? order by id");
  ask.bind(project);
  while (ask.step()) all.push_back({ask.whole(0), ask.number(1), ask.whole(2), ask.text(3), ask.text(4)});
  return all;
}

std::int64_t Store::add_favourite(std::int64_t project, const StoredFavourite& favourite) {
  if (favourites(project).size() >= kMostFavourites) {
    throw Error(fmt::format("a project has at most {} favourites", kMostFavourites));
  }
  const std::lock_guard lock(mutex_);
  Transaction transaction(*database_);
  head(project);
  database_->prepare("insert into favourite (project, score, genes, words, derivation) values (?, ?, ?, ?, ?)")
      .bind(project).bind(favourite.score).bind(favourite.genes).bind(favourite.words).bind_blob(favourite.derivation).run();
  const std::int64_t id = database_->last_row();
  transaction.commit();
  return id;
}

void Store::remove_favourite(std::int64_t project, std::int64_t favourite) {
  const std::lock_guard lock(mutex_);
  database_->prepare("delete from favourite where project = ? and id = ?").bind(project).bind(favourite).run();
}

void Store::alone(const std::function<void(Database&)>& work) {
  const std::lock_guard lock(mutex_);
  work(*database_);
}

std::optional<std::string> Store::setting(const std::string& name) {
  const std::lock_guard lock(mutex_);
  Statement ask = database_->prepare("select value from setting where name = ?");
  if (!ask.bind(name).step()) return std::nullopt;
  return ask.text(0);
}

void Store::set_setting(const std::string& name, const std::string& value) {
  const std::lock_guard lock(mutex_);
  database_->prepare("insert or replace into setting (name, value) values (?, ?)").bind(name).bind(value).run();
}

}  // namespace espalier::studio
