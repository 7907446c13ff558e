#include <regex>

#include "command.hpp"
#include "support/small_cohort.hpp"

/// What lies there is an answer of the same question: every option of `study` and `sweep` changed in turn, as `condyle help` lists them,
/// and every file that they read.

namespace condyle::test {
namespace {

/// The command's long options.
std::set<std::string> options_of(const fs::path& folder, const std::string& command) {
  const std::string help = run_condyle(folder, "help --help-all " + command).out;
  std::set<std::string> names;
  const std::regex option("\n  (?:-[a-zA-Z],)?(--[a-z-]+)");
  for (auto at = std::sregex_iterator(help.begin(), help.end(), option); at != std::sregex_iterator(); ++at)
    names.insert((*at)[1]);
  return names;
}

/// Two command lines that differ by one option.
struct Changed {
  std::string before, after;
};

class Keys : public CommandTest {
 protected:
  bool is_there(const std::string& arguments) const {
    const Ran ran = run(arguments);
    EXPECT_NE(ran.exit_code, 2) << arguments << ran.err;
    return ran.err.find("is there already") != ran.err.npos;
  }

  /// Each option of the command is in one of the two lists, and those that change an answer make it anew.
  void expect_anew(const std::string& command, const std::string& arguments,
                   const std::set<std::string>& decide_nothing,
                   const std::map<std::string, Changed>& changes) const {
    // Those that change the same line come after each other: the last one's answer is the next one's.
    std::multimap<std::string, std::string> options;
    for (const std::string& option : options_of(here, command)) {
      if (decide_nothing.contains(option)) continue;
      const auto change = changes.find(option);
      ASSERT_NE(change, changes.end()) << option << " is new: how does it change an answer?";
      options.emplace(change->second.before, option);
    }
    for (const auto& [before, option] : options) {
      const auto line = [&](const std::string& more) {
        return fmt::format("{} {} {} --out out", command, arguments, more);
      };
      const std::string& after = changes.at(option).after;
      is_there(line(before));
      EXPECT_TRUE(is_there(line(before))) << option;
      EXPECT_FALSE(is_there(line(after))) << option;
      EXPECT_TRUE(is_there(line(after))) << option;
      EXPECT_FALSE(is_there(line(before))) << option;
    }
  }

