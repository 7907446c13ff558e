#include "condyle/make_joint.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "condyle/error.hpp"
#include "core/composed.hpp"
#include "core/coordinate_range.hpp"
#include "core/extended.hpp"
#include "core/formatted.hpp"
#include "core/lower_case.hpp"
#include "core/rounded.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/body_pieces.hpp"
#include "kinematics/cut_parts.hpp"
#include "kinematics/femoral_axes.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_parts.hpp"
#include "kinematics/posed_parts.hpp"
#include "kinematics/resampling.hpp"
#include "kinematics/surface_points.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle {
namespace {

using core::formatted;

/// Two meshes that contradict each other cannot both be in the unit described.
void check_units(const Body& fixed, const LikelyUnit& of_fixed, const Body& mobile,
                 const LikelyUnit& of_mobile) {
  if (of_fixed.unit && of_mobile.unit && *of_fixed.unit != *of_mobile.unit)
    throw UsageError("units: " + fixed.name + " looks like " + std::string(plural_of(*of_fixed.unit)) +
                     " and " + mobile.name + " like " + std::string(plural_of(*of_mobile.unit)) +
                     ": give both in one unit");
}

/// X_AW X_WB in extended precision, row by row without the last one.
std::array<core::Extended, 12> wide_product(const Pose& X_AW, const Pose& X_WB) {
  const auto element = [&](int i, int k) {
    const auto product = [&](int j) { return core::Extended(X_AW(i, j)) * core::Extended(X_WB(j, k)); };
    return (product(0) + product(1)) + (product(2) + product(3));
  };
  return {element(0, 0), element(0, 1), element(0, 2), element(0, 3), element(1, 0), element(1, 1),
          element(1, 2), element(1, 3), element(2, 0), element(2, 1), element(2, 2), element(2, 3)};
}

/// X_AW X_WB * (scale p) in extended precision, rounded once per coordinate; untouched where nothing is to be done.
Mesh placed(const Pose& X_AW, const Pose& X_WB, double scale, const Body& body) {
  using core::Extended;
  const std::array<Extended, 12> m = wide_product(X_AW, X_WB);
  if (scale == 1 && m == wide_product(Pose::Identity(), Pose::Identity())) return body.mesh;
  Points points = body.mesh.vertices();
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Extended x = Extended(scale) * Extended(points.x[v]);
    const Extended y = Extended(scale) * Extended(points.y[v]);
    const Extended z = Extended(scale) * Extended(points.z[v]);
    const auto row = [&](std::size_t i) {
      return static_cast<double>(m[4 * i] * x + m[4 * i + 1] * y + m[4 * i + 2] * z + m[4 * i + 3]);
    };
    const Vec3 p(row(0), row(1), row(2));
    if (!(p.cwiseAbs().maxCoeff() <= core::largest_coordinate))
      throw UsageError(body.name + ": vertex " + std::to_string(v) +
                       ": coordinates too large for millimetres");
    points.set(v, p);
  }
  return body.mesh.moved_to(std::move(points));
}

/// The image of a body in the frame A: its lengths are mm already.
std::optional<BodyImage> placed_image(const Pose& X_AB, const std::optional<BodyImage>& image) {
  if (!image) return std::nullopt;
  BodyImage placed{X_AB.linear() * image->voxel, {}, image->notes};
  for (const ImageCut& cut : image->cuts) {
    const Vec3 normal = X_AB.linear() * cut.normal;
    placed.cuts.push_back({normal, cut.offset_mm + normal.dot(X_AB.translation())});
  }
  return placed;
}

std::optional<Sphere> placed_head(const Pose& X_AB, const std::optional<Sphere>& head) {
  if (!head) return std::nullopt;
  return Sphere{posed(X_AB, head->centre), head->radius};
}

