#include "condyle/io/recorded_motion.hpp"

#include <clocale>

#include "io/motion/motion_text.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

using test::read_table;
using test::replaced;

using Strings = std::vector<std::string>;

const std::string a_mot =
    "Coordinates\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\n\nUnits are S.I. units\nAngles are in "
    "degrees.\n\n"
    "endheader\ntime\thip_flexion_r\tpelvis_tx\n  0.4\t 19.5\t -0.25\n  0.5\t 2e1\t +.125\n";
const std::string a_csv = "# a comment\ntime,flexion,tx\n0,19.5,-0.25\n# another\n0.1,2e1,+.125\n";

TEST(MotionFile, ReadsWhatTheOpenSimHeaderIsFollowedBy) {
  const io::MotionTable table = read_table("walk.mot", a_mot);
  EXPECT_EQ(table.columns, (Strings{"time", "hip_flexion_r", "pelvis_tx"}));
  EXPECT_EQ(table.rows, 2u);
  EXPECT_EQ(table.values, (std::vector<std::vector<double>>{{0.4, 0.5}, {19.5, 20}, {-0.25, 0.125}}));
  EXPECT_EQ(table.line_of_row, (std::vector<std::size_t>{12, 13}));
  EXPECT_EQ(table.in_degrees, true);
  EXPECT_EQ(table.processing, Strings{});
  EXPECT_EQ(table.digest, io::digest_of(a_mot));
}

TEST(MotionFile, HeaderLinesComeInAnyOrderAndMayBeLeftOut) {
  const io::MotionTable table =
      read_table("a.STO", " indegrees = no \nnColumns=2\nname = of a model = x\nENDHEADER\n\nt a\n1 2\n");
  EXPECT_EQ(table.in_degrees, false);
  EXPECT_EQ(table.columns, (Strings{"t", "a"}));
  EXPECT_EQ(read_table("a.sto", "endheader\nt a\n1 2\n").in_degrees, std::nullopt);
}

TEST(MotionFile, InDegreesIsFollowedAgainstTheWordsAndANoteSaysSo) {
  const io::MotionTable table = read_table("a.mot", replaced(a_mot, "inDegrees=yes", "inDegrees=no"));
  EXPECT_EQ(table.in_degrees, false);
  EXPECT_EQ(table.processing,
            Strings{"the header says inDegrees=no and in words that angles are in degrees: inDegrees=no is "
                    "followed"});
  // Words on their own are prose that programs leave unchanged: they decide nothing.
  EXPECT_EQ(read_table("a.mot", replaced(a_mot, "inDegrees=yes\n", "")).in_degrees, std::nullopt);
}

TEST(MotionFile, WrongCountsInTheHeaderAreNoted) {
  const io::MotionTable table =
      read_table("a.mot", replaced(replaced(a_mot, "nRows=2", "nRows=1"), "nColumns=3", "nColumns=7"));
  EXPECT_EQ(table.rows, 2u);
  EXPECT_EQ(table.processing,
            (Strings{"the header promises 1 rows and the file has 2: all of them are read",
                     "the header promises 7 columns and the file has 3: all of them are read"}));
}

