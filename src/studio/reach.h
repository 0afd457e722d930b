#pragma once
// Reach: where what grows from a rule can land, told by models that grow freely. Done in short turns.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "model/expand.h"
#include "run/scene.h"
#include "studio/model_message.h"

namespace espalier::studio {

class Reach {
 public:
  static constexpr std::uint32_t kModels = 200;
  static constexpr std::size_t kMostPoints = 20'000;

  Reach(std::shared_ptr<const GeneratorGraph> graph, Scene scene, std::string rule);

  const std::string& rule() const { return rule_; }
  bool done() const { return done_; }
  /// Grows models for so many seconds, or to the end; one at least.
  void go_on(double seconds);
  /// ESPC.
  std::string message() const { return cloud_message(rule_, points_); }
  const std::vector<CloudPoint>& points() const { return points_; }

 private:
  void grow_one();

  std::shared_ptr<const GeneratorGraph> graph_;
  Scene scene_;
  std::string rule_;
  Expander expander_;
  Model model_;
  std::vector<CloudPoint> points_;
  std::uint32_t models_ = 0;
  double spent_ = 0;
  bool done_ = false;
};

}  // namespace espalier::studio
