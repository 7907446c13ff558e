#include "io/result/rom_result.hpp"

#include <charconv>
#include <nlohmann/json.hpp>
#include <sstream>

#include "answer/limit_facts.hpp"
#include "answer/motion_caveats.hpp"
#include "io/result/clock_text.hpp"
#include "io/result/scope_text.hpp"
#include "rom_scene.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

using Json = nlohmann::json;

Json json_of(const RangeAnswer& answer) {
  return Json::parse(io::rom_json(shown(answer)));
}
std::string text_of(const RangeAnswer& answer, io::TextForm form = io::TextForm::brief) {
  return io::rom_text(shown(answer), form);
}

/// Numbers that no short decimal is equal to, and every kind of feature.
std::vector<motion::MotionLimit> some_limits() {
  motion::MotionLimit contact;
  contact.motion = {"flexion",
                    JointAngle::flexion,
                    RotationSense::positive,
                    {Angle::degrees(0.1), Angle::degrees(1.0 / 3), Angle::degrees(-7)},
                    Angle::degrees(180)};
  contact.end.turned = Angle::radians(1.2345678901234567);
  contact.end.reason = motion::LimitReason::contact;
  contact.end.contact = {{motion::FeatureKind::edge, 3, 17},
                         {motion::FeatureKind::face, 40},
                         {0.1, 1.0 / 3, -2e-17},
                         {7, 8, 9},
                         motion::ContactKind::impingement};
  contact.end.bearing_contact =
      motion::EarlierContact{Angle::radians(1.1), motion::ContactWitness{{}, {}, {1, 2, 3}, {4, 5, 6}}};
  contact.head = motion::HeadAtLimit{.centre_distance_mm = 1.0 / 3, .joint_space_mm = 0.1};
  contact.end.error_bound = Angle::radians(1.5e-12);
  motion::MotionLimit ended;
  ended.motion = {
      "own, \"odd\" motion", JointAngle::internal_rotation, RotationSense::negative, {}, Angle::degrees(40)};
  ended.end.turned = Angle::degrees(40);
  motion::MotionLimit swallowed;
  swallowed.motion = {"schön", JointAngle::adduction, RotationSense::negative, {}, Angle::degrees(90)};
  swallowed.end.reason = motion::LimitReason::contact_at_start;
  return {contact, ended, swallowed};
}

