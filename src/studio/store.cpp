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

#include "base/error.h"
#include "studio/breeding_tables.h"

namespace espalier::studio {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

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

void Store::fail_no_project(std::int64_t project) { throw Error(fmt::format("there is no project {}", project)); }

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
        "insert into favourite (project, score, genes, words, derivation, picture) "
        "select ?, score, genes, words, derivation, picture from favourite where project = ? order by id"}) {
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

void Store::touch(std::int64_t project, std::int64_t number) {
  database_->prepare("update project set head = ?, changed = ?, revision = revision + 1 where id = ?")
      .bind(number).bind(now()).bind(project).run();
}

void Store::alone(const std::function<void(Database&)>& work) {
  const std::lock_guard lock(mutex_);
  work(*database_);
}

}  // namespace espalier::studio
