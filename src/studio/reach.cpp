#include "studio/reach.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "studio/free_growth.h"

namespace espalier::studio {
namespace {

constexpr double kMostSeconds = 1;
// Models of hostile grammars are cut short.
constexpr ExpandLimits kLimits = {.most_parts = 20'000, .most_turns = 200'000, .most_copies = 50'000,
                                  .make_materials = false};

bool finite(const Vec3& p) { return std::isfinite(p.x + p.y + p.z); }

}  // namespace

Reach::Reach(std::shared_ptr<const GeneratorGraph> graph, Scene scene, std::string rule)
    : graph_(std::move(graph)), scene_(std::move(scene)), rule_(std::move(rule)), expander_(*graph_, kLimits) {
  const auto has = [&](const Rule& one) { return one.name == rule_; };
  done_ = std::none_of(graph_->rules.begin(), graph_->rules.end(), has);
}

void Reach::go_on(double seconds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point began = Clock::now();
  double spent = 0;
  do {
    if (done_) return;
    grow_one();
    spent = std::chrono::duration<double>(Clock::now() - began).count();
    done_ = done_ || ++models_ >= kModels || points_.size() >= kMostPoints || spent_ + spent >= kMostSeconds;
  } while (spent < seconds);
  spent_ += spent;
}

void Reach::grow_one() {
  Derivation derivation;
  try {
    derivation = grow_freely(*graph_, scene_, models_);
  } catch (const Error&) {
    done_ = true;
    return;
  }
  expander_.expand(derivation, ExpandTo::parts, model_);
  const auto of_rule = [&](std::uint32_t gene) { return rule_of(*graph_, derivation.genes[gene]).name == rule_; };
  const auto add = [&](const Vec3& at, std::uint32_t kind) {
    if (finite(at) && points_.size() < kMostPoints) points_.push_back({at, kind});
  };
  for (const Bone& bone : model_.bones) {
    if (of_rule(bone.gene)) add(bone.from, 0), add(bone.to, 1);
  }
  for (const Instance& instance : model_.instances) {
    if (of_rule(instance.gene)) add(instance.model_from_mesh.origin, 2);
  }
}

}  // namespace espalier::studio