motion::BearingSurface some_bearing() {
  motion::BearingSurface surface;
  surface.head = {{0.1, 0.2, 0.3}, 24.5};
  surface.margin_mm = 1.75, surface.rim_gap_mm = 2.25;
  surface.triangles = {1, 0, 1};
  return surface;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(RomJson, HasEveryKeyAndEveryBitOfTheNumbers) {
  const Joint joint = arm_and_post();
  const std::vector<motion::MotionLimit> limits = some_limits();
  const Json json = json_of({.joint = joint,
                             .limits = limits,
                             .bearing = {some_bearing(), {}},
                             .bearing_rule = motion::BearingRule::leave_out,
                             .caveats = {"a term"}});
  EXPECT_EQ(json["condyle"], 1);
  EXPECT_EQ(json["joint"], "arm and post");
  EXPECT_EQ(json["fixed"], "post");
  EXPECT_EQ(json["mobile"], "arm");
  EXPECT_EQ(json["side"], "right");
  EXPECT_EQ(json["caveats"], Json({"a term"}));
  EXPECT_EQ(json["bearing"]["rule"], "leave_out");
  EXPECT_EQ(json["bearing"]["head"]["centre_mm"], (Json{0.1, 0.2, 0.3}));
  EXPECT_EQ(json["bearing"]["head"]["radius_mm"], 24.5);
  EXPECT_EQ(json["bearing"]["margin_mm"], 1.75);
  EXPECT_EQ(json["bearing"]["rim_gap_mm"], 2.25);
  EXPECT_EQ(json["bearing"]["triangles"], 2);
  EXPECT_TRUE(json["bearing"]["socket"].is_null());
  expect_says(json["scope"].get<std::string>(), "not a medical device");
  EXPECT_FALSE(json.contains("map"));
  ASSERT_EQ(json["motions"].size(), 3u);

  const Json& flexion = json["motions"][0];
  EXPECT_EQ(flexion["name"], "flexion");
  EXPECT_EQ(flexion["limit_deg"].get<double>(), limits[0].end.turned.degrees());
  EXPECT_EQ(flexion["reason"], "contact");
  EXPECT_EQ(flexion["contact_kind"], "impingement");
  EXPECT_EQ(flexion["bearing_contact_deg"].get<double>(), Angle::radians(1.1).degrees());
  EXPECT_EQ(flexion["bearing_contact_point_mm"], (Json{1.0, 2.0, 3.0}));
  EXPECT_EQ(flexion["centre_distance_mm"], 1.0 / 3);
  EXPECT_EQ(flexion["joint_space_mm"], 0.1);
  EXPECT_EQ(flexion["contact_point_mm"], (Json{0.1, 1.0 / 3, -2e-17}));
  EXPECT_EQ(flexion["contact_point_mobile_mm"], (Json{7.0, 8.0, 9.0}));
  EXPECT_EQ(flexion["features"]["fixed"], (Json{{"kind", "edge"}, {"vertices", {3, 17}}}));
  EXPECT_EQ(flexion["features"]["mobile"], (Json{{"kind", "face"}, {"id", 40}}));
  EXPECT_EQ(flexion["error_bound_deg"].get<double>(), limits[0].end.error_bound.degrees());
  EXPECT_EQ(flexion["vary"], "flexion");
  EXPECT_EQ(flexion["sense"], "positive");
  EXPECT_EQ(flexion["range_deg"].get<double>(), limits[0].motion.range.degrees());
  EXPECT_EQ(flexion["start_deg"]["adduction"].get<double>(), limits[0].motion.start.adduction.degrees());
  EXPECT_EQ(flexion["held_deg"].size(), 2u);
  EXPECT_EQ(flexion["normal_range_deg"], 120);
  EXPECT_EQ(flexion["held_deg"]["internal_rotation"].get<double>(),
            limits[0].motion.start.internal_rotation.degrees());
  EXPECT_EQ(flexion["at_limit_deg"]["flexion"].get<double>(), limits[0].angles_at_limit().flexion.degrees());
  EXPECT_EQ(flexion["guarantee"], guarantee_text(limits[0]));

  EXPECT_EQ(json["normal_range_source"], "AAOS 1965");

  const Json& ended = json["motions"][1];
  EXPECT_EQ(ended["reason"], "end_of_range");
  EXPECT_EQ(ended["at_limit_deg"]["internal_rotation"].get<double>(), -ended["limit_deg"].get<double>());
  for (const char* key : {"contact_kind", "contact_point_mm", "contact_point_mobile_mm", "features",
                          "bearing_contact_deg", "centre_distance_mm", "joint_space_mm", "normal_range_deg"})
    EXPECT_TRUE(ended.at(key).is_null()) << key;
  const Json& swallowed = json["motions"][2];
  EXPECT_EQ(swallowed["reason"], "contact_at_start");
  EXPECT_EQ(swallowed["limit_deg"], 0.0);
  EXPECT_EQ(swallowed["contact_kind"], "unknown");
  EXPECT_TRUE(swallowed["features"].is_null());
}

TEST(RomJson, IsValidWhateverBytesTheNamesHold) {
  Joint joint = arm_and_post();
  joint.name = "\xff\"\n";
  std::vector<motion::MotionLimit> limits = some_limits();
  limits[0].motion.name = "\xc3";
  EXPECT_TRUE(Json::accept(io::rom_json(shown({.joint = joint, .limits = limits}))));
}

TEST(RomCsv, HasAsManyFieldsInEveryLineAndEveryBitOfTheNumbers) {
  const Joint joint = arm_and_post();
  const std::vector<motion::MotionLimit> limits = some_limits();
  const auto lines = lines_of(io::rom_csv(shown({.joint = joint, .limits = limits})));
  ASSERT_EQ(lines.size(), 4u);
  const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  EXPECT_EQ(commas(lines[1]), commas(lines[0]));
  EXPECT_EQ(commas(lines[2]), commas(lines[0]) + 1);  // one in a quoted name
  EXPECT_EQ(commas(lines[3]), commas(lines[0]));
  expect_begins(lines[2], "\"own, \"\"odd\"\" motion\",40,end_of_range,,");
  double turned = 0;
  const char* digits = lines[1].c_str() + std::string("flexion,").size();
  std::from_chars(digits, lines[1].c_str() + lines[1].size(), turned);
  EXPECT_EQ(turned, limits[0].end.turned.degrees());
  expect_says(lines[1], ",edge 3-17,face 40,");
  expect_ends(lines[3], ",,,,,,,,,,,,,,,end_unknown");
  EXPECT_TRUE(lines[1].ends_with(",120,,,,bone_may_end")) << "the normal range of flexion, and what ends it";
}

TEST(RomCsv, NamesTheMeshesThatMeet) {
  Joint joint = arm_and_post();
  joint.mobile.parts = {{"shaft", 0, joint.mobile.mesh.vertices().size(), 0, 40},
                        {"tip", joint.mobile.mesh.vertices().size(), 0, 40, 1000}};
  const auto lines = lines_of(io::rom_csv(shown({.joint = joint, .limits = some_limits()})));
  expect_says(lines[0], ",fixed_feature,mobile_feature,fixed_part,mobile_part,");
  expect_says(lines[1], ",edge 3-17,face 40,,tip,");
}

TEST(RomText, AlignsItsColumnsAndSaysReasonsInWords) {
  const Joint joint = arm_and_post();
  const std::vector<motion::MotionLimit> limits = some_limits();
  const auto lines = lines_of(text_of({.joint = joint,
                                       .limits = limits,
                                       .bearing = {some_bearing(), {}},
                                       .bearing_rule = motion::BearingRule::leave_out,
                                       .caveats = {"left out: nothing"}}));
  ASSERT_GT(lines.size(), 6u);
  EXPECT_EQ(lines[0], "arm and post: arm in post, right side");
  EXPECT_EQ(lines[1], "  left out: nothing") << "a bearing surface with a rim is as usual";
  EXPECT_EQ(lines[2], "  zero: given by the reference pose stated");
  // Column of the first letter of the reasons; an umlaut is two bytes and one letter, a dash three.
  const std::size_t column = lines[3].find("ended by");
  EXPECT_EQ(lines[4].find("impingement"), column);
  EXPECT_EQ(lines[5].find("no contact in range"), column + 2);
  EXPECT_EQ(lines[6].find("in contact at start"), column + 1);
  expect_says(lines[4], " 70.74 ");  // 1.2345678901 rad
  EXPECT_TRUE(lines[4].ends_with(" 63.03")) << "bearing contact at 1.1 rad: " << lines[4];
  expect_says(lines[5], " >40 ");
  const std::size_t living = lines[3].find("living hips");
  EXPECT_EQ(lines[4].find("clinical 120 "), living)
      << "it starts from adduction, which the cadavers' did not: " << lines[4];
  EXPECT_EQ(lines[5].find("groups' means 23–56"), living) << lines[5];
}

TEST(RomText, SaysWhereNoRimWasFoundAndNoMinusBeforeZero) {
  Joint joint = arm_and_post();
  const std::vector<motion::MotionLimit> limits = some_limits();
  motion::BearingSurface bearing = some_bearing();
  const auto text = [&] {
    return text_of({.joint = joint, .limits = limits, .bearing = {bearing, {}}}, io::TextForm::whole);
  };
  expect_says(text(), "bearing surface: 2 of 3 triangles of arm");
  expect_says(text(), "(radius 24.50 mm, rim 2.25 mm from it)");
  bearing.rim_gap_mm.reset();
  expect_says(text(), "(radius 24.50 mm, no rim was found)");
  bearing.margin_mm = by_head(motion::usual_bearing_margin_mm, bearing.head);
  expect_says(
      text(),
      "within 2.04 mm of the head's sphere\n    (radius 24.50 mm, no rim was found: the usual margin)");
  bearing.parts = {"cartilage"};
  expect_silent(text(), "no rim");
  // The contact point of the first limit has z = -2e-17; joints without a clock have it in the text.
  joint.anatomy = Anatomy::knee;
  expect_says(text(), "(0.10, 0.33, 0.00)");
}

TEST(RomJson, SaysThatTheTwoBedsideTestsAreAsDefinedHere) {
  const Joint joint = arm_and_post();
  std::vector<motion::MotionLimit> limits(3);
  for (std::size_t i = 0; i < 3; ++i) limits[i].motion.name = (std::array{"fadir", "flexion", "faber"})[i];
  const Json motions = json_of({.joint = joint, .limits = limits})["motions"];
  for (const std::size_t i : {0, 2})
    EXPECT_EQ(motions[i]["definition"], "as defined here; no angles are agreed on");
  EXPECT_TRUE(motions[1]["definition"].is_null());
}

std::vector<std::string> codes_of(const Joint& joint, const motion::Motion& motion) {
  std::vector<std::string> codes;
  for (const MotionCaveat& caveat : motion_caveats(joint, motion)) codes.emplace_back(name_of(caveat.code));
  return codes;
}

/// By the table of docs/range-of-motion.md.
TEST(MotionCaveats, SayOfEachMotionOfAHipWhetherBoneUsuallyEndsIt) {
  using Codes = std::vector<std::string>;
  const std::map<std::string, Codes> expected{
      {"flexion", {"bone_may_end"}},
      {"extension", {"soft_tissue_ends"}},
      {"abduction", {"end_unknown"}},
      {"adduction", {"bone_may_end"}},
      {"internal_rotation", {"capsule_restrains"}},
      {"external_rotation", {"capsule_restrains"}},
      {"abduction_at_90_flexion", {"bone_may_end", "bone_may_end"}},
      {"adduction_at_90_flexion", {"soft_tissue_ends"}},
      {"internal_rotation_at_90_flexion", {"soft_tissue_close", "labrum_not_modelled"}},
      {"external_rotation_at_90_flexion", {"capsule_restrains"}},
      {"fadir", {"bone_may_end", "labrum_not_modelled"}},
      {"faber", {"capsule_restrains"}}};
  const Joint joint = arm_and_post();
  std::size_t known = 0;
  for (const motion::Motion& motion : motion::hip_motions()) {
    EXPECT_EQ(codes_of(joint, motion), expected.at(motion.name)) << motion.name;
    ++known;
    for (const MotionCaveat& caveat : motion_caveats(joint, motion)) {
      expect_ends(caveat.text, ".");
      EXPECT_EQ(caveat.source.empty(), caveat.code == MotionCaveatCode::end_unknown) << motion.name;
    }
  }
  EXPECT_EQ(known, expected.size());
}

TEST(MotionCaveats, AreOfMotionsThatTurnAsTheirNameSaysAndOfHipsOnly) {
  Joint joint = arm_and_post();
  motion::Motion motion = motion::motion_named(motion::hip_motions(), "extension");
  motion.sense = RotationSense::positive;
  EXPECT_EQ(codes_of(joint, motion), std::vector<std::string>{"end_unknown"});
  motion = motion::motion_named(motion::hip_motions(), "fadir");
  joint.fixed.name = "pelvis with Labrum";
  EXPECT_EQ(codes_of(joint, motion), std::vector<std::string>{"bone_may_end"});
  joint.anatomy = Anatomy::knee;
  EXPECT_TRUE(codes_of(joint, motion).empty());
}

TEST(Scope, IsOsseousOnlyWhereAllMeshesAreBones) {
  Joint joint = arm_and_post();
  expect_begins(io::scope_text(joint), "osseous contact only; soft tissue is not modelled");
  const std::size_t vertices = joint.mobile.mesh.vertices().size();
  const std::size_t triangles = joint.mobile.mesh.triangles().size();
  joint.mobile.parts = {
      {"femur", 0, vertices / 2, 0, triangles / 2},
      {"Femoral_Cartilage", vertices / 2, vertices - vertices / 2, triangles / 2, triangles - triangles / 2}};
  expect_begins(io::scope_text(joint), "contact of the bones and cartilages given; ");
  joint.fixed.name = "labrum";
  expect_begins(io::scope_text(joint), "contact of the bones, cartilages and labrum given; ");
  joint.mobile.parts.clear();
  joint.mobile.name = "lateral meniscus", joint.fixed.name = "tibial cartilage";
  expect_begins(io::scope_text(joint), "contact of the cartilages and menisci given; ");
  for (const std::string& scope : {io::scope_text(joint), io::scope_text(arm_and_post()), io::scope_text()})
    expect_ends(scope, "; research software, not a medical device");
}

TEST(Scope, TakesAllWordsOfAName) {
  Joint joint = arm_and_post();
  joint.fixed.name = "acetabular cartilage with labrum", joint.mobile.name = "implant";
  expect_begins(io::scope_text(joint), "contact of the cartilages, labrum and implants given; ");
  EXPECT_EQ(codes_of(joint, motion::motion_named(motion::hip_motions(), "fadir")),
            std::vector<std::string>{"bone_may_end"});
  joint.fixed.name = "joint capsule";
  expect_begins(io::scope_text(joint), "contact of the soft tissue and implants given; ");
}

TEST(Scope, NamesLayersThatSurfacesCarry) {
  Joint joint = arm_and_post();
  io::ContactEntry entry;
  const auto scope = [&] { return io::scope_text(entry, io::surfaces_of(entry, joint)); };
  expect_begins(scope(), "osseous contact");
  entry.mobile.emplace();
  expect_begins(scope(), "contact of the bones and elastic layers given; ");
  entry.fixed.emplace();
  expect_begins(scope(), "contact of the elastic layers given; ");
  joint.mobile.name = "femoral cartilage";
  expect_begins(scope(), "contact of the cartilages and elastic layers given; ");
}

TEST(RomText, HasALineForEachCaveatWithItsMotions) {
  const Joint joint = arm_and_post();
  std::vector<motion::MotionLimit> limits(3);
  for (std::size_t i = 0; i < 3; ++i)
    limits[i].motion = motion::motion_named(
        motion::hip_motions(), (std::array{"extension", "internal_rotation_at_90_flexion", "fadir"})[i]);
  const std::string text = text_of({.joint = joint, .limits = limits}, io::TextForm::whole);
  expect_says(text,
              "a labrum, which no mesh is called, took 18 deg off them (median) (PMC7754612):\n"
              "      internal_rotation_at_90_flexion, fadir\n");
  // What the lines on living hips say is not said again.
  expect_says(text, "usually ended by soft tissue before bone: extension\n");
  expect_silent(text, "soft tissue usually ends them");
  const Json extension = json_of({.joint = joint, .limits = limits})["motions"][0];
  ASSERT_EQ(extension["caveats"].size(), 1u);
  EXPECT_EQ(extension["caveats"][0]["code"], "soft_tissue_ends");
  EXPECT_EQ(extension["caveats"][0]["source"], "Turley 2013, PMC3589629");
  EXPECT_FALSE(extension["caveats"][0]["text"].get<std::string>().empty());
}

TEST(NormalHipRange, IsGivenWhereTheSourceHasAValue) {
  EXPECT_EQ(normal_hip_range("flexion"), Angle::degrees(120));
  EXPECT_EQ(normal_hip_range("extension"), Angle::degrees(30));
  EXPECT_EQ(normal_hip_range("abduction"), Angle::degrees(45));
  EXPECT_EQ(normal_hip_range("adduction"), Angle::degrees(30));
  EXPECT_EQ(normal_hip_range("internal_rotation"), Angle::degrees(45));
  EXPECT_EQ(normal_hip_range("external_rotation"), Angle::degrees(45));
  for (const char* none : {"fadir", "faber", "internal_rotation_at_90_flexion", "my_motion", ""})
    EXPECT_FALSE(normal_hip_range(none)) << none;
}

/// Internal rotation at 90 degrees of flexion that impingement ends there.
motion::MotionLimit impingement_test_at(Angle turned) {
  motion::MotionLimit limit;
  limit.motion = motion::motion_named(motion::hip_motions(), "internal_rotation_at_90_flexion");
  limit.end.turned = turned;
  limit.end.reason = motion::LimitReason::contact;
  limit.end.contact = motion::ContactWitness{};
  limit.end.contact->kind = motion::ContactKind::impingement;
  return limit;
}

TEST(BoneReference, IsShortFromTheMeanOfHipsWithACamDown) {
  Joint joint = arm_and_post();
  joint.zero_from = ZeroFrom::stated;
  for (const auto& [turned, is_short] :
       {std::pair(21.11, false), {21.1, true}, {10.0, true}, {24.0, false}}) {
    const std::vector limits{impingement_test_at(Angle::degrees(turned))};
    const Json json = json_of({.joint = joint, .limits = limits})["motions"][0];
    EXPECT_EQ(json["bone_reference"], (Json{{"healthy_deg", 27.9},
                                            {"cam_without_complaints_deg", 21.1},
                                            {"patients_deg", 12.3},
                                            {"people_each", 10},
                                            {"is_short", is_short},
                                            {"source", "Audenaert 2012, doi 10.1177/0363546512441328"}}));
    EXPECT_TRUE(json["normal_range_deg"].is_null());
    const std::string text = text_of({.joint = joint, .limits = limits}, io::TextForm::whole);
    expect_says(text, "27.9 deg in 10 simulated healthy hips");
    EXPECT_EQ(text.find("as early as in hips with a cam") != text.npos, is_short) << text;
  }
}

TEST(BoneReference, OfAMotionThatItsOwnRangeEndsIsNotShort) {
  Joint joint = arm_and_post();
  joint.zero_from = ZeroFrom::stated;
  motion::MotionLimit limit = impingement_test_at(Angle::degrees(15));
  ASSERT_TRUE(is_short(*bone_reference(joint, limit), limit));
  limit.end.reason = motion::LimitReason::end_of_range;
  limit.end.contact.reset();
  EXPECT_FALSE(is_short(*bone_reference(joint, limit), limit));
}

TEST(BoneReference, IsOfNativeHipsFromNeutralAndImpingementOnly) {
  Joint joint = arm_and_post();
  joint.zero_from = ZeroFrom::stated;
  const motion::MotionLimit limit = impingement_test_at(Angle::degrees(10));
  ASSERT_TRUE(bone_reference(joint, limit));
  Joint replaced = joint, shoulder = joint, as_scanned = joint;
  replaced.implant = JointImplant{};
  shoulder.anatomy = Anatomy::shoulder;
  as_scanned.zero_from = ZeroFrom::as_given;
  for (const Joint& other : {replaced, shoulder, as_scanned}) EXPECT_FALSE(bone_reference(other, limit));
  std::array others{limit, limit, limit, limit};
  others[0].motion.name = "fadir";
  others[1].motion.start.adduction = Angle::degrees(10);
  others[2].motion.sense = RotationSense::negative;
  others[3].end.contact->kind = motion::ContactKind::bearing;
  for (const motion::MotionLimit& other : others) EXPECT_FALSE(bone_reference(joint, other));
}

TEST(MotionCaveats, HaveNoStudiesOfNativeHipsForAnImplant) {
  Joint joint = arm_and_post();
  joint.implant = JointImplant{};
  for (const motion::Motion& motion : motion::hip_motions()) {
    const std::vector<MotionCaveat> caveats = motion_caveats(joint, motion);
    ASSERT_EQ(caveats.size(), 1u) << motion.name;
    EXPECT_EQ(caveats[0].code, MotionCaveatCode::end_unknown);
  }
}

/// Two limits that turn one angle to either side, and a third that ends nowhere.
std::vector<motion::MotionLimit> opposite_limits() {
  std::vector<motion::MotionLimit> limits;
  for (const auto& [name, sense, turned] :
       {std::tuple("external_rotation", RotationSense::negative, 20.25),
        std::tuple("internal_rotation", RotationSense::positive, 41.5),
        std::tuple("internal_rotation_farther", RotationSense::positive, 120.0)}) {
    motion::MotionLimit limit;
    limit.motion = {name, JointAngle::internal_rotation, sense, {}, Angle::degrees(120)};
    limit.end.turned = Angle::degrees(turned);
    limit.end.reason = turned < 120 ? motion::LimitReason::contact : motion::LimitReason::end_of_range;
    limits.push_back(limit);
  }
  return limits;
}

TEST(RomResult, SaysWhereAnglesCountFrom) {
  Joint joint = arm_and_post();
  const std::vector<motion::MotionLimit> limits = opposite_limits();
  for (const auto& [from, word, is_neutral] : {std::tuple(ZeroFrom::as_given, "as_given", false),
                                               {ZeroFrom::stated, "stated", true},
                                               {ZeroFrom::landmarks, "landmarks", true},
                                               {ZeroFrom::anatomy, "anatomy", true}}) {
    joint.zero_from = from;
    const Json json = json_of({.joint = joint, .limits = limits});
    EXPECT_EQ(json["zero"]["from"], word);
    EXPECT_EQ(json["zero"]["is_neutral"], is_neutral);
    EXPECT_TRUE(json["zero"]["femur_deg"].is_null()) << "an arm has no condyles";
    EXPECT_EQ(json["motions"][0]["zero_from"], word);
    // A range of other people counts from neutral.
    EXPECT_EQ(json["motions"][0]["normal_range_deg"], is_neutral ? Json(45.0) : Json(nullptr)) << word;
    const std::string text = text_of({.joint = joint, .limits = limits});
    expect_says(text, "  zero: ");
    EXPECT_EQ(text.find("not compared with clinical ranges") == text.npos, is_neutral) << text;
  }
}

TEST(RomResult, HasTheTotalArcOfOppositeMotionsThatBothEndInContact) {
  const Joint joint = arm_and_post();
  std::vector<motion::MotionLimit> limits = opposite_limits();
  const Json arcs = json_of({.joint = joint, .limits = limits})["arcs"];
  ASSERT_EQ(arcs.size(), 1u);
  EXPECT_EQ(arcs[0]["motions"], Json({"external_rotation", "internal_rotation"}));
  EXPECT_NEAR(arcs[0]["arc_deg"].get<double>(), 61.75, 1e-12);
  expect_says(text_of({.joint = joint, .limits = limits}),
              "total arcs (deg): external_rotation to internal_rotation 61.75");
  // From another start it is another arc.
  limits[1].motion.start.flexion = Angle::degrees(90);
  EXPECT_TRUE(json_of({.joint = joint, .limits = limits})["arcs"].empty());
}

TEST(ClockHour, IsNamedAsAClockNamesIt) {
  EXPECT_EQ(io::clock_text(0), "12:00");
  EXPECT_EQ(io::clock_text(1.5), "1:30");
  EXPECT_EQ(io::clock_text(11.999), "12:00");
  EXPECT_EQ(io::clock_text(9.1), "9:06");
}

/// A limit with contact in this direction from the joint centre.
motion::MotionLimit contact_towards(const Vec3& p) {
  motion::MotionLimit limit;
  limit.motion.name = "flexion";
  limit.end.reason = motion::LimitReason::contact;
  limit.end.contact = {{}, {}, p, p};
  return limit;
}

TEST(ClockHour, HasTwelveSuperiorAndThreeAnteriorOnEitherSideOfTheBody) {
  // Anterior is +X and superior +Y on both sides; the socket is to the right (+Z) of a right hip's centre.
  for (const Side side : {Side::right, Side::left}) {
    Joint joint = arm_and_post();
    joint.side = side;
    const double lateral = side == Side::right ? 5 : -5;
    const std::vector limits{contact_towards({0, 20, lateral}), contact_towards({20, 0, lateral}),
                             contact_towards({14, 14, lateral}), contact_towards({0, -20, lateral}),
                             contact_towards({-20, 0, lateral})};
    const RangeAnswer answer{.joint = joint, .limits = limits};
    const io::RomResult result{joint, answer};
    const std::array hours{0.0, 3.0, 1.5, 6.0, 9.0};
    // Four roundings of an arctangent, in hours.
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_NEAR(clock_hour(result.answer, limits[i]).value(), hours[i], 1e-14);
    EXPECT_NEAR(Json::parse(io::rom_json(result))["motions"][2]["clock_hour"].get<double>(), 1.5, 1e-14);
    expect_says(io::rom_text(result), "  1:30\n");
    expect_says(io::rom_csv(result), ",1.5,,,,,,,,120,,,,bone_may_end\n");
  }
}

TEST(ClockHour, LeavesOutWhatDidNotTouchAndHinges) {
  Joint joint = arm_and_post();
  const std::vector<motion::MotionLimit> limits = some_limits();
  const auto with_hour = [&] {
    return std::count_if(limits.begin(), limits.end(), [&](const motion::MotionLimit& limit) {
      return clock_hour({.joint = joint, .limits = limits}, limit).has_value();
    });
  };
  EXPECT_EQ(with_hour(), 1);
  joint.kind = JointKind::hinge;
  EXPECT_EQ(with_hour(), 0);
  EXPECT_TRUE(json_of({.joint = joint, .limits = limits})["motions"][0]["clock_hour"].is_null());
}

TEST(ClockHour, EndsWhereNoRimCanBe) {
  const Joint joint = arm_and_post();
  motion::BearingFinding bearing;
  bearing.surface.emplace().head = {Vec3::Zero(), 20};
  const std::vector limits{contact_towards({0, 31.999, 0}), contact_towards({0, 32.001, 0})};
  const RangeAnswer answer{.joint = joint, .limits = limits, .bearing = bearing};
  const io::RomResult result{joint, answer};
  EXPECT_EQ(clock_hour(result.answer, limits[0]), 0.0);
  EXPECT_FALSE(clock_hour(result.answer, limits[1]));
}

TEST(RomJson, SaysThatLimitsWithADepthAllowedAreSearchedFor) {
  const Joint joint = arm_and_post();
  motion::DepthLimit depth;
  depth.limit = contact_towards({1, 2, 3});
  depth.at_limit.depth_mm = 0.4375;
  depth.start_depth_mm = 0.125;
  depth.depth_grows = false;
  const Json motion = json_of({.joint = joint, .limits = {depth.limit}, .depths = {depth}})["motions"][0];
  EXPECT_EQ(motion["depth"]["at_limit_mm"], 0.4375);
  EXPECT_EQ(motion["depth"]["at_start_mm"], 0.125);
  EXPECT_EQ(motion["depth"]["grows"], false);
  expect_begins(motion["guarantee"].get<std::string>(), "searched, not exact");
  EXPECT_FALSE(motion.contains("zone"));
}

TEST(Guarantee, SaysWhatHoldsForEachReason) {
  const auto limits = some_limits();
  EXPECT_EQ(guarantee_text(limits[0]),
            "free before the limit; in contact at it or past it by at most 8.6e-11 deg");
  EXPECT_EQ(guarantee_text(limits[1]), "free over the whole range of 40 deg");
  EXPECT_EQ(guarantee_text(limits[2]), "in contact before any rotation");
}

}  // namespace
}  // namespace condyle::test
