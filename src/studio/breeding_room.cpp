#include "studio/breeding_room.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "studio/breeding_text.h"
#include "studio/model_message.h"
#include "studio/quietly.h"

namespace espalier::studio {

BreedingRoom::BreedingRoom(Store& store, std::int64_t project, RoomListener& listener, StoredState state)
    : project_store_(store), store_(store), project_(project), listener_(listener),
      executor_(give_up_at_, Cores::all),
      bench_([&store, project](const std::string& hash) { return store.blob(project, hash); }, executor_),
      state_(std::move(state)), thread_([this] { run(); }) {}

BreedingRoom::~BreedingRoom() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
    give_up_at_ = ticks(std::chrono::steady_clock::now());
  }
  changed_.notify_all();
  thread_.join();
}

void BreedingRoom::take(const StoredState& state) {
  const std::lock_guard lock(mutex_);
  state_ = state;
  changed_.notify_all();
}

void BreedingRoom::post(RoomRequest request) {
  {
    const std::lock_guard lock(mutex_);
    if (requests_.size() < kMostWaiting) {
      requests_.push_back(std::move(request));
      changed_.notify_all();
      return;
    }
  }
  request.socket->out.push_text(to_text(api::Failed{request.number, "too many requests wait already"}));
}

void BreedingRoom::leave(const WebSocketPtr& socket) {
  const std::lock_guard lock(mutex_);
  std::erase(pages_, socket);
  // It may have asked to come in, and that may not have been answered yet.
  requests_.push_back({.socket = socket, .request = {}, .number = {}, .leaves = true});
  changed_.notify_all();
}

std::optional<std::int64_t> BreedingRoom::open() const {
  const std::lock_guard lock(mutex_);
  return open_;
}

// The room's thread.

