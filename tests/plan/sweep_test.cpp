#include "condyle/sweep.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "condyle/answer.hpp"
#include "condyle/implant.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/sample/hip.hpp"
#include "plan/design_limits.hpp"
#include "plan/joined_body.hpp"
#include "plan/safe_zones.hpp"
#include "support/test.hpp"

/// Sweeps against the closed forms of docs/mathematics/13-implants.md, and against joints made anew for each design.

namespace condyle::test {
namespace {

PartParameter parameter(std::string name, ParameterKind kind, double low, double high, double value = 0,
                        double sigma = 0) {
  PartParameter made{.name = std::move(name), .kind = kind, .low = low, .high = high};
  made.value = made.described = made.as_given = value;
  made.sigma = sigma;
  if (kind == ParameterKind::translation) made.direction = Vec3::UnitY();
  return made;
}

JointDescription described(std::string name, Side side, std::vector<PosedPart> parts) {
  JointDescription description{.name = std::move(name), .side = side};
  description.frame.centre = Vec3(Vec3::Zero());
  for (PosedPart& part : parts) description.parts.push_back({std::move(part)});
  return description;
}

/// A total hip whose cup and stem are parts, with or without bones.
PlacedJoint replaced_hip(const plan::TotalHip& hip, const plan::ImplantMeshes& meshes, double cup_sigma = 0) {
  const bool has_bones = meshes.fixed.size() > 1;
  PosedPart cup{.name = "cup", .body = BodyRole::fixed, .definition = hip.cup.definition};
  PosedPart stem{.name = "stem", .body = BodyRole::mobile};
  if (has_bones) cup.meshes = {"liner"}, stem.meshes = {"head", "neck", "stem"};
  cup.parameters = {parameter("inclination", ParameterKind::cup_inclination, 0, 90,
                              hip.cup.inclination.degrees(), cup_sigma),
                    parameter("anteversion", ParameterKind::cup_anteversion, -60, 75,
                              hip.cup.anteversion.degrees(), cup_sigma)};
  stem.parameters = {parameter("version", ParameterKind::version, -30, 60, hip.stem_version.degrees())};
  PlacedJoint placed =
      make_joint(described("replaced hip", Side::right, {cup, stem}),
                 plan::joined_body("pelvis", meshes.fixed), plan::joined_body("femur", meshes.mobile));
  placed.joint.implant = plan::implant_in_joint(hip, placed.joint);
  return placed;
}

PlacedJoint implant_alone(const plan::TotalHip& hip, double cup_sigma = 0) {
  return replaced_hip(hip, plan::implant_meshes(hip, Side::right), cup_sigma);
}

plan::SweepTarget turn_to(const std::string& motion, double reach_deg) {
  return {motion, motion::motion_named(motion::hip_motions(), motion), Angle::degrees(reach_deg)};
}

/// The targets of the reference zones.
std::vector<plan::SweepTarget> seven_targets() {
  std::vector<plan::SweepTarget> targets;
  for (const auto& [motion, reach] : zone_targets) targets.push_back(turn_to(motion, reach));
  return targets;
}

SweepAnswer swept(const PlacedJoint& placed, const std::string& vary,
                  std::vector<plan::SweepTarget> targets = seven_targets(),
                  std::optional<BandRequest> bands = {}) {
  return answer_sweep(
      {placed.joint, placed.placement},
      {.parameters = plan::parse_sweep(vary), .targets = std::move(targets), .bands = std::move(bands)});
}

Joint with(const Joint& joint, const std::vector<ParameterValue>& values) {
  return with_parameters(joint, values);
}

TEST(SafeZone, HasTheAreaAndTheBorderOfTheClosedForm) {
  for (const Zone& zone : zones) {
    plan::TotalHip hip;
    hip.neck_shaft = Angle::degrees(zone.neck_shaft), hip.stem_version = Angle::degrees(zone.version);
    hip.head_radius_mm = zone.head, hip.neck_radius_mm = zone.neck;
    const PlacedJoint placed = implant_alone(hip);
    const SweepAnswer sweep = swept(placed, "cup.inclination=30:55:1 cup.anteversion=-25:45:1");
    EXPECT_NEAR(sweep.safe_measure, zone.area, 0.01 * zone.area) << zone.neck_shaft << " " << zone.head;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t line = 5 + 5 * i;
      std::vector<plan::SafeInterval> on_line;
      for (const plan::SafeInterval& each : sweep.safe)
        if (each.line == line) on_line.push_back(each);
      ASSERT_EQ(on_line.size(), 1u);
      // Limits in closed form: only the linear end of the search is left, of a hundredth of a step.
      EXPECT_NEAR(on_line[0].low, zone.free[i][0], 2e-3);
      EXPECT_NEAR(on_line[0].high, zone.free[i][1], 2e-3);
    }
    EXPECT_EQ(sweep.window_measure, 25 * 70);
  }
}

TEST(SafeZone, CountsDesignsAsTheGridDoes) {
  const PlacedJoint placed = implant_alone({});
  const SweepAnswer sweep = swept(placed, "cup.inclination=30:55:1 cup.anteversion=-25:45:1");
  std::size_t safe = 0, by_form = 0;
  for (const double margin : sweep.margin_deg) safe += margin >= 0;
  for (const plan::DesignLimit& limit : sweep.limits) by_form += limit.by == plan::LimitKnownBy::closed_form;
  // The area of squares around safe designs differs from the zone's by less than half a square along its border.
  EXPECT_NEAR(static_cast<double>(safe), 658.125 + 0.5 * (27.4 + 21.2), 30);
  EXPECT_GT(by_form, sweep.limits.size() * 9 / 10);
  ASSERT_TRUE(sweep.best);
  for (const double margin : sweep.margin_deg) EXPECT_LE(margin, sweep.margin_deg[*sweep.best]);
}

TEST(Sweep, SearchesMeshesWhereTheClosedFormIsNotUsedAndFindsTheSame) {
  plan::TotalHip hip;
  hip.facets = 120;
  const PlacedJoint placed = implant_alone(hip);
  const std::vector<plan::SweepTarget> targets = seven_targets();
  const std::vector<std::string> swept{"cup.inclination", "cup.anteversion", "stem.version"};
  const plan::DesignLimits fast(placed.joint, {}, targets, swept),
      slow(placed.joint, {}, targets, swept, false);
  std::vector<plan::DesignLimit> a(targets.size()), b(targets.size());
  for (const auto& values : {std::vector<double>{40, 15, 15}, {33, -5, 10}, {50, 25, 0}, {45, 8, 22}}) {
    fast.limits(values, a), slow.limits(values, b);
    const RevolvedPair pair = *plan::closed_form(with(placed.joint, {{"cup.inclination", values[0]},
                                                                     {"cup.anteversion", values[1]},
                                                                     {"stem.version", values[2]}}))
                                   .pair;
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const plan::ClosedLimit closed =
          plan::closed_limit(pair, placed.joint.coordinates(), targets[t].motion);
      EXPECT_EQ(b[t].by, plan::LimitKnownBy::meshes);
      EXPECT_GE(b[t].turned_deg, closed.of_facets_low.degrees() - 1e-4);
      EXPECT_LE(b[t].turned_deg, closed.of_facets_high.degrees() + 1e-4);
      EXPECT_EQ(a[t].turned_deg >= targets[t].reach.degrees(), b[t].turned_deg >= targets[t].reach.degrees());
    }
  }
}

