#include "condyle/angle.hpp"
#include "condyle/contact.hpp"
#include "condyle/radial.hpp"
#include "condyle/range_of_motion.hpp"
#include "condyle/sample/hip.hpp"
#include "oracle/cgal_oracle.hpp"
#include "simd/instruction_set.hpp"
#include "support/brute_force.hpp"
#include "support/test.hpp"

/// Whole answers on real joints against CGAL with exact predicates: equal as sets.

namespace condyle {
namespace {

using test::CgalOracle;

struct JointFiles {
  const char* name;
  const char* fixed;
  const char* mobile;
  double side;  // +1 right, -1 left
  friend void PrintTo(const JointFiles& joint, std::ostream* out) { *out << joint.name; }
};

/// Joints with files, and the sample, which needs none.
const JointFiles joints[] = {
    {"sample_1", nullptr, nullptr, 1},
    {"sample_2", nullptr, nullptr, 1},
    {"vhf", "hip_vhf_right/hip_bone.ply", "hip_vhf_right/femur.ply", 1},
    {"libhip", "hip_libhip_m1_left/hip_bone.ply", "hip_libhip_m1_left/femur.ply", -1},
    {"libhip_coarse", "hip_libhip_m1_left/coarse/hip_bone_2442.ply",
     "hip_libhip_m1_left/coarse/femur_1542.ply", -1},
    {"cartilage_gap", "hip_libhip_m1_left/acetabular_cartilage_gap.ply",
     "hip_libhip_m1_left/femur_cartilage_gap.ply", -1},
    {"cartilage_nogap", "hip_libhip_m1_left/acetabular_cartilage_nogap.ply",
     "hip_libhip_m1_left/femur_cartilage_nogap.ply", -1},
    {"cartilage_coarse", "hip_libhip_m1_left/coarse/acetabular_cartilage_2876.ply",
     "hip_libhip_m1_left/coarse/femur_cartilage_2824.ply", -1},
};

Pose turned(double flexion, double adduction, double rotation, double side,
            const Vec3& shift = Vec3::Zero()) {
  const auto about = [](double degrees, const Vec3& axis) {
    return Eigen::AngleAxisd(Angle::degrees(degrees).radians(), axis);
  };
  Pose X = Pose::Identity();
  X.linear() = (about(flexion, Vec3::UnitZ()) * about(adduction, side * Vec3::UnitX()) *
                about(rotation, side * Vec3::UnitY()))
                   .toRotationMatrix();
  X.translation() = shift;
  return X;
}

/// 52 poses: neutral, single and combined angles through the range of a hip and past it, steps of a hundredth
/// of a degree, and shifts that drive the bones into each other.
std::vector<Pose> poses(double side) {
  std::vector<Pose> out = {Pose::Identity()};
  for (const double flexion : {-30., -15., 0.01, 20., 45., 70., 90., 110., 130.})
    out.push_back(turned(flexion, 0, 0, side));
  for (const double adduction : {-60., -40., -20., 0.01, 15., 30., 45.})
    out.push_back(turned(0, adduction, 0, side));
  for (const double rotation : {-60., -30., 0.01, 30., 60.}) out.push_back(turned(0, 0, rotation, side));
  for (const double flexion : {60., 90., 120.}) {
    for (const double rotation : {-40., 0., 20., 40.}) {
      for (const double adduction : {-20., 15.}) out.push_back(turned(flexion, adduction, rotation, side));
    }
  }
  for (const Vec3& shift : {Vec3(0, 0.4, 0), Vec3(0, 2, 0), Vec3(1.5, 0, 0), Vec3(-3, 1, 0),
                            Vec3(0, 0, -4 * side), Vec3(2, 6, -3 * side)}) {
    out.push_back(turned(0, 0, 0, side, shift));
  }
  return out;
}

/// The meshes of one joint, read once for all tests of it.
struct LoadedJoint {
  TriMesh fixed, mobile;
};

/// Where surfaces just touch: a ten-thousandth of a degree before and after the end of each clinical motion.
std::vector<Pose> grazing_poses(const LoadedJoint& meshes, double side_sign) {
  const Side side = side_sign > 0 ? Side::right : Side::left;
  const Joint joint{"", JointKind::ball, side, {"", meshes.fixed}, {"", meshes.mobile}};
  const motion::RangeOfMotion range(joint,
                                    {.bearing = {.rule = motion::BearingRule::count},
                                     .overlap = {.reference_contact = motion::ReferenceContact::accept}});
  std::vector<Pose> poses;
  for (const motion::MotionLimit& limit : range.limits(motion::hip_motions())) {
    if (limit.end.reason != motion::LimitReason::contact) continue;
    for (const double past : {-1e-4, 1e-4}) {
      const double sense = limit.motion.sense == RotationSense::positive ? 1 : -1;
      poses.push_back(pose_at({.side = side}, motion::turned_by(limit.angles_at_limit(), limit.motion.vary,
                                                                Angle::degrees(sense * past))));
    }
  }
  return poses;
}

const LoadedJoint* load(const JointFiles& files) {
  static std::map<std::string, LoadedJoint> loaded;
  if (!files.fixed) {
    const auto [at, is_new] = loaded.try_emplace(files.name);
    if (is_new) {
      sample::SampleHip hip = sample::sample_hip(
          {}, std::string(files.name) == "sample_1" ? sample::Scenario::one : sample::Scenario::two);
      at->second = {std::move(hip.hip_bone), std::move(hip.femur)};
    }
    return &at->second;
  }
  const auto data = test::shared_data();
  if (!data) return nullptr;
  const auto [at, is_new] = loaded.try_emplace(files.name);
  if (is_new) at->second = {test::read_ply(*data / files.fixed), test::read_ply(*data / files.mobile)};
  return &at->second;
}

/// Parity is blind to how often a self-overlapping mesh is wound about a point; where the two differ,
/// rational arithmetic computes the winding number, and it must be one that parity cannot express.
void expect_same_states(const radial::RadialResults& ours, const std::vector<PointState>& oracle,
                        const TriMesh& mesh, PointsView points, std::size_t& overlapping) {
  ASSERT_EQ(ours.size(), oracle.size());
  for (std::size_t i = 0; i < oracle.size(); ++i) {
    if (ours.state[i] == oracle[i]) continue;
    const auto truth = test::winding_number(mesh, points[i]);
    EXPECT_FALSE(truth.on_surface);
    EXPECT_TRUE(truth.winding < 0 || truth.winding > 1)
        << "vertex " << i << " has winding number " << truth.winding;
    EXPECT_EQ(ours.winding[i], truth.winding);
    ++overlapping;
  }
}

/// The fast path finds the same points inside, as deep.
void expect_same_penetrations(const radial::RadialTable& table, const radial::SortedPoints& points,
                              const Pose& X, const radial::RadialResults& hits) {
  radial::Penetrations found;
  table.penetrations(points, X, found);
  const auto not_outside = std::count_if(hits.state.begin(), hits.state.end(),
                                         [](PointState state) { return state != PointState::outside; });
  ASSERT_EQ(static_cast<std::ptrdiff_t>(found.size()), not_outside);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Index p = found.point[i];
    EXPECT_EQ(found.state[i], hits.state[p]) << "vertex " << p;
    EXPECT_EQ(found.depth_mm[i], -hits.radial_gap_mm[p]) << "vertex " << p;
    EXPECT_EQ(found.triangle[i], hits.triangle[p]) << "vertex " << p;
  }
}

class ContactOfRealJoints : public testing::TestWithParam<JointFiles> {};
INSTANTIATE_TEST_SUITE_P(SharedData, ContactOfRealJoints, testing::ValuesIn(joints),
                         [](const auto& joint) { return joint.param.name; });

TEST_P(ContactOfRealJoints, VerticesInsideAndTrianglePairsAreThoseOfCgalInEveryPose) {
  const LoadedJoint* meshes = load(GetParam());
  if (!meshes) GTEST_SKIP() << "no shared data: set CONDYLE_DATA";
  const contact::JointContact joint(meshes->fixed, meshes->mobile);
  const CgalOracle fixed_oracle(meshes->fixed), mobile_oracle(meshes->mobile);
  const radial::SortedPoints fixed_points(meshes->fixed.vertices), mobile_points(meshes->mobile.vertices);
  const std::vector<simd::InstructionSet> sets = simd::instruction_sets();
  std::size_t free = 0, touching = 0, deep = 0, overlapping = 0, asked = 0;
  std::vector<Pose> all = poses(GetParam().side);
  for (const Pose& X : grazing_poses(*meshes, GetParam().side)) all.push_back(X);
  for (const Pose& X : all) {
    const TriMesh posed_mobile = posed(X, meshes->mobile);
    const Points fixed_in_M = posed(X.inverse(), meshes->fixed.vertices.view());
    const contact::RadialContact contact = joint.radial(X);
    ASSERT_TRUE(contact.mobile_in_fixed && contact.fixed_in_mobile);
    expect_same_states(*contact.mobile_in_fixed, fixed_oracle.states(posed_mobile.vertices), meshes->fixed,
                       posed_mobile.vertices, overlapping);
    expect_same_states(*contact.fixed_in_mobile, mobile_oracle.states(fixed_in_M), meshes->mobile, fixed_in_M,
                       overlapping);
    EXPECT_EQ(contact.pairs, fixed_oracle.pairs(posed_mobile));
    const simd::InstructionSetInUse in_use(sets[asked++ % sets.size()]);
    expect_same_penetrations(joint.fixed_table(), mobile_points, X, *contact.mobile_in_fixed);
    expect_same_penetrations(joint.mobile_table(), fixed_points, X.inverse(), *contact.fixed_in_mobile);
    EXPECT_EQ(joint.in_contact(X), contact.in_contact);
    const auto inside = std::count(contact.mobile_in_fixed->state.begin(),
                                   contact.mobile_in_fixed->state.end(), PointState::inside);
    (!contact.in_contact ? free : inside == 0 ? touching : deep)++;
  }
  std::printf(
      "%s: %zu poses free, %zu touching without a vertex inside, %zu deeper; %zu states beyond parity\n",
      GetParam().name, free, touching, deep, overlapping);
  EXPECT_GT(deep, 5u);
}

TEST_P(ContactOfRealJoints, TheTangentialMethodHasTheSameVerticesInsideAndPairs) {
  const LoadedJoint* meshes = load(GetParam());
  if (!meshes) GTEST_SKIP() << "no shared data: set CONDYLE_DATA";
  const contact::JointContact joint(meshes->fixed, meshes->mobile);
  const std::vector<Pose> all = poses(GetParam().side);
  for (std::size_t i = 0; i < all.size(); i += 7) {
    // About Z the axis frame of F only permutes coordinates: both methods see the same doubles, and CGAL has
    // judged those.
    const contact::TangentialContact tangential = joint.tangential(all[i], Vec3::UnitZ());
    const contact::RadialContact radial = joint.radial(all[i]);
    EXPECT_EQ(tangential.mobile_in_fixed->state, radial.mobile_in_fixed->state) << "pose " << i;
    EXPECT_EQ(tangential.pairs, radial.pairs) << "pose " << i;
  }
}

/// The exit of each vertex inside, again: every triangle, in long double, by the plane's equation and
/// three volumes.
double depth_by_all_triangles(const TriMesh& mesh, const Vec3& v) {
  using Long3 = Eigen::Matrix<long double, 3, 1>;
  const Long3 ray = v.cast<long double>();
  long double before = -std::numeric_limits<long double>::infinity(), after = -before;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Long3 a = mesh.corner(t, 0).cast<long double>(), b = mesh.corner(t, 1).cast<long double>(),
                c = mesh.corner(t, 2).cast<long double>();
    const long double ab = ray.dot(a.cross(b)), bc = ray.dot(b.cross(c)), ca = ray.dot(c.cross(a));
    if (!((ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0))) continue;
    const Long3 normal = (b - a).cross(c - a);
    const long double way = a.dot(normal) / ray.dot(normal);
    if (way > 0 && way < 1) before = std::max(before, way);
    if (way > 1) after = std::min(after, way);
  }
  return static_cast<double>(std::min(1 - before, after - 1) * ray.norm());
}

