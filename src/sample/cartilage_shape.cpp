#include "sample/cartilage_shape.hpp"

#include <algorithm>
#include <cmath>

#include "core/trigonometry.hpp"
#include "sample/femur_shape.hpp"
#include "sample/hip_bone_shape.hpp"

namespace condyle::sample {
namespace {

/// Width over which edges are rounded, of the thickness: below one, so that the rounding of one side never
/// reaches the other and both stay what they are.
constexpr double rounding = 0.8;

/// How far from the native alpha angle, as seen from the neck's axis, the femoral cartilage keeps: head and
/// neck blend on the way there.
constexpr Angle margin_off_neck = Angle::degrees(15);

/// Room around the solids, mm.
constexpr double room_around = 4;

/// Directions from the hip centre that are farther than an angle from an axis of length one: distance to the
/// cone, negative on that side. A cone cuts every sphere about the centre at a right angle.
struct FartherThan {
  Vec3 axis;
  Angle angle;

  FieldValue operator()(const Vec3& p) const noexcept {
    const double along = p.dot(axis), sine = core::sine(angle.radians()),
                 cosine = core::cosine(angle.radians());
    const Vec3 across = p - along * axis;
    const double distance = across.norm();
    const Vec3 outward = distance > 0 ? Vec3(across / distance) : Vec3(Vec3::Zero());
    return {sine * along - cosine * distance, sine * axis - cosine * outward};
  }
};

struct FemoralCartilagePieces {
  Field femur;
  Ball surface;
  FartherThan off_neck;
  double seam;

  FieldValue operator()(const Vec3& p) const {
    return without(common(ball(surface, p), off_neck(p), seam), femur(p), seam);
  }
  double border_distance(const Vec3& p) const noexcept { return std::abs(off_neck(p).value); }
};

struct AcetabularCartilagePieces {
  Field hip_bone;
  Ball surface, outermost;
  double socket_radius;
  Vec3 opening;
  double rim_offset;
  Circle rim;
  double labrum_radius, labrum_seam;
  Ball fossa_top, fossa_bottom;
  double seam;

  FieldValue operator()(const Vec3& p) const {
    FieldValue ring = common(ball(outermost, p), half_space(opening, rim_offset, p), seam);
    ring = without(ring, bar(fossa_top, fossa_bottom, p), seam);
    ring = joined(ring, tube(rim, labrum_radius, p), labrum_seam);
    ring = without(ring, ball(surface, p), seam);
    // The socket's sphere has no bone in it, so the bone's field is at least this there. Where that does not
    // reach the seam, neither does the bone, whose field is the dear part.
    if (socket_radius - p.norm() >= seam - ring.value) return ring;
    return without(ring, hip_bone(p), seam);
  }
  double border_distance(const Vec3& p) const noexcept {
    const double from_fossa = std::abs(bar(fossa_top, fossa_bottom, p).value);
    return std::min(from_fossa, std::max(tube(rim, labrum_radius, p).value, 0.0));
  }
};

Box box_about_centre(double reach) noexcept {
  return {Vec3::Constant(-reach), Vec3::Constant(reach)};
}

}  // namespace

ArticularSpheres articular_spheres(const HipParameters& hip, const CartilageParameters& cartilage) noexcept {
  const double head = hip.head_radius_mm, femoral = head + cartilage.femoral_thickness_mm;
  return {head, femoral, femoral + cartilage.clearance_mm, head + hip.joint_space_mm};
}

Cartilage femoral_cartilage_shape(const HipParameters& hip, const CartilageParameters& parameters) {
  const ArticularSpheres spheres = articular_spheres(hip, parameters);
  FemoralCartilagePieces cartilage;
  HipParameters without_cam = hip;
  without_cam.alpha_angle.reset();
  cartilage.femur = femur_shape(without_cam).field;
  cartilage.surface = {Vec3::Zero(), spheres.femoral};
  cartilage.off_neck = {femur_axes(hip).neck, native_alpha_angle(hip) + margin_off_neck};
  cartilage.seam = rounding * spheres.femoral_thickness();
  return {{cartilage, box_about_centre(spheres.femoral + room_around), {}},
          [cartilage](const Vec3& p) { return cartilage.border_distance(p); }};
}

Cartilage acetabular_cartilage_shape(const HipParameters& hip, const CartilageParameters& parameters) {
  const ArticularSpheres spheres = articular_spheres(hip, parameters);
  const Socket socket = socket_of(hip);
  const double scale = spheres.socket / nominal_socket_radius;
  AcetabularCartilagePieces cartilage;
  cartilage.hip_bone = hip_bone_shape(hip).field;
  cartilage.surface = {Vec3::Zero(), spheres.acetabular};
  cartilage.socket_radius = spheres.socket;
  cartilage.outermost = {Vec3::Zero(), spheres.socket + 2 * scale};
  cartilage.opening = socket.opening;
  cartilage.rim_offset = socket.rim_offset;
  cartilage.labrum_radius = 3.5 * scale;
  cartilage.labrum_seam = 3 * scale;
  const double level = socket.rim_offset + 1.5 * scale;
  cartilage.rim = {level * socket.opening, socket.opening,
                   std::sqrt(spheres.socket * spheres.socket - level * level) + 1 * scale};
  cartilage.fossa_top = {-spheres.socket * socket.opening, 11 * scale};
  cartilage.fossa_bottom = {spheres.socket * (-0.75 * socket.opening + 0.66 * socket.notch), 8 * scale};
  cartilage.seam = rounding * std::min(spheres.acetabular_thickness(), 2.0 * scale);
  return {{cartilage, box_about_centre(spheres.socket + 2 * cartilage.labrum_radius + room_around), {}},
          [cartilage](const Vec3& p) { return cartilage.border_distance(p); }};
}

}  // namespace condyle::sample