/// A sample hip whose pelvis tilts and turns and whose femur turns and shifts.
PlacedJoint hip_of_parts(Side side = Side::right) {
  const sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::one);
  PosedPart pelvis{.name = "pelvis", .body = BodyRole::fixed};
  pelvis.parameters = {parameter("tilt", ParameterKind::tilt, -30, 30),
                       parameter("frontal", ParameterKind::frontal, -30, 30)};
  PosedPart femur{.name = "femur", .body = BodyRole::mobile};
  femur.parameters = {parameter("version", ParameterKind::version, -30, 30),
                      parameter("height", ParameterKind::translation, -2, 2)};
  const sample::SampleHip used = side == Side::left ? mirrored(hip) : hip;
  return make_joint(described("hip", side, {pelvis, femur}), {"hip bone", used.hip_bone},
                    {"femur", used.femur});
}

class DesignsOfAHip : public testing::TestWithParam<std::string> {};

TEST_P(DesignsOfAHip, HaveTheLimitsOfJointsMadeAnew) {
  const Side side = GetParam().ends_with("left") ? Side::left : Side::right;
  const PlacedJoint placed = hip_of_parts(side);
  std::vector<plan::SweepTarget> targets;
  for (const motion::Motion& motion : motion::hip_motions())
    targets.push_back({motion.name, motion, Angle::degrees(10)});
  // Which one changes fastest decides whose tables are kept.
  const std::vector<std::string> swept =
      GetParam().starts_with("pelvis last")
          ? std::vector<std::string>{"femur.version", "pelvis.tilt", "pelvis.frontal"}
          : std::vector<std::string>{"pelvis.tilt", "femur.height", "femur.version"};
  motion::RangeOptions options;
  options.overlap.reference_contact = motion::ReferenceContact::accept;
  options.bearing.margin_mm = 1;  // as the joint given has it: each joint made anew would find its own
  const plan::DesignLimits limits(placed.joint, options, targets, swept);
  std::mt19937 random(7);
  std::vector<plan::DesignLimit> found(targets.size());
  for (int design = 0; design < 6; ++design) {
    std::vector<double> values;
    std::vector<ParameterValue> named;
    for (const std::string& name : swept) {
      const double reach = name == "femur.height" ? 1 : 15;
      values.push_back(std::uniform_real_distribution<double>(-reach, reach)(random));
      named.push_back({name, values.back()});
    }
    limits.limits(values, found);
    const Joint joint = with_parameters(placed.joint, named);
    motion::RangeOptions anew = options;
    anew.bearing.surface = motion::find_bearing_surface(placed.joint, options.bearing).surface;
    const motion::RangeOfMotion range(joint, anew);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const motion::MotionLimit limit = range.limit(targets[t].motion);
      EXPECT_NEAR(found[t].turned_deg, limit.end.turned.degrees(), 1e-9) << targets[t].name;
      EXPECT_EQ(found[t].reason, limit.end.reason) << targets[t].name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, DesignsOfAHip,
                         testing::Values("pelvis last", "femur last", "pelvis last, left",
                                         "femur last, left"),
                         [](const auto& of) {
                           std::string name;
                           for (const char c : of.param)
                             name += std::isalpha(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

TEST(Sweep, OfBoneAndImplantTogetherEndsAtTheEarlierOfBoth) {
  const plan::TotalHip hip;
  const plan::ImplantMeshes all = *sample::sample_replacement(hip, {}, sample::Scenario::one, Side::right);
  const PlacedJoint both = replaced_hip(hip, all);
  plan::ImplantMeshes bones = all, implant = all;
  for (auto* body : {&bones.fixed, &bones.mobile})
    std::erase_if(
        *body, [](const plan::ImplantMesh& mesh) { return mesh.part != "hip_bone" && mesh.part != "femur"; });
  for (auto* body : {&implant.fixed, &implant.mobile})
    std::erase_if(
        *body, [](const plan::ImplantMesh& mesh) { return mesh.part == "hip_bone" || mesh.part == "femur"; });
  const Joint bone = make_joint(described("bones", Side::right, {}), plan::joined_body("pelvis", bones.fixed),
                                plan::joined_body("femur", bones.mobile))
                         .joint;
  const PlacedJoint alone = implant_alone(hip);
  const std::vector<std::string> swept{"cup.inclination", "cup.anteversion"};
  std::vector<plan::SweepTarget> targets;
  for (const motion::Motion& motion : motion::hip_motions())
    targets.push_back({motion.name, motion, Angle::degrees(10)});
  motion::RangeOptions every_contact;
  every_contact.bearing.rule = motion::BearingRule::count;
  const plan::DesignLimits limits(both.joint, every_contact, targets, swept);
  const motion::RangeOfMotion of_bone(bone, every_contact);
  std::vector<plan::DesignLimit> found(targets.size());
  std::size_t by_bone = 0, by_implant = 0;
  for (const auto& values : {std::vector<double>{40, 15}, {35, 0}, {50, 25}}) {
    limits.limits(values, found);
    const Joint turned = with(alone.joint, {{"cup.inclination", values[0]}, {"cup.anteversion", values[1]}});
    const motion::RangeOfMotion of_implant(turned, every_contact);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const motion::Limit a = of_bone.limit(targets[t].motion).end,
                          b = of_implant.limit(targets[t].motion).end;
      const bool bone_first = a.reason != motion::LimitReason::end_of_range &&
                              (b.reason == motion::LimitReason::end_of_range || a.turned < b.turned);
      const motion::Limit& first = bone_first ? a : b;
      // Meshes of 360 facets lie within 0.0013 degrees of the closed form that stands for them here.
      EXPECT_NEAR(found[t].turned_deg, first.turned.degrees(), bone_first ? 1e-9 : 2e-3) << targets[t].name;
      if (first.reason == motion::LimitReason::end_of_range) continue;
      ASSERT_LT(found[t].pair, limits.pairs().size());
      const plan::EndingPair& pair = limits.pairs()[found[t].pair];
      const bool is_of_bones = pair.fixed == "hip_bone" && pair.mobile == "femur";
      EXPECT_EQ(is_of_bones, bone_first && found[t].by == plan::LimitKnownBy::meshes) << targets[t].name;
      (bone_first ? by_bone : by_implant) += 1;
    }
  }
  EXPECT_GT(by_bone, 3u);
  EXPECT_GT(by_implant, 3u);
}

TEST(Sweep, TiltsThePelvisByTurningItBackInFlexion) {
  const PlacedJoint placed = hip_of_parts();
  plan::SweepTarget standing = turn_to("flexion", 20), at_90 = turn_to("internal_rotation_at_90_flexion", 10);
  standing.pelvic_tilt = at_90.pelvic_tilt = Angle::degrees(7);
  const std::vector<plan::SweepTarget> tilted{standing, at_90};
  motion::RangeOptions options;
  options.overlap.reference_contact = motion::ReferenceContact::accept;
  options.bearing.rule = motion::BearingRule::count;
  const std::vector<std::string> swept{"femur.version"};
  const plan::DesignLimits limits(placed.joint, options, tilted, swept);
  std::vector<plan::DesignLimit> found(2);
  limits.limits(std::vector<double>{0}, found);
  const Joint by_hand = with(placed.joint, {{"pelvis.tilt", 7}});
  const motion::RangeOfMotion range(by_hand, options);
  for (std::size_t t = 0; t < 2; ++t)
    EXPECT_NEAR(found[t].turned_deg, range.limit(tilted[t].motion).end.turned.degrees(), 1e-9);
}

/// Five by five designs whose margin is 1 degree, but for those of the last value of b, which are not safe.
SweepAnswer plateau() {
  SweepAnswer sweep{.parameters = plan::parse_sweep("part.a=0:4:1 part.b=0:4:1"),
                    .targets = {{.name = "sitting", .reach = Angle::degrees(100)}},
                    .pairs = {{"liner", "neck"}},
                    .share = {}};
  for (int design = 0; design < 25; ++design) {
    sweep.margin_deg.push_back(design % 5 < 4 ? 1 : -2);
    sweep.limits.push_back({100 + sweep.margin_deg.back(), motion::LimitReason::contact});
    sweep.limits.back().pair = 0;
  }
  return sweep;
}

TEST(Sweep, OfEqualDesignsTheBestLiesDeepestAmongSafeOnesThenNearestToTheJoint) {
  SweepAnswer sweep = plateau();
  // Two steps to what is not safe or not in the sweep have a = 1 to 3 with b = 1 or 2, and no design has more.
  for (const auto& [here, best] : {std::pair<std::vector<double>, std::vector<double>>{{3.2, 0.6}, {3, 1}},
                                   {{0, 9}, {1, 2}},
                                   {{2, 1.4}, {2, 1}}}) {
    sweep.here = here;
    const SweepAnswer summarised = merged_sweep({&sweep, 1});
    ASSERT_TRUE(summarised.best);
    EXPECT_EQ(summarised.values_of(*summarised.best), best);
    ASSERT_FALSE(summarised.notes.empty());
    EXPECT_EQ(
        summarised.notes.front().text,
        "20 designs share the largest margin, 1.00 degrees: sitting ends with neck on liner in all; the best "
        "lies deepest in the zone");
  }
}

TEST(Sweep, ByLeastChangeTheBestIsTheSafeDesignNearestToTheJoint) {
  SweepAnswer sweep = plateau();
  sweep.best_by = BestDesign::least_change;
  sweep.here = {0.2, 4.4};
  EXPECT_EQ(merged_sweep({&sweep, 1}).best, 3u) << "0, 3: the last safe value of b";
  sweep.here = {2.5, 0};
  const SweepAnswer shared = merged_sweep({&sweep, 1});
  EXPECT_EQ(shared.notes.front().text,
            "2 safe designs change the joint as little; the best lies deepest in the zone");
  for (double& margin : sweep.margin_deg) margin = -1;
  sweep.margin_deg[7] = -0.5;
  EXPECT_EQ(merged_sweep({&sweep, 1}).best, 7u) << "without a safe design by the margin";
}

TEST(Sweep, DividesMarginsByTheWeightsOfTheirTargetsToFindTheBest) {
  SweepAnswer sweep{.parameters = plan::parse_sweep("part.a=0:2:1"),
                    .targets = {{.name = "sitting", .reach = Angle::degrees(100)},
                                {.name = "pivoting", .reach = Angle::degrees(40)}},
                    .pairs = {{"liner", "neck"}},
                    .share = {}};
  sweep.here = {0};
  for (const double over : {2.0, 5.0, 8.0}) {
    sweep.limits.push_back({100 + over, motion::LimitReason::contact});
    sweep.limits.push_back({40 + 10 - over, motion::LimitReason::contact});
    sweep.margin_deg.push_back(std::min(over, 10 - over));
  }
  EXPECT_EQ(merged_sweep({&sweep, 1}).best, 1u);
  sweep.targets[0].weight = 5;  // 8 / 5 and 2 are more than 5 / 5 and 5
  const SweepAnswer weighted = merged_sweep({&sweep, 1});
  EXPECT_EQ(weighted.best, 2u);
  EXPECT_EQ(weighted.margin_deg[2], 2) << "margins are as they were";

  // The target of the least margin by weight ends the best designs, and not that of the least margin.
  sweep.limits[4] = sweep.limits[2], sweep.limits[5] = sweep.limits[3],
  sweep.margin_deg[2] = sweep.margin_deg[1];
  for (plan::DesignLimit& limit : sweep.limits) limit.pair = 0;
  EXPECT_EQ(merged_sweep({&sweep, 1}).notes.front().text,
            "2 designs share the largest weighted margin, 1.00 degrees: sitting ends with neck on liner in "
            "all; the "
            "best lies deepest in the zone");

  // A miss of a heavier target counts more: 4 degrees of it against 10 of the other.
  for (std::size_t i = 0; i < 3; ++i) {
    sweep.limits[2 * i].turned_deg = i == 1 ? 100 : 96;
    sweep.limits[2 * i + 1].turned_deg = i == 1 ? 30 : 40;
    sweep.margin_deg[i] = i == 1 ? -10 : -4;
  }
  EXPECT_EQ(merged_sweep({&sweep, 1}).best, 1u);
}

TEST(Sweep, OneBestDesignIsNotSaidToShareItsMargin) {
  SweepAnswer sweep = plateau();
  sweep.here = {2, 2};
  sweep.margin_deg[0] = 3;
  const SweepAnswer summarised = merged_sweep({&sweep, 1});
  EXPECT_EQ(summarised.best, 0u);
  for (const SweepNote& note : summarised.notes) EXPECT_NE(note.code, SweepNoteCode::best_is_shared);
}

TEST(Sweep, OfSharesIsThatOfTheWhole) {
  const PlacedJoint placed = implant_alone({}, 4);
  SweepRequest request{.parameters = plan::parse_sweep("cup.inclination=30:50:4 cup.anteversion=-20:40:5"),
                       .targets = seven_targets(),
                       .bands = BandRequest{.samples = 40}};
  const SweepAnswer whole = answer_sweep({placed.joint, placed.placement}, request);
  std::vector<SweepAnswer> shares;
  for (std::size_t number = 1; number <= 4; ++number) {
    request.share = {number, 4};
    shares.push_back(answer_sweep({placed.joint, placed.placement}, request));
  }
  const SweepAnswer merged = merged_sweep(shares);
  EXPECT_EQ(merged.margin_deg, whole.margin_deg);
  EXPECT_EQ(merged.probability, whole.probability);
  EXPECT_EQ(merged.safe_measure, whole.safe_measure);
  EXPECT_EQ(merged.window_measure, whole.window_measure);
  EXPECT_EQ(merged.best, whole.best);
  ASSERT_EQ(merged.safe.size(), whole.safe.size());
  for (std::size_t i = 0; i < whole.safe.size(); ++i) {
    EXPECT_EQ(merged.safe[i].line, whole.safe[i].line);
    EXPECT_EQ(merged.safe[i].low, whole.safe[i].low);
    EXPECT_EQ(merged.safe[i].high_target, whole.safe[i].high_target);
  }
  ASSERT_EQ(merged.notes.size(), whole.notes.size());
  std::swap(shares[1], shares[2]);
  EXPECT_THROW(merged_sweep(shares), UsageError);
}

#ifdef __GLIBC__
/// What the limits of one design take beside what is there, bytes, without a closed form.
std::size_t taken_by_limits(const std::vector<plan::SweepTarget>& targets) {
  const plan::TotalHip hip;
  const PlacedJoint placed = implant_alone(hip);
  const std::vector<std::string> swept{"cup.inclination", "cup.anteversion"};
  const auto in_use = [] {
    const auto use = mallinfo2();
    return use.uordblks + use.hblkhd;
  };
  const std::size_t before = in_use();
  const plan::DesignLimits limits(placed.joint, {}, targets, swept, false);
  std::vector<plan::DesignLimit> found(targets.size());
  limits.limits(std::vector<double>{40, 15}, found);
  return in_use() - before;
}

TEST(Sweep, TakesTheMemoryOfOneMotionForAllTargetsOfIt) {
  const std::vector<plan::SweepTarget> one{turn_to("flexion", 100)};
  std::vector<plan::SweepTarget> many;
  for (int i = 0; i < 300; ++i) {
    many.push_back(turn_to("flexion", 60 + 0.05 * i));
    many.back().name += std::to_string(i);
  }
  // A name, a motion and a limit each.
  EXPECT_LE(taken_by_limits(many), taken_by_limits(one) + many.size() * 2048);
}

TEST(Sweep, TakesNoMoreMemoryThanSomeMotionsForAnyNumberOfThem) {
  std::vector<plan::SweepTarget> many;
  for (int i = 0; i < 1000; ++i) {
    many.push_back(turn_to("flexion", 60));
    many.back().name += std::to_string(i);
    many.back().motion.start.internal_rotation = Angle::degrees(0.01 * i);
  }
  EXPECT_LE(taken_by_limits(many), std::size_t{400} << 20);
}
#endif

TEST(Sweep, GivesTheProbabilityOfANormalDistributionOverTheSafeInterval) {
  // Only the anteversion matters if the inclination has no deviation.
  PlacedJoint placed = implant_alone({}, 4);
  placed.joint.posed->parts[0].parameters[0].sigma = 0;
  constexpr std::size_t samples = 400;
  const SweepAnswer sweep = swept(placed, "cup.inclination=40:40:1 cup.anteversion=-10:45:5", seven_targets(),
                                  BandRequest{.samples = samples});
  ASSERT_EQ(sweep.safe.size(), 1u);
  const auto below = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2)); };
  for (std::size_t i = 0; i < sweep.designs(); ++i) {
    const double at = sweep.values_of(i)[1];
    const double expected = below((sweep.safe[0].high - at) / 4) - below((sweep.safe[0].low - at) / 4);
    // One draw in each stratum: either end of the interval lies in one of them.
    EXPECT_NEAR(sweep.probability[i], expected, 2.0 / samples) << at;
  }
}

