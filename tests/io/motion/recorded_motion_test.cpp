#include "condyle/io/recorded_motion.hpp"

#include <fmt/format.h>

#include "core/predicates.hpp"
#include "io/motion/motion_text.hpp"
#include "io/motion/some_pose.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

using test::read_table;
using test::replaced;
using Strings = std::vector<std::string>;
using Frame = std::optional<std::vector<double>>;

constexpr double degree = std::numbers::pi / 180;

TEST(RecordedCoordinates, UnitSignAndOffsetAreApplied) {
  const io::MotionTable table = read_table("a.csv", "time,a,b,c,d\n0,90,0.5,1.25,2\n1,-30,-0.25,2,4\n");
  const io::NamedCoordinates out = io::recorded_coordinates(
      table,
      {{.coordinate = "flexion", .column = "a", .unit = io::ColumnUnit::degrees, .sign = -1, .offset = 5},
       {.coordinate = "adduction", .column = "b", .unit = io::ColumnUnit::radians},
       {.coordinate = "x", .kind = io::CoordinateKind::length, .column = "c", .unit = io::ColumnUnit::metres},
       {.coordinate = "y",
        .kind = io::CoordinateKind::length,
        .column = "d",
        .unit = io::ColumnUnit::millimetres,
        .sign = -1,
        .offset = 0.5}});
  EXPECT_EQ(out.names, (Strings{"flexion", "adduction", "x", "y"}));
  EXPECT_EQ(out.frames, (std::vector<Frame>{{{-85, 0.5 * (180 / std::numbers::pi), 1250, -1.5}},
                                            {{35, -0.25 * (180 / std::numbers::pi), 2000, -3.5}}}));
  EXPECT_EQ(out.times.values, (std::vector<double>{0, 1}));
  EXPECT_EQ(out.processing, Strings{});
}

TEST(RecordedCoordinates, AnglesAreAsTheHeaderSays) {
  const std::string sto = "inDegrees=no\nendheader\ntime a\n0 1\n";
  const auto angle = [](const std::string& text, std::optional<io::ColumnUnit> unit) {
    return io::recorded_coordinates(read_table("a.sto", text),
                                    {{.coordinate = "flexion", .column = "a", .unit = unit}})
        .frames[0]
        ->front();
  };
  EXPECT_EQ(angle(sto, {}), 180 / std::numbers::pi);
  EXPECT_EQ(angle(replaced(sto, "=no", "=yes"), {}), 1);
  EXPECT_EQ(angle(sto, io::ColumnUnit::radians), 180 / std::numbers::pi);
  EXPECT_EQ(angle(replaced(sto, "=no", "=yes"), io::ColumnUnit::degrees), 1);
}

TEST(RecordedCoordinates, RadiansUnderAHeaderThatSaysDegreesAreNoted) {
  const auto notes = [](std::string_view header, std::string_view rows,
                        std::optional<io::ColumnUnit> unit = {}) {
    return io::recorded_coordinates(
               read_table("a.sto", fmt::format("inDegrees={}\nendheader\ntime a b\n{}", header, rows)),
               {{.coordinate = "flexion", .column = "a", .unit = unit},
                {.coordinate = "adduction", .column = "b"}})
        .notes;
  };
  const char* radians = "0 -0.3 0.05\n0.1 0.2 0.1\n0.2 0.7 0.02\n";
  const auto noted = notes("yes", radians);
  ASSERT_EQ(noted.size(), 1u);
  EXPECT_EQ(noted[0].code, motion::ContactNoteCode::unlikely_angle);
  test::expect_says(noted[0].text, "inDegrees=yes");
  EXPECT_TRUE(notes("no", radians).empty());
  EXPECT_TRUE(notes("yes", "0 -17 3\n0.1 11 6\n0.2 40 1\n").empty());
  EXPECT_TRUE(notes("yes", "0 -0.3 30\n0.1 0.2 60\n0.2 0.7 0\n").empty()) << "one column moves as in degrees";
}

