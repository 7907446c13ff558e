#include "condyle/io/study.hpp"

#include <hdf5.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "condyle/io/joint_file.hpp"
#include "condyle/version.hpp"
#include "core/thread_limit.hpp"
#include "io/file/whole_file.hpp"
#include "io/result/sample_files.hpp"
#include "study_of_arms.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

namespace fs = std::filesystem;
using io::read_whole_file;

TEST_F(StudyOfArms, HasARowForEveryJointAndMotionOrAFailure) {
  const io::StudyDone done = run(study("out"));
  EXPECT_EQ(done.joints, 9u);
  EXPECT_EQ(done.failures, 4u);
  const auto limits = rows_of(folder / "out/limits.csv");
  ASSERT_EQ(limits.size(), 18u);
  for (std::size_t k = 1; k <= 9; ++k) {
    const auto& row = limits[2 * (k - 1)];
    EXPECT_EQ(row.at("id"), fmt::format("h{}", k));
    EXPECT_EQ(row.at("table_row"), fmt::format("{}", k));
    EXPECT_EQ(row.at("group"), k % 2 ? "a, x" : "b, x");
    EXPECT_EQ(row.at("motion"), "flexion");
    // The arm's lower front edge, (1, -100), meets the post's wall; limits are within 3e-10 degrees of the truth.
    const double wall = SmallCohort::wall_mm(k);
    const double limit = std::asin(wall / std::hypot(1, 100)) - std::atan2(1, 100);
    EXPECT_NEAR(std::stod(row.at("limit_deg")), limit * 180 / std::numbers::pi, 3e-10);
    EXPECT_NEAR(std::stod(row.at("contact_x_mm")), wall, 1e-9);
    EXPECT_EQ(limits[2 * k - 1].at("motion"), "extension");
  }
  EXPECT_EQ(rows_of(folder / "out/hips.csv").size(), 9u);
}

TEST_F(StudyOfArms, SaysOfEveryFailureItsExitCodeAndWhy) {
  run(study("out"));
  const auto failures = rows_of(folder / "out/failures.csv");
  ASSERT_EQ(failures.size(), 4u);
  const auto expect = [&](std::size_t i, const char* id, const char* code, std::string_view saying) {
    EXPECT_EQ(failures[i].at("id"), id);
    EXPECT_EQ(failures[i].at("table_row"), fmt::format("{}", 10 + i));
    EXPECT_EQ(failures[i].at("exit_code"), code);
    expect_says(failures[i].at("message"), saying);
  };
  expect(0, "gone", "3", "nothere.toml: no such file");
  expect(1, "open", "3", "mobile.mesh: there is no file");
  expect(2, "contact", "6", "in contact in the reference pose");
  expect(3, "empty", "3",
         "line 14: a row needs joint, or fixed and mobile, or labels, or opensim_model, or sample");
}

TEST_F(StudyOfArms, OfShardsMergedIsTheStudyOfTheWholeTableByteForByte) {
  run(study("whole"));
  for (const std::size_t of : {1u, 7u, 20u}) {
    const std::string out = fmt::format("in{}", of);
    for (std::size_t number = of; number >= 1; --number) run(shard(out, number, of));
    const io::StudyDone merged = io::merge_study(folder / out);
    EXPECT_EQ(merged.joints, 9u);
    EXPECT_EQ(merged.failures, 4u);
    expect_same_tables("whole", out);
  }
}

TEST_F(StudyOfArms, IsTheSameOnAnyNumberOfThreads) {
  io::Study banded = study("one");
  banded.options.bands.emplace().samples = 20;
  for (const auto& [out, threads] : {std::pair("one", 1u), {"seven", 7u}}) {
    const core::ThreadLimit limit(threads);
    banded.folder = folder / out;
    run(banded);
  }
  expect_same_tables("one", "seven");
}