TEST(Sweep, SaysWhichDesignsAreInContactInTheReferencePose) {
  const PlacedJoint placed = implant_alone({});
  // At an inclination of 0 the opening points down and the neck, 45 degrees up from it and more, is inside the liner's angle no longer.
  const SweepAnswer sweep =
      swept(placed, "cup.inclination=40:40:1 cup.anteversion=-60:75:5", {turn_to("flexion", 20)});
  for (std::size_t i = 0; i < sweep.designs(); ++i) {
    const Joint turned = with(placed.joint, {{"cup.anteversion", sweep.values_of(i)[1]}});
    const RevolvedPair pair = *plan::closed_form(turned).pair;
    const bool apart = pair.fixed_axis.dot(pair.mobile_axis) < std::cos(pair.half_angle.radians());
    EXPECT_EQ(std::isnan(sweep.margin_deg[i]), apart) << sweep.values_of(i)[1];
  }
}

TEST(Sweep, NotesAnImplantWhoseMeshesAreNotThoseOfItsSizes) {
  const plan::TotalHip made;
  PlacedJoint placed = implant_alone(made);
  plan::TotalHip said = made;
  said.neck_radius_mm = 7;
  placed.joint.implant = plan::implant_in_joint(said, placed.joint);
  const SweepRequest request{.parameters = plan::parse_sweep("cup.anteversion=10:20:10"),
                             .targets = {turn_to("flexion", 110)}};
  const SweepAnswer sweep = answer_sweep({placed.joint, placed.placement}, request);
  ASSERT_FALSE(sweep.notes.empty());
  EXPECT_EQ(sweep.notes[0].code, SweepNoteCode::differs_from_closed_form);
  for (const plan::DesignLimit& limit : sweep.limits) EXPECT_EQ(limit.by, plan::LimitKnownBy::meshes);
  const RangeAnswer range =
      answer_range({placed.joint, placed.placement}, {.motions = motion::hip_motions()});
  EXPECT_TRUE(std::any_of(range.notes.begin(), range.notes.end(), [](const RangeNote& note) {
    return note.code == RangeNoteCode::differs_from_closed_form;
  }));
}

