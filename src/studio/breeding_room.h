#pragma once
// BreedingRoom: a thread of a project's own on which people breed. One session is open in it, for all pages that are in
// the room; models are made one after the other while nobody asks for anything, and sent as soon as each is ready.

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <studio_types.h>

#include "studio/breeding_session.h"
#include "studio/patient_executor.h"
#include "studio/web_server.h"

namespace espalier::studio {

/// Whether a request is of the breeding room.
bool is_breeding(const api::Request& request);

/// The project, as the room sees it. Called on the room's thread.
class RoomListener {
 public:
  virtual ~RoomListener() = default;
  /// To all pages of the project.
  virtual void tell_project(const std::string& text) = 0;
  /// An individual shall be a favourite, or be shown; the project answers.
  virtual void keep_bred(const WebSocketPtr& socket, const StoredFavourite& favourite,
                         std::optional<std::int64_t> number) = 0;
  virtual void show_bred(const WebSocketPtr& socket, const std::string& derivation,
                         std::optional<std::int64_t> number) = 0;
};

struct RoomRequest {
  WebSocketPtr socket;
  api::Request request;
  std::optional<std::int64_t> number;
  std::vector<std::string> founders = {};  // derivations as JSON, where a session begins with some
  bool leaves = false;                     // nothing is asked: the page is in another project, or gone
};

class BreedingRoom {
 public:
  static constexpr std::size_t kMostWaiting = 1000;  // requests
  /// Numbers of its mesh tables have this bit.
  static constexpr std::uint32_t kTables = 0x80000000u;

  /// All must outlive it.
  BreedingRoom(Store& store, std::int64_t project, RoomListener& listener, StoredState state);
  ~BreedingRoom();

  /// The project has come to this state.
  void take(const StoredState& state);
  /// Is done when its turn comes; the answers go to the socket.
  void post(RoomRequest request);
  void leave(const WebSocketPtr& socket);
  /// The session that is open.
  std::optional<std::int64_t> open() const;

 private:
  void run();
  bool skips_ahead(RoomRequest& request);
  void answer(RoomRequest& request);
  void adopt(const StoredState& state);
  void fail(const char* why) noexcept;
  void see_off(const WebSocketPtr& socket);

  // Requests, on the room's thread; what throws Error has changed nothing. False: somebody else answers.
  bool act(const RoomRequest& from, const api::StartBreeding& start);
  bool act(const RoomRequest& from, const api::OpenBreeding& open);
  bool act(const RoomRequest& from, const api::LeaveBreeding&);
  bool act(const RoomRequest& from, const api::RenameBreeding& rename);
  bool act(const RoomRequest& from, const api::DeleteBreeding& remove);
  bool act(const RoomRequest& from, const api::Blend& blend);
  bool act(const RoomRequest& from, const api::KeepIndividual& keep);
  bool act(const RoomRequest& from, const api::ShowIndividual& show);
  bool act(const RoomRequest& from, const api::AskIndividual& ask);
  bool act(const RoomRequest& from, const api::AskModel& ask);
  bool act(const RoomRequest& from, const api::AskLineage&);
  template <class Change>
  bool act(const RoomRequest& from, const Change& change);

  BreedingSession& session();
  void open_session(const WebSocketPtr& socket, std::int64_t number);
  void close_session();
  void enter(const WebSocketPtr& socket);
  void make_busy(const std::string& busy);
  std::string text(const std::string& busy = "") const;
  void tell_pages(const std::string& text);
  void tell_list();

  // Models.
  BredModelPtr model_of(const RoomIndividual& one);
  void update_makers();
  bool models_missing() const;
  void make_models();
  void send_models();
  ModelPacket packet(const RoomIndividual& one) const;

  Store& project_store_;
  BreedingStore store_;
  const std::int64_t project_;
  RoomListener& listener_;

  std::atomic<std::int64_t> give_up_at_{0};  // see PatientExecutor

  // Of the room's thread alone.
  PatientExecutor executor_;
  BreedingBench bench_;
  std::optional<StoredState> newest_;                    // that nobody needed yet
  std::unique_ptr<BreedingSession> session_;
  std::string problem_;                                  // with the project's state
  std::vector<std::unique_ptr<BredModelMaker>> makers_;  // per worker
  std::shared_ptr<const Setup> makers_setup_;            // what they are made for ...
  api::RoomSettings makers_settings_;
  Bytes meshes_;
  std::uint32_t table_ = kTables;
  std::map<std::int64_t, std::uint32_t> sent_;  // version by individual

  /// Guards all that follows.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<RoomRequest> requests_;
  std::optional<StoredState> state_;  // that is new
  std::vector<WebSocketPtr> pages_;
  std::optional<std::int64_t> open_;
  bool end_ = false;

  std::thread thread_;
};

}  // namespace espalier::studio
