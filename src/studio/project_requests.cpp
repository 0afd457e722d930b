// What pages ask of an open project, request by request.
#include <algorithm>

#include <fmt/format.h>

#include "base/base64.h"
#include "base/error.h"
#include "derivation/encode.h"
#include "grammar/formatter.h"
#include "studio/gene_text.h"
#include "studio/project_session.h"
#include "studio/scene_json.h"

namespace espalier::studio {
namespace {

constexpr std::size_t kMostDropped = 20;  // favourites that can be taken back

template <class Message>
std::string answer_text(Message message, std::optional<std::int64_t> number) {
  message.request = number;
  return to_text(message);
}

}  // namespace

template <class Other>
void ProjectSession::act(const WebSocketPtr&, const Other&) {
  throw Error("this is no request to a project");
}

void ProjectSession::answer(const WebSocketPtr& socket, const api::Request& request, std::optional<std::int64_t> number) {
  try {
    if (is_breeding(request)) return send_to_room(socket, request, number);
    std::visit([&](const auto& asked) { act(socket, asked); }, request);
    socket->out.push_text(answer_text(api::Done{}, number));
  } catch (const std::exception& error) {
    socket->out.push_text(to_text(api::Failed{number, error.what()}));
  }
}

void ProjectSession::change(const StoredState& next, const StoredStep& step, LiveStart start,
                            std::optional<std::string> model, const std::map<std::string, std::string>& blobs,
                            std::optional<double> seconds) {
  // The search begins while the disk is written (an edit adds one to the revision); files it can read only from there.
  const bool early = blobs.empty();
  if (early) live_->take(next, now_.revision + 1, start, model, seconds);
  try {
    take_now(store_.edit(project_, next, step, blobs));
  } catch (...) {
    if (early) live_->take(now_.state, now_.revision, LiveStart::keep, step.model_before);
    throw;
  }
  if (!early) live_->take(next, now_.revision, start, model);
  send_document();
}

void ProjectSession::act(const WebSocketPtr&, const api::Edit& edit) {
  StoredState next = now_.state;
  if (edit.grammar) next.grammar = *edit.grammar;
  if (edit.scene) next.scene = edit.scene->text;
  const bool search = edit.search.value_or(false);
  if (next == now_.state) {
    if (search) live_->start(LiveStart::shown, 0);
    return;
  }
  change(next, {.label = edit.label, .gesture = edit.gesture.value_or(""), .search = search},
         search ? LiveStart::shown : LiveStart::keep);
}

void ProjectSession::moved(const std::optional<StoredMove>& move, const char* nothing) {
  if (!move) throw Error(nothing);
  // A search that goes on would at once replace the model that is brought back.
  if (move->model && !move->search) live_->stop();
  live_->take(move->now.state, move->now.revision, move->search ? LiveStart::shown : LiveStart::keep, move->model);
  take_now(move->now);
  send_document();
}

void ProjectSession::act(const WebSocketPtr&, const api::Undo&) {
  const ShownModelPtr model = shown();
  moved(store_.undo(project_, model ? std::optional(model->encoded) : std::nullopt), "there is nothing to undo");
}
void ProjectSession::act(const WebSocketPtr&, const api::Redo&) { moved(store_.redo(project_), "there is nothing to do again"); }

void ProjectSession::act(const WebSocketPtr&, const api::RemoveFile& remove) {
  StoredState next = now_.state;
  const auto is_it = [&](const StoredFile& file) { return file.path == remove.path; };
  if (std::erase_if(next.files, is_it) == 0) throw Error(fmt::format("the project has no file {}", remove.path));
  change(next, {.label = "Remove " + remove.path}, LiveStart::keep);
}

void ProjectSession::act(const WebSocketPtr&, const api::StartSearch& start) {
  LiveStart from = start.from == api::StartSearchFrom::shown ? LiveStart::shown : LiveStart::nothing;
  const ShownModelPtr before = shown();
  if (start.onward.value_or(false) || !before) {
    return live_->start(start.onward.value_or(false) ? LiveStart::onward : from, start.seconds);
  }
  // What it finds may be worse than what is shown: undo brings that back.
  change(now_.state, {.label = "Search", .model_before = before->encoded}, from, {}, {}, start.seconds);
}

void ProjectSession::act(const WebSocketPtr&, const api::StopSearch&) { live_->stop(); }

ShownModelPtr ProjectSession::find_model(std::int64_t number) const {
  const std::lock_guard lock(mutex_);
  for (const ShownModelPtr& model : recent_) {
    if (model->number == number) return model;
  }
  throw Error(fmt::format("model {} is not shown any more", number));
}

void ProjectSession::act(const WebSocketPtr& socket, const api::AskGene& ask) {
  if (ask.gene.has_value() == ask.path.has_value()) throw Error("ask_gene must have either gene or path");
  const ShownModelPtr model = find_model(ask.model);
  socket->out.push_text(answer_text(gene_text(*model, ask.path ? gene_at(*model, *ask.path) : *ask.gene), ask.request));
}

void ProjectSession::show_by_hand(const std::string& label, const std::string& gesture, const std::string& derivation) {
  const ShownModelPtr before = shown();
  live_->stop();
  StoredStep step{label, gesture, false, {}, derivation};
  if (before) step.model_before = before->encoded;
  change(now_.state, step, LiveStart::keep, derivation);
}

void ProjectSession::act(const WebSocketPtr&, const api::SetDraw& set) {
  const ShownModelPtr model = find_model(set.model);
  const Derivation changed = with_draw(*model, set.gene, set.index, set.quantile);
  const GeneratorGraph& graph = model->setup->graph();
  const Rule& rule = rule_of(graph, changed.genes[static_cast<std::size_t>(set.gene)]);
  show_by_hand("Set a draw of " + rule.name, set.gesture.value_or(""), encode(graph, changed));
}

void ProjectSession::act(const WebSocketPtr&, const api::SetLock& set) {
  const ShownModelPtr model = find_model(set.model);
  const std::string path = path_of(*model, set.gene);
  std::vector<std::string> locks = locks_of(now_.state.scene);
  // A lock holds all below; what frees a gene frees those above it too.
  std::erase_if(locks, [&](const std::string& lock) { return set.locked ? stands_on(lock, path) : stands_on(path, lock); });
  if (set.locked) locks.push_back(path);
  StoredState next = now_.state;
  next.scene = with_locks(next.scene, locks);
  if (next == now_.state) return;
  const std::string rule = path.substr(path.rfind('/') + 1);
  change(next, {.label = (set.locked ? "Lock " : "Free ") + rule}, LiveStart::keep);
}

void ProjectSession::act(const WebSocketPtr& socket, const api::AskReach& ask) {
  reach_.ask(socket, ask.rule);
}

void ProjectSession::act(const WebSocketPtr&, const api::Format&) {
  Diagnostics diagnostics;
  const std::optional<std::string> text = format_grammar(now_.state.grammar, diagnostics);
  if (!text) throw Error("the grammar cannot be read: see its problems");
  if (*text == now_.state.grammar) return;
  StoredState next = now_.state;
  next.grammar = *text;
  change(next, {.label = "Format"}, LiveStart::keep);
}

void ProjectSession::act(const WebSocketPtr&, const api::KeepFavourite& asked) {
  const ShownModelPtr model = asked.model ? find_model(*asked.model) : shown();
  if (!model) throw Error("no model is shown");
  StoredFavourite favourite{0, model->score.value_or(0), static_cast<std::int64_t>(model->derivation.size()), model->words,
                            model->encoded, decode_base64(asked.picture.value_or(""))};
  keep(std::move(favourite));
}

void ProjectSession::keep(StoredFavourite favourite) {
  favourite.id = store_.add_favourite(project_, favourite);
  favourites_.push_back(std::move(favourite));
  send_document();
}

void ProjectSession::act(const WebSocketPtr&, const api::DropFavourite& drop) {
  const auto is_it = [&](const StoredFavourite& one) { return one.id == drop.favourite; };
  const auto found = std::find_if(favourites_.begin(), favourites_.end(), is_it);
  if (found == favourites_.end()) throw Error("there is no such favourite");
  store_.remove_favourite(project_, drop.favourite);
  dropped_.push_back(std::move(*found));
  if (dropped_.size() > kMostDropped) dropped_.pop_front();
  favourites_.erase(found);
  send_document();
}

void ProjectSession::act(const WebSocketPtr&, const api::RestoreFavourite& restore) {
  // Numbers are given again: the newest of that number.
  const auto is_it = [&](const StoredFavourite& one) { return one.id == restore.favourite; };
  const auto found = std::find_if(dropped_.rbegin(), dropped_.rend(), is_it);
  if (found == dropped_.rend()) throw Error("there is no such favourite among those that were dropped last");
  keep(*found);
  dropped_.erase(std::prev(found.base()));
}

void ProjectSession::act(const WebSocketPtr&, const api::ShowFavourite& show) {
  for (const StoredFavourite& one : favourites_) {
    if (one.id == show.favourite) return show_by_hand("Show a favourite", "", one.derivation);
  }
  throw Error("there is no such favourite");
}

}  // namespace espalier::studio