TEST(Sweep, NotesThatAlsoWhereBoneEndsTheMotionsBefore) {
  const plan::TotalHip made;
  PlacedJoint placed =
      replaced_hip(made, *sample::sample_replacement(made, {}, sample::Scenario::one, Side::right));
  plan::TotalHip said = made;
  said.neck_radius_mm = 7;
  placed.joint.implant = plan::implant_in_joint(said, placed.joint);
  const SweepAnswer sweep = swept(placed, "cup.anteversion=10:20:10", {turn_to("adduction", 20)});
  ASSERT_LT(sweep.limits_here[0].turned_deg, 40);  // femur on hip bone; the neck would meet the liner at 67.6
  ASSERT_FALSE(sweep.notes.empty());
  EXPECT_EQ(sweep.notes[0].code, SweepNoteCode::differs_from_closed_form);
}

TEST(ClosedForm, StandsBesideTheLimitsOfMeshesAndAgrees) {
  for (const double stem : {5.0, 15.0, 30.0}) {
    const PlacedJoint placed = implant_alone({});
    const Joint joint =
        with(placed.joint, {{"cup.inclination", 47}, {"cup.anteversion", 8}, {"stem.version", stem}});
    // The same implant made of its sizes: its cup and neck are where the parts have turned them.
    plan::TotalHip made;
    made.cup = {Angle::degrees(47), Angle::degrees(8)};
    made.stem_version = Angle::degrees(stem);
    const RevolvedPair turned = *plan::closed_form(joint).pair,
                       pair = *plan::revolved_pair(made, Side::right);
    EXPECT_LT((turned.fixed_axis - pair.fixed_axis).norm(), 1e-14);
    EXPECT_LT((turned.mobile_axis - pair.mobile_axis).norm(), 1e-14);
    const RangeAnswer range = answer_range({joint, placed.placement}, {.motions = motion::hip_motions()});
    ASSERT_EQ(range.closed.size(), range.limits.size());
    EXPECT_TRUE(std::none_of(range.notes.begin(), range.notes.end(), [](const RangeNote& note) {
      return note.code == RangeNoteCode::differs_from_closed_form;
    }));
    for (std::size_t i = 0; i < range.limits.size(); ++i) {
      EXPECT_EQ(range.closed[i].reason, range.limits[i].end.reason);
      EXPECT_NEAR(range.closed[i].turned.degrees(), range.limits[i].end.turned.degrees(), 0.01);
    }
  }
}

