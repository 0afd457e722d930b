#include "studio/reach_queue.h"

namespace espalier::studio {
namespace {

constexpr double kTurn = 0.01;  // seconds

}  // namespace

void ReachQueue::restart() {
  if (!reach_) return;
  for (const WebSocketPtr& socket : for_) asked_.try_emplace(socket->number, socket, reach_->rule());
  reach_.reset();
}

bool ReachQueue::go_on(const std::shared_ptr<const GeneratorGraph>& graph, const std::function<Scene()>& scene) {
  if (!reach_ && !asked_.empty() && graph) {
    // All who asked for one rule get one cloud.
    const std::string rule = asked_.begin()->second.second;
    for_.clear();
    for (auto it = asked_.begin(); it != asked_.end();) {
      if (it->second.second != rule) {
        ++it;
        continue;
      }
      for_.push_back(it->second.first);
      it = asked_.erase(it);
    }
    reach_ = std::make_unique<Reach>(graph, scene(), rule);
  }
  if (!reach_) return false;
  reach_->go_on(kTurn);
  if (!reach_->done()) return true;
  const Bytes cloud = std::make_shared<const std::string>(reach_->message());
  for (const WebSocketPtr& socket : for_) socket->out.push_cloud(cloud);
  reach_.reset();
  return true;
}

}  // namespace espalier::studio
