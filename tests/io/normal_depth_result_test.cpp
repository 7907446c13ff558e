#include <nlohmann/json.hpp>

#include "condyle/inspect.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"
#include "io/result/depth_result.hpp"
#include "support/test.hpp"

/// Answers of `condyle depth --method normal` for a ball that stands in a flat sheet.
///
///          ___
///        /     \                  ball of radius R, its centre h above the sheet: at the distance r from the
///       |   +   |  ^              middle the depth is sqrt(R^2 - r^2) - h
///     ___\_____/___| h______      sheet, normal +y
///          ---

namespace condyle {
namespace {

using Json = nlohmann::json;

constexpr double R = 20, h = 19;
constexpr double spacing = 0.5;

/// A flat square of side 20 in y = 0, normal +y, with a vertex in its middle.
TriMesh sheet() {
  return test::plane(10, 40);
}
const TriMesh& ball() {
  static const TriMesh mesh = test::sphere(Vec3::Zero(), R, 6);
  return mesh;
}

Joint joint_of(Body fixed, Body mobile) {
  return {.name = "joint",
          .kind = JointKind::free,
          .side = Side::right,
          .fixed = std::move(fixed),
          .mobile = std::move(mobile),
          .anatomy = Anatomy::knee};
}
const Joint& ball_on_sheet() {
  static const Joint joint = joint_of({"sheet", sheet()}, {"ball", ball()});
  return joint;
}
Pose at_height(double y) {
  return Pose(Eigen::Translation3d(0, y, 0));
}

io::DepthResult result_of(const Joint& joint, const Pose& X_FM, const io::ContactEntry& entry = {}) {
  const io::DepthQuestion question{
      .joint = joint, .pose = {.translation_mm = X_FM.translation()}, .X_FM = X_FM};
  return io::depth_result(question, answer_depth(joint, {.X_FM = X_FM,
                                                         .method = DepthMethod::normal,
                                                         .casting = entry.casting,
                                                         .rays = entry.rays,
                                                         .distances = contact::DistancesOf::all_vertices}));
}
Json json_of(const Joint& joint, const Pose& X_FM, const io::ContactEntry& entry = {}) {
  return Json::parse(result_of(joint, X_FM, entry).json);
}

const io::MeshArray* array_named(const std::vector<io::MeshArray>& arrays, std::string_view name) {
  for (const io::MeshArray& array : arrays)
    if (array.name == name) return &array;
  return nullptr;
}

TEST(NormalDepthResult, ABallInASheetIsAsDeepAsItsCap) {
  const Json json = json_of(ball_on_sheet(), at_height(h));
  EXPECT_EQ(json["method"], "normal");
  EXPECT_TRUE(json["in_contact"]);
  EXPECT_GT(json["triangle_pairs"], 0);
  EXPECT_EQ(json["rays"], Json({{"casting", "both"}, {"rule", "cut_faces"}, {"reach_mm", 20.0}}));
  EXPECT_EQ(json["nearest_distance_mm"], 0);

  // Vertex above vertex.
  const Json &from_sheet = json["bodies"]["fixed"], &from_ball = json["bodies"]["mobile"];
  for (const Json* body : {&from_sheet, &from_ball})
    EXPECT_NEAR((*body)["max_normal_depth_mm"].get<double>(), R - h, 1e-12);

  // The ball's mesh sags by up to edge^2 / 4 R (docs/mathematics/08-known-answers.md), upwards by R / y of that at the
  // height y, and a depth taken as linear along edges e of the sheet falls short by up to e^2 / 8 times its curvature, R^2 / y^3. Both are
  // largest an edge beyond the border. What is found is then between the cap's figures and those of a sheet so much higher.
  const double e = std::numbers::sqrt2 * spacing, edge = inspect(ball()).edge_lengths.longest;
  const double y = std::sqrt(R * R - std::pow(std::sqrt(R * R - h * h) + e, 2));
  const double off = e * e / 8 * R * R / (y * y * y) + edge * edge / (4 * R) * R / y;
  const auto area = [](double height) { return std::numbers::pi * (R * R - height * height); };
  const auto volume = [](double height) {
    const double d = R - height;
    return std::numbers::pi * d * d * (3 * R - d) / 3;
  };
  const double found = from_sheet["area_mm2"];
  EXPECT_LT(found, area(h));
  EXPECT_GT(found, area(h + off));
  EXPECT_LT(area(h) - area(h + off), 0.02 * area(h)) << "narrow enough to say something";
  EXPECT_LT(found * from_sheet["mean_normal_depth_mm"].get<double>(), volume(h));
  EXPECT_GT(found * from_sheet["mean_normal_depth_mm"].get<double>(), volume(h + off));

  EXPECT_EQ(from_sheet["target"], "ball");
  EXPECT_EQ(from_ball["target"], "sheet");
  EXPECT_EQ(from_sheet["triangles"], 3200);
  for (const int k : {0, 1, 2}) EXPECT_NEAR(from_sheet["centre_mm"][k].get<double>(), 0, spacing / 100);
  EXPECT_EQ(from_sheet["centre_own_mm"], from_sheet["centre_mm"]);
  // The ball's own centre is h above.
  EXPECT_NEAR(from_ball["centre_mm"][1].get<double>() - from_ball["centre_own_mm"][1].get<double>(), h,
              1e-12);
  EXPECT_LT(from_ball["centre_mm"][1], 0);
}

TEST(NormalDepthResult, OnlyTheBodyThatCastsHasFiguresAndArrays) {
  const io::DepthResult result =
      result_of(ball_on_sheet(), at_height(h), {.casting = contact::Casting::fixed});
  const Json json = Json::parse(result.json);
  EXPECT_TRUE(json["bodies"]["mobile"].is_null());
  EXPECT_EQ(json["rays"]["casting"], "fixed");
  test::expect_silent(result.text, "from ball");
  test::expect_says(result.text, "  from sheet to ball: ");
  test::expect_says(result.text, "depth along normals ");
  test::expect_says(result.text, ", 1.000 at most, triangle ");

  EXPECT_EQ(array_named(result.mobile.triangles, "depth_mm"), nullptr);
  ASSERT_EQ(result.fixed.triangles.size(), 3u);
  EXPECT_EQ(result.fixed.triangles[0].name, "depth_mm") << "the one to colour by";
  const auto& depth = std::get<std::vector<double>>(result.fixed.triangles[0].values);
  const auto& areas =
      std::get<std::vector<double>>(array_named(result.fixed.triangles, "contact_area_mm2")->values);
  ASSERT_EQ(depth.size(), 3200u);
  ASSERT_EQ(areas.size(), 3200u);
  double area = 0, overlap = 0;
  std::size_t in_contact = 0;
  for (std::size_t t = 0; t < areas.size(); ++t) {
    area += areas[t];
    overlap += areas[t] * depth[t];
    in_contact += areas[t] > 0;
  }
  const Json& body = json["bodies"]["fixed"];
  EXPECT_NEAR(area, body["area_mm2"].get<double>(), 1e-10);
  EXPECT_NEAR(overlap / area, body["mean_normal_depth_mm"].get<double>(), 1e-12);
  EXPECT_EQ(in_contact, body["triangles_in_contact"]);
  EXPECT_GT(depth[body["deepest_triangle"].get<std::size_t>()], 0.9);
  EXPECT_EQ(array_named(result.fixed.points, "nearest_distance_mm"), &result.fixed.points.front());
}

TEST(NormalDepthResult, ExchangingTheBodiesExchangesTheirFigures) {
  const Joint exchanged = joint_of({"ball", ball()}, {"sheet", sheet()});
  const Pose X = at_height(h) * Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized());
  const Json here = json_of(ball_on_sheet(), X)["bodies"], there = json_of(exchanged, X.inverse())["bodies"];
  for (const auto& [one, other] : {std::pair{"fixed", "mobile"}, {"mobile", "fixed"}}) {
    const Json &a = here[one], &b = there[other];
    EXPECT_EQ(a["target"], b["target"]);
    EXPECT_EQ(a["triangles_in_contact"], b["triangles_in_contact"]);
    EXPECT_EQ(a["deepest_triangle"], b["deepest_triangle"]);
    for (const char* key : {"area_mm2", "mean_normal_depth_mm", "max_normal_depth_mm"})
      EXPECT_NEAR(a[key].get<double>(), b[key].get<double>(), 1e-9) << one << " " << key;
    for (const int k : {0, 1, 2})
      EXPECT_NEAR(a["centre_own_mm"][k].get<double>(), b["centre_own_mm"][k].get<double>(), 1e-9);
  }
}

TEST(NormalDepthResult, WithoutContactThereAreNoDepthsAndNoCentre) {
  const io::DepthResult result = result_of(ball_on_sheet(), at_height(R + 2));
  const Json json = Json::parse(result.json);
  EXPECT_FALSE(json["in_contact"]);
  EXPECT_NEAR(json["nearest_distance_mm"].get<double>(), 2, 1e-12);
  for (const char* body : {"fixed", "mobile"}) {
    const Json& figures = json["bodies"][body];
    EXPECT_EQ(figures["area_mm2"], 0);
    EXPECT_EQ(figures["max_normal_depth_mm"], 0);
    EXPECT_EQ(figures["triangles_in_contact"], 0);
    for (const char* key : {"deepest_triangle", "centre_mm", "centre_own_mm"})
      EXPECT_TRUE(figures[key].is_null()) << key;
  }
  test::expect_says(result.text, "  free; 0 intersecting");
  test::expect_says(result.text, "  from ball to sheet: no depth along normals\n");
}

TEST(NormalDepthResult, RaysFromTheFrontAndBeyondTheReachAreCounted) {
  // From the sheet to the ball, whose bottom is up to 1 mm below: a ray of half of that is cut off.
  const Json near = json_of(ball_on_sheet(), at_height(h), {.rays = {.reach_mm = 0.9}});
  EXPECT_GT(near["bodies"]["fixed"]["cut_off_by_reach"], 0);
  EXPECT_LE(near["bodies"]["fixed"]["max_normal_depth_mm"], 0.9);
  const Json usual = json_of(ball_on_sheet(), at_height(h));
  EXPECT_EQ(usual["bodies"]["fixed"]["cut_off_by_reach"], 0);
  EXPECT_EQ(usual["bodies"]["mobile"]["met_from_front"], 0);
  // The top of the ball is 39 mm above the sheet: its rays go down through all of the ball and meet the sheet's front.
  const io::DepthResult far = result_of(ball_on_sheet(), at_height(h), {.rays = {.reach_mm = 50}});
  const Json bodies = Json::parse(far.json)["bodies"];
  EXPECT_GT(bodies["mobile"]["met_from_front"], 0);
  EXPECT_EQ(bodies["fixed"]["met_from_front"], 0) << "the ball is closed";
  test::expect_says(far.text, "rays met sheet, which is open, from its front");
  test::expect_says(result_of(ball_on_sheet(), at_height(h), {.rays = {.reach_mm = 0.9}}).text,
                    "the reach of 0.9 mm cuts off ");
}

TEST(NormalDepthResult, AnOverlapOfSheetsThatDoNotMeetIsSaid) {
  // A lid within the bounds of a larger sheet above it: rays down from the large one's middle meet the lid from behind.
  const TriMesh lid = test::mesh_of({{-2, 0, -2}, {0, 0, 2}, {2, 0, -2}}, {{0, 2, 1}});
  const Joint joint = joint_of({"sheet", sheet()}, {"lid", lid});
  const io::DepthResult below = result_of(joint, at_height(-1), {.casting = contact::Casting::fixed});
  const Json json = Json::parse(below.json);
  EXPECT_FALSE(json["in_contact"]);
  EXPECT_NEAR(json["bodies"]["fixed"]["max_normal_depth_mm"].get<double>(), 1, 1e-12);
  EXPECT_GT(json["bodies"]["fixed"]["rim_faces"], 0);
  test::expect_says(below.text, "  the surfaces do not meet: ");
  test::expect_says(below.text, " triangles at the rim of lid, ");
}

TEST(NormalDepthResult, TheDeepestTriangleIsOfAPart) {
  const TriMesh far = posed(at_height(100), ball());
  const std::size_t first = far.triangles.size();
  Body body{"both balls", test::joined(far, ball())};
  body.parts = {{"far", 0, far.vertices.size(), 0, first},
                {"near", far.vertices.size(), ball().vertices.size(), first, ball().triangles.size()}};
  const io::DepthResult result =
      result_of(joint_of({"sheet", sheet()}, body), at_height(h), {.casting = contact::Casting::mobile});
  const Json deepest = Json::parse(result.json)["bodies"]["mobile"];
  EXPECT_EQ(deepest["deepest_part"]["name"], "near");
  EXPECT_EQ(deepest["deepest_part"]["triangle"].get<std::size_t>(),
            deepest["deepest_triangle"].get<std::size_t>() - first);
  test::expect_says(result.text, " of near)\n");
  test::expect_says(result.pairs, ",,near\n");
}

TEST(NormalDepthResult, IsWrittenWithItsTriangles) {
  const test::TemporaryFolder folder;
  const Joint& joint = ball_on_sheet();
  const io::DepthQuestion question{
      .joint = joint, .pose = {.translation_mm = {0, h, 0}}, .X_FM = at_height(h)};
  const io::DepthResult result = result_of(joint, at_height(h), {.casting = contact::Casting::fixed});
  io::write_depth(folder / "out", question, result, {io::VtpEncoding::text, io::VertexTables::write});
  const std::string fixed = io::read_whole_file(folder / "out/fixed.vtp"),
                    mobile = io::read_whole_file(folder / "out/mobile.vtp");
  for (const char* array : {"depth_mm", "contact_area_mm2", "in_contact", "nearest_distance_mm"}) {
    const std::string name = "Name=\"" + std::string(array) + "\"";
    EXPECT_NE(fixed.find(name), std::string::npos) << array;
    EXPECT_EQ(mobile.find(name) != std::string::npos,
              std::string(array) == "in_contact" || std::string(array) == "nearest_distance_mm")
        << array;
  }
  EXPECT_EQ(io::read_mesh(folder / "out/mobile.vtp").mesh, posed(at_height(h), ball()));
  test::expect_says(io::read_whole_file(folder / "out/fixed.csv"),
                    "vertex,x_mm,y_mm,z_mm,nearest_distance_mm\n");
}

}  // namespace
}  // namespace condyle
