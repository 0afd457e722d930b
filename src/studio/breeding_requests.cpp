// What pages ask of the breeding room, request by request.
#include <algorithm>
#include <type_traits>

#include <fmt/format.h>

#include "base/base64.h"
#include "base/error.h"
#include "derivation/encode.h"
#include "studio/breeding_room.h"
#include "studio/breeding_text.h"
#include "studio/individual_genes.h"

namespace espalier::studio {
namespace {

template <class Kind, class... Kinds>
constexpr bool is_one_of = (std::is_same_v<Kind, Kinds> || ...);

template <class Message>
std::string answer_text(Message message, std::optional<std::int64_t> number) {
  message.request = number;
  return to_text(message);
}

// How a session is told of each change.
void change(BreedingSession& session, const api::SetBreeding& asked) { session.set(asked); }
void change(BreedingSession& session, const api::Rate& asked) { session.rate(asked); }
void change(BreedingSession& session, const api::Compare& asked) { session.compare(asked); }
void change(BreedingSession& session, const api::Breed&) { session.breed(); }
void change(BreedingSession& session, const api::MoreLikeThis& asked) { session.more_like(asked.individual); }
void change(BreedingSession& session, const api::SetGenes& asked) { session.set_genes(asked); }
void change(BreedingSession& session, const api::LockDraws& asked) { session.lock(asked); }
void change(BreedingSession& session, const api::GoToGeneration& asked) { session.go_to(asked.generation); }
void change(BreedingSession& session, const api::UndoBreeding&) { session.undo(); }
void change(BreedingSession& session, const api::RedoBreeding&) { session.redo(); }

template <class Asked>
constexpr bool is_change = requires(BreedingSession& session, const Asked& asked) { change(session, asked); };

template <class Asked>
constexpr bool is_of_room =
    is_change<Asked> || is_one_of<Asked, api::StartBreeding, api::OpenBreeding, api::LeaveBreeding, api::RenameBreeding,
                                  api::DeleteBreeding, api::Blend, api::KeepIndividual, api::ShowIndividual,
                                  api::AskIndividual, api::AskModel, api::AskLineage>;

}  // namespace

bool is_breeding(const api::Request& request) {
  return std::visit([](const auto& asked) { return is_of_room<std::decay_t<decltype(asked)>>; }, request);
}

/// Sliders and blends follow a hand: of requests of one gesture in a row that wait already, one does what all of them
/// ask.
bool BreedingRoom::skips_ahead(RoomRequest& request) {
  const std::lock_guard lock(mutex_);
  if (requests_.empty() || requests_.front().leaves || requests_.front().socket != request.socket) return false;
  api::Request& after = requests_.front().request;
  if (const auto* blend = std::get_if<api::Blend>(&request.request)) {
    const auto* next = std::get_if<api::Blend>(&after);
    return next && !blend->keep.value_or(false);
  }
  const auto* set = std::get_if<api::SetGenes>(&request.request);
  auto* next = std::get_if<api::SetGenes>(&after);
  if (!set || !next || set->individual != next->individual || set->gesture != next->gesture || !set->gesture)
    return false;
  if (set->draws.size() + next->draws.size() > BreedingSession::kMostDraws) return false;
  next->draws.insert(next->draws.begin(), set->draws.begin(), set->draws.end());
  return true;
}

void BreedingRoom::answer(RoomRequest& request) {
  const auto done = [&](std::optional<std::int64_t> number) {
    request.socket->out.push_text(to_text(api::Done{number}));
  };
  std::vector<std::optional<std::int64_t>> numbers = {request.number};
  while (skips_ahead(request)) {
    const std::lock_guard lock(mutex_);
    request = std::move(requests_.front());
    requests_.pop_front();
    numbers.push_back(request.number);
  }
  std::string failure;
  bool own = true;
  try {
    own = std::visit([&](const auto& asked) { return act(request, asked); }, request.request);
  } catch (const std::exception& error) {
    failure = error.what();
    if (session_) tell_pages(text());  // nothing is busy any more
  }
  if (!own) numbers.pop_back();
  for (const std::optional<std::int64_t> number : numbers) {
    if (failure.empty()) done(number);
    else request.socket->out.push_text(to_text(api::Failed{number, failure}));
  }
}

template <class Change>
bool BreedingRoom::act(const RoomRequest&, const Change& asked) {
  if constexpr (is_change<Change>) {
    constexpr bool breeds = is_one_of<Change, api::Breed, api::MoreLikeThis>;
    BreedingSession& open = session();
    if (breeds) make_busy("Breeding");
    change(open, asked);
    // The disk has it: pages are told what became of it.
    tell_pages(text());
    send_models();
    if (breeds) tell_list();
    return true;
  } else {
    throw Error("this is no request to the breeding room");
  }
}

bool BreedingRoom::act(const RoomRequest& from, const api::StartBreeding& start) {
  if (!bench_.ready()) throw Error(problem_);
  make_busy("A first generation");
  open_session(from.socket, BreedingSession::begin(store_, bench_, project_, start, from.founders));
  return true;
}

bool BreedingRoom::act(const RoomRequest& from, const api::OpenBreeding& asked) {
  if (!session_ || session_->number() != asked.session) {
    open_session(from.socket, asked.session);
    return true;
  }
  enter(from.socket);
  from.socket->out.push_text(text());
  for (const RoomIndividual& one : session_->individuals()) {
    if (one.model) from.socket->out.push_individual(one.row.id, packet(one));
  }
  return true;
}

bool BreedingRoom::act(const RoomRequest& from, const api::LeaveBreeding&) {
  leave(from.socket);
  return true;
}

bool BreedingRoom::act(const RoomRequest&, const api::RenameBreeding& rename) {
  store_.rename(project_, rename.session, rename.name);
  if (session_ && session_->number() == rename.session) {
    session_->reload();
    tell_pages(text());
  }
  tell_list();
  return true;
}

bool BreedingRoom::act(const RoomRequest&, const api::DeleteBreeding& remove) {
  store_.remove(project_, remove.session);
  if (session_ && session_->number() == remove.session) {
    {
      const std::lock_guard lock(mutex_);
      pages_.clear();
    }
    close_session();
  } else {
    tell_list();
  }
  return true;
}

bool BreedingRoom::act(const RoomRequest& from, const api::Blend& blend) {
  BreedingSession& open = session();
  if (blend.keep.value_or(false)) {
    open.keep_blend(blend);
    tell_pages(text());
    return true;
  }
  RoomIndividual preview;
  preview.derivation = open.blended(blend);
  preview.model = model_of(preview);
  from.socket->out.push_individual(0, packet(preview));
  return true;
}

bool BreedingRoom::act(const RoomRequest& from, const api::KeepIndividual& keep) {
  const RoomIndividual one = session().find(keep.individual);
  const BredModelPtr model = model_of(one);
  StoredFavourite favourite{0, model->facts.score.value_or(0), model->facts.genes, model->facts.words,
                            encode(bench_.graph(), *one.derivation), decode_base64(keep.picture.value_or(""))};
  listener_.keep_bred(from.socket, favourite, from.number);
  return false;
}

bool BreedingRoom::act(const RoomRequest& from, const api::ShowIndividual& show) {
  const RoomIndividual one = session().find(show.individual);
  if (!one.derivation) throw Error(one.missing);
  listener_.show_bred(from.socket, encode(bench_.graph(), *one.derivation), from.number);
  return false;
}

bool BreedingRoom::act(const RoomRequest& from, const api::AskIndividual& ask) {
  const RoomIndividual one = session().find(ask.individual);
  if (!one.derivation) throw Error(one.missing);
  api::IndividualGenes genes;
  genes.session = session_->number();
  genes.individual = one.row.id;
  for (const RoomIndividual& shown : session_->individuals()) {
    if (shown.row.id == one.row.id) genes.version = shown.version;
  }
  genes.genes = individual_genes(*bench_.setup(), *one.derivation, bench_.held(session_->locked()), genes.truncated);
  from.socket->out.push_text(answer_text(genes, from.number));
  return true;
}

bool BreedingRoom::act(const RoomRequest& from, const api::AskModel& ask) {
  RoomIndividual one = session().find(ask.individual);
  for (const RoomIndividual& shown : session_->individuals()) {
    if (shown.row.id == one.row.id) one.version = shown.version;
  }
  one.model = model_of(one);
  from.socket->out.push_individual(one.row.id, packet(one));
  return true;
}

bool BreedingRoom::act(const RoomRequest& from, const api::AskLineage&) {
  from.socket->out.push_text(answer_text(lineage_text(session()), from.number));
  return true;
}

}  // namespace espalier::studio
