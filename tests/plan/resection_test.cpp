#include "condyle/resection.hpp"

#include <cstdio>

#include "condyle/answer.hpp"
#include "condyle/sample/hip.hpp"
#include "measure/analytic_hip.hpp"
#include "mesh/self_crossings.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/winding_number.hpp"
#include "motion/rom/displacement.hpp"
#include "plan/sweep.hpp"
#include "plan/swept_interval.hpp"
#include "support/real_hip.hpp"
#include "support/test.hpp"

/// Bone that must go, against closed forms, sampled poses and the exact limits: docs/mathematics/12-resection.md.

namespace condyle::test {
namespace {

constexpr double degree = std::numbers::pi / 180;
const Vec3 down = -Vec3::UnitY();

/// A cylinder of radius a from the origin along an axis.
TriMesh neck(double a, const Vec3& axis = down) {
  constexpr double length = 60;
  std::vector<ProfilePoint> profile{{0, 0}, {0, a}};
  for (double along = 1; along <= length; along += 1) profile.push_back({along, a});
  profile.push_back({length, 0});
  return revolved(axis, profile, 240);
}

/// A half ball of radius `outer` with a hemispherical hole of radius R, its face through the origin.
TriMesh socket(double R, double outer, const Vec3& opening = down) {
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= 90; i += 5)
    profile.push_back({-outer * std::cos(i * degree), outer * std::sin(i * degree)});
  for (int i = 90; i >= 0; --i) profile.push_back({-R * std::cos(i * degree), R * std::sin(i * degree)});
  profile.front().beside = profile.back().beside = 0;
  return revolved(opening, profile, 360);
}

/// Far enough for an endless wall.
constexpr double endless = 80;

plan::ReachTarget target(const char* motion, double degrees) {
  return {motion::motion_named(motion::hip_motions(), motion), Angle::degrees(degrees)};
}

plan::ResectionOptions reaching(std::vector<plan::ReachTarget> targets) {
  plan::ResectionOptions request;
  request.targets = std::move(targets);
  return request;
}

/// The same, whatever bears.
plan::ResectionOptions reaching_with_every_contact(std::vector<plan::ReachTarget> targets) {
  plan::ResectionOptions request = reaching(std::move(targets));
  request.range.bearing.rule = motion::BearingRule::count;
  return request;
}

void expect_sound(const plan::CutBone& cut) {
  EXPECT_TRUE(cut.body.mesh.is_closed());
  EXPECT_EQ(mesh::self_crossings_of(cut.body.mesh).pairs, 0);
  std::size_t turned = 0;
  for (std::size_t t = 0; t < cut.before.triangles.size(); ++t) {
    const auto normal = [&](const TriMesh& m) {
      return Vec3((m.corner(t, 1) - m.corner(t, 0)).cross(m.corner(t, 2) - m.corner(t, 0)));
    };
    turned += !(normal(cut.before).dot(normal(cut.body.mesh)) > 0);
  }
  EXPECT_EQ(turned, 0);
}

/// Reached by the exact limits of the joint without the bone, by at most a fifth of a degree too much, and no limit is smaller.
void expect_reached(const Joint& before, const plan::Resection& done,
                    const motion::RangeOptions& range = {}) {
  for (const plan::ReachOutcome& outcome : done.targets) {
    EXPECT_FALSE(outcome.blocked) << outcome.target.motion.name;
    EXPECT_GE(outcome.after.end.turned.degrees(), outcome.target.reach.degrees() - 1e-9)
        << outcome.target.motion.name;
    if (outcome.before.end.turned < outcome.target.reach) {
      EXPECT_LE(outcome.after.end.turned.degrees(), outcome.target.reach.degrees() + 0.2);
    }
  }
  const auto motions = motion::hip_motions();
  const auto was = motion::RangeOfMotion(before, range).limits(motions),
             is = motion::RangeOfMotion(done.joint, range).limits(motions);
  for (std::size_t i = 0; i < motions.size(); ++i)
    EXPECT_GE(is[i].end.turned.degrees(), was[i].end.turned.degrees() - 1e-9) << motions[i].name;
}

/// The cut, sound and with the limits that it is for.
plan::Resection resected(const Joint& joint, const plan::ResectionOptions& request) {
  plan::Resection done = plan::resect(joint, request);
  EXPECT_TRUE(done.mobile || done.fixed);
  expect_reached(joint, done, request.range);
  for (const auto* cut : {&done.mobile, &done.fixed})
    if (*cut) expect_sound(**cut);
  return done;
}

struct NeckCase {
  double R, a, outer, limit, target, volume, area, depth;
  double volume_within;
};

// At edges of 0.5 mm. The cut is planned 0.0005 degrees beyond its target, which is 0.06 per cent of the second, small volume.
TEST(Resection, ANeckInASocketLosesWhatTheClosedFormSays) {
  for (const NeckCase& each :
       {NeckCase{25, 15, endless, 53.130102, 65, 356.680106, 215.932501, 4.434543, 0.001},
        {16, 6, endless, 67.975687, 70, 1.234676, 5.949339, 0.527678, 0.01}}) {
    const Joint joint = hip_of(socket(each.R, each.outer), neck(each.a));
    const plan::Resection done = resected(joint, reaching({target("flexion", each.target)}));
    ASSERT_TRUE(done.mobile);
    EXPECT_NEAR(done.targets[0].before.end.turned.degrees(), each.limit, 0.02);
    EXPECT_NEAR(done.mobile->volume_mm3 / each.volume, 1, each.volume_within);
    EXPECT_NEAR(done.mobile->least_volume_mm3 / each.volume, 1, 0.01);
    EXPECT_NEAR(done.mobile->area_mm2 / each.area, 1,
                0.025);  // what is less deep than a per cent is 1.5 % of it
    EXPECT_NEAR(done.mobile->deepest_mm, each.depth, 0.01);
  }
}

// A socket's wall that ends leaves bone above what it sweeps over, which a depth from the surface takes too.
TEST(Resection, WhatMustGoUnderAWallIsTheClosedForm) {
  const NeckCase each{16, 6, 20, 67.975687, 75, 30.817788, 36.055234, 1.858895, 0.05};
  const Joint joint = hip_of(socket(each.R, each.outer), neck(each.a));
  const plan::Resection done = resected(joint, reaching({target("flexion", each.target)}));
  EXPECT_NEAR(done.mobile->least_volume_mm3 / each.volume, 1, 0.01);
  EXPECT_GT(done.mobile->volume_mm3, each.volume);
  EXPECT_LT(done.mobile->volume_mm3, (1 + each.volume_within) * each.volume);
}

/// The closed form V(R) - V(outer) must go; what lies above the overhang goes too.
TEST(LongResection, DeepCutsUnderAWallAreReached) {
  if (std::getenv("CONDYLE_LONG_TESTS") == nullptr) GTEST_SKIP() << "a minute: CONDYLE_LONG_TESTS is not set";
  for (const auto& [R, a, outer, reach, volume, most] :
       {std::array{25., 15., 30., 65., 287.130333, 306.}, std::array{24., 12., 27., 75., 261.302985, 353.}}) {
    const Joint joint = hip_of(socket(R, outer), neck(a));
    plan::ResectionOptions request = reaching_with_every_contact({target("flexion", reach)});
    const plan::Resection done = resected(joint, request);
    std::printf("%.1f mm3 of which %.1f must, %.2f mm deep\n", done.mobile->volume_mm3,
                done.mobile->least_volume_mm3, done.mobile->deepest_mm);
    EXPECT_NEAR(done.mobile->least_volume_mm3 / volume, 1, 0.002);
    EXPECT_LT(done.mobile->volume_mm3, most);
  }
}

// Cup at 40 degrees of radiographic inclination and 15 of anteversion, walls of 16 to 20 mm, neck of 6 at 135 and 15 degrees.
TEST(Resection, ANeckInACupLosesWhatQuadratureSays) {
  const double inclination = 40 * degree, anteversion = 15 * degree, shaft = 45 * degree;
  const Vec3 opening(std::sin(anteversion), -std::cos(inclination) * std::cos(anteversion),
                     std::sin(inclination) * std::cos(anteversion));
  const Vec3 along =
      Eigen::AngleAxisd(-15 * degree, Vec3::UnitY()) * Vec3(0, -std::cos(shaft), std::sin(shaft));
  const Joint joint = hip_of(socket(16, 20, opening), neck(6, along));
  plan::ResectionOptions request = reaching_with_every_contact({target("flexion", 135)});
  const plan::Resection one = resected(joint, request);
  EXPECT_NEAR(one.mobile->least_volume_mm3, 6.443, 0.01 * 6.443);
  EXPECT_LT(one.volume_mm3(), 1.02 * 6.443);

  request.targets.push_back(target("internal_rotation_at_90_flexion", 45));
  request.targets.push_back(target("extension", 66));
  const plan::Resection three = resected(joint, request);
  EXPECT_NEAR(three.mobile->least_volume_mm3, 19.627, 0.01 * 19.627);
  EXPECT_LT(three.volume_mm3(), 1.02 * 19.627);
}

TriMesh ball_at(const Vec3& centre, double radius) {
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= 180; i += 2)
    profile.push_back({-radius * std::cos(i * degree), radius * std::sin(i * degree)});
  profile.front().beside = profile.back().beside = 0;
  return shifted_by(revolved(Vec3::UnitZ(), profile, 180), centre);
}

