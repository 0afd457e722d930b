// The history of a project: steps, how they join, what is forgotten.
#include <set>

#include "studio/breeding_tables.h"
#include "studio/store.h"

namespace espalier::studio {

/// Unless some state still names it.
void Store::forget_text(std::int64_t project, const std::string& hash) {
  database_->prepare("delete from text where project = ?1 and hash = ?2 and not exists (select 1 from step where "
                     "project = ?1 and (grammar = ?2 or scene = ?2 or files = ?2 or model_before = ?2 or model_after = ?2))")
      .bind(project).bind(hash).run();
}

void Store::forget_blobs(std::int64_t project) {
  std::set<std::string> named;
  Statement lists = database_->prepare("select distinct files from step where project = ?");
  lists.bind(project);
  while (lists.step()) {
    for (const StoredFile& file : parse_files(text(project, lists.text(0)))) named.insert(file.hash);
  }
  for (const std::string& list : breeding_file_lists(*database_, project)) {
    for (const StoredFile& file : parse_files(list)) named.insert(file.hash);
  }
  std::vector<std::string> unnamed;
  Statement ask = database_->prepare("select hash from blob where project = ?");
  ask.bind(project);
  while (ask.step()) {
    if (named.count(ask.text(0)) == 0) unnamed.push_back(ask.text(0));
  }
  for (const std::string& hash : unnamed) {
    database_->prepare("delete from blob where project = ? and hash = ?").bind(project).bind(hash).run();
  }
}

/// Forgets the oldest steps where there are too many, or their texts too long, and whatever no state names any more.
void Store::trim(std::int64_t project) {
  const std::int64_t number = head(project).number;
  database_->prepare("delete from step where project = ? and number < ?").bind(project).bind(number - kMostSteps).run();
  for (;;) {
    database_->prepare("delete from text where project = ?1 and hash not in ("
                       "select grammar from step where project = ?1 union select scene from step where project = ?1 "
                       "union select files from step where project = ?1 "
                       "union select model_before from step where project = ?1 and model_before is not null "
                       "union select model_after from step where project = ?1 and model_after is not null)")
        .bind(project).run();
    Statement ask = database_->prepare("select sum(length(bytes)) from text where project = ?");
    if (!ask.bind(project).step() || static_cast<std::uint64_t>(ask.whole(0)) <= kMostHistoryBytes) break;
    Statement oldest = database_->prepare("select number from step where project = ? order by number");
    std::vector<std::int64_t> before;
    oldest.bind(project);
    while (oldest.step()) {
      if (oldest.whole(0) < number) before.push_back(oldest.whole(0));
    }
    if (before.empty()) break;
    database_->prepare("delete from step where project = ? and number <= ?")
        .bind(project).bind(before[before.size() / 2]).run();
  }
  forget_blobs(project);
}

StoredProjectState Store::edit(std::int64_t project, const StoredState& state, const StoredStep& step,
                               const std::map<std::string, std::string>& blobs) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(*database_);
  const Head at = head(project);
  const std::string grammar = keep_text(project, state.grammar), scene = keep_text(project, state.scene);
  const std::string files = keep_files(project, state.files, blobs);
  std::optional<std::string> before, after;
  if (step.model_before) before = keep_text(project, *step.model_before);
  if (step.model_after) after = keep_text(project, *step.model_after);
  bool redone = false;
  {
    Statement ask = database_->prepare("select 1 from step where project = ? and number > ?");
    redone = ask.bind(project).bind(at.number).step();
  }
  const bool joins = at.number > 0 && !step.gesture.empty() && step.gesture == at.gesture && !redone;
  std::int64_t number = at.number;
  if (joins) {
    std::optional<std::string> old_after;
    {
      Statement ask = database_->prepare("select model_after from step where project = ? and number = ?");
      if (ask.bind(project).bind(number).step()) old_after = ask.maybe_text(0);
    }
    database_->prepare("update step set label = ?, search = max(search, ?), grammar = ?, scene = ?, files = ?, "
                       "model_before = coalesce(model_before, ?), model_after = coalesce(?, model_after) "
                       "where project = ? and number = ?")
        .bind(step.label).bind(std::int64_t{step.search}).bind(grammar).bind(scene).bind(files).bind_maybe(before).bind_maybe(after)
        .bind(project).bind(number).run();
    for (const std::string& old : {at.grammar, at.scene, at.files}) forget_text(project, old);
    if (old_after) forget_text(project, *old_after);
    if (before) forget_text(project, *before);
  } else {
    database_->prepare("delete from step where project = ? and number > ?").bind(project).bind(number).run();
    ++number;
    database_->prepare("insert into step values (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
        .bind(project).bind(number).bind(step.label).bind(step.gesture).bind(std::int64_t{step.search}).bind(grammar)
        .bind(scene).bind(files).bind_maybe(before).bind_maybe(after).run();
  }
  touch(project, number);
  if (!joins && (redone || number % 16 == 0)) trim(project);
  StoredProjectState result = read(project);
  transaction.commit();
  return result;
}

std::optional<StoredMove> Store::undo(std::int64_t project, const std::optional<std::string>& shown) {
  return move(project, true, shown);
}
std::optional<StoredMove> Store::redo(std::int64_t project) { return move(project, false, {}); }

std::optional<StoredMove> Store::move(std::int64_t project, bool back, const std::optional<std::string>& shown) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(*database_);
  const std::int64_t number = head(project).number, to = back ? number - 1 : number + 1;
  {
    Statement ask = database_->prepare("select 1 from step where project = ? and number = ?");
    if (!ask.bind(project).bind(to).step()) return std::nullopt;
  }
  if (shown) {
    database_->prepare("update step set model_after = ? where project = ? and number = ? and model_before is not null "
                       "and model_after is null")
        .bind(keep_text(project, *shown)).bind(project).bind(number).run();
  }
  StoredMove move;
  std::optional<std::string> model;
  {
    Statement ask = database_->prepare("select search, model_before, model_after from step where project = ? and number = ?");
    ask.bind(project).bind(back ? number : to).step();
    move.search = ask.whole(0) != 0;
    model = ask.maybe_text(back ? 1 : 2);
  }
  if (model) move.model = text(project, *model);
  // What comes next is a step of its own, whatever gesture it is of.
  database_->prepare("update step set gesture = '' where project = ? and number in (?, ?)")
      .bind(project).bind(number).bind(to).run();
  touch(project, to);
  move.now = read(project);
  transaction.commit();
  return move;
}

}  // namespace espalier::studio
