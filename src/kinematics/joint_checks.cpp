#include "condyle/joint_checks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/parallel.hpp"
#include "core/rounded.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/body_pieces.hpp"
#include "kinematics/bone_sizes.hpp"
#include "kinematics/cut_parts.hpp"
#include "kinematics/flat_end_notes.hpp"
#include "kinematics/flat_ends.hpp"
#include "kinematics/head_shape.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_axes.hpp"
#include "kinematics/hip_parts.hpp"
#include "kinematics/long_bone_checks.hpp"
#include "kinematics/loose_head.hpp"
#include "kinematics/shoulder_checks.hpp"
#include "kinematics/surface_notes.hpp"
#include "kinematics/turned_leg.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle {
namespace {

using core::formatted;

/// Shares of a sphere: femoral heads have 0.7 and more, half resected ones 0.4; sockets have 0.3.
constexpr double fullest_stray_sphere = 0.4, least_socket_coverage = 0.2;
/// Least size of a femoral head in a joint declared to be none: condyles, tali and capitella are less of a sphere, or
/// smaller.
constexpr double least_femoral_coverage = 0.5, least_femoral_radius_mm = 15;
/// Share of a turn: a talar dome has a third.
constexpr double least_cylinder_coverage = 0.2;

/// Bounds of a good fit: a head's is 0.1 mm, a cylinder's of a whole turn less than a degree.
constexpr double largest_centre_bound_mm = 1, largest_axis_bound_deg = 5;

/// How near the joint centre that of a sphere must be to be taken for the head of a bearing surface.
constexpr double farthest_stray_sphere = 5;

/// A hip bone without a socket, as in models of gait, is nearer to the head's centre than this, in its radii.
constexpr double farthest_bone = 3;

/// A shaft or a hip bone has its mass farther from the head's centre than this, in radii; a cartilage has not.
constexpr double least_lever = 1;

/// Cosines. Right hips show 0.25 to 0.65 forwards and outwards, wrong ones as much the other way; and 0.75 to 1 upwards.
constexpr double opposed_cosine = -0.1, upright = 0.3;
/// A hip bone that shows less forwards than right ones do may be turned about superior: its shape decides, by so many margins of its votes.
constexpr double usual_forwards = 0.25, least_shape_vote = 1;

/// How far in front of the neck a socket opens, seen from above, degrees, is the versions of both together: 30 to 40 is normal, 20 and less severe
/// retroversion (Tönnis and Heinecke 1999). Directions whose horizontal part is shorter have no front.
constexpr double least_version_deg = 20, least_horizontal = 0.3;

class Notes {
 public:
  void add(JointNoteCode code, std::string text) { notes_.push_back({code, std::move(text)}); }
  void add(std::vector<JointNote> others) {
    std::move(others.begin(), others.end(), std::back_inserter(notes_));
  }
  const std::vector<JointNote>& so_far() const noexcept { return notes_; }
  std::vector<JointNote> take() { return std::move(notes_); }

 private:
  std::vector<JointNote> notes_;
};

/// From the sphere's centre to where its part of the surface is missing: along the neck of a head, out of a socket.
/// Zero where the part is nearly all of a sphere.
Vec3 open_side(const TriMesh& mesh, const SphericalPatch& patch) {
  std::vector<std::uint8_t> on(mesh.vertices.size());
  for (const Index v : patch.fit.vertices) on[v] = 1;
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [i, j, k] = mesh.triangles[t];
    if (!(on[i] & on[j] & on[k])) continue;
    const Vec3 a = mesh.vertices[i], b = mesh.vertices[j], c = mesh.vertices[k];
    const double here = (b - a).cross(c - a).norm();
    sum -= here * ((a + b + c) / 3 - patch.fit.sphere.centre).normalized();
    area += here;
  }
  constexpr double whole = 0.05;  // a femoral head has 0.2, a socket 0.5
  return sum.norm() > whole * area ? sum.normalized() : Vec3(Vec3::Zero());
}