TEST(RecordedCoordinates, AUnitThatContradictsTheHeaderIsRefused) {
  const auto refused = [](const char* header, io::ColumnUnit unit) {
    return test::refusal("a.sto", std::string(header) + "\nendheader\ntime /j/k/a/value\n0 1\n",
                         [&](const auto& path) {
                           io::recorded_coordinates(io::read_motion_table(path),
                                                    {{.coordinate = "flexion", .column = "a", .unit = unit}});
                         });
  };
  EXPECT_EQ(
      refused("inDegrees=yes", io::ColumnUnit::radians),
      "column 'a': its unit is given as radians, and the header says inDegrees=yes: leave the unit out, "
      "or correct the header");
  EXPECT_EQ(refused("inDegrees=no", io::ColumnUnit::degrees),
            "column 'a': its unit is given as degrees, and the header says inDegrees=no: leave the unit out, "
            "or correct the header");
  EXPECT_EQ(refused("title", io::ColumnUnit::radians), "accepted") << "no header says it";
}

TEST(RecordedCoordinates, AFrameWithAGapIsAGapAndOnlyInColumnsThatAreNeeded) {
  const io::MotionTable table = read_table("a.csv", "time,a,b,c\n0,1,2,\n1,,2,3\n2,1,nan,3\n3,1,2,3\n");
  const io::NamedCoordinates out = io::recorded_coordinates(
      table, {{.coordinate = "flexion", .column = "a", .unit = io::ColumnUnit::degrees},
              {.coordinate = "adduction", .column = "b", .unit = io::ColumnUnit::degrees}});
  EXPECT_EQ(out.frames, (std::vector<Frame>{{{1, 2}}, std::nullopt, std::nullopt, {{1, 2}}}));
  EXPECT_EQ(out.processing,
            Strings{"2 of 4 frames are gaps, the first in line 3: they are left out, not interpolated"});
}

TEST(RecordedCoordinates, AWholeNameGoesBeforeTheCoordinateOfAPath) {
  const io::MotionTable table =
      read_table("a.sto", "inDegrees=yes\nendheader\ntime /j/k/flex/value /j/k/flex/speed flex\n0 1 2 3\n");
  const auto value = [&](const char* column) {
    return io::recorded_coordinates(table, {{.coordinate = "flexion", .column = column}}).frames[0]->front();
  };
  EXPECT_EQ(value("flex"), 3);
  EXPECT_EQ(value("/j/k/flex/value"), 1);
  EXPECT_EQ(value("/j/k/flex/speed"), 2);
}

/// 16 numbers of a body's pose, row by row: translation in the last column, or transposed.
std::string cells(const Pose& X, bool transposed) {
  std::string text;
  const Eigen::Matrix4d matrix = transposed ? Eigen::Matrix4d(X.matrix().transpose()) : X.matrix();
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index j = 0; j < 4; ++j) text += fmt::format(",{}", matrix(i, j));
  return text;
}

Strings jam_names(const std::string& body) {
  Strings names;
  for (const char row : {'1', '2', '3', '4'})
    for (const char column : {'1', '2', '3', '4'}) names.push_back(body + "_T" + row + column);
  return names;
}

Strings xmalab_columns(const std::string& body) {
  Strings names;
  for (const char* name : {"R11", "R12", "R13", "01", "R21", "R22", "R23", "02", "R31", "R32", "R33", "03",
                           "TX", "TY", "TY", "1"})
    names.push_back(body + "_" + name);
  return names;
}

std::string csv_of(const Strings& fixed_names, const Strings& mobile_names,
                   const std::vector<std::pair<Pose, Pose>>& frames, bool transposed) {
  std::string text;
  for (const Strings* names : {&fixed_names, &mobile_names})
    for (const std::string& name : *names) text += (text.empty() ? "" : ",") + name;
  for (const auto& [X_LF, X_LM] : frames)
    text += "\n" + (cells(X_LF, transposed) + cells(X_LM, transposed)).substr(1);
  return text + "\n";
}

const std::vector<std::pair<Pose, Pose>> frames = {
    {test::some_pose(0.3, {1, 2, 3}, {100, -200, 50}), test::some_pose(-1.2, {3, -1, 2}, {110, -190, 20})},
    {test::some_pose(2.9, {0, 2, -1}, {10, 0, 5}), test::some_pose(0.7, {1, 1, 1}, {12, -400, 2})}};

