#include "io/joint/propose_other_joint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "condyle/inspect.hpp"
#include "condyle/io/pose_text.hpp"
#include "core/rounded.hpp"
#include "core/trigonometry.hpp"
#include "io/joint/proposal_lines.hpp"
#include "io/joint/propose_units.hpp"
#include "kinematics/ankle_anatomy.hpp"
#include "kinematics/elbow_anatomy.hpp"
#include "kinematics/knee_anatomy.hpp"
#include "kinematics/shoulder_anatomy.hpp"
#include "mesh/enclosed_volume.hpp"

namespace condyle::io {
namespace {

/// A value with its evidence, or why there is none.
template <class T>
struct Shown {
  std::optional<T> value = {};
  std::string says = {};
};

/// The proposed joint; places in mm, in the frame of the meshes.
struct ShownJoint {
  std::string kind, kind_says;
  std::vector<std::string> other_choices;  ///< comments below the kind
  Shown<Vec3> centre = {}, anterior = {}, superior = {};
  std::string anterior_choices = "[x, y, z]";
  std::optional<Side> side = {};
  std::string why_no_side = {};
  std::vector<std::string> evidence = {};
};

constexpr std::string_view side_sets = "it sets the sense of the angles other than the first";
constexpr std::string_view centre_sets = "rotations turn about it";

double in_degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

std::string cylinder_text(const CylinderFit& fit) {
  return fmt::format("radius {:.2f} mm, rms {:.2f} mm, known to {:.1f} degrees and {:.1f} mm",
                     fit.cylinder.radius, fit.rms_residual, fit.direction_bound->degrees(),
                     *fit.axis_bound_mm);
}

std::string shaft_text(const kinematics::ShaftLine& shaft, std::string_view bone) {
  return fmt::format("the {}'s shaft from {:.0f} to {:.0f} mm above the axis, to {:.1f} degrees", bone,
                     shaft.first_mm, shaft.last_mm, shaft.bound_deg);
}

/// Words of our own, which need no escapes.
std::string toml_word(std::string_view word) {
  return fmt::format("\"{}\"", word);
}

/// Nine digits; what is nothing but rounding is 0.
Vec3 without_rounding(Vec3 v) {
  for (double& x : v)
    if (std::abs(x) < 1e-9) x = 0;
  return v;
}

std::string direction_text(const Vec3& given) {
  const Vec3 v = without_rounding(given);
  return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x(), v.y(), v.z());
}

/// To a thousandth of a millimetre, in the unit of the meshes.
std::string place_text(const Vec3& mm, LengthUnit unit) {
  const auto rounded = [&](double x) { return (std::round(x * 1000) / 1000 + 0.0) / mm_per(unit); };
  return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", rounded(mm.x()), rounded(mm.y()), rounded(mm.z()));
}

/// Axes that segmentations and models come in, and how far these are turned in the nearest.
std::string nearest_axes_text(const kinematics::ShownAxes& axes) {
  struct Known {
    std::string_view name;
    FrameDirections axes;
  };
  const std::array known{Known{"RAS", ras_axes}, Known{"LPS", lps_axes},
                         Known{"joint axes (x anterior, y superior, z right)", {}}};
  const auto turned = [&](const FrameDirections& in) {
    const Vec3 right = in.anterior.cross(in.superior);
    const double trace =
        in.anterior.dot(axes.anterior) + in.superior.dot(axes.superior) + right.dot(axes.right());
    return in_degrees(core::arccosine(std::clamp((trace - 1) / 2, -1.0, 1.0)));
  };
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const Known& a, const Known& b) {
    return turned(a.axes) < turned(b.axes);
  });
  return fmt::format("of the axes in use the nearest are {}, turned by {:.0f} degrees", nearest->name,
                     turned(nearest->axes));
}

void show_axes(ShownJoint& joint, const kinematics::ShownAxes& axes, std::string forwards,
               std::string upwards) {
  joint.anterior = {axes.anterior, std::move(forwards)};
  joint.superior = {axes.superior, std::move(upwards)};
  joint.evidence.push_back(nearest_axes_text(axes));
}

std::string exchanged_text(bool is_exchanged, std::string_view part) {
  return is_exchanged ? fmt::format("; the other body has {}, so fixed and mobile look exchanged", part)
                      : std::string();
}

