// What an open project and its breeding room have to do with each other.
#include "base/error.h"
#include "breed/settings.h"
#include "studio/breeding_text.h"
#include "studio/project_session.h"

namespace espalier::studio {

void ProjectSession::send_to_room(const WebSocketPtr& socket, const api::Request& request,
                                  std::optional<std::int64_t> number) {
  RoomRequest asked{socket, request, number, {}};
  if (const auto* start = std::get_if<api::StartBreeding>(&request)) {
    if (start->from == api::StartBreedingFrom::shown) {
      const ShownModelPtr model = shown();
      if (!model) throw Error("no model is shown");
      asked.founders.push_back(model->encoded);
    } else if (start->from == api::StartBreedingFrom::favourites) {
      if (favourites_.empty()) throw Error("the project has no favourites");
      // The newest first, and no more than a screen holds.
      for (auto it = favourites_.rbegin(); it != favourites_.rend(); ++it) {
        if (asked.founders.size() < BreedSettings::kMostPopulation) asked.founders.push_back(it->derivation);
      }
    }
  }
  if (!room_) {  // nobody else makes one
    RoomListener& self = *this;
    auto room = std::make_unique<BreedingRoom>(store_, project_, self, now_.state);
    const std::lock_guard lock(mutex_);
    room_ = std::move(room);
  }
  room_->post(std::move(asked));
}

void ProjectSession::send_breedings(const WebSocketPtr& socket) {
  std::optional<std::int64_t> open;
  {
    const std::lock_guard lock(mutex_);
    if (room_) open = room_->open();
  }
  socket->out.push_text(to_text(breedings_text(BreedingStore(store_).list(project_), open)));
}

void ProjectSession::breedings_changed() {
  enqueue([this] {
    std::vector<WebSocketPtr> sockets;
    {
      const std::lock_guard lock(mutex_);
      sockets = sockets_;
    }
    for (const WebSocketPtr& socket : sockets) send_breedings(socket);
  });
}

// The room's thread.

void ProjectSession::tell_project(const std::string& text) { send(text); }

/// Does it when its turn comes, and answers.
void ProjectSession::answer_task(const WebSocketPtr& socket, std::optional<std::int64_t> number, Task task) {
  const bool taken = enqueue([socket, number, task = std::move(task)] {
    try {
      task();
      socket->out.push_text(to_text(api::Done{number}));
    } catch (const std::exception& error) {
      socket->out.push_text(to_text(api::Failed{number, error.what()}));
    }
  });
  if (!taken) socket->out.push_text(to_text(api::Failed{number, "the project is busy"}));
}

void ProjectSession::keep_bred(const WebSocketPtr& socket, const StoredFavourite& favourite,
                               std::optional<std::int64_t> number) {
  answer_task(socket, number, [this, favourite] { keep(favourite); });
}

void ProjectSession::show_bred(const WebSocketPtr& socket, const std::string& derivation,
                               std::optional<std::int64_t> number) {
  answer_task(socket, number, [this, derivation] { show_by_hand("Show an individual", "", derivation); });
}

}  // namespace espalier::studio
