#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "condyle/brush.hpp"
#include "condyle/contact.hpp"
#include "condyle/io/label_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/pressure.hpp"
#include "condyle/range_of_motion.hpp"
#include "mesh/surface_distance.hpp"
#include "motion/rom/overlap.hpp"

/// The part of a body that carries load: a run of its vertices from `first_vertex`, as a mesh of its own.
struct PageSurface {
  std::size_t first_vertex = 0;
  std::optional<condyle::Mesh> mesh = {};
  std::optional<condyle::contact::ElasticLayer> layer = {};
};

/// Layers that carry load, and what the last pose showed of them.
struct PagePressure {
  PageSurface fixed = {}, mobile = {};
  std::optional<condyle::contact::ElasticContact> contact = {};
  condyle::Pose results_at = condyle::Pose::Identity();
  std::optional<condyle::contact::ElasticContactResults> results = {};
};

/// A file that was dropped.
struct PageFile {
  std::string name;
  condyle::io::FileDigest digest;
};

/// Evidence and input of a proposed joint.
struct PageProposal {
  std::vector<std::string> inferred;
  std::vector<condyle::JointNote> notes = {};
  std::vector<condyle::io::LabelNote> of_images = {};  ///< of bones of label maps
  PageFile fixed = {}, mobile = {};
  std::string fixed_name = {},
              mobile_name =
                  {};  ///< of the bodies: their files' or their labels', which say what tissue a mesh is of
};

/// Bones that are brushed, and the joint about another centre.
struct PageEdit {
  std::optional<condyle::plan::Brush> fixed = {}, mobile = {};
  std::shared_ptr<const condyle::motion::RangeOfMotion> about = {};
  condyle::Vec3 centre_mm = condyle::Vec3::Zero();
};

/// Parts that turn, and the joint as it was described with them.
struct PageParts {
  condyle::PosedParts described = {};
  std::optional<condyle::Joint> as_described = {};
  condyle::motion::BearingOptions bearing = {};
};

/// A joint of the page, and what its last answers left.
struct CondyleJoint {
  condyle::Joint joint;
  condyle::contact::JointContact bodies;
  condyle::motion::BearingOptions bearing = {};
  std::shared_ptr<const condyle::motion::RangeOfMotion> range = {};
  condyle::Vec3 range_held_at = condyle::Vec3::Zero();
  condyle::radial::Penetrations penetrations = {};
  std::vector<std::uint32_t> pair_triangles = {};
  std::vector<double> intervals = {};
  std::optional<condyle::mesh::SurfaceDistance> to_fixed = {}, to_mobile = {};
  std::optional<condyle::motion::PartsOfJoint> counted = {};  ///< parts whose contact ends motions
  PagePressure pressure = {};
  PageEdit edit = {};
  PageParts parts = {};
  PageProposal proposal = {};  ///< empty if the joint was given
  std::string description = {};
};

/// The fixed body, or the mobile one.
template <class Joint>
auto& body_of(Joint& joint, bool is_fixed) {
  return is_fixed ? joint.joint.fixed : joint.joint.mobile;
}

/// Points as x, y and z each.
condyle::Points points_of(const double* xyz, std::size_t count);
void put_points(const condyle::Points& points, double* xyz);

/// Three angles, in degrees.
condyle::JointAngles angles_of(const double* deg);

/// Pose from 16 numbers, row by row.
condyle::Pose pose_of(const double* rows);

/// Made ready for rotations of a body that keeps this translation, in F: at the first call and whenever it is another one.
const condyle::motion::RangeOfMotion& range_of(CondyleJoint& joint,
                                               const condyle::Vec3& held_mm = condyle::Vec3::Zero());

/// How far an angle, numbered in the joint's order, turns from a start.
struct PageMotion {
  int vary;
  bool is_positive;
  const double* start_deg;
  double range_deg;
};
/// The eight numbers of condyle_limit(); points of the range's own frame lie at `origin`.
void put_limit(const condyle::motion::RangeOfMotion& range, const PageMotion& motion,
               const condyle::Vec3& origin, double limit[8]);

/// The line that condyle_error() gives.
std::string& last_error();

/// Result of `answer`, or `failed` with the error's line kept.
template <class Result, class Answer>
Result guarded(Result failed, const Answer& answer) {
  try {
    return answer();
  } catch (const std::exception& error) {
    last_error() = error.what();
  }
  return failed;
}
