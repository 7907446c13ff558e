#include "condyle/io/mesh_file.hpp"
#include "condyle/io/study.hpp"
#include "io/result/sample_files.hpp"
#include "io/study/study_joint.hpp"
#include "study_of_arms.hpp"
#include "support/test.hpp"

/// Contents that a study's table may have, and those that are refused.

namespace condyle::test {
namespace {

namespace fs = std::filesystem;

TEST(StudyTable, IsRefusedWithTheLineThatIsWrong) {
  const TemporaryFolder folder;
  const auto expect = [&](std::string_view text, std::string_view saying) {
    const fs::path table = folder.file("table.csv", text);
    const std::string said = complaint_of<FileError>([&] { io::run_study({table, folder / "out"}); });
    expect_says(said, saying);
    expect_says(said, "table.csv");
    EXPECT_FALSE(fs::exists(folder / "out")) << text;
  };
  expect("", "has no names of columns");
  expect("id,joint\n", "has no row");
  expect("joint\na.toml\n", "line 1: there is no column 'id'");
  expect("id,joint,joint\na,b,c\n", "line 1: column 'joint' is there twice");
  expect("id,joint,\na,b,c\n", "line 1: column 3 has no name");
  expect("id;joint\na;b\n", "columns must be separated by commas");
  expect("id,joint\na,b\n\nc\n", "line 4: 1 fields where there are 2 columns");
  expect("id,joint\na,b\n,c\n", "line 3: id is empty");
  expect("id,joint\na,b\nc,d\na,e\n", "line 4: id 'a' is that of line 2");
  expect("id,joint\n\"a,b\n", "line 2: a quote is not closed");
  expect("id,joint,a/b\nx,y,z\n", "line 1: column 'a/b'");
  expect(std::string_view("id,joint,a\0b\nx,y,z\n", 19), "a name has no control characters");
  expect("id,joint," + std::string(1001, 'a') + "\nx,y,z\n", "column 3 has a name of 1001 bytes");
  expect("id,joint,limit_deg,table_limit_deg\nx,y,1,2\n", "line 1: column 'table_limit_deg' is there twice");
  expect("id,sample,haed_radius_mm\na,1,25\n",
         "line 1: column 'haed_radius_mm': did you mean 'head_radius_mm'?");
  expect("id,sample,Head_Radius_MM\na,1,25\n", "did you mean 'head_radius_mm'?");
  expect("id,sample,sdie\na,1,left\n", "did you mean 'side'?");
  expect("id,sample,alpha_angle\na,1,60\n", "column 'alpha_angle': did you mean 'alpha_angle_deg'?");
  expect("id,sample,Alpha_Angle_degrees\na,1,60\n", "did you mean 'alpha_angle_deg'?");
  expect("id,sample,neck_length_cm\na,1,5\n", "did you mean 'neck_length_mm'?");
  expect("id,joint,pelvic_tilt\na,b,5\n", "did you mean 'pelvic_tilt_deg'?");
  for (const char* age : {"Age", "age_yr", "age_months"})
    expect(fmt::format("id,joint,{}\na,b,5\n", age), "did you mean 'age_years'?");
  for (const char* sex : {"Sex", "gender"})
    expect(fmt::format("id,joint,{}\na,b,F\n", sex), "did you mean 'sex'?");
  expect("id,joint,age,age_years\na,b,5,5\n", "columns 'age' and 'age_years' are one");
  expect("id,fixed,mobile,side,unit\na,b,c,left,m\n", "did you mean 'units'?");
  expect("id,fixed,mobile,side,axis\na,b,c,left,LPS\n", "did you mean 'axes'?");
  expect("id,fixed,moblie,side\na,b,c,left\n", "did you mean 'mobile'?");
  expect("id,jiont\na,b\n", "did you mean 'joint'?");
  expect(std::string_view("id,joint,a\nx,y,\0z\n", 18), "line 2: has a character 0");
}

TEST(StudyTable, CarriesColumnsThatAreNearlyCalledAsOnesThatItHasOrDoesNotNeed) {
  const TemporaryFolder folder;
  const fs::path table = folder.file(
      "table.csv", "id,joint,side,site,haed_radius_mm,unit,age\na,nothere.toml,,Bern,25,orthopaedics,61\n");
  io::run_study({table, folder / "out"});
  const auto failure = rows_of(folder / "out/failures.csv").at(0);
  for (const char* column : {"site", "haed_radius_mm", "unit", "age"}) EXPECT_TRUE(failure.contains(column));
}

TEST(StudyTable, SaysWhoseJointsTheyAre) {
  const TemporaryFolder folder;
  const SmallCohort cohort(folder.path(), 1);
  const io::StudyTable table = io::read_study_table(
      folder.file("whose.csv",
                  "id,joint,age,sex,species\na,hip1.toml,7,F,\nb,hip1.toml,,male,cat\nc,hip1.toml,,girl,\n"
                  "d,hip1.toml,old,,\ne,hip1.toml,121,,\n"));
  const auto person = [&](std::size_t row) {
    return io::load_joint(table, table.rows.at(row)).loaded.joint.person;
  };
  EXPECT_EQ(person(0).age_years, 7);
  EXPECT_EQ(person(0).sex, Sex::female);
  EXPECT_TRUE(person(0).is_human());
  EXPECT_EQ(person(1).sex, Sex::male);
  EXPECT_EQ(person(1).species, "cat");
  for (const std::size_t bad : {2u, 3u, 4u}) EXPECT_THROW(person(bad), FileError) << bad;
  EXPECT_EQ(table.carried.size(), 3u) << "they are covariates too";
}

TEST(StudyTable, TakesAByteOrderMarkCommentsAndLineEndsOfWindows) {
  const TemporaryFolder folder;
  const SmallCohort cohort(folder.path(), 1);
  const fs::path table =
      folder.file("other.csv", "\xEF\xBB\xBF# a remark\r\nid,joint,reason\r\nh1,hip1.toml,why not\r\n");
  EXPECT_EQ(io::run_study({table, folder / "out"})->joints, 1u);
  const auto rows = rows_of(folder / "out/limits.csv");
  EXPECT_EQ(rows[0].at("table_reason"), "why not");
  EXPECT_EQ(rows[0].at("reason"), "contact");
}

TEST(StudyOfMeshes, TakesSideUnitsAndAxesFromTheTable) {
  const TemporaryFolder folder;
  const sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::one);
  {
    io::OutputFolder out(folder / "hip");
    io::write_sample_hip(out, hip, Side::right);
    out.commit();
  }
  // In metres, X to the right, Y anterior, Z superior.
  const auto ras = [](const Vec3& p) { return Vec3(Vec3(p.z(), p.x(), p.y()) / 1000); };
  io::write_mesh(folder / "bone_ras.ply", mapped(hip.hip_bone, ras));
  io::write_mesh(folder / "femur_ras.ply", mapped(hip.femur, ras));
  folder.file("table.csv",
              "id,joint,fixed,mobile,side,units,axes\n"
              "a,hip/hip.toml,,,,,\n"
              "b,,bone_ras.ply,femur_ras.ply,right,m,RAS\n"
              "c,,bone_ras.ply,femur_ras.ply,,m,RAS\n"
              "d,,bone_ras.ply,femur_ras.ply,right,ft,RAS\n"
              "e,hip/hip.toml,bone_ras.ply,femur_ras.ply,right,m,RAS\n"
              "f,,bone_ras.ply,femur_ras.ply,right,m,ras\n"
              "g,,bone_ras.ply,femur_ras.ply,R,m,RAS\n");
  io::Study study{folder / "table.csv", folder / "out"};
  study.options.motions = {"flexion", "fadir"};
  io::run_study(study);
  const auto limits = rows_of(folder / "out/limits.csv");
  ASSERT_EQ(limits.size(), 4u);
  // The centre of b is fitted to the head: within what triangles sag below the sphere.
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(std::stod(limits[i].at("limit_deg")), std::stod(limits[i + 2].at("limit_deg")), 0.5);
  const auto failures = rows_of(folder / "out/failures.csv");
  ASSERT_EQ(failures.size(), 5u);
  expect_says(failures[0].at("message"), "line 4: column 'side': right or left is needed");
  expect_says(failures[1].at("message"), "line 5: column 'units': 'ft' is none of mm, cm, in, m");
  expect_says(failures[2].at("message"), "line 6: a row needs");
  // Words are spelt as in joint files.
  expect_says(failures[3].at("message"), "line 7: column 'axes': 'ras' is none of joint, RAS, LPS");
  expect_says(failures[4].at("message"), "line 8: column 'side': 'R' is none of right, left");
}

}  // namespace
}  // namespace condyle::test