/// The sphere round the joint centre, from which bearing surfaces are inferred; if it is not most of a head, one
/// anywhere.
std::optional<SphericalPatch> head_of(const Mesh& mesh) {
  const auto& near_centre = kinematics::head_near_centre(mesh);
  if (near_centre && near_centre->coverage >= fullest_stray_sphere) return near_centre;
  const auto& anywhere = kinematics::head_anywhere(mesh);
  if (anywhere && anywhere->coverage >= fullest_stray_sphere) return anywhere;
  return near_centre;
}

/// The head that the centre was fitted to, if it was, in M; there its centre is the origin.
std::optional<SphericalPatch> head_of(const Joint& joint, const JointPlacement& placement) {
  if (!placement.sphere || placement.fitted_body != BodyRole::mobile) return head_of(joint.mobile.mesh);
  // The placed head differs by rounding: with the very one from which bearing surfaces are inferred, its socket is
  // found once.
  const auto& kept = kinematics::fitted_head(joint.mobile.mesh);
  if (kept && kept->fit.vertices == placement.sphere->fit.vertices) return kept;
  SphericalPatch head = *placement.sphere;
  head.fit.sphere.centre = Vec3::Zero();
  return head;
}

void check_surface(const Body& body, Notes& notes, bool is_cut = false) {
  // Meshes of one body may lie in each other, as a cartilage does in its bone: what is inside one is inside the body.
  if (!body.parts.empty()) {
    for (const BodyPart& part : body.parts)
      check_surface({body.name + "'s " + part.name, mesh_of_part(body, part.name)}, notes,
                    part.cut_triangles > 0);
    return;
  }
  notes.add(kinematics::piece_notes(body.name, body.mesh, is_cut));
  notes.add(kinematics::surface_notes(body.name, body.mesh));
  if (auto note = kinematics::self_crossing_note(body.name, body.mesh)) notes.add({std::move(*note)});
}

void check_cuts(const Body& body, Notes& notes) {
  if (!body.image || body.image->cuts.empty()) return;
  notes.add(JointNoteCode::cut_by_view,
            body.name + formatted(" ends where its image ends, in %zu flat face%s of %.0f mm2 together: what "
                                  "is missing may end a motion earlier, and limits are upper bounds",
                                  body.image->cuts.size(), body.image->cuts.size() == 1 ? "" : "s",
                                  cut_area_mm2(body)));
}

/// Largest edge of a voxel that resolves the joint space of a hip, 2 to 4 mm wide, mm for a head of the usual size.
constexpr double thickest_slice_mm = 2.75;

/// What the makers of a surface said of it, and whether its voxels resolve the joint space.
void check_images(const Joint& joint, const std::optional<SphericalPatch>& head, Notes& notes) {
  for (const Body* body : {&joint.fixed, &joint.mobile})
    if (body->image) notes.add(body->image->notes);
  if (!joint.is_hip() || !head) return;
  Vec3 edges = Vec3::Zero();
  for (const Body* body : {&joint.fixed, &joint.mobile})
    if (body->image && body->image->voxel.colwise().norm().maxCoeff() > edges.maxCoeff())
      edges = body->image->voxel.colwise().norm();
  if (edges.maxCoeff() > by_head(thickest_slice_mm, head->fit.sphere))
    notes.add(JointNoteCode::thick_slices,
              formatted("voxels of %.3g x %.3g x %.3g mm do not resolve the joint space: limits near contact "
                        "in the socket, and those by thin bone, may be off by many degrees",
                        edges.x(), edges.y(), edges.z()));
}

/// A fragment that is moved is less than what it is cut from; of the mobile body either part may move.
void check_parts_cut_off(const Joint& joint, Notes& notes) {
  if (!joint.posed) return;
  for (const PosedPart& part : joint.posed->parts) {
    if (part.cut_from.empty() || part.body != BodyRole::fixed) continue;
    const double cut_off = mesh::enclosed_volume(mesh_of_part(joint.fixed, part.name)),
                 rest = mesh::enclosed_volume(mesh_of_part(joint.fixed, part.cut_from));
    if (cut_off > rest)
      notes.add(JointNoteCode::part_is_most,
                "part " + part.name + formatted(" is %.0f %% of ", 100 * cut_off / (cut_off + rest)) +
                    part.cut_from + ", from which it is cut: do the normals of its planes point inwards?");
  }
}