/// The axes about a centre, from directions or landmarks.
Pose frame_about(const Vec3& centre, const JointDescription& description) {
  struct Frames {
    const Vec3& centre;
    Side side;
    Pose operator()(const FrameDirections& d) const {
      return frame_from_axes(centre, d.anterior, d.superior);
    }
    Pose operator()(const PelvisLandmarks& l) const { return frame_from_landmarks(centre, l); }
    Pose operator()(const AnteriorPelvicPlane& l) const { return frame_from_landmarks(centre, l); }
    Pose operator()(const FemurLandmarks& l) const { return frame_from_landmarks(centre, side, l); }
    Pose operator()(const TransepicondylarAxis& l) const { return frame_from_landmarks(side, l); }
  };
  try {
    return std::visit(Frames{centre, description.side}, description.frame.axes);
  } catch (const UsageError& error) {
    throw UsageError(std::string("frame: ") + error.what());
  }
}

/// Takes one direction into another less than half a turn away, as Eigen's FromTwoVectors does: that one's singular value
/// decomposition for opposite directions takes a compiler six seconds.
Eigen::Matrix3d smallest_rotation(const Vec3& from, const Vec3& to) {
  const Vec3 a = from.normalized(), b = to.normalized();
  const double s = std::sqrt((1 + b.dot(a)) * 2);
  const Vec3 v = a.cross(b) * (1 / s);
  return Eigen::Quaterniond(s * 0.5, v.x(), v.y(), v.z()).toRotationMatrix();
}

/// Rotates the frame by the smallest rotation that lays its Z axis along the fitted cylinder's, in the nearer
/// sense.
Pose rotated_to_axis(const Pose& X_WF, const Vec3& fitted, JointPlacement& placement) {
  constexpr double largest_turn_deg = 45;  // beyond it the fit is not of the joint that the axes describe
  const Vec3 z = X_WF.linear().col(2);
  const Vec3 axis = z.dot(fitted) < 0 ? Vec3(-fitted) : fitted;
  placement.axis_rotation = Angle::radians(core::arctangent(z.cross(axis).norm(), z.dot(axis)));
  if (placement.axis_rotation.degrees() > largest_turn_deg)
    throw MeshError(
        formatted("frame.centre: the fitted axis is %.1f degrees from right = anterior x superior; more than "
                  "%g is not taken for the same axis (limit the fit with fit_within)",
                  placement.axis_rotation.degrees(), largest_turn_deg));
  Pose rotated = X_WF;
  rotated.linear() = smallest_rotation(z, axis) * X_WF.linear();
  return rotated;
}

/// Placing a mesh rounds its vertices by half a unit in the last place of what it moves them by: refused above a nanometre, where
/// contact would no longer be that of the meshes given.
void check_rounding(const JointDescription& description, const Pose& X_WF) {
  constexpr double largest_rounding_mm = 1e-6;
  for (const Pose* pose : {&X_WF, &description.fixed_in_W, &description.mobile_in_W}) {
    const double far = pose->translation().cwiseAbs().maxCoeff();
    const double rounding = far * std::numeric_limits<double>::epsilon() / 2;
    if (!(rounding <= largest_rounding_mm))
      throw UsageError(formatted("%s: at %.3g mm it rounds the vertices by %.1g mm, more than %g",
                                 pose == &X_WF ? "frame.centre" : "pose of a body", far, rounding,
                                 largest_rounding_mm));
  }
}

/// A fit may fail because the units are wrong: then no bone has the size that the mesh has in mm.
std::string size_hint(const TriMesh& mesh_in_mm, const Person& of) {
  if (!of.is_human() || likely_unit(mesh_in_mm).unit == LengthUnit::millimetres) return "";
  return formatted("; in the units stated it is %.4g mm across, and no human bone is: are the units right?",
                   mesh::bounds_of_surface(mesh_in_mm).diagonal());
}

/// Where a fit looks for a sphere, and for a cylinder elsewhere.
bool has_head(const JointDescription& description) noexcept {
  const bool head = description.anatomy == Anatomy::hip || description.anatomy == Anatomy::shoulder;
  return description.kind == JointKind::ball || (description.kind == JointKind::free && head);
}