std::string epicondyles_text(const kinematics::Epicondyles& epicondyles) {
  // Surgical and cylinder axes of knees differ by some degrees; more is not an axis through epicondyles.
  constexpr double most_deg = 15;
  const std::string points =
      fmt::format("{} and {} mm", core::rounded(epicondyles.first, 1), core::rounded(epicondyles.last, 1));
  if (epicondyles.to_axis_deg > most_deg)
    return fmt::format(
        "no epicondylar axis: the outermost points {} lie {:.0f} degrees off the condyles' axis", points,
        epicondyles.to_axis_deg);
  return fmt::format(
      "the epicondylar axis, through the outermost points {}, is {:.1f} degrees from the condyles' axis",
      points, epicondyles.to_axis_deg);
}

ShownJoint shown_knee(const TriMesh& femur, const TriMesh& tibia) {
  const kinematics::KneeAnatomy knee = kinematics::knee_anatomy(femur, tibia);
  ShownJoint joint{
      .kind = "free",
      .kind_says = "a knee turns in all three angles and slides",
      .other_choices = {
          "kind = \"hinge\" is the other choice: flexion about the condyles' axis, and nothing else",
          "translation_frame = \"joint_axes\" would give x, y, z along the joint's axes (Grood and Suntay "
          "1983), not the femur's"}};
  if (!knee.condyles) {
    const bool is_exchanged = kinematics::knee_anatomy(tibia, femur).condyles.has_value();
    joint.centre.says = knee.why_no_condyles + exchanged_text(is_exchanged, "condyles");
  } else {
    const kinematics::Condyles& condyles = *knee.condyles;
    joint.centre = {
        condyles.fit.cylinder.point,
        fmt::format("middle of the axis of both condyles' common cylinder: {}", cylinder_text(condyles.fit))};
    joint.evidence.push_back(
        fmt::format("the condyles share {:.0f} degrees of a turn, {:.0f} mm from outer to outer end",
                    condyles.common_arc_deg, condyles.length_mm));
    joint.evidence.push_back(epicondyles_text(*knee.epicondyles));
  }
  joint.evidence.insert(joint.evidence.end(), knee.evidence.begin(), knee.evidence.end());
  joint.anterior.says = joint.superior.says = knee.why_no_axes;
  if (knee.axes)
    show_axes(joint, *knee.axes, "square to the condyles' axis and superior",
              knee.head ? fmt::format("towards the femur's head at {} mm, square to the condyles' axis",
                                      core::rounded(knee.head->fit.sphere.centre, 1))
                        : shaft_text(*knee.shaft, "femur") + ", square to the condyles' axis");
  joint.side = knee.side;
  joint.why_no_side = knee.why_no_side;
  return joint;
}

ShownJoint shown_ankle(const TriMesh& tibia, const TriMesh& talus) {
  const kinematics::AnkleAnatomy ankle = kinematics::ankle_anatomy(tibia, talus);
  ShownJoint joint{
      .kind = "hinge",
      .kind_says = "the talus turns about the axis of its dome",
      .other_choices = {"kind = \"free\" is the other choice: three angles and three translations"},
      .why_no_side = "two meshes do not show it: the tibia may or may not have the fibula's malleolus"};
  if (ankle.dome.fit) {
    joint.centre = {ankle.centre, "middle of the axis of the talar dome: " + cylinder_text(*ankle.dome.fit)};
  } else {
    const bool is_exchanged = kinematics::ankle_anatomy(talus, tibia).dome.fit.has_value();
    joint.centre.says = ankle.dome.why_none + exchanged_text(is_exchanged, "a dome");
  }
  joint.evidence = ankle.evidence;
  joint.anterior.says = joint.superior.says = ankle.why_no_axes;
  if (ankle.axes)
    show_axes(joint, *ankle.axes, "towards the talus' head, square to the dome's axis",
              shaft_text(*ankle.shaft, "tibia") + ", square to the dome's axis");
  return joint;
}