void check_fit(const Joint& joint, const JointPlacement& placement, Notes& notes) {
  const std::string& fixed = joint.fixed.name;
  const std::string& name = placement.fitted_body == BodyRole::fixed ? fixed : joint.mobile.name;
  if (const auto& sphere = placement.sphere) {
    const double least = placement.fitted_body == BodyRole::fixed ? least_socket_coverage
                         : joint.anatomy == Anatomy::shoulder     ? kinematics::least_humeral_coverage
                                                                  : fullest_stray_sphere;
    if (sphere->coverage < least)
      notes.add(JointNoteCode::low_coverage,
                "the centre was fitted to " + formatted("%.0f %% of a sphere on ", 100 * sphere->coverage) +
                    name + ": too little for a " + (&name == &fixed ? "socket" : "head"));
    if (sphere->centre_bound_mm && *sphere->centre_bound_mm > largest_centre_bound_mm)
      notes.add(JointNoteCode::uncertain_fit,
                "parts of the sphere fitted to " + name +
                    formatted(" give centres up to %.1f mm apart from it", *sphere->centre_bound_mm));
  }
  if (const auto& cylinder = placement.cylinder) {
    if (cylinder->coverage < least_cylinder_coverage)
      notes.add(
          JointNoteCode::low_coverage,
          "the axis was fitted to " + formatted("%.0f %% of a turn on ", 100 * cylinder->coverage) + name);
    if (cylinder->direction_bound && cylinder->direction_bound->degrees() > largest_axis_bound_deg)
      notes.add(JointNoteCode::uncertain_fit,
                "parts of the cylinder fitted to " + name +
                    formatted(" give axes up to %.1f degrees off it", cylinder->direction_bound->degrees()));
  }
}

void check_centres(const Joint& joint, const Sphere& head, const std::optional<SphericalPatch>& socket,
                   Notes& notes) {
  const std::string& mobile = joint.mobile.name;
  if (const double off = head.centre.norm(); off > by_head(farthest_from_head_mm, head))
    notes.add(JointNoteCode::centre_off_head,
              formatted("the joint centre is %.1f mm from that of the head of ", off) + mobile +
                  formatted(", a sphere of radius %.1f mm about ", head.radius) +
                  core::rounded(head.centre, 1));
  if (!socket) return;
  const Sphere& cup = socket->fit.sphere;
  if (!kinematics::fits_into(head, *socket)) {
    notes.add(
        JointNoteCode::socket_smaller_than_head,
        std::string(joint.fixed.head ? "the head does not fit into the socket that is stated, which"
                                     : "no socket was found that the head fits into: the sphere round it") +
            formatted(" has a radius of %.2f mm, the head one of %.2f mm", cup.radius, head.radius));
    return;
  }
  if (const double apart = (cup.centre - head.centre).norm();
      apart > by_head(farthest_head_from_socket_mm, head))
    notes.add(JointNoteCode::head_socket_apart,
              formatted("head and socket have their centres %.1f mm apart", apart));
}

/// Cosines that are positive on a hip of the side stated, in the axes stated.
struct Evidence {
  double medial, anterior, superior;
};

/// Evidence of the hip bone: its mass is up, inwards and a little behind, its socket opens in the opposite direction.
Evidence of_hip_bone(const Vec3& mass, const Vec3& opening, double rightwards) {
  const Vec3 both = (mass.normalized() - opening) / 2;
  return {-rightwards * both.z(), -both.x(), both.y()};
}