TEST_F(StudyOfArms, IsNotDoneAgainForTheSameInputs) {
  EXPECT_FALSE(run(study("out")).was_there);
  const auto written = fs::last_write_time(folder / "out/study.json");
  const io::StudyDone again = run(study("out"));
  EXPECT_TRUE(again.was_there);
  EXPECT_EQ(again.joints, 9u);
  EXPECT_EQ(again.failures, 4u);
  EXPECT_EQ(fs::last_write_time(folder / "out/study.json"), written);
}

TEST_F(StudyOfArms, IsDoneAgainForOtherMeshesOtherOptionsAndFilesThatWereChanged) {
  run(study("out"));
  cohort.write_post(3, 90);
  EXPECT_FALSE(run(study("out")).was_there);
  io::Study all_motions = study("out");
  all_motions.options.motions.clear();
  EXPECT_FALSE(run(all_motions).was_there);
  EXPECT_TRUE(run(all_motions).was_there);
  std::ofstream(folder / "out/limits.csv", std::ios::app) << "more\n";
  EXPECT_FALSE(run(all_motions).was_there);
  // A file that was missing and is there now.
  std::ofstream(folder / "nothere.toml") << read_whole_file(folder / "hip1.toml");
  const io::StudyDone found = run(all_motions);
  EXPECT_FALSE(found.was_there);
  EXPECT_EQ(found.failures, 3u);
}

TEST_F(StudyOfArms, IsRefusedForATableOfBytesThatAreNoUtf8) {
  io::Study bytes = study("out");
  bytes.table = folder / "bytes.csv";
  for (const char* table :
       {"id,joint,a\xff\nh,hip1.toml,x\n", "id,joint,a\nh,hip1.toml,\xfe\n",
        "id,joint,a\nh,hip1.toml,\xc0\xaf\n", "id,joint,a\nh,hip1.toml,\xed\xa0\x80\n",
        "id,joint,a\nh,hip1.toml,\xf4\x90\x80\x80\n", "id,joint,a\nh,hip1.toml,\xe2\x82"}) {
    std::ofstream(bytes.table) << table;
    EXPECT_THROW(run(bytes), FileError) << table;
  }
}

/// Shard 3 of 3 has the same two joints in both tables, in other places.
TEST_F(StudyOfArms, IsDoneAgainWhereItsRowsMoved) {
  io::Study last = shard("out", 3, 3), all = study("whole");
  last.table = all.table = folder / "moved.csv";
  for (const char* before : {"", "z,hip4.toml\n"}) {
    std::ofstream(last.table) << "id,joint\n" << before << "a,hip1.toml\nb,hip2.toml\nc,hip3.toml\nd,\n";
    EXPECT_FALSE(run(last).was_there);
    EXPECT_TRUE(run(last).was_there);
    for (const std::size_t number : {1u, 2u}) {
      last.shard->number = number;
      run(last);
    }
    last.shard->number = 3;
    io::merge_study(folder / "out");
    run(all);
    expect_same_tables("whole", "out");
  }
}

TEST_F(StudyOfArms, KeepsShardsWhoseRowsDidNotChange) {
  for (std::size_t number = 1; number <= 3; ++number) run(shard("out", number, 3));
  cohort.write_table("open.toml", "c");
  expect_says(complaint_of<FileError>([&] {
                EXPECT_TRUE(run(shard("out", 1, 3)).was_there);
                io::merge_study(folder / "out");
              }),
              "2_of_3: is of another table");
  EXPECT_TRUE(run(shard("out", 2, 3)).was_there);
  EXPECT_FALSE(run(shard("out", 3, 3)).was_there);
  io::merge_study(folder / "out");
  run(study("whole"));
  expect_same_tables("whole", "out");
}