/// The sphere of one body of a hip that belongs to the other: not another patch of it, nor the other of both sockets of a pelvis. Where the bodies
/// show no hip, the fullest.
SphericalPatch sphere_of_hip(const CentreFit& fit, const Mesh& fitted, const Mesh& other) {
  constexpr std::size_t resamples = kinematics::usual_resamples;
  const Mesh &of_fitted = mesh::outer_surface(fitted), &of_other = mesh::outer_surface(other);
  if (fit.body == BodyRole::mobile) {
    if (auto head = kinematics::head_in_socket(of_other, of_fitted, resamples, !of_fitted.is_closed()))
      return *std::move(head);
  } else if (const auto head = kinematics::head_in_socket(of_fitted, of_other)) {
    const Sphere& sphere = head->fit.sphere;
    const TriMesh near = kinematics::pieces_about(fitted, sphere);
    if (auto socket = kinematics::find_sphere_where(
            near, {.part = SphericalPart::socket, .resamples = resamples}, [&](const SphericalPatch& patch) {
              return (patch.fit.sphere.centre - sphere.centre).norm() < sphere.radius / 2;
            }))
      return *std::move(socket);
    const auto about = kinematics::sphere_around(near, sphere, resamples);
    if (about && kinematics::fits_into(sphere, *about)) return *about;
  }
  return find_sphere(fitted,
                     {.part = fit.body == BodyRole::fixed ? SphericalPart::socket : SphericalPart::head,
                      .resamples = resamples});
}

Pose fitted_frame(const JointDescription& description, const CentreFit& fit, const Body& fixed,
                  const Body& mobile, JointPlacement& placement) {
  placement.fitted_body = fit.body;
  const bool is_fixed = fit.body == BodyRole::fixed;
  const Body &body = is_fixed ? fixed : mobile, &other = is_fixed ? mobile : fixed;
  const Pose &X_WB = is_fixed ? description.fixed_in_W : description.mobile_in_W,
             &X_WO = is_fixed ? description.mobile_in_W : description.fixed_in_W;
  const Mesh mesh = placed(Pose::Identity(), X_WB, mm_per(description.units), body);
  try {
    if (has_head(description) && body.head) {
      placement.sphere =
          kinematics::stated_patch(mesh, {posed(X_WB, body.head->centre), body.head->radius},
                                   fit.body == BodyRole::fixed ? SphericalPart::socket : SphericalPart::head);
    } else if (has_head(description)) {
      SphereSearch search;
      search.part = fit.body == BodyRole::fixed ? SphericalPart::socket : SphericalPart::head;
      search.within = fit.within;
      search.resamples = kinematics::usual_resamples;
      placement.sphere =
          description.anatomy == Anatomy::hip && !fit.within
              ? sphere_of_hip(fit, mesh, placed(Pose::Identity(), X_WO, mm_per(description.units), other))
              : find_sphere(mesh, search);
    } else {
      placement.cylinder = find_cylinder(mesh, {.within = fit.within});
    }
  } catch (const MeshError& error) {
    throw MeshError("frame.centre: " + body.name + ": " + error.what() + size_hint(mesh, description.person));
  }
  if (placement.sphere) return frame_about(placement.sphere->fit.sphere.centre, description);
  const Cylinder& cylinder = placement.cylinder->cylinder;
  return rotated_to_axis(frame_about(cylinder.point, description), cylinder.direction, placement);
}

Pose frame_of(const JointDescription& description, const Body& fixed, const Body& mobile,
              JointPlacement& placement) {
  const FrameDescription& frame = description.frame;
  if (const auto* directions = std::get_if<FrameDirections>(&frame.axes))
    placement.axis_errors = axis_errors(directions->anterior, directions->superior);
  if (const auto* fit = std::get_if<CentreFit>(&frame.centre))
    return fitted_frame(description, *fit, fixed, mobile, placement);
  const auto* centre = std::get_if<Vec3>(&frame.centre);
  return frame_about(centre ? *centre : Vec3(Vec3::Zero()), description);
}

