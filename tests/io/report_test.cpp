#include "io/report/report.hpp"

#include "condyle/contact.hpp"
#include "core/thread_limit.hpp"
#include "io/file/output_file.hpp"
#include "io/file/whole_file.hpp"
#include "io/report/page.hpp"
#include "rom_scene.hpp"
#include "support/report_block.hpp"
#include "support/same_bits.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

using Json = nlohmann::json;

ReportBlock block_of(const io::Report& report) {
  return report_block(io::report_html(report));
}

/// Coordinates that no short decimal is equal to.
Joint odd_joint() {
  Joint joint = arm_and_post();
  TriMesh arm = shifted_by(joint.mobile.mesh.arrays(), Vec3(0.1, -1e-17, 1.0 / 3));
  arm.vertices.z[0] = -0.0;
  joint.mobile.mesh = arm;
  joint.mobile.parts = {{"shaft", 0, 4, 0, 6}, {"head", 4, 4, 6, 6, PartContact::bearing}};
  return joint;
}

void expect_is(const ReportBlock& block, const std::string& role, const Mesh& mesh) {
  std::vector<double> xyz;
  std::vector<std::uint32_t> corners;
  for (std::size_t v = 0; v < mesh.vertices().size(); ++v)
    xyz.insert(xyz.end(), {mesh.vertices().x[v], mesh.vertices().y[v], mesh.vertices().z[v]});
  for (const Triangle& triangle : mesh.triangles())
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  expect_same_bits(block.array<double>(role + "_vertices", "f64"), xyz);
  EXPECT_EQ(block.array<std::uint32_t>(role + "_triangles", "u32"), corners);
}

TEST(Report, HasTheJointToTheBit) {
  const Joint joint = odd_joint();
  const JointCoordinates reference{.angles = {Angle::degrees(30), Angle::degrees(-7), {}}};
  const ReportBlock block = block_of({.title = "a title", .joint = joint, .reference_pose = reference});
  expect_is(block, "fixed", joint.fixed.mesh);
  expect_is(block, "mobile", joint.mobile.mesh);
  EXPECT_EQ(block.json["title"], "a title");
  EXPECT_EQ(block.json["joint"], Json({{"name", "arm and post"},
                                       {"kind", "ball"},
                                       {"anatomy", "hip"},
                                       {"side", "right"},
                                       {"fixed", "post"},
                                       {"mobile", "arm"},
                                       {"translation_frame", "fixed"}}));
  EXPECT_EQ(block.json["coordinates"][2],
            Json({{"name", "internal_rotation"}, {"opposite", "external_rotation"}}));
  EXPECT_EQ(block.json["reference_deg"], (Json{30.0, -7.0, 0.0}));
  EXPECT_EQ(block.json["parts"]["fixed"], Json::array());
  EXPECT_EQ(block.json["parts"]["mobile"][1], Json({{"name", "head"},
                                                    {"first_vertex", 4},
                                                    {"vertices", 4},
                                                    {"first_triangle", 6},
                                                    {"triangles", 6},
                                                    {"contact", "bearing"}}));
}

/// Limits of the arm, and its map.
struct Answered {
  explicit Answered(const Joint& of)
      : joint(of),
        range(joint),
        limits(range.limits(motion::built_in_motions(joint.kind, joint.anatomy))),
        map(motion::motion_map({.row = {JointAngle::adduction, -10, 10, 5},
                                .column = {JointAngle::internal_rotation, -20, 20, 10},
                                .vary = JointAngle::flexion},
                               range)),
        answer{
            .joint = joint, .limits = limits, .bearing = range.bearing(), .caveats = {"a term"}, .map = map} {
  }

  Joint joint;
  motion::RangeOfMotion range;
  std::vector<motion::MotionLimit> limits;
  motion::MotionMap map;
  RangeAnswer answer;
  io::RomResult rom{joint, answer};
};

