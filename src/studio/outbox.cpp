#include "studio/outbox.h"

#include <algorithm>
#include <utility>

namespace espalier::studio {

void OutBox::push_text(std::string text) {
  OutMessage message;
  message.bytes = std::make_shared<const std::string>(std::move(text));
  push(std::move(message));
}

void OutBox::push_model(ModelPacket model) {
  OutMessage message;
  message.kind = OutMessage::Kind::model;
  message.model = std::move(model);
  push(std::move(message));
}

void OutBox::push_cloud(Bytes cloud) {
  OutMessage message;
  message.kind = OutMessage::Kind::cloud;
  message.bytes = std::move(cloud);
  push(std::move(message));
}

void OutBox::push_individual(std::int64_t individual, ModelPacket model) {
  OutMessage message;
  message.kind = OutMessage::Kind::individual;
  message.individual = individual;
  message.model = std::move(model);
  push(std::move(message));
}

void OutBox::push(OutMessage message) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  if (message.kind == OutMessage::Kind::text) {
    ++texts_;
    text_bytes_ += message.bytes->size();
    if (texts_ > kMostTexts || text_bytes_ > kMostTextBytes) {
      closed_ = true;
      waiting_.clear();
      changed_.notify_all();
      return;
    }
  } else {
    const auto is_older = [&](const OutMessage& waiting) {
      return waiting.kind == message.kind && waiting.individual == message.individual;
    };
    auto older = std::find_if(waiting_.begin(), waiting_.end(), is_older);
    const auto is_individual = [](const OutMessage& waiting) { return waiting.kind == OutMessage::Kind::individual; };
    if (older == waiting_.end() && message.kind == OutMessage::Kind::individual &&
        static_cast<std::size_t>(std::count_if(waiting_.begin(), waiting_.end(), is_individual)) >= kMostIndividuals) {
      older = std::find_if(waiting_.begin(), waiting_.end(), is_individual);
    }
    if (older != waiting_.end()) waiting_.erase(older);
  }
  waiting_.push_back(std::move(message));
  changed_.notify_all();
}

void OutBox::forget_models() {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [](const OutMessage& message) { return message.kind != OutMessage::Kind::text; });
}

std::optional<OutMessage> OutBox::take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || !waiting_.empty(); });
  if (closed_) return std::nullopt;
  OutMessage message = std::move(waiting_.front());
  waiting_.pop_front();
  if (message.kind == OutMessage::Kind::text) {
    --texts_;
    text_bytes_ -= message.bytes->size();
  }
  return message;
}

void OutBox::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  waiting_.clear();
  changed_.notify_all();
}

bool OutBox::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

}  // namespace espalier::studio