/// A product of two matrices of a rotation and of a difference of places below 700 mm, each entry three products.
constexpr double rounding = 16 * core::rounding_unit;

void expect_X_FM(const io::RecordedPoses& poses, double scale) {
  ASSERT_EQ(poses.X_FM.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    ASSERT_TRUE(poses.X_FM[i]);
    const auto& [X_LF, X_LM] = frames[i];
    const Eigen::Matrix3d R = X_LF.linear().transpose() * X_LM.linear();
    const Vec3 p = scale * (X_LF.linear().transpose() * (X_LM.translation() - X_LF.translation()));
    EXPECT_LE((poses.X_FM[i]->linear() - R).cwiseAbs().maxCoeff(), rounding);
    EXPECT_LE((poses.X_FM[i]->translation() - p).cwiseAbs().maxCoeff(), rounding * scale * 700);
  }
}

TEST(RecordedPoses, BothConventionsAreToldByWhere0001Stands) {
  for (const bool transposed : {false, true})
    for (const bool of_jam : {false, true}) {
      const io::MotionTable table =
          read_table("a.csv", of_jam ? csv_of(jam_names("F"), jam_names("M"), frames, transposed)
                                     : csv_of(xmalab_columns("F"), xmalab_columns("M"), frames, transposed));
      expect_X_FM(io::recorded_poses(table, {"F", "M", LengthUnit::millimetres}), 1);
      expect_X_FM(io::recorded_poses(table, {"F", "M", LengthUnit::metres}), 1000);
    }
}

TEST(RecordedPoses, WithoutAnyTranslationTheNamesTell) {
  std::vector<std::pair<Pose, Pose>> turned = {
      {Pose::Identity(), test::some_pose(0.5, {0, 0, 1}, {0, 0, 0})}};
  const double c = std::cos(0.5), s = std::sin(0.5);
  for (const bool of_jam : {false, true}) {
    const io::RecordedPoses poses = io::recorded_poses(
        read_table("a.csv", of_jam ? csv_of(jam_names("F"), jam_names("M"), turned, false)
                                   : csv_of(xmalab_columns("F"), xmalab_columns("M"), turned, true)),
        {"F", "M", {}});
    EXPECT_NEAR(poses.X_FM[0]->linear()(0, 0), c, rounding);
    EXPECT_NEAR(poses.X_FM[0]->linear()(1, 0), s, rounding);
    ASSERT_FALSE(poses.processing.empty());
    test::expect_says(poses.processing.back(), "no matrix has a translation");
  }
}

TEST(RecordedPoses, AGapInEitherBodyIsAGap) {
  std::string text =
      csv_of(jam_names("F"), jam_names("M"), {frames[0], frames[1], frames[0], frames[1]}, false);
  std::vector<std::size_t> ends;
  for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1)) ends.push_back(at);
  // The last number of row 2, and the first of row 1.
  text.replace(text.rfind(',', ends[3]) + 1, ends[3] - text.rfind(',', ends[3]) - 1, "NaN");
  text.replace(ends[1] + 1, text.find(',', ends[1]) - ends[1] - 1, "");
  const io::RecordedPoses poses = io::recorded_poses(read_table("a.csv", text), {"F", "M", {}});
  EXPECT_TRUE(poses.X_FM[0]);
  EXPECT_FALSE(poses.X_FM[1]);
  EXPECT_FALSE(poses.X_FM[2]);
  EXPECT_TRUE(poses.X_FM[3]);
  EXPECT_EQ(poses.times.values, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_FALSE(poses.times.in_seconds);
}

