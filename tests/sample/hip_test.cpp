#include "condyle/sample/hip.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "condyle/core/error.hpp"
#include "condyle/sample/femur_shape.hpp"
#include "condyle/sample/hip_bone_shape.hpp"
#include "condyle/sample/projection.hpp"
#include "condyle/sample/self_intersection.hpp"
#include "sample/section.hpp"
#include "sample/topology.hpp"
#include "support/brute_force.hpp"

namespace condyle {
namespace {

using test::topology;

constexpr Scenario scenarios[] = {Scenario::one, Scenario::two, Scenario::three, Scenario::four};

/// The default hip, made once per scenario.
const SampleHip& hip_at(Scenario scenario) {
  static std::map<Scenario, SampleHip> made;
  const auto found = made.find(scenario);
  return found != made.end() ? found->second : made.emplace(scenario, sample_hip({}, scenario)).first->second;
}

double degrees(double radians) {
  return Angle::radians(radians).degrees();
}

double degrees_between(const Vec3& a, const Vec3& b) {
  return degrees(std::atan2(a.cross(b).norm(), a.dot(b)));
}

void expect_sound(const TriMesh& mesh, int genus) {
  const auto found = topology(mesh);
  EXPECT_TRUE(found.is_closed_and_consistent);
  EXPECT_TRUE(found.has_manifold_vertices);
  EXPECT_EQ(found.components, 1);
  EXPECT_EQ(found.genus, genus);
  EXPECT_GT(found.signed_volume, 0);
}

TEST(SampleHip, HasTheCountsOfThePapersTable1) {
  const std::size_t femur_vertices[] = {773, 3086, 12338, 49346},
                    femur_triangles[] = {1542, 6168, 24672, 98688};
  const std::size_t bone_vertices[] = {1221, 4884, 19536, 78144},
                    bone_triangles[] = {2442, 9768, 39072, 156288};
  for (int i = 0; i < 4; ++i) {
    const SampleHip& hip = hip_at(scenarios[i]);
    EXPECT_EQ(hip.femur.vertices.size(), femur_vertices[i]);
    EXPECT_EQ(hip.femur.triangles.size(), femur_triangles[i]);
    EXPECT_EQ(hip.hip_bone.vertices.size(), bone_vertices[i]);
    EXPECT_EQ(hip.hip_bone.triangles.size(), bone_triangles[i]);
  }
}

TEST(SampleHip, IsClosedManifoldAndWoundOutwardsWithOneHoleInTheHipBone) {
  for (const Scenario scenario : scenarios) {
    expect_sound(hip_at(scenario).femur, 0);
    expect_sound(hip_at(scenario).hip_bone, 1);
  }
}

TEST(SampleHip, DoesNotRunIntoItself) {
  for (const Scenario scenario : scenarios) {
    EXPECT_FALSE(sample::first_self_intersection(hip_at(scenario).femur));
    EXPECT_FALSE(sample::first_self_intersection(hip_at(scenario).hip_bone));
  }
}

TEST(SampleHip, VerticesLieOnTheSolidsTheyWereMadeFrom) {
  const auto femur = sample::femur_shape({}).field, hip_bone = sample::hip_bone_shape({}).field;
  const auto worst = [](const sample::Field& field, const TriMesh& mesh) {
    double most = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      most = std::max(most, std::abs(field(mesh.vertices[v]).value));
    }
    return most;
  };
  // laid_on leaves a distance of at most laid_tolerance / 4 by the local slope, and no field is steeper than
  // two.
  for (const Scenario scenario : scenarios) {
    EXPECT_LT(worst(femur, hip_at(scenario).femur), sample::laid_tolerance);
    EXPECT_LT(worst(hip_bone, hip_at(scenario).hip_bone), sample::laid_tolerance);
  }
}

TEST(SampleHip, FinerScenariosKeepTheVerticesOfCoarserOnes) {
  for (int i = 0; i + 1 < 4; ++i) {
    const auto& coarse = hip_at(scenarios[i]).hip_bone.vertices;
    const auto& fine = hip_at(scenarios[i + 1]).hip_bone.vertices;
    for (std::size_t v = 0; v < coarse.size(); ++v) EXPECT_EQ(coarse[v], fine[v]);
  }
}

TEST(SampleHip, TrianglesAreNoSlivers) {
  // Subdivision keeps the shape of flat triangles; only where midpoints leave a sharp ridge do angles shrink.
  const double least_deg[] = {25, 15, 12, 10};
  for (int i = 0; i < 4; ++i) {
    EXPECT_GT(test::smallest_angles_deg(hip_at(scenarios[i]).femur).front(), least_deg[i]);
    EXPECT_GT(test::smallest_angles_deg(hip_at(scenarios[i]).hip_bone).front(), least_deg[i]);
  }
}

TEST(SampleHip, SameParametersGiveTheSameBytesOnAnyNumberOfThreads) {
  for (const Scenario scenario : {Scenario::one, Scenario::three}) {
    const SampleHip again = sample_hip({}, scenario);
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const SampleHip alone = sample_hip({}, scenario);
    for (const SampleHip& other : {again, alone}) {
      EXPECT_EQ(other.femur, hip_at(scenario).femur);
      EXPECT_EQ(other.hip_bone, hip_at(scenario).hip_bone);
    }
  }
}

TEST(SampleHip, AnyEvenCountAndAnyEdgeLengthCanBeAskedFor) {
  for (const auto& [bone, femur] : {std::pair{1600, 600}, {5000, 3332}, {10002, 12346}}) {
    const TriangleCounts counts = {static_cast<std::size_t>(bone), static_cast<std::size_t>(femur)};
    const SampleHip hip = sample_hip({}, counts);
    EXPECT_EQ(hip.hip_bone.triangles.size(), counts.hip_bone);
    EXPECT_EQ(hip.femur.triangles.size(), counts.femur);
    expect_sound(hip.hip_bone, 1);
    expect_sound(hip.femur, 0);
  }
  const TriMesh femur = sample_hip({}, EdgeLength{4}).femur;
  double sum = 0, count = 0;
  for (std::size_t t = 0; t < femur.triangles.size(); ++t) {
    const double length = (femur.corner(t, 0) - femur.corner(t, 1)).norm();
    if (femur.corner(t, 0).norm() < 50) continue;  // finer near the joint
    sum += length, ++count;
  }
  EXPECT_NEAR(sum / count, 4, 0.4);
}

TEST(SampleHip, HeadIsASphereOfTheGivenRadiusAboutTheOrigin) {
  for (const double radius : {20.0, 28.0}) {
    HipParameters parameters;
    parameters.head_radius_mm = radius;
    const auto& femur = sample_hip(parameters, Scenario::one).femur;
    const Vec3 neck = sample::femur_axes(parameters).neck;
    int on_head = 0;
    for (std::size_t v = 0; v < femur.vertices.size(); ++v) {
      const Vec3 p = femur.vertices[v];
      if (p.dot(neck) > 0)
        continue;  // the side that looks into the socket, and the shaft's side is not there
      EXPECT_NEAR(p.norm(), radius, sample::laid_tolerance);
      ++on_head;
    }
    EXPECT_GT(on_head, 100);
  }
}

/// Whether a vertex lies on the socket's sphere.
bool on_sphere(const Vec3& p, double radius) {
  return std::abs(p.norm() - radius) < 2 * sample::laid_tolerance;
}

TEST(SampleHip, SocketIsASphereWiderThanTheHeadByTheJointSpace) {
  for (const double space : {2.5, 5.0}) {
    HipParameters parameters;
    parameters.joint_space_mm = space;
    const auto& bone = sample_hip(parameters, Scenario::one).hip_bone;
    int on_socket = 0;
    for (std::size_t v = 0; v < bone.vertices.size(); ++v) {
      const Vec3 p = bone.vertices[v];
      EXPECT_GT(p.norm(), parameters.head_radius_mm + space - 2 * sample::laid_tolerance);
      on_socket += on_sphere(p, parameters.head_radius_mm + space);
    }
    EXPECT_GT(on_socket, 60);
  }
}

/// The neck's axis as a surgeon templates it: from the head's centre to the middle of the narrowest section.
Vec3 measured_neck(const TriMesh& femur, const Vec3& roughly, double head_radius) {
  test::SectionLoop narrowest = {std::numeric_limits<double>::infinity(), Vec3::Zero()};
  for (double at = 0.9; at < 1.4; at += 0.05) {
    const auto loop = test::section_near(femur, roughly, at * head_radius * roughly);
    if (loop.area < narrowest.area) narrowest = loop;
  }
  return narrowest.centroid.normalized();
}

TEST(SampleHip, NeckShaftAngleAndAnteversionMeasuredOnTheMeshAreThoseAskedFor) {
  for (const auto& [neck_shaft, anteversion] :
       {std::pair{127.0, 15.0}, {115.0, 40.0}, {140.0, -10.0}, {115.0, -10.0}}) {
    HipParameters parameters;
    parameters.neck_shaft_angle = Angle::degrees(neck_shaft);
    parameters.femoral_anteversion = Angle::degrees(anteversion);
    const TriMesh femur = sample_hip(parameters, Scenario::two).femur;
    const auto axes = sample::femur_axes(parameters);
    const auto shaft_at = [&](double below_foot) {
      return test::section_near(femur, axes.distal, axes.foot + below_foot * axes.distal).centroid;
    };
    const Vec3 distal = (shaft_at(85) - shaft_at(60)).normalized();
    const Vec3 neck = measured_neck(femur, axes.neck, parameters.head_radius_mm);
    EXPECT_NEAR(180 - degrees_between(neck, distal), neck_shaft, 1) << anteversion;
    // Seen along the shaft: `neck` leads away from the head, so backwards where the head lies forward.
    const Vec3 right = Vec3(0, distal.z(), -distal.y()).normalized();
    EXPECT_NEAR(degrees(std::atan2(-neck.x(), neck.dot(right))), anteversion, 1) << neck_shaft;
  }
}

TEST(SampleHip, SocketOpensInTheDirectionAskedFor) {
  for (const auto& [inclination, version] : {std::pair{50.0, 18.0}, {42.0, 0.0}, {58.0, 30.0}}) {
    HipParameters parameters;
    parameters.acetabular_inclination = Angle::degrees(inclination);
    parameters.acetabular_version = Angle::degrees(version);
    const TriMesh bone = sample_hip(parameters, Scenario::three).hip_bone;
    const double radius = parameters.head_radius_mm + parameters.joint_space_mm;
    // The border of the spherical part is a circle but for the notch below: fit the plane of its upper half.
    const Vec3 asked = sample::socket_of(parameters).opening;
    const Vec3 up = Vec3::UnitY() - asked.y() * asked;
    std::vector<Vec3> border;
    for (const auto& t : bone.triangles) {
      const bool is_whole =
          std::all_of(t.begin(), t.end(), [&](Index v) { return on_sphere(bone.vertices[v], radius); });
      for (const Index v : t) {
        const Vec3 p = bone.vertices[v];
        if (!is_whole && on_sphere(p, radius) && p.dot(up) > 0) border.push_back(p);
      }
    }
    ASSERT_GT(border.size(), 30u);
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : border) mean += p / static_cast<double>(border.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vec3& p : border) spread += (p - mean) * (p - mean).transpose();
    Vec3 opening = Eigen::JacobiSVD<Eigen::Matrix3d>(spread, Eigen::ComputeFullU).matrixU().col(2);
    if (opening.z() < 0) opening = -opening;
    EXPECT_NEAR(degrees_between(opening, Vec3(0, -1, 0)), inclination, 1) << version;
    EXPECT_NEAR(degrees(std::atan2(opening.x(), opening.z())), version, 1) << inclination;
  }
}

