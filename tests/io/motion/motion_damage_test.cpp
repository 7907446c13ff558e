#include "condyle/io/recorded_motion.hpp"
#include "io/motion/load_table.hpp"
#include "io/motion/motion_text.hpp"
#include "support/test.hpp"

/// The error for a damaged file is one line that names the place. Each kind of file is damaged in turn.

namespace condyle {
namespace {

using test::expect_complaints;
using test::replaced;

const auto only_read = [](const std::filesystem::path& path) { io::read_motion_table(path); };

/// Kinds of damage that any OpenSim table can have.
const std::string mot =
    "Coordinates\nversion=1\nnRows=3\nnColumns=3\ninDegrees=yes\nendheader\ntime hip_flexion_r "
    "hip_adduction_r\n"
    "0.4 1.5 2.5\n0.5 3.5 4.5\n0.6 5.5 6.5\n";

TEST(DamagedMotion, Mot) {
  const auto with = [](std::string_view from, std::string_view to) { return replaced(mot, from, to); };
  expect_complaints(
      "walk.mot", mot,
      {{"", "is empty"},
       {" \r\n\n", "is empty"},
       {with("endheader\n", ""), "has no line 'endheader': the header does not end"},
       {mot.substr(0, mot.find("time")), "has no names of columns after 'endheader'"},
       {mot.substr(0, mot.find("0.4")), "has no rows of numbers"},
       {with(" 4.5", ""), "line 9: has 2 values, and there are 3 columns"},
       {with(" 4.5", " 4.5 7"), "line 9: has 4 values, and there are 3 columns"},
       {with("hip_adduction_r", "hip_adduction_r knee_angle_r"),
        "line 8: has 3 values, and there are 4 columns"},
       {with("3.5", "3,5"), "line 9: column 'hip_flexion_r': '3,5' should be a number"},
       {with("3.5", "3.5e"), "line 9: column 'hip_flexion_r': '3.5e' should be a number"},
       {with("3.5", "0x3"), "line 9: column 'hip_flexion_r': '0x3' should be a number"},
       {with("3.5", "1e999"), "line 9: column 'hip_flexion_r': '1e999' should be a number"},
       {with("3.5", "-inf"), "line 9: column 'hip_flexion_r': '-inf' is not finite"},
       {with("3.5",
             "\x01"
             "2"),
        "line 9: column 'hip_flexion_r': '?2' should be a number"},
       {with("hip_adduction_r", "hip_flexion_r"), "line 7: column 'hip_flexion_r' is there twice"},
       {with("time hip_flexion_r hip_adduction_r\n", ""),
        "line 7: '0.4' should be the name of column 1: the names of the columns are missing"},
       {with("0.5 3.5", "0.4 3.5"),
        "line 9: column 'time': 0.4 does not come after 0.4: times must increase"},
       {with("0.6 5.5", "0.3 5.5"),
        "line 10: column 'time': 0.3 does not come after 0.5: times must increase"},
       {with("0.5 3.5", "nan 3.5"), "line 9: column 'time': a time must not be a gap"},
       {with("0.5 3.5", "\n0.5 3.5"), "line 9: is empty, and rows follow"},
       {with("inDegrees=yes", "inDegrees=perhaps"), "line 5: inDegrees: must be yes or no, not 'perhaps'"},
       {with("version=1", "inDegrees=no"), "line 5: 'inDegrees' is given twice, with different values"},
       {with("nRows=3", "nRows=three"), "line 3: nRows: 'three' should be a whole number"},
       {with("version=1", "DataType=Vec3"), "line 2: DataType: must be double, not 'Vec3'"}},
      only_read);
}

const std::string states =
    "States\ninDegrees=no\nendheader\n"
    "time\t/jointset/knee_r/knee_flex_r/value\t/jointset/knee_r/knee_flex_r/speed\t/jointset/knee_r/"
    "knee_tx_r/value\n"
    "0\t0.5\t0\t0.001\n0.01\t0.6\t0\t0.002\n";

TEST(DamagedMotion, States) {
  const auto with = [](std::string_view from, std::string_view to) { return replaced(states, from, to); };
  const std::string flexion = "/jointset/knee_r/knee_flex_r/value",
                    others = ", '/jointset/knee_r/knee_flex_r/speed', '/jointset/knee_r/knee_tx_r/value'";
  expect_complaints(
      "passive.sto", states,
      {{with("knee_flex_r/value", "knee_flx_r/value"),
        "has no column 'knee_flex_r' (did you mean \"knee_flx_r\"?); it has 'time', "
        "'/jointset/knee_r/knee_flx_r/value'" +
            others},
       {with("knee_flex_r/value", "knee_r/angle/value"),
        "has no column 'knee_flex_r'; it has 'time', '/jointset/knee_r/knee_r/angle/value'" + others},
       {with("knee_flex_r/speed", "x/knee_flex_r/value"),
        "column 'knee_flex_r' could be '/jointset/knee_r/knee_flex_r/value' or "
        "'/jointset/knee_r/x/knee_flex_r/value': give the whole name"},
       {with("inDegrees=no\n", ""),
        "column 'knee_flex_r': the file does not say whether angles are in degrees: give its unit"},
       {with("knee_flex_r/speed", "knee_flex_r/value"), "line 4: column '" + flexion + "' is there twice"},
       {with("0.6", "0.6rad"), "line 6: column '" + flexion + "': '0.6rad' should be a number"},
       {with("0.6", "infinity"), "line 6: column '" + flexion + "': 'infinity' is not finite"},
       {with("\t0.002", ""), "line 6: has 3 values, and there are 4 columns"},
       {with("0.01\t", "-0.01\t"), "line 6: column 'time': -0.01 does not come after 0: times must increase"},
       {with("endheader", "endheaders"), "has no line 'endheader': the header does not end"},
       {states.substr(0, states.find("0\t0.5")), "has no rows of numbers"},
       {with("0.01\t0.6\t0\t", "0.01\t0.6\t0\t0.002\n0.02\t"),
        "line 7: has 2 values, and there are 4 columns"}},
      [](const std::filesystem::path& path) {
        io::recorded_coordinates(io::read_motion_table(path),
                                 {{.coordinate = "flexion", .column = "knee_flex_r"},
                                  {.coordinate = "x",
                                   .kind = io::CoordinateKind::length,
                                   .column = "knee_tx_r",
                                   .unit = io::ColumnUnit::metres}});
      });
}

/// A table of 4 x 4 matrices: F stands still, M turns about Z by 90 degrees.
std::string names(const std::string& body) {
  std::string line;
  for (const char row : {'1', '2', '3', '4'})
    for (const char column : {'1', '2', '3', '4'}) line += '\t' + body + "_T" + row + column;
  return line;
}
const std::string identity = "\t1\t0\t0\t0\t0\t1\t0\t0\t0\t0\t1\t0\t0\t0\t0\t1";
const std::string quarter = "\t0\t-1\t0\t10\t1\t0\t0\t20\t0\t0\t1\t30\t0\t0\t0\t1";
const std::string matrices = "nRows=2\nendheader\ntime" + names("F") + names("tibia") + "\n0" + identity +
                             quarter + "\n1" + identity + quarter + "\n";

TEST(DamagedMotion, Matrices) {
  const auto with = [](std::string_view from, std::string_view to) { return replaced(matrices, from, to); };
  const auto with_last = [](const std::string& matrix) {
    return matrices.substr(0, matrices.size() - quarter.size() - 1) + matrix + "\n";
  };
  expect_complaints(
      "mri.sto", matrices,
      {{with("tibia_T11", "tibai_T11"),
        "has no columns of body 'tibia' (did you mean \"tibai\"?): they are named tibia_T11 to tibia_T44, or "
        "tibia_R11 to tibia_1; it has 'F', 'tibai'"},
       {with("tibia_T23", "tibia_X23"), "has no column 'tibia_T23'"},
       {with("tibia_T23", "tibia_T22"), "line 3: column 'tibia_T22' is there twice"},
       {with_last("\t0\t-1\t0\t10\t1\t0\t0\t20\t0\t0\t1\t30\t0\t0\t0\t2"),
        "line 5: the matrix of 'tibia' has 0 0 0 1 neither in its last row nor in its last column"},
       {with_last("\t0\t1\t0\t0\t-1\t0\t0\t0\t0\t0\t1\t0\t10\t20\t30\t1"),
        "line 5: the matrix of 'tibia' has 0 0 0 1 in its last column, and those before it in their last "
        "row"},
       {with_last("\t0\t-1\t0\t10\t1\t0\t0\t20\t0\t0\t-1\t30\t0\t0\t0\t1"),
        "line 5: the matrix of 'tibia' is a reflection, not a rotation: its determinant is -1"},
       {with_last("\t0\t-1\t0\t10\t1\t0\t0\t20\t0\t0\t1.001\t30\t0\t0\t0\t1"),
        "line 5: the matrix of 'tibia' is no rotation: off by 0.002, more than 0.0001"},
       {with_last("\t0\t-1000\t0\t10\t1000\t0\t0\t20\t0\t0\t1000\t30\t0\t0\t0\t1"),
        "line 5: the matrix of 'tibia' is no rotation: off by 1e+06, more than 0.0001"},
       {with_last("\t0\t0\t0\t10\t0\t0\t0\t20\t0\t0\t0\t30\t0\t0\t0\t1"),
        "line 5: the matrix of 'tibia' is no rotation: off by 1, more than 0.0001"},
       {with_last("\t0\t-1\t0\t10\t1\t0\t0\t20\t0\t0\t1\t30\t0\t0\t0"),
        "line 5: has 32 values, and there are 33 columns"},
       {with("\t30\t", "\tmm\t"), "line 4: column 'tibia_T34': 'mm' should be a number"},
       {with("\t30\t", "\tinf\t"), "line 4: column 'tibia_T34': 'inf' is not finite"},
       {with("\n1\t", "\n-1\t"), "line 5: column 'time': -1 does not come after 0: times must increase"}},
      [](const std::filesystem::path& path) {
        io::recorded_poses(io::read_motion_table(path), {"F", "tibia", {}});
      });
}

/// As XMALab writes it, its second TY included; filtered at 25 Hz.
std::string xmalab_names(const std::string& body) {
  std::string line;
  for (const char* name : {"_R11", "_R12", "_R13", "_01", "_R21", "_R22", "_R23", "_02", "_R31", "_R32",
                           "_R33", "_03", "_TX", "_TY", "_TY", "_1"})
    line += " , " + body + name + "_25Hz";
  return line;
}
const std::string xmalab_identity = " , 1 , 0 , 0 , 0 , 0 , 1 , 0 , 0 , 0 , 0 , 1 , 0 , 0 , 0 , 0 , 1";
const std::string xmalab_quarter = " , 0 , 1 , 0 , 0 , -1 , 0 , 0 , 0 , 0 , 0 , 1 , 0 , 10 , 20 , 30 , 1";
const std::string xmalab = "Frame" + xmalab_names("F") + xmalab_names("M") + "\n1" + xmalab_identity +
                           xmalab_quarter + "\n2" + xmalab_identity + xmalab_quarter + "\n";

TEST(DamagedMotion, Xmalab) {
  const auto with = [](std::string_view from, std::string_view to) { return replaced(xmalab, from, to); };
  const auto with_last = [](const std::string& matrix) {
    return xmalab.substr(0, xmalab.size() - xmalab_quarter.size() - 1) + matrix + "\n";
  };
  expect_complaints(
      "xmalab.csv", xmalab,
      {{with("M_R11", "m_R11"),
        "has no columns of body 'M': they are named M_T11 to M_T44, or M_R11 to M_1; it has 'F', 'm'"},
       {with("M_R11_25Hz", "M_R11_50Hz"), "has no column 'M_R12_50Hz'"},
       {with("M_02", "M_R11_50Hz"), "body 'M' has two sets of columns: 'M_R11_25Hz' and 'M_R11_50Hz_25Hz'"},
       {with("M_02", "M_01"), "line 1: column 'M_01_25Hz' is there twice"},
       {with("M_TX", "M_TY"), "line 1: column 'M_TY_25Hz' is there twice"},
       {with("Frame" + xmalab_names("F") + xmalab_names("M") + "\n", ""),
        "line 1: '1' should be the name of column 1: the names of the columns are missing"},
       {with_last(" , 0 , -1 , 0 , 10 , 1 , 0 , 0 , 20 , 0 , 0 , 1 , 30 , 0 , 0 , 0 , 1"),
        "line 3: the matrix of 'M' has 0 0 0 1 in its last row, and those before it in their last column"},
       {with_last(" , 0 , 1 , 0 , 0 , -1 , 0 , 0 , 0 , 0 , 0 , 1 , 0.5 , 10 , 20 , 30 , 1"),
        "line 3: the matrix of 'M' has 0 0 0 1 neither in its last row nor in its last column"},
       {with_last(" , 0 , 1 , 0 , 0 , 1 , 0 , 0 , 0 , 0 , 0 , 1 , 0 , 10 , 20 , 30 , 1"),
        "line 3: the matrix of 'M' is a reflection, not a rotation: its determinant is -1"},
       {with_last(" , 0 , 1.1 , 0 , 0 , -1 , 0 , 0 , 0 , 0 , 0 , 1 , 0 , 10 , 20 , 30 , 1"),
        "line 3: the matrix of 'M' is no rotation: off by 0.21, more than 0.0001"},
       {with_last(xmalab_quarter + " , "), "line 3: has 34 values, and there are 33 columns"},
       {with("30", "3 0"), "line 2: column 'M_TZ_25Hz': '3 0' should be a number"},
       {with("30", "INF"), "line 2: column 'M_TZ_25Hz': 'INF' is not finite"},
       {with("\n2 ", "\n0 "), "line 3: column 'Frame': 0 does not come after 1: times must increase"}},
      [](const std::filesystem::path& path) {
        io::recorded_poses(io::read_motion_table(path), {"F", "M", {}});
      });
}

const std::string csv = "# of a goniometer\ntime,flexion,rotation\n0,1.5,2.5\n0.1,3.5,4.5\n0.2,,6.5\n";

TEST(DamagedMotion, Csv) {
  const auto with = [](std::string_view from, std::string_view to) { return replaced(csv, from, to); };
  expect_complaints(
      "arm.csv", csv,
      {{"# only a comment\n", "has no names of columns"},
       {"time,flexion\n", "has no rows of numbers"},
       {"time;flexion\n0,5;1\n", "line 1: 'time;flexion': columns must be separated by commas"},
       {"time\tflexion\n0\t1\n", "line 1: 'time?flexion': columns must be separated by commas"},
       {with(",flexion,", ",,"), "line 2: column 2 has no name"},
       {with("rotation", "flexion"), "line 2: column 'flexion' is there twice"},
       {with("rotation", "\"rotation"), "line 2: a quote is not closed"},
       {with("4.5", "4.5,9"), "line 4: has 4 values, and there are 3 columns"},
       {with(",4.5", ""), "line 4: has 2 values, and there are 3 columns"},
       {with("3.5", "x"), "line 4: column 'flexion': 'x' should be a number"},
       {with("3.5", "1 2"), "line 4: column 'flexion': '1 2' should be a number"},
       {with("3.5", "Inf"), "line 4: column 'flexion': 'Inf' is not finite"},
       {with("0.2,", ","), "line 5: column 'time': a time must not be a gap"},
       {with("0.2,", "0.1,"), "line 5: column 'time': 0.1 does not come after 0.1: times must increase"},
       {with("\n0.2", "\n\n0.2"), "line 5: is empty, and rows follow"},
       {with("time,flexion,rotation\n", ""),
        "line 2: '0' should be the name of column 1: the names of the columns are missing"},
       {with("flexion", "flexoin"),
        "has no column 'flexion' (did you mean \"flexoin\"?); it has 'time', 'flexoin', 'rotation'"}},
      [](const std::filesystem::path& path) {
        io::recorded_coordinates(
            io::read_motion_table(path),
            {{.coordinate = "flexion", .column = "flexion", .unit = io::ColumnUnit::degrees}});
      });
}

const std::string loads = "time,force_x_n,force_y_n,force_z_n\n0,0,-1000,0\n0.1,0,-1500,0\n0.2,,,\n";

TEST(DamagedMotion, Loads) {
  const io::FrameTimes times{{0, 0.1, 0.2}};
  const auto with = [](std::string_view from, std::string_view to) { return replaced(loads, from, to); };
  const auto read = [&](bool free_rotations) {
    return [&times, free_rotations](const std::filesystem::path& path) {
      io::loads_of(io::read_motion_table(path), times, BodyRole::fixed, free_rotations);
    };
  };
  const std::string beside =
      "time,force_x_n,force_y_n,force_z_n,moment_x_nmm,moment_z_nmm\n0,0,-1,0,1,2\n0.1,0,-1,0,1,2\n0.2,0,-1,"
      "0,"
      "1,2\n";
  expect_complaints(
      "loads.csv", loads,
      {{"", "is empty"},
       {"time,force_x_n,force_y_n,force_z_n\n", "has no rows of numbers"},
       {with("force_y_n", "force_y"),
        "has no column 'force_y_n' (did you mean \"force_y\"?); it has 'time', 'force_x_n', 'force_y', "
        "'force_z_n'"},
       {with("force_z_n", "force_y_n"), "line 1: column 'force_y_n' is there twice"},
       {with("-1500", "-15oo"), "line 3: column 'force_y_n': '-15oo' should be a number"},
       {with("-1500", "-inf"), "line 3: column 'force_y_n': '-inf' is not finite"},
       {with("-1500,0", "-1500"), "line 3: has 3 values, and there are 4 columns"},
       {with("0.1,", "0.15,"),
        "line 3: is at 0.15, and the motion at 0.1: its rows are not at the times of the motion"},
       {with("0.2,,,\n", ""), "has 2 rows, and the motion 3: its rows are not at the times of the motion"},
       {with("0.2,", ","), "line 4: column 'time': a time must not be a gap"},
       {with("\n0.1", "\n\n0.1"), "line 3: is empty, and rows follow"},
       {beside, "column 'moment_x_nmm': moments are balanced with --free-rotations only"}},
      read(false));
  EXPECT_EQ(test::refusal("loads.csv", beside, read(true)),
            "has no column 'moment_y_nmm'; it has 'time', 'force_x_n', 'force_y_n', 'force_z_n', "
            "'moment_x_nmm', 'moment_z_nmm'");
  std::string names = "time", values;
  for (int c = 0; c < 25; ++c) names += ",c" + std::to_string(c), values += ",1";
  const std::string table = names + "\n0" + values + "\n0.1" + values + "\n0.2" + values + "\n";
  const std::string many = test::refusal("loads.csv", table, read(false));
  test::expect_says(many, "'c18' and 6 more");
}

TEST(RecordedLoads, AFrameWithAGapHasNone) {
  const io::FrameTimes times{{0, 0.1, 0.2}};
  const auto given = io::loads_of(test::read_table("loads.csv", loads), times, BodyRole::mobile, false);
  ASSERT_EQ(given.size(), 3u);
  EXPECT_EQ(given[1]->on_mobile.force_n, Vec3(0, -1500, 0));
  EXPECT_EQ(given[1]->on_mobile.moment_nmm, Vec3(0, 0, 0));
  EXPECT_EQ(given[1]->frame, BodyRole::mobile);
  EXPECT_FALSE(given[2]);
}

/// Turned by a quarter about z, a force along the mobile body's x is along the fixed one's y.
TEST(RecordedLoads, AreZeroWhereNothingActsAlongWhatIsFree) {
  Pose X_FM = Pose::Identity();
  X_FM.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const contact::Load fixed{.on_mobile = {{3, 0, 0}, {}}},
      mobile{.on_mobile = {{3, 0, 0}, {}}, .frame = BodyRole::mobile};
  const contact::Load moment{.on_mobile = {{0, 0, 0}, {0, 1, 0}}};
  EXPECT_TRUE(contact::is_zero_along({}, X_FM, {}));
  EXPECT_FALSE(contact::is_zero_along(fixed, X_FM, {}));
  const contact::BalanceOptions along_y{.free_directions = {Vec3(0, 2, 0)}};
  EXPECT_TRUE(contact::is_zero_along(fixed, X_FM, along_y));
  EXPECT_FALSE(contact::is_zero_along(mobile, X_FM, along_y));
  EXPECT_TRUE(contact::is_zero_along(moment, X_FM, {}));
  EXPECT_FALSE(contact::is_zero_along(moment, X_FM, {.free_rotations = true}));
}

/// The same mutations every time: bytes exchanged, pieces left out and repeated, ends cut off.
std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t end) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(end, 1));
  };
  for (std::size_t changes = 1 + below(3); changes > 0 && !text.empty(); --changes) {
    const std::size_t at = below(text.size()), length = below(20);
    switch (random() % 4) {
      case 0:
        text[at] = "0123456789 .,-+eEnaif=\t\n\r\"#\xFF"[below(28)];
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      default:
        text.resize(at);
    }
  }
  return text;
}