/// A rotation with one column stretched by e has singular values 1, 1, 1 + e and the rotation as its nearest one.
TEST(RecordedPoses, RotationsThatAreALittleOffBecomeTheNearestOnes) {
  for (const double stretch : {1e-12, 0.9e-9, 4.9e-5}) {
    Pose X_LM = frames[0].second;
    X_LM.linear().col(1) *= 1 + stretch;
    const io::RecordedPoses poses = io::recorded_poses(
        read_table("a.csv", csv_of(jam_names("F"), jam_names("M"), {{frames[0].first, X_LM}}, false)),
        {"F", "M", {}});
    const Eigen::Matrix3d R = frames[0].first.linear().transpose() * frames[0].second.linear();
    // The singular value decomposition is good to some units of rounding.
    EXPECT_LE((poses.X_FM[0]->linear() - R).cwiseAbs().maxCoeff(), 4 * rounding) << stretch;
    // (1 + e)^2 - 1 = 2 e + e^2 is what it is off by.
    EXPECT_EQ(poses.processing.size(), 2 * stretch > 1e-9 ? 1u : 0u) << stretch;
    if (stretch > 1e-6) {
      EXPECT_EQ(poses.processing[0],
                "rotations are orthonormal to 9.8e-05 only (line 2, 'M'): the nearest ones are used");
    }
  }
}

/// R = Rz(-flexion) Rx(adduction) Ry(rotation), so R21 = sin a, R01 = sin f cos a, R20 = -cos a sin r.
Vec3 knee_angles(const Eigen::Matrix3d& R) {
  return {std::atan2(R(0, 1), R(1, 1)), std::asin(R(2, 1)), std::atan2(-R(2, 0), R(2, 2))};
}

TEST(RecordedPoses, AKneeMeasuredByMriIsWhereItsReadmeSays) {
  FOUND_OR_SKIP(folder, test::shared_data());
  const io::RecordedPoses poses = io::recorded_poses(
      io::read_motion_table(*folder / "motion_mri_knee" / "passive_body_transformations.sto"),
      {"femur_distal_r", "tibia_proximal_r", LengthUnit::metres});
  ASSERT_EQ(poses.X_FM.size(), 60u);
  struct Row {
    std::size_t row;
    Vec3 translation_mm, angles_deg;
  };
  for (const auto& [row, translation_mm, angles_deg] :
       {Row{0, {1.97015, -0.38414, -2.39974}, {26.30480, -0.27747, -0.44750}},
        Row{20, {2.44138, -1.15345, -2.36312}, {41.61138, 1.66967, -1.78322}},
        Row{40, {-0.51856, -0.27445, -1.47515}, {9.40304, -0.55334, -3.55086}}}) {
    ASSERT_TRUE(poses.X_FM[row]);
    EXPECT_LE((poses.X_FM[row]->translation() - translation_mm).cwiseAbs().maxCoeff(), 0.001) << row;
    EXPECT_LE((knee_angles(poses.X_FM[row]->linear()) / degree - angles_deg).cwiseAbs().maxCoeff(), 0.01)
        << row;
  }
  ASSERT_EQ(poses.processing.size(), 2u);
  EXPECT_EQ(poses.processing[0], "the header promises 48 rows and the file has 60: all of them are read");
  test::expect_begins(poses.processing[1], "rotations are orthonormal to ");
}

TEST(RecordedCoordinates, OfARealWalkAndARealKnee) {
  FOUND_OR_SKIP(folder, test::shared_data());
  const io::NamedCoordinates hip = io::recorded_coordinates(
      io::read_motion_table(*folder / "motion_gait2354_walk" / "subject01_walk1_ik.mot"),
      {{.coordinate = "flexion", .column = "hip_flexion_r"}});
  double least = 1000, most = -1000;
  for (const Frame& frame : hip.frames)
    least = std::min(least, frame->front()), most = std::max(most, frame->front());
  EXPECT_NEAR(least, -21.69, 0.005);
  EXPECT_NEAR(most, 21.67, 0.005);

  const io::NamedCoordinates knee = io::recorded_coordinates(
      io::read_motion_table(*folder / "knee_lenhart2015_right" / "passive_flexion_states.sto"),
      {{.coordinate = "flexion", .column = "knee_flex_r"},
       {.coordinate = "x",
        .kind = io::CoordinateKind::length,
        .column = "knee_tx_r",
        .unit = io::ColumnUnit::metres}});
  // The digits of the file, converted: a rounding of each number and one of each product.
  EXPECT_DOUBLE_EQ(knee.frames[1]->at(0), -4.166025947653313e-10 / degree);
  EXPECT_DOUBLE_EQ(knee.frames[1]->at(1), 0.4800858074338325);
}

}  // namespace
}  // namespace condyle
