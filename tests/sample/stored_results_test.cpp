#include <bit>
#include <ostream>
#include <type_traits>

#include "condyle/contact.hpp"
#include "condyle/pose.hpp"
#include "condyle/range_of_motion.hpp"
#include "condyle/tangential.hpp"
#include "core/thread_limit.hpp"
#include "sample/made_hips.hpp"
#include "simd/instruction_set.hpp"
#include "support/test.hpp"

/// Answers on the sample hip as they have always been: a change of the code that is not meant to change them
/// shows here at the first bit. A change that is meant to: store the new hashes, and say in the commit why.
///
/// Results of the C library's functions of angles may differ by the last bit between machines. They are kept out: the
/// meshes whose answers are hashed have vertices rounded to 2^-16 mm, poses are made without
/// functions of angles, `ray_to_normal` is left out, and the limits of motions are rounded to 1e-8 degrees
/// and their contact points to 1e-6 mm. Everything else is hashed by its bits.

namespace condyle::sample {
namespace {

/// FNV-1a of 64 bits, http://www.isthe.com/chongo/tech/comp/fnv; numbers as eight bytes, the lowest first.
class Hash {
 public:
  void add(std::uint64_t number) noexcept {
    for (int byte = 0; byte < 8; ++byte, number >>= 8) value_ = (value_ ^ (number & 0xff)) * 0x100000001b3;
  }
  void add(double number) noexcept { add(std::bit_cast<std::uint64_t>(number)); }
  void add_rounded(double number, double unit) noexcept {
    add(static_cast<std::uint64_t>(std::llround(number / unit)));
  }
  /// Integers and enumerations, negative ones as their two's complement; angles as radians.
  template <class T>
  void add_all(const std::vector<T>& numbers) noexcept {
    add(std::uint64_t{numbers.size()});
    for (const T& number : numbers) {
      if constexpr (std::is_same_v<T, double>) {
        add(number);
      } else if constexpr (std::is_same_v<T, Angle>) {
        add(number.radians());
      } else {
        add(static_cast<std::uint64_t>(static_cast<std::int64_t>(number)));
      }
    }
  }
  std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

std::uint64_t hash_of(const TriMesh& mesh) {
  Hash hash;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (const double x : {mesh.vertices.x[v], mesh.vertices.y[v], mesh.vertices.z[v]}) hash.add(x);
  }
  for (const auto& triangle : mesh.triangles) {
    for (const Index vertex : triangle) hash.add(std::uint64_t{vertex});
  }
  return hash.value();
}

TriMesh rounded(TriMesh mesh) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 p = mesh.vertices[v];
    mesh.vertices.set(v, Vec3(std::nearbyint(p.x() * 0x1p16), std::nearbyint(p.y() * 0x1p16),
                              std::nearbyint(p.z() * 0x1p16)) *
                             0x1p-16);
  }
  return mesh;
}

/// The rotation of the quaternion (w, x, y, z) of any length, by products and quotients only.
Pose turned(double w, double x, double y, double z, const Vec3& shift) {
  const double n = w * w + x * x + y * y + z * z;
  Pose X = Pose::Identity();
  X.linear() << (w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n,
      2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n,
      2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n;
  X.translation() = shift;
  return X;
}

/// Neutral and free; shifted by a little more than the joint space; flexed by 90 degrees and beyond, with
/// rotation and adduction; abducted, much further than joints go; driven deep into the socket.
std::vector<Pose> poses() {
  return {Pose::Identity(),
          turned(1, 0, 0, 0, {0.25, 3.75, 0}),
          turned(1, 0, 0, 1, {0, 0, 0}),
          turned(5, 1, 1, 9, {0, 0, 0}),
          turned(12, -7, 2, 1, {0, 0, 0}),
          turned(2, -2, 1, 1, {0, 0, 0}),
          turned(3, 0, 1, 8, {0, 0, 0}),
          turned(7, 2, -3, 6, {-1.5, 8, -3})};
}

void add(const std::vector<contact::TrianglePair>& pairs, Hash& hash) {
  hash.add(std::uint64_t{pairs.size()});
  for (const auto& [fixed, mobile] : pairs) hash.add(std::uint64_t{fixed}), hash.add(std::uint64_t{mobile});
}

template <class Hits>
void add_common(const Hits& hits, Hash& hash) {
  hash.add_all(hits.state);
  hash.add_all(hits.winding);
  hash.add_all(hits.triangle);
}

struct Hashes {
  std::uint64_t hip_bone, femur, radial, tangential, arcs, motions;
  friend bool operator==(const Hashes&, const Hashes&) = default;
  friend void PrintTo(const Hashes& hashes, std::ostream* out) {
    *out << std::hex << "hip bone 0x" << hashes.hip_bone << ", femur 0x" << hashes.femur << ", radial 0x"
         << hashes.radial << ", tangential 0x" << hashes.tangential << ", arcs 0x" << hashes.arcs
         << ", motions 0x" << hashes.motions << std::dec;
  }
};

/// How many points were inside in all poses, pairs found and motions ended by contact: hashes of nothing hold
/// nothing.
struct Seen {
  std::size_t inside = 0, pairs = 0, arcs = 0, contacts = 0;
};

std::uint64_t radial_hash(const contact::JointContact& joint, Seen& seen) {
  Hash hash;
  for (const Pose& X_FM : poses()) {
    const contact::RadialContact contact = joint.radial(X_FM);
    for (const auto* hits : {&*contact.mobile_in_fixed, &*contact.fixed_in_mobile}) {
      add_common(*hits, hash);
      hash.add_all(hits->direction);
      hash.add_all(hits->radial_gap_mm);
      for (const PointState state : hits->state) seen.inside += state == PointState::inside;
    }
    add(contact.pairs, hash);
    hash.add(std::uint64_t{contact.in_contact});
    seen.pairs += contact.pairs.size();
  }
  return hash.value();
}

std::uint64_t tangential_hash(const contact::JointContact& joint) {
  Hash hash;
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, -2, 3)}) {
    for (const Pose& X_FM : poses()) {
      const contact::TangentialContact contact = joint.tangential(X_FM, axis);
      for (const auto* hits : {&*contact.mobile_in_fixed, &*contact.fixed_in_mobile}) {
        add_common(*hits, hash);
        hash.add_all(hits->rotation_sense);
        hash.add_all(hits->angular_gap);
        hash.add_all(hits->arc_gap_mm);
      }
      add(contact.pairs, hash);
    }
  }
  return hash.value();
}