TEST_P(ContactOfRealJoints, DepthsAreThoseOfAnIndependentRay) {
  const LoadedJoint* meshes = load(GetParam());
  if (!meshes) GTEST_SKIP() << "no shared data: set CONDYLE_DATA";
  const radial::RadialTable fixed(meshes->fixed);
  std::size_t compared = 0;
  for (const Pose& X : {turned(120, 10, 30, GetParam().side), turned(-30, 0, -40, GetParam().side)}) {
    const Points points = posed(X, meshes->mobile.vertices.view());
    const radial::RadialResults hits = fixed.query(points);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      // Several boundary crossings or overlaps are counted by winding number; the plain scan knows one.
      if (hits.state[i] != PointState::inside || hits.winding[i] != 1 || compared > 400) continue;
      const double expected = depth_by_all_triangles(meshes->fixed, points[i]);
      EXPECT_NEAR(-hits.radial_gap_mm[i], expected, 1e-9 * points[i].norm()) << "vertex " << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 0u);
}

TEST_P(ContactOfRealJoints, BothMapsGiveTheSameBytesInEveryPose) {
  const LoadedJoint* meshes = load(GetParam());
  if (!meshes) GTEST_SKIP() << "no shared data: set CONDYLE_DATA";
  const contact::JointContact cube(meshes->fixed, meshes->mobile, {radial::DirectionMapKind::cube, 64});
  const contact::JointContact cartesian(meshes->fixed, meshes->mobile,
                                        {radial::DirectionMapKind::cartesian, 64});
  for (const double flexion : {0., 60., 120.}) {
    const Pose X = turned(flexion, 10, 20, GetParam().side);
    const contact::RadialContact a = cube.radial(X), b = cartesian.radial(X);
    EXPECT_EQ(a.mobile_in_fixed, b.mobile_in_fixed);
    EXPECT_EQ(a.fixed_in_mobile, b.fixed_in_mobile);
    EXPECT_EQ(a.pairs, b.pairs);
  }
}