ShownJoint shown_elbow(const TriMesh& humerus, const TriMesh& ulna) {
  const kinematics::ElbowAnatomy elbow = kinematics::elbow_anatomy(humerus, ulna);
  ShownJoint joint{
      .kind = "hinge",
      .kind_says = "the ulna turns about the axis of the trochlea",
      .other_choices = {"kind = \"free\" is the other choice: three angles and three translations"},
      .why_no_side = "two meshes do not show it"};
  joint.anterior.says = joint.superior.says = elbow.why_no_superior;
  if (!elbow.trochlea.fit) {
    const bool is_exchanged = kinematics::elbow_anatomy(ulna, humerus).trochlea.fit.has_value();
    joint.centre.says = elbow.trochlea.why_none + exchanged_text(is_exchanged, "a trochlea");
    return joint;
  }
  joint.centre = {elbow.centre, "middle of the axis of the trochlea: " + cylinder_text(*elbow.trochlea.fit)};
  if (!elbow.superior) return joint;
  joint.superior = {*elbow.superior, shaft_text(*elbow.shaft, "humerus") + ", square to the trochlea's axis"};
  joint.anterior_choices = fmt::format("{} or {}", direction_text(*elbow.from_shaft_line),
                                       direction_text(-*elbow.from_shaft_line));
  joint.anterior.says = fmt::format(
      "the first is where the axis lies from the shaft's line, by {:.1f} mm, as in front of most humeri; its "
      "opposite makes flexion extension",
      elbow.off_shaft_line_mm);
  return joint;
}

ShownJoint shown_shoulder(const TriMesh& scapula, const TriMesh& humerus) {
  const kinematics::ShoulderAnatomy shoulder = kinematics::shoulder_anatomy(scapula, humerus);
  ShownJoint joint{
      .kind = "ball",
      .kind_says = "the humerus turns about the centre of its head",
      .other_choices = {"kind = \"free\" is the other choice: the head also slides on the glenoid"},
      .why_no_side = "two meshes do not show it"};
  const std::string landmarks =
      "the scapula's axes need landmarks (ISB: acromial angle, inferior angle, root of the spine), and "
      "elevation is measured from them";
  joint.anterior.says = joint.superior.says = landmarks;
  if (shoulder.head) {
    const SphericalPatch& head = *shoulder.head;
    joint.centre = {
        head.fit.sphere.centre,
        fmt::format(
            "the head's centre: radius {:.2f} mm, {:.0f} % of a sphere, rms {:.2f} mm, known to {:.1f} mm",
            head.fit.sphere.radius, 100 * head.coverage, head.fit.rms_residual, *head.centre_bound_mm)};
    joint.evidence.push_back(
        fmt::format("from the head the humerus' mass lies towards {}: down, if the arm hangs",
                    core::rounded(*shoulder.towards_humerus, 2)));
  } else {
    const bool is_exchanged = kinematics::shoulder_anatomy(humerus, scapula).head.has_value();
    joint.centre.says = shoulder.why_no_head + exchanged_text(is_exchanged, "a head");
  }
  if (shoulder.glenoid)
    joint.evidence.push_back(
        fmt::format("a glenoid of {:.0f} mm2 on a sphere of radius {:.1f} mm, its centre {:.1f} mm from the "
                    "head's, faces {}: roughly to the side",
                    shoulder.glenoid->area_mm2, shoulder.glenoid->fit.sphere.radius,
                    (shoulder.glenoid->fit.sphere.centre - shoulder.head->fit.sphere.centre).norm(),
                    core::rounded(shoulder.glenoid->faces, 2)));
  else
    joint.evidence.push_back("no glenoid: " + shoulder.why_no_glenoid);
  return joint;
}

ShownJoint shown(Anatomy anatomy, const TriMesh& fixed, const TriMesh& mobile) {
  switch (anatomy) {
    case Anatomy::knee:
      return shown_knee(fixed, mobile);
    case Anatomy::ankle:
      return shown_ankle(fixed, mobile);
    case Anatomy::elbow:
      return shown_elbow(fixed, mobile);
    default:
      return shown_shoulder(fixed, mobile);
  }
}

/// Condyles, heads and domes of a mesh that is inside out are hollows.
std::string inverted_text(const ProposedBody& fixed, const ProposedBody& mobile) {
  for (const ProposedBody* body : {&fixed, &mobile})
    if (const Mesh mesh(body->mesh); mesh.is_closed() && mesh::is_inside_out(mesh))
      return fmt::format("; the mesh of {} is inside out: condyle inspect --repair flip_inverted",
                         body->name);
  return {};
}