TriMesh block(const Vec3& low, const Vec3& high) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(
        {i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z()});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// The face of a block turns against a ball at rest: no vertex of the block is swept, and the groove has a closed depth.
TEST(Resection, ABallThatTouchesNoVertexLeavesItsGroove) {
  struct Groove {
    double distance, radius, before_face, target, limit, depth, volume, volume_within;
  };
  for (const auto& [distance, radius, before_face, reach, limit, depth, volume, volume_within] :
       {Groove{40, 3, 20, 18, 15.698778, 1.604020, 19.92709, 0.01},
        {30, 2, 10, 12, 6.177446, 3.046985, 29.91463, 0.04}}) {
    const Vec3 centre = distance * Vec3(std::cos(before_face * degree), std::sin(before_face * degree), 0);
    const Joint joint =
        hip_of(ball_at(centre, radius), block({distance - 9.3, -20, -9.7}, {distance + 9.1, 0, 9.9}));
    plan::ResectionOptions request = reaching_with_every_contact({target("flexion", reach)});
    const plan::Resection done = resected(joint, request);
    EXPECT_NEAR(done.targets[0].before.end.turned.degrees(), limit, 0.001);
    EXPECT_NEAR(done.mobile->deepest_mm, depth, 0.01);
    EXPECT_NEAR(done.mobile->least_volume_mm3 / volume, 1, 0.01);
    EXPECT_NEAR(done.mobile->volume_mm3 / volume, 1, volume_within);
  }
}