std::vector<std::string> processing_of(const JointPlacement& placement) {
  std::vector<std::string> notes;
  if (const AxisErrors& errors = placement.axis_errors; !errors.none())
    notes.push_back(
        formatted("axes made orthonormal: lengths were off by %.1e and %.1e, the right angle by %.1e",
                  errors.anterior_length, errors.superior_length, errors.right_angle));
  if (const JointAngles& pose = placement.reference_pose.angles;
      placement.zero_from == ZeroFrom::landmarks || placement.zero_from == ZeroFrom::anatomy)
    notes.push_back(std::string(placement.zero_from == ZeroFrom::landmarks
                                    ? "the landmarks of both bodies give"
                                    : "the condyles of the femur give") +
                    " the reference pose: flexion " + core::rounded(pose.flexion.degrees(), 2) +
                    ", adduction " + core::rounded(pose.adduction.degrees(), 2) + ", internal rotation " +
                    core::rounded(pose.internal_rotation.degrees(), 2) + " degrees");
  if (placement.sphere) {
    const SphereFit& fit = placement.sphere->fit;
    const auto& bound = placement.sphere->centre_bound_mm;  // only a fit has one
    std::string text = formatted(
        "%s: sphere of radius %.3f mm over %zu vertices, %.0f %% of the sphere, rms residual %.3f mm, "
        "largest %.3f mm",
        bound ? "centre fitted" : "centre of the sphere that is stated", fit.sphere.radius,
        fit.vertices.size(), 100 * placement.sphere->coverage, fit.rms_residual, fit.largest_residual);
    if (bound) text += formatted("; centre within %.2f mm by resampling", *bound);
    notes.push_back(std::move(text));
  }
  if (placement.cylinder) {
    const CylinderFit& fit = *placement.cylinder;
    notes.push_back(
        formatted("axis fitted: cylinder of radius %.3f mm over %zu vertices, %.0f %% of a turn, rms "
                  "residual %.3f mm, largest %.3f mm; direction within %.2f degrees and axis within %.2f mm "
                  "by resampling; axes rotated by %.2f degrees to it",
                  fit.cylinder.radius, fit.vertices.size(), 100 * fit.coverage, fit.rms_residual,
                  fit.largest_residual, fit.direction_bound.value_or(Angle()).degrees(),
                  fit.axis_bound_mm.value_or(0), placement.axis_rotation.degrees()));
  }
  return notes;
}

/// Angles at which the femur of a hip lies in the pose of its mesh, by its condyles.
JointAngles angles_by_condyles(const JointDescription& description, const Pose& X_FW, const Body& mobile,
                               const JointPlacement& placement) {
  if (description.anatomy != Anatomy::hip || description.kind == JointKind::hinge)
    throw UsageError("reference_pose: anatomy gives that of a hip only");
  if (description.reference_pose.angles != JointAngles{})
    throw UsageError("reference_pose: angles follow from the anatomy: leave them out");
  const Mesh femur = placed(X_FW, description.mobile_in_W, mm_per(description.units), mobile);
  if (mobile.head)
    kinematics::keep_head(femur, *placed_head(core::composed(X_FW, description.mobile_in_W), mobile.head));
  else if (placement.sphere && placement.fitted_body == BodyRole::mobile)
    kinematics::keep_head(femur, placement.sphere->fit.vertices);
  const std::optional<Eigen::Matrix3d>& axes = kinematics::femoral_axes(femur);
  if (!axes)
    throw MeshError("reference_pose: " + mobile.name +
                    " shows no condyles: its anatomy does not say how it lies");
  Pose X_FN = Pose::Identity();
  X_FN.linear() = *axes;
  return angles_at(description.coordinates(), X_FN);
}

/// X_MW at zero angles, and the reference pose that goes with it.
Pose mobile_frame(const JointDescription& description, const Pose& X_FW, const Body& mobile,
                  JointPlacement& placement) {
  if (!description.frame.mobile_axes) {
    placement.reference_pose = description.reference_pose;
    placement.zero_from = description.zero_from;
    if (description.zero_from == ZeroFrom::anatomy)
      placement.reference_pose.angles = angles_by_condyles(description, X_FW, mobile, placement);
    else if (description.reference_pose.angles != JointAngles{})
      placement.zero_from = ZeroFrom::stated;
    return core::composed(
        inverted(pose_at(description.coordinates(), placement.reference_pose, description.translation_frame)),
        X_FW);
  }
  if (description.kind == JointKind::hinge)
    throw UsageError("frame: a hinge takes the landmarks of one body");
  if (description.anatomy != Anatomy::hip)
    throw UsageError("frame: landmarks of pelvis and femur are those of a hip");
  if (description.reference_pose != JointCoordinates{} || description.zero_from == ZeroFrom::anatomy)
    throw UsageError("reference_pose: follows from the landmarks of both bodies: leave it out");
  try {
    const Pose X_WM =
        frame_from_landmarks(placement.X_WF.translation(), description.side, *description.frame.mobile_axes);
    placement.reference_pose.angles = angles_at(description.coordinates(), core::composed(X_FW, X_WM));
    placement.zero_from = ZeroFrom::landmarks;
    return inverted(X_WM);
  } catch (const UsageError& error) {
    throw UsageError(std::string("frame: ") + error.what());
  }
}

