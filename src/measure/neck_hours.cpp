#include "measure/neck_hours.hpp"

#include <cmath>

#include "core/formatted.hpp"
#include "core/parallel.hpp"
#include "measure/alpha_angle.hpp"
#include "measure/near_part.hpp"

namespace condyle::measure {
namespace {

/// Sine of one degree.
constexpr double smallest_sine = 0.0175;

/// The alpha angle is largest here in cams: from 11 to 4 o'clock.
constexpr double first_hour = 11, last_hour = 4;

void set_doubt(NeckHour& hour) {
  hour.is_doubtful = hour.alpha_deg && hour.alpha_at_1mm_deg &&
                     std::abs(*hour.alpha_deg - *hour.alpha_at_1mm_deg) > alpha_doubt_deg;
}

/// One side of a plane; `beside` is how far the circle's centre is towards that side.
NeckHour on_side(const Contour& half, const std::optional<CircleFit>& fit, double beside, double hour,
                 double turn, const AxisSections& sections, double head_radius) {
  NeckHour out{};
  out.hour = hour;
  if (const auto narrow = neck_ends(half, head_radius) ? std::nullopt : narrowest_neck(half, head_radius)) {
    out.offset_mm = head_radius - narrow->y();
    out.offset_point = sections.point(turn, *narrow);
  }
  if (!fit) {
    out.why_no_alpha = out.why_no_alpha_at_1mm = "too little of the head's circle is in this plane";
    return out;
  }
  const Circle circle{{fit->circle.centre.x(), beside}, fit->circle.radius};
  out.circle_along_mm = circle.centre.x(), out.circle_beside_mm = beside;
  out.circle_radius_mm = circle.radius, out.circle_rms_mm = fit->rms_residual;
  AlphaFinding at_half = alpha_angle(half, circle, head_radius, by_head(alpha_tolerances_mm[0], head_radius));
  AlphaFinding at_one = alpha_angle(half, circle, head_radius, by_head(alpha_tolerances_mm[1], head_radius));
  out.why_no_alpha = std::move(at_half.why_none), out.why_no_alpha_at_1mm = std::move(at_one.why_none);
  if (at_half.alpha) {
    out.alpha_deg = at_half.alpha->alpha_deg;
    out.outside_again_deg = at_half.alpha->outside_again_deg;
    out.alpha_point = sections.point(turn, at_half.alpha->point);
  }
  if (at_one.alpha) out.alpha_at_1mm_deg = at_one.alpha->alpha_deg;
  set_doubt(out);
  return out;
}

Measure alpha_at(const NeckHour& hour) {
  Measure out = measured_or(hour.alpha_deg, hour.why_no_alpha);
  if (hour.is_doubtful)
    add_note(out, core::formatted("%.1f at a tolerance of 1 mm: the contour leaves its circle slowly",
                                  *hour.alpha_at_1mm_deg));
  if (hour.outside_again_deg)
    add_note(out,
             core::formatted("the contour is outside its circle again up to %.1f", *hour.outside_again_deg));
  return out;
}

bool is_in_front(const NeckHour& hour) {
  return hour.hour >= first_hour || hour.hour <= last_hour;
}

}  // namespace

std::optional<motion::ClockFace> clock_about(const Vec3& axis, const Vec3& up, const Vec3& anterior) {
  const Vec3 twelve = up - up.dot(axis) * axis;
  if (!(twelve.norm() > smallest_sine)) return std::nullopt;
  const Vec3 three = axis.cross(twelve.normalized());
  return motion::ClockFace{twelve.normalized(), three.dot(anterior) > 0 ? three : Vec3(-three)};
}

std::vector<NeckHour> around_neck(const TriMesh& femur, const NeckGeometry& neck,
                                  const std::vector<char>& ends) {
  const double radius = neck.head.radius;
  const MeshPart near = near_part(femur, {neck.head.centre, 1.01 * neck_reach * radius});
  std::vector<char> marks;
  for (const Index v : near.vertices) marks.push_back(ends[v]);
  const AxisSections sections(near.mesh, neck.head.centre, neck.direction, neck.clock.twelve,
                              neck.clock.three, std::move(marks));
  std::vector<NeckHour> hours(neck_steps);
  const auto set_plane = [&](std::size_t k) {
    const std::size_t other = k + neck_steps / 2;
    const auto hour = [](std::size_t step) { return 12.0 * static_cast<double>(step) / neck_steps; };
    const double turn = two_pi * static_cast<double>(k) / neck_steps;
    Contour section = sections.at(turn);
    std::erase_if(section, [](const ContourPiece& piece) { return piece.from_end && piece.to_end; });
    const auto fit = head_circle(section, radius);
    const double beside = fit ? fit->circle.centre.y() : 0;
    hours[k] = on_side(upper_half(section), fit, beside, hour(k), turn, sections, radius);
    hours[other] =
        on_side(lower_half(section), fit, -beside, hour(other), turn + two_pi / 2, sections, radius);
  };
  core::parallel_chunks(neck_steps / 2, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) set_plane(k);
  });
  return hours;
}