/// Where no ball of the radius comes to that stays outside of the bone: how far from one a lowered vertex is at the most, mm. Balls stand in
/// places `spacing` apart, and may enter bone by half of that.
double not_touched_mm(const plan::CutBone& cut, double radius, double spacing) {
  const TriMesh mesh(cut.body.mesh);
  const mesh::SurfaceDistance distance(mesh);
  const mesh::WindingNumber inside(cut.body.mesh);
  Eigen::AlignedBox3d box;
  Points lowered;
  for (std::size_t v = 0; v < cut.depth_mm.size(); ++v)
    if (cut.depth_mm[v] > 0) lowered.push_back(mesh.vertices[v]), box.extend(Vec3(mesh.vertices[v]));
  box.min().array() -= radius, box.max().array() += radius;
  Points free;
  for (double x = box.min().x(); x <= box.max().x(); x += spacing)
    for (double y = box.min().y(); y <= box.max().y(); y += spacing)
      for (double z = box.min().z(); z <= box.max().z();) {
        const Vec3 c(x, y, z);
        const double clear = distance(c) - radius;
        if (std::abs(clear) < spacing && clear > -spacing / 2 && inside.at(c).winding == 0) free.push_back(c);
        // The distance changes by no more than one goes.
        z += spacing * std::max(1.0, std::floor(std::abs(clear) / spacing));
      }
  double most = 0;
  for (std::size_t v = 0; v < lowered.size(); ++v) {
    const Vec3 p = lowered[v];
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < free.size(); ++i) nearest = std::min(nearest, (p - free[i]).squaredNorm());
    most = std::max(most, std::sqrt(nearest) - radius);
  }
  return most;
}

/// The groove of a ball of 3 mm, and a burr.
struct GrooveAndBurr {
  Joint joint;
  plan::ResectionOptions request;

  explicit GrooveAndBurr(double burr_mm)
      : joint(hip_of(ball_at(40 * Vec3(std::cos(20 * degree), std::sin(20 * degree), 0), 3),
                     block({31.3, -20, -9.7}, {49.1, 0, 9.9}))),
        request(reaching_with_every_contact({target("flexion", 18)})) {
    request.burr_mm = burr_mm;
  }
};

// The cap that a ball makes as it goes in as deep as the ball at rest would.
TEST(Resection, ABurrThatIsWiderThanAGrooveMakesItsOwnCap) {
  const double depth = 1.604020;
  for (const double radius : {4.0, 5.5}) {
    const GrooveAndBurr groove(2 * radius);
    const plan::Resection done = resected(groove.joint, groove.request);
    const double cap = std::numbers::pi * depth * depth * (3 * radius - depth) / 3;
    EXPECT_NEAR(done.mobile->volume_mm3 / cap, 1, 0.02);
    EXPECT_NEAR(done.mobile->burr_volume_mm3 / (cap - 19.92709), 1, 0.04);
    EXPECT_NEAR(done.mobile->deepest_mm, depth, 0.015);
    EXPECT_EQ(done.mobile->burr_in_kept_mm, 0);
    EXPECT_LT(not_touched_mm(*done.mobile, radius, 0.2), 0.15);
  }
  const GrooveAndBurr groove(11);
  plan::ResectionOptions any_shape = groove.request;
  any_shape.burr_mm.reset();
  EXPECT_GT(not_touched_mm(*plan::resect(groove.joint, any_shape).mobile, 5.5, 0.2), 0.3);
}

TEST(Resection, ABurrThatIsNarrowerThanAGrooveTakesNoMore) {
  const GrooveAndBurr groove(5);
  const plan::Resection done = resected(groove.joint, groove.request);
  EXPECT_LT(done.mobile->burr_volume_mm3, 0.01 * done.mobile->volume_mm3);
  EXPECT_NEAR(done.mobile->volume_mm3 / 19.92709, 1, 0.02);
}

TEST(Resection, ABurrThatWouldEnterKeptBoneIsSaidTo) {
  const Joint joint = hip_of(socket(25, endless), neck(15));
  plan::ResectionOptions request = reaching({target("flexion", 56)});
  request.edge_mm = 1;
  const plan::Resection any_shape = plan::resect(joint, request);
  request.burr_mm = 30;
  const plan::Resection free = plan::resect(joint, request);
  EXPECT_EQ(free.mobile->burr_in_kept_mm, 0);
  // Everything from 2 mm beside what must go on.
  Points goes;
  for (std::size_t v = 0; v < any_shape.mobile->depth_mm.size(); ++v)
    if (any_shape.mobile->depth_mm[v] > 0) goes.push_back(any_shape.mobile->before.vertices[v]);
  for (std::size_t v = 0; v < joint.mobile.mesh.vertices().size(); ++v) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < goes.size(); ++i)
      nearest = std::min(nearest, (joint.mobile.mesh.vertices()[v] - goes[i]).norm());
    request.mobile.vertices.push_back(nearest > 2);
  }
  const plan::Resection kept = plan::resect(joint, request);
  EXPECT_FALSE(kept.targets[0].blocked);
  EXPECT_GT(kept.mobile->burr_in_kept_mm, 0.05);
  EXPECT_LT(kept.volume_mm3(), free.volume_mm3());
  EXPECT_GT(kept.volume_mm3(), any_shape.volume_mm3());
}

TEST(Resection, NothingIsRemovedBeforeTheLimit) {
  const Joint joint = hip_of(socket(16, endless), neck(6));
  const plan::Resection done = plan::resect(joint, reaching({target("flexion", 60)}));
  EXPECT_FALSE(done.mobile || done.fixed);
  EXPECT_EQ(done.volume_mm3(), 0);
}