TEST_F(StudyOfArms, IsMergedOnlyWhereAllShardsAreThereAndWhole) {
  const auto merging = [&] { return complaint_of<FileError>([&] { io::merge_study(folder / "out"); }); };
  expect_says(merging(), "there is no shard");
  for (const std::size_t number : {1u, 2u, 4u}) run(shard("out", number, 5));
  expect_says(merging(), "2 of 5 shards are missing or not whole: 3, 5");
  EXPECT_FALSE(fs::exists(folder / "out/limits.csv"));
  for (const std::size_t number : {3u, 5u}) run(shard("out", number, 5));
  std::ofstream(folder / "out/shards/4_of_5/failures.csv", std::ios::app) << "x\n";
  expect_says(merging(), "1 of 5 shards is missing or not whole: 4");
  run(shard("out", 4, 5));
  io::Study other = shard("out", 5, 5);
  other.options.motions = {"flexion"};
  run(other);
  expect_says(merging(), "other options");
  run(shard("out", 1, 2));
  expect_says(merging(), "shards of 2 and of 5");
}

TEST_F(StudyOfArms, EndsWithItsLowestBadJointWhereThatIsAskedFor) {
  io::Study strict = study("out");
  strict.bad_joint = io::BadJoint::ends_run;
  expect_says(complaint_of<FileError>([&] { run(strict); }), "nothere.toml");
  EXPECT_FALSE(fs::exists(folder / "out/limits.csv"));
  // Tables that are there already change nothing, and stay.
  run(study("out"));
  expect_says(complaint_of<FileError>([&] { run(strict); }), "nothere.toml");
  EXPECT_TRUE(run(study("out")).was_there);
}

TEST_F(StudyOfArms, EndsWhereItsOptionsDoNotFit) {
  io::Study wrong = study("out");
  wrong.options.motions = {"flexoin"};
  expect_says(complaint_of<UsageError>([&] { run(wrong); }), "flexoin");
  EXPECT_FALSE(fs::exists(folder / "out/limits.csv"));
}

TEST_F(StudyOfArms, WritesNothingWhereItIsStopped) {
  std::stop_source stop;
  Control control;
  control.stop = stop.get_token();
  control.progress = [&](std::string_view, std::size_t, std::size_t) { stop.request_stop(); };
  EXPECT_FALSE(io::run_study(study("out"), control));
  EXPECT_EQ(count_entries(folder / "out"), 1u) << "the rows that were answered, for the next run";
  EXPECT_TRUE(fs::exists(folder / "out/.condyle-rows"));
}

TEST_F(StudyOfArms, HasBandsMapAndDepthWhereTheyAreAskedFor) {
  io::Study full = study("out");
  full.options.bands.emplace().samples = 20;
  motion::MapGrid grid;
  grid.column = {JointAngle::adduction, -10, 10, 10};
  grid.row = {JointAngle::internal_rotation, -10, 10, 5};
  grid.vary = JointAngle::flexion;
  full.options.map = grid;
  full.options.depth_at = io::PoseDegrees{.flexion = 35};
  run(full);
  const auto limit = rows_of(folder / "out/limits.csv")[0];
  EXPECT_LT(std::stod(limit.at("band_p5_deg")), std::stod(limit.at("band_median_deg")));
  EXPECT_LT(std::stod(limit.at("band_median_deg")), std::stod(limit.at("band_p95_deg")));
  const auto hips = rows_of(folder / "out/hips.csv");
  EXPECT_EQ(hips[0].at("map_points"), "15");
  EXPECT_EQ(std::stod(hips[0].at("map_upper_contact_points")), 15);
  // A post 20 mm thick whose wall is nearer than the arm's end at 35 degrees, and not all before it.
  const auto limits = rows_of(folder / "out/limits.csv");
  for (std::size_t k = 1; k <= 9; ++k) {
    if (SmallCohort::wall_mm(k) <= 40) continue;
    const bool meets = std::stod(limits[2 * (k - 1)].at("limit_deg")) < 35;
    EXPECT_EQ(hips[k - 1].at("depth_in_contact"), meets ? "1" : "0") << k;
    EXPECT_EQ(hips[k - 1].at("depth_state"), meets ? "contact" : "free") << k;
    EXPECT_EQ(hips[k - 1].at("depth_to_limit_deg").empty(), meets) << k;
  }
  run(study("plain"));
  EXPECT_FALSE(rows_of(folder / "plain/limits.csv")[0].contains("band_p5_deg"));
  EXPECT_FALSE(rows_of(folder / "plain/hips.csv")[0].contains("map_points"));
}

