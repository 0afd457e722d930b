#pragma once
// OutBox: what waits to be written to one page. Texts are never dropped; of models and clouds only the newest waits, and so of
// the models of each individual of the breeding room. Safe to use from any thread.

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace espalier::studio {

using Bytes = std::shared_ptr<const std::string>;

/// A model as it goes to a page: its meshes, unless the page has them; the model; and the text that describes it.
struct ModelPacket {
  std::uint32_t table = 0;  // number of the mesh table
  Bytes meshes, model, shown;
};

struct OutMessage {
  enum class Kind : std::uint8_t { text, model, cloud, individual } kind = Kind::text;
  Bytes bytes;        // text, cloud
  ModelPacket model;  // model, individual
  std::int64_t individual = 0;
};

class OutBox {
 public:
  static constexpr std::size_t kMostTexts = 4000;
  static constexpr std::size_t kMostTextBytes = 64u << 20;
  static constexpr std::size_t kMostIndividuals = 64;  // the oldest gives way

  /// A page that lets too many texts wait is given up: the box closes.
  void push_text(std::string text);
  void push_model(ModelPacket model);
  void push_cloud(Bytes cloud);
  void push_individual(std::int64_t individual, ModelPacket model);
  /// Models and clouds that wait are of a project that the page has left.
  void forget_models();

  /// The next message, as soon as there is one; nothing once the box is closed.
  std::optional<OutMessage> take();
  void close();
  bool closed() const;

 private:
  void push(OutMessage message);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<OutMessage> waiting_;
  std::size_t texts_ = 0, text_bytes_ = 0;
  bool closed_ = false;
};

}  // namespace espalier::studio