TEST(MotionFile, ARowThatRepeatsTheOneBeforeItIsReadOnce) {
  // OpenSim's tools write their last row twice.
  const io::MotionTable table = read_table("a.sto", a_mot + "  0.5\t 2e1\t +.125\n");
  EXPECT_EQ(table.rows, 2u);
  EXPECT_EQ(table.values, (std::vector<std::vector<double>>{{0.4, 0.5}, {19.5, 20}, {-0.25, 0.125}}));
  EXPECT_EQ(table.line_of_row, (std::vector<std::size_t>{12, 13}));
  EXPECT_EQ(table.processing, (Strings{"the header promises 2 rows and the file has 3: all of them are read",
                                       "line 14 repeats line 13, its time included: the row is read once"}));
  // Anywhere, several times, with gaps, and by any spelling of the numbers.
  const io::MotionTable more = read_table("a.csv", "time,a,b\n0,1,\n0.0,1.0,nan\n0e3,1,\n1,2,3\n1,2,3\n");
  EXPECT_EQ(more.rows, 2u);
  EXPECT_EQ(more.values[1], (std::vector<double>{1, 2}));
  EXPECT_EQ(more.line_of_row, (std::vector<std::size_t>{2, 5}));
  EXPECT_EQ(
      more.processing,
      (Strings{"line 3 repeats line 2, its time included: this row and 2 others like it are read once"}));
  // Without times, rows may be equal: a body that rests.
  EXPECT_EQ(read_table("a.csv", "a,b\n1,2\n1,2\n").rows, 2u);
  EXPECT_EQ(test::refusal("a.csv", "time,a\n0,1\n0,1.0000001\n",
                          [](const std::filesystem::path& path) { io::read_motion_table(path); }),
            "line 3: column 'time': 0 does not come after 0: times must increase");
}

TEST(MotionFile, NamesBetweenTabsMayHaveBlanks) {
  const std::string start = "inDegrees=yes\nendheader\n", rows = "0\t1\t2\n1\t3\t4\n";
  const io::MotionTable table = read_table("a.sto", start + "time\thip flexion r \t Knie, gebeugt\n" + rows);
  EXPECT_EQ(table.columns, (Strings{"time", "hip flexion r", "Knie, gebeugt"}));
  EXPECT_EQ(table.values[1], (std::vector<double>{1, 3}));
  // A tab at the end of lines, and rows with blanks between their numbers.
  EXPECT_EQ(read_table("a.sto", start + "time\ta b\tc d\t\n0 1 2\n").columns,
            (Strings{"time", "a b", "c d"}));
  // Where as many words as numbers stand there, words are names, whatever is between them.
  EXPECT_EQ(read_table("a.sto", start + "time a\tb\n" + rows).columns, (Strings{"time", "a", "b"}));
  const auto read = [](const std::filesystem::path& path) { io::read_motion_table(path); };
  EXPECT_EQ(test::refusal("a.sto", start + "time hip flexion\tknee\n" + rows, read),
            "line 4: has 3 values, and there are 4 columns");
  EXPECT_EQ(test::refusal("a.sto", start + "time\ta b\ta b\n" + rows, read),
            "line 3: column 'a b' is there twice");
}

TEST(MotionFile, ReadsCsvWithComments) {
  const io::MotionTable table = read_table("walk.csv", a_csv);
  EXPECT_EQ(table.columns, (Strings{"time", "flexion", "tx"}));
  EXPECT_EQ(table.values, (std::vector<std::vector<double>>{{0, 0.1}, {19.5, 20}, {-0.25, 0.125}}));
  EXPECT_EQ(table.line_of_row, (std::vector<std::size_t>{3, 5}));
  EXPECT_EQ(table.in_degrees, std::nullopt);
}

TEST(MotionFile, CsvNamesMayBeQuotedAndHaveBlanksAroundThem) {
  const io::MotionTable table = read_table("a.csv", " \"a, \"\"b\"\"\" , c \n\"1\", 2 \n");
  EXPECT_EQ(table.columns, (Strings{"a, \"b\"", "c"}));
  EXPECT_EQ(table.values, (std::vector<std::vector<double>>{{1}, {2}}));
}

TEST(MotionFile, GapsAreKept) {
  for (const auto& [name, text] :
       {std::pair<const char*, std::string>{"a.mot", replaced(a_mot, "19.5", "NaN")},
        {"a.mot", replaced(a_mot, "19.5", "nan")},
        {"a.mot", replaced(a_mot, "19.5", "-nan(ind)")},
        {"a.csv", replaced(a_csv, "19.5", "")},
        {"a.csv", replaced(a_csv, "19.5", " NaN ")}}) {
    const io::MotionTable table = read_table(name, text);
    EXPECT_TRUE(std::isnan(table.values[1][0])) << text;
    EXPECT_EQ(table.values[1][1], 20) << text;
  }
}