/// The parts described, in the frames of their bodies.
std::vector<PosedPart> placed_parts(const JointDescription& description, const Pose& X_FW, const Pose& X_MW) {
  std::vector<PosedPart> parts;
  for (const auto& [described, centre_in_W] : description.parts) {
    PosedPart part = described;
    const Pose& X_BW = part.body == BodyRole::fixed ? X_FW : X_MW;
    part.centre = centre_in_W ? posed(X_BW, *centre_in_W) : Vec3::Zero();
    for (CutPlane& plane : part.cut) plane = {posed(X_BW, plane.point), X_BW.linear() * plane.normal};
    for (PartParameter& parameter : part.parameters) parameter.described = parameter.value;
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Ascending numbers of vertices of a mesh after it was cut.
std::vector<Index> numbers_after(const std::vector<Index>& vertex_before,
                                 const std::vector<Index>& vertices) {
  if (vertex_before.empty()) return vertices;
  std::vector<Index> after;
  for (std::size_t v = 0; v < vertex_before.size(); ++v)
    if (std::binary_search(vertices.begin(), vertices.end(), vertex_before[v]))
      after.push_back(static_cast<Index>(v));
  return after;
}

/// A ligament in the frames of its bodies, its slack length resolved.
Ligament placed_ligament(const DescribedLigament& described, const JointDescription& description,
                         const Pose& X_FB, const Pose& X_MB, const JointPlacement& placement,
                         const std::optional<Sphere>& head) {
  Ligament ligament = described.ligament;
  const auto refuse = [&](const std::string& what) {
    throw UsageError("ligament " + ligament.name + ": " + what);
  };
  for (Vec3& point : ligament.fixed) point = posed(X_FB, point);
  for (Vec3& point : ligament.mobile) point = posed(X_MB, point);
  if (described.wraps_head) {
    if (head)
      ligament.wrap = LigamentWrap{.centre = head->centre, .radius_mm = head->radius};
    else if (placement.sphere && placement.fitted_body == BodyRole::mobile)
      ligament.wrap = LigamentWrap{.radius_mm = placement.sphere->fit.sphere.radius};
    else
      refuse("wrap: no head is known here: fit the centre, or give the sphere");
  } else if (ligament.wrap) {
    const Pose& X = ligament.wrap->body == BodyRole::fixed ? X_FB : X_MB;
    ligament.wrap->centre = posed(X, ligament.wrap->centre);
    ligament.wrap->axis = (X.linear() * ligament.wrap->axis).normalized();
    ligament.wrap->axes = X.linear() * ligament.wrap->axes;
    if (ligament.wrap->shape == WrapShape::ellipsoid && ligament.ends_at_strain)
      refuse("over an ellipsoid it cannot end motions: lengths on one are not computed");
  }
  const auto length_at = [&](const JointCoordinates& at) {
    const Pose X_FM = pose_at(description.coordinates(), at, description.translation_frame);
    const auto state = ligament_state(ligament, X_FM);
    if (!state)
      refuse(ligament.wrap->shape == WrapShape::ellipsoid
                 ? "it meets its ellipsoid, on which lengths are not computed"
                 : "an end of the part that crosses the joint lies inside its wrap");
    return state->length_mm;
  };
  if (described.taut_at) {
    JointCoordinates taut = placement.reference_pose;
    taut.angles = *described.taut_at;
    ligament.slack_length_mm = length_at(taut);
  } else if (described.slack_share) {
    ligament.slack_length_mm = *described.slack_share * length_at(placement.reference_pose);
  }
  if (!(ligament.slack_length_mm > 0)) refuse("its slack length must be above 0");
  if (!ligament.ends_at_strain) return ligament;
  if (const double strain = length_at(placement.reference_pose) / ligament.slack_length_mm - 1;
      strain > *ligament.ends_at_strain)
    refuse(formatted("its strain is %.4g in the reference pose already, more than the %g that it ends at",
                     strain, *ligament.ends_at_strain));
  return ligament;
}

}  // namespace

bool Person::is_human() const {
  const std::string name = core::lower_case(species);
  return name.empty() || name == "human" || name == "homo sapiens";
}

PlacedJoint make_joint(const JointDescription& description, Body fixed, Body mobile) {
  JointPlacement placement{};
  placement.fixed.likely_unit = likely_unit(fixed.mesh);
  placement.mobile.likely_unit = likely_unit(mobile.mesh);
  if (description.person.is_human())
    check_units(fixed, placement.fixed.likely_unit, mobile, placement.mobile.likely_unit);
  placement.X_WF = frame_of(description, fixed, mobile, placement);
  check_rounding(description, placement.X_WF);

  const Pose X_FW = inverted(placement.X_WF);
  const Pose X_MW = mobile_frame(description, X_FW, mobile, placement);
  const double scale = mm_per(description.units);
  fixed.mesh = placed(X_FW, description.fixed_in_W, scale, fixed);
  mobile.mesh = placed(X_MW, description.mobile_in_W, scale, mobile);
  fixed.image = placed_image(core::composed(X_FW, description.fixed_in_W), fixed.image);
  mobile.image = placed_image(core::composed(X_MW, description.mobile_in_W), mobile.image);
  fixed.head = placed_head(core::composed(X_FW, description.fixed_in_W), fixed.head);
  mobile.head = placed_head(core::composed(X_MW, description.mobile_in_W), mobile.head);
  std::vector<PosedPart> parts = placed_parts(description, X_FW, X_MW);
  const kinematics::CutParts cut = kinematics::cut_parts(parts, fixed, mobile);
  kinematics::check_parts(parts, fixed, mobile);
  if (mobile.head) kinematics::keep_head(mobile.mesh, *mobile.head);
  // A search about the joint centre finds the head that a search of the whole body found.
  const auto* fit = std::get_if<CentreFit>(&description.frame.centre);
  if (placement.sphere && fit && fit->body == BodyRole::mobile && !fit->within && !mobile.head)
    kinematics::keep_head(mobile.mesh,
                          numbers_after(cut.mobile_vertex_before, placement.sphere->fit.vertices));
  Joint joint{description.name,
              description.kind,
              description.side,
              std::move(fixed),
              std::move(mobile),
              description.anatomy,
              description.translation_frame};
  joint.zero_from = placement.zero_from;
  joint.planned = description.planned;
  joint.person = description.person;
  joint.units = description.units;
  if (!description.ligaments.empty() && !parts.empty())
    throw UsageError(
        "ligament: a joint with parts that move in their body has none: they would not move along");
  for (const DescribedLigament& ligament : description.ligaments)
    joint.ligaments.push_back(
        placed_ligament(ligament, description, core::composed(X_FW, description.fixed_in_W),
                        core::composed(X_MW, description.mobile_in_W), placement, joint.mobile.head));
  if (!parts.empty())
    joint.posed = PosedParts{std::move(parts),
                             {joint.fixed.mesh, joint.fixed.image, joint.fixed.head},
                             {joint.mobile.mesh, joint.mobile.image, joint.mobile.head}};
  kinematics::pose_parts(joint);
  placement.fixed.bounds = mesh::bounds_of_vertices(joint.fixed.mesh);
  placement.mobile.bounds = mesh::bounds_of_vertices(joint.mobile.mesh);
  placement.processing = processing_of(placement);
  placement.processing.insert(placement.processing.end(), cut.processing.begin(), cut.processing.end());
  return {std::move(joint), std::move(placement)};
}

}  // namespace condyle
