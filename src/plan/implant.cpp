#include "condyle/implant.hpp"

#include <array>
#include <cmath>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/trigonometry.hpp"
#include "plan/implant_limits.hpp"
#include "plan/implant_shape.hpp"

namespace condyle::plan {
namespace {

/// As people write it: 40, where the angle in radians has 39.99999999999999.
double written_degrees(Angle angle) noexcept {
  return std::round(angle.degrees() * 1e9) / 1e9;
}

template <auto member>
struct SizeOf;

template <class Design, double Design::*member>
struct SizeOf<member> {
  static double value(const Implant& implant) { return std::get<Design>(implant).*member; }
  static void set(Implant& implant, double value) { std::get<Design>(implant).*member = value; }
};

template <class Design, Angle Design::*member>
struct SizeOf<member> {
  static double value(const Implant& implant) { return written_degrees(std::get<Design>(implant).*member); }
  static void set(Implant& implant, double value) {
    std::get<Design>(implant).*member = Angle::degrees(value);
  }
};

template <Angle CupAngles::*member>
struct CupAngle {
  static double value(const Implant& implant) {
    return written_degrees(std::get<TotalHip>(implant).cup.*member);
  }
  static void set(Implant& implant, double value) {
    std::get<TotalHip>(implant).cup.*member = Angle::degrees(value);
  }
};

template <class Access>
ImplantParameter parameter(std::string_view name, std::string_view unit, double low, double high,
                           std::string_view meaning) {
  return {name, unit, meaning, low, high, &Access::value, &Access::set};
}

std::span<const ImplantParameter> hip_sizes() noexcept {
  using T = TotalHip;
  static const std::array all{
      parameter<CupAngle<&CupAngles::inclination>>("inclination", "deg", 0, 90,
                                                   "Inclination of the cup, by the definition"),
      parameter<CupAngle<&CupAngles::anteversion>>("anteversion", "deg", -60, 75,
                                                   "Anteversion of the cup, by the definition"),
      parameter<SizeOf<&T::neck_shaft>>("neck_shaft", "deg", 110, 160, "Angle between neck and stem"),
      parameter<SizeOf<&T::stem_version>>("stem_version", "deg", -30, 60, "Anteversion of the stem's neck"),
      parameter<SizeOf<&T::head_radius_mm>>("head_radius", "mm", 9, 40,
                                            "Radius of the liner inside, and of its head"),
      parameter<SizeOf<&T::clearance_mm>>(
          "clearance", "mm", 0.2, 3, "By which the mesh of the head is smaller, so that it never touches"),
      parameter<SizeOf<&T::neck_radius_mm>>("neck_radius", "mm", 2, 20,
                                            "Radius of the neck at the centre of the head"),
      parameter<SizeOf<&T::neck_taper>>("neck_taper", "deg", -8, 15,
                                        "Half-angle of a conical neck that widens towards the stem"),
      parameter<SizeOf<&T::neck_upper_width_mm>>("neck_upper_width", "mm", 0, 40,
                                                 "Width of a trapezoid neck above; 0: the neck is round"),
      parameter<SizeOf<&T::neck_lower_width_mm>>("neck_lower_width", "mm", 0, 40,
                                                 "Width of a trapezoid neck below"),
      parameter<SizeOf<&T::liner_half_angle>>("liner_half_angle", "deg", 50, 120,
                                              "How far the liner reaches from its pole; 90: half a ball"),
      parameter<SizeOf<&T::chamfer>>(
          "chamfer", "deg", -30, 30,
          "How far the rim's outer edge lies behind the inner one, seen from the centre"),
      parameter<SizeOf<&T::lip>>("lip", "deg", 0, 30, "How far the rim is raised where its lip is highest"),
      parameter<SizeOf<&T::lip_towards>>("lip_towards", "deg", -180, 180,
                                         "Where on the rim the lip is highest, from the top backwards"),
      parameter<SizeOf<&T::lip_width>>("lip_width", "deg", 20, 360, "How much of the rim the lip takes"),
      parameter<SizeOf<&T::cup_radius_mm>>("cup_radius", "mm", 12, 45, "Radius of the cup outside"),
      parameter<SizeOf<&T::offset_mm>>("offset", "mm", 20, 80,
                                       "Distance from the centre of the head to the axis of the stem"),
      parameter<SizeOf<&T::stem_radius_mm>>("stem_radius", "mm", 3, 10, "Radius of the stem"),
      parameter<SizeOf<&T::stem_length_mm>>("stem_length", "mm", 30, 250,
                                            "Length of the stem below the axis of the neck"),
      parameter<SizeOf<&T::leg_length_mm>>("leg_length", "mm", -30, 30,
                                           "By which the leg becomes longer: moves the bone of the femur"),
  };
  return all;
}

std::span<const ImplantParameter> shoulder_sizes() noexcept {
  using T = ReverseShoulder;
  static const std::array all{
      parameter<SizeOf<&T::glenoid_inclination>>("glenoid_inclination", "deg", -45, 45,
                                                 "Inclination of the glenoid, upwards"),
      parameter<SizeOf<&T::glenoid_version>>("glenoid_version", "deg", -45, 45,
                                             "Version of the glenoid, forwards"),
      parameter<SizeOf<&T::neck_shaft>>("neck_shaft", "deg", 110, 170,
                                        "Angle between the cup's axis and the stem"),
      parameter<SizeOf<&T::retroversion>>("retroversion", "deg", -45, 90, "Retroversion of the cup's axis"),
      parameter<SizeOf<&T::head_radius_mm>>("head_radius", "mm", 12, 30,
                                            "Radius of the cup inside, and of its ball"),
      parameter<SizeOf<&T::clearance_mm>>(
          "clearance", "mm", 0.2, 3, "By which the mesh of the ball is smaller, so that it never touches"),
      parameter<SizeOf<&T::neck_radius_mm>>("neck_radius", "mm", 2, 20, "Radius of the pillar of the ball"),
      parameter<SizeOf<&T::neck_taper>>("neck_taper", "deg", -8, 15,
                                        "Half-angle of a conical pillar that widens towards the scapula"),
      parameter<SizeOf<&T::liner_half_angle>>("liner_half_angle", "deg", 30, 100,
                                              "How far the cup reaches from its pole; 90: half a ball"),
      parameter<SizeOf<&T::chamfer>>(
          "chamfer", "deg", -30, 30,
          "How far the rim's outer edge lies behind the inner one, seen from the centre"),
      parameter<SizeOf<&T::cup_radius_mm>>("cup_radius", "mm", 14, 45, "Radius of the cup outside"),
      parameter<SizeOf<&T::pillar_length_mm>>("pillar_length", "mm", 20, 60,
                                              "Length of the pillar, from the centre of the ball"),
      parameter<SizeOf<&T::stem_radius_mm>>("stem_radius", "mm", 3, 10, "Radius of the stem"),
      parameter<SizeOf<&T::stem_length_mm>>("stem_length", "mm", 30, 200, "Length of the stem below the cup"),
  };
  return all;
}

std::string implant_line(std::string_view what) {
  return "implant: " + std::string(what);
}

/// Liner, ball and neck of either implant.
struct Sizes {
  LinerShape liner;
  NeckShape neck;
  double ball_radius_mm, neck_end_mm;
  const char* neck_end_by;  ///< the size that decides it
  int facets;
};

Sizes sizes_of(const TotalHip& hip) {
  return {{hip.head_radius_mm, hip.cup_radius_mm, hip.liner_half_angle, hip.chamfer},
          {hip.neck_radius_mm, hip.neck_taper},
          hip.head_radius_mm - hip.clearance_mm,
          plan::neck_end_mm(hip),
          "offset",
          hip.facets};
}

Sizes sizes_of(const ReverseShoulder& shoulder) {
  return {{shoulder.head_radius_mm, shoulder.cup_radius_mm, shoulder.liner_half_angle, shoulder.chamfer},
          {shoulder.neck_radius_mm, shoulder.neck_taper},
          shoulder.head_radius_mm - shoulder.clearance_mm,
          shoulder.pillar_length_mm,
          "pillar_length",
          shoulder.facets};
}

void check_ranges(const Implant& implant) {
  for (const ImplantParameter& each : implant_parameters(implant)) {
    const double value = each.value(implant);
    if (value >= each.low && value <= each.high) continue;
    throw UsageError(implant_line(each.name) + core::formatted(" is %g, must be %g to %g %s", value, each.low,
                                                               each.high,
                                                               each.unit == "deg" ? "degrees" : "mm"));
  }
}

void check_sizes(const Sizes& sizes) {
  const auto refuse = [](const std::string& what) { throw UsageError(implant_line(what)); };
  constexpr int fewest = 24, most = 2880;
  if (sizes.facets < fewest || sizes.facets > most || sizes.facets % 4 != 0)
    refuse(
        core::formatted("facets is %d, must be a multiple of 4 from %d to %d", sizes.facets, fewest, most));
  const LinerShape& liner = sizes.liner;
  constexpr double thinnest = 1;
  if (liner.outer_radius_mm < liner.radius_mm + thinnest)
    refuse(core::formatted(
        "a head of radius %g mm is too large for a cup of radius %g mm outside: its wall needs %g mm",
        liner.radius_mm, liner.outer_radius_mm, thinnest));
  const double chamfer_cosine = core::sine_cosine(liner.chamfer.radians()).cosine;
  if (chamfer_cosine * liner.outer_radius_mm <= liner.radius_mm)
    refuse(core::formatted(
        "a chamfer of %g degrees is too much for walls from %g to %g mm: it would run into the head",
        written_degrees(liner.chamfer), liner.radius_mm, liner.outer_radius_mm));
  const double t = core::tangent(sizes.neck.taper.radians());
  const double at_end = sizes.neck.radius_mm + t * sizes.neck_end_mm;
  constexpr double thinnest_neck = 1;
  if (sizes.neck.radius_mm + t * sizes.ball_radius_mm >= sizes.ball_radius_mm)
    refuse(core::formatted("the neck, of radius %g mm, is thicker than the head, of radius %g mm",
                           sizes.neck.radius_mm + t * sizes.ball_radius_mm, sizes.ball_radius_mm));
  if (at_end < thinnest_neck)
    refuse(core::formatted("a taper of %g degrees leaves the neck a radius of %g mm at its end",
                           written_degrees(sizes.neck.taper), at_end));
  constexpr double beyond = 2;
  // The neck ends in a plane: its end is beyond the cup all over if its middle is.
  if (sizes.neck_end_mm < liner.outer_radius_mm + beyond)
    refuse(
        core::formatted("the neck ends %.3g mm from the centre of the head, too near to a cup of radius %g "
                        "mm outside: it must end %g mm beyond, by a larger %s",
                        sizes.neck_end_mm, liner.outer_radius_mm, beyond, sizes.neck_end_by));
  if (!(contact_half_angle(liner, sizes.neck) > Angle::degrees(1)))
    refuse("the neck is too thick for the opening of the liner: both would always be in contact");
}

void check_design(const TotalHip& hip) {
  const auto refuse = [](const std::string& what) { throw UsageError(implant_line(what)); };
  if ((hip.neck_upper_width_mm > 0) != (hip.neck_lower_width_mm > 0))
    refuse("a trapezoid neck has both widths, neck_upper_width and neck_lower_width");
  if (hip.neck_upper_width_mm > 0) {
    const double farthest =
        core::hypotenuse(hip.neck_radius_mm, std::max(hip.neck_upper_width_mm, hip.neck_lower_width_mm) / 2);
    if (farthest + core::tangent(hip.neck_taper.radians()) * hip.head_radius_mm >=
        hip.head_radius_mm - hip.clearance_mm)
      refuse(core::formatted(
          "the neck, whose corners are %.3g mm from its axis, is thicker than the head, of radius %g mm",
          farthest, hip.head_radius_mm - hip.clearance_mm));
  }
  if (hip.lip > Angle()) {
    LinerShape raised{hip.head_radius_mm, hip.cup_radius_mm, hip.liner_half_angle + hip.lip, hip.chamfer};
    if (raised.half_angle > Angle::degrees(150) ||
        !(contact_half_angle(raised, {hip.neck_radius_mm, hip.neck_taper}) > Angle::degrees(1)))
      refuse("the lip leaves no opening for the neck");
  }
}

void check_design(const ReverseShoulder&) {}

}  // namespace

std::string_view name_of(const Implant& implant) noexcept {
  return std::holds_alternative<TotalHip>(implant) ? "total_hip" : "reverse_shoulder";
}

std::span<const ImplantParameter> implant_parameters(const Implant& implant) noexcept {
  return std::holds_alternative<TotalHip>(implant) ? hip_sizes() : shoulder_sizes();
}

void check_implant(const Implant& implant) {
  if (const auto* hip = std::get_if<TotalHip>(&implant); hip != nullptr && hip->clearance_mm <= 0)
    throw UsageError(implant_line(
        core::formatted("a clearance of %g mm makes the head larger than the liner", hip->clearance_mm)));
  check_ranges(implant);
  std::visit(
      [](const auto& design) {
        check_sizes(sizes_of(design));
        check_design(design);
      },
      implant);
}

std::string why_not_revolved(const Implant& implant) {
  const auto* hip = std::get_if<TotalHip>(&implant);
  if (hip == nullptr) return {};
  if (hip->lip > Angle()) return "a liner with a lip is no body of revolution";
  if (hip->neck_upper_width_mm > 0) return "a trapezoid neck is no body of revolution";
  return {};
}

std::optional<RevolvedPair> revolved_pair(const Implant& implant, Side side) {
  check_implant(implant);
  if (!why_not_revolved(implant).empty()) return std::nullopt;
  const ImplantAxes axes = plan::axes_of(implant, side);
  const Sizes sizes = std::visit([](const auto& design) { return sizes_of(design); }, implant);
  const HalfAngles half = plan::half_angles(sizes.liner, sizes.neck, sizes.facets);
  const bool is_hip = std::holds_alternative<TotalHip>(implant);
  return RevolvedPair{is_hip ? axes.liner : axes.neck, is_hip ? axes.neck : axes.liner, half.exact,
                      half.of_facets_low, half.of_facets_high};
}

}  // namespace condyle::plan
