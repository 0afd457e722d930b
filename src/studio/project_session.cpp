#include "studio/project_session.h"

#include <chrono>

#include "base/error.h"
#include "studio/quietly.h"
#include "studio/scene_json.h"

namespace espalier::studio {
namespace {

constexpr std::size_t kMostRecent = 12;   // models that requests may name
constexpr auto kSaveEvery = std::chrono::milliseconds(700);

template <class Message>
std::string answer_text(Message message, std::optional<std::int64_t> number) {
  message.request = number;
  return to_text(message);
}

std::string failed(const std::string& text, std::optional<std::int64_t> number) {
  return to_text(api::Failed{number, text});
}

bool scene_has_targets(const std::string& scene) {
  try {
    return read_scene(scene, {}).has_targets;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

ProjectSession::ProjectSession(Store& store, std::int64_t project)
    : store_(store), project_(project) {
  now_ = store_.open(project);
  favourites_ = store_.favourites(project);
  state_ = now_.state;
  const std::string shown = store_.shown(project);
  LiveListener& self = *this;
  live_ = std::make_unique<LiveSearch>([&store, project](const std::string& hash) { return store.blob(project, hash); },
                                       self, shown);
  // Where nothing was ever shown, the scene that it was made with is searched at once.
  live_->take(state_, now_.revision, LiveStart::keep);
  if (shown.empty() && scene_has_targets(state_.scene)) live_->start(LiveStart::nothing, 0);
  thread_ = std::thread([this] { run(); });
}

ProjectSession::~ProjectSession() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  changed_.notify_all();
  thread_.join();
  live_.reset();
  room_.reset();
  try {
    save_shown();
  } catch (const std::exception&) {  // the last second is lost
  }
}

void ProjectSession::join(const WebSocketPtr& socket, std::optional<std::int64_t> request) {
  const bool taken = enqueue([this, socket, request] {
    send_document(&socket);
    if (check_.done()) send_checked(&socket);
    {
      const std::lock_guard lock(mutex_);
      sockets_.push_back(socket);
      if (search_state_) socket->out.push_text(*search_state_);
      if (packet_.model) socket->out.push_model(packet_);
    }
    send_breedings(socket);
    socket->out.push_text(answer_text(api::Done{}, request));
  });
  if (!taken) socket->out.push_text(failed("the project is busy", request));
}

void ProjectSession::renamed() {
  enqueue([this] {
    take_now(store_.open(project_));
    send_document();
  });
}

void ProjectSession::leave(const WebSocketPtr& socket) {
  const std::lock_guard lock(mutex_);
  std::erase(sockets_, socket);
  // It may not have come in yet: its joining waits, or is being done.
  tasks_.push_back([this, socket] {
    const std::lock_guard alone(mutex_);
    std::erase(sockets_, socket);
  });
  changed_.notify_all();
  if (room_) room_->leave(socket);
  if (sockets_.empty() && live_ && !end_) live_->stop();
}

bool ProjectSession::watched() const {
  const std::lock_guard lock(mutex_);
  return !sockets_.empty() || !tasks_.empty();
}

void ProjectSession::post(const WebSocketPtr& socket, api::Request request, std::optional<std::int64_t> number) {
  const auto held = std::make_shared<const api::Request>(std::move(request));
  if (enqueue([this, socket, held, number] { answer(socket, *held, number); })) return;
  socket->out.push_text(failed("too many requests wait already", number));
}

bool ProjectSession::enqueue(Task task) {
  const std::lock_guard lock(mutex_);
  if (end_ || tasks_.size() >= kMostWaiting) return false;
  tasks_.push_back(std::move(task));
  changed_.notify_all();
  return true;
}

void ProjectSession::add_file(const StoredFile& file, const std::string& bytes) {
  const auto done = std::make_shared<std::promise<void>>();
  std::future<void> result = done->get_future();
  const bool taken = enqueue([this, file, bytes, done] {
    try {
      StoredState next = now_.state;
      std::erase_if(next.files, [&](const StoredFile& old) { return old.path == file.path; });
      next.files.push_back(file);
      sort_by_path(next.files);
      change(next, {.label = "Add " + file.path}, LiveStart::keep, {}, {{file.hash, bytes}});
      done->set_value();
    } catch (...) {
      done->set_exception(std::current_exception());
    }
  });
  if (!taken) throw Error("the project is busy");
  result.get();
}

StoredState ProjectSession::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

ShownModelPtr ProjectSession::shown() const {
  const std::lock_guard lock(mutex_);
  return recent_.empty() ? nullptr : recent_.back();
}

// The search's thread.

void ProjectSession::shown(const ShownModelPtr& model, const ModelPacket& packet) {
  const std::lock_guard lock(mutex_);
  recent_.push_back(model);
  if (recent_.size() > kMostRecent) recent_.pop_front();
  packet_ = packet;
  unsaved_ = true;
  for (const WebSocketPtr& socket : sockets_) socket->out.push_model(packet);
  changed_.notify_all();
}

void ProjectSession::searched(const api::SearchState& state) {
  std::string text = to_text(state);
  const std::lock_guard lock(mutex_);
  for (const WebSocketPtr& socket : sockets_) socket->out.push_text(text);
  search_state_ = std::move(text);
}

void ProjectSession::scene_problem(const std::string& text) {
  enqueue([this, text] {
    check_.set_setup_fault(text);
    if (check_.done()) send_checked();
  });
}

void ProjectSession::noted(api::LogLevel level, const std::string& text) {
  send(to_text(api::Log{{}, level, text}));
}

// The session's thread.

void ProjectSession::run() {
  auto saved = std::chrono::steady_clock::now();
  for (;;) {
    Task task;
    {
      std::unique_lock lock(mutex_);
      if (end_) return;
      if (!tasks_.empty()) {
        task = std::move(tasks_.front());
        tasks_.pop_front();
      }
    }
    try {
      if (task) {
        task();
        continue;
      }
      if (do_idle_work()) continue;
      const auto now = std::chrono::steady_clock::now();
      bool unsaved = false;
      {
        std::unique_lock lock(mutex_);
        const auto wakes = [&] { return end_ || !tasks_.empty() || (unsaved_ && now - saved >= kSaveEvery); };
        changed_.wait_for(lock, kSaveEvery, wakes);
        unsaved = unsaved_;
      }
      if (unsaved && std::chrono::steady_clock::now() - saved >= kSaveEvery) {
        saved = std::chrono::steady_clock::now();
        save_shown();
      }
    } catch (const std::exception& error) {
      quietly([&] { noted(api::LogLevel::error, error.what()); });
    }
  }
}

void ProjectSession::save_shown() {
  ShownModelPtr newest;
  {
    const std::lock_guard lock(mutex_);
    if (!unsaved_ || recent_.empty()) return;
    newest = recent_.back();
    unsaved_ = false;
  }
  store_.set_shown(project_, newest->encoded);
}

bool ProjectSession::do_idle_work() {
  if (check_.revision() == now_.revision) {
    return reach_.go_on(check_.graph(), [this] { return check_.readable_scene(now_.state); });
  }
  check_.check(now_.state, now_.revision, [this](const std::string& hash) { return store_.blob(project_, hash); });
  send_checked();
  reach_.restart();
  return true;
}

void ProjectSession::send_checked(const WebSocketPtr* only) { send(to_text(check_.message()), only); }

void ProjectSession::send_document(const WebSocketPtr* only) {
  api::Document document;
  document.project = {now_.project.id, now_.project.name, now_.project.changed};
  document.revision = now_.revision;
  document.grammar = now_.state.grammar;
  document.scene.text = now_.state.scene;
  for (const StoredFile& file : now_.state.files) {
    api::FileInfo info{file.path, static_cast<std::int64_t>(file.bytes), {}, {}};
    if (file.triangles > 0) {
      info.triangles = static_cast<std::int64_t>(file.triangles);
      info.size = {file.size[0], file.size[1], file.size[2]};
    }
    document.files.push_back(std::move(info));
  }
  for (const StoredFavourite& one : favourites_) document.favourites.push_back({one.id, one.score, one.genes, one.words, !one.picture.empty()});
  document.undo = now_.undo;
  document.redo = now_.redo;
  send(to_text(document), only);
}

void ProjectSession::send(const std::string& text, const WebSocketPtr* only) {
  if (only) return (*only)->out.push_text(text);
  const std::lock_guard lock(mutex_);
  for (const WebSocketPtr& socket : sockets_) socket->out.push_text(text);
}

void ProjectSession::take_now(StoredProjectState now) {
  now_ = std::move(now);
  const std::lock_guard lock(mutex_);
  state_ = now_.state;
  if (room_) room_->take(state_);
}

}  // namespace espalier::studio
