#include "command.hpp"
#include "condyle/angle.hpp"
#include "support/knee.hpp"

/// `condyle depth --method normal`: meshes may be open.

namespace condyle::test {
namespace {

/// A ball of radius 20 whose centre --pose y=19 has 19 above a flat sheet.
class NormalMethod : public CommandTest {
 protected:
  NormalMethod() {
    io::write_mesh(folder / "sheet.ply", sheet());
    io::write_mesh(folder / "ball.ply", sphere(Vec3::Zero(), 20, 4));
    write_joint("[contact]\ncasting = \"mobile\"\nreach = 15\n");
  }
  /// Normal +y, with a vertex in the middle and edges of 1.
  static TriMesh sheet() {
    constexpr int n = 20;
    TriMesh mesh;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) mesh.vertices.push_back({i - n / 2.0, 0, j - n / 2.0});
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        const Index a = i * (n + 1) + j, b = a + n + 1;
        mesh.triangles.push_back({a, a + 1, b});
        mesh.triangles.push_back({b, a + 1, b + 1});
      }
    }
    return mesh;
  }
  void write_joint(const std::string& more, const std::string& fixed = "mesh = \"sheet.ply\"",
                   const std::string& centre = "[0, 0, 0]") const {
    write("joint.toml", text_of_joint({.fixed = "name = \"sheet\"\n" + fixed,
                                       .mobile = "name = \"ball\"\nmesh = \"ball.ply\"",
                                       .more = more,
                                       .kind = "free",
                                       .joint = "knee",
                                       .centre = centre}));
  }
  Ran by_normals(const std::string& arguments = "") const {
    return run("depth joint.toml --pose y=19 --method normal " + arguments);
  }
  Json normal_depths(const std::string& arguments = "") const {
    return answer("depth joint.toml --pose y=19 --method normal " + arguments);
  }
};

TEST_F(NormalMethod, AnswersForAnOpenSheet) {
  const Json json = normal_depths();
  EXPECT_EQ(json["method"], "normal");
  EXPECT_TRUE(json["in_contact"]);
  EXPECT_EQ(json["caveats"].size(), 1u);
  EXPECT_TRUE(json["bodies"]["fixed"].is_null()) << "the joint file has the mobile body cast";
  const Json& ball = json["bodies"]["mobile"];
  EXPECT_EQ(ball["target"], "sheet");
  EXPECT_NEAR(ball["max_normal_depth_mm"], 1, 1e-12);
  EXPECT_EQ(json["rays"]["reach_mm"], 15);
  EXPECT_FALSE(json.contains("max_radial_depth_mm"));

  const std::string text = by_normals().out;
  EXPECT_TRUE(
      says(text, "  depths along normals compare with those of the same casting surface and rule only"));
  EXPECT_TRUE(says(text, "  from ball to sheet: "));
  EXPECT_TRUE(says(text, ", 1.000 at most, triangle "));
}

TEST_F(NormalMethod, IsNamedWhereAnOpenMeshIsRefused) {
  expect_refused(4, "depth joint.toml --pose y=19", "(--method normal or --pairs-only accept such meshes)");
  // Where triangles are wound against each other, normals mean nothing; where all of a closed mesh are, neither.
  TriMesh twisted = sheet();
  std::swap(twisted.triangles[100][0], twisted.triangles[100][1]);
  io::write_mesh(folder / "sheet.ply", twisted);
  expect_refused(4, "depth joint.toml --pose y=19", "(--pairs-only accepts such meshes)");
  expect_refusal(by_normals(), 4, "sheet.ply: triangles wound against each other at the edge from vertex ",
                 "");
  io::write_mesh(folder / "sheet.ply", sheet());
  io::write_mesh(folder / "ball.ply", flipped(sphere(Vec3::Zero(), 20, 4)));
  expect_refusal(by_normals(), 4, "ball.ply: inverted orientation", "");
}

TEST_F(NormalMethod, OptionsTakeThePlaceOfWhatTheJointFileSays) {
  const Json json = normal_depths("--casting both --rule face_centre --reach 12");
  EXPECT_EQ(json["rays"], Json({{"casting", "both"}, {"rule", "face_centre"}, {"reach_mm", 12.0}}));
  EXPECT_FALSE(json["bodies"]["fixed"].is_null());
  EXPECT_FALSE(json["bodies"]["mobile"].is_null());
  EXPECT_EQ(json["provenance"]["command"],
            Json({"depth", "joint.toml", "--pose", "y=19", "--method", "normal", "--casting", "both",
                  "--rule", "face_centre", "--reach", "12"}));
  // Whole triangles of half a square each.
  const Json& sheet = json["bodies"]["fixed"];
  EXPECT_EQ(sheet["area_mm2"].get<double>(), 0.5 * sheet["triangles_in_contact"].get<double>());
}

TEST_F(NormalMethod, ItsOptionsAreRefusedElsewhereAndWhereTheyMakeNoSense) {
  for (const char* option : {"--casting fixed", "--rule cut_faces", "--reach 5"})
    expect_refusal(run(std::string("depth joint.toml --pairs-only ") + option), 2, "are for --method normal",
                   option);
  expect_refusal(by_normals("--about flexion"), 2, "about: is for method tangential", "");
  expect_refusal(by_normals("--reach 0"), 2, "the reach of rays must be above 0 mm", "");
  expect_refusal(by_normals("--casting ball"), 2, "--casting", "");
}

