#include "contest.hpp"

#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "baseline.hpp"
#include "method.hpp"
#include "questions.hpp"
#include "reference.hpp"
#include "support/test.hpp"
#include "timing.hpp"

namespace bench {
namespace {

using condyle::Angle;
using condyle::Pose;
using condyle::TriMesh;
using condyle::Vec3;

/// Keeps a processor busy for so long.
void compute_for(double seconds) {
  const Stopwatch watch;
  while (watch.processor_seconds() < seconds) {
  }
}

Contestant taking(const std::string& name, double seconds, const Wrong& wrong) {
  return {name, name + "'s title", [=] {
            return Ready{[=] { compute_for(seconds); }, [=] { return wrong; }};
          }};
}

Contest held(const std::vector<Contestant>& others) {
  Contest contest{"asked", "what is asked", "things", 2, {}};
  hold(contest, taking("ours", 0.01, {.of = 7}), others, 0.2);
  return contest;
}

const Table& table_of(const Report& report, const std::string& name) {
  for (const Table& table : report.tables)
    if (table.head.name == name) return table;
  throw std::logic_error("no table " + name);
}

TEST(Contest, TheRatioIsAboveOneForWhoTakesLongerThanCondyle) {
  const Contest contest = held({taking("slow", 0.08, {}), taking("quick", 0.001, {})});
  ASSERT_EQ(contest.results.size(), 3u);
  EXPECT_EQ(contest.results[0].name, "ours");
  EXPECT_EQ(contest.results[0].ratio(), 1);
  EXPECT_EQ(contest.results[1].name, "quick");
  EXPECT_LT(contest.results[1].ratio(), 1);
  EXPECT_EQ(contest.results[2].name, "slow");
  EXPECT_GT(contest.results[2].ratio(), 1);

  Report report;
  report_contest(contest, "scene", report);
  EXPECT_EQ(report.ratios.at("asked/scene/slow"), contest.results[2].ratio());
  EXPECT_EQ(report.ratios.count("asked/scene/ours"), 0u) << "it is what the others are compared with";
}

TEST(Contest, TheFastestAndTheFastestWithoutAWrongAnswerAreNamed) {
  const Contest contest =
      held({taking("right", 0.03, {.of = 7}), taking("wrong", 0.02, {.missed = 1, .of = 7}),
            taking("late", 0.06, {.of = 7})});
  Report report;
  report_contest(contest, "scene", report);
  const auto& row = table_of(report, "beside_others").rows.at(0);
  EXPECT_EQ(text(row[3], 3), "0 of 7 things");
  EXPECT_EQ(text(row[4], 3), "wrong's title");
  EXPECT_EQ(text(row[7], 3), "1 of 7 things");
  EXPECT_EQ(text(row[8], 3), "right's title");
}

TEST(Contest, WhatIsMissedInventedOrOffIsWrong) {
  EXPECT_EQ((Wrong{.missed = 1, .invented = 20, .off = 300, .of = 1000}.all()), 321);
}

TEST(Contest, WhoFailsStaysInTheTableWithTheReason) {
  const auto fails = [](const char* why) { return std::runtime_error(why); };
  const Contest contest = held({
      {"unmade", "unmade", [=]() -> Ready { throw fails("no tree"); }},
      {"mute", "mute",
       [=] {
         return Ready{[=] { throw fails("no answer"); }, [] { return Wrong{}; }};
       }},
      taking("answers", 0.001, {.of = 7}),
  });
  Report report;
  report_contest(contest, "scene", report);
  const Table& all = table_of(report, "beside_others_all");
  ASSERT_EQ(all.rows.size(), 4u);
  EXPECT_EQ(text(all.rows[1][1], 3), "answers's title");
  EXPECT_EQ(text(all.rows[2][1], 3), "unmade, fails: no tree");
  EXPECT_EQ(text(all.rows[3][1], 3), "mute, fails: no answer");
  EXPECT_EQ(report.ratios.size(), 1u);
}

TEST(Contest, AWrongAnswerOfCondyleIsADisagreement) {
  Contest contest = held({});
  Report report;
  report_contest(contest, "scene", report);
  EXPECT_TRUE(report.disagreements.empty());
  contest.results[0].wrong.off = 1;
  report_contest(contest, "scene", report);
  EXPECT_EQ(report.disagreements, std::vector<std::string>{"asked/scene/ours: 1 of 7 things wrong"});
}

TEST(Contest, WithoutOthersThereIsNoFastest) {
  Report report;
  report_contest(held({}), "scene", report);
  EXPECT_EQ(text(table_of(report, "beside_others").rows.at(0)[4], 3), "none");
}

// What the contests hold answers against.

/// A box of 4 mm, cut into its twelve triangles, sunk by 1 mm into a large one.
TEST(ReferenceDepth, IsThatOfTheBodiesAndNotOfTheirTriangles) {
  const TriMesh fixed = condyle::test::box({-9, -9, -9}, {10, 11, 0.5}),
                mobile = condyle::test::box({-2, -2, -0.5}, {2, 2, 3});
  Pose away = Pose::Identity();
  away.translation() = Vec3(0, 0, 5);
  Reference reference{Bodies{fixed, mobile}, {Pose::Identity(), away}};
  const auto [low, high] = reference.depth(0);
  EXPECT_LE(low, 1);
  EXPECT_GE(high, 1);
  EXPECT_LE(high - low, 0.01);
  EXPECT_EQ(reference.depth(1).low_mm, 0);
}

/// Two bars that cross: no vertex of one is inside the other, and the middles of two faces of the second are 4 mm from the first one's.
TEST(ReferenceDepth, IsFoundInAFaceWhoseCornersAreAllOutside) {
  const TriMesh fixed = condyle::test::box({-20, -4, -4}, {20, 4, 4}),
                mobile = condyle::test::box({-3, -20, -2}, {3, 21, 2.5});
  Reference reference{Bodies{fixed, mobile}, {Pose::Identity()}};
  EXPECT_TRUE(reference.inside(0).empty());
  const auto [low, high] = reference.depth(0);
  EXPECT_LE(low, 4);
  EXPECT_GE(high, 4);
  EXPECT_LE(high - low, 0.01);
  EXPECT_NEAR(method_named("two_meshes")->make({fixed, mobile})->find_depth(Pose::Identity()).depth_mm, 4,
              1e-6);
}

std::vector<MethodKind> those_that(bool Answers::*answer) {
  std::vector<MethodKind> kinds;
  for (const MethodGroup& group : method_groups())
    for (const MethodKind& kind : group.kinds)
      if (kind.answers.*answer) kinds.push_back(kind);
  return kinds;
}

TEST(DepthMethods, AllSeeContactAndItsAbsence) {
  const TriMesh fixed = condyle::test::sphere({0, 0, 0}, 10, 3),
                mobile = condyle::test::sphere({0, 0, 0}, 5, 3);
  ASSERT_FALSE(those_that(&Answers::depth).empty());
  for (const MethodKind& kind : those_that(&Answers::depth)) {
    SCOPED_TRACE(kind.name);
    const auto method = kind.make({fixed, mobile});
    Pose X = Pose::Identity();
    X.translation() = Vec3(0.1, 0.2, 16);
    EXPECT_FALSE(method->find_depth(X).in_contact);
    X.translation() = Vec3(0.1, 0.2, 14);
    const BodyDepth found = method->find_depth(X);
    EXPECT_TRUE(found.in_contact);
    EXPECT_GT(found.depth_mm, 0);
  }
}

TEST(FirstContactMethods, FindWhereABoxTurnsIntoAWall) {
  // A box of half width 10 about z, whose corner at 45 degrees reaches a wall 12 from the axis at acos(12 / hypot(10, 10)) from it.
  const TriMesh wall = condyle::test::box({12, -30, -5}, {20, 30, 5}),
                bar = condyle::test::box({-10, -10, -4}, {10, 10, 4});
  const double angle = 45 - std::acos(12 / std::hypot(10.0, 10.0)) * 180 / std::numbers::pi;
  ASSERT_FALSE(those_that(&Answers::first_contact).empty());
  for (const MethodKind& kind : those_that(&Answers::first_contact)) {
    SCOPED_TRACE(kind.name);
    const auto turned = kind.make({wall, bar})->find_first_contact(Vec3::UnitZ(), Angle::degrees(170));
    ASSERT_TRUE(turned.has_value());
    // Conservative advancement ends at a step of a hundred thousandth of the range, which may be well before contact.
    EXPECT_LE(turned->degrees(), angle + 170e-5);
    EXPECT_GT(turned->degrees(), 0);
    if (kind.family == "Condyle") {
      EXPECT_NEAR(turned->degrees(), angle, 1e-9);
    }
    const auto free = kind.make({wall, bar})->find_first_contact(Vec3::UnitZ(), Angle::degrees(10));
    EXPECT_FALSE(free.has_value());
  }
}

TEST(Pairs, OfTwoSetsOfBoxesAreThoseOfTheTrees) {
  const auto boxes = method_named("cgal_boxes"), trees = method_named("trees");
  if (!boxes) GTEST_SKIP() << "CGAL is not there";
  const TriMesh fixed = condyle::test::sphere({0, 0, 0}, 10, 3),
                mobile = condyle::test::sphere({0, 0, 0}, 5, 3);
  Pose X(Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()));
  X.translation() = Vec3(0.1, 0.2, 13);
  std::vector<condyle::contact::TrianglePair> found, expected;
  boxes->make({fixed, mobile})->find_pairs(X, found);
  trees->make({fixed, mobile})->find_pairs(X, expected);
  std::sort(found.begin(), found.end());
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(found, expected);
}

TEST(Runs, AreAddedToThoseThatAreThere) {
  const condyle::test::TemporaryFolder folder;
  const std::string file = (folder.path() / "runs.json").string();
  Report report;
  report.machine = {
      {"processor", "one"}, {"date", "2026-11-28 10:00 UTC"}, {"commit", "abc"}, {"compiler", "left out"}};
  const std::string main(main_ratios().front());
  add_run(file, report, {{main, 21.456}, {"pairs/another/fcl_obb", 3}});
  add_run(file, report, {{main, 0.5}});
  std::ifstream in(file);
  const auto runs = nlohmann::json::parse(in);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0]["commit"], "abc");
  EXPECT_FALSE(runs[0].contains("compiler"));
  EXPECT_EQ(runs[0]["ratios"].size(), 1u);
  EXPECT_EQ(runs[0]["ratios"][main], 21.46);
  EXPECT_EQ(runs[1]["ratios"][main], 0.5);
}

TEST(Runs, AFileThatIsNoneIsNamedAndLeftAlone) {
  const condyle::test::TemporaryFolder folder;
  const std::string file = (folder.path() / "runs.json").string();
  std::ofstream(file) << "{}";
  try {
    add_run(file, {}, {});
    FAIL() << "added";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(file), std::string::npos);
  }
  std::stringstream now;
  now << std::ifstream(file).rdbuf();
  EXPECT_EQ(now.str(), "{}");
}

}  // namespace
}  // namespace bench
