#include "condyle/range_of_motion.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "interrupts.hpp"
#include "io/joint/known_motions.hpp"
#include "io/result/caveats.hpp"
#include "io/result/rom_result.hpp"
#include "motion.hpp"

namespace condyle::python {
namespace {

motion::RangeOptions options_in(const JointHandle& handle, const py::dict& given) {
  motion::RangeOptions options;
  if (given["count_bearing"].cast<bool>()) options.bearing.rule = motion::BearingRule::count;
  options.bearing.margin_mm = given["bearing_margin_mm"].cast<std::optional<double>>();
  options.overlap.reference_pose = handle.loaded.report.placement.reference_pose.angles;
  if (given["accept_reference_contact"].cast<bool>())
    options.overlap.reference_contact = motion::ReferenceContact::accept;
  if (const auto rings = given["leave_out_rings"].cast<std::optional<int>>())
    options.overlap.leave_out_reference_contacts = motion::LeaveOutReferenceContacts{*rings};
  return options;
}

std::unique_ptr<RangeHandle> ready(const JointHandle& handle, const py::object& translation_mm,
                                   const py::dict& given) {
  std::optional<Vec3> requested;
  if (!translation_mm.is_none()) requested = vector_in(translation_mm, "translation_mm");
  const std::optional<Vec3> translation =
      held_translation(handle.joint(), handle.loaded.report.placement, requested);
  motion::RangeOptions options = options_in(handle, given);
  return followed(py::none(), [&](const auto&, const std::stop_token&) {
    auto range = std::make_unique<RangeHandle>(handle.joint(), translation, options);
    // Found once, for bands too.
    range->options.bearing.surface = range->range.bearing().surface;
    return range;
  });
}

py::list limits(const RangeHandle& handle, const py::list& given) {
  const std::vector<motion::Motion> motions = motions_in(given);
  const auto found = followed(py::none(), [&](const auto&, const std::stop_token& stop) {
    std::vector<motion::MotionLimit> done;
    each_limit(handle.range, motions, stop,
               [&](motion::MotionLimit&& limit) { done.push_back(std::move(limit)); });
    return done;
  });
  py::list list;
  for (const motion::MotionLimit& limit : found) list.append(dict_of(limit));
  return list;
}

/// (code, text) of each.
py::list notes(const RangeHandle& handle, const py::list& given) {
  const std::vector<motion::Motion> motions = motions_in(given);
  const std::vector<RangeNote> found = [&] {
    const py::gil_scoped_release released;
    return range_notes(handle.joint, handle.range.limits(motions), handle.options, handle.range.bearing());
  }();
  py::list list;
  for (const RangeNote& note : found) list.append(py::make_tuple(std::string(name_of(note.code)), note.text));
  return list;
}

py::dict free_angles(const RangeHandle& handle, std::size_t vary, const py::object& start,
                     double negative_deg, double positive_deg) {
  const JointAngles from = angles_in(start, "start");
  const motion::RotationRange range{Angle::degrees(negative_deg), Angle::degrees(positive_deg)};
  const motion::FreeAngles found = [&] {
    const py::gil_scoped_release released;
    return handle.range.free_angles(angle_numbered(vary), from, range);
  }();
  py::list intervals;
  for (const motion::FreeInterval& interval : found.intervals)
    intervals.append(py::make_tuple(interval.low.degrees(), interval.high.degrees(), dict_of(interval.at_low),
                                    dict_of(interval.at_high)));
  py::dict dict;
  dict["negative"] = dict_of(found.from_start.negative);
  dict["positive"] = dict_of(found.from_start.positive);
  dict["intervals"] = intervals;
  return dict;
}

py::list built_in(const JointHandle& handle) {
  py::list list;
  for (const motion::Motion& motion : io::known_motions(handle.loaded)) list.append(tuple_of(motion));
  return list;
}

/// Code, text and source of each; no source is None.
py::list caveats(const JointHandle& handle, const py::tuple& motion) {
  py::list list;
  for (const auto& [code, summary, text, source] : io::motion_caveats(handle.joint(), motion_in(motion)))
    list.append(
        py::make_tuple(name_of(code), text, source.empty() ? py::object(py::none()) : py::str(source)));
  return list;
}

py::object bearing_of(const RangeHandle& handle) {
  const auto& surface = handle.range.bearing().surface;
  if (!surface) return py::none();
  py::dict dict;
  dict["head_centre"] = array_of(surface->head.centre);
  dict["head_radius_mm"] = surface->head.radius;
  dict["margin_mm"] = surface->margin_mm;
  dict["parts"] = surface->parts;
  dict["rim_gap_mm"] = surface->rim_gap_mm;
  dict["beside_gap_mm"] = surface->beside_gap_mm;
  dict["triangles"] = array_of(std::vector<std::uint8_t>(surface->triangles));
  return dict;
}

py::dict path_limit(const JointHandle& handle, const py::object& given, double tolerance_deg,
                    const py::dict& options) {
  const PointsIn degrees(given, "waypoints");
  std::vector<JointAngles> waypoints;
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const Vec3 at = degrees.view()[i];
    waypoints.push_back({Angle::degrees(at[0]), Angle::degrees(at[1]), Angle::degrees(at[2])});
  }
  const motion::RangeOptions range = options_in(handle, options);
  const motion::PathLimit limit = followed(py::none(), [&](const auto&, const std::stop_token&) {
    return motion::PathFinder(handle.joint(), range).limit(waypoints, Angle::degrees(tolerance_deg));
  });
  py::dict dict;
  dict["segment"] = limit.segment;
  dict["fraction"] = limit.fraction;
  dict["angles_deg"] = std::array{limit.at.flexion.degrees(), limit.at.adduction.degrees(),
                                  limit.at.internal_rotation.degrees()};
  dict["reason"] = io::name_of(limit.reason);
  dict["contact"] = dict_of(limit.contact);
  dict["distance_mm"] = limit.distance_mm;
  return dict;
}

/// The side of a limit's contact, given as dict_of() returns it.
py::object side_of_contact(const JointHandle& handle, const py::dict& contact,
                           const py::object& translation_mm) {
  motion::MotionLimit limit;
  limit.end.contact.emplace();
  limit.end.contact->fixed_point = vector_in(contact["fixed_point"], "contact");
  limit.end.contact->kind = contact["kind"].cast<std::string>() == io::name_of(motion::ContactKind::bearing)
                                ? motion::ContactKind::bearing
                                : motion::ContactKind::impingement;
  if (!translation_mm.is_none()) limit.translation_mm = vector_in(translation_mm, "translation_mm");
  const auto side = motion::contact_side(handle.joint(), limit);
  return side ? py::object(py::str(name_of(*side))) : py::none();
}

}  // namespace

void bind_range_of_motion(py::module_& module) {
  py::class_<RangeHandle>(module, "RangeOfMotion")
      .def("limits", &limits)
      .def("notes", &notes)
      .def("free_angles", &free_angles)
      .def_property_readonly("bearing", &bearing_of)
      .def_property_readonly("why_no_bearing",
                             [](const RangeHandle& h) { return h.range.bearing().why_none; })
      .def_property_readonly("left_out", [](const RangeHandle& h) {
        return py::make_tuple(h.range.left_out().fixed_triangles, h.range.left_out().mobile_triangles);
      });
  module.def("range_of_motion", &ready);
  module.def("motions", &built_in);
  module.def("motion_caveats", &caveats);
  module.def("path_limit", &path_limit);
  module.def("contact_side", &side_of_contact);
}

}  // namespace condyle::python
