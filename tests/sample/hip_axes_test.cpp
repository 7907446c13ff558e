#include "kinematics/hip_axes.hpp"

#include "condyle/sample/hip.hpp"
#include "support/test.hpp"

/// Axes and sides of sample hips and real ones, whole and cut, in all axes in use and turned out of them.

namespace condyle::test {
namespace {

struct Bones {
  TriMesh hip_bone, femur;
};

TriMesh moved(TriMesh mesh, const Eigen::Matrix3d& R) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.vertices.set(v, R * mesh.vertices[v]);
  return mesh;
}

/// The triangles within this ball about the hip's centre and above this height: open where it is cut.
TriMesh cut(const TriMesh& mesh, double radius, double lowest) {
  TriMesh kept{mesh.vertices, {}};
  const auto inside = [&](Index v) {
    const Vec3 p = mesh.vertices[v];
    return p.norm() < radius && p.y() > lowest;
  };
  for (const Triangle& t : mesh.triangles)
    if (inside(t[0]) && inside(t[1]) && inside(t[2])) kept.triangles.push_back(t);
  return kept;
}

/// The part of the bones that is present; lengths in mm.
struct Cut {
  const char* name;
  double hip_bone, femur, lowest;
};
constexpr double whole = 1e3;
const Cut cuts[] = {{"whole", whole, whole, -whole},
                    {"femur cut 60 mm down", whole, whole, -60},
                    {"head and neck", whole, 45, -whole},
                    {"hip bone round the socket", 50, whole, -whole},
                    {"both", 60, whole, -60}};

Bones cut(const Bones& bones, const Cut& to) {
  return {cut(bones.hip_bone, to.hip_bone, -whole), cut(bones.femur, to.femur, to.lowest)};
}

Bones mirrored(const Bones& bones) {
  return {condyle::sample::mirrored(bones.hip_bone), condyle::sample::mirrored(bones.femur)};
}

/// From the joint axes to those of the meshes.
Eigen::Matrix3d to_mesh_axes(const FrameDirections& axes) {
  Eigen::Matrix3d R;
  R << axes.anterior, axes.superior, axes.anterior.cross(axes.superior);
  return R;
}

const FrameDirections all_axes[] = {ras_axes, lps_axes, {}};

/// A hip as a scan may give it: the truth.
struct Scan {
  Side side;
  FrameDirections axes;
  Eigen::Matrix3d tilt = Eigen::Matrix3d::Identity();
};

enum class Verdict { none, right, wrong };

/// `right_hip` is a right one in joint axes.
Verdict judged(const Bones& right_hip, const Scan& scan, const std::optional<Side>& given = {}) {
  const Bones bones = scan.side == Side::right ? right_hip : mirrored(right_hip);
  const Eigen::Matrix3d R = to_mesh_axes(scan.axes) * scan.tilt;
  const TriMesh hip_bone = moved(bones.hip_bone, R);
  const auto hip = kinematics::hip_anatomy(hip_bone, moved(bones.femur, R));
  if (!hip) return Verdict::none;
  const auto found = kinematics::hip_axes(hip_bone, *hip, given).agreeing;
  if (found.size() != 1) return Verdict::none;
  const FrameDirections& axes = found[0].axes->directions;
  return found[0].side == scan.side && axes.anterior == scan.axes.anterior &&
                 axes.superior == scan.axes.superior
             ? Verdict::right
             : Verdict::wrong;
}

/// Uniform in [0, 1), the same everywhere.
double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

Eigen::Matrix3d turned(std::mt19937_64& random, double most_deg) {
  Vec3 axis;
  do axis = Vec3(uniform(random), uniform(random), uniform(random)) * 2 - Vec3::Ones();
  while (!(axis.norm() > 0.1 && axis.norm() < 1));
  return Eigen::AngleAxisd(most_deg * uniform(random) * std::numbers::pi / 180, axis.normalized())
      .toRotationMatrix();
}

/// An average one, made once: it takes a second.
const Bones& sample_bones() {
  static const Bones bones = [] {
    sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::one);
    return Bones{std::move(hip.hip_bone), std::move(hip.femur)};
  }();
  return bones;
}

