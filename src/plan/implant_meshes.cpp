#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "condyle/implant.hpp"
#include "core/trigonometry.hpp"
#include "mesh/enclosed_volume.hpp"
#include "plan/implant_shape.hpp"

namespace condyle::plan {
namespace {

using core::sine_cosine;

/// Between meshes that join, mm: more than what their facets sag.
constexpr double joint_gap_mm = 0.05;

/// An axis through the centre with two directions across it: `up` towards Y, `beside` = axis x up.
struct AxisAcross {
  Vec3 axis, up, beside;

  explicit AxisAcross(const Vec3& along) : axis(along) {
    const Vec3 reference = std::abs(axis.y()) < 0.999 ? Vec3::UnitY() : Vec3::UnitX();
    up = (reference - reference.dot(axis) * axis).normalized();
    beside = axis.cross(up);
  }

  Vec3 at(double along, double radius, double turn) const {
    const auto [sine, cosine] = sine_cosine(turn);
    return along * axis + radius * (cosine * up + sine * beside);
  }
};

using Ring = std::vector<Vec3>;

/// A closed mesh from a point over rings of as many points each to another point.
TriMesh lofted(const Vec3& first, const std::vector<Ring>& rings, const Vec3& last) {
  TriMesh mesh;
  mesh.vertices.push_back(first);
  for (const Ring& ring : rings)
    for (const Vec3& p : ring) mesh.vertices.push_back(p);
  mesh.vertices.push_back(last);
  const auto around = static_cast<Index>(rings.front().size());
  const auto vertex = [&](std::size_t ring, Index i) {
    return static_cast<Index>(1 + static_cast<Index>(ring) * around + i % around);
  };
  const auto end = static_cast<Index>(mesh.vertices.size() - 1);
  for (Index i = 0; i < around; ++i) mesh.triangles.push_back({0, vertex(0, i + 1), vertex(0, i)});
  for (std::size_t r = 0; r + 1 < rings.size(); ++r)
    for (Index i = 0; i < around; ++i) {
      mesh.triangles.push_back({vertex(r, i), vertex(r, i + 1), vertex(r + 1, i)});
      mesh.triangles.push_back({vertex(r, i + 1), vertex(r + 1, i + 1), vertex(r + 1, i)});
    }
  for (Index i = 0; i < around; ++i)
    mesh.triangles.push_back({end, vertex(rings.size() - 1, i), vertex(rings.size() - 1, i + 1)});
  if (mesh::is_inside_out(mesh))
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// The other side: Z negated, triangles turned round.
void put_on_side(TriMesh& mesh, Side side) {
  if (side == Side::right) return;
  for (double& z : mesh.vertices.z) z = -z;
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

Ring ring_of(int facets, const std::function<Vec3(int i, double turn)>& at) {
  Ring ring;
  for (int i = 0; i < facets; ++i) ring.push_back(at(i, two_pi * i / facets));
  return ring;
}

/// A ball about the centre. Its facets are degrees wide whatever those of liner and neck: nothing touches it.
TriMesh ball_mesh(const AxisAcross& frame, double radius) {
  constexpr int around = 120, rings = 59;
  std::vector<Ring> all;
  for (int r = 1; r <= rings; ++r) {
    const core::SineCosine from_pole = sine_cosine(two_pi / 2 * r / (rings + 1));
    all.push_back(ring_of(around, [&](int, double turn) {
      return frame.at(radius * from_pole.cosine, radius * from_pole.sine, turn);
    }));
  }
  return lofted(radius * frame.axis, all, -radius * frame.axis);
}

/// The liner with its cup. `rim` gives the half-angle from the pole at each turn about the axis.
TriMesh liner_mesh(const AxisAcross& frame, const LinerShape& liner, int facets,
                   const std::function<Angle(double turn)>& rim) {
  constexpr int steps = 30;
  std::vector<Ring> rings;
  const auto add = [&](double radius, double share, Angle less) {
    rings.push_back(ring_of(facets, [&](int, double turn) {
      const auto [sine, cosine] = sine_cosine(((rim(turn) - less) * share).radians());
      return frame.at(-radius * cosine, radius * sine, turn);
    }));
  };
  for (int i = 1; i <= steps; ++i) add(liner.radius_mm, static_cast<double>(i) / steps, {});
  for (int i = steps; i >= 1; --i) add(liner.outer_radius_mm, static_cast<double>(i) / steps, liner.chamfer);
  return lofted(-liner.radius_mm * frame.axis, rings, -liner.outer_radius_mm * frame.axis);
}

/// A section of a neck at the centre of the head, around: in the plane of `up` and `beside`.
struct SectionPoint {
  double up, beside;
};

/// From just outside the ball, whose shape its end has, to a plane across its axis.
TriMesh neck_mesh(const AxisAcross& frame, const std::vector<SectionPoint>& section, const NeckShape& neck,
                  double ball_radius, double end) {
  const auto [ts, tc] = sine_cosine(neck.taper.radians());
  const double t = ts / tc / neck.radius_mm, start = ball_radius + joint_gap_mm;
  constexpr int steps = 16;
  Ring on_ball, at_end;
  for (const auto& [up, beside] : section) {
    const Vec3 across = up * frame.up + beside * frame.beside;
    const double a = across.norm(), slope = a * t;
    // z^2 + (a + slope z)^2 = start^2
    const double q = 1 + slope * slope;
    const double z = (std::sqrt(start * start * q - a * a) - a * slope) / q;
    on_ball.push_back(z * frame.axis + (1 + t * z) * across);
    at_end.push_back(end * frame.axis + (1 + t * end) * across);
  }
  std::vector<Ring> rings;
  for (int i = 1; i < steps; ++i) {
    Ring inner;
    for (const Vec3& p : on_ball) {
      const Vec3 across = p - p.dot(frame.axis) * frame.axis;
      const auto [sine, cosine] = sine_cosine(core::arctangent(across.norm(), p.dot(frame.axis)) * i / steps);
      inner.push_back(start * (cosine * frame.axis + sine * across.normalized()));
    }
    rings.push_back(std::move(inner));
  }
  rings.push_back(on_ball);
  rings.push_back(at_end);
  return lofted(start * frame.axis, rings, end * frame.axis);
}

std::vector<SectionPoint> round_section(double radius, int facets) {
  std::vector<SectionPoint> section;
  for (int i = 0; i < facets; ++i) {
    const auto [sine, cosine] = sine_cosine(two_pi * i / facets);
    section.push_back({radius * cosine, radius * sine});
  }
  return section;
}

std::vector<SectionPoint> trapezoid_section(const TotalHip& hip) {
  const double h = hip.neck_radius_mm, upper = hip.neck_upper_width_mm / 2,
               lower = hip.neck_lower_width_mm / 2;
  const SectionPoint corners[] = {{h, -upper}, {h, upper}, {-h, lower}, {-h, -lower}};
  std::vector<SectionPoint> section;
  const int side = hip.facets / 4;
  for (int c = 0; c < 4; ++c)
    for (int i = 0; i < side; ++i) {
      const double s = static_cast<double>(i) / side;
      const SectionPoint &a = corners[c], &b = corners[(c + 1) % 4];
      section.push_back({a.up + s * (b.up - a.up), a.beside + s * (b.beside - a.beside)});
    }
  return section;
}

/// A stem: a tube of round sections along a parabola from `start` in the sense of `along` to the axis of the stem, then straight on. All of it is
/// farther from the centre than the cup, which it never reaches.
TriMesh stem_mesh(const Vec3& start, const Vec3& along, double bend, double first_radius, double radius,
                  double length, const Vec3& down) {
  constexpr int around = 72, in_bend = 20, in_shaft = 8;
  constexpr double tip_share = 0.6;
  const Vec3 corner = start + bend * along;
  const Vec3 across = along.cross(down).normalized();
  std::vector<Ring> rings;
  const auto add = [&](const Vec3& middle, const Vec3& tangent, double r) {
    const Vec3 side = tangent.normalized().cross(across);
    rings.push_back(ring_of(around, [&](int, double turn) {
      const auto [sine, cosine] = sine_cosine(turn);
      return Vec3(middle + r * (cosine * across + sine * side));
    }));
  };
  for (int i = 0; i <= in_bend; ++i) {
    const double s = static_cast<double>(i) / in_bend;
    const Vec3 middle = (1 - s) * (1 - s) * start + 2 * s * (1 - s) * corner + s * s * (corner + bend * down);
    add(middle, (1 - s) * along + s * down, first_radius + s * (radius - first_radius));
  }
  for (int i = 1; i <= in_shaft; ++i) {
    const double s = static_cast<double>(i) / in_shaft;
    add(corner + (bend + s * (length - bend)) * down, down, radius * (1 + s * (tip_share - 1)));
  }
  return lofted(start, rings, corner + length * down);
}

ImplantMeshes meshes_of(const TotalHip& hip, const Vec3& stem_down) {
  const ImplantAxes axes = plan::axes_of(hip, Side::right);
  const AxisAcross cup(axes.liner), neck(axes.neck);
  const LinerShape liner{hip.head_radius_mm, hip.cup_radius_mm, hip.liner_half_angle, hip.chamfer};
  // The turn that `beside` gives a positive sense is backwards on a right hip.
  const double sense = cup.beside.x() <= 0 ? 1 : -1;
  const auto rim = [&](double turn) {
    if (hip.lip == Angle()) return hip.liner_half_angle;
    double from_lip = std::remainder(sense * turn - hip.lip_towards.radians(), two_pi);
    from_lip = std::min(1.0, std::abs(from_lip) / (hip.lip_width.radians() / 2));
    const double cosine = sine_cosine(from_lip * two_pi / 4).cosine;
    return hip.liner_half_angle + hip.lip * (cosine * cosine);
  };
  const NeckShape shape{hip.neck_radius_mm, hip.neck_taper};
  const double end = plan::neck_end_mm(hip), ball = hip.head_radius_mm - hip.clearance_mm;
  const std::vector<SectionPoint> section =
      hip.neck_upper_width_mm > 0 ? trapezoid_section(hip) : round_section(hip.neck_radius_mm, hip.facets);
  ImplantMeshes made;
  made.fixed.push_back({"liner", liner_mesh(cup, liner, hip.facets, rim)});
  made.mobile.push_back({"head", ball_mesh(neck, ball)});
  made.mobile.push_back({"neck", neck_mesh(neck, section, shape, ball, end - joint_gap_mm)});
  made.mobile.push_back(
      {"stem", stem_mesh((end + joint_gap_mm) * neck.axis, neck.axis, plan::stem_bend_mm(hip) - joint_gap_mm,
                         std::min(hip.stem_radius_mm, hip.neck_radius_mm), hip.stem_radius_mm,
                         hip.stem_length_mm, stem_down)});
  return made;
}

ImplantMeshes meshes_of(const ReverseShoulder& shoulder, const Vec3& stem_down) {
  const ImplantAxes axes = plan::axes_of(shoulder, Side::right);
  const AxisAcross cup(axes.liner), pillar(axes.neck);
  const LinerShape liner{shoulder.head_radius_mm, shoulder.cup_radius_mm, shoulder.liner_half_angle,
                         shoulder.chamfer};
  const double ball = shoulder.head_radius_mm - shoulder.clearance_mm;
  const double stem_start = shoulder.cup_radius_mm + joint_gap_mm;
  ImplantMeshes made;
  made.fixed.push_back({"head", ball_mesh(pillar, ball)});
  made.fixed.push_back(
      {"pillar", neck_mesh(pillar, round_section(shoulder.neck_radius_mm, shoulder.facets),
                           {shoulder.neck_radius_mm, shoulder.neck_taper}, ball, shoulder.pillar_length_mm)});
  made.mobile.push_back(
      {"liner", liner_mesh(cup, liner, shoulder.facets, [&](double) { return shoulder.liner_half_angle; })});
  made.mobile.push_back(
      {"stem", stem_mesh(-stem_start * cup.axis, -cup.axis, plan::least_stem_bend_mm, shoulder.stem_radius_mm,
                         shoulder.stem_radius_mm, shoulder.stem_length_mm, stem_down)});
  return made;
}

/// Along the neck from the centre of the head to the stem's axis.
double neck_length_mm(const TotalHip& hip) {
  return hip.offset_mm / sine_cosine(hip.neck_shaft.radians()).sine;
}

}  // namespace

ImplantAxes axes_of(const Implant& implant, Side side) {
  if (const auto* hip = std::get_if<TotalHip>(&implant))
    return {cup_axis(hip->cup, side), neck_axis(hip->neck_shaft, hip->stem_version, side)};
  const auto& shoulder = std::get<ReverseShoulder>(implant);
  // R_y(version) R_x(-inclination) Z is where the glenoid faces; the pillar goes the other way.
  const auto [si, ci] = sine_cosine(shoulder.glenoid_inclination.radians());
  const auto [sv, cv] = sine_cosine(shoulder.glenoid_version.radians());
  // R_y(retroversion) (0, cos(180 - neck_shaft), -sin(180 - neck_shaft)).
  const auto [sn, cn] = sine_cosine(shoulder.neck_shaft.radians());
  const auto [sr, cr] = sine_cosine(shoulder.retroversion.radians());
  Vec3 pillar(-sv * ci, -si, -cv * ci), liner(-sr * sn, -cn, -cr * sn);
  if (side == Side::left) pillar.z() = -pillar.z(), liner.z() = -liner.z();
  return {liner, pillar};
}

double neck_end_mm(const TotalHip& hip) {
  // Beyond the cup, and not farther than leaves room for the bend.
  constexpr double share = 0.6, beyond_cup = 3;
  const double length = neck_length_mm(hip);
  return std::min(std::max(share * length, hip.cup_radius_mm + beyond_cup), length - least_stem_bend_mm);
}

double stem_bend_mm(const TotalHip& hip) {
  return neck_length_mm(hip) - neck_end_mm(hip);
}

ImplantMeshes implant_meshes(const Implant& implant, Side side, const Vec3& stem_down) {
  check_implant(implant);
  ImplantMeshes made = std::visit([&](const auto& design) { return meshes_of(design, stem_down); }, implant);
  for (auto* body : {&made.fixed, &made.mobile})
    for (ImplantMesh& each : *body) put_on_side(each.mesh, side);
  return made;
}

NeckCut neck_cut(const TotalHip& hip, Side side) {
  const Vec3 axis = neck_axis(hip.neck_shaft, hip.stem_version, side);
  return {axis, plan::neck_end_mm(hip), neck_length_mm(hip) * axis};
}

}  // namespace condyle::plan
