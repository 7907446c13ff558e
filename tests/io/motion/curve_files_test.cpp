#include "io/motion/curve_files.hpp"

#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <bit>

#include "condyle/io/recorded_motion.hpp"
#include "io/file/whole_file.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

using test::TemporaryFolder;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Doubles that lose something in fewer than 17 digits, the ends of their range, and gaps.
io::Curves some_curves() {
  return {.axis = "time",
          .at = {0, 0.1, 1.0 / 3, 1e6},
          .names = {"tf_contact.casting.total.contact_area", "b"},
          .values = {{1.0 / 3, -0.0, none, std::numeric_limits<double>::max()},
                     {none, std::numeric_limits<double>::denorm_min(),
                      1 + std::numeric_limits<double>::epsilon(), -7}}};
}

void expect_equal_columns(const std::vector<double>& read, const std::vector<double>& written) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (std::isnan(written[i]))
      EXPECT_TRUE(std::isnan(read[i]));
    else
      EXPECT_EQ(std::bit_cast<std::uint64_t>(read[i]), std::bit_cast<std::uint64_t>(written[i]))
          << written[i];
  }
}

void expect_read_back(const io::MotionTable& table, const io::Curves& curves) {
  ASSERT_EQ(table.columns.size(), 1 + curves.names.size());
  EXPECT_EQ(table.columns[0], curves.axis);
  expect_equal_columns(table.values[0], curves.at);
  for (std::size_t c = 0; c < curves.names.size(); ++c) {
    EXPECT_EQ(table.columns[c + 1], curves.names[c]);
    expect_equal_columns(table.values[c + 1], curves.values[c]);
  }
  EXPECT_EQ(table.processing, std::vector<std::string>{});
}

TEST(CurveFiles, AStoFileIsReadBackBitForBit) {
  const TemporaryFolder folder;
  for (const io::AngleUnit unit : {io::AngleUnit::degrees, io::AngleUnit::radians}) {
    io::write_sto(folder / "a.sto", "contact of a knee", some_curves(), unit);
    const io::MotionTable table = io::read_motion_table(folder / "a.sto");
    expect_read_back(table, some_curves());
    EXPECT_EQ(table.in_degrees, unit == io::AngleUnit::degrees);
  }
}

TEST(CurveFiles, ACsvFileIsReadBackBitForBit) {
  const TemporaryFolder folder;
  io::Curves curves = some_curves();
  curves.axis = "cycle_percent";
  curves.names = {"depth, greatest", "the \"other\" one"};
  io::write_curves_csv(folder / "a.csv", curves, "# version: 1\n# command: condyle, of course\n");
  expect_read_back(io::read_motion_table(folder / "a.csv"), curves);
  test::expect_begins(io::read_whole_file(folder / "a.csv"),
                      "# version: 1\n# command: condyle, of course\ncycle_percent,\"depth, greatest\",");
}

TEST(CurveFiles, WhatCouldNotBeReadBackIsNotWritten) {
  const TemporaryFolder folder;
  const auto complaint = [&](const io::Curves& curves, const char* file) {
    const std::string said = test::complaint_about<FileError>(folder / file, [&](const auto& path) {
      if (std::string_view(file) == "a.sto")
        io::write_sto(path, "title", curves, io::AngleUnit::degrees);
      else
        io::write_curves_csv(path, curves);
    });
    EXPECT_EQ(test::count_entries(folder.path()), said == "accepted" ? 1u : 0u);
    std::filesystem::remove(folder / file);
    return said;
  };
  for (const char* file : {"a.sto", "a.csv"}) {
    EXPECT_EQ(complaint(some_curves(), file), "accepted");
    const std::string refused = "cannot be written: column ",
                      blank = "'b c' has a name that cannot be read back";
    io::Curves curves = some_curves();
    curves.names[0] = "a";
    for (const auto& [name, says] : {std::pair("a", "'a' is there twice"),
                                     {"time", "'time' is there twice"},
                                     {"", "'' has a name that cannot be read back"}}) {
      curves.names[1] = name;
      EXPECT_EQ(complaint(curves, file), refused + says);
    }
    curves.names[1] = "b c";
    EXPECT_EQ(complaint(curves, file), std::string_view(file) == "a.csv" ? "accepted" : refused + blank);
    curves.names[1] = "b";
    curves.values[1][2] = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(complaint(curves, file), refused + "'b' has a number that is not finite");
  }
}