/// A femur that is turned by 180 degrees about superior lies as one of the other side with its neck turned back. Both sides' sockets of a pelvis
/// may be there for it: about y = 0, LPS and RAS differ by nothing else.
void check_version(const Joint& joint, const Vec3& neck, const Vec3& opening, Notes& notes) {
  // Other surfaces beside the bones, and a head out of its socket, move the direction of neck or opening.
  constexpr JointNoteCode moving[] = {JointNoteCode::self_crossings, JointNoteCode::nested_surfaces,
                                      JointNoteCode::head_socket_apart};
  const auto moves = [&](const JointNote& note) {
    return std::find(std::begin(moving), std::end(moving), note.code) != std::end(moving);
  };
  if (std::any_of(notes.so_far().begin(), notes.so_far().end(), moves)) return;
  const double rightwards = joint.side == Side::right ? 1 : -1;
  const auto forwards_deg = [&](const Vec3& v) {
    return core::arctangent(v.x(), rightwards * v.z()) * 180 / std::numbers::pi;
  };
  for (const Vec3& v : {neck, opening})
    if (!(core::hypotenuse(v.x(), v.z()) >= least_horizontal)) return;
  const double version_deg = forwards_deg(opening) - forwards_deg(neck);
  if (version_deg >= least_version_deg) return;
  notes.add(
      JointNoteCode::unlikely_version,
      formatted(
          "the socket of %s opens %.0f degrees in front of the neck of %s, of most hips 30 to 40: both "
          "retroverted, or one turned by 180 degrees about superior, as where one file is in LPS and the "
          "other in RAS",
          joint.fixed.name.c_str(), version_deg, joint.mobile.name.c_str()));
}

void check_hip(const Joint& joint, const SphericalPatch& head, const SphericalPatch& socket, Notes& notes) {
  const double rightwards = joint.side == Side::right ? 1 : -1;
  const Vec3 mass =
      kinematics::area_centroid(mesh::outer_surface(joint.fixed.mesh)) - socket.fit.sphere.centre;
  const Vec3 shaft =
      kinematics::area_centroid(mesh::outer_surface(joint.mobile.mesh)) - head.fit.sphere.centre;
  if (mass.norm() < least_lever * socket.fit.sphere.radius ||
      shaft.norm() < least_lever * head.fit.sphere.radius)
    return;
  const std::string &fixed = joint.fixed.name, &mobile = joint.mobile.name;
  const Vec3 opening = open_side(kinematics::uncut_surface(joint.fixed), socket),
             neck = open_side(joint.mobile.mesh, head);
  const Evidence bone = of_hip_bone(mass, opening, rightwards);
  if (bone.superior < upright) {
    notes.add(JointNoteCode::axes_not_upright,
              fixed + " does not lie above its socket: superior does not point up");
    return;
  }
  if (-shaft.normalized().y() < upright) {
    notes.add(
        JointNoteCode::axes_not_upright,
        mobile + " does not hang down from its head at zero angles: superior or the reference pose is wrong");
    return;
  }
  const double neck_outwards = rightwards * neck.z();
  const std::string side = joint.side == Side::right ? "right" : "left";
  const bool lateral = bone.medial < opposed_cosine, backwards = bone.anterior < opposed_cosine;
  const auto has_shape_of_side = [&] {
    const auto hip = kinematics::hip_anatomy(joint.fixed.mesh, joint.mobile.mesh);
    return hip &&
           kinematics::shape_vote(joint.side, joint.fixed.mesh, *hip, Vec3::UnitY()) >= least_shape_vote;
  };
  if (lateral && (backwards || (bone.anterior < usual_forwards && has_shape_of_side())))
    notes.add(
        JointNoteCode::axes_turned,
        fixed +
            (backwards ? " lies lateral of its socket, which opens backwards"
                       : " lies lateral of its socket, and both bones have the shape of the side stated") +
            ": the axes are turned by 180 degrees about superior, as where LPS coordinates are read as RAS");
  else if (lateral ? neck_outwards > -opposed_cosine : neck_outwards < opposed_cosine)
    notes.add(JointNoteCode::bodies_disagree, fixed + (lateral ? " lies lateral" : " lies medial") +
                                                  " of its socket and the neck of " + mobile +
                                                  (lateral ? " points outwards" : " points inwards") +
                                                  ": one of the two is mirrored or of the other side");
  else if (lateral)
    notes.add(JointNoteCode::wrong_side, "the side is " + side + ", but " + fixed +
                                             " lies lateral of its socket: it is the other side's or "
                                             "mirrored, or the axes are turned by a quarter");
  else if (backwards)
    notes.add(JointNoteCode::mirrored,
              "the socket of " + fixed +
                  " opens backwards: front and back are mirrored, or the axes are turned by a quarter");
  else
    check_version(joint, neck, opening, notes);
}

