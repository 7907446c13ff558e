#include "io/result/crate.hpp"
#include "command.hpp"
#include "support/small_cohort.hpp"

/// `--crate`: an RO-Crate names every file of the folder and every file that was read, with digests that sha256sum finds too.

namespace condyle::test {
namespace {

using Names = std::set<std::string>;

class Crate : public CommandTest {
 protected:
  Json crate(const std::string& out) const { return json_of(out + "/ro-crate-metadata.json"); }

  static Json entity(const Json& crate, const std::string& id) {
    for (const Json& each : crate.at("@graph"))
      if (each.at("@id") == id) return each;
    ADD_FAILURE() << "no entity " << id;
    return {};
  }
  static Names ids(const Json& references) {
    Names names;
    for (const Json& each : references) names.insert(each.at("@id").get<std::string>());
    return names;
  }
  /// Every path under which it was read.
  static Names inputs(const Json& crate) {
    Names names;
    for (const std::string& id : ids(entity(crate, "#run").at("object")))
      for (const Json names_of = entity(crate, id).at("alternateName"); const Json& name : names_of)
        names.insert(name);
    return names;
  }
  /// That sha256sum finds the digests: of results below `out`, of inputs below `base`.
  void expect_digests(const std::string& out, const std::string& base) const {
    const Json json = crate(out);
    std::ofstream sums(here / "sums");
    for (const std::string& id : ids(entity(json, "#run").at("result"))) {
      const Json file = entity(json, id);
      sums << file.at("sha256").get<std::string>() << "  " << out << "/" << id << "\n";
      EXPECT_EQ(file.at("contentSize"), fmt::format("{}", fs::file_size(here / out / id))) << id;
    }
    for (const std::string& id : ids(entity(json, "#run").at("object"))) {
      const Json file = entity(json, id);
      EXPECT_EQ(id, "nih:sha-256;" + file.at("sha256").get<std::string>());
      for (const Json& name : file.at("alternateName"))
        sums << file.at("sha256").get<std::string>() << "  " << base << name.get<std::string>() << "\n";
    }
    sums.close();
    EXPECT_EQ(
        std::system(fmt::format("cd '{}' && sha256sum --check --strict --quiet sums", here.string()).c_str()),
        0);
  }
  /// That its results are all files there but itself.
  void expect_all_files(const std::string& out) const {
    Names there;
    for (const auto& entry : fs::recursive_directory_iterator(here / out))
      if (entry.is_regular_file()) there.insert(entry.path().lexically_relative(here / out).string());
    EXPECT_EQ(there.erase("ro-crate-metadata.json"), 1u);
    EXPECT_EQ(ids(entity(crate(out), "#run").at("result")), there);
  }

