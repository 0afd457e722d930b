#include "score/model_change.h"

#include <gtest/gtest.h>

#include "score/score_models.h"

namespace espalier {
namespace {

using namespace test;

/// One part per digit.
std::vector<Instance> parts(const std::string& digits) {
  std::vector<Instance> made;
  for (const char digit : digits) {
    made.push_back(part(kBox, box_frame(Vec3(static_cast<float>(digit - '0')), Vec3(20))));
    made.back().gene = static_cast<std::uint32_t>(made.size());  // does not matter
  }
  return made;
}

std::string change(const std::string& before, const std::string& after) {
  const std::vector<Instance> a = parts(before), b = parts(after);
  const ModelChange found = find_change(a, b);
  EXPECT_EQ(found.before.size(), before.size());
  const auto removed = found.removed.size();
  const auto added = static_cast<std::size_t>(found.added.data() - b.data());
  EXPECT_EQ(found.first, added);
  EXPECT_EQ(before.substr(0, found.first) + after.substr(added, found.added.size()) +
                before.substr(found.first + removed), after);
  return before.substr(found.first, removed) + ">" + after.substr(added, found.added.size());
}

TEST(ModelChange, IsWhatBeginningAndEndLeave) {
  EXPECT_EQ(change("1234", "1234"), ">");
  EXPECT_EQ(change("", ""), ">");
  EXPECT_EQ(change("", "12"), ">12");
  EXPECT_EQ(change("12", ""), "12>");
  EXPECT_EQ(change("1234", "1954"), "23>95");
  EXPECT_EQ(change("1234", "14"), "23>");
  EXPECT_EQ(change("14", "1234"), ">23");
  EXPECT_EQ(change("111", "11"), "1>");
  EXPECT_EQ(change("11", "11111"), ">111");
  EXPECT_EQ(change("1213", "1313"), "2>3");
  EXPECT_EQ(change("123", "456"), "123>456");
}

TEST(ModelChange, LooksAtAllThatTargetsSee) {
  const Instance one = part(kCone, box_frame(Vec3(1), Vec3(2)), 0.5f);
  Instance other = one;
  other.gene = 7, other.material = 3;
  EXPECT_TRUE(same_part(one, other));
  other.top = 0.25f;
  EXPECT_FALSE(same_part(one, other));
  other = one, other.mesh = kBox;
  EXPECT_FALSE(same_part(one, other));
  other = one, other.layer = Layer::detail;
  EXPECT_FALSE(same_part(one, other));
  other = one, other.model_from_mesh.origin.z += 1e-6f;
  EXPECT_FALSE(same_part(one, other));
}

}  // namespace
}  // namespace espalier