// Along the neck's own radius a vertex must go down to the larger of the hole's sphere and the plane of the block's face at the target.
TEST(Resection, EveryVertexIsAsDeepAsItMustBeAndLittleDeeper) {
  const double R = 25, a = 15, reach = 65;
  const plan::Resection done =
      plan::resect(hip_of(socket(R, endless), neck(a)), reaching({target("flexion", reach)}));
  const plan::CutBone& cut = *done.mobile;
  double excess = 0;
  std::size_t lowered = 0;
  for (std::size_t v = 0; v < cut.depth_mm.size(); ++v) {
    const Vec3 p = cut.before.vertices[v];
    const double along = -p.y(), beside = std::hypot(p.x(), p.z());
    if (std::abs(beside - a) > 0.01 || along < 1 || along > 50) continue;
    const double forwards = p.x() / beside;
    const double to_sphere = std::sqrt(std::max(R * R - along * along, 0.0));
    const double to_plane =
        forwards > 0 ? along * std::cos(reach * degree) / (std::sin(reach * degree) * forwards) : 1e9;
    const double must = std::max(0.0, a - std::max(to_sphere, to_plane));
    const double goes = a - std::hypot(cut.body.mesh.vertices()[v].x(), cut.body.mesh.vertices()[v].z());
    EXPECT_GT(goes, must - 0.02) << v;
    if (cut.depth_mm[v] > 0) ++lowered, excess += goes - must;
  }
  ASSERT_GT(lowered, 500u);
  EXPECT_LT(excess / static_cast<double>(lowered), 0.01);
}

TEST(Resection, WhatASweepFindsIsWhatSampledPosesFind) {
  const Joint joint = hip_of(socket(25, 30), neck(15));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> beside(-15, 15), along(-50, -10);
  for (const BodyRole cut : {BodyRole::mobile, BodyRole::fixed}) {
    const Mesh& other = cut == BodyRole::mobile ? joint.fixed.mesh : joint.mobile.mesh;
    for (const char* name : {"flexion", "abduction", "fadir", "internal_rotation_at_90_flexion"}) {
      const motion::Motion motion = motion::motion_named(motion::hip_motions(), name);
      Points points;
      for (int i = 0; i < 200; ++i) points.push_back({beside(random), along(random), beside(random)});
      const Angle reach = Angle::degrees(40);
      const auto first = plan::Sweep(joint, cut, other, motion, std::nullopt).first_inside(points, reach);
      const mesh::WindingNumber inside(other);
      for (std::size_t i = 0; i < points.size(); ++i) {
        double sampled = std::numeric_limits<double>::infinity();
        for (double degrees = 0; degrees <= reach.degrees() && std::isinf(sampled); degrees += 0.5) {
          const Pose X_FM = pose_at(
              joint.coordinates(),
              motion::turned_by(motion.start, motion.vary, Angle::degrees(degrees) * sign_of(motion.sense)));
          const Vec3 at = (cut == BodyRole::mobile ? X_FM : inverted(X_FM)) * points[i];
          if (inside.at(at).winding > 0) sampled = degrees * degree;
        }
        if (std::isinf(sampled)) continue;
        EXPECT_LE(first[i], sampled + 1e-9) << name << " " << i;
        EXPECT_GT(first[i], sampled - 0.5 * degree - 1e-9) << name << " " << i;
      }
    }
  }
}

// Against one probe after the other, step by step, the last step halved from its middle on; from the surface and from just before the end.
TEST(Resection, SweptIntervalsEndWhereSingleStepsFindTheirEnd) {
  const Joint joint = hip_of(socket(25, 30), neck(15));
  const plan::Sweep sweep(joint, BodyRole::mobile, joint.fixed.mesh, target("flexion", 65).motion,
                          std::nullopt);
  const Angle reach = Angle::degrees(65);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> turned(-0.7, 0.7), along(15, 40), below(0, 4.5);
  std::vector<plan::Probe> probes;
  for (int i = 0; i < 400; ++i) {
    const double angle = turned(random);
    const Vec3 outwards(std::cos(angle), 0, std::sin(angle));
    probes.push_back({(15 - (i % 2) * below(random)) * outwards + along(random) * down, -outwards,
                      i % 5 == 0 ? 1.03 : 30});
  }
  const std::vector<plan::SweepTo> sweeps{{&sweep, reach}};
  const auto found = plan::swept_intervals(probes, sweeps);
  const auto is_odd = [](std::size_t i) { return i % 2 == 1; };
  const auto of_even = plan::swept_intervals(
      probes, sweeps, [&](auto& which, const auto&, double) { std::erase_if(which, is_odd); });
  std::size_t swept = 0;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const auto is_swept = [&](double depth) {
      Points point;
      point.push_back(probes[i].at(std::min(depth, probes[i].room)));
      return std::isfinite(sweep.first_inside(point, reach)[0]);
    };
    EXPECT_EQ(found[i].need.has_value(), is_swept(0));
    if (!found[i].need) continue;
    ++swept;
    double length = 0;
    for (int step = 1; length < probes[i].room && is_swept(step * 0.1); ++step)
      length = std::min(step * 0.1, probes[i].room);
    if (length < probes[i].room) {
      double half = 0.05;
      for (int halving = 0; halving < 9; ++halving, half /= 2)
        if (is_swept(length + half)) length = std::min(length + half, probes[i].room);
      length = std::min(length + 2 * half, probes[i].room);
    }
    EXPECT_EQ(found[i].length, length) << i;
    EXPECT_TRUE(is_odd(i) ? of_even[i].length <= length : of_even[i].length == length) << i;
  }
  EXPECT_GT(swept, 50u);
}

// The depth that stays is that of the cut, not of what the other bone's share takes away from it.
TEST(Resection, ADepthThatIsSharedIsHeldByEachBone) {
  const Joint joint = hip_of(socket(25, 30), neck(15));
  plan::ResectionOptions request = reaching({target("flexion", 56)});
  request.fixed_share = 0.5;
  request.edge_mm = 1;
  const plan::Resection free = plan::resect(joint, request);
  const double deepest = std::max(free.mobile->deepest_mm, free.fixed->deepest_mm);
  request.mobile.deepest_mm = request.fixed.deepest_mm = 1.3 * deepest;
  const plan::Resection held = plan::resect(joint, request);
  EXPECT_FALSE(held.targets[0].blocked);
  EXPECT_NEAR(held.volume_mm3() / free.volume_mm3(), 1, 1e-3);
}

