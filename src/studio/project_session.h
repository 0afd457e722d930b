#pragma once
// ProjectSession: an open project: its document, who looks at it, and the search that runs on it. Requests of all its
// pages are done one after another on a thread of its own, and so is the checking; the search has another, and where people
// breed, the breeding room.

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <studio_types.h>

#include "studio/breeding_room.h"
#include "studio/document_check.h"
#include "studio/live_search.h"
#include "studio/reach_queue.h"
#include "studio/store.h"
#include "studio/web_server.h"

namespace espalier::studio {

class ProjectSession final : private LiveListener, private RoomListener {
 public:
  static constexpr std::size_t kMostWaiting = 1000;  // requests

  /// The store must outlive it. Throws Error where there is no such project.
  ProjectSession(Store& store, std::int64_t project);
  ~ProjectSession() override;

  std::int64_t project() const { return project_; }
  /// From now on the socket is told of everything, beginning with how things are.
  void join(const WebSocketPtr& socket, std::optional<std::int64_t> request);
  void leave(const WebSocketPtr& socket);
  bool watched() const;
  /// The store has another name for it.
  void renamed();
  /// Is done when its turn comes; the answers go to the socket.
  void post(const WebSocketPtr& socket, api::Request request, std::optional<std::int64_t> number);

  /// Adds a file, or replaces the one of that path. Waits for its turn. Throws Error.
  void add_file(const StoredFile& file, const std::string& bytes);
  StoredState state() const;
  ShownModelPtr shown() const;
  /// Sessions of the breeding room have come from elsewhere.
  void breedings_changed();

 private:
  using Task = std::function<void()>;

  void shown(const ShownModelPtr& model, const ModelPacket& packet) override;
  void searched(const api::SearchState& state) override;
  void scene_problem(const std::string& text) override;
  void noted(api::LogLevel level, const std::string& text) override;

  void tell_project(const std::string& text) override;
  void keep_bred(const WebSocketPtr& socket, const StoredFavourite& favourite, std::optional<std::int64_t> number) override;
  void show_bred(const WebSocketPtr& socket, const std::string& derivation, std::optional<std::int64_t> number) override;
  void answer_task(const WebSocketPtr& socket, std::optional<std::int64_t> number, Task task);
  void send_to_room(const WebSocketPtr& socket, const api::Request& request, std::optional<std::int64_t> number);
  void send_breedings(const WebSocketPtr& socket);

  bool enqueue(Task task);
  void run();
  bool do_idle_work();
  void answer(const WebSocketPtr& socket, const api::Request& request, std::optional<std::int64_t> number);
  /// To all pages, or to that one.
  void send(const std::string& text, const WebSocketPtr* only = nullptr);
  void send_document(const WebSocketPtr* only = nullptr);
  void send_checked(const WebSocketPtr* only = nullptr);
  void save_shown();

  // Requests, on the session's thread; what throws Error has changed nothing.
  void change(const StoredState& next, const StoredStep& step, LiveStart start, std::optional<std::string> model = {},
              const std::map<std::string, std::string>& blobs = {}, std::optional<double> seconds = {});
  void moved(const std::optional<StoredMove>& move, const char* nothing);
  void take_now(StoredProjectState now);
  ShownModelPtr find_model(std::int64_t number) const;
  void keep(StoredFavourite favourite);
  void show_by_hand(const std::string& label, const std::string& gesture, const std::string& derivation);
  void act(const WebSocketPtr& socket, const api::Edit& edit);
  void act(const WebSocketPtr& socket, const api::Undo&);
  void act(const WebSocketPtr& socket, const api::Redo&);
  void act(const WebSocketPtr& socket, const api::RemoveFile& remove);
  void act(const WebSocketPtr& socket, const api::StartSearch& start);
  void act(const WebSocketPtr& socket, const api::StopSearch&);
  void act(const WebSocketPtr& socket, const api::AskGene& ask);
  void act(const WebSocketPtr& socket, const api::SetDraw& set);
  void act(const WebSocketPtr& socket, const api::SetLock& set);
  void act(const WebSocketPtr& socket, const api::AskReach& ask);
  void act(const WebSocketPtr& socket, const api::Format&);
  void act(const WebSocketPtr& socket, const api::KeepFavourite& keep);
  void act(const WebSocketPtr& socket, const api::DropFavourite& drop);
  void act(const WebSocketPtr& socket, const api::RestoreFavourite& restore);
  void act(const WebSocketPtr& socket, const api::ShowFavourite& show);
  template <class Other>
  void act(const WebSocketPtr&, const Other&);

  Store& store_;
  const std::int64_t project_;

  // Of the session's thread alone.
  StoredProjectState now_;
  std::vector<StoredFavourite> favourites_;
  std::deque<StoredFavourite> dropped_;  // of them, the last that were
  DocumentCheck check_;
  ReachQueue reach_;

  /// Guards all that follows.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Task> tasks_;
  bool end_ = false;
  std::vector<WebSocketPtr> sockets_;
  StoredState state_;                 // a copy for other threads
  std::deque<ShownModelPtr> recent_;  // the newest last
  ModelPacket packet_;                // of the newest
  std::optional<std::string> search_state_;
  bool unsaved_ = false;              // the newest is not in the store

  std::unique_ptr<BreedingRoom> room_;  // once somebody breeds

  std::unique_ptr<LiveSearch> live_;
  std::thread thread_;
};

}  // namespace espalier::studio
