#pragma once
// CurveCost: what a skeleton costs under guiding curves (Guiding curves 2018, section 3.3, equations 1 to 8). A bone is
// judged by the curve nearest to its base: how far it is, how well the bone is aligned, and which segments of the curve
// it uses. Costs are integers, so their sum is the same in any order, bone by bone or all at once.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "model/model.h"
#include "score/curve_finder.h"
#include "score/guiding_curve.h"

namespace espalier {

/// The terms of the cost, in the order in which they are told.
enum class CurveTerm : std::uint8_t { distance, alignment, utilisation, density };
inline constexpr std::size_t kCurveTerms = 4;

/// One skeleton's account: costs in units of kCostUnit, and how often what was used.
struct CurveTally {
  std::array<std::int64_t, kCurveTerms> cost{};
  std::vector<std::uint8_t> uses;   // per segment of all curves; stays at 255
  std::vector<std::uint16_t> crowd;  // bones per cell of the density's region; stays at 65535

  std::int64_t total() const { return cost[0] + cost[1] + cost[2] + cost[3]; }
  bool operator==(const CurveTally&) const = default;
};

/// What one bone does to an account, whatever is there already.
struct BoneEffect {
  std::int64_t distance = 0, alignment = 0;   // cost
  std::uint32_t curve = 0;
  std::uint16_t first_segment = 1, last_segment = 0;  // that it uses; none where first is greater
  std::uint16_t cell = 0xffff;  // of the density's region; 0xffff: beyond it
};

inline constexpr double kCostUnit = 0x1p-16;
/// Each term of a bone is kept within these bounds, in cost: so no sum can overflow.
inline constexpr double kMostCost = 1e9;

class CurveField;

class CurveCost {
 public:
  /// Throws Error as `validate` does.
  explicit CurveCost(const CurveSettings& settings);
  ~CurveCost();

  const CurveSettings& settings() const { return settings_; }
  /// Of one curve: its length over GuidingCurve::segment, rounded up; at least 1.
  std::uint32_t segments(std::uint32_t curve) const { return rulers_[curve].segments; }
  /// Which segment a parameter falls into, 0..segments - 1. All are equally long.
  std::uint32_t segment_at(std::uint32_t curve, float t) const;

  /// An empty skeleton's.
  void reset(CurveTally& tally) const;
  /// The curve that judges a bone with this base.
  CurvePoint nearest(const Vec3& base) const;
  /// `base` is nearest(from).
  BoneEffect judge(const CurvePoint& base, const Vec3& from, const Vec3& to) const;
  void add(const BoneEffect& effect, CurveTally& tally) const;
  void add_bone(const Vec3& from, const Vec3& to, CurveTally& tally) const { add(judge(nearest(from), from, to), tally); }
  /// The alignment term of a bone with this base and direction (any length; zero costs nothing), in kCostUnit.
  std::int64_t alignment(const CurvePoint& base, const Vec3& direction) const;

 private:
  /// Where segments begin along t.
  struct Ruler {
    static constexpr std::size_t kGuesses = 64;
    std::uint32_t segments = 1, first = 0;  // first: into CurveTally::uses
    std::vector<float> begins;              // segments + 1; the last is above 1
    std::array<std::uint16_t, kGuesses + 1> guess{};  // the segment at t = i / kGuesses
    std::array<float, kGuesses + 1> behind{};         // share of the curve's length that lies behind, likewise
    std::array<std::int64_t, 256> worth{};  // cost of the use after so many
  };

  static Ruler make_ruler(const GuidingCurve& curve, std::uint32_t first);
  float distance_beyond(const GuidingCurve& curve, const CurvePoint& base) const;
  std::uint16_t cell_at(const Vec3& p) const;
  std::int64_t crowd_cost(double bones) const;

  CurveSettings settings_;
  CurveFinder finder_;
  std::unique_ptr<const CurveField> field_;  // null: exact
  std::vector<Ruler> rulers_;
  std::uint32_t all_segments_ = 0;
  std::array<std::uint32_t, 3> cells_{};
  double wanted_in_cell_ = 0;
};

}  // namespace espalier