/// Loss of the volume that a bone's triangles enclose, by its cut.
double lost_mm3(const plan::CutBone& cut) {
  const auto below = [](const TriMesh& mesh) {
    double volume = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      volume += mesh.corner(t, 0).dot(mesh.corner(t, 1).cross(mesh.corner(t, 2))) / 6;
    return volume;
  };
  return below(cut.before) - below(cut.body.mesh);
}

TEST(Resection, RimOrBothBonesReachTheSameTarget) {
  const Joint joint = hip_of(socket(25, 30), neck(15));
  for (const double share : {1.0, 0.5}) {
    plan::ResectionOptions request = reaching({target("flexion", 60)});
    request.fixed_share = share;
    const plan::Resection done = resected(joint, request);
    ASSERT_TRUE(done.fixed);
    EXPECT_EQ(done.mobile.has_value(), share < 1);
    EXPECT_NEAR(done.fixed->volume_mm3, lost_mm3(*done.fixed), 1e-6);
  }
}

Joint sample_joint(double alpha_deg) {
  sample::HipParameters parameters;
  parameters.alpha_angle = Angle::degrees(alpha_deg);
  auto [hip_bone, femur] = sample::sample_hip(parameters, sample::Scenario::one);
  return hip_of(std::move(hip_bone), std::move(femur));
}

TEST(Resection, SampleCamsReachTheirTargets) {
  for (const double alpha : {60.0, 70.0, 80.0}) {
    const Joint joint = sample_joint(alpha);
    const plan::Resection done =
        resected(joint, reaching({target("internal_rotation_at_90_flexion", 50), target("fadir", 36)}));
    EXPECT_LT(done.mobile->volume_mm3, 1.01 * done.mobile->least_volume_mm3 + 0.1);
    for (std::size_t v = 0; v < done.mobile->depth_mm.size(); ++v)
      if (done.mobile->depth_mm[v] > 0) {
        EXPECT_GE(done.mobile->needed_by[v], 0);
      }
  }
}

// The hip made without a cam reaches what it reaches, so no bone of it is in the way of that: what is left of a cam lies around it. It is not
// the same, and its alpha angle falls hardly: beside the head a cam passes through the joint space and stands in no way.
TEST(Resection, OfACamNothingGoesThatTheHipWithoutOneHas) {
  auto [hip_bone, femur] = sample::sample_hip(sample::HipParameters{}, sample::Scenario::one);
  const Joint without = hip_of(std::move(hip_bone), std::move(femur));
  std::vector<plan::ReachTarget> targets;
  for (const char* name : {"internal_rotation_at_90_flexion", "fadir"}) {
    const plan::ReachTarget any = target(name, 1);
    const Angle end = motion::RangeOfMotion(without).limit(any.motion).end.turned;
    targets.push_back({any.motion, end - Angle::degrees(0.01)});
  }
  const plan::Resection done = plan::resect(sample_joint(75), reaching(targets));
  const plan::CutBone& cut = *done.mobile;
  const mesh::WindingNumber inside(without.mobile.mesh);
  std::size_t lowered = 0;
  for (std::size_t v = 0; v < cut.depth_mm.size(); ++v) {
    if (cut.depth_mm[v] < 0.2) continue;
    const Vec3 now = cut.body.mesh.vertices()[v], out = (Vec3(cut.before.vertices[v]) - now).normalized();
    EXPECT_EQ(inside.at(now + 0.1 * out).winding, 0) << v << ", " << cut.depth_mm[v] << " mm deep";
    ++lowered;
  }
  EXPECT_GT(lowered, 300u);
}

TEST(Resection, AMarginKeepsTheFixedBoneMovedOutwardsClear) {
  const Joint joint = hip_of(socket(25, endless), neck(15));
  plan::ResectionOptions request = reaching({target("flexion", 60)});
  const double without = plan::resect(joint, request).volume_mm3();
  request.margin_mm = 1;
  const plan::Resection done = plan::resect(joint, request);
  EXPECT_GT(done.volume_mm3(), without);
  // A block whose hole is nine tenths of a millimetre narrower, and its face as much farther down.
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= 90; i += 5) profile.push_back({-80 * std::cos(i * degree), 80 * std::sin(i * degree)});
  profile.push_back({0.9, 80});
  profile.push_back({0.9, 24.1});
  for (int i = 90; i >= 0; --i)
    profile.push_back({-24.1 * std::cos(i * degree), 24.1 * std::sin(i * degree)});
  profile.back().beside = profile.front().beside = 0;
  const Joint nearer = hip_of(revolved(down, profile, 360), done.joint.mobile.mesh);
  EXPECT_GE(motion::RangeOfMotion(nearer).limit(target("flexion", 60).motion).end.turned.degrees(), 60);
}