/// A line is its own interpolation; a parabola's is off by (t - a)(b - t) between frames a and b.
TEST(CycleOf, IsLinearBetweenFrames) {
  io::Curves curves{.axis = "time", .at = {1, 2, 4, 8}, .names = {"line", "parabola"}, .values = {{}, {}}};
  for (const double t : curves.at) curves.values[0].push_back(3 * t - 2), curves.values[1].push_back(t * t);
  const io::Curves cycle = io::cycle_of(curves, 1.5, 6, 10);
  EXPECT_EQ(cycle.axis, "cycle_percent");
  EXPECT_EQ(cycle.names, curves.names);
  ASSERT_EQ(cycle.at.size(), 10u);
  EXPECT_EQ(cycle.at.front(), 0);
  EXPECT_EQ(cycle.at.back(), 100);
  for (std::size_t i = 0; i < 10; ++i) {
    const double t = 1.5 + 0.5 * static_cast<double>(i);
    const double a = t < 2 ? 1 : t < 4 ? 2 : 4, b = 2 * a;
    EXPECT_NEAR(cycle.at[i], 100 * static_cast<double>(i) / 9, 1e-13);
    EXPECT_NEAR(cycle.values[0][i], 3 * t - 2, 1e-14 * 16);
    EXPECT_NEAR(cycle.values[1][i], t * t + (t - a) * (b - t), 1e-14 * 64);
  }
}

TEST(CycleOf, HasAHundredAndOnePointsUnlessToldAndItsEndsAreFrames) {
  const io::Curves cycle = io::cycle_of(
      {.axis = "time", .at = {0, 0.3, 0.7, 1.1}, .names = {"a"}, .values = {{1, 2, 3, 4}}}, 0.3, 1.1);
  EXPECT_EQ(cycle.at.size(), 101u);
  EXPECT_EQ(cycle.at[50], 50);
  EXPECT_EQ(cycle.values[0].front(), 2);
  EXPECT_EQ(cycle.values[0].back(), 4);
}

TEST(CycleOf, DoesNotBridgeGaps) {
  const io::Curves cycle = io::cycle_of({.axis = "time",
                                         .at = {0, 1, 2, 3, 4},
                                         .names = {"a", "b"},
                                         .values = {{0, 10, none, 30, 40}, {0, 1, 2, 3, 4}}},
                                        0, 4, 9);
  const std::vector<double> expected = {0, 5, 10, none, none, none, 30, 35, 40};
  expect_equal_columns(cycle.values[0], expected);
  expect_equal_columns(cycle.values[1], {0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4});
}

TEST(CycleOf, RefusesACycleThatIsNotInTheMotion) {
  const io::Curves curves{.axis = "time", .at = {0, 1}, .names = {"a"}, .values = {{0, 1}}};
  EXPECT_NO_THROW(io::cycle_of(curves, 0, 1, 2));
  EXPECT_THROW(io::cycle_of(curves, 0, 1, 1), UsageError);
  EXPECT_THROW(io::cycle_of(curves, 1, 1), UsageError);
  EXPECT_THROW(io::cycle_of(curves, 1, 0), UsageError);
  EXPECT_THROW(io::cycle_of(curves, none, 1), UsageError);
  EXPECT_THROW(io::cycle_of(curves, -1e-9, 1), UsageError);
  EXPECT_THROW(io::cycle_of(curves, 0, std::nextafter(1, 2)), UsageError);
  EXPECT_THROW(io::cycle_of({.axis = "time", .at = {}, .names = {}, .values = {}}, 0, 1), UsageError);
}

TEST(Pvd, IsACollectionWithATimeAndAPartForEachFile) {
  const TemporaryFolder folder;
  const std::array files = {
      io::SeriesFile{0.1, "fixed", "f_0.vtp"}, io::SeriesFile{0.1, "mobile", "m & \"n\"<0>.vtp"},
      io::SeriesFile{1.0 / 3, "fixed", "f_0.vtp"}, io::SeriesFile{1.0 / 3, "mobile", "m_1.vtp"}};
  io::write_pvd(folder / "series.pvd", files);

  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
      vtkXMLUtilities::ReadElementFromFile((folder / "series.pvd").c_str()));
  ASSERT_NE(root, nullptr);
  EXPECT_STREQ(root->GetName(), "VTKFile");
  EXPECT_STREQ(root->GetAttribute("type"), "Collection");
  vtkXMLDataElement* collection = root->FindNestedElementWithName("Collection");
  ASSERT_NE(collection, nullptr);
  ASSERT_EQ(collection->GetNumberOfNestedElements(), 4);
  for (int i = 0; i < 4; ++i) {
    vtkXMLDataElement* entry = collection->GetNestedElement(i);
    const io::SeriesFile& file = files[static_cast<std::size_t>(i)];
    double time = 0;
    EXPECT_STREQ(entry->GetName(), "DataSet");
    EXPECT_EQ(entry->GetScalarAttribute("timestep", time), 1);
    EXPECT_NEAR(time, file.time_s, 1e-6);  // VTK reads it by a stream's rules
    EXPECT_EQ(entry->GetAttribute("part"),
              file.part == std::string("fixed") ? std::string("0") : std::string("1"));
    EXPECT_EQ(entry->GetAttribute("name"), file.part);
    EXPECT_EQ(entry->GetAttribute("file"), file.file);
  }
}

}  // namespace
}  // namespace condyle
