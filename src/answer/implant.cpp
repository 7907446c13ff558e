#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "condyle/answer.hpp"
#include "condyle/contact.hpp"
#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/one_line.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/cut_parts.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_parts.hpp"
#include "plan/place_implant.hpp"

namespace condyle {
namespace {

using core::formatted;

[[noreturn]] void refuse(const std::string& what) {
  throw UsageError("implant: " + what);
}

/// Sizes of bones are rounded to what a person reads: the file, the meshes and the text then have one number.
double hundredths(double value) {
  return std::round(value * 100) / 100;
}

void require_native_hip(const Joint& joint) {
  if (!joint.is_hip() || joint.kind == JointKind::hinge) refuse("the joint is no hip");
  if (joint.implant) refuse("the joint has an implant already");
}

Sphere head_of(const measure::HipMeasures& bones) {
  if (!bones.femur.head) throw MeshError("implant: " + bones.femur.head_radius.why_none);
  return *bones.femur.head;
}

std::optional<Sphere> socket_of(const Joint& joint, const Sphere& head) {
  if (joint.fixed.head) return joint.fixed.head;
  const auto found = kinematics::socket_around(kinematics::uncut_surface(joint.fixed), head);
  if (!*found || !kinematics::fits_into(head, **found)) return std::nullopt;
  return (*found)->fit.sphere;
}

Vec3 centre_of(ImplantCentre centre, const Sphere& head, const std::optional<Sphere>& socket) {
  if (centre == ImplantCentre::head) return head.centre;
  if (!socket) refuse("no socket was found around the head: take the head's centre");
  return socket->centre;
}

/// A shaft that is nearly level says that zero angles are not those of standing: nothing would be placed rightly.
constexpr double least_upright = 0.5;  // cosine to the vertical

std::optional<plan::ShaftLine> shaft_of(const measure::HipMeasures& bones) {
  if (!bones.femur.shaft) return std::nullopt;
  const measure::ShaftGeometry& shaft = *bones.femur.shaft;
  const Vec3 down = (shaft.last - shaft.first).normalized();
  if (!(-down.y() > least_upright))
    refuse("the shaft of the femur is more than 60 degrees from the vertical at zero angles");
  return plan::ShaftLine{shaft.first, down};
}

/// From the head's centre along the bone's neck. With a shaft to that point of its axis which the neck's axis passes nearest, so that a stem
/// in the shaft restores the head's centre: the two axes are skew by up to a centimetre.
Vec3 native_stem(const measure::HipMeasures& bones, const std::optional<plan::ShaftLine>& shaft,
                 const char* size) {
  if (!bones.femur.neck)
    refuse("the femur shows no neck to take " + std::string(size) +
           " from: " + bones.femur.alpha_12.why_none + "; give one");
  const measure::NeckGeometry& neck = *bones.femur.neck;
  if (!shaft) return neck.direction;
  const double along = plan::nearest_along(shaft->point, shaft->down, {neck.head.centre, neck.direction});
  return shaft->point + along * shaft->down - neck.head.centre;
}

void take_stem(ImplantAnswer& answer, const std::optional<plan::ShaftLine>& shaft, Side side) {
  const auto native = [&](const char* size) { return native_stem(answer.bones, shaft, size); };
  plan::TotalHip& hip = answer.hip;
  if (answer.of_bones.neck_shaft)
    hip.neck_shaft =
        Angle::degrees(hundredths(plan::stem_angles(native("neck_shaft"), side).neck_shaft.degrees()));
  if (answer.of_bones.stem_version)
    hip.stem_version =
        Angle::degrees(hundredths(plan::stem_angles(native("stem_version"), side).version.degrees()));
  answer.of_bones.offset = answer.of_bones.offset && shaft.has_value();
  if (!answer.of_bones.offset) return;
  const Vec3 to_shaft = native("offset");
  hip.offset_mm = hundredths(core::hypotenuse(to_shaft.x(), to_shaft.z()));
}

void take_cup(ImplantAnswer& answer, Side side) {
  plan::TotalHip& hip = answer.hip;
  constexpr double step = 0.5;
  if (answer.of_bones.cup_radius) hip.cup_radius_mm = std::ceil(answer.room_mm / step - 1) * step;
  if (!answer.of_bones.cup) return;
  const measure::AcetabulumMeasures& socket = answer.bones.acetabulum;
  if (!socket.plane)
    refuse("the hip bone shows no rim to take the cup's angles from: " + socket.inclination.why_none +
           "; give inclination and anteversion");
  const plan::CupAngles rim = plan::cup_angles(socket.plane->normal, hip.cup.definition, side);
  hip.cup.inclination = Angle::degrees(hundredths(rim.inclination.degrees()));
  hip.cup.anteversion = Angle::degrees(hundredths(rim.anteversion.degrees()));
}

void require_room(const ImplantAnswer& answer, const std::string& bone) {
  if (answer.hip.head_radius_mm < answer.room_mm) return;
  refuse(formatted("a head of radius %g mm does not fit: %s begins %.1f mm from its centre",
                   answer.hip.head_radius_mm, core::one_line(bone).c_str(), answer.room_mm));
}

double angle_between(const Vec3& a, const Vec3& b) {
  return core::arctangent(a.cross(b).norm(), a.dot(b));
}

/// Hours around a socket; those in front are where the psoas tendon passes.
struct Hours {
  double from, to;
};
constexpr Hours all_round{0, 12}, in_front{1, 5};

/// The edge of the cup's outside against the rim, at the hours in the rim's plane: the notch is no rim.
std::optional<CupOverhang> overhang(const ImplantAnswer& answer, Side side, const Hours& at) {
  const Vec3 pole = -plan::cup_axis(answer.hip.cup, side);
  const double edge = (answer.hip.liner_half_angle - answer.hip.chamfer).radians();
  std::optional<CupOverhang> most;
  for (const measure::RimHour& rim : answer.bones.acetabulum.rim) {
    if (!rim.point || !rim.is_in_plane || rim.hour < at.from || rim.hour > at.to) continue;
    const double mm = (edge - angle_between(*rim.point - answer.centre_mm, pole)) * answer.hip.cup_radius_mm;
    if (mm > 0 && (!most || mm > most->mm)) most = CupOverhang{mm, rim.hour};
  }
  return most;
}

/// "neck and liner": the meshes of a pair of triangles that meet.
std::string meeting(const Joint& joint, const contact::TrianglePair& pair) {
  const BodyPart *mobile = part_of_triangle(joint.mobile, pair.mobile),
                 *fixed = part_of_triangle(joint.fixed, pair.fixed);
  return core::one_line(mobile ? mobile->name : joint.mobile.name) + " and " +
         core::one_line(fixed ? fixed->name : joint.fixed.name);
}

void require_apart(const Joint& joint) {
  const contact::JointContact bodies(joint);
  const Pose zero = Pose::Identity();
  if (!bodies.in_contact(zero)) return;
  const auto pairs = bodies.pairs(zero);
  const std::string which = pairs.empty() ? "the bodies" : meeting(joint, pairs.front());
  throw motion::ReferenceContactError("implant: placed so, " + which + " are in contact at zero angles");
}

void note(ImplantAnswer& answer, ImplantNoteCode code, std::string text) {
  answer.notes.push_back({code, std::move(text)});
}

void note_frame(ImplantAnswer& answer) {
  if (answer.bones.pelvis_frame.empty())
    note(answer, ImplantNoteCode::pelvis_as_scanned,
         "the axes are as scanned: the pelvis may have lain turned, and the cup's angles turn with it");
  const double moved = answer.centre_mm.norm();
  if (moved > centres_apart_mm)
    note(answer, ImplantNoteCode::centre_moved,
         formatted("the implant's centre is %.1f mm from the joint's former centre", moved));
}

void note_centres(ImplantAnswer& answer, const Sphere& head) {
  if (!answer.socket) return;
  const double apart = (answer.socket->centre - head.centre).norm();
  if (apart > centres_apart_mm)
    note(answer, ImplantNoteCode::centres_apart,
         formatted("head and socket have centres %.1f mm apart: the implant has that of the %s", apart,
                   std::string(name_of(answer.centre_of)).c_str()));
}

void note_femur(ImplantAnswer& answer) {
  if (!answer.bones.femur.shaft)
    note(answer, ImplantNoteCode::no_shaft,
         answer.bones.femur.neck_shaft.why_none +
             ": the stem points down the frame's vertical, and the femur keeps its place beside it");
  if (!answer.bones.femur.trochanter_top) return;
  const Vec3 top = *answer.bones.femur.trochanter_top - answer.centre_mm + answer.femur_shift_mm;
  constexpr double same_place_mm = 1;
  const Points& left = answer.joint.mobile.mesh.vertices();
  for (std::size_t v = 0; v < left.size(); ++v)
    if ((left[v] - top).norm() < same_place_mm) return;
  note(answer, ImplantNoteCode::trochanter_cut,
       "the cut across the neck takes the tip of the greater trochanter too");
}

void note_cup(ImplantAnswer& answer, const std::string& bone) {
  if (const double depth = answer.hip.cup_radius_mm - answer.room_mm; depth > 0)
    note(answer, ImplantNoteCode::cup_in_bone,
         formatted("the cup's outside is up to %.1f mm in %s: that bone is not reamed, and contact counts it",
                   depth, core::one_line(bone).c_str()));
  if (!answer.bones.acetabulum.plane)
    note(answer, ImplantNoteCode::no_rim,
         answer.bones.acetabulum.inclination.why_none +
             ": how far the cup stands out of the bone is not known");
  if (const auto front = overhang(answer, answer.joint.side, in_front);
      front && front->mm > cup_stands_out_mm)
    note(answer, ImplantNoteCode::cup_stands_out,
         formatted("the cup's edge stands out of the rim in front, by %.1f mm at %.1f h", front->mm,
                   front->hour));
}

void note_left_out(ImplantAnswer& answer, const std::vector<std::string>& meshes) {
  if (meshes.empty()) return;
  std::string names;
  for (const std::string& mesh : meshes) names += (names.empty() ? "" : ", ") + core::one_line(mesh);
  note(answer, ImplantNoteCode::meshes_left_out, "these meshes are left out: " + names);
}

/// Sizes that the request leaves to the bones.
void take_sizes(ImplantAnswer& answer, const std::optional<plan::ShaftLine>& shaft, Side side) {
  take_stem(answer, shaft, side);
  take_cup(answer, side);
  plan::check_implant(answer.hip);
}

void take_placed(ImplantAnswer& answer, plan::PlacedHip&& placed) {
  answer.joint = std::move(placed.joint);
  answer.cut = placed.cut;
  answer.removed_mm3 = placed.removed_mm3;
  answer.femur_shift_mm = placed.femur_shift_mm;
  answer.pair = answer.joint.implant->pair;
  answer.why_no_pair = answer.joint.implant->why_no_pair;
}

const char* const implant_caveat =
    "bones and implant only: soft tissue, fixation and the strength of the remaining bone are not modelled; "
    "the hip bone is not reamed";

}  // namespace

std::string_view name_of(ImplantCentre centre) noexcept {
  return centre == ImplantCentre::head ? "head" : "socket";
}

ImplantCentre implant_centre_named(std::string_view word) {
  for (const ImplantCentre each : {ImplantCentre::head, ImplantCentre::socket})
    if (word == name_of(each)) return each;
  throw UsageError("centre: must be head or socket, not '" + core::one_line(word) + "'");
}

std::string_view name_of(ImplantNoteCode code) noexcept {
  switch (code) {
    case ImplantNoteCode::pelvis_as_scanned:
      return "pelvis_as_scanned";
    case ImplantNoteCode::centres_apart:
      return "centres_apart";
    case ImplantNoteCode::centre_moved:
      return "centre_moved";
    case ImplantNoteCode::no_shaft:
      return "no_shaft";
    case ImplantNoteCode::no_rim:
      return "no_rim";
    case ImplantNoteCode::cup_in_bone:
      return "cup_in_bone";
    case ImplantNoteCode::cup_stands_out:
      return "cup_stands_out";
    case ImplantNoteCode::trochanter_cut:
      return "trochanter_cut";
    case ImplantNoteCode::meshes_left_out:
      break;
  }
  return "meshes_left_out";
}

ImplantAnswer answer_implant(const Case& of, const ImplantRequest& request) {
  const Joint& joint = of.joint;
  require_native_hip(joint);
  const auto held = held_translation(of, {});
  const Joint at = held && *held != Vec3::Zero() ? held_at(joint, *held) : joint;
  ImplantAnswer answer{.hip = request.hip,
                       .of_bones = request.of_bones,
                       .centre_of = request.centre,
                       .centre_mm = Vec3::Zero(),
                       .bones = measure::measure_hip(at, of.measure_options()),
                       .cut = {},
                       .femur_shift_mm = Vec3::Zero(),
                       .joint = at};
  const Sphere head = head_of(answer.bones);
  const auto shaft = shaft_of(answer.bones);
  answer.socket = socket_of(at, head);
  answer.centre_mm = centre_of(request.centre, head, answer.socket);
  if (of.placement.sphere && of.placement.fitted_body == BodyRole::mobile)
    answer.centre_bound_mm = of.placement.sphere->centre_bound_mm;
  answer.room_mm = plan::distance_to_bone(at, answer.centre_mm);
  require_room(answer, at.fixed.name);
  take_sizes(answer, shaft, at.side);
  plan::PlacedHip placed = plan::place_total_hip(answer.hip, at, {answer.centre_mm, head, shaft});
  const std::vector<std::string> left_out = std::move(placed.left_out);
  take_placed(answer, std::move(placed));
  answer.stands_out = overhang(answer, at.side, all_round);
  require_apart(answer.joint);
  note_frame(answer);
  note_centres(answer, head);
  note_femur(answer);
  note_cup(answer, at.fixed.name);
  note_left_out(answer, left_out);
  answer.caveats.emplace_back(implant_caveat);
  return answer;
}

}  // namespace condyle