struct Counts {
  int right = 0, wrong = 0, all = 0;
};

/// Each cut on both sides, in some of the axes, tilted by up to 30 degrees, the femur turned by up to 15.
Counts tilted(const Bones& right_hip, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Counts counts;
  for (const Cut& to : cuts) {
    Bones bones = cut(right_hip, to);
    bones.femur = moved(bones.femur, turned(random, 15));
    for (const Side side : {Side::right, Side::left}) {
      const FrameDirections& axes = all_axes[random() % 3];
      const Verdict verdict = judged(bones, {side, axes, turned(random, 30)});
      ++counts.all;
      counts.right += verdict == Verdict::right;
      counts.wrong += verdict == Verdict::wrong;
    }
  }
  return counts;
}

void expect_inferred_with_short_femurs(const Bones& hip) {
  for (const Cut& to : {cuts[1], cuts[2]})
    for (const Side side : {Side::right, Side::left})
      EXPECT_EQ(judged(cut(hip, to), {side, lps_axes}), Verdict::right) << to.name;
}

TEST(HipAxesOfSamples, AreInferredWithShortFemurs) {
  expect_inferred_with_short_femurs(sample_bones());
}

TEST(HipAxesOfSamples, AreInferredInAllAxesInUse) {
  for (const FrameDirections& axes : all_axes)
    for (const Side side : {Side::right, Side::left})
      EXPECT_EQ(judged(sample_bones(), {side, axes}), Verdict::right);
}

TEST(HipAxesOfSamples, RoundTheSocketOnlyNeedTheSide) {
  const Bones hip = cut(sample_bones(), cuts[3]);
  EXPECT_EQ(judged(hip, {Side::left, lps_axes}, Side::left), Verdict::right);
}

TEST(HipAxesOfSamples, AreNeverWrongInTiltedScans) {
  const Counts counts = tilted(sample_bones(), 1);
  EXPECT_EQ(counts.wrong, 0);
  EXPECT_GE(2 * counts.right, counts.all);
}

/// Axes that are not in use: x forwards, y to the left, z up, and y up with x to the right.
TEST(HipAxesOfSamples, AreNotInferredInOtherAxes) {
  const FrameDirections others[] = {{Vec3::UnitX(), Vec3::UnitZ()}, {-Vec3::UnitZ(), Vec3::UnitY()}};
  for (const Cut& to : cuts)
    for (const FrameDirections& axes : others)
      for (const Side side : {Side::right, Side::left})
        EXPECT_EQ(judged(cut(sample_bones(), to), {side, axes}), Verdict::none) << to.name;
}

struct Real {
  const char *hip_bone, *femur;
  Side side;
  friend void PrintTo(const Real& real, std::ostream* out) { *out << real.hip_bone; }
};

class HipAxesOfReal : public testing::TestWithParam<Real> {
 protected:
  void SetUp() override {
    FOUND_OR_SKIP(data, shared_data());
    hip_ = {read_ply(*data / GetParam().hip_bone), read_ply(*data / GetParam().femur)};
    if (GetParam().side == Side::left) hip_ = mirrored(hip_);
  }
  Bones hip_;
};
INSTANTIATE_TEST_SUITE_P(SharedData, HipAxesOfReal,
                         testing::Values(Real{"hip_vhf_right/hip_bone.ply", "hip_vhf_right/femur.ply",
                                              Side::right},
                                         Real{"hip_libhip_m1_left/coarse/hip_bone_2442.ply",
                                              "hip_libhip_m1_left/coarse/femur_1542.ply", Side::left},
                                         Real{"hip_gait2392_lowres_dirty/pelvis_r.ply",
                                              "hip_gait2392_lowres_dirty/femur_r.ply", Side::right}));

TEST_P(HipAxesOfReal, AreInferredWithShortFemurs) {
  expect_inferred_with_short_femurs(hip_);
}

TEST_P(HipAxesOfReal, AreNeverWrongInTiltedScans) {
  const Counts counts = tilted(hip_, 1);
  EXPECT_EQ(counts.wrong, 0);
  EXPECT_GE(2 * counts.right, counts.all);
}

}  // namespace
}  // namespace condyle::test