TEST(MotionFile, LineEndsMarksAndEmptyLinesAtTheEndMakeNoDifference) {
  for (const auto& [name, text] : {std::pair<const char*, std::string>{"a.mot", a_mot}, {"a.csv", a_csv}}) {
    std::string windows = "\xEF\xBB\xBF";
    for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    const io::MotionTable expected = read_table(name, text);
    for (const std::string& variant :
         {windows, windows + "\r\n \r\n", text + "\n\n\t\n", text.substr(0, text.size() - 1)}) {
      const io::MotionTable table = read_table(name, variant);
      EXPECT_EQ(table.columns, expected.columns);
      EXPECT_EQ(table.values, expected.values);
      EXPECT_EQ(table.line_of_row, expected.line_of_row);
      EXPECT_EQ(table.processing, Strings{});
    }
  }
}

TEST(MotionFile, NumbersAreTheSameInEveryLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "C"}) {
    if (std::setlocale(LC_ALL, locale) == nullptr) continue;
    EXPECT_EQ(read_table("a.mot", a_mot).values[2][0], -0.25) << locale;
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST(MotionFile, FramesAreCountedWhereThereIsNoTime) {
  const auto times = [](std::string_view text) { return io::frame_times(read_table("a.csv", text)); };
  EXPECT_EQ(times("Time,a\n0.5,1\n0.75,2\n").values, (std::vector{0.5, 0.75}));
  EXPECT_TRUE(times("Time,a\n0.5,1\n0.75,2\n").in_seconds);
  EXPECT_EQ(times("Frame,a\n11,1\n12,2\n").values, (std::vector<double>{11, 12}));
  EXPECT_FALSE(times("Frame,a\n11,1\n12,2\n").in_seconds);
  EXPECT_EQ(times("b,a\n9,1\n5,2\n").values, (std::vector<double>{0, 1}));
  EXPECT_FALSE(times("b,a\n9,1\n5,2\n").in_seconds);
}

TEST(MotionFile, TheSecondTyOfXmalabIsTz) {
  const io::MotionTable table =
      read_table("a.csv", "b_TX_9Hz , b_TY_9Hz , b_TY_9Hz , b_1_9Hz\n1 , 2 , 3 , 1\n");
  EXPECT_EQ(table.columns, (Strings{"b_TX_9Hz", "b_TY_9Hz", "b_TZ_9Hz", "b_1_9Hz"}));
  EXPECT_EQ(table.processing.size(), 1u);
}

TEST(MotionFile, ReadsRealFiles) {
  FOUND_OR_SKIP(folder, test::shared_data());
  const io::MotionTable walk =
      io::read_motion_table(*folder / "motion_gait2354_walk" / "subject01_walk1_ik.mot");
  EXPECT_EQ(walk.rows, 73u);
  EXPECT_EQ(walk.columns.size(), 24u);
  EXPECT_EQ(walk.in_degrees, true);
  EXPECT_EQ(walk.values[0].front(), 0.4);
  EXPECT_EQ(walk.values[0].back(), 1.6);
  EXPECT_EQ(walk.processing, Strings{});

  const auto knee = *folder / "knee_lenhart2015_right";
  const io::MotionTable states = io::read_motion_table(knee / "passive_flexion_states.sto");
  EXPECT_EQ(states.rows, 251u);
  EXPECT_EQ(states.in_degrees, false);
  EXPECT_EQ(states.processing, Strings{});
  const io::MotionTable contact = io::read_motion_table(knee / "passive_flexion_contact_reference.sto");
  EXPECT_EQ(contact.columns.size(), 35u);
  ASSERT_EQ(contact.processing.size(), 1u);
  test::expect_says(contact.processing[0], "inDegrees=no is followed");
}

}  // namespace
}  // namespace condyle