TEST(Resection, KeptBoneStopsAMotionAndIsNamed) {
  const Joint joint = hip_of(socket(25, endless), neck(15));
  plan::ResectionOptions request = reaching({target("flexion", 57.5)});
  request.mobile.deepest_mm = 1;
  const plan::Resection shallow = plan::resect(joint, request);
  ASSERT_TRUE(shallow.targets[0].blocked);
  EXPECT_EQ(shallow.targets[0].blocked->by, plan::KeptBy::depth);
  EXPECT_LE(shallow.mobile->deepest_mm, 1);
  // A depth of 1 mm is reached where 15 - 25 cos t = 1.
  const double closed_form = std::acos(14.0 / 25) / degree;
  EXPECT_NEAR(shallow.targets[0].planned.degrees(), closed_form, 0.5);
  EXPECT_GE(shallow.targets[0].after.end.turned.degrees(), shallow.targets[0].planned.degrees() - 1e-9);

  request.mobile = {};
  request.mobile.vertices.assign(joint.mobile.mesh.vertices().size(), 1);
  const plan::Resection none = plan::resect(joint, request);
  ASSERT_TRUE(none.targets[0].blocked);
  EXPECT_EQ(none.targets[0].blocked->by, plan::KeptBy::marked);
  EXPECT_EQ(none.volume_mm3(), 0);
  EXPECT_NEAR(none.targets[0].planned.degrees(), 53.13, 0.05);
}

