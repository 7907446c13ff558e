#include <span>

#include "condyle/impingement_zone.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/range_of_motion.hpp"
#include "motion/joint_scenes.hpp"
#include "motion/motion_cases.hpp"
#include "support/test.hpp"

/// Bodies of several meshes whose contact ends a motion, slides or gives way: each answer is that of the pairs of meshes, each pair
/// searched as a joint of its own.

namespace condyle::motion {
namespace {

using namespace test;

struct Layer {
  TriMesh mesh;
  PartContact contact;
};

Body body_of(const char* name, std::span<const Layer> layers) {
  TriMesh whole;
  std::vector<BodyPart> parts;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const TriMesh& mesh = layers[i].mesh;
    parts.push_back({name + std::to_string(i), whole.vertices.size(), mesh.vertices.size(),
                     whole.triangles.size(), mesh.triangles.size(), layers[i].contact});
    whole = joined(whole, mesh);
  }
  return {name, std::move(whole), std::move(parts)};
}

/// A joint without a head: only words distinguish contacts.
Joint knee_of(Body fixed, Body mobile) {
  return {"layers", JointKind::ball, Side::right, std::move(fixed), std::move(mobile), Anatomy::knee};
}

std::vector<Layer> random_layers(std::mt19937& random) {
  std::uniform_int_distribution<int> word(0, 2);
  std::vector<Layer> layers{{random_box(random), PartContact::ends}};
  for (int i = 0; i < 4; ++i) layers.push_back({random_box(random), static_cast<PartContact>(word(random))});
  return layers;
}

/// By the table of PartContact, as it is read.
ContactKind kind_of(PartContact fixed, PartContact mobile, bool fixed_has_bearing) {
  if (fixed == PartContact::soft || mobile == PartContact::soft) return ContactKind::soft;
  if (mobile != PartContact::bearing) return ContactKind::impingement;
  return fixed == PartContact::bearing || !fixed_has_bearing ? ContactKind::bearing
                                                             : ContactKind::impingement;
}

/// The first contact of each kind, of pairs of meshes searched alone.
struct Expected {
  std::optional<Limit> ends, slides, soft;