  const SmallCohort cohort{here, 4};
};

TEST_F(Crate, OfRangesOfMotionNamesEveryFileWithItsDigest) {
  const std::string command =
      "rom hip1.toml --motion flexion --map adduction=-10:10:10 internal_rotation=-10:10:10 --crate "
      "2026-01-31";
  done(command + " --out out");
  const Json json = crate("out"), root = entity(json, "./"), action = entity(json, "#run");
  expect_all_files("out");
  expect_digests("out", "");
  EXPECT_EQ(inputs(json), (Names{"hip1.toml", "post1.ply", "arm.ply"}));
  EXPECT_EQ(root.at("datePublished"), "2026-01-31");
  EXPECT_EQ(root.at("conformsTo").at("@id"), "https://w3id.org/ro/wfrun/process/0.5");
  Names parts = ids(action.at("result"));
  parts.merge(ids(action.at("object")));
  EXPECT_EQ(ids(root.at("hasPart")), parts);
  EXPECT_EQ(action.at("instrument").at("@id"), "#condyle");
  EXPECT_EQ(action.at("description"),
            "condyle rom hip1.toml --motion flexion --map adduction=-10:10:10 --map "
            "internal_rotation=-10:10:10");
  done(command + " --out again --threads 1");
  EXPECT_EQ(text_of("again/ro-crate-metadata.json"), text_of("out/ro-crate-metadata.json"));
  done("rom hip1.toml --motion flexion --out out");
  EXPECT_FALSE(fs::exists(here / "out/ro-crate-metadata.json")) << "of an earlier answer";
}

TEST_F(Crate, ChangesNoOtherFile) {
  done("rom hip1.toml --motion flexion --out without");
  done("rom hip1.toml --motion flexion --out with --crate 2026-01-31");
  for (const char* name : {"rom.json", "limits.csv"})
    EXPECT_EQ(text_of(std::string("with/") + name), text_of(std::string("without/") + name)) << name;
}

TEST_F(Crate, OfShardsMergedIsThatOfTheWholeStudy) {
  done("study table.csv --motion flexion --out whole --crate 2026-01-31");
  expect_all_files("whole");
  expect_digests("whole", "");
  for (const char* shard : {"1/2", "2/2"})
    done(fmt::format("study table.csv --motion flexion --out parted --shard {}", shard));
  done("merge parted --crate 2026-01-31");
  expect_digests("parted", "");
  // study.json says that it was merged.
  Json whole = crate("whole"), merged = crate("parted");
  for (Json* json : {&whole, &merged})
    for (Json& each : json->at("@graph"))
      if (each.at("@id") == "study.json") each.erase("sha256"), each.erase("contentSize");
  EXPECT_EQ(merged, whole);
  const Names read = inputs(whole);
  EXPECT_EQ(read.count("table.csv"), 1u);
  EXPECT_EQ(read.count("hip4.toml"), 1u);
  EXPECT_EQ(read.count("nothere.toml"), 0u);
}

TEST_F(Crate, ComesToAStudyThatIsThereAlready) {
  done("study table.csv --motion flexion --out once --crate 2026-01-31");
  done("study table.csv --motion flexion --out out");
  EXPECT_FALSE(fs::exists(here / "out/ro-crate-metadata.json"));
  const Ran again = run("study table.csv --motion flexion --out out --crate 2026-01-31");
  EXPECT_TRUE(says(again.err, "is there already"));
  EXPECT_TRUE(says(again.err, "wrote out/ro-crate-metadata.json"));
  EXPECT_EQ(text_of("out/ro-crate-metadata.json"), text_of("once/ro-crate-metadata.json"));
  done("study table.csv --motion flexion --out out");
  EXPECT_TRUE(fs::exists(here / "out/ro-crate-metadata.json")) << "of the same answer";
}

TEST_F(Crate, OfAPatientNamesEveryFolder) {
  sample_into(here / "bones", "hip --scenario 1");
  done("hip bones/hip_bone.ply bones/femur.ply --samples 0 --out patient --crate 2026-01-31");
  expect_all_files("patient");
  expect_digests("patient", "");
  EXPECT_EQ(inputs(crate("patient")), (Names{"bones/hip_bone.ply", "bones/femur.ply"}));
}

TEST_F(Crate, WithoutAFolderOrADayIsRefusedBeforeTheWork) {
  for (const char* date : {"today", "2026-02-29", "2026-1-31", "20260131", "2026-01-31T10:00", "+026-01-31"})
    for (const char* command : {"rom hip1.toml --out out", "study table.csv --out out", "merge out",
                                "hip post1.ply arm.ply --out out"})
      expect_refusal(run(fmt::format("{} --crate {}", command, date)), 2, "is no day", command);
  expect_refused(2, "rom hip1.toml --crate 2026-01-31", "--out");
  expect_refused(2, "study table.csv --out out --shard 1/2 --crate 2026-01-31", "condyle merge");
  EXPECT_FALSE(fs::exists(here / "out"));
}

TEST_F(Crate, HasOneEntityForFilesOfOneContentAndNamesAsUrisHaveThem) {
  fs::create_directory(here / "a folder");
  write("a folder/50 %.csv", "x\n");
  const std::string digest(64, 'a');
  const io::CrateRun asked{"2026-01-31",
                           "condyle rom",
                           "",
                           {{io::Input::Kind::file, "one.ply", digest},
                            {io::Input::Kind::entry, "gone.ply", "none"},
                            {io::Input::Kind::file, "two.ply", digest}}};
  const std::vector<fs::path> files = {"a folder/50 %.csv"};
  const Json json = Json::parse(io::crate_document(asked, here, files));
  EXPECT_EQ(ids(entity(json, "#run").at("object")), Names{"nih:sha-256;" + digest});
  EXPECT_EQ(inputs(json), (Names{"one.ply", "two.ply"}));
  EXPECT_EQ(entity(json, "a%20folder/50%20%25.csv").at("encodingFormat"), "text/csv");
}

}  // namespace
}  // namespace condyle::test
