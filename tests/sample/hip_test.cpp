#include "condyle/sample/hip.hpp"

#include "core/thread_limit.hpp"
#include "sample/femur_shape.hpp"
#include "sample/hip_bone_shape.hpp"
#include "sample/made_hips.hpp"
#include "sample/projection.hpp"
#include "sample/self_intersection.hpp"
#include "sample/topology.hpp"
#include "support/brute_force.hpp"
#include "support/test.hpp"

namespace condyle::sample {
namespace {

using test::made_hip;
using test::topology;

constexpr Scenario hip_scenarios[] = {Scenario::one, Scenario::two, Scenario::three, Scenario::four};

TEST(SampleHip, HasTheCountsOfThePapersTable1) {
  const std::size_t femur_vertices[] = {773, 3086, 12338, 49346},
                    femur_triangles[] = {1542, 6168, 24672, 98688};
  const std::size_t bone_vertices[] = {1221, 4884, 19536, 78144},
                    bone_triangles[] = {2442, 9768, 39072, 156288};
  for (int i = 0; i < 4; ++i) {
    const SampleHip& hip = made_hip(hip_scenarios[i]);
    EXPECT_EQ(hip.femur.vertices.size(), femur_vertices[i]);
    EXPECT_EQ(hip.femur.triangles.size(), femur_triangles[i]);
    EXPECT_EQ(hip.hip_bone.vertices.size(), bone_vertices[i]);
    EXPECT_EQ(hip.hip_bone.triangles.size(), bone_triangles[i]);
  }
}

TEST(SampleHip, IsClosedManifoldAndWoundOutwardsWithOneHoleInTheHipBone) {
  for (const Scenario scenario : hip_scenarios) {
    test::expect_sound(made_hip(scenario).femur, 0);
    test::expect_sound(made_hip(scenario).hip_bone, 1);
  }
}

TEST(SampleHip, DoesNotRunIntoItself) {
  for (const Scenario scenario : hip_scenarios) {
    EXPECT_FALSE(sample::first_self_intersection(made_hip(scenario).femur));
    EXPECT_FALSE(sample::first_self_intersection(made_hip(scenario).hip_bone));
  }
}

TEST(SampleHip, VerticesLieOnTheSolidsTheyWereMadeFrom) {
  const auto femur = sample::femur_shape({}).field, hip_bone = sample::hip_bone_shape({}).field;
  const auto worst = [](const Field& field, const TriMesh& mesh) {
    double most = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      most = std::max(most, std::abs(field(mesh.vertices[v]).value));
    }
    return most;
  };
  // laid_on leaves a distance of at most laid_tolerance / 4 by the local slope, and no field is steeper than
  // two.
  for (const Scenario scenario : hip_scenarios) {
    EXPECT_LT(worst(femur, made_hip(scenario).femur), sample::laid_tolerance);
    EXPECT_LT(worst(hip_bone, made_hip(scenario).hip_bone), sample::laid_tolerance);
  }
}

TEST(SampleHip, FinerScenariosKeepTheVerticesOfCoarserOnes) {
  for (int i = 0; i + 1 < 4; ++i) {
    const auto& coarse = made_hip(hip_scenarios[i]).hip_bone.vertices;
    const auto& fine = made_hip(hip_scenarios[i + 1]).hip_bone.vertices;
    for (std::size_t v = 0; v < coarse.size(); ++v) EXPECT_EQ(coarse[v], fine[v]);
  }
}

TEST(SampleHip, TrianglesAreNoSlivers) {
  // Remeshing avoids angles below 30 degrees; laying midpoints on a sharp lip takes some of that away again.
  constexpr double least_deg = 20;
  for (const Scenario scenario : hip_scenarios) {
    EXPECT_GT(test::smallest_angles_deg(made_hip(scenario).femur).front(), least_deg);
    EXPECT_GT(test::smallest_angles_deg(made_hip(scenario).hip_bone).front(), least_deg);
  }
}

TEST(SampleHip, SameParametersGiveTheSameBytesOnAnyNumberOfThreads) {
  // Holds the vertices of the coarser ones: see above.
  const SampleHip& made = made_hip(Scenario::three);
  const SampleHip again = sample_hip({}, Scenario::three);
  const core::ThreadLimit one_thread(1);
  const SampleHip alone = sample_hip({}, Scenario::three);
  for (const SampleHip* other : {&again, &alone}) {
    EXPECT_EQ(other->femur, made.femur);
    EXPECT_EQ(other->hip_bone, made.hip_bone);
  }
}

TEST(SampleHip, AnyEvenCountAndAnyEdgeLengthCanBeAskedFor) {
  for (const auto& [bone, femur] : {std::pair{1600, 600}, {5000, 3332}, {10002, 12346}}) {
    const TriangleCounts counts = {static_cast<std::size_t>(bone), static_cast<std::size_t>(femur)};
    const SampleHip hip = sample_hip({}, counts);
    EXPECT_EQ(hip.hip_bone.triangles.size(), counts.hip_bone);
    EXPECT_EQ(hip.femur.triangles.size(), counts.femur);
    test::expect_sound(hip.hip_bone, 1);
    test::expect_sound(hip.femur, 0);
  }
  const TriMesh femur = sample_hip({}, EdgeLength{4}).femur;
  double sum = 0, count = 0;
  for (std::size_t t = 0; t < femur.triangles.size(); ++t) {
    const double length = (femur.corner(t, 0) - femur.corner(t, 1)).norm();
    if (femur.corner(t, 0).norm() < 50) continue;  // finer near the joint
    sum += length, ++count;
  }
  EXPECT_GT(count, 300);
  EXPECT_NEAR(sum / count, 4, 0.4);
}

TEST(SampleHip, AnteversionTurnsTheWholeFemurAboutItsShaft) {
  HipParameters turned;
  turned.femoral_anteversion = Angle::degrees(40);
  const auto before = sample::femur_shape({}).field, after = sample::femur_shape(turned).field;
  const Vec3 distal = sample::femur_axes({}).distal;
  const Angle by = turned.femoral_anteversion - HipParameters{}.femoral_anteversion;
  const Eigen::AngleAxisd turn(by.radians(), distal);
  const TriMesh& femur = made_hip(Scenario::one).femur;
  double most = 0;
  for (std::size_t v = 0; v < femur.vertices.size(); ++v) {
    for (const double reach : {0.9, 1.0, 1.1}) {
      const Vec3 p = reach * femur.vertices[v];
      most = std::max(most, std::abs(after(turn * p).value - before(p).value));
    }
  }
  // A turned point is rounded to within some ulp of 200 mm, about 1e-13.
  EXPECT_LT(most, 1e-11);
}

/// The smallest value of the other bone's field at the vertices of each bone, the femur turned by the
/// clinical angles.
double least_clearance(double flexion_deg, double adduction_deg, double rotation_deg) {
  const auto femur = sample::femur_shape({}).field, hip_bone = sample::hip_bone_shape({}).field;
  const SampleHip& hip = made_hip(Scenario::two);
  const auto turn = [](double deg, const Vec3& axis) {
    return Eigen::AngleAxisd(Angle::degrees(deg).radians(), axis);
  };
  Pose X_FM = Pose::Identity();
  X_FM.linear() = (turn(flexion_deg, Vec3::UnitZ()) * turn(adduction_deg, Vec3::UnitX()) *
                   turn(rotation_deg, Vec3::UnitY()))
                      .toRotationMatrix();
  const Pose X_MF = X_FM.inverse();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < hip.femur.vertices.size(); ++v) {
    least = std::min(least, hip_bone(posed(X_FM, hip.femur.vertices[v])).value);
  }
  for (std::size_t v = 0; v < hip.hip_bone.vertices.size(); ++v) {
    least = std::min(least, femur(posed(X_MF, hip.hip_bone.vertices[v])).value);
  }
  return least;
}

