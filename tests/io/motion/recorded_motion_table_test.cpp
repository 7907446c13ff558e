#include "io/joint/recorded_motion_table.hpp"

#include "support/test.hpp"

namespace condyle {
namespace {

const std::array<io::CoordinateName, 3> knee = {
    io::CoordinateName{"flexion", io::CoordinateKind::angle},
    io::CoordinateName{"internal_rotation", io::CoordinateKind::angle},
    io::CoordinateName{"x", io::CoordinateKind::length}};

io::RecordedMotionMapping mapping_of(std::string_view text) {
  const toml::table file = toml::parse(text);
  const std::filesystem::path path = "knee.toml";
  io::TomlTable table(path, *file["recorded_motion"].as_table(), "recorded_motion");
  return io::recorded_motion_mapping(table, knee, {});
}

std::string refusal(std::string_view keys) {
  return test::complaint_of<FileError>([&] { mapping_of("[recorded_motion]\n" + std::string(keys)); });
}

TEST(RecordedMotionTable, GivesColumnsOfCoordinates) {
  const auto mapping = std::get<std::vector<io::ColumnOfCoordinate>>(mapping_of(
      "[recorded_motion]\nx = { column = \"knee_tx_r\", unit = \"m\" }\nflexion = \"knee_flex_r\"\n"
      "internal_rotation = { column = \"knee_rot_r\", unit = \"rad\", sign = -1, offset = 2.5 }\n"));
  ASSERT_EQ(mapping.size(), 3u);
  EXPECT_EQ(mapping[0].coordinate, "flexion");
  EXPECT_EQ(mapping[0].column, "knee_flex_r");
  EXPECT_EQ(mapping[0].unit, std::nullopt);
  EXPECT_EQ(mapping[0].sign, 1);
  EXPECT_EQ(mapping[0].offset, 0);
  EXPECT_EQ(mapping[1].coordinate, "internal_rotation");
  EXPECT_EQ(mapping[1].unit, io::ColumnUnit::radians);
  EXPECT_EQ(mapping[1].sign, -1);
  EXPECT_EQ(mapping[1].offset, 2.5);
  EXPECT_EQ(mapping[2].coordinate, "x");
  EXPECT_EQ(mapping[2].kind, io::CoordinateKind::length);
  EXPECT_EQ(mapping[2].column, "knee_tx_r");
  EXPECT_EQ(mapping[2].unit, io::ColumnUnit::metres);
}

TEST(RecordedMotionTable, GivesColumnsOfPoses) {
  const auto mapping = std::get<io::ColumnsOfPoses>(
      mapping_of("[recorded_motion]\nfixed_body = \"femur\"\nmobile_body = \"tibia\"\nunits = \"m\"\n"));
  EXPECT_EQ(mapping.fixed_body, "femur");
  EXPECT_EQ(mapping.mobile_body, "tibia");
  EXPECT_EQ(mapping.unit, LengthUnit::metres);
}

TEST(RecordedMotionTable, RefusesByLineAndKey) {
  const std::string poses = "fixed_body = \"femur\"\nmobile_body = \"tibia\"\nunits = \"m\"\n";
  EXPECT_EQ(refusal(poses), "accepted");
  EXPECT_EQ(refusal(""),
            "knee.toml: line 1: recorded_motion.fixed_body: is missing, and so are columns of flexion, "
            "internal_rotation, x");
  EXPECT_EQ(refusal("fixed_body = \"femur\"\nunits = \"m\"\n"),
            "knee.toml: line 1: recorded_motion.mobile_body: is missing");
  EXPECT_EQ(refusal("fixed_body = \"femur\"\nmobile_body = \"tibia\"\n"),
            "knee.toml: line 1: recorded_motion.units: is missing");
  EXPECT_EQ(refusal("fixed_body = \"femur\"\nmobile_body = \"femur\"\nunits = \"m\"\n"),
            "knee.toml: line 3: recorded_motion.mobile_body: must be another body than fixed_body");
  EXPECT_EQ(
      refusal("fixed_body = \"femur\"\nmobile_body = \"tibia\"\nunits = \"ft\"\n"),
      "knee.toml: line 4: recorded_motion.units: must be \"mm\" or \"cm\" or \"in\" or \"m\", not \"ft\"");
  EXPECT_EQ(refusal(poses + "flexion = \"a\"\n"),
            "knee.toml: line 5: recorded_motion.flexion: fixed_body and mobile_body give the poses already: "
            "leave one "
            "of the two out");
  EXPECT_EQ(refusal("x = \"knee_tx_r\"\n"),
            "knee.toml: line 2: recorded_motion.x: a length needs its unit: write { column = \"...\", unit = "
            "\"mm\" } "
            "or \"m\"");
  EXPECT_EQ(refusal("x = { column = \"knee_tx_r\" }\n"),
            "knee.toml: line 2: recorded_motion.x.unit: is missing");
  EXPECT_EQ(refusal("x = { column = \"knee_tx_r\", unit = \"rad\" }\n"),
            "knee.toml: line 2: recorded_motion.x.unit: must be \"mm\" or \"m\", not \"rad\"");
  EXPECT_EQ(refusal("flexion = { column = \"a\", unit = \"m\" }\n"),
            "knee.toml: line 2: recorded_motion.flexion.unit: must be \"deg\" or \"rad\", not \"m\"");
  EXPECT_EQ(refusal("flexion = { colum = \"a\" }\n"),
            "knee.toml: line 2: recorded_motion.flexion.column: is missing; there is \"colum\" (did you mean "
            "\"column\"?)");
  EXPECT_EQ(refusal("flexion = { column = \"a\", sign = 2 }\n"),
            "knee.toml: line 2: recorded_motion.flexion.sign: must be 1 or -1");
  EXPECT_EQ(refusal("flexion = \"\"\n"), "knee.toml: line 2: recorded_motion.flexion: must name a column");
  EXPECT_EQ(refusal("flexion = 3\n"),
            "knee.toml: line 2: recorded_motion.flexion: must be a table, not a whole number");
  EXPECT_EQ(refusal("flexion = \"a\"\nfexion = \"b\"\n"),
            "knee.toml: line 3: recorded_motion.fexion: unknown key (did you mean \"flexion\"?); known here: "
            "flexion, "
            "internal_rotation, x");
}

}  // namespace
}  // namespace condyle