TEST(ClosedForm, IsNoneOfAnImplantThatIsShifted) {
  PlacedJoint placed = implant_alone({});
  PosedPart& cup = placed.joint.posed->parts[0];
  cup.parameters.push_back(parameter("height", ParameterKind::translation, -5, 5));
  EXPECT_TRUE(plan::closed_form(placed.joint).pair);
  const Joint shifted = with(placed.joint, {{"cup.height", 2}});
  EXPECT_FALSE(plan::closed_form(shifted).pair);
  EXPECT_NE(plan::closed_form(shifted).why_none.find("shifts"), std::string::npos);
}

TEST(CupAngles, OfAPartAreThoseOfTheCupThatIsMadeWithThem) {
  for (const CupDefinition definition : all_cup_definitions)
    for (const Side side : {Side::right, Side::left}) {
      plan::TotalHip given, wanted;
      given.cup = {Angle::degrees(41), Angle::degrees(12), definition};
      wanted.cup = {Angle::degrees(33), Angle::degrees(-7), definition};
      const plan::ImplantMeshes meshes = plan::implant_meshes(given, side);
      PosedPart cup{.name = "cup", .body = BodyRole::fixed, .definition = definition};
      cup.parameters = {parameter("inclination", ParameterKind::cup_inclination, 0, 90, 41),
                        parameter("anteversion", ParameterKind::cup_anteversion, -60, 75, 12)};
      PlacedJoint placed =
          make_joint(described("hip", side, {cup}), plan::joined_body("pelvis", meshes.fixed),
                     plan::joined_body("femur", meshes.mobile));
      placed.joint.implant = plan::implant_in_joint(given, placed.joint);
      const Joint turned = with(placed.joint, {{"cup.inclination", 33}, {"cup.anteversion", -7}});
      const plan::CupAngles angles = *plan::cup_angles(turned, definition);
      EXPECT_NEAR(angles.inclination.degrees(), 33, 1e-12);
      EXPECT_NEAR(angles.anteversion.degrees(), -7, 1e-12);
      // The axis of the turned mesh itself: the mean of its vertices lies on it.
      Vec3 mean = Vec3::Zero();
      const PointsView vertices = turned.fixed.mesh.vertices().view();
      for (std::size_t v = 0; v < vertices.size(); ++v) mean += vertices[v];
      EXPECT_GT(-mean.normalized().dot(plan::cup_axis(wanted.cup, side)), 1 - 1e-9);
    }
}