TEST(Resection, AGainCountsFromWhereTheMotionEnds) {
  const Joint joint = hip_of(socket(25, endless), neck(15));
  const auto gain_of = [](const char* motion, double degrees) {
    plan::ReachTarget gain = target(motion, degrees);
    gain.is_gain = true;
    return reaching({gain});
  };
  const plan::Resection by_gain = plan::resect(joint, gain_of("flexion", 4));
  const double now = by_gain.targets[0].before.end.turned.degrees();
  EXPECT_NEAR(now, 53.13, 0.02);
  EXPECT_NEAR(by_gain.targets[0].target.reach.degrees(), now + 4, 1e-12);
  EXPECT_FALSE(by_gain.targets[0].target.is_gain);
  EXPECT_NEAR(by_gain.volume_mm3(), plan::resect(joint, reaching({target("flexion", now + 4)})).volume_mm3(),
              1e-3);
  const auto refusal_of = [&](const plan::ResectionOptions& request) {
    try {
      (void)plan::resect(joint, request);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal_of(gain_of("flexion", 130)).find("beyond its range"), std::string::npos);
  EXPECT_THROW((void)plan::resect(joint, gain_of("internal_rotation", 5)), MeshError) << "nothing ends it";
  EXPECT_NE(refusal_of(gain_of("flexion", -5)).find("is to gain -5 degrees: a gain is above 0"),
            std::string::npos);
  EXPECT_TRUE(parse_reach("flexion=+4").front().is_gain);
  EXPECT_THROW((void)parse_reach("flexion=++4"), UsageError);
}

TEST(Resection, RequestsThatSayNothingAreRefused) {
  const Joint joint = hip_of(socket(16, 20), neck(6));
  EXPECT_THROW(plan::resect(joint, {}), UsageError);
  EXPECT_THROW(plan::resect(joint, reaching({target("flexion", 0)})), UsageError);
  EXPECT_THROW(plan::resect(joint, reaching({target("flexion", 181)})), UsageError);
  plan::ResectionOptions request = reaching({target("flexion", 70)});
  request.mobile.vertices = {1, 0};
  EXPECT_THROW(plan::resect(joint, request), UsageError);
  const auto motions = motion::hip_motions();
  // A neck without a head bears nowhere.
  request = reaching({target("flexion", 70)});
  request.mobile.within_mm = 5;
  EXPECT_THROW(plan::resect(joint, request), UsageError);
  request = reaching({target("flexion", 70)});
  request.burr_mm = 0;
  EXPECT_THROW(plan::resect(joint, request), UsageError);
  EXPECT_THROW(reach_targets(motions, "flexion"), UsageError);
  EXPECT_THROW(reach_targets(motions, "flexion=nan"), UsageError);
  // A name may be given in any letters.
  EXPECT_THROW(plan::resect(joint, reaching(reach_targets(motions, "flexion=70 Flexion=71"))), UsageError);
  EXPECT_THROW(reach_targets(motions, " "), UsageError);
  EXPECT_EQ(reach_targets(motions, "flexion=115, fadir=30").size(), 2u);
}

// The cartilage is the bearing surface; the bone is measured before and after.
TEST(Resection, MeasuresAreThoseOfTheBoneUnderACartilage) {
  sample::HipParameters parameters;
  parameters.alpha_angle = Angle::degrees(70);
  auto [hip_bone, femur] = sample::sample_hip(parameters, sample::Scenario::one);
  const TriMesh cartilage = ball_at(Vec3::Zero(), parameters.head_radius_mm + 1);
  const std::size_t vertices = femur.vertices.size(), triangles = femur.triangles.size();
  Joint joint = hip_of(std::move(hip_bone), joined(femur, cartilage));
  joint.mobile.parts = {{"bone", 0, vertices, 0, triangles},
                        {"cartilage", vertices, cartilage.vertices.size(), triangles,
                         cartilage.triangles.size(), PartContact::bearing}};
  const auto radius = [](const measure::HipMeasures& shape) { return *shape.femur.head_radius.value; };
  const ResectionAnswer answer =
      answer_resection({joint}, {.resection = reaching({target("internal_rotation_at_90_flexion", 45)}),
                                 .bands = {},
                                 .curve_points = 0});
  ASSERT_TRUE(answer.resection.mobile);
  expect_reached(joint, answer.resection);
  EXPECT_NEAR(motion::find_bearing_surface(answer.resection.joint).surface->head.radius,
              parameters.head_radius_mm + 1, 0.05);
  EXPECT_NEAR(radius(*answer.shape_before), radius(measure::measure_hip(joint)), 1e-9);
  EXPECT_NEAR(radius(*answer.shape_after), radius(measure::measure_hip(joint)), 1e-9);
}

/// The joint as it turns about another point of its frame.
Joint about(const Joint& joint, const Vec3& centre) {
  Joint moved = joint;
  for (Body Joint::*body : {&Joint::fixed, &Joint::mobile}) {
    (moved.*body).mesh = Mesh(shifted_by((joint.*body).mesh, -centre));
    if ((moved.*body).head) (moved.*body).head->centre -= centre;
  }
  return moved;
}

// Counted by the exact limits of each displaced joint, made by hand of the same draws. Along the neck's own axis, and along that of the
// motion, a displacement moves no limit: what is left is one of 16 mm's arc against a hole of 25, whose share with margin 0 is about half.
TEST(Resection, ASharesMarginIsReachedInThatShareOfJointsThatAreDisplacedByHand) {
  Case of{hip_of(socket(25, 30), neck(15))};
  of.uncertainty = {.centre_mm = 0.5, .axes = Angle(), .surface_mm = 0, .surface_voxels = 0};
  const BandRequest bands{.samples = 40};
  const auto draws = motion::displacements(band_options(of, bands), 0);
  double margin_mm = 0;
  for (const double confidence : {0.5, 0.8}) {
    ResectionRequest request{.resection = reaching({target("flexion", 60)}),
                             .bands = bands,
                             .confidence = confidence,
                             .curve_points = 0};
    request.resection.edge_mm = 1;
    request.motions = {request.resection.targets[0].motion};
    const ResectionAnswer answer = answer_resection(of, request);
    const auto share_of = [&](const Joint& cut) {
      std::size_t reached = 0;
      for (const motion::Displacement& draw : draws)
        reached += motion::RangeOfMotion(about(cut, draw.centre), {}).limit(request.motions[0]).end.turned >=
                   request.resection.targets[0].reach;
      return static_cast<double>(reached) / static_cast<double>(draws.size());
    };
    EXPECT_EQ(answer.promises[0].confidence_reached, share_of(answer.resection.joint));
    EXPECT_GE(answer.promises[0].confidence_reached, confidence);
    EXPECT_GT(answer.margin_mm, margin_mm);
    // What is asked of the margin: with what it may be too large by, the share is not reached. 0.25 degrees are 0.07 mm at the neck.
    request.resection.margin_mm = answer.margin_mm - 0.2;
    EXPECT_LT(share_of(plan::resect(of.joint, request.resection).joint), confidence);
    std::vector<double> gains;
    for (std::size_t i = 0; i < draws.size(); ++i)
      gains.push_back((answer.bands_after[0].turned[i] - answer.bands_before[0].turned[i]).degrees());
    std::sort(gains.begin(), gains.end());
    EXPECT_NEAR(answer.gain[0].degrees(), motion::quantile(gains, 1 - confidence), 1e-9);
    margin_mm = answer.margin_mm;
    if (confidence > 0.5) continue;
    // A margin that is given stays.
    request.confidence.reset();
    request.resection.margin_mm = 0;
    const ResectionAnswer given = answer_resection(of, request);
    EXPECT_EQ(given.margin_mm, 0);
    EXPECT_TRUE(given.alternatives.empty());
    EXPECT_EQ(given.promises[0].confidence_reached, share_of(given.resection.joint));
    EXPECT_LT(given.promises[0].confidence_reached, 0.6);
  }
}

// The last one is the plan itself.
TEST(Resection, EachPointOfACurveIsAPlanByItself) {
  const Case of{hip_of(socket(25, 30), neck(15))};
  ResectionRequest request{.resection = reaching({target("flexion", 55)}), .bands = {}, .curve_points = 2};
  request.resection.edge_mm = 2;
  request.motions = {request.resection.targets[0].motion};
  const ResectionAnswer answer = answer_resection(of, request);
  ASSERT_EQ(answer.curve.size(), 2u);
  for (const ResectionAnswer::CurvePoint& point : answer.curve) {
    plan::ResectionOptions one = request.resection;
    one.targets[0].reach = point.reached;
    const plan::Resection cut = plan::resect(of.joint, one);
    EXPECT_EQ(point.volume_mm3, cut.volume_mm3());
    EXPECT_EQ(point.deepest_mm, cut.mobile->deepest_mm);
  }
  EXPECT_LT(answer.curve[0].volume_mm3, answer.curve[1].volume_mm3);
  EXPECT_EQ(answer.curve[1].reached, request.resection.targets[0].reach);
}

// The socket is said to lie so far off that about its centre the cut's own gain is lost, or not.
TEST(Resection, AboutTheOtherCentreAPlanIsWhatTheJointThatIsMovedThereSays) {
  const sample::SampleHip bones =
      sample::sample_hip({.alpha_angle = Angle::degrees(70)}, sample::Scenario::one);
  Joint joint = hip_of(bones.hip_bone, bones.femur);
  const auto found = *motion::find_bearing_surface(joint).surface;
  joint.mobile.head = found.head, joint.mobile.bearing_margin_mm = found.margin_mm;
  const motion::Motion motion = target("internal_rotation_at_90_flexion", 45).motion;
  int plans = 0, decided = 0;
  for (const Vec3& off : {Vec3(0, 0.5, 0), Vec3(0, 1.2, 0), Vec3(0, -1.2, 0), Vec3(1.2, 0.4, 0)}) {
    joint.fixed.head = Sphere{found.head.centre + off, found.socket->radius};
    const ResectionAnswer answer =
        answer_resection({joint}, {.resection = reaching({{motion, Angle::degrees(45)}}),
                                   .motions = {motion},
                                   .bands = {},
                                   .curve_points = 0});
    const ResectionAnswer::TargetPromise& promise = answer.promises[0];
    ASSERT_EQ(promise.other_centre.has_value(), off.norm() > 1) << off.transpose();
    if (!promise.other_centre) continue;
    const auto limit_deg = [&](const Joint& of) {
      return motion::RangeOfMotion(about(of, joint.fixed.head->centre), {})
          .limit(motion)
          .end.turned.degrees();
    };
    EXPECT_NEAR(promise.other_centre->before.degrees(), limit_deg(joint), 1e-6);
    EXPECT_NEAR(promise.other_centre->after.degrees(), limit_deg(answer.resection.joint), 1e-6);
    const double there_deg = limit_deg(answer.resection.joint);
    const bool is_plan = there_deg >= answer.before[0].end.turned.degrees(), is_decided = there_deg >= 45;
    EXPECT_EQ(promise.is_plan, is_plan) << promise.text;
    EXPECT_EQ(promise.other_centre->is_decided, is_decided) << promise.text;
    EXPECT_EQ(promise.text.starts_with("no plan: "), !is_plan) << promise.text;
    plans += is_plan, decided += is_decided;
    const auto code = is_plan ? ResectionNoteCode::not_decided : ResectionNoteCode::no_plan;
    EXPECT_EQ(std::any_of(answer.notes.begin(), answer.notes.end(),
                          [&](const auto& note) { return note.code == code; }),
              !is_decided);
  }
  EXPECT_EQ(std::pair(plans, decided), std::pair(2, 1)) << "of three other centres";
}

// Nothing would be inside the one and nothing would be left of the other.
TEST(Resection, BodiesThatAreInsideOutAreRefused) {
  const Joint joint = hip_of(socket(16, 20), neck(6));
  for (Body Joint::*body : {&Joint::fixed, &Joint::mobile}) {
    Joint inverted = joint;
    TriMesh mesh = (joint.*body).mesh;
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    (inverted.*body).mesh = Mesh(std::move(mesh));
    try {
      plan::resect(inverted, reaching({target("flexion", 70)}));
      FAIL() << (joint.*body).name;
    } catch (const MeshError& error) {
      EXPECT_NE(std::string(error.what()).find("inverted orientation"), std::string::npos) << error.what();
    }
  }
}

struct GainCase {
  double gain_deg, least_mm3, deepest_mm;
};

TEST(Resection, TheVisibleHumansHipLosesLittleMoreThanTheLeast) {
  FOUND_OR_SKIP(hip, hip_vhf_right());
  // Least volumes by voxels of 0.2 mm.
  for (const auto& [gain, least, deepest] : {GainCase{5, 34.8, 1.3}, {10, 150.1, 2.8}, {15, 352.6, 4.5}}) {
    const plan::Resection done =
        resected(*hip, reaching({target("internal_rotation_at_90_flexion", 32.686 + gain)}));
    EXPECT_LE(done.volume_mm3(), 1.01 * least);
    EXPECT_GE(done.volume_mm3(), 0.97 * least);
    EXPECT_LE(done.mobile->deepest_mm, deepest);
  }
  // The same bone in its place is the same joint, also if a head was fitted to it by itself.
  const plan::Resection done =
      plan::resect(*hip, reaching({target("internal_rotation_at_90_flexion", 42.686)}));
  const Mesh& cut_femur = done.mobile->body.mesh;
  Joint anew = *hip;
  anew.mobile.mesh = cut_femur;
  EXPECT_NE(motion::find_bearing_surface(anew).surface->head.radius,
            motion::find_bearing_surface(done.joint).surface->head.radius);
  const auto motions = motion::hip_motions();
  const auto placed = motion::RangeOfMotion(plan::with_mobile_mesh(*hip, cut_femur)).limits(motions),
             planned = motion::RangeOfMotion(done.joint).limits(motions);
  for (std::size_t i = 0; i < motions.size(); ++i)
    EXPECT_EQ(placed[i].end.turned, planned[i].end.turned) << motions[i].name;
  // From the rim, and from both: what poses 0.2 degrees apart sweep over, in voxels of 0.25 mm.
  for (const auto& [share, of_rim] : {std::pair(1.0, 149.6), {0.5, 73.1}}) {
    plan::ResectionOptions request = reaching({target("internal_rotation_at_90_flexion", 42.686)});
    request.fixed_share = share;
    const plan::Resection rim = resected(*hip, request);
    EXPECT_NEAR(rim.fixed->volume_mm3 / of_rim, 1, 0.01);
  }
  plan::ResectionOptions burr = reaching({target("internal_rotation_at_90_flexion", 42.686)});
  burr.burr_mm = 5.5;
  const plan::Resection made = resected(*hip, burr);
  EXPECT_LT(made.volume_mm3(), 1.15 * 150.1);
  EXPECT_LT(not_touched_mm(*made.mobile, 2.75, 0.2), 0.15 + made.mobile->burr_in_kept_mm);
  const plan::Resection flexion = resected(*hip, reaching({target("flexion", 140)}));
}

// A globe on a cone: what flexion sweeps of the cone folds, whichever way it goes. The other directions, each as long, are not tried.
TEST(Resection, ACutThatFoldsManyTrianglesIsRefusedAtOnce) {
  FOUND_OR_SKIP(hip, hip_vhf_right());
  constexpr double radius = 23.8, rows = 23;
  std::vector<ProfilePoint> profile{{-radius, 0}};
  for (int i = 1; i < rows; ++i)
    profile.push_back(
        {-radius * std::cos(i * 180 / rows * degree), radius * std::sin(i * 180 / rows * degree)});
  profile.push_back({80, 0});
  Joint joint = *hip;
  joint.mobile.mesh = Mesh(revolved(down, profile, 100));
  try {
    plan::resect(joint, reaching({target("flexion", 125)}));
    FAIL();
  } catch (const MeshError& error) {
    EXPECT_NE(std::string(error.what()).find("turns more than 10000 triangles over: ask for less"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace condyle::test