/// The neutral-pose tables in the READMEs of the shared hips. Where surfaces touch (nogap), the README's 2616
/// pairs were counted before coordinates were rounded to the file's float32; for the file as it is, rational
/// arithmetic over all 21428 pairs whose boxes meet says 2612, and so does CGAL.
struct NeutralRow {
  const char* moving;
  const char* fixed;
  std::size_t pairs;
  long inside;
  double min_distance_mm;
};

const NeutralRow neutral_rows[] = {
    {"hip_vhf_right/femur", "hip_vhf_right/hip_bone", 0, 0, 0.3818},
    {"hip_libhip_m1_left/femur", "hip_libhip_m1_left/hip_bone", 0, 0, 1.5178},
    {"hip_libhip_m1_left/femur_cartilage_gap", "hip_libhip_m1_left/acetabular_cartilage_gap", 0, 0, 0.1186},
    {"hip_libhip_m1_left/femur_cartilage_nogap", "hip_libhip_m1_left/acetabular_cartilage_nogap", 2612, 331,
     0.0},
    {"hip_libhip_m1_left/femur_cartilage_gap", "hip_libhip_m1_left/hip_bone", 0, 0, 0.4172},
    {"hip_libhip_m1_left/femur", "hip_libhip_m1_left/acetabular_cartilage_gap", 0, 0, 0.1517},
    {"hip_libhip_m1_left/acetabular_cartilage_gap", "hip_libhip_m1_left/hip_bone", 825, 685, 0.0003},
    {"hip_libhip_m1_left/femur_cartilage_gap", "hip_libhip_m1_left/femur", 1438, 832, 0.0002},
    {"hip_libhip_m1_left/coarse/femur_1542", "hip_libhip_m1_left/coarse/hip_bone_2442", 0, 0, 1.4324},
    {"hip_libhip_m1_left/coarse/femur_cartilage_2824", "hip_libhip_m1_left/coarse/acetabular_cartilage_2876",
     0, 0, 0.1037},
};

