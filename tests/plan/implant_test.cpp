#include "condyle/implant.hpp"

#include "condyle/range_of_motion.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/self_crossings.hpp"
#include "plan/safe_zones.hpp"
#include "support/test.hpp"

/// Implants against the closed forms of docs/mathematics/13-implants.md, and meshes against both.

namespace condyle::test {
namespace {

constexpr double in_degrees = 180 / std::numbers::pi;
constexpr CoordinateSystem right_hip{Anatomy::hip, Side::right};

plan::CupAngles cup(double inclination, double anteversion,
                    CupDefinition definition = CupDefinition::radiographic) {
  return {Angle::degrees(inclination), Angle::degrees(anteversion), definition};
}

struct Design {
  const char* name;
  double inclination, anteversion, neck_shaft, version, head, neck, reach, half_angle;
};

/// Designs and their limits to 1e-4 degrees, computed independently of this code: by the closed form, A, B and E by meshes too.
const Design designs[] = {
    {"A", 40, 15, 135, 15, 16, 6, 90, 67.9757},    {"B", 45, 20, 135, 15, 18, 6, 90, 70.5288},
    {"C", 40, 15, 125, 10, 14, 6, 90, 64.6231},    {"D", 50, 5, 130, 5, 18, 6.5, 90, 68.8316},
    {"E", 35, 25, 127, 20, 16, 5, 85, 76.7900},    {"F", 45, 15, 135, 0, 20, 6, 95, 67.5424},
    {"G", 30, 10, 132, 15, 16, 6.75, 90, 65.0470},
};

/// Their limits in the order of hip_motions(); -1 for the end of the range.
constexpr std::array<double, 12> limits_of_designs[] = {
    {128.7064, 61.1268, 59.5838, 67.5978, -1, 70.5273, -1, 45.3956, 38.6748, 108.6748, 30.7376, -1},
    {144.5010, 61.0067, 65.6158, 63.6298, -1, 62.7349, -1, 54.4941, 52.0859, 112.0859, 44.2217, -1},
    {132.1862, 65.7721, 46.2858, 75.4594, -1, 56.9386, 73.7332, 48.1649, 29.2663, 109.2663, 24.4711, -1},
    {135.6716, -1, 68.4441, 68.2289, 106.4383, 83.4074, -1, 31.8628, 31.4352, 101.4352, 20.1107, -1},
    {160.6957, 52.5694, 50.4907, 83.0374, -1, 54.9653, 87.3278, 88.0955, 57.0441, -1, 54.7120, -1},
    {122.0266, 80.5195, 66.7044, 66.7044, -1, 80.5195, 82.7130, 34.2201, 28.0620, 118.0620, 18.8545, -1},
    {111.0629, 55.9717, 44.8840, 78.9053, -1, 78.1255, 83.3512, 36.2233, 20.3117, 110.3117, 14.2686, -1},
};

plan::TotalHip total_hip_of(const Design& d, int facets = plan::default_facets) {
  plan::TotalHip hip;
  hip.cup = cup(d.inclination, d.anteversion);
  hip.neck_shaft = Angle::degrees(d.neck_shaft);
  hip.stem_version = Angle::degrees(d.version);
  hip.head_radius_mm = d.head, hip.neck_radius_mm = d.neck;
  hip.liner_half_angle = Angle::degrees(d.reach);
  hip.facets = facets;
  return hip;
}

/// All meshes of a body as one.
Body body_of(const char* name, const std::vector<plan::ImplantMesh>& meshes) {
  TriMesh all;
  std::vector<BodyPart> parts;
  for (const auto& [part, mesh] : meshes) {
    parts.push_back(
        {part, all.vertices.size(), mesh.vertices.size(), all.triangles.size(), mesh.triangles.size()});
    append(all, mesh);
  }
  return {name, Mesh(std::move(all)), std::move(parts)};
}

Joint joint_of(const plan::Implant& implant, Side side = Side::right) {
  const plan::ImplantMeshes meshes = plan::implant_meshes(implant, side);
  const bool is_hip = std::holds_alternative<plan::TotalHip>(implant);
  return {.name = "replacement",
          .kind = JointKind::ball,
          .side = side,
          .fixed = body_of("fixed", meshes.fixed),
          .mobile = body_of("mobile", meshes.mobile),
          .anatomy = is_hip ? Anatomy::hip : Anatomy::shoulder};
}

std::vector<motion::MotionLimit> mesh_limits(const plan::Implant& implant, Side side = Side::right) {
  const Joint joint = joint_of(implant, side);
  const std::vector<motion::Motion> motions = motion::built_in_motions(JointKind::ball, joint.anatomy);
  return motion::RangeOfMotion(joint).limits(motions);
}

double largest_difference(const plan::Implant& implant, Side side = Side::right) {
  const auto pair = *plan::revolved_pair(implant, side);
  double most = 0;
  for (const motion::MotionLimit& limit : mesh_limits(implant, side)) {
    const CoordinateSystem system{
        std::holds_alternative<plan::TotalHip>(implant) ? Anatomy::hip : Anatomy::shoulder, side};
    const plan::ClosedLimit closed = plan::closed_limit(pair, system, limit.motion);
    EXPECT_EQ(limit.end.reason, closed.reason) << limit.motion.name;
    most = std::max(most, std::abs(limit.end.turned.degrees() - closed.turned.degrees()));
    EXPECT_GE(limit.end.turned.radians(), closed.of_facets_low.radians() - 1e-9) << limit.motion.name;
    EXPECT_LE(limit.end.turned.radians(), closed.of_facets_high.radians() + 1e-9) << limit.motion.name;
  }
  return most;
}

TEST(CupAngles, ConvertBetweenMurraysDefinitions) {
  struct Row {
    plan::CupAngles radiographic, anatomic, operative;
  };
  const auto row = [](double ri, double ra, double ai, double aa, double oi, double oa) {
    return Row{cup(ri, ra), cup(ai, aa, CupDefinition::anatomic), cup(oi, oa, CupDefinition::operative)};
  };
  for (const Row& each : {row(40, 15, 42.273515, 22.629056, 38.380802, 19.278960),
                          row(45, 20, 48.358857, 27.236313, 41.641143, 27.236313),
                          row(30, 10, 31.474949, 19.425400, 29.498704, 11.508393)}) {
    for (const plan::CupAngles& from : {each.radiographic, each.anatomic, each.operative})
      for (const plan::CupAngles& to : {each.radiographic, each.anatomic, each.operative}) {
        const plan::CupAngles found = plan::by_definition(from, to.definition);
        EXPECT_NEAR(found.inclination.degrees(), to.inclination.degrees(), 2e-6);
        EXPECT_NEAR(found.anteversion.degrees(), to.anteversion.degrees(), 2e-6);
      }
  }
}

TEST(CupAngles, GoToAnAxisAndBackOnBothSides) {
  for (const Side side : {Side::right, Side::left})
    for (const auto definition :
         {CupDefinition::radiographic, CupDefinition::anatomic, CupDefinition::operative})
      for (double inclination = 1; inclination < 90; inclination += 7.5)
        for (double anteversion = -40; anteversion <= 60; anteversion += 12.5) {
          const plan::CupAngles given = cup(inclination, anteversion, definition);
          const Vec3 axis = plan::cup_axis(given, side);
          EXPECT_NEAR(axis.norm(), 1, 1e-15);
          EXPECT_GT(side == Side::right ? axis.z() : -axis.z(), 0);
          const plan::CupAngles back = plan::cup_angles(3 * axis, definition, side);
          EXPECT_NEAR(back.inclination.degrees(), inclination, 1e-12);
          EXPECT_NEAR(back.anteversion.degrees(), anteversion, 1e-12);
        }
}

TEST(CupAngles, AreNamed) {
  for (const auto definition :
       {CupDefinition::radiographic, CupDefinition::anatomic, CupDefinition::operative})
    EXPECT_EQ(cup_definition_named(name_of(definition)), definition);
  EXPECT_THROW(cup_definition_named("surgical"), UsageError);
}

double half_angle(plan::LinerShape liner, plan::NeckShape neck) {
  return plan::contact_half_angle(liner, neck).degrees();
}

TEST(ContactHalfAngle, OfASharpRimAndACylinderIsClosed) {
  for (const Design& d : designs)
    EXPECT_NEAR(half_angle({d.head, d.head + 5, Angle::degrees(d.reach)}, {d.neck}), d.half_angle, 5e-5)
        << d.name;
  EXPECT_NEAR(half_angle({16, 20}, {6}), 90 - std::asin(6.0 / 16) * in_degrees, 1e-11);
}

TEST(ContactHalfAngle, OfConesAndChamfers) {
  const auto degrees = [](double value) { return Angle::degrees(value); };
  EXPECT_NEAR(half_angle({16, 19}, {6, degrees(3)}), 65.007447, 1e-6);
  EXPECT_NEAR(half_angle({16, 22}, {5, degrees(5)}), 66.861754, 1e-6);
  EXPECT_NEAR(half_angle({18, 21}, {7, degrees(-2)}), 69.129352, 1e-6);
  // The outer edge 10 degrees before the inner one, and 10 behind it.
  EXPECT_NEAR(half_angle({16, 20, degrees(90), degrees(-10)}, {6}), 62.542397, 1e-6);
  EXPECT_NEAR(half_angle({16, 20, degrees(90), degrees(10)}, {6}), 67.975687, 1e-6);
}

TEST(ClosedLimit, IsThatOfTheTables) {
  const std::vector<motion::Motion> motions = motion::hip_motions();
  for (std::size_t i = 0; i < std::size(designs); ++i) {
    const Design& d = designs[i];
    const auto pair = *plan::revolved_pair(total_hip_of(d), Side::right);
    for (std::size_t m = 0; m < motions.size(); ++m) {
      const plan::ClosedLimit limit = plan::closed_limit(pair, right_hip, motions[m]);
      const bool ends = limits_of_designs[i][m] < 0;
      EXPECT_EQ(limit.reason, ends ? motion::LimitReason::end_of_range : motion::LimitReason::contact)
          << d.name << motions[m].name;
      EXPECT_NEAR(limit.turned.degrees(), ends ? motions[m].range.degrees() : limits_of_designs[i][m], 6e-5)
          << d.name << " " << motions[m].name;
    }
  }
}

TEST(ClosedLimit, IsTheSameOnTheLeft) {
  for (const Design& d : designs)
    for (const motion::Motion& motion : motion::hip_motions()) {
      const plan::ClosedLimit right =
          plan::closed_limit(*plan::revolved_pair(total_hip_of(d), Side::right), right_hip, motion);
      const plan::ClosedLimit left = plan::closed_limit(*plan::revolved_pair(total_hip_of(d), Side::left),
                                                        {Anatomy::hip, Side::left}, motion);
      EXPECT_NEAR(right.turned.radians(), left.turned.radians(), 1e-14) << d.name << motion.name;
    }
}

double limit_of(const plan::TotalHip& hip, const char* motion, double more_flexion = 0) {
  motion::Motion asked = motion::motion_named(motion::hip_motions(), motion);
  asked.start.flexion = asked.start.flexion + Angle::degrees(more_flexion);
  return plan::closed_limit(*plan::revolved_pair(hip, Side::right), right_hip, asked).turned.degrees();
}

TEST(ClosedLimit, ShiftsWithTiltAndVersionOfTheStem) {
  const plan::TotalHip a = total_hip_of(designs[0]);
  // Every pose of flexion f under a pelvis tilted forwards by 10 is that of f + 10.
  EXPECT_NEAR(limit_of(a, "flexion", 10), 118.7064, 6e-5);
  EXPECT_NEAR(limit_of(a, "flexion", -10), 138.7064, 6e-5);
  EXPECT_NEAR(limit_of(a, "internal_rotation_at_90_flexion", 10), 29.7197, 6e-5);
  EXPECT_NEAR(limit_of(a, "internal_rotation_at_90_flexion", -10), 48.0857, 6e-5);
  EXPECT_NEAR(limit_of(a, "fadir", 10), 19.5598, 6e-5);
  EXPECT_NEAR(limit_of(a, "fadir", -10), 41.4822, 6e-5);
  for (const double more : {10.0, -10.0}) {
    plan::TotalHip turned = a;
    turned.stem_version = a.stem_version + Angle::degrees(more);
    EXPECT_NEAR(limit_of(turned, "internal_rotation_at_90_flexion"), 38.6748 + more, 6e-5);
    EXPECT_NEAR(limit_of(turned, "flexion"), more > 0 ? 134.3695 : 120.6952, 6e-5);
  }
}

TEST(ClosedLimit, SaysContactAtTheStartAndThatNothingMeets) {
  const motion::Motion turn{"turn", JointAngle::flexion, RotationSense::positive, {}, Angle::degrees(180)};
  RevolvedPair pair{Vec3::UnitY(), Vec3::UnitY(), Angle::degrees(30), Angle::degrees(30), Angle::degrees(30)};
  EXPECT_NEAR(plan::closed_limit(pair, right_hip, turn).turned.degrees(), 30, 1e-12);
  pair.mobile_axis = Vec3(0.6, 0.8, 0);
  EXPECT_EQ(plan::closed_limit(pair, right_hip, turn).reason, motion::LimitReason::contact_at_start);
  EXPECT_EQ(plan::closed_limit(pair, right_hip, turn).turned, Angle());
  pair.fixed_axis = Vec3::UnitZ(), pair.mobile_axis = Vec3::UnitZ();
  EXPECT_EQ(plan::closed_limit(pair, right_hip, turn).reason, motion::LimitReason::end_of_range);
  EXPECT_EQ(plan::closed_limit(pair, right_hip, turn).turned, turn.range);
}

/// {(RI, RA): every target is free}: the intervals of RA that are free at an RI, by halving.
bool is_safe(const Vec3& neck, Angle half_angle, double ri, double ra) {
  static const std::vector<motion::Motion> motions = [] {
    std::vector<motion::Motion> all;
    for (const auto& [name, reach] : zone_targets) {
      all.push_back(motion::motion_named(motion::hip_motions(), name));
      all.back().range = Angle::degrees(reach);
    }
    return all;
  }();
  const RevolvedPair pair{plan::cup_axis(cup(ri, ra), Side::right), neck, half_angle, half_angle, half_angle};
  for (const motion::Motion& motion : motions)
    if (plan::closed_limit(pair, right_hip, motion).reason != motion::LimitReason::end_of_range) return false;
  return true;
}

/// Where a cup between a safe and an unsafe anteversion becomes unsafe.
double border(const auto& safe, double inside, double outside) {
  for (int i = 0; i < 40; ++i) (safe((inside + outside) / 2) ? inside : outside) = (inside + outside) / 2;
  return (inside + outside) / 2;
}

/// The one interval that is free, empty if none is; others fail.
std::array<double, 2> free_anteversion(const Vec3& neck, Angle half_angle, double ri, double step) {
  const auto safe = [&](double ra) { return is_safe(neck, half_angle, ri, ra); };
  std::vector<double> ends;
  for (double ra = -60; ra < 80; ra += step)
    if (safe(ra) != safe(ra + step))
      ends.push_back(safe(ra) ? border(safe, ra, ra + step) : border(safe, ra + step, ra));
  if (ends.empty()) return {0, 0};
  EXPECT_EQ(ends.size(), 2) << "at an inclination of " << ri;
  return {ends.front(), ends.back()};
}

TEST(SafeZone, HasTheAreasAndBordersOfTheTables) {
  for (const Zone& zone : zones) {
    const Vec3 neck =
        plan::neck_axis(Angle::degrees(zone.neck_shaft), Angle::degrees(zone.version), Side::right);
    const Angle half = plan::contact_half_angle({zone.head, zone.head + 5}, {zone.neck});
    for (int i = 0; i < 4; ++i) {
      const auto [low, high] = free_anteversion(neck, half, 35 + 5 * i, 2);
      EXPECT_NEAR(low, zone.free[i][0], 6e-5);
      EXPECT_NEAR(high, zone.free[i][1], 6e-5);
    }
    constexpr int strips = 100;
    double area = 0;
    for (int i = 0; i < strips; ++i) {
      const auto [low, high] = free_anteversion(neck, half, 30 + 25 * (i + 0.5) / strips, 1);
      area += (high - low) * 25 / strips;
    }
    EXPECT_NEAR(area, zone.area, 1e-3 * zone.area);
  }
}

TEST(ImplantMeshes, AreClosedWoundOutwardsAndApart) {
  plan::TotalHip lipped;
  lipped.lip = Angle::degrees(15), lipped.chamfer = Angle::degrees(10);
  plan::TotalHip trapezoid;
  trapezoid.neck_upper_width_mm = 8, trapezoid.neck_lower_width_mm = 12,
  trapezoid.neck_taper = Angle::degrees(2);
  plan::TotalHip bent;
  bent.neck_shaft = Angle::degrees(110), bent.stem_radius_mm = 10, bent.offset_mm = 50;
  for (const plan::Implant& implant :
       {plan::Implant(plan::TotalHip{}), plan::Implant(lipped), plan::Implant(trapezoid), plan::Implant(bent),
        plan::Implant(plan::ReverseShoulder{})})
    for (const Side side : {Side::right, Side::left}) {
      const Joint joint = joint_of(implant, side);
      for (const Body* body : {&joint.fixed, &joint.mobile}) {
        EXPECT_TRUE(body->mesh.is_closed());
        EXPECT_EQ(mesh::self_crossings_of(body->mesh).pairs, 0);
        for (const BodyPart& part : body->parts)
          EXPECT_GT(mesh::enclosed_volume(mesh_of_part(*body, part.name)), 0) << part.name;
      }
    }
}

TEST(ImplantMeshes, EndMotionsWhereTheClosedFormDoes) {
  for (const Design& d : designs) EXPECT_LT(largest_difference(total_hip_of(d, 720)), 0.01) << d.name;
  EXPECT_LT(largest_difference(total_hip_of(designs[0], 720), Side::left), 0.01);
}

TEST(ImplantMeshes, ComeNearerByTheSquareOfTheFacets) {
  for (const int d : {0, 1, 4}) {
    const double coarse = largest_difference(total_hip_of(designs[d], 180)),
                 middle = largest_difference(total_hip_of(designs[d], 360)),
                 fine = largest_difference(total_hip_of(designs[d], 720));
    EXPECT_LT(coarse, 0.0055) << designs[d].name;
    // Which chord ends a motion where changes with the facets: a quarter each time on average.
    EXPECT_LT(middle, coarse / 2) << designs[d].name;
    EXPECT_LT(fine, coarse / 9) << designs[d].name;
  }
}

TEST(ImplantMeshes, OfConesAndChamfersEndMotionsWhereTheClosedFormDoes) {
  plan::TotalHip hip;
  hip.neck_taper = Angle::degrees(4);
  EXPECT_LT(largest_difference(hip), 0.01);
  hip.chamfer = Angle::degrees(-12);
  EXPECT_LT(largest_difference(hip), 0.01);
  hip.chamfer = Angle::degrees(12), hip.liner_half_angle = Angle::degrees(95);
  EXPECT_LT(largest_difference(hip), 0.01);
}

std::string part_that_met(const Body& body, const motion::Feature& feature) {
  return (feature.kind == motion::FeatureKind::face ? part_of_triangle(body, feature.id)
                                                    : part_of_vertex(body, feature.id))
      ->name;
}

TEST(ImplantMeshes, AreEndedByNeckAndLiner) {
  const Joint joint = joint_of(plan::TotalHip{});
  for (const motion::MotionLimit& limit : motion::RangeOfMotion(joint).limits(motion::hip_motions())) {
    if (limit.end.reason != motion::LimitReason::contact) continue;
    const motion::ContactWitness& met = *limit.end.contact;
    EXPECT_EQ(part_that_met(joint.mobile, met.mobile_feature), "neck") << limit.motion.name;
    EXPECT_EQ(part_that_met(joint.fixed, met.fixed_feature), "liner") << limit.motion.name;
  }
}

TEST(ReverseShoulder, IsTheSamePairWithRolesExchanged) {
  const plan::ReverseShoulder shoulder;
  const auto pair = *plan::revolved_pair(shoulder, Side::right);
  EXPECT_NEAR(pair.half_angle.degrees(), 102.607312, 1e-6);
  const std::vector<motion::Motion> motions{
      {"abduction", JointAngle::adduction, RotationSense::positive, {}, Angle::degrees(180)},
      {"horizontal_flexion",
       JointAngle::flexion,
       RotationSense::positive,
       {Angle(), Angle::degrees(90), Angle()},
       Angle::degrees(180)},
      {"internal_rotation", JointAngle::internal_rotation, RotationSense::positive, {}, Angle::degrees(120)},
      {"elevation in the plane 90",
       JointAngle::adduction,
       RotationSense::positive,
       {Angle::degrees(90), Angle(), Angle()},
       Angle::degrees(180)},
  };
  const double known[] = {139.7805, 79.1543, 99.3252, 39.9971};
  for (std::size_t m = 0; m < motions.size(); ++m)
    EXPECT_NEAR(plan::closed_limit(pair, {Anatomy::shoulder, Side::right}, motions[m]).turned.degrees(),
                known[m], 6e-5)
        << motions[m].name;
  for (const Side side : {Side::right, Side::left}) EXPECT_LT(largest_difference(shoulder, side), 0.01);
}

TEST(TotalHip, TurnsFartherWithALargerHeadAndLessFarWithARaisedRim) {
  plan::TotalHip larger;
  larger.head_radius_mm = 18;
  plan::TotalHip raised;
  raised.lip = Angle::degrees(15), raised.lip_width = Angle::degrees(360);
  const auto usual = mesh_limits(plan::TotalHip{}), with_larger = mesh_limits(larger),
             with_raised = mesh_limits(raised);
  double gain = 0, loss = 0;
  for (std::size_t m = 0; m < usual.size(); ++m) {
    EXPECT_GE(with_larger[m].end.turned, usual[m].end.turned) << usual[m].motion.name;
    EXPECT_LE(with_raised[m].end.turned.radians(), usual[m].end.turned.radians() + 1e-9)
        << usual[m].motion.name;
    gain += (with_larger[m].end.turned - usual[m].end.turned).degrees();
    loss += (usual[m].end.turned - with_raised[m].end.turned).degrees();
  }
  EXPECT_GT(gain, 10);
  EXPECT_GT(loss, 10);
  EXPECT_FALSE(plan::revolved_pair(raised, Side::right));
  EXPECT_EQ(plan::why_not_revolved(raised), "a liner with a lip is no body of revolution");
}

TEST(TotalHip, WithMoreAnteversionBendsFartherAndExtendsLess) {
  plan::TotalHip less = total_hip_of(designs[0]), more = less;
  more.cup.anteversion = Angle::degrees(25);
  EXPECT_GT(limit_of(more, "flexion"), limit_of(less, "flexion"));
  EXPECT_LT(limit_of(more, "extension"), limit_of(less, "extension"));
  EXPECT_LT(limit_of(more, "external_rotation"), limit_of(less, "external_rotation"));
}

TEST(TotalHip, WithALipBehindLosesWhereTheNeckComesToIt) {
  plan::TotalHip behind;
  behind.lip = Angle::degrees(15), behind.lip_towards = Angle::degrees(120),
  behind.lip_width = Angle::degrees(120);
  const auto usual = mesh_limits(plan::TotalHip{}), raised = mesh_limits(behind);
  // External rotation and extension bring the neck to the rim behind; flexion to the one in front.
  for (const auto& [m, loses] : {std::pair(0, false), std::pair(5, true)})
    EXPECT_EQ(raised[m].end.turned < usual[m].end.turned - Angle::degrees(1), loses) << usual[m].motion.name;
}

std::string refused(const plan::Implant& implant) {
  return complaint_of<UsageError>([&] { plan::check_implant(implant); });
}

TEST(TotalHip, RefusesWrongSizesInOneLine) {
  using Hip = plan::TotalHip;
  struct Wrong {
    void (*make)(Hip&);
    const char* line;
  };
  EXPECT_EQ(refused(Hip{}), "accepted");
  for (const auto& [make, line] :
       {Wrong{[](Hip& h) { h.head_radius_mm = 28; },
              "a head of radius 28 mm is too large for a cup of radius 27 mm outside: its wall needs 1 mm"},
        {[](Hip& h) { h.clearance_mm = -1; }, "a clearance of -1 mm makes the head larger than the liner"},
        {[](Hip& h) { h.neck_radius_mm = 17; },
         "the neck, of radius 17 mm, is thicker than the head, of radius 15.5 mm"},
        {[](Hip& h) { h.cup.inclination = Angle::degrees(-5); },
         "inclination is -5, must be 0 to 90 degrees"},
        {[](Hip& h) { h.neck_radius_mm = std::numeric_limits<double>::quiet_NaN(); },
         "neck_radius is nan, must be 2 to 20 mm"},
        {[](Hip& h) { h.facets = 181; }, "facets is 181, must be a multiple of 4 from 24 to 2880"},
        {[](Hip& h) { h.offset_mm = 20; },
         "the neck ends 16.3 mm from the centre of the head, too near to a cup of radius 27 mm outside: it "
         "must "
         "end 2 mm beyond, by a larger offset"},
        {[](Hip& h) { h.neck_lower_width_mm = 9; },
         "a trapezoid neck has both widths, neck_upper_width and neck_lower_width"}}) {
    Hip hip;
    make(hip);
    EXPECT_EQ(refused(hip), std::string("implant: ") + line);
  }
  for (const auto make : {+[](Hip& h) { h.chamfer = Angle::degrees(30), h.cup_radius_mm = 18; },
                          +[](Hip& h) { h.neck_taper = Angle::degrees(-8), h.neck_radius_mm = 4; },
                          +[](Hip& h) { h.neck_radius_mm = 15, h.liner_half_angle = Angle::degrees(119); }}) {
    Hip hip;
    make(hip);
    EXPECT_NE(refused(hip), "accepted");
  }
}

TEST(ImplantParameters, ReadAndWriteEachSize) {
  for (plan::Implant implant : {plan::Implant(plan::TotalHip{}), plan::Implant(plan::ReverseShoulder{})}) {
    for (const plan::ImplantParameter& each : plan::implant_parameters(implant)) {
      const double value = each.value(implant), other = (each.low + 3 * each.high) / 4;
      EXPECT_GE(value, each.low) << each.name;
      EXPECT_LE(value, each.high) << each.name;
      each.set(implant, other);
      EXPECT_NEAR(each.value(implant), other, 1e-9) << each.name;
      each.set(implant, value);
    }
    EXPECT_EQ(refused(implant), "accepted");
  }
}

}  // namespace
}  // namespace condyle::test