  static void take(std::optional<Limit>& sooner, const Limit& limit) {
    if (limit.reason != LimitReason::end_of_range && (!sooner || limit.turned < sooner->turned))
      sooner = limit;
  }
  void take(ContactKind kind, const Limit& limit) {
    take(kind == ContactKind::soft ? soft : kind == ContactKind::bearing ? slides : ends, limit);
  }
};

Expected expected_of(const std::vector<Layer>& fixed, const std::vector<Layer>& mobile,
                     const Motion& motion) {
  const bool has_bearing = std::any_of(
      fixed.begin(), fixed.end(), [](const Layer& layer) { return layer.contact == PartContact::bearing; });
  RangeOptions accept;
  accept.overlap.reference_contact = ReferenceContact::accept;
  Expected expected;
  for (const Layer& f : fixed)
    for (const Layer& m : mobile) {
      const RangeOfMotion pair(knee_of({"fixed", f.mesh}, {"mobile", m.mesh}), accept);
      expected.take(kind_of(f.contact, m.contact, has_bearing), pair.limit(motion).end);
    }
  return expected;
}

void expect_earlier(const std::optional<EarlierContact>& noted, const std::optional<Limit>& expected,
                    const Limit& end) {
  ASSERT_EQ(noted.has_value(), expected && expected->turned < end.turned);
  if (noted) {
    EXPECT_NEAR(noted->turned.radians(), expected->turned.radians(), 1e-11);
  }
}

bool has(const std::vector<Layer>& layers, PartContact contact) {
  return std::any_of(layers.begin(), layers.end(),
                     [&](const Layer& layer) { return layer.contact == contact; });
}

TEST(Layers, AnswerAsTheirPairsOfMeshesDo) {
  std::mt19937 random(33);
  int ended = 0, slid = 0, gave_way = 0;
  for (int scene = 0; scene < 60; ++scene) {
    const std::vector<Layer> fixed = random_layers(random), mobile = random_layers(random);
    const Joint joint = knee_of(body_of("fixed", fixed), body_of("mobile", mobile));
    RangeOptions accept;
    accept.overlap.reference_contact = ReferenceContact::accept;
    const RangeOfMotion range(joint, accept);
    for (const Motion& motion : built_in_motions(joint.kind, joint.anatomy)) {
      SCOPED_TRACE(std::to_string(scene) + " " + motion.name);
      const Limit end = range.limit(motion).end;
      const Expected expected = expected_of(fixed, mobile, motion);
      ASSERT_EQ(end.reason, expected.ends ? expected.ends->reason : LimitReason::end_of_range);
      const Angle turned = expected.ends ? expected.ends->turned : motion.range;
      EXPECT_NEAR(end.turned.radians(), turned.radians(), 1e-11);
      if (end.reason == LimitReason::contact_at_start) continue;
      expect_earlier(end.bearing_contact, expected.slides, end);
      expect_earlier(end.soft_contact, expected.soft, end);
      ended += expected.ends.has_value(), slid += end.bearing_contact.has_value(),
          gave_way += end.soft_contact.has_value();
      if (!end.contact) continue;
      // Which two meshes met is in the answer, and they are two that end motions.
      const BodyPart* f = part_of_triangle(joint.fixed, end.contact->fixed_feature.kind == FeatureKind::face
                                                            ? end.contact->fixed_feature.id
                                                            : no_index);
      if (f) {
        EXPECT_NE(f->contact, PartContact::soft);
      }
      const bool distinguishes = has(mobile, PartContact::bearing);
      EXPECT_EQ(end.kind(), distinguishes ? ContactKind::impingement : ContactKind::unknown);
    }
  }
  EXPECT_GT(ended, 100);
  EXPECT_GT(slid, 20);
  EXPECT_GT(gave_way, 60);
}

TEST(Layers, CountBearingOnRequestAndNeverWhatIsSoft) {
  std::mt19937 random(5);
  const std::vector<Layer> fixed = random_layers(random), mobile = random_layers(random);
  const Joint joint = knee_of(body_of("fixed", fixed), body_of("mobile", mobile));
  RangeOptions count{.bearing = {.rule = BearingRule::count}};
  count.overlap.reference_contact = ReferenceContact::accept;
  const RangeOfMotion range(joint, count);
  for (const Motion& motion : built_in_motions(joint.kind, joint.anatomy)) {
    Expected expected = expected_of(fixed, mobile, motion);
    if (expected.slides) Expected::take(expected.ends, *expected.slides);
    const Limit end = range.limit(motion).end;
    EXPECT_EQ(end.reason, expected.ends ? expected.ends->reason : LimitReason::end_of_range) << motion.name;
    if (expected.ends) {
      EXPECT_NEAR(end.turned.radians(), expected.ends->turned.radians(), 1e-11);
    }
  }
}

TEST(Layers, LeaveFreeWhatTheirPairsLeaveFree) {
  std::mt19937 random(12);
  RangeOptions accept;
  accept.overlap.reference_contact = ReferenceContact::accept;
  const RotationRange half_turns{Angle::degrees(-180), Angle::degrees(180)};
  std::size_t intervals = 0;
  for (int scene = 0; scene < 12; ++scene) {
    const std::vector<Layer> fixed = random_layers(random), mobile = random_layers(random);
    const RangeOfMotion range(knee_of(body_of("fixed", fixed), body_of("mobile", mobile)), accept);
    const bool has_bearing = has(fixed, PartContact::bearing);
    for (const JointAngle vary : all_joint_angles) {
      const FreeAngles free = range.free_angles(vary, {}, half_turns);
      intervals += free.intervals.size();
      // Free is what all pairs that end motions leave free.
      const auto is_free = [&](Angle at) {
        for (const Layer& f : fixed)
          for (const Layer& m : mobile) {
            if (kind_of(f.contact, m.contact, has_bearing) != ContactKind::impingement) continue;
            const RangeOfMotion pair(knee_of({"fixed", f.mesh}, {"mobile", m.mesh}), accept);
            if (!pair.both_limits(vary, turned_by({}, vary, at), {Angle(), Angle()}).free_at_start())
              return false;
          }
        return true;
      };
      for (int degrees = -175; degrees < 180; degrees += 25) {
        const Angle at = Angle::degrees(degrees);
        const bool said = std::any_of(free.intervals.begin(), free.intervals.end(),
                                      [&](const FreeInterval& i) { return i.low <= at && at <= i.high; });
        EXPECT_EQ(said, is_free(at)) << scene << " " << degrees;
      }
    }
  }
  EXPECT_GT(intervals, 36u);
}

/// A post whose edge ends flexion, cartilage of both bodies and a labrum met before it.
Joint layered_post(double pad_y) {
  PostJoint post = post_joint(JointAngle::flexion, Side::right);
  const Layer arm{post.joint.mobile.mesh, PartContact::ends}, bone{post.joint.fixed.mesh, PartContact::ends};
  // The arm swings forwards: pads in front of it, nearer to the centre.
  const Layer pad{box({9, pad_y, -1}, {11, pad_y + 10, 1}), PartContact::bearing};
  const Layer labrum{box({5, -60, -1}, {6, -55, 1}), PartContact::soft};
  const Layer cartilage{box({-1.2, -45, -1.2}, {1.2, -25, 1.2}), PartContact::bearing};
  return {"post", JointKind::hinge, Side::right, body_of("fixed", std::array{bone, pad, labrum}),
          body_of("mobile", std::array{arm, cartilage})};
}

const BodyPart& part_of(const Body& body, const Feature& feature) {
  return *(feature.kind == FeatureKind::face ? part_of_triangle(body, feature.id)
                                             : part_of_vertex(body, feature.id));
}

TEST(Layers, AreNamedAtTheLimitAndBeforeIt) {
  const Joint joint = layered_post(-40);
  const MotionLimit limit = RangeOfMotion(joint).limit(hip_motions().front());
  ASSERT_EQ(limit.end.reason, LimitReason::contact);
  EXPECT_NEAR(limit.end.turned.radians(), post_limit(), 1e-11) << "cartilage and labrum are left behind";
  EXPECT_EQ(limit.end.kind(), ContactKind::impingement);
  EXPECT_EQ(part_of(joint.fixed, limit.end.contact->fixed_feature).name, "fixed0");
  ASSERT_TRUE(limit.end.soft_contact && limit.end.soft_contact->contact);
  EXPECT_EQ(limit.end.soft_contact->contact->kind, ContactKind::soft);
  EXPECT_EQ(part_of(joint.fixed, limit.end.soft_contact->contact->fixed_feature).name, "fixed2");
  ASSERT_TRUE(limit.end.bearing_contact && limit.end.bearing_contact->contact);
  EXPECT_EQ(part_of(joint.fixed, limit.end.bearing_contact->contact->fixed_feature).name, "fixed1");
  EXPECT_EQ(part_of(joint.mobile, limit.end.bearing_contact->contact->mobile_feature).name, "mobile1");
}

TEST(Layers, EndAMotionWhereBoneMeetsCartilage) {
  const Joint joint = layered_post(-70);
  const MotionLimit limit = RangeOfMotion(joint).limit(hip_motions().front());
  ASSERT_EQ(limit.end.reason, LimitReason::contact);
  EXPECT_LT(limit.end.turned.radians(), post_limit());
  EXPECT_EQ(limit.end.kind(), ContactKind::impingement);
  EXPECT_EQ(part_of(joint.fixed, limit.end.contact->fixed_feature).name, "fixed1");
  EXPECT_EQ(part_of(joint.mobile, limit.end.contact->mobile_feature).name, "mobile0");
}

TEST(Layers, AreTheSameForPathsDisplacedJointsAndZones) {
  const Joint joint = layered_post(-70);
  const Motion motion = built_in_motions(joint.kind, joint.anatomy).front();
  const RangeOfMotion range(joint);
  const MotionLimit limit = range.limit(motion);
  JointAngles end{};
  end.flexion = Angle::degrees(60);
  const PathLimit path = PathFinder(joint).limit(std::array{JointAngles{}, end});
  EXPECT_EQ(path.reason, LimitReason::contact);
  EXPECT_NEAR(path.at.flexion.degrees(), limit.end.turned.degrees(), 0.01);
  const auto about = limits_about(joint, {&motion, 1}, {}, std::array{Vec3(0, 0, 0)});
  EXPECT_NEAR(about.front().turned.radians(), limit.end.turned.radians(), 1e-11);
  const auto zone = ZoneFinder(joint, {.past = Angle::degrees(1)}).zone(limit);
  ASSERT_TRUE(zone && !zone->mobile.triangles.empty());
  for (const Index t : zone->mobile.triangles) EXPECT_EQ(part_of_triangle(joint.mobile, t)->name, "mobile0");
  for (const Index t : zone->fixed.triangles) EXPECT_NE(part_of_triangle(joint.fixed, t)->name, "fixed2");
  for (std::size_t v = 0; v < joint.fixed.mesh.vertices().size(); ++v)
    if (part_of_vertex(joint.fixed, v)->contact == PartContact::soft) {
      EXPECT_EQ(zone->fixed.radial_depth_mm[v], 0) << v;
    }
}

TEST(Layers, OfAHeadSlideOnAllThatTouchesIt) {
  // Cartilage of the socket is a mesh of its own; the head, which touches the bone of it, slides all the same.
  const Joint plain = head_and_post_joint({0, 3.5, 0});
  Joint joint = plain;
  const TriMesh pad = box({200, 0, 0}, {201, 1, 1});
  const std::size_t vertices = joint.fixed.mesh.vertices().size(),
                    triangles = joint.fixed.mesh.triangles().size();
  joint.fixed.mesh = joined(joint.fixed.mesh, pad);
  joint.fixed.parts = {
      {"bone", 0, vertices, 0, triangles},
      {"cartilage", vertices, pad.vertices.size(), triangles, pad.triangles.size(), PartContact::bearing}};
  for (const Motion& motion : hip_motions()) {
    const Limit end = RangeOfMotion(joint).limit(motion).end,
                expected = RangeOfMotion(plain).limit(motion).end;
    EXPECT_NEAR(end.turned.radians(), expected.turned.radians(), 1e-11) << motion.name;
    EXPECT_EQ(end.reason, expected.reason);
    ASSERT_EQ(end.bearing_contact.has_value(), expected.bearing_contact.has_value());
    if (end.bearing_contact) {
      EXPECT_NEAR(end.bearing_contact->turned.radians(), expected.bearing_contact->turned.radians(), 1e-11);
    }
  }
}

TEST(Layers, NeedOneThatEndsMotions) {
  std::mt19937 random(1);
  const std::array all_soft{Layer{random_box(random), PartContact::soft}};
  const std::array bone{Layer{random_box(random), PartContact::ends}};
  EXPECT_THROW(RangeOfMotion(knee_of(body_of("fixed", all_soft), body_of("mobile", bone))), MeshError);
  EXPECT_THROW(RangeOfMotion(knee_of(body_of("fixed", bone), body_of("mobile", all_soft))), MeshError);
}

}  // namespace
}  // namespace condyle::motion