TEST(Sweep, RefusesWhatItCannotAnswerInOneLine) {
  const PlacedJoint placed = implant_alone({});
  const auto line = [&](const std::string& vary, std::vector<plan::SweepTarget> targets) {
    try {
      check_sweep({placed.joint, placed.placement},
                  {.parameters = plan::parse_sweep(vary), .targets = std::move(targets)});
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto tilted = [](double deg) {
    plan::SweepTarget target = turn_to("flexion", 20);
    target.pelvic_tilt = Angle::degrees(deg);
    return target;
  };
  using Targets = std::vector<plan::SweepTarget>;
  const Targets one{turn_to("flexion", 90)};
  const std::string vary = "cup.inclination=30:50:1";
  for (const auto& [varied, targets, said] : std::vector<std::tuple<std::string, Targets, std::string>>{
           {vary, one, "accepted"},
           {"cup.inclinaton=30:50:1", one,
            "there is no parameter \"cup.inclinaton\" (did you mean \"cup.inclination\"?); there are "
            "cup.inclination, cup.anteversion, stem.version"},
           {"cup.inclination=30:95:1", one, "cup.inclination: 95 deg is outside of its range, 0 to 90"},
           {"cup.inclination=50:30:1", one, "cup.inclination: the last value, 30, lies below the first, 50"},
           {"cup.inclination=30:50:0", one, "cup.inclination: the step must be above 0"},
           {"cup.inclination=30:50", one,
            "\"cup.inclination=30:50\" is not a parameter with its first and last value and a step, as in "
            "cup.inclination=30:50:1"},
           {vary + " " + vary, one, "cup.inclination is given twice"},
           {vary, {}, "a sweep needs one target or more"},
           {vary,
            {turn_to("flexion", 200)},
            "target flexion: 200 degrees, must be above 0 and up to the motion's range, 180"},
           {vary, {turn_to("flexion", 20), turn_to("flexion", 30)}, "target flexion is given twice"},
           {vary, {tilted(-60)}, "accepted"},
           {vary, {tilted(-100)}, "target flexion: the tilt must be between -60 and 60 degrees"},
           {"cup.inclination=0:90:0.001 cup.anteversion=0:60:0.01", one,
            "540096001 designs are too many: up to 10000000"}})
    EXPECT_EQ(line(varied, targets), said);
}

TEST(Sweep, SaysWhereItsZoneEnds) {
  const PlacedJoint placed = implant_alone({});
  const auto codes = [&](const std::string& vary, std::vector<plan::SweepTarget> targets) {
    std::string text;
    for (const SweepNote& note : swept(placed, vary, std::move(targets)).notes)
      text += std::string(name_of(note.code)) + " ";
    return text;
  };
  EXPECT_EQ(codes("cup.anteversion=-20:45:5", seven_targets()), "");
  EXPECT_EQ(codes("cup.anteversion=10:45:5", seven_targets()), "zone_leaves_window ");
  EXPECT_EQ(codes("cup.anteversion=10:20:5", seven_targets()), "everything_is_safe ");
  EXPECT_EQ(codes("cup.anteversion=-20:0:5", seven_targets()), "nothing_is_safe ");
  EXPECT_EQ(codes("cup.anteversion=-20:44.9:5", seven_targets()), "last_value_left_out ") << "it ends at 40";
  EXPECT_EQ(codes("cup.anteversion=-20:45.1:5", seven_targets()), "last_value_left_out ") << "it ends at 45";
}

TEST(Sweep, SaysThatAParameterThatItVariesWasSet) {
  const PlacedJoint placed = implant_alone({});
  const Joint set = with(placed.joint, {{"cup.anteversion", 20}});
  const auto codes = [&](const std::string& vary) {
    std::vector<SweepNoteCode> found;
    for (const SweepNote& note : swept({set, placed.placement}, vary).notes) found.push_back(note.code);
    return found;
  };
  EXPECT_EQ(codes("cup.anteversion=-20:45:5"), std::vector{SweepNoteCode::value_is_swept});
  const std::vector<SweepNoteCode> of_other = codes("cup.inclination=30:50:5");
  EXPECT_EQ(std::count(of_other.begin(), of_other.end(), SweepNoteCode::value_is_swept), 0);
}

}  // namespace
}  // namespace condyle::test