using Corners = std::array<Vec3, 3>;

Corners corners(const TriMesh& mesh, std::size_t t) {
  return {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
}

bool overlap(const Corners& s, const Corners& t) {
  const auto low = [](const Corners& c) { return Vec3(c[0].cwiseMin(c[1]).cwiseMin(c[2])); };
  const auto high = [](const Corners& c) { return Vec3(c[0].cwiseMax(c[1]).cwiseMax(c[2])); };
  return (low(s).array() <= high(t).array()).all() && (low(t).array() <= high(s).array()).all();
}

TEST(SampleHip, IsFreeInTheNeutralPoseWithTheJointSpaceAsItsSmallestGap) {
  // By the fields the gap between the smooth solids, which is smallest in the joint.
  EXPECT_NEAR(least_clearance(0, 0, 0), HipParameters{}.joint_space_mm, 2 * sample::laid_tolerance);
  const SampleHip& hip = made_hip(Scenario::one);
  // Exactly, between the flat triangles: only pairs whose boxes overlap can meet.
  int boxes_overlap = 0;
  for (std::size_t i = 0; i < hip.femur.triangles.size(); ++i) {
    const Corners s = corners(hip.femur, i);
    for (std::size_t j = 0; j < hip.hip_bone.triangles.size(); ++j) {
      const Corners t = corners(hip.hip_bone, j);
      if (!overlap(s, t)) continue;
      ++boxes_overlap;
      EXPECT_FALSE(test::triangles_intersect(s, t)) << i << " " << j;
    }
  }
  EXPECT_GT(boxes_overlap, 0);
}

TEST(SampleHip, MovesThroughTheRangeOfEverydayLifeAndImpingesBeyond) {
  EXPECT_GT(least_clearance(90, 0, 0), 0);
  EXPECT_LT(least_clearance(150, 0, 0), 0);
  EXPECT_GT(least_clearance(-15, 0, 0), 0);
  EXPECT_GT(least_clearance(0, -40, 0), 0);
  EXPECT_LT(least_clearance(0, -80, 0), 0);
  EXPECT_GT(least_clearance(0, 20, 0), 0);
  EXPECT_GT(least_clearance(90, 0, 20), 0);
  EXPECT_LT(least_clearance(90, 0, 70), 0);
}

TEST(SampleHip, EveryParameterWorksAtBothEndsOfItsRangeAndIsNamedBeyond) {
  struct Case {
    std::string name;
    double low, high;
    std::function<void(HipParameters&, double)> set;
  };
  const auto length = [](double HipParameters::*member) {
    return [member](HipParameters& hip, double value) { hip.*member = value; };
  };
  const auto angle = [](Angle HipParameters::*member) {
    return [member](HipParameters& hip, double value) { hip.*member = Angle::degrees(value); };
  };
  const Case cases[] = {
      {"head_radius_mm", 18, 32, length(&HipParameters::head_radius_mm)},
      {"joint_space_mm", 2, 6, length(&HipParameters::joint_space_mm)},
      {"neck_shaft_angle", 110, 145, angle(&HipParameters::neck_shaft_angle)},
      {"femoral_anteversion", -15, 45, angle(&HipParameters::femoral_anteversion)},
      {"neck_radius_mm", 8, 0.8 * 24, length(&HipParameters::neck_radius_mm)},
      {"neck_length_mm", 40, 65, length(&HipParameters::neck_length_mm)},
      {"shaft_length_mm", 60, 250, length(&HipParameters::shaft_length_mm)},
      {"alpha_angle", sample::native_alpha_angle({}).degrees(), 90,
       [](HipParameters& hip, double value) { hip.alpha_angle = Angle::degrees(value); }},
      {"acetabular_inclination", 35, 65, angle(&HipParameters::acetabular_inclination)},
      {"acetabular_version", -10, 35, angle(&HipParameters::acetabular_version)},
      {"lateral_centre_edge_angle", 15, 45, angle(&HipParameters::lateral_centre_edge_angle)},
  };
  for (const auto& [name, low, high, set] : cases) {
    // The native angle comes back rounded from degrees.
    const double least = name == "alpha_angle" ? low + 1e-9 : low;
    for (const double value : {least, high}) {
      HipParameters parameters;
      set(parameters, value);
      EXPECT_NO_THROW({
        const SampleHip hip = sample_hip(parameters, Scenario::one);
        EXPECT_GT(test::smallest_angles_deg(hip.femur).front(), 15) << name << " " << value;
        EXPECT_GT(test::smallest_angles_deg(hip.hip_bone).front(), 15) << name << " " << value;
      }) << name
         << " " << value;
    }
    for (const double value : {low - 0.01, high + 0.01, std::nan("")}) {
      HipParameters parameters;
      set(parameters, value);
      try {
        sample_hip(parameters, Scenario::one);
        ADD_FAILURE() << name << " = " << value << " was accepted";
      } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
      }
    }
  }
}

TEST(SampleHip, CountsThatNoMeshCanHaveAreRefused) {
  EXPECT_THROW(sample_hip({}, TriangleCounts{2443, 1542}), UsageError);
  EXPECT_THROW(sample_hip({}, TriangleCounts{2442, 100}), UsageError);
  EXPECT_THROW(sample_hip({}, TriangleCounts{2442, 1u << 30}), UsageError);
  EXPECT_THROW(sample_hip({}, EdgeLength{0}), UsageError);
  EXPECT_THROW(sample_hip({}, EdgeLength{50}), UsageError);
}

TEST(SampleHip, LeftHipIsTheMirrorImage) {
  const SampleHip& right = made_hip(Scenario::one);
  const SampleHip left = mirrored(right);
  test::expect_sound(left.femur, 0);
  test::expect_sound(left.hip_bone, 1);
  for (std::size_t v = 0; v < left.femur.vertices.size(); ++v) {
    EXPECT_EQ(left.femur.vertices[v], Vec3(1, 1, -1).cwiseProduct(right.femur.vertices[v]));
  }
  EXPECT_EQ(mirrored(left).femur, right.femur);
}

}  // namespace
}  // namespace condyle::sample