void BreedingRoom::run() {
  for (;;) {
    std::optional<StoredState> state;
    std::optional<RoomRequest> request;
    {
      std::unique_lock lock(mutex_);
      const bool idle = !models_missing() && !(session_ && session_->wants_to_reflect());
      if (idle) changed_.wait(lock, [&] { return end_ || state_ || !requests_.empty(); });
      if (end_) return;
      std::swap(state, state_);
      if (!requests_.empty()) {
        request = std::move(requests_.front());
        requests_.pop_front();
      }
    }
    if (state) newest_ = std::move(state);
    try {
      // Nobody breeds: what the grammar has become is found out when somebody does.
      if (newest_ && (session_ || (request && !request->leaves))) adopt(*std::exchange(newest_, {}));
    } catch (const std::exception& error) {
      fail(error.what());
    }
    try {
      if (request && request->leaves) see_off(request->socket);
      else if (request) answer(*request);
      else if (models_missing()) make_models();
      else if (session_ && session_->reflect()) tell_pages(text());
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }
}

/// The last page to leave closes the session.
void BreedingRoom::see_off(const WebSocketPtr& socket) {
  bool empty = false;
  {
    const std::lock_guard lock(mutex_);
    std::erase(pages_, socket);
    empty = pages_.empty();
  }
  if (empty) close_session();
}

/// What cannot be made is not tried for ever.
void BreedingRoom::fail(const char* why) noexcept {
  quietly([&] { tell_pages(to_text(api::Log{{}, api::LogLevel::error, why})); });
  quietly([&] { close_session(); });
  session_.reset();
}

void BreedingRoom::adopt(const StoredState& state) {
  problem_.clear();
  try {
    bench_.take(state);
  } catch (const GrammarFault&) {
    problem_ = "the grammar has errors: until they are mended the room works with the text before them";
  } catch (const Error& error) {
    problem_ = bench_.as_named(error.what());
  }
  if (!session_) return;
  if (problem_.empty()) session_->refresh();
  tell_pages(text());
  send_models();
}

std::string BreedingRoom::text(const std::string& busy) const {
  std::string problem = problem_;
  const std::vector<RoomIndividual>& all = session_->individuals();
  if (std::none_of(all.begin(), all.end(), [](const RoomIndividual& one) { return one.derivation.has_value(); })) {
    problem = "this generation belongs to another text of the grammar, and none of it has a place in the present one";
  }
  return to_text(breeding_text(*session_, problem, busy));
}

void BreedingRoom::tell_pages(const std::string& text) {
  const std::lock_guard lock(mutex_);
  for (const WebSocketPtr& page : pages_) page->out.push_text(text);
}

void BreedingRoom::tell_list() { listener_.tell_project(to_text(breedings_text(store_.list(project_), open()))); }

BreedingSession& BreedingRoom::session() {
  if (!session_) throw Error("no breeding session is open");
  return *session_;
}

void BreedingRoom::make_busy(const std::string& busy) {
  if (session_) tell_pages(text(busy));
}

void BreedingRoom::close_session() {
  session_.reset();
  sent_.clear();
  makers_.clear();
  makers_setup_.reset();
  bool told = false;
  {
    const std::lock_guard lock(mutex_);
    told = open_.has_value();
    open_.reset();
  }
  if (told) tell_list();
}

/// The session is the one that is open. Where the project's state is none to breed in, that of its generation serves.
void BreedingRoom::open_session(const WebSocketPtr& socket, std::int64_t number) {
  const BreedingHead head = store_.open(project_, number);
  if (!bench_.ready()) bench_.take(store_.generation(number, head.generation).state);
  auto opened = std::make_unique<BreedingSession>(store_, bench_, project_, number);
  session_ = std::move(opened);
  sent_.clear();
  {
    const std::lock_guard lock(mutex_);
    open_ = number;
  }
  enter(socket);
  tell_pages(text());
  send_models();
  tell_list();
}

void BreedingRoom::enter(const WebSocketPtr& socket) {
  if (socket->out.closed()) return;
  const std::lock_guard lock(mutex_);
  if (std::find(pages_.begin(), pages_.end(), socket) == pages_.end()) pages_.push_back(socket);
}

// Models.

void BreedingRoom::update_makers() {
  const bool same_state = makers_setup_ == bench_.setup();
  const auto limits = [](const api::RoomSettings& s) {
    return std::tuple(s.max_triangles, s.max_height, s.max_spread);
  };
  const bool same_limits = limits(makers_settings_) == limits(session_->settings());
  if (same_state && same_limits && !makers_.empty()) return;
  makers_.clear();
  if (!same_state || !meshes_) {
    std::string message = mesh_message(table_ + 1, bench_.setup()->meshes);
    const bool same = meshes_ && std::string_view(*meshes_).substr(12) == std::string_view(message).substr(12);
    if (!same) meshes_ = std::make_shared<const std::string>(std::move(message)), ++table_;
  }
  makers_setup_ = bench_.setup();
  makers_settings_ = session_->settings();
  const ViabilitySettings viability = bench_.viability(makers_settings_);
  for (int i = 0; i < executor_.workers(); ++i) {
    makers_.push_back(std::make_unique<BredModelMaker>(makers_setup_, bench_.has_targets(), viability));
  }
}

bool BreedingRoom::models_missing() const {
  if (!session_) return false;
  const std::vector<RoomIndividual>& all = session_->individuals();
  return std::any_of(all.begin(), all.end(), [](const RoomIndividual& one) { return one.derivation && !one.model; });
}

ModelPacket BreedingRoom::packet(const RoomIndividual& one) const {
  return bred_packet(*one.model, meshes_, table_, session_ ? session_->number() : 0, one.row.id, one.version);
}

/// As many as there are workers; then it is looked whether somebody asks for something.
void BreedingRoom::make_models() {
  update_makers();
  std::vector<const RoomIndividual*> missing;
  for (const RoomIndividual& one : session_->individuals()) {
    const auto is_twin = [&](const RoomIndividual* other) { return other->row.derivation == one.row.derivation; };
    if (!one.derivation || one.model || std::any_of(missing.begin(), missing.end(), is_twin)) continue;
    missing.push_back(&one);
    if (missing.size() == makers_.size()) break;
  }
  std::vector<std::pair<std::string, BredModelPtr>> made(missing.size());
  executor_.for_each(missing.size(), [&](std::size_t i, int worker) {
    made[i] = {missing[i]->row.derivation, makers_[static_cast<std::size_t>(worker)]->make(*missing[i]->derivation)};
  });
  for (const auto& [derivation, model] : made) session_->keep_model(derivation, model);
  send_models();
}

BredModelPtr BreedingRoom::model_of(const RoomIndividual& one) {
  if (one.model) return one.model;
  if (!one.derivation) throw Error(one.missing);
  update_makers();
  return makers_[0]->make(*one.derivation);
}

/// To all pages, what is new.
void BreedingRoom::send_models() {
  for (const RoomIndividual& one : session_->individuals()) {
    if (!one.model || sent_[one.row.id] == one.version) continue;
    update_makers();  // and the table of meshes
    sent_[one.row.id] = one.version;
    const ModelPacket sent = packet(one);
    const std::lock_guard lock(mutex_);
    for (const WebSocketPtr& page : pages_) page->out.push_individual(one.row.id, sent);
  }
}

}  // namespace espalier::studio