/// The side as the file has it.
std::optional<Side> add_side(ProposalLines& lines, const std::optional<Stated<Side>>& stated,
                             const ShownJoint& joint, Anatomy anatomy) {
  if (stated && joint.side && stated->value != *joint.side) {
    lines.missing("side", "\"right\" or \"left\"",
                  fmt::format("{} it is {}, and the bones are shaped as those of a {} {}; {}", stated->by,
                              name_of(stated->value), name_of(*joint.side), name_of(anatomy), side_sets));
    return std::nullopt;
  }
  if (stated) {
    lines.key("side", toml_word(name_of(stated->value)), stated->by);
    return stated->value;
  }
  if (joint.side)
    lines.key("side", toml_word(name_of(*joint.side)),
              "inferred from the shape of the bones, below; a mirrored mesh has the other");
  else
    lines.missing("side", "\"right\" or \"left\"", fmt::format("{}; {}", joint.why_no_side, side_sets));
  return joint.side;
}

void add_direction(ProposalLines& lines, std::string_view key, const Shown<Vec3>& shown,
                   std::string_view choices) {
  if (shown.value)
    lines.key(key, direction_text(*shown.value), shown.says);
  else
    lines.missing(key, choices, shown.says);
}

/// The joint in the unit that is stated or that the sizes of the meshes speak for; if it shows no centre there, in the first other one in
/// which the bones could be as large and it shows one.
std::pair<std::optional<Stated<LengthUnit>>, ShownJoint> shown_in_some_unit(Anatomy anatomy,
                                                                            const ProposedBody& fixed,
                                                                            const ProposedBody& mobile,
                                                                            const ProposalFacts& facts) {
  const auto in_unit = [&](LengthUnit unit) {
    return shown(anatomy, surface_in_mm(fixed, unit), surface_in_mm(mobile, unit));
  };
  auto by_size = units_by_size(fixed, mobile, facts);
  ShownJoint joint = in_unit(by_size ? by_size->value : LengthUnit::millimetres);
  if (joint.centre.value || facts.units || !facts.person.is_human())
    return {std::move(by_size), std::move(joint)};
  const double size = std::max(mesh::bounds_of_surface(fixed.mesh).diagonal(),
                               mesh::bounds_of_surface(mobile.mesh).diagonal());
  constexpr double shortest_mm = 55, longest_mm = 600;  // of the larger bone of such a joint
  for (const LengthUnit unit : all_length_units) {
    if ((by_size && unit == by_size->value) || size * mm_per(unit) < shortest_mm ||
        size * mm_per(unit) > longest_mm)
      continue;
    if (ShownJoint other = in_unit(unit); other.centre.value)
      return {Stated<LengthUnit>{unit,
                                 fmt::format("inferred: in {} the bones show such a joint", plural_of(unit))},
              std::move(other)};
  }
  return {std::move(by_size), std::move(joint)};
}

}  // namespace

JointProposal proposal_of_other(ProposedBody fixed, ProposedBody mobile, Anatomy anatomy,
                                const ProposalFacts& facts) {
  auto [inferred, joint] = shown_in_some_unit(anatomy, fixed, mobile, facts);
  const LengthUnit units = inferred ? inferred->value : LengthUnit::millimetres;
  fixed.mesh = surface_in_mm(fixed, units);
  mobile.mesh = surface_in_mm(mobile, units);

  ProposalLines lines;
  add_head(lines, fixed, mobile, facts);
  lines.key("joint", toml_word(name_of(anatomy)), "given");
  lines.key("kind", toml_word(joint.kind), joint.kind_says);
  for (const std::string& choice : joint.other_choices) lines.add("# " + choice);
  const std::optional<Side> side = add_side(lines, facts.side, joint, anatomy);
  add_units(lines, inferred, fixed, mobile);
  add_body(lines, "fixed", fixed, facts.joint_file);
  add_body(lines, "mobile", mobile, facts.joint_file);
  lines.add("\n[frame]");
  if (joint.centre.value)
    lines.key("centre", place_text(*joint.centre.value, units), joint.centre.says);
  else
    lines.missing("centre", "[x, y, z]",
                  fmt::format("{}{}; {}", joint.centre.says, inverted_text(fixed, mobile), centre_sets));
  add_direction(lines, "anterior", joint.anterior, joint.anterior_choices);
  add_direction(lines, "superior", joint.superior, "[x, y, z]");
  for (const std::string& line : joint.evidence) lines.evidence(line);
  lines.add(
      "# Angles are 0 in the pose of the meshes; if the joint was scanned bent, [reference_pose] with that "
      "angle makes 0");
  lines.add("# the straight joint, and changes every limit by it.");
  return std::move(lines).proposal(side);
}

}  // namespace condyle::io