TEST(ContactOfRealHips, IsInTheNeutralPoseThatOfThePublishedTables) {
  FOUND_OR_SKIP(data, test::shared_data());
  for (const auto& row : neutral_rows) {
    SCOPED_TRACE(row.moving);
    const TriMesh fixed = test::read_ply(*data / (std::string(row.fixed) + ".ply"));
    const TriMesh moving = test::read_ply(*data / (std::string(row.moving) + ".ply"));
    const contact::RadialContact contact = contact::JointContact(fixed, moving).radial(Pose::Identity());
    EXPECT_EQ(contact.pairs.size(), row.pairs);
    const auto& hits = *contact.mobile_in_fixed;
    EXPECT_EQ(std::count(hits.state.begin(), hits.state.end(), PointState::inside), row.inside);
    // The table's distances are rounded to 1e-4 mm; no gap along a ray is shorter than the distance.
    EXPECT_NEAR(CgalOracle(fixed).min_distance(moving.vertices), row.min_distance_mm, 0.5e-4 + 1e-9);
    if (row.pairs == 0) {
      const double min_gap = *std::min_element(hits.radial_gap_mm.begin(), hits.radial_gap_mm.end());
      EXPECT_GE(min_gap, row.min_distance_mm - 0.5e-4);
    }
  }
}

}  // namespace
}  // namespace condyle
