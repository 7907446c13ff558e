#include "method.hpp"
#include "questions.hpp"
#include "support/test.hpp"

namespace bench {
namespace {

using condyle::TriMesh;
using condyle::Vec3;

void append(TriMesh& mesh, const TriMesh& more) {
  const auto first = static_cast<condyle::Index>(mesh.vertices.size());
  for (std::size_t v = 0; v < more.vertices.size(); ++v) mesh.vertices.push_back(more.vertices[v]);
  for (const auto& [a, b, c] : more.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
}

/// A blade of 0.02 mm that turns about z: at 20.5 degrees it passes a pin as thin, in a tenth of a degree, and at 55.5 it meets a block.
Scene blade_and_pin() {
  TriMesh fixed = condyle::test::box({5, 19, -5}, {17, 40, 5});
  append(fixed, condyle::test::box({25.28, 9.446, -1}, {25.3, 9.466, 1}));
  Scene scene{{"blade",
               condyle::JointKind::ball,
               condyle::Side::right,
               {"block and pin", fixed},
               {"blade", condyle::test::box({15, -0.01, -2}, {30, 0.01, 2})}},
              {}};
  for (const double degrees : {10.0, 20.5, 57.0, 15.0, 20.4, 60.0, 30.0, 20.6, 63.0})
    scene.poses.push_back(
        {condyle::Pose(Eigen::AngleAxisd(condyle::Angle::degrees(degrees).radians(), Vec3::UnitZ())),
         PoseKind::free});
  return scene;
}

TEST(BesideOthers, AContactShorterThanAStepIsCountedAsMissedByWhoSteps) {
  if (!method_named("fcl_obbrss")) GTEST_SKIP() << "FCL is not there";
  Report report;
  ask_beside_others(blade_and_pin(), Effort::quick, report);
  EXPECT_EQ(report.disagreements, std::vector<std::string>{});
  const auto all = std::find_if(report.tables.begin(), report.tables.end(),
                                [](const Table& table) { return table.head.name == "beside_others_all"; });
  ASSERT_NE(all, report.tables.end());
  std::map<std::string, std::int64_t> missed;
  for (const auto& row : all->rows)
    if (text(row[0], 3) == "first_contact") missed[text(row[1], 3)] = std::get<std::int64_t>(row[5]);
  EXPECT_EQ(missed.at("two meshes without a joint"), 0);
  EXPECT_EQ(missed.at("FCL, oriented boxes and swept rectangles, by 1° and bisected"), 3)
      << "all three axes are z";
}

}  // namespace
}  // namespace bench