/// Coarse meshes, as those of models of gait, have no sockets.
void check_side_without_socket(const Joint& joint, Notes& notes) {
  if (auto note = kinematics::hip_side_note(joint)) notes.add({std::move(*note)});
}

/// Without a socket about the head the hip bone may be anywhere, and the sphere a condyle or a trochanter.
void check_distance(const Joint& joint, const Sphere& head, Notes& notes) {
  double squared = HUGE_VAL;
  const auto& vertices = joint.fixed.mesh.vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v)
    squared = std::min(squared, (vertices[v] - head.centre).squaredNorm());
  if (const double off = std::sqrt(squared); off > farthest_bone * head.radius)
    return notes.add(
        JointNoteCode::far_centre,
        joint.fixed.name + formatted(" has nothing within %.0f mm of the head of ", off) + joint.mobile.name);
  const TriMesh& fixed = kinematics::uncut_surface(joint.fixed);
  if (kinematics::lies_about(fixed, head)) return;
  const auto socket = kinematics::full_socket(fixed);
  if (!socket) return;
  const double apart = (socket->fit.sphere.centre - head.centre).norm();
  if (apart > socket->fit.sphere.radius / 2)
    notes.add(
        JointNoteCode::no_head,
        joint.mobile.name + " has no head in or near the socket of " + joint.fixed.name +
            formatted(": the sphere found, of radius %.1f mm, is %.0f mm from a socket of radius %.1f mm",
                      head.radius, apart, socket->fit.sphere.radius));
}

/// Whether there is a socket about the joint centre, of whatever size.
bool has_socket(const Body& fixed) {
  try {
    const Sphere socket =
        find_sphere(kinematics::uncut_surface(fixed), {.part = SphericalPart::socket}).fit.sphere;
    return socket.centre.norm() < socket.radius;
  } catch (const MeshError&) {
    return false;
  }
}

void check_ball(const Joint& joint, const JointPlacement& placement, Notes& notes) {
  const auto head = head_of(joint, placement);
  if (!head || head->coverage < fullest_stray_sphere) {
    const auto on_fixed = head_of(joint.fixed.mesh);
    if (on_fixed && on_fixed->coverage >= fullest_stray_sphere)
      notes.add(JointNoteCode::swapped_bodies, joint.fixed.name + " has a head and " + joint.mobile.name +
                                                   " has none: are the bodies exchanged?");
    else if (head && !placement.sphere && head->fit.sphere.centre.norm() <= farthest_stray_sphere)
      notes.add(JointNoteCode::low_coverage,
                formatted("the sphere about the joint centre is %.0f %% of one on ", 100 * head->coverage) +
                    joint.mobile.name + ": too little for a head, and bearing contact is inferred from it");
    else if (!placement.sphere && !has_part(joint.mobile, PartContact::bearing) && has_socket(joint.fixed))
      notes.add(JointNoteCode::no_head,
                "no head was found on " + joint.mobile.name +
                    ": contact in the socket is not distinguished from impingement, and ends motions");
    check_side_without_socket(joint, notes);
    return;
  }
  const auto socket = kinematics::socket_of(joint.fixed, head->fit.sphere);
  check_centres(joint, head->fit.sphere, *socket, notes);
  if (auto note = kinematics::head_shape_note(joint, head->fit.sphere)) notes.add({std::move(*note)});
  if (*socket) {
    check_hip(joint, *head, **socket, notes);
  } else {
    if (auto note = kinematics::loose_head_note(joint, head->fit.sphere)) notes.add({std::move(*note)});
    check_side_without_socket(joint, notes);
    check_distance(joint, head->fit.sphere, notes);
  }
}

