#include <Eigen/Cholesky>
#include <Eigen/SVD>

#include "sample/femur_shape.hpp"
#include "sample/hip_bone_shape.hpp"
#include "sample/made_hips.hpp"
#include "sample/projection.hpp"
#include "sample/section.hpp"
#include "support/test.hpp"

/// Clinical measures, measured on the meshes.

namespace condyle::sample {
namespace {

using test::made_hip;

double degrees(double radians) {
  return Angle::radians(radians).degrees();
}

double degrees_between(const Vec3& a, const Vec3& b) {
  return degrees(std::atan2(a.cross(b).norm(), a.dot(b)));
}

/// Hips that differ in everything that is measured below.
std::array<HipParameters, 4> different_hips() {
  std::array<HipParameters, 4> hips;
  struct Measures {
    double head_radius, space, neck_shaft, anteversion, inclination, version, centre_edge;
  };
  constexpr std::array<Measures, 4> measures = {{{24, 3.5, 127, 15, 50, 18, 33},
                                                 {20, 2.5, 115, 40, 42, 0, 20},
                                                 {28, 5.0, 140, -10, 58, 30, 42},
                                                 {24, 3.5, 115, -10, 50, 18, 25}}};
  for (std::size_t i = 0; i < hips.size(); ++i) {
    hips[i].head_radius_mm = measures[i].head_radius;
    // A neck in proportion.
    hips[i].neck_radius_mm *= measures[i].head_radius / HipParameters{}.head_radius_mm;
    hips[i].neck_length_mm *= measures[i].head_radius / HipParameters{}.head_radius_mm;
    hips[i].joint_space_mm = measures[i].space;
    hips[i].neck_shaft_angle = Angle::degrees(measures[i].neck_shaft);
    hips[i].femoral_anteversion = Angle::degrees(measures[i].anteversion);
    hips[i].acetabular_inclination = Angle::degrees(measures[i].inclination);
    hips[i].acetabular_version = Angle::degrees(measures[i].version);
    hips[i].lateral_centre_edge_angle = Angle::degrees(measures[i].centre_edge);
  }
  return hips;
}

TEST(SampleHipMeasures, HeadIsASphereOfTheGivenRadiusAboutTheOrigin) {
  for (const HipParameters& parameters : different_hips()) {
    const double radius = parameters.head_radius_mm;
    const auto& femur = made_hip(Scenario::three, parameters).femur;
    const Vec3 neck = sample::femur_axes(parameters).neck;
    int on_head = 0;
    for (std::size_t v = 0; v < femur.vertices.size(); ++v) {
      const Vec3 p = femur.vertices[v];
      if (p.dot(neck) > 0)
        continue;  // the side that looks into the socket, and the shaft's side is not there
      EXPECT_NEAR(p.norm(), radius, sample::laid_tolerance);
      ++on_head;
    }
    EXPECT_GT(on_head, 1000);
  }
}

/// Whether a vertex lies on the socket's sphere.
bool on_sphere(const Vec3& p, double radius) {
  return std::abs(p.norm() - radius) < 2 * sample::laid_tolerance;
}

TEST(SampleHipMeasures, SocketIsASphereWiderThanTheHeadByTheJointSpace) {
  for (const HipParameters& parameters : different_hips()) {
    const double space = parameters.joint_space_mm;
    const auto& bone = made_hip(Scenario::three, parameters).hip_bone;
    int on_socket = 0;
    for (std::size_t v = 0; v < bone.vertices.size(); ++v) {
      const Vec3 p = bone.vertices[v];
      EXPECT_GT(p.norm(), parameters.head_radius_mm + space - 2 * sample::laid_tolerance);
      on_socket += on_sphere(p, parameters.head_radius_mm + space);
    }
    EXPECT_GT(on_socket, 600);
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

TEST(SampleHipMeasures, NeckShaftAngleAndAnteversionMeasuredOnTheMeshAreThoseAskedFor) {
  for (const HipParameters& parameters : different_hips()) {
    const double neck_shaft = parameters.neck_shaft_angle.degrees();
    const double anteversion = parameters.femoral_anteversion.degrees();
    const TriMesh& femur = made_hip(Scenario::three, parameters).femur;
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

TEST(SampleHipMeasures, SocketOpensInTheDirectionAskedFor) {
  for (const HipParameters& parameters : different_hips()) {
    const double inclination = parameters.acetabular_inclination.degrees();
    const double version = parameters.acetabular_version.degrees();
    const TriMesh& bone = made_hip(Scenario::three, parameters).hip_bone;
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

TEST(SampleHipMeasures, LateralCentreEdgeAngleMeasuredInTheFrontalPlaneIsTheOneAskedFor) {
  for (const HipParameters& parameters : different_hips()) {
    const double asked = parameters.lateral_centre_edge_angle.degrees();
    const TriMesh& bone = made_hip(Scenario::three, parameters).hip_bone;
    const double radius = parameters.head_radius_mm + parameters.joint_space_mm;
    // As on a radiograph, the most lateral point of the roof. Its edge is rounded over a seam of 4 mm in a
    // socket of 27.5 mm: take the middle.
    const double half_seam = 2 * radius / 27.5;
    const double edge_radius = radius + half_seam;
    double most = 0;
    for (std::size_t t = 0; t < bone.triangles.size(); ++t) {
      // Both ends of the cut through the triangle; the section passes the edge's radius between them.
      std::vector<Vec3> ends;
      for (int k = 0; k < 3; ++k) {
        const Vec3 p = bone.corner(t, k), q = bone.corner(t, (k + 1) % 3);
        if ((p.x() < 0) != (q.x() < 0)) ends.push_back(p + p.x() / (p.x() - q.x()) * (q - p));
      }
      if (ends.size() != 2 || ends[0].y() < 0) continue;
      const double before = ends[0].norm() - edge_radius, after = ends[1].norm() - edge_radius;
      if ((before < 0) == (after < 0)) continue;
      const Vec3 at = ends[0] + before / (before - after) * (ends[1] - ends[0]);
      most = std::max(most, degrees(std::atan2(at.z(), at.y())));
    }
    EXPECT_NEAR(most, asked, 1) << asked;
  }
}

struct Leaving {
  double circle_radius;
  Angle alpha;
};

/// Noetzli's construction in the plane of the neck's axis and the cam's clock position: the circle that best
/// fits the contour of the head on the side away from the neck, and, following the contour from there towards
/// the neck, the first point that is more than `beyond` of the radius outside.
Leaving measured_alpha(const TriMesh& femur, const Vec3& neck, const Vec3& out, double beyond) {
  const Vec3 normal = neck.cross(out);
  struct Point {
    double along, across;
  };
  std::vector<Point> contour;
  for (std::size_t t = 0; t < femur.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = femur.corner(t, k), q = femur.corner(t, (k + 1) % 3);
      const double at_p = p.dot(normal), at_q = q.dot(normal);
      if (!(at_p < 0 && at_q >= 0)) continue;  // every edge once: its other triangle has it the other way
      const Vec3 at = p + at_p / (at_p - at_q) * (q - p);
      if (at.dot(out) > 0 && at.dot(neck) < 30) contour.push_back({at.dot(neck), at.dot(out)});
    }
  }
  constexpr double clear_of_neck = 5;  // mm behind the centre: past 100 degrees from the neck's axis
  // Kasa's fit: x^2 + y^2 = 2 a x + 2 b y + c, linear in the unknowns.
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  Vec3 right_side = Vec3::Zero();
  for (const auto& [x, y] : contour) {
    if (x > -clear_of_neck) continue;
    const Vec3 row(2 * x, 2 * y, 1);
    normal_matrix += row * row.transpose();
    right_side += (x * x + y * y) * row;
  }
  const Vec3 fit = normal_matrix.ldlt().solve(right_side);
  const double a = fit[0], b = fit[1], radius = std::sqrt(fit[2] + a * a + b * b);

  std::vector<std::pair<double, double>> polar;  // angle from the neck's axis, distance from the centre
  for (const auto& [x, y] : contour) polar.emplace_back(std::atan2(y - b, x - a), std::hypot(x - a, y - b));
  std::sort(polar.rbegin(), polar.rend());
  const double leaves = (1 + beyond) * radius;
  const auto first =
      std::find_if(polar.begin() + 1, polar.end(), [&](const auto& point) { return point.second > leaves; });
  if (first == polar.end()) return {radius, Angle()};
  const auto& [angle_before, before] = *(first - 1);
  const auto& [angle_after, after] = *first;
  const double part = (leaves - before) / (after - before);
  return {radius, Angle::radians(angle_before + part * (angle_after - angle_before))};
}

TEST(SampleHipMeasures, AlphaAngleMeasuredOnTheMeshIsTheOneAskedFor) {
  // Half a per cent of the radius, as stated with native_alpha_angle(). Triangles of scenario three, with
  // edges up to e = 2 mm on a head of r >= 20 mm, sag e^2 / (8 r) = 0.025 mm, a fifth of that.
  constexpr double beyond = 0.005;
  std::array<HipParameters, 4> hips = different_hips();
  const std::array<double, 4> asked_deg = {58, 68, 79, 90};
  for (std::size_t i = 0; i < hips.size(); ++i) {
    hips[i].alpha_angle = Angle::degrees(asked_deg[i]);
    const auto axes = sample::femur_axes(hips[i]);
    const TriMesh& femur = made_hip(Scenario::three, hips[i]).femur;
    const auto [radius, alpha] = measured_alpha(femur, axes.neck, sample::cam_direction(axes), beyond);
    EXPECT_NEAR(radius, hips[i].head_radius_mm, 0.025);
    EXPECT_NEAR(alpha.degrees(), asked_deg[i], 1);
  }
}

TEST(SampleHipMeasures, AnyFemurLeavesItsHeadAtTheAlphaAngleAskedForAndNotBefore) {
  std::mt19937 random(1);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  constexpr double step_deg = 0.05;
  for (int i = 0; i < 300; ++i) {
    HipParameters hip;
    hip.head_radius_mm = between(18, 32);
    hip.neck_radius_mm = between(8, 0.8 * hip.head_radius_mm);
    hip.neck_length_mm = between(40, 65);
    hip.neck_shaft_angle = Angle::degrees(between(110, 145));
    hip.femoral_anteversion = Angle::degrees(between(-15, 45));
    const double least = std::max(50.0, sample::native_alpha_angle(hip).degrees());
    const double asked_deg = i % 10 == 0 ? least : between(least, 90);
    hip.alpha_angle = Angle::degrees(asked_deg);
    const auto femur = sample::femur_shape(hip).field;
    const auto axes = sample::femur_axes(hip);
    double at_deg = 180;
    for (; at_deg > 0; at_deg -= step_deg) {
      const double at = Angle::degrees(at_deg).radians();
      const Vec3 towards = std::cos(at) * axes.neck + std::sin(at) * sample::cam_direction(axes);
      if (femur(1.005 * hip.head_radius_mm * towards).value <= 0) break;
    }
    EXPECT_NEAR(at_deg, asked_deg, 1.01 * step_deg);
  }
}

TEST(SampleHipMeasures, WithoutACamAlphaIsTheNativeOne) {
  for (const HipParameters& parameters : different_hips()) {
    const auto axes = sample::femur_axes(parameters);
    const TriMesh& femur = made_hip(Scenario::three, parameters).femur;
    const auto found = measured_alpha(femur, axes.neck, sample::cam_direction(axes), 0.005);
    EXPECT_NEAR(found.alpha.degrees(), sample::native_alpha_angle(parameters).degrees(), 1);
  }
}

TEST(SampleHipMeasures, ACamSitsMidwayBetweenSuperiorAndAnteriorAndLeavesTheRestAlone) {
  HipParameters with_cam;
  with_cam.alpha_angle = Angle::degrees(80);
  const auto without = sample::femur_shape({}).field, with = sample::femur_shape(with_cam).field;
  const auto axes = sample::femur_axes({});
  const Vec3 out = sample::cam_direction(axes);
  EXPECT_LT(std::abs(out.dot(axes.neck)), 1e-15);
  EXPECT_GT(out.x(), 0.5);
  EXPECT_GT(out.y(), 0.3);
  const TriMesh& plain = made_hip(Scenario::three).femur;
  double most = 0;
  Vec3 highest = Vec3::Zero();
  for (std::size_t v = 0; v < plain.vertices.size(); ++v) {
    const Vec3 p = plain.vertices[v];
    const double height = without(p).value - with(p).value;
    EXPECT_GE(height, -1e-12);
    if (height > most) most = height, highest = p;
    // Behind the neck, on the head's far side and from the trochanters down there is none.
    if (p.dot(out) < -6 || p.dot(axes.neck) < -2 || p.dot(axes.neck) > 45) {
      EXPECT_EQ(height, 0) << p.transpose();
    }
  }
  EXPECT_GT(most, 1.5);
  const Vec3 around = highest - highest.dot(axes.neck) * axes.neck;
  EXPECT_LT(degrees_between(around, out), 30);
}

}  // namespace
}  // namespace condyle::sample
