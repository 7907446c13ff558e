#include "answer/records/limit_record.hpp"

#include "io/record/table_of.hpp"
#include "rom_scene.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

constexpr auto every_column = [](const FieldColumn&) { return true; };

TEST(LimitRecord, NamesEachKeyAndColumnOnce) {
  std::set<std::string> keys, columns;
  for_each_field<LimitRecord>([&](const auto& field) {
    if (*field.key == 0) return;
    EXPECT_TRUE(keys.insert(field.key).second) << field.key;
    EXPECT_NE(*field.meaning, 0) << field.key;
  });
  for (const io::ResultColumn& column : io::columns_of<LimitRecord>(Anatomy::knee, every_column)) {
    EXPECT_TRUE(columns.insert(column.name).second) << column.name;
    EXPECT_FALSE(column.meaning.empty()) << column.name;
  }
  EXPECT_GE(keys.size(), 20u);
  EXPECT_GE(columns.size(), 30u);
}

TEST(LimitRecord, HasAsManyCellsAsColumnsForAnyLimit) {
  const Joint joint = arm_and_post();
  motion::MotionLimit free;
  free.motion = {"own", JointAngle::adduction, RotationSense::negative, {}, Angle::degrees(40)};
  motion::MotionLimit contact = free;
  contact.end.reason = motion::LimitReason::contact;
  contact.end.contact = {{motion::FeatureKind::edge, 3, 17},
                         {motion::FeatureKind::face, 40},
                         {1, 2, 3},
                         {4, 5, 6},
                         motion::ContactKind::bearing};
  const RangeAnswer answer{.joint = joint, .limits = {free, contact}};
  const std::vector<io::ResultColumn> columns = io::columns_of<LimitRecord>(joint.anatomy, every_column);
  for (std::size_t i = 0; i < answer.limits.size(); ++i) {
    std::vector<std::string> cells;
    io::append_cells(cells, limit_record(answer, i), {{}, joint.anatomy}, every_column);
    ASSERT_EQ(cells.size(), columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k].name == "fixed_feature") {
        EXPECT_EQ(cells[k], i == 0 ? "" : "edge 3-17");
      }
  }
}

}  // namespace
}  // namespace condyle::test
