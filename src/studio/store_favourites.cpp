// What a project has beside its history: the model that is shown, and favourites. And what belongs to no project.
#include <fmt/format.h>

#include "base/error.h"
#include "studio/picture_type.h"
#include "studio/store.h"

namespace espalier::studio {

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
  Statement ask = database_->prepare("select id, score, genes, words, derivation, picture from favourite "
                                     "where project = ? order by id");
  ask.bind(project);
  while (ask.step()) all.push_back({ask.whole(0), ask.number(1), ask.whole(2), ask.text(3), ask.text(4), ask.text(5)});
  return all;
}

std::int64_t Store::add_favourite(std::int64_t project, const StoredFavourite& favourite) {
  if (favourites(project).size() >= kMostFavourites) {
    throw Error(fmt::format("a project has at most {} favourites", kMostFavourites));
  }
  if (favourite.picture.size() > kMostPictureBytes || (!favourite.picture.empty() && picture_type(favourite.picture).empty())) {
    throw Error(fmt::format("a favourite's picture must be a PNG, JPEG or WebP of at most {} bytes", kMostPictureBytes));
  }
  const std::lock_guard lock(mutex_);
  Transaction transaction(*database_);
  head(project);
  database_->prepare("insert into favourite (project, score, genes, words, derivation, picture) values (?, ?, ?, ?, ?, ?)")
      .bind(project).bind(favourite.score).bind(favourite.genes).bind(favourite.words).bind_blob(favourite.derivation)
      .bind_blob(favourite.picture).run();
  const std::int64_t id = database_->last_row();
  transaction.commit();
  return id;
}

std::string Store::favourite_picture(std::int64_t project, std::int64_t favourite) {
  const std::lock_guard lock(mutex_);
  Statement ask = database_->prepare("select picture from favourite where project = ? and id = ?");
  return ask.bind(project).bind(favourite).step() ? ask.text(0) : "";
}

void Store::remove_favourite(std::int64_t project, std::int64_t favourite) {
  const std::lock_guard lock(mutex_);
  database_->prepare("delete from favourite where project = ? and id = ?").bind(project).bind(favourite).run();
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