  /// An answer is there as long as the file is what it was.
  void expect_read(const std::string& command, const fs::path& file, const std::string& other) const {
    const std::string before = io::read_whole_file(file);
    is_there(command);
    EXPECT_TRUE(is_there(command)) << file << "\n" << command;
    std::ofstream(file, std::ios::binary) << other;
    EXPECT_FALSE(is_there(command)) << file << "\n" << command;
    fs::remove(file);
    EXPECT_FALSE(is_there(command)) << file << " is gone\n" << command;
    std::ofstream(file, std::ios::binary) << before;
    EXPECT_FALSE(is_there(command)) << file << "\n" << command;
  }
};

TEST_F(Keys, OfAStudyHaveEveryOption) {
  const SmallCohort cohort(here, 1);
  const std::string layers = "--load '' --e 10 --nu 0.3 --thickness 2", cut = "--resect flexion=40 --edge 10",
                    map = "--map flexion=0:20:20 adduction=0:10:10";
  expect_anew("study", "table.csv", {"--out", "--crate", "--shard", "--help", "--strict", "--within"},
              {{"--motion", {"--motion flexion", "--motion extension"}},
               {"--band", {"--band=20", "--band=21"}},
               {"--seed", {"--band=20", "--band=20 --seed 7"}},
               {"--sigma-centre", {"--band=20", "--band=20 --sigma-centre 0.4"}},
               {"--sigma-axes", {"--band=20", "--band=20 --sigma-axes 0.9"}},
               {"--sigma-surface", {"--band=20", "--band=20 --sigma-surface 0.2"}},
               {"--map", {map, "--map flexion=0:20:20 adduction=0:20:20"}},
               {"--vary", {map, "--map flexion=0:20:20 internal_rotation=0:10:10 --vary adduction"}},
               {"--anatomy", {"", "--anatomy elbow"}},
               {"--depth", {"--depth flexion=10", "--depth flexion=20"}},
               {"--measures", {"", "--measures"}},
               {"--resect", {cut, "--resect flexion=41 --edge 10"}},
               {"--from", {cut, cut + " --from fixed"}},
               {"--share", {cut + " --from both", cut + " --from both --share 0.4"}},
               {"--margin", {cut, cut + " --margin 1"}},
               {"--burr", {cut, cut + " --burr 2"}},
               {"--deepest", {cut, cut + " --deepest 3"}},
               {"--edge", {cut, "--resect flexion=40 --edge 9"}},
               {"--load", {layers, "--load flexion=10 --e 10 --nu 0.3 --thickness 2"}},
               {"--follow-load", {layers + " --force 1 2 3", "--follow-load --force 1 2 3"}},
               {"--force", {layers, layers + " --force 1 2 3"}},
               {"--along", {layers + " --force 1 2 3", layers + " --force 1 2 3 --along 1 0 0"}},
               {"--bearing", {"", "--bearing 3"}},
               {"--accept-reference-contact", {"", "--accept-reference-contact"}},
               {"--exclude-reference-contacts", {"", "--exclude-reference-contacts"}},
               {"--e", {layers, "--load '' --e 11 --nu 0.3 --thickness 2"}},
               {"--nu", {layers, "--load '' --e 10 --nu 0.31 --thickness 2"}},
               {"--thickness", {layers, "--load '' --e 10 --nu 0.3 --thickness 3"}},
               {"--law", {layers, layers + " --law logarithmic"}},
               {"--casting", {layers, layers + " --casting fixed"}},
               {"--rule", {layers, layers + " --rule face_centre"}},
               {"--reach", {layers, layers + " --reach 10"}}});
}

/// A joint of arms has no bearing surface to measure from.
TEST_F(Keys, OfAStudyHaveTheDistanceWithinWhichBoneIsCut) {
  write("hips.csv", "id,sample,side\na,1,right\n");
  const std::string cut =
      "study hips.csv --motion internal_rotation_at_90_flexion --resect internal_rotation_at_90_flexion=30 "
      "--edge 5 "
      "--out out";
  is_there(cut);
  EXPECT_TRUE(is_there(cut));
  EXPECT_FALSE(is_there(cut + " --within 40"));
  EXPECT_TRUE(is_there(cut + " --within 40"));
}

TEST_F(Keys, OfASweepHaveEveryOption) {
  sample_into(here, "replacement --facets 24");
  const auto write_targets = [&](const char* name, int reach) {
    write(name, fmt::format("name,motion,reach_deg\nsitting,flexion,{}\n", reach));
  };
  write_targets("daily.csv", 110);
  write_targets("other.csv", 111);
  const std::string vary = "hip.toml --vary cup.inclination=40:45:5",
                    layers = "--load flexion=20 --e 10 --nu 0.3 --thickness 2",
                    forced = layers + " --force 0 500 0";
  const auto with = [&](const std::string& more) { return vary + " --targets daily.csv " + more; };
  // Refused, with exit code 2: docs/sweeps.md.
  const std::set<std::string> refused = {"--sigma-centre", "--sigma-axes", "--sigma-surface"};
  std::set<std::string> decide_nothing = {"--out", "--shard", "--help", "--strict", "--json"};
  decide_nothing.insert(refused.begin(), refused.end());
  expect_anew("sweep", "", decide_nothing,
              {{"--vary", {with(""), "hip.toml --vary cup.inclination=40:50:5 --targets daily.csv"}},
               {"--targets", {with(""), vary + " --targets other.csv"}},
               {"--set", {with(""), with("--set cup.anteversion=16")}},
               {"--best", {with(""), with("--best least-change")}},
               {"--band", {with("--band=20"), with("--band=21")}},
               {"--seed", {with("--band=20"), with("--band=20 --seed 7")}},
               {"--measures", {with(""), with("--measures centre_edge_lateral_section_deg")}},
               {"--load", {with(layers), with("--load flexion=10 --e 10 --nu 0.3 --thickness 2")}},
               {"--force", {with(layers), with(forced)}},
               {"--along", {with(forced), with(forced + " --along 0 1 0")}},
               {"--e", {with(layers), with("--load flexion=20 --e 11 --nu 0.3 --thickness 2")}},
               {"--nu", {with(layers), with("--load flexion=20 --e 10 --nu 0.31 --thickness 2")}},
               {"--thickness", {with(layers), with("--load flexion=20 --e 10 --nu 0.3 --thickness 3")}},
               {"--law", {with(layers), with(layers + " --law logarithmic")}},
               {"--casting", {with(layers), with(layers + " --casting fixed")}},
               {"--rule", {with(layers), with(layers + " --rule face_centre")}},
               {"--reach", {with(layers), with(layers + " --reach 10")}},
               {"--bearing", {with(""), with("--bearing 3")}},
               {"--accept-reference-contact", {with(""), with("--accept-reference-contact")}}});
}

std::string repeated_lines(std::size_t count, const std::string& text) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text + "\n";
  return all;
}

TEST_F(Keys, OfAStudyHaveEveryFileThatItsLayersAndMotionsAreReadFrom) {
  const SmallCohort cohort(here, 1);
  io::write_mesh(here / "behind.ply", box({-0.5, -100, -1}, {0.5, -10, 1}));
  io::write_mesh(here / "other.ply", box({-0.4, -100, -1}, {0.5, -10, 1}));
  write("h.txt", repeated_lines(8, "2"));
  append("hip1.toml",
         "[contact.fixed]\nyoungs_modulus_mpa = 10\npoisson_ratio = 0.3\nthickness_file = \"h.txt\"\n"
         "[contact.mobile]\nyoungs_modulus_mpa = 10\npoisson_ratio = 0.3\nbehind = \"behind.ply\"\n"
         "thickness = 1\n");
  write("curves.csv", "time,flexion_deg\n0,0\n1,20\n");
  write("one.csv", "id,joint,follow\na,hip1.toml,\n");
  write("follow.csv", "id,joint,follow\na,hip1.toml,curves.csv\n");
  write("meshes.csv", "id,fixed,mobile,side\na,post1.ply,arm.ply,right\n");
  const std::string other_mesh = text_of("other.ply"),
                    loaded = "study one.csv --motion flexion --load '' --out out";
  expect_read(loaded, here / "h.txt", repeated_lines(8, "3"));
  expect_read(loaded, here / "behind.ply", other_mesh);
  expect_read(loaded, here / "arm.ply", other_mesh);
  expect_read(loaded, here / "post1.ply", other_mesh);
  expect_read(loaded, here / "hip1.toml", text_of("hip1.toml") + "# more\n");
  expect_read("study follow.csv --out out", here / "curves.csv", "time,flexion_deg\n0,0\n1,21\n");
  expect_read("study meshes.csv --out out", here / "arm.ply", other_mesh);
}

TEST_F(Keys, OfAStudyHaveVoxelsThatLieInAFileOfTheirOwn) {
  std::string voxels(4 * 4 * 4, '\0');
  voxels[21] = 1, voxels[42] = 2;
  std::string other = voxels;
  other[22] = 1;
  write("a.nhdr",
        "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\n"
        "sizes: 4 4 4\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
        "space origin: (0,0,0)\nencoding: raw\ndata file: a.raw\n");
  write("a.mhd",
        "ObjectType = Image\nNDims = 3\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
        "Offset = 0 0 0\nElementSpacing = 1 1 1\nDimSize = 4 4 4\n"
        "ElementType = MET_UCHAR\nElementDataFile = a.raw\n");
  std::string header(348, '\0');
  const auto put = [&](std::size_t at, auto value) {
    header.replace(at, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(0, std::int32_t{348});
  const std::int16_t sizes[] = {3, 4, 4, 4, 1, 1, 1, 1};
  for (std::size_t k = 0; k < 8; ++k) put(40 + 2 * k, sizes[k]);
  put(70, std::int16_t{2}), put(72, std::int16_t{8});
  for (std::size_t k = 0; k < 8; ++k) put(76 + 4 * k, 1.0f);
  put(254, std::int16_t{1});
  for (std::size_t k = 0; k < 3; ++k) put(280 + 16 * k + 4 * k, 1.0f);
  header.replace(344, 3, "ni1");
  write("a.hdr", header);
  for (const auto& [labels, data] : {std::pair("a.nhdr", "a.raw"), {"a.mhd", "a.raw"}, {"a.hdr", "a.img"}}) {
    write(data, voxels);
    write("table.csv", fmt::format("id,labels,fixed_label,mobile_label\na,{},1,2\n", labels));
    const Ran inspected = run(std::string("inspect ") + labels);
    EXPECT_EQ(inspected.exit_code, 0) << inspected.err;
    expect_read("study table.csv --out out", here / data, other);
    expect_read("study table.csv --out out", here / labels, "x");
    // And no result takes their place.
    fs::rename(here / data, here / "hips.csv");
    std::string text = text_of(labels);
    if (const std::size_t at = text.find(data); at != text.npos) {
      text.replace(at, 5, "hips.csv");
      write(labels, text);
      expect_refusal(run("study table.csv --out ."), 3,
                     "./hips.csv: is read for this answer, which would be written over it", labels);
      EXPECT_EQ(text_of("hips.csv"), voxels) << labels;
    }
    fs::rename(here / "hips.csv", here / data);
  }
}

TEST_F(Keys, OfAnAnswerAreInItsProvenance) {
  const SmallCohort cohort(here, 1);
  write("h.txt", repeated_lines(8, "2"));
  append("hip1.toml",
         "[contact.mobile]\nyoungs_modulus_mpa = 10\npoisson_ratio = 0.3\nthickness_file = \"h.txt\"\n");
  const auto others_of = [&](const std::string& arguments) {
    const Ran ran = run(arguments + " --json");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return Json::parse(ran.out).at("provenance").value("other_files", Json());
  };
  EXPECT_EQ(others_of("load hip1.toml"),
            Json({{{"path", "h.txt"}, {"sha256", io::digest_of(repeated_lines(8, "2")).sha256}}}));
  EXPECT_TRUE(others_of("rom hip1.toml --motion flexion").is_null()) << "no layer is read for limits";
}

TEST_F(Keys, OfAStudyHaveTheEnvironmentOfItsPaths) {
  const SmallCohort cohort(here, 1);
  for (const char* name : {"one", "two"}) {
    fs::create_directory(here / name);
    io::write_mesh(here / name / "post.ply",
                   box({name == std::string("one") ? 35.0 : 45.0, -120, -50}, {70, -80, 50}));
  }
  cohort.write_joint("hip1.toml", "${CONDYLE_TEST_BONES}/post.ply", "arm.ply");
  const std::string study = "study table.csv --motion flexion --out out";
  ::setenv("CONDYLE_TEST_BONES", "one", 1);
  is_there(study);
  EXPECT_TRUE(is_there(study));
  ::setenv("CONDYLE_TEST_BONES", "two", 1);
  EXPECT_FALSE(is_there(study));
  EXPECT_TRUE(is_there(study));
  ::unsetenv("CONDYLE_TEST_BONES");
}

TEST_F(Keys, OfASweepHaveEveryFileAndItsShardsDoNotMergeWithOthers) {
  sample_into(here, "replacement --facets 24");
  write("daily.csv", "name,motion,reach_deg\nsitting,flexion,110\n");
  const TriMesh head = io::read_mesh(here / "head.ply").mesh;
  TriMesh behind = head;
  io::write_mesh(here / "behind.ply", behind);
  behind.vertices.set(0, Vec3(1.01 * behind.vertices[0]));
  io::write_mesh(here / "other.ply", behind);
  write("h.txt", repeated_lines(head.vertices.size(), "2"));
  // What lies behind a mesh that a part moves would not move with it: the hip bone stays.
  append("hip.toml",
         "\n[contact]\nfixed_part = \"hip_bone\"\nmobile_part = \"head\"\n"
         "[contact.fixed]\nyoungs_modulus_mpa = 10\npoisson_ratio = 0.3\nbehind = \"behind.ply\"\nthickness "
         "= 1\n"
         "[contact.mobile]\nyoungs_modulus_mpa = 10\npoisson_ratio = 0.3\nthickness_file = \"h.txt\"\n");
  const std::string sweep =
      "sweep hip.toml --vary 'cup.inclination=40:45:5 cup.anteversion=10:15:5' --targets daily.csv --load "
      "flexion=20 --out ";
  const Ran ran = run(sweep + "out");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  expect_read(sweep + "out", here / "h.txt", repeated_lines(head.vertices.size(), "3"));
  expect_read(sweep + "out", here / "behind.ply", text_of("other.ply"));
  expect_read(sweep + "out", here / "daily.csv", "name,motion,reach_deg\nsitting,flexion,100\n");
  expect_read(sweep + "out", here / "stem.ply", text_of("neck.ply"));
  expect_read(sweep + "out", here / "hip.toml", text_of("hip.toml") + "# more\n");
  ASSERT_EQ(run(sweep + "parts --shard 1/2").exit_code, 0);
  write("h.txt", repeated_lines(head.vertices.size(), "4"));
  ASSERT_EQ(run(sweep + "parts --shard 2/2").exit_code, 0);
  expect_refused(3, "merge parts", "2_of_2");
  ASSERT_EQ(run(sweep + "parts --shard 1/2").exit_code, 0);
  EXPECT_EQ(run("merge parts").exit_code, 0);
  write("h.txt", repeated_lines(head.vertices.size(), "5"));
  expect_refused(3, "merge parts", "h.txt: is another since");
}

}  // namespace
}  // namespace condyle::test