TEST(Report, SaysOfLimitsWhatRomSays) {
  const Answered answer(odd_joint());
  const ReportBlock block = block_of({.title = "", .joint = answer.joint, .rom = &answer.rom});
  Json said = Json::parse(io::rom_json(answer.rom));
  said["map"].erase("intervals");  // the page has them under "map"
  EXPECT_EQ(block.json["rom"], said);
  EXPECT_FALSE(block.json.contains("rom_error"));
  // Roles of triangles in contact have arrays only if they differ.
  EXPECT_EQ(block.json["arrays"].contains("mobile_roles"), !answer.range.bearing().roles.mobile.empty());
}

TEST(Report, HasWhatContactOfEachTriangleMeans) {
  const Joint joint = arm_and_post();
  motion::ContactRoles roles;
  roles.mobile.assign(12, motion::ContactRole::ends);
  roles.mobile[2] = motion::ContactRole::bearing, roles.mobile[5] = motion::ContactRole::bearing_on_bearing;
  roles.fixed.assign(12, motion::ContactRole::soft);
  const RangeAnswer without{.joint = joint, .bearing = {.roles = roles}};
  const io::RomResult rom{joint, without};
  const ReportBlock block = block_of({.title = "", .joint = joint, .rom = &rom});
  EXPECT_EQ(block.array<std::uint8_t>("mobile_roles", "u8"),
            (std::vector<std::uint8_t>{0, 0, 1, 0, 0, 3, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(block.array<std::uint8_t>("fixed_roles", "u8"), std::vector<std::uint8_t>(12, 2));
}

TEST(Report, HasAMapThatTranslatesInMillimetresWithWhatItHolds) {
  Joint joint = arm_and_post();
  joint.kind = JointKind::free;
  Answered answer(joint);
  const motion::MotionMap sliding =
      motion::motion_map({.row = {JointAngle::flexion, 0, 10, 10},
                          .column = {motion::MapCoordinate::translation(0), -1, 1, 1},
                          .vary = motion::MapCoordinate::translation(1),
                          .held = {.angles = {{}, Angle::degrees(2), {}}}},
                         answer.range);
  answer.answer.map = sliding;
  const io::RomResult rom{joint, answer.answer};
  const Json map = block_of({.title = "", .joint = joint, .rom = &rom}).json["map"];
  EXPECT_EQ(map["columns"]["translation"], "x");
  EXPECT_EQ(map["columns"]["values_mm"], (Json{-1.0, 0.0, 1.0}));
  EXPECT_EQ(map["rows"]["values_deg"], (Json{0.0, 10.0}));
  EXPECT_EQ(map["start_mm"], 0);
  EXPECT_EQ(map["range_mm"], (Json{-50.0, 50.0}));
  EXPECT_FALSE(map.contains("start_deg"));
  EXPECT_EQ(map["held_deg"], (Json{0.0, Angle::degrees(2).degrees(), 0.0}));
  EXPECT_EQ(map["held_mm"], (Json{0.0, 0.0, 0.0}));
  ASSERT_EQ(map["intervals"].size(), sliding.slides.size());
  for (std::size_t i = 0; i < sliding.slides.size(); ++i)
    for (std::size_t k = 0; k < sliding.slides[i].intervals.size(); ++k) {
      const motion::FreeSlide& free = sliding.slides[i].intervals[k];
      EXPECT_EQ(map["intervals"][i][k], (Json{*free.low.at_mm, *free.high.at_mm, free.low.contact ? 1 : 0,
                                              free.high.contact ? 1 : 0}));
    }
}

TEST(Report, HasAllFreeIntervalsOfAMap) {
  const Answered answer(arm_and_post());
  const Json map = block_of({.title = "", .joint = answer.joint, .rom = &answer.rom}).json["map"];
  EXPECT_EQ(map["columns"], Json({{"angle", "internal_rotation"},
                                  {"opposite", "external_rotation"},
                                  {"values_deg", {-20.0, -10.0, 0.0, 10.0, 20.0}}}));
  EXPECT_EQ(map["rows"]["values_deg"], (Json{-10.0, -5.0, 0.0, 5.0, 10.0}));
  EXPECT_EQ(map["vary"], "flexion");
  EXPECT_EQ(map["vary_opposite"], "extension");
  EXPECT_EQ(map["range_deg"], (Json{-180.0, 180.0}));
  ASSERT_EQ(map["intervals"].size(), answer.map.points.size());
  bool some_end_by_contact = false;
  for (std::size_t i = 0; i < answer.map.points.size(); ++i) {
    const auto& intervals = answer.map.points[i].intervals;
    ASSERT_EQ(map["intervals"][i].size(), intervals.size());
    for (std::size_t k = 0; k < intervals.size(); ++k) {
      const Json& given = map["intervals"][i][k];
      EXPECT_EQ(given[0], intervals[k].low.degrees());
      EXPECT_EQ(given[1], intervals[k].high.degrees());
      EXPECT_EQ(given[2], intervals[k].at_low.reason == motion::LimitReason::contact ? 1 : 0);
      EXPECT_EQ(given[3], intervals[k].at_high.reason == motion::LimitReason::contact ? 1 : 0);
      some_end_by_contact |= given[3] == 1;
    }
  }
  EXPECT_TRUE(some_end_by_contact);
}

TEST(Report, HasRadialGapsInTheReferencePoseAndAtEveryLimit) {
  const Answered answer(arm_and_post());
  const ReportBlock block = block_of({.title = "", .joint = answer.joint, .rom = &answer.rom});
  const Json& poses = block.json["poses"];
  ASSERT_EQ(poses.size(), 1 + answer.limits.size());
  EXPECT_EQ(poses[0]["name"], "reference");
  EXPECT_EQ(poses[0]["pose"], Json::parse("[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]"));
  EXPECT_EQ(poses[0]["in_contact"], false);
  EXPECT_EQ(poses[0]["contact_point_mm"], nullptr);
  const contact::JointContact contact(answer.joint);
  bool some_gap = false, no_gap = false;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const JointAngles angles = i == 0 ? JointAngles{} : answer.limits[i - 1].angles_at_limit();
    EXPECT_EQ(poses[i]["coordinates_deg"], (Json{angles.flexion.degrees(), angles.adduction.degrees(),
                                                 angles.internal_rotation.degrees()}));
    const contact::RadialContact at = contact.radial(pose_at(answer.joint.coordinates(), angles));
    const auto check = [&](const char* key, const radial::RadialResults& results) {
      const auto gaps = block.array<std::int16_t>(poses[i][key], "i16");
      ASSERT_EQ(gaps.size(), results.size());
      for (std::size_t v = 0; v < gaps.size(); ++v) {
        const double gap_mm = results.radial_gap_mm[v];
        if (std::isinf(gap_mm)) {
          EXPECT_EQ(gaps[v], 32767);
          no_gap = true;
        } else {
          EXPECT_NEAR(gaps[v] / 100.0, std::clamp(gap_mm, -327.68, 327.66), 0.005 + 1e-12) << i << " " << v;
          some_gap = true;
        }
      }
    };
    check("fixed_gaps", *at.fixed_in_mobile);
    check("mobile_gaps", *at.mobile_in_fixed);
  }
  EXPECT_TRUE(some_gap && no_gap);
  EXPECT_EQ(poses[1]["name"], "flexion");
  EXPECT_EQ(poses[1]["contact_point_mm"], block.json["rom"]["motions"][0]["contact_point_mm"]);
}

TEST(Report, HasOfAJointBeforeItsLimitsAndTheBodiesThatChanged) {
  const Answered before(arm_and_post());
  Joint moved = arm_and_post();
  moved.fixed.mesh = box({50, -120, -50}, {70, -80, 50});
  const Answered after(moved);
  const io::Report report{
      .title = "",
      .joint = after.joint,
      .rom = &after.rom,
      .before = io::ReportedBefore{.joint = before.joint, .file = "folder/before.toml", .rom = &before.rom}};
  const ReportBlock block = block_of(report);
  const Json& found = block.json["before"];
  EXPECT_EQ(found["file"], "before.toml");
  EXPECT_EQ(found["joint"], Json({{"name", "arm and post"}, {"fixed", "post"}, {"mobile", "arm"}}));
  EXPECT_FALSE(found.contains("rom_error"));
  EXPECT_EQ(found["surfaces"]["mobile"], nullptr) << "the arm is the same";
  EXPECT_EQ(found["surfaces"]["fixed"],
            Json({{"vertices", "before_fixed_vertices"}, {"triangles", "fixed_triangles"}}))
      << "its triangles are the same";
  expect_same_bits(block.array<double>("before_fixed_vertices", "f64"),
                   block_of({.title = "", .joint = before.joint}).array<double>("fixed_vertices", "f64"));
  ASSERT_EQ(found["differences"].size(), after.limits.size());
  for (std::size_t i = 0; i < after.limits.size(); ++i) {
    const Json& difference = found["differences"][i];
    const Json &then = found["rom"]["motions"][i], &now = block.json["rom"]["motions"][i];
    EXPECT_EQ(difference["motion"], now["name"]);
    if (then["reason"] != "contact" || now["reason"] != "contact") continue;
    EXPECT_EQ(difference["difference_deg"].get<double>(),
              now["limit_deg"].get<double>() - then["limit_deg"].get<double>());
  }
  EXPECT_GT(found["differences"][0]["difference_deg"], 0) << "the post is farther away";
}

TEST(Report, SaysWhyAJointBeforeHasNoLimits) {
  const Joint joint = arm_and_post();
  const ReportBlock block = block_of(
      {.title = "",
       .joint = joint,
       .rom_error = "here",
       .before = io::ReportedBefore{.joint = joint, .file = {}, .rom = nullptr, .rom_error = "there"}});
  const Json& before = block.json["before"];
  EXPECT_EQ(before["file"], nullptr);
  EXPECT_EQ(before["rom"], nullptr);
  EXPECT_EQ(before["rom_error"], "there");
  EXPECT_EQ(before["differences"], Json::array());
  EXPECT_EQ(before["surfaces"], Json({{"fixed", nullptr}, {"mobile", nullptr}}));
  EXPECT_FALSE(block_of({.title = "", .joint = joint}).json.contains("before"));
}

TEST(Report, SaysWhyThereAreNoLimitsAndStoresNoPosesOfOpenMeshes) {
  Joint joint = arm_and_post();
  TriMesh post = joint.fixed.mesh.arrays();
  post.triangles.pop_back();
  joint.fixed.mesh = post;
  const ReportBlock block = block_of({.title = "", .joint = joint, .rom_error = "post: is <open>"});
  EXPECT_EQ(block.json["rom"], nullptr);
  EXPECT_EQ(block.json["map"], nullptr);
  EXPECT_EQ(block.json["rom_error"], "post: is <open>");
  EXPECT_EQ(block.json["poses"], Json::array());
  expect_is(block, "fixed", joint.fixed.mesh);
}

TEST(Report, StoresNoPosesWhereTheCentreLiesOnASurface) {
  Joint joint = arm_and_post();
  joint.mobile.mesh = box({-1, -100, -2}, {1, 0, 2});
  const ReportBlock block = block_of({.title = "", .joint = joint});
  EXPECT_EQ(block.json["poses"], Json::array());
  expect_is(block, "mobile", joint.mobile.mesh);
}

/// The page asks the core, which knows five.
TEST(Report, NamesTheAnatomyThatAHingeOfNoJointTurnsAs) {
  Joint joint = arm_and_post();
  joint.kind = JointKind::hinge;
  EXPECT_EQ(block_of({.title = "", .joint = joint}).json["joint"]["anatomy"], "hip");
}

TEST(Report, HasFramesOfARecordedMotionWithItsGaps) {
  io::LoadedJoint loaded{.joint = arm_and_post(), .report = {}};
  io::JointMotion motion;
  motion.times = {.values = {0, 0.1, 0.3}, .in_seconds = true};
  const Pose bent = pose_at(loaded.joint.coordinates(), JointAngles{Angle::degrees(20), {}, {}});
  motion.X_FM = {Pose::Identity(), std::nullopt, bent};
  const io::ContactSurfaces surfaces{loaded.joint.fixed, loaded.joint.mobile};
  const io::MotionQuestion question{.joint = loaded, .motion = motion, .surfaces = surfaces, .contact = {}};
  MotionAnswer answer;
  answer.frames = {motion::FrameContact{.X_FM = Pose::Identity(), .smallest_gap_mm = 12.5}, std::nullopt,
                   motion::FrameContact{.X_FM = bent, .smallest_gap_mm = 1.0 / 3}};
  const ReportBlock block = block_of(
      {.title = "", .joint = loaded.joint, .recorded = io::ReportedMotion{"walk", question, answer}});
  const Json& recorded = block.json["recorded"];
  EXPECT_EQ(recorded["name"], "walk");
  EXPECT_EQ(recorded["axis"], "time_s");
  expect_same_bits(block.array<double>(recorded["times_s"], "f64"), motion.times.values);
  const auto degrees = block.array<double>(recorded["coordinates_deg"], "f64");
  const auto poses = block.array<double>(recorded["poses"], "f64");
  ASSERT_EQ(degrees.size(), 9u);
  ASSERT_EQ(poses.size(), 48u);
  EXPECT_TRUE(std::isnan(degrees[4]));
  EXPECT_NEAR(degrees[6], 20, 1e-13);
  EXPECT_TRUE(std::isnan(poses[20]));
  for (std::size_t k = 0; k < 16; ++k)
    EXPECT_EQ(poses[32 + k], bent.matrix()(static_cast<int>(k / 4), static_cast<int>(k % 4)));
  EXPECT_EQ(block.array<double>(recorded["coordinates_mm"], "f64").size(), 9u);
  const io::Curves curves = io::curves_of(question, answer);
  ASSERT_EQ(recorded["curves"].size(), curves.names.size());
  for (std::size_t i = 0; i < curves.names.size(); ++i) {
    EXPECT_EQ(recorded["curves"][i]["name"], curves.names[i]);
    const auto values = block.array<double>(recorded["curves"][i]["values"], "f64");
    ASSERT_EQ(values.size(), 3u);
    EXPECT_TRUE(std::isnan(values[1]));
    if (curves.names[i] == "smallest_gap_mm") {
      EXPECT_EQ(recorded["curves"][i]["unit"], "mm");
      EXPECT_EQ(values[2], 1.0 / 3);
    }
  }
}

TEST(Report, AnyTextStaysTextAndNeverBecomesMarkup) {
  Joint joint = arm_and_post();
  joint.name = "</script><script>alert(\"1\")</script><!--condyle-data-->";
  joint.fixed.name = "\xD7\xA2\xD7\xA6\xD7\x9D \xE2\x80\xAE'\"&amp;<b>\t\n\\";
  joint.mobile.name = std::string(1 << 20, 'M');
  const std::string html = io::report_html({.title = joint.name, .joint = joint});
  const ReportBlock block = report_block(html);
  EXPECT_EQ(block.json["title"], joint.name);
  EXPECT_EQ(block.json["joint"]["name"], joint.name);
  EXPECT_EQ(block.json["joint"]["fixed"], joint.fixed.name);
  EXPECT_EQ(block.json["joint"]["mobile"], joint.mobile.name);
  // But for the data the page is the template, to the byte.
  std::string without = html;
  const std::string element = data_element(html);
  without.replace(without.find(element), element.size(), "<!--condyle-data-->");
  EXPECT_EQ(without, io::read_whole_file(CONDYLE_REPORT_TEMPLATE));
}

TEST(Report, ReplacesBytesThatAreNoText) {
  Joint joint = arm_and_post();
  joint.name = "a\xFFz";
  EXPECT_EQ(block_of({.title = "", .joint = joint}).json["joint"]["name"], "a\xEF\xBF\xBDz");
}

TEST(Report, IsTheSameBytesOnOneThreadAndOnMany) {
  const Answered answer(arm_and_post());
  const io::Report report{.title = "", .joint = answer.joint, .rom = &answer.rom};
  const std::string many = io::report_html(report);
  const core::ThreadLimit one(1);
  EXPECT_EQ(io::report_html(report), many);
}

TEST(Report, IsWrittenWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const Joint joint = arm_and_post();
  const io::Report report{.title = "", .joint = joint};
  io::write_report(folder / "new/deep/report.html", report);
  EXPECT_EQ(io::read_whole_file(folder / "new/deep/report.html"), io::report_html(report));
  folder.file("file", "in the way");
  EXPECT_THROW(io::write_report(folder / "file/report.html", report), FileError);
  EXPECT_THROW(io::check_output_file(folder / "file/report.html"), FileError);
  EXPECT_THROW(io::check_output_file(folder / "new"), FileError);
  EXPECT_THROW(io::check_output_file(""), FileError);
  io::check_output_file(folder / "other/report.html");
  EXPECT_FALSE(std::filesystem::exists(folder / "other"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(ReportPage, NeedsExactlyOnePlaceForTheData) {
  EXPECT_THROW(io::page_with("<html></html>", "data"), std::logic_error);
  EXPECT_THROW(io::page_with("<!--condyle-data--><!--condyle-data-->", "data"), std::logic_error);
  const std::string page = io::page_with("before<!--condyle-data-->after", "data");
  expect_begins(page, "before<script type=\"application/octet-stream\" id=\"condyle-data\">");
  expect_ends(page, "</script>after");
}

TEST(ReportPage, TheTemplateInTheProgramIsThatOfTheRepository) {
  EXPECT_TRUE(io::report_template() == io::read_whole_file(CONDYLE_REPORT_TEMPLATE))
      << "another template is built in";
  EXPECT_NE(io::page_with(io::report_template(), ""), "");
}

/// The arm turns as a whole and shifts; the post does not.
Joint turning_joint() {
  Joint joint = odd_joint();
  PosedPart arm{.name = "arm", .body = BodyRole::mobile, .centre = Vec3(0.1, 0, 0)};
  arm.parameters = {
      {.name = "turn", .kind = ParameterKind::version, .low = -10, .high = 20, .sigma = 0.3},
      {.name = "out", .kind = ParameterKind::translation, .low = -1, .high = 1, .direction = Vec3::UnitX()}};
  joint.posed = PosedParts{
      {arm}, {joint.fixed.mesh, {}, {}}, {joint.mobile.mesh, {}, Sphere{Vec3(0.1, 0.2, 1.0 / 3), 0.7}}};
  return joint;
}

TEST(Report, HasThePartsThatTurnAndTheBodiesAsGivenWhereTheyTurned) {
  const Joint given = turning_joint();
  const ParameterValue values[] = {{"arm.turn", 1.0 / 3}};
  const Joint joint = with_parameters(given, values);
  const ReportBlock block = block_of({.title = "a title", .joint = joint, .bearing_margin_mm = 1.5});
  const Json& posed = block.json["posed"];
  EXPECT_EQ(posed["bearing_margin_mm"], 1.5);
  const Json& part = posed["parts"][0];
  EXPECT_EQ(part["name"], "arm");
  EXPECT_EQ(part["body"], "mobile");
  EXPECT_EQ(part["centre_mm"], (Json{0.1, 0.0, 0.0}));
  EXPECT_EQ(part["parameters"][0], Json({{"name", "turn"},
                                         {"kind", "version"},
                                         {"unit", "deg"},
                                         {"range", {-10.0, 20.0}},
                                         {"value", 1.0 / 3},
                                         {"in_joint_file", 0.0},
                                         {"as_given", 0.0},
                                         {"sigma", 0.3},
                                         {"along", {0.0, 0.0, 0.0}}}));
  EXPECT_EQ(posed["fixed"]["as_given"], nullptr);
  EXPECT_EQ(posed["mobile"]["head"]["radius_mm"], 0.7);
  EXPECT_EQ(posed["mobile"]["cut_triangles"], (Json{0, 0}));
  std::vector<double> xyz;
  for (std::size_t v = 0; v < given.mobile.mesh.vertices().size(); ++v)
    for (int i = 0; i < 3; ++i) xyz.push_back(given.mobile.mesh.vertices()[v][i]);
  expect_same_bits(block.array<double>(posed["mobile"]["as_given"].get<std::string>(), "f64"), xyz);
  expect_is(block, "mobile", joint.mobile.mesh);
}

TEST(Report, HasNoPartsOfAJointWithout) {
  const Joint joint = odd_joint();
  EXPECT_FALSE(block_of({.title = "a title", .joint = joint}).json.contains("posed"));
}

}  // namespace
}  // namespace condyle::test