/// Whether two meshes have the same triangles of the same shape, wherever each lies.
bool are_one_mesh(const Mesh& a, const Mesh& b) {
  if (a.triangles().empty() || a.vertices().size() != b.vertices().size() ||
      !std::equal(a.triangles().begin(), a.triangles().end(), b.triangles().begin(), b.triangles().end()))
    return false;
  const double rounding = 1e-9 * mesh::bounds_of_surface(a).diagonal();
  for (std::size_t t = 0; t < a.triangles().size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const double of_a = (a.corner(t, k) - a.corner(t, next)).norm();
      const double of_b = (b.corner(t, k) - b.corner(t, next)).norm();
      if (!(std::abs(of_a - of_b) <= rounding)) return false;
    }
  return true;
}

/// A femoral head in its socket is neither a hinge nor a knee, ankle or elbow. A shoulder has a head too, and checks of its own.
void check_stated_joint(const Joint& joint, Notes& notes) {
  if (joint.anatomy == Anatomy::shoulder) return;
  const auto& head = kinematics::head_near_centre(joint.mobile.mesh);
  if (!head || head->coverage < least_femoral_coverage || head->fit.sphere.radius < least_femoral_radius_mm ||
      head->fit.sphere.centre.norm() > farthest_stray_sphere)
    return;
  const auto socket = kinematics::socket_of(joint.fixed, head->fit.sphere);
  if (!*socket || !kinematics::fits_into(head->fit.sphere, **socket)) return;
  notes.add(JointNoteCode::unlikely_joint,
            std::string(joint.kind == JointKind::hinge ? "the joint is declared a hinge"
                                                       : "the joint is declared not a hip") +
                ", but " + joint.mobile.name +
                formatted(" has a head of radius %.1f mm in a socket of ", head->fit.sphere.radius) +
                joint.fixed.name + ": a hip is a ball joint");
}

}  // namespace

std::string_view name_of(JointNoteCode code) noexcept {
  switch (code) {
    case JointNoteCode::unlikely_size:
      return "unlikely_size";
    case JointNoteCode::units_disagree:
      return "units_disagree";
    case JointNoteCode::nested_surfaces:
      return "nested_surfaces";
    case JointNoteCode::separate_pieces:
      return "separate_pieces";
    case JointNoteCode::open_mesh:
      return "open_mesh";
    case JointNoteCode::mixed_orientation:
      return "mixed_orientation";
    case JointNoteCode::two_sided:
      return "two_sided";
    case JointNoteCode::inverted_mesh:
      return "inverted_mesh";
    case JointNoteCode::self_crossings:
      return "self_crossings";
    case JointNoteCode::doubled_triangles:
      return "doubled_triangles";
    case JointNoteCode::part_is_most:
      return "part_is_most";
    case JointNoteCode::pieces_left_out:
      return "pieces_left_out";
    case JointNoteCode::gap_in_bone:
      return "gap_in_bone";
    case JointNoteCode::interpolated_labels:
      return "interpolated_labels";
    case JointNoteCode::thick_slices:
      return "thick_slices";
    case JointNoteCode::two_affines:
      return "two_affines";
    case JointNoteCode::two_voxel_sizes:
      return "two_voxel_sizes";
    case JointNoteCode::unknown_units:
      return "unknown_units";
    case JointNoteCode::more_bytes:
      return "more_bytes";
    case JointNoteCode::simplified_away:
      return "simplified_away";
    case JointNoteCode::touching:
      return "touching";
    case JointNoteCode::cut_by_view:
      return "cut_by_view";
    case JointNoteCode::flat_end:
      return "flat_end";
    case JointNoteCode::same_mesh:
      return "same_mesh";
    case JointNoteCode::unlikely_joint:
      return "unlikely_joint";
    case JointNoteCode::swapped_bodies:
      return "swapped_bodies";
    case JointNoteCode::no_head:
      return "no_head";
    case JointNoteCode::head_not_round:
      return "head_not_round";
    case JointNoteCode::low_coverage:
      return "low_coverage";
    case JointNoteCode::uncertain_fit:
      return "uncertain_fit";
    case JointNoteCode::far_centre:
      return "far_centre";
    case JointNoteCode::centre_off_head:
      return "centre_off_head";
    case JointNoteCode::head_socket_apart:
      return "head_socket_apart";
    case JointNoteCode::socket_smaller_than_head:
      return "socket_smaller_than_head";
    case JointNoteCode::socket_larger_than_head:
      return "socket_larger_than_head";
    case JointNoteCode::axes_not_upright:
      return "axes_not_upright";
    case JointNoteCode::axes_turned:
      return "axes_turned";
    case JointNoteCode::wrong_side:
      return "wrong_side";
    case JointNoteCode::mirrored:
      return "mirrored";
    case JointNoteCode::bodies_disagree:
      return "bodies_disagree";
    case JointNoteCode::unlikely_version:
      return "unlikely_version";
    case JointNoteCode::turned_leg:
      return "turned_leg";
    case JointNoteCode::ligament_off_bone:
      return "ligament_off_bone";
    case JointNoteCode::ligament_through_bone:
      return "ligament_through_bone";
    case JointNoteCode::unlikely_strain:
      return "unlikely_strain";
  }
  return "";
}

