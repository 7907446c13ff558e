#include "core/arc_set.hpp"

#include <rapidcheck/gtest.h>

#include "support/test.hpp"

namespace condyle {
namespace {

Angle deg(double value) {
  return Angle::degrees(value);
}
core::Arc arc(double start_deg, double width_deg) {
  return {deg(start_deg), deg(width_deg)};
}

TEST(ArcSet, OfNothingHoldsNothingAndOfEverythingEverything) {
  EXPECT_TRUE(core::ArcSet().empty());
  EXPECT_FALSE(core::ArcSet().contains(deg(0)));
  EXPECT_TRUE(core::ArcSet().complement().is_full_turn());
  EXPECT_TRUE(core::ArcSet::full_turn().complement().empty());
  EXPECT_TRUE(core::ArcSet::full_turn().contains(deg(-1234)));
  EXPECT_EQ(core::ArcSet::full_turn().arcs(), std::vector<core::Arc>{arc(0, 360)});
  EXPECT_EQ(core::ArcSet().measure().radians(), 0);
  EXPECT_EQ(core::ArcSet::full_turn().measure().radians(), two_pi);
}

TEST(ArcSet, IncludesTheEndsOfItsArcs) {
  const core::ArcSet set({{Angle::radians(1), Angle::radians(2)}});
  EXPECT_TRUE(set.contains(Angle::radians(1)));
  EXPECT_TRUE(set.contains(Angle::radians(3)));
  EXPECT_FALSE(set.contains(Angle::radians(std::nextafter(1, 0))));
  EXPECT_FALSE(set.contains(Angle::radians(std::nextafter(3, 4))));
}

TEST(ArcSet, JoinsArcsThatOverlapOrMeet) {
  const core::ArcSet set({{Angle::radians(2), Angle::radians(1)}, {Angle::radians(1), Angle::radians(1)}});
  EXPECT_EQ(set.arcs(), (std::vector<core::Arc>{{Angle::radians(1), Angle::radians(2)}}));
}

TEST(ArcSet, ReportsAnArcAcrossZeroAsOne) {
  const core::ArcSet set({arc(-10, 20), arc(100, 10)});
  const auto arcs = set.arcs();
  ASSERT_EQ(arcs.size(), 2u);
  EXPECT_NEAR(arcs[0].start.degrees(), 100, 1e-12);
  EXPECT_NEAR(arcs[1].start.degrees(), 350, 1e-12);
  EXPECT_NEAR(arcs[1].width.degrees(), 20, 1e-12);
  EXPECT_TRUE(set.contains(deg(0)));
  EXPECT_TRUE(set.contains(deg(360)));
  EXPECT_TRUE(set.contains(arc(-5, 10)));
  EXPECT_FALSE(set.contains(arc(-5, 30)));
}

TEST(ArcSet, HoldsZeroHoweverItIsNamed) {
  for (const core::ArcSet& set :
       {core::ArcSet({{Angle(), Angle()}}), core::ArcSet({{Angle::radians(two_pi - 1), Angle::radians(1)}}),
        core::ArcSet({{Angle::radians(0), Angle::radians(1)}})}) {
    EXPECT_TRUE(set.contains(deg(0)));
    EXPECT_TRUE(set.contains(Angle::radians(two_pi)));
    EXPECT_EQ(set.arcs().size(), 1u);
    EXPECT_EQ(set.united(set), set);
  }
}

TEST(ArcSet, OfASingleDirectionHasNoWidthAndNoComplementOfItsOwn) {
  const core::ArcSet point({arc(90, 0)});
  EXPECT_TRUE(point.contains(deg(90)));
  EXPECT_EQ(point.measure().radians(), 0);
  EXPECT_TRUE(point.complement().contains(deg(90))) << "ends belong to both";
}

/// Arcs that start on a tick, a 512th of a turn, and end halfway between two: whatever rounding does to them,
/// it never decides what overlaps. Start and width in quarter ticks.
using Arcs = std::vector<std::pair<int, int>>;
constexpr int quarters = 4 * 512;

std::pair<int, int> any_arc() {
  return {4 * *rc::gen::inRange(0, 512), 2 + 4 * *rc::gen::inRange(0, 170)};
}
Arcs any_arcs() {
  Arcs arcs(*rc::gen::inRange<std::size_t>(0, 12));
  for (auto& a : arcs) a = any_arc();
  return arcs;
}

Angle quarter(int count) {
  return Angle::radians(count * (two_pi / quarters));
}

core::ArcSet set_of(const Arcs& from) {
  std::vector<core::Arc> out;
  for (const auto& [start, width] : from) out.push_back({quarter(start), quarter(width)});
  return core::ArcSet(out);
}

/// The obvious membership: any arc holds the direction.
bool any_holds(const Arcs& from, int at) {
  return std::any_of(from.begin(), from.end(),
                     [at](const auto& a) { return (at - a.first + quarters) % quarters <= a.second; });
}

RC_GTEST_PROP(ArcSet, HoldsWhatAnyOfItsArcsHolds, ()) {
  const Arcs a = any_arcs(), b = any_arcs();
  const core::ArcSet one = set_of(a), other = set_of(b), both = one.united(other), rest = both.complement();
  for (int at = 1; at < quarters; at += 2) {
    RC_ASSERT(one.contains(quarter(at)) == any_holds(a, at));
    RC_ASSERT(both.contains(quarter(at)) == (any_holds(a, at) || any_holds(b, at)));
    RC_ASSERT(rest.contains(quarter(at)) == !both.contains(quarter(at)));
  }
  RC_ASSERT(other.united(one) == both);
  RC_ASSERT(both.united(rest).is_full_turn());
  RC_ASSERT(std::abs(both.measure().radians() + rest.measure().radians() - two_pi) < 1e-12);
}

RC_GTEST_PROP(ArcSet, HoldsAnArcWhereItHoldsAllOfIt, ()) {
  const Arcs a = any_arcs();
  const auto [start, width] = any_arc();
  bool all = true;
  for (int at = start + 1; at < start + width; at += 2) all = all && any_holds(a, at % quarters);
  RC_ASSERT(set_of(a).contains(core::Arc{quarter(start + 1), quarter(width - 2)}) == all);
}

}  // namespace
}  // namespace condyle