/// A data set of texts or of numbers, as texts.
std::vector<double> h5_numbers(hid_t file, const std::string& path) {
  const hid_t set = H5Dopen2(file, path.c_str(), H5P_DEFAULT), space = H5Dget_space(set);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << path;
  H5Sclose(space);
  H5Dclose(set);
  return values;
}

/// A data set of texts of variable length.
std::vector<std::string> h5_texts(hid_t file, const std::string& path) {
  const hid_t set = H5Dopen2(file, path.c_str(), H5P_DEFAULT), space = H5Dget_space(set),
              type = H5Dget_type(set);
  EXPECT_GT(H5Tis_variable_str(type), 0) << path;
  EXPECT_EQ(H5Tget_cset(type), H5T_CSET_UTF8) << path;
  std::vector<char*> read(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()), 0) << path;
  std::vector<std::string> texts;
  for (const char* text : read) texts.emplace_back(text ? text : "");
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, read.data());
  H5Tclose(type);
  H5Sclose(space);
  H5Dclose(set);
  return texts;
}

TEST_F(StudyOfArms, HasTheSameNumbersInItsHdf5File) {
  run(study("out"));
  const hid_t file = H5Fopen((folder / "out/study.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const auto rows = rows_of(folder / "out/limits.csv");
  for (const char* column : {"limit_deg", "weight_kg", "contact_x_mm", "table_row", "clock_hour"}) {
    const std::vector<double> values = h5_numbers(file, std::string("/limits/") + column);
    ASSERT_EQ(values.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].at(column).empty())
        EXPECT_TRUE(std::isnan(values[i]));
      else
        EXPECT_EQ(values[i], std::stod(rows[i].at(column))) << column;
    }
  }
  EXPECT_EQ(h5_numbers(file, "/failures/exit_code"), (std::vector<double>{3, 3, 6, 3}));
  for (const char* column : {"id", "group", "motion", "contact_kind"}) {
    const std::vector<std::string> texts = h5_texts(file, std::string("/limits/") + column);
    ASSERT_EQ(texts.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(texts[i], rows[i].at(column)) << column;
  }
  H5Fclose(file);
}

TEST(StudyH5, GrowsWithTheTextsAndNotWithTheLongestOne) {
  const TemporaryFolder folder;
  const std::string remark(1'000'000, 'x');
  constexpr std::size_t rows = 200;
  std::string table = "id,joint,remark\n";
  for (std::size_t i = 0; i < rows; ++i)
    table += fmt::format("j{},nothere.toml,{}\n", i, i == 7 ? remark : "");
  EXPECT_EQ(io::run_study({folder.file("table.csv", table), folder / "out"})->failures, rows);
  // In the file a text has a reference of 16 bytes, and 16 beside it and up to 7 behind it where it lies; its columns, and
  // what HDF5 has beside them, take less than 64 kB.
  constexpr std::size_t text_columns = 4, beside_text = 16 + 16 + 7, beside_all = 1 << 16;
  const auto texts = fs::file_size(folder / "out/failures.csv");
  EXPECT_LT(fs::file_size(folder / "out/study.h5"), texts + rows * text_columns * beside_text + beside_all);
  const hid_t file = H5Fopen((folder / "out/study.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  EXPECT_EQ(h5_texts(file, "/failures/remark")[7], remark);
  EXPECT_EQ(h5_texts(file, "/failures/remark")[8], "");
  H5Fclose(file);
}

TEST_F(StudyOfArms, RefusesAPoseThatAHingeDoesNotTurnTo) {
  io::Study asked = knees();
  const auto refusal = [&] { return complaint_of<UsageError>([&] { io::run_study(asked); }); };
  constexpr auto says =
      "knees.csv: line 2: joint 'k': pose: a hinge rotates in flexion only, not in adduction";
  asked.options.depth_at = io::study_pose("flexion=30 adduction=10", Anatomy::knee);
  expect_ends(refusal(), says);
  asked.options.depth_at = io::study_pose("flexion=20", Anatomy::knee);
  EXPECT_EQ(io::run_study(asked)->joints, 1u);
  asked.options.depth_at.reset();
  asked.options.load.emplace().at = io::study_pose("flexion=30 adduction=10", Anatomy::knee);
  expect_ends(refusal(), says);
  EXPECT_THROW(io::study_pose("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", Anatomy::knee), UsageError);
}

TEST_F(StudyOfArms, WithoutAnAnswerIsTheErrorOfItsFirstFailure) {
  const auto refusal = [&](std::string_view table) {
    return complaint_of<FileError>([&] {
      const fs::path path = folder.file("none.csv", table);
      io::require_answered(*io::run_study({path, folder / "none"}), path);
    });
  };
  expect_says(refusal("id,joint\na,nothere.toml\nb,in_contact.toml\n"),
              "none.csv: none of 2 joints was answered; "
              "the first one: ");
  const fs::path contact = folder.file("none.csv", "id,joint\nb,in_contact.toml\na,nothere.toml\n");
  for (const bool again : {false, true}) {
    const io::StudyDone done = *io::run_study({contact, folder / "none"});
    EXPECT_EQ(done.was_there, again);
    EXPECT_THROW(io::require_answered(done, contact), motion::ReferenceContactError);
  }
  io::require_answered(run(study("some")), cohort.table());
}

TEST_F(StudyOfArms, NamesEveryColumnInItsDictionary) {
  run(study("out"));
  std::map<std::string, std::vector<std::string>> names;
  for (const auto& row : rows_of(folder / "out/columns.csv")) {
    names[row.at("table")].push_back(row.at("column"));
    EXPECT_FALSE(row.at("meaning").empty()) << row.at("column");
  }
  for (const char* table : {"limits", "hips", "failures"}) {
    const std::string text = read_whole_file(folder / "out" / (std::string(table) + ".csv"));
    std::string header;
    for (const std::string& name : names[table]) header += (header.empty() ? "" : ",") + name;
    expect_says(text, "\n" + header + "\n");
  }
}

TEST_F(StudyOfArms, SaysInEveryTableWhichVersionAndOptionsItIsOf) {
  io::Study asked = study("out");
  asked.options.bands = BandRequest{.samples = 20, .seed = 7};
  run(asked);
  const auto options = nlohmann::json::parse(read_whole_file(folder / "out/study.json"))["options"];
  for (const char* table : {"limits", "hips", "failures", "columns"}) {
    std::istringstream text(read_whole_file(folder / "out" / (std::string(table) + ".csv")));
    std::string version_line, options_line, header;
    for (std::string* line : {&version_line, &options_line, &header}) std::getline(text, *line);
    EXPECT_EQ(version_line, "# condyle_version: " + std::string(version)) << table;
    ASSERT_TRUE(options_line.starts_with("# options: ")) << table;
    EXPECT_EQ(nlohmann::json::parse(options_line.substr(11)), options) << table;
    EXPECT_FALSE(header.starts_with("#")) << table;
  }
}

TEST(StudyOfSamples, GivesTheSameOfMeasuresAndOfMeshesInFiles) {
  const TemporaryFolder folder;
  io::SampleCohort cohort{.n = 2, .seed = 7};
  io::write_sample_cohort(folder / "measures", cohort);
  cohort.meshes = io::CohortMeshes::in_files;
  io::write_sample_cohort(folder / "files", cohort);
  io::Study study;
  study.options.motions = {"flexion", "internal_rotation_at_90_flexion"};
  for (const char* source : {"measures", "files"}) {
    study.table = folder / source / "cohort.csv";
    study.folder = folder / (std::string("of_") + source);
    EXPECT_EQ(io::run_study(study)->joints, 2u);
  }
  EXPECT_EQ(read_whole_file(folder / "of_measures/limits.csv"),
            read_whole_file(folder / "of_files/limits.csv"));
}

}  // namespace
}  // namespace condyle::test