TEST(SampleHip, LateralCentreEdgeAngleMeasuredInTheFrontalPlaneIsTheOneAskedFor) {
  for (const double asked : {20.0, 33.0, 42.0}) {
    HipParameters parameters;
    parameters.lateral_centre_edge_angle = Angle::degrees(asked);
    const TriMesh bone = sample_hip(parameters, Scenario::three).hip_bone;
    const double radius = parameters.head_radius_mm + parameters.joint_space_mm;
    // As on a radiograph, the most lateral point of the roof. Its edge is rounded over a seam of 4 mm: take
    // the middle.
    constexpr double half_seam = 2;
    double most = 0;
    for (const auto& t : bone.triangles) {
      for (int k = 0; k < 3; ++k) {
        const Vec3 p = bone.vertices[t[k]], q = bone.vertices[t[(k + 1) % 3]];
        if ((p.x() < 0) == (q.x() < 0)) continue;
        const Vec3 at = p + p.x() / (p.x() - q.x()) * (q - p);
        if (at.y() > 0 && at.norm() < radius + half_seam)
          most = std::max(most, degrees(std::atan2(at.z(), at.y())));
      }
    }
    EXPECT_NEAR(most, asked, 1) << asked;
  }
}

/// The smallest value of the other bone's field at the vertices of each bone, the femur turned by the
/// clinical angles.
double least_clearance(double flexion_deg, double adduction_deg, double rotation_deg) {
  const auto femur = sample::femur_shape({}).field, hip_bone = sample::hip_bone_shape({}).field;
  const SampleHip& hip = hip_at(Scenario::two);
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
  const SampleHip& hip = hip_at(Scenario::one);
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
      {"acetabular_inclination", 35, 65, angle(&HipParameters::acetabular_inclination)},
      {"acetabular_version", -10, 35, angle(&HipParameters::acetabular_version)},
      {"lateral_centre_edge_angle", 15, 45, angle(&HipParameters::lateral_centre_edge_angle)},
  };
  for (const auto& [name, low, high, set] : cases) {
    // Just inside, as degrees come back rounded.
    for (const double value : {low + 1e-9, high - 1e-9}) {
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
  const SampleHip& right = hip_at(Scenario::one);
  const SampleHip left = mirrored(right);
  expect_sound(left.femur, 0);
  expect_sound(left.hip_bone, 1);
  for (std::size_t v = 0; v < left.femur.vertices.size(); ++v) {
    EXPECT_EQ(left.femur.vertices[v], Vec3(1, 1, -1).cwiseProduct(right.femur.vertices[v]));
  }
  EXPECT_EQ(mirrored(left).femur, right.femur);
}

}  // namespace
}  // namespace condyle
