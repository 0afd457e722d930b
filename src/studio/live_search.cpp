#include "studio/live_search.h"

#include <chrono>
#include <exception>

#include "studio/quietly.h"

namespace espalier::studio {

LiveSearch::LiveSearch(ReadBlob read_blob, LiveListener& listener, std::string shown)
    : read_blob_(std::move(read_blob)), listener_(listener), thread_([this, shown] { run(shown); }) {}

LiveSearch::~LiveSearch() {
  {
    const std::lock_guard lock(mutex_);
    wishes_.end = true;
    give_up_at_ = 1;
  }
  changed_.notify_all();
  thread_.join();
}

void LiveSearch::wish(bool leaves_search) {
  constexpr auto kPatience = std::chrono::milliseconds(200);
  if (leaves_search && give_up_at_ == 0) give_up_at_ = ticks(std::chrono::steady_clock::now() + kPatience);
  changed_.notify_all();
}

void LiveSearch::take(const StoredState& state, std::int64_t revision, LiveStart start, std::optional<std::string> model,
                      std::optional<double> seconds) {
  const std::lock_guard lock(mutex_);
  wishes_.state = state;
  wishes_.revision = revision;
  if (model) wishes_.model = std::move(model);
  // An edit that asks for a search is not undone by one after it that does not.
  if (!wishes_.start || start != LiveStart::keep) wishes_.start = start, wishes_.timed = seconds.has_value();
  if (seconds) wishes_.seconds = seconds, wishes_.stop = false;
  wish(true);
}

void LiveSearch::start(LiveStart start, double seconds) {
  const std::lock_guard lock(mutex_);
  wishes_.start = start;
  wishes_.seconds = seconds;
  wishes_.timed = true;
  wishes_.stop = false;
  wish(start != LiveStart::onward);
}

void LiveSearch::stop() {
  const std::lock_guard lock(mutex_);
  wishes_.stop = true;
  if (!wishes_.state) wishes_.start.reset();
  else wishes_.start = LiveStart::keep;
  wish(true);
}

void LiveSearch::run(std::string shown) {
  std::unique_ptr<LiveWork> work;
  try {
    work = std::make_unique<LiveWork>(read_blob_, listener_, give_up_at_, std::move(shown));
  } catch (const std::exception& error) {
    listener_.noted(api::LogLevel::error, error.what());
    return;
  }
  for (;;) {
    LiveWishes wishes;
    {
      std::unique_lock lock(mutex_);
      if (!work->running()) changed_.wait(lock, [&] { return wishes_.any(); });
      if (wishes_.end) return;
      std::swap(wishes, wishes_);
      give_up_at_ = 0;
    }
    try {
      if (wishes.any()) work->handle(wishes);
      if (work->running()) work->slice();
    } catch (const std::exception& error) {
      quietly([&] { work->give_up(error.what()); });
    }
  }
}

}  // namespace espalier::studio