TEST_F(NormalMethod, WritesItsAnswerWithTheTrianglesOfTheCastingBody) {
  const Ran ran = by_normals("--json --out deep");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(text_of("deep/depth.json"), ran.out);
  const std::string fixed = text_of("deep/fixed.vtp"), mobile = text_of("deep/mobile.vtp");
  for (const char* array : {"Name=\"depth_mm\"", "Name=\"contact_area_mm2\""}) {
    EXPECT_TRUE(says(mobile, array)) << array;
    EXPECT_FALSE(says(fixed, array)) << array;
  }
  EXPECT_TRUE(says(fixed, "Name=\"in_contact\""));
  const std::string pairs = text_of("deep/pairs.csv");
  EXPECT_TRUE(says(pairs, "\nfixed_triangle,mobile_triangle\n"));
  done("depth joint.toml --pose y=19 --pairs-only --json --out pairs");
  const std::string other = text_of("pairs/pairs.csv");
  EXPECT_EQ(pairs.substr(pairs.find("fixed_triangle,")), other.substr(other.find("fixed_triangle,")));
}

TEST_F(NormalMethod, CentresAreInTheFrameAskedFor) {
  const Json joint = normal_depths("--casting both");
  write_joint("", "mesh = \"sheet.ply\"", "[1, 2, -3]");
  // The files' meshes lie by -(1, 2, -3) in the joint: the pose that brings the ball to the same place is the same.
  const Json moved = normal_depths("--frame source");
  for (const char* body : {"fixed", "mobile"}) {
    for (const int k : {0, 1, 2}) {
      for (const char* key : {"centre_mm", "centre_own_mm"})
        EXPECT_NEAR(moved["bodies"][body][key][k], joint["bodies"][body][key][k], 1e-12)
            << body << " " << key;
    }
  }
}

TEST_F(NormalMethod, IsAboutThePartsThatTheJointFileNames) {
  io::write_mesh(folder / "far.ply", box({-5, -200, -5}, {5, -190, 5}));
  const Json alone = normal_depths("--casting both");
  write_joint("[contact]\nfixed_part = \"near\"\n",
              "meshes = [{ name = \"far\", mesh = \"far.ply\" }, { name = \"near\", mesh = \"sheet.ply\" }]");
  const Json part = normal_depths("--casting both");
  EXPECT_EQ(part["fixed"], "near");
  EXPECT_EQ(part["bodies"]["fixed"], alone["bodies"]["fixed"]);
  EXPECT_EQ(part["bodies"]["mobile"]["target"], "near");
  write_joint("[contact]\nfixed_part = \"nearer\"\n",
              "meshes = [{ name = \"far\", mesh = \"far.ply\" }, { name = \"near\", mesh = \"sheet.ply\" }]");
  expect_refusal(by_normals(), 2, "nearer", "");
}

/// The first and the last frame of the published flexion of a knee, straight and bent, whose cartilages are open sheets.
TEST(NormalMethodOnAKnee, GivesThePublishedDepths) {
  FOUND_OR_SKIP(knee, shared_knee());
  ::setenv("CONDYLE_DATA", fs::absolute(*shared_data()).c_str(), 1);
  const TemporaryFolder folder;
  // Eight decimals of a metre are published, of the coordinates too: half a digit along each axis, and what rounded angles
  // move within 60 mm of the origin.
  constexpr double digit = 0.5000001e-5, of_coordinates = 1.7321 * digit + 1e-6;
  for (const std::size_t frame : {std::size_t{0}, knee->states.rows.size() - 1}) {
    SCOPED_TRACE(frame);
    const auto state = [&](const std::string& name) {
      return knee->states.rows[frame][knee->states.column("/jointset/knee_r/knee_" + name + "_r/value")];
    };
    std::string pose;
    const auto add = [&](const char* coordinate, double value) {
      pose += std::string(coordinate) + "=" + Json(value).dump() + " ";
    };
    add("flexion", Angle::radians(state("flex")).degrees());
    add("adduction", Angle::radians(state("add")).degrees());
    add("internal_rotation", Angle::radians(state("rot")).degrees());
    for (const char* axis : {"x", "y", "z"}) add(axis, 1e3 * state(std::string("t") + axis));
    const Ran ran = run_condyle(folder.path(), "depth " CONDYLE_KNEE_BY_HAND
                                               "/tibiofemoral.toml --method normal --json --pose \"" +
                                                   pose + "\"");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const Json json = Json::parse(ran.out), tibia = json["bodies"]["mobile"];
    EXPECT_TRUE(json["in_contact"]);
    EXPECT_EQ(json["rays"]["rule"], "face_centre");
    EXPECT_TRUE(json["bodies"]["fixed"].is_null());
    EXPECT_EQ(tibia["target"], "femoral cartilage");
    const auto published = [&](const std::string& name) { return knee->published("tf", frame, name); };
    const double mean = 1e3 * published("mean_proximity");
    EXPECT_NEAR(tibia["max_normal_depth_mm"], 1e3 * published("max_proximity"), digit + of_coordinates);
    EXPECT_NEAR(tibia["mean_normal_depth_mm"], mean, digit + of_coordinates);
    EXPECT_NEAR(tibia["area_mm2"], 1e6 * published("contact_area"), 0.5000001e-2);
    constexpr double patch = 30;  // mm: from a centre to the far end of the other compartment
    for (const int k : {0, 1, 2})
      EXPECT_NEAR(tibia["centre_own_mm"][k], 1e3 * published(std::string("center_of_proximity_") + "xyz"[k]),
                  patch * of_coordinates / mean);
    if (frame > 0) continue;
    EXPECT_NEAR(tibia["max_normal_depth_mm"], 0.40443, 0.5e-5 + digit + of_coordinates);
  }
}

}  // namespace
}  // namespace condyle::test
