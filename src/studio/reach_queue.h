#pragma once
// ReachQueue: which pages asked for the reach of which rule, and the cloud that is being made. Of one thread.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "studio/reach.h"
#include "studio/web_server.h"

namespace espalier::studio {

class ReachQueue {
 public:
  void ask(const WebSocketPtr& socket, const std::string& rule) { asked_[socket->number] = {socket, rule}; }
  /// The grammar is another one now: what was being made begins anew, of that.
  void restart();
  /// Works for a short while. Whether there was anything to do. `scene` is asked for when a cloud begins.
  bool go_on(const std::shared_ptr<const GeneratorGraph>& graph, const std::function<Scene()>& scene);

 private:
  std::map<std::uint64_t, std::pair<WebSocketPtr, std::string>> asked_;  // rule by socket
  std::unique_ptr<Reach> reach_;
  std::vector<WebSocketPtr> for_;
};

}  // namespace espalier::studio