namespace {

struct Largest {
  const NeckHour* hour = nullptr;
  std::optional<double> alpha_deg;
  int places = 0, without = 0;

  void add(const NeckHour& at, const std::optional<double>& alpha) {
    ++places;
    if (!alpha) return void(++without);
    if (!alpha_deg || *alpha > *alpha_deg) hour = &at, alpha_deg = alpha;
  }
  std::string note() const {
    return without == 0 ? std::string()
                        : core::formatted("none at %d of %d places from 11 to 4 o'clock", without, places);
  }
};

void set_largest(const std::vector<NeckHour>& hours, FemurMeasures& out) {
  Largest at_half, at_1mm;
  for (const NeckHour& hour : hours) {
    if (!is_in_front(hour)) continue;
    at_half.add(hour, hour.alpha_deg), at_1mm.add(hour, hour.alpha_at_1mm_deg);
  }
  const std::string none = "there is no alpha angle between 11 and 4 o'clock";
  out.alpha_largest = at_half.hour ? alpha_at(*at_half.hour) : not_measured(none);
  out.alpha_largest_hour = at_half.hour ? measured(at_half.hour->hour) : not_measured(none);
  out.alpha_largest_at_1mm = measured_or(at_1mm.alpha_deg, none);
  add_note(out.alpha_largest, at_half.note()), add_note(out.alpha_largest_hour, at_half.note());
  add_note(out.alpha_largest_at_1mm, at_1mm.note());
}

void set_offset(const NeckHour& hour, double head_radius, Measure& offset, Measure& ratio) {
  const std::string no_neck = "the neck's contour is not in this plane, or not to its end";
  offset = measured_or(hour.offset_mm, no_neck);
  ratio = hour.offset_mm ? measured(*hour.offset_mm / (2 * head_radius)) : not_measured(no_neck);
}

}  // namespace

void set_alpha(const std::vector<NeckHour>& hours, double head_radius, FemurMeasures& out) {
  const NeckHour &at_12 = hours[neck_step(0)], &at_1_30 = hours[neck_step(1.5)], &at_3 = hours[neck_step(3)];
  out.alpha_12 = alpha_at(at_12), out.alpha_1_30 = alpha_at(at_1_30), out.alpha_3 = alpha_at(at_3);
  out.alpha_12_at_1mm = measured_or(at_12.alpha_at_1mm_deg, at_12.why_no_alpha_at_1mm);
  out.alpha_1_30_at_1mm = measured_or(at_1_30.alpha_at_1mm_deg, at_1_30.why_no_alpha_at_1mm);
  out.alpha_3_at_1mm = measured_or(at_3.alpha_at_1mm_deg, at_3.why_no_alpha_at_1mm);
  set_largest(hours, out);
  set_offset(at_12, head_radius, out.offset_12, out.offset_ratio_12);
  set_offset(at_1_30, head_radius, out.offset_1_30, out.offset_ratio_1_30);
  set_offset(at_3, head_radius, out.offset_3, out.offset_ratio_3);
}

std::vector<Measure*> alpha_measures(FemurMeasures& femur) {
  return {&femur.alpha_12,        &femur.alpha_1_30,         &femur.alpha_3,
          &femur.alpha_12_at_1mm, &femur.alpha_1_30_at_1mm,  &femur.alpha_3_at_1mm,
          &femur.alpha_largest,   &femur.alpha_largest_hour, &femur.alpha_largest_at_1mm};
}

std::vector<Measure*> clock_measures(FemurMeasures& femur) {
  std::vector<Measure*> measures = alpha_measures(femur);
  for (Measure* offset : {&femur.offset_12, &femur.offset_1_30, &femur.offset_3, &femur.offset_ratio_12,
                          &femur.offset_ratio_1_30, &femur.offset_ratio_3})
    measures.push_back(offset);
  return measures;
}

}  // namespace condyle::measure