TEST(DamagedMotion, AnyBytesGiveAWholeTableOrOneLine) {
  std::mt19937 random(1);
  std::size_t read = 0, refused = 0;
  for (const auto& [name, text] : {std::pair<const char*, std::string>{"a.mot", mot},
                                   {"b.sto", states},
                                   {"c.sto", matrices},
                                   {"d.csv", xmalab},
                                   {"e.csv", csv}})
    for (int i = 0; i < 300; ++i) {
      const std::string bytes = mutated(text, random);
      const std::string complaint = test::refusal(name, bytes, [&](const std::filesystem::path& path) {
        const io::MotionTable table = io::read_motion_table(path);
        ASSERT_GT(table.rows, 0u);
        ASSERT_EQ(table.values.size(), table.columns.size());
        ASSERT_EQ(table.line_of_row.size(), table.rows);
        for (const std::vector<double>& column : table.values) {
          ASSERT_EQ(column.size(), table.rows);
          for (const double value : column) ASSERT_FALSE(std::isinf(value));
        }
        ASSERT_EQ(std::set<std::string>(table.columns.begin(), table.columns.end()).size(),
                  table.columns.size());
      });
      ++(complaint == "accepted" ? read : refused);
    }
  // Both happen, so that both are tested.
  EXPECT_GT(read, 100u);
  EXPECT_GT(refused, 100u);
}

TEST(DamagedMotion, FilesThatAreNone) {
  const test::TemporaryFolder folder;
  const auto complaint = [](const std::filesystem::path& path) {
    return test::complaint_of<FileError>([&] { io::read_motion_table(path); });
  };
  std::filesystem::create_directories(folder / "folder.mot");
  EXPECT_EQ(complaint(folder / "missing.mot"), (folder / "missing.mot").string() + ": no such file");
  EXPECT_EQ(complaint(folder / "folder.mot"), (folder / "folder.mot").string() + ": is a folder, not a file");
  const auto unknown = folder.file("walk.c3d", mot);
  EXPECT_EQ(complaint(unknown),
            unknown.string() + ": unknown extension '.c3d': .mot, .sto and .csv are read");
}

}  // namespace
}  // namespace condyle