std::uint64_t arcs_hash(const contact::JointContact& joint, Seen& seen) {
  Hash hash;
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, -2, 3)}) {
    const tangential::RingTable table(joint.fixed(), AxisFrame(Vec3::Zero(), axis));
    const tangential::OccupiedArcs arcs = table.occupied_arcs(joint.mobile().vertices());
    for (std::size_t point = 0; point < arcs.size(); ++point) {
      hash.add(std::uint64_t{arcs.of(point).size()});
      for (const tangential::OccupiedArc& arc : arcs.of(point)) {
        hash.add(arc.begin.radians()), hash.add(arc.end.radians());
        hash.add(std::uint64_t{arc.enters}), hash.add(std::uint64_t{arc.leaves});
      }
      seen.arcs += arcs.of(point).size();
    }
  }
  return hash.value();
}

std::uint64_t motions_hash(const contact::JointContact& joint, Seen& seen) {
  const motion::RangeOfMotion range(
      {"sample hip", JointKind::ball, Side::right, {"hip bone", joint.fixed()}, {"femur", joint.mobile()}},
      {.bearing = {.rule = motion::BearingRule::count}});
  Hash hash;
  const auto add_feature = [&](const motion::Feature& feature) {
    hash.add(static_cast<std::uint64_t>(feature.kind));
    hash.add(std::uint64_t{feature.id}), hash.add(std::uint64_t{feature.other_end});
  };
  for (const motion::MotionLimit& motion : range.limits(motion::hip_motions())) {
    const motion::Limit& limit = motion.end;
    hash.add_rounded(limit.turned.degrees(), 1e-8);
    hash.add(static_cast<std::uint64_t>(limit.reason));
    hash.add(std::uint64_t{limit.contact.has_value()});
    // Kept as it was stored: whether the contact is within 26 mm of the joint centre.
    hash.add(std::uint64_t{limit.contact && limit.contact->fixed_point.norm() <= 26});
    if (!limit.contact) continue;
    ++seen.contacts;
    add_feature(limit.contact->fixed_feature), add_feature(limit.contact->mobile_feature);
    for (const Vec3& p : {limit.contact->fixed_point, limit.contact->mobile_point}) {
      for (int axis = 0; axis < 3; ++axis) hash.add_rounded(p[axis], 1e-6);
    }
  }
  return hash.value();
}

void expect_stored(Scenario scenario, const Hashes& stored) {
  const SampleHip& hip = test::made_hip(scenario);
  const std::uint64_t hip_bone = hash_of(hip.hip_bone), femur = hash_of(hip.femur);
  EXPECT_TRUE(hip_bone == stored.hip_bone && femur == stored.femur)
      << "the sample is made otherwise, or on a machine whose C library rounds otherwise";
  const contact::JointContact joint(rounded(hip.hip_bone), rounded(hip.femur));
  Seen seen;
  const Hashes found = {hip_bone,
                        femur,
                        radial_hash(joint, seen),
                        tangential_hash(joint),
                        arcs_hash(joint, seen),
                        motions_hash(joint, seen)};
  EXPECT_EQ(found, stored);
  EXPECT_GT(seen.inside, 200u);
  EXPECT_GT(seen.pairs, 400u);
  EXPECT_GT(seen.arcs, 200u);
  EXPECT_GE(seen.contacts, 6u);
}

constexpr Hashes of_scenario_one = {.hip_bone = 0x637ce21c2363a85e,
                                    .femur = 0x1cb8fd6386079d71,
                                    .radial = 0x0e6b42dd8af0c61c,
                                    .tangential = 0xa488feeb24ad1136,
                                    .arcs = 0x09afef927db2cb9f,
                                    .motions = 0xb9be3589290fe999};

TEST(StoredResults, OfScenarioOneAreWhatTheyWere) {
  expect_stored(Scenario::one, of_scenario_one);
}

TEST(StoredResults, AreTheSameOnEachInstructionSetAndOnOneTwoAndSevenThreads) {
  for (const simd::InstructionSet& set : simd::instruction_sets()) {
    const simd::InstructionSetInUse in_use(set);
    for (const std::size_t threads : {1, 2, 7}) {
      SCOPED_TRACE(set.name + ", " + std::to_string(threads) + " threads");
      const core::ThreadLimit most(threads);
      expect_stored(Scenario::one, of_scenario_one);
    }
  }
}

TEST(StoredResults, OfScenarioTwoAreWhatTheyWere) {
  expect_stored(Scenario::two, {.hip_bone = 0x54639e27e546b972,
                                .femur = 0x01b75921c0f69d07,
                                .radial = 0x0f6ce2e536b911c1,
                                .tangential = 0xe7128fe3146bb73a,
                                .arcs = 0x4ec232458a0c8e7e,
                                .motions = 0x13a848a2169b6bf3});
}

}  // namespace
}  // namespace condyle::sample