std::optional<JointNoteCode> image_note_code(std::string_view name) noexcept {
  const auto code = std::find_if(std::begin(image_note_codes), std::end(image_note_codes),
                                 [&](JointNoteCode each) { return name_of(each) == name; });
  return code == std::end(image_note_codes) ? std::nullopt : std::optional(*code);
}

std::vector<JointNote> check_joint(const Joint& joint, const JointPlacement& placement) {
  // What is found on a surface is kept with its mesh, and takes the longest: bodies and socket at the same time.
  Notes of_fixed, of_mobile, notes;
  kinematics::SizeNotes sizes;
  std::optional<SphericalPatch> head;
  const auto check_body = [&](const Body& body, Notes& own) {
    check_surface(body, own);
    check_cuts(body, own);
    if (joint.is_hip()) kinematics::flat_ends(body.mesh);
  };
  const auto check_sizes = [&] {
    head = joint.has_head() ? head_of(joint, placement) : std::nullopt;
    sizes =
        kinematics::size_notes(joint, head && head->coverage >= fullest_stray_sphere ? head : std::nullopt);
  };
  core::parallel_pair(
      [&] { check_body(joint.fixed, of_fixed); },
      [&] { core::parallel_pair(check_sizes, [&] { check_body(joint.mobile, of_mobile); }); });
  notes.add(std::move(sizes.notes));
  notes.add(of_fixed.take());
  notes.add(of_mobile.take());
  check_images(joint, head, notes);
  check_parts_cut_off(joint, notes);
  notes.add(check_ligaments(joint, placement));
  check_fit(joint, placement, notes);
  const bool is_same = are_one_mesh(joint.fixed.mesh, joint.mobile.mesh);
  if (is_same)
    notes.add(JointNoteCode::same_mesh, joint.fixed.name + " and " + joint.mobile.name +
                                            " are one mesh: is one file given for both bodies?");
  if (is_same || !sizes.are_bones) return notes.take();
  notes.add(kinematics::flat_end_notes(joint));
  if (joint.is_hip()) {
    check_ball(joint, placement, notes);
    if (auto note = kinematics::turned_leg_note(joint, notes.so_far())) notes.add({std::move(*note)});
    return notes.take();
  }
  check_stated_joint(joint, notes);
  if (joint.has_head()) notes.add(kinematics::shoulder_notes(joint, placement));
  notes.add(kinematics::long_bone_notes(joint, placement));
  return notes.take();
}

}  // namespace condyle
