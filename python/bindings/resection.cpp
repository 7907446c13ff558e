#include "resection.hpp"

#include <pybind11/stl.h>

#include "answer/limit_facts.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/brush.hpp"
#include "interrupts.hpp"
#include "motion.hpp"
#include "range_answer.hpp"

namespace condyle::python {
namespace {

/// The joint with other meshes, placed like this one.
std::unique_ptr<JointHandle> handle_of(const JointHandle& handle, Joint joint) {
  io::LoadedJoint loaded = handle.loaded;
  loaded.joint = std::move(joint);
  return std::make_unique<JointHandle>(std::move(loaded));
}

ResectionRequest request_in(const py::list& motions, const py::list& reach, const py::dict& given) {
  ResectionRequest request{.resection = cut_in(given), .motions = motions_in(motions)};
  for (const py::handle each : reach) {
    const auto target = each.cast<py::tuple>();
    request.resection.targets.push_back({motion_in(target[0].cast<py::tuple>()),
                                         Angle::degrees(target[1].cast<double>()), target[2].cast<bool>()});
  }
  request.resection.mobile.vertices = given["keep_mobile"].cast<std::vector<std::uint8_t>>();
  request.resection.fixed.vertices = given["keep_fixed"].cast<std::vector<std::uint8_t>>();
  request.resection.range.bearing = bearing_in(given);
  request.curve_points = given["curve_points"].cast<std::size_t>();
  request.bands = band_in(given["band"]);
  request.confidence = given["confidence"].cast<std::optional<double>>();
  return request;
}

py::object dict_of_cut(const std::optional<plan::CutBone>& cut) {
  if (!cut) return py::none();
  py::dict dict;
  dict["before"] = Mesh(cut->before);
  dict["after"] = cut->body.mesh;
  dict["depth_mm"] = array_of(std::vector<double>(cut->depth_mm));
  dict["needed_by"] = array_of(std::vector<std::int32_t>(cut->needed_by.begin(), cut->needed_by.end()));
  dict["needed_from_deg"] = array_of(std::vector<double>(cut->needed_from_deg));
  dict["volume_mm3"] = cut->volume_mm3;
  dict["least_volume_mm3"] = cut->least_volume_mm3;
  dict["burr_volume_mm3"] = cut->burr_volume_mm3;
  dict["burr_in_kept_mm"] = cut->burr_in_kept_mm;
  dict["area_mm2"] = cut->area_mm2;
  dict["deepest_mm"] = cut->deepest_mm;
  dict["deepest_at"] = array_of(cut->deepest_at);
  return dict;
}

py::tuple tuple_of_target(const JointHandle& handle, const plan::Resection& without,
                          const plan::ReachOutcome& outcome, const ResectionAnswer::TargetPromise& promise) {
  py::object blocked = py::none();
  if (outcome.blocked)
    blocked = py::make_tuple(std::string(name_of(outcome.blocked->by)),
                             outcome.blocked->body == BodyRole::mobile ? "mobile" : "fixed",
                             array_of(outcome.blocked->point_mm));
  const motion::Motion& motion = outcome.target.motion;
  const auto band = [&](const std::optional<motion::LimitBand>& of) -> py::object {
    if (!of) return py::none();
    return py::make_tuple(degrees_turned(of->p5, motion), degrees_turned(of->median, motion),
                          degrees_turned(of->p95, motion));
  };
  py::object other = py::none();
  if (const auto& centre = promise.other_centre)
    other = py::make_tuple(centre->of == BodyRole::fixed ? "socket" : "head",
                           degrees_turned(centre->before, motion), degrees_turned(centre->after, motion),
                           centre->is_decided);
  return py::make_tuple(
      motion.name, plan::asked_degrees(outcome.target.reach), plan::asked_degrees(outcome.planned),
      limits_of(handle.joint(), {&outcome.before, 1})[0], limits_of(without.joint, {&outcome.after, 1})[0],
      blocked, optional_number(promise.confidence_reached), band(promise.before), band(promise.after), other,
      promise.is_plan, promise.text);
}

/// Keys and (before, after), None where the meshes do not show a measure; None for joints other than hips.
py::object shapes_of(const ResectionAnswer& answer) {
  if (!answer.shape_before) return py::none();
  py::dict dict;
  for (const measure::MeasureDefinition& each : measure::measure_definitions())
    dict[py::str(each.key.data(), each.key.size())] =
        py::make_tuple(optional_number(each.of(*answer.shape_before).value),
                       optional_number(each.of(*answer.shape_after).value));
  return dict;
}

py::dict resection(const JointHandle& handle, const py::list& motions, const py::list& reach,
                   const py::dict& given, const py::object& progress) {
  const ResectionRequest request = request_in(motions, reach, given);
  ResectionAnswer answer = *with_progress(
      progress, [&](const Control& control) { return answer_resection(handle.loaded, request, control); });
  py::list targets, alternatives, curve;
  for (std::size_t i = 0; i < answer.promises.size(); ++i)
    targets.append(
        tuple_of_target(handle, answer.resection, answer.resection.targets[i], answer.promises[i]));
  for (const ResectionAnswer::Alternative& each : answer.alternatives)
    alternatives.append(py::make_tuple(each.confidence, each.margin_mm, each.volume_mm3));
  for (const ResectionAnswer::CurvePoint& point : answer.curve)
    curve.append(py::make_tuple(point.target, point.reached.degrees(), point.volume_mm3, point.deepest_mm));
  py::dict dict;
  dict["joint"] = handle_of(handle, answer.resection.joint);
  dict["mobile"] = dict_of_cut(answer.resection.mobile);
  dict["fixed"] = dict_of_cut(answer.resection.fixed);
  dict["targets"] = targets;
  dict["before"] = limits_of(handle.joint(), answer.before);
  dict["after"] = limits_of(answer.resection.joint, answer.after);
  py::list gain;
  for (const Angle each : answer.gain) gain.append(each.degrees());
  dict["gain_deg"] = gain;
  dict["shapes"] = shapes_of(answer);
  dict["confidence"] = optional_number(answer.confidence);
  dict["displaced"] = answer.displaced;
  dict["alternatives"] = alternatives;
  dict["curve"] = curve;
  dict["notes"] = notes_of(answer.notes) + notes_of(answer.limit_notes);
  dict["margin_mm"] = answer.margin_mm;
  dict["caveats"] = answer.caveats;
  dict["plan"] = std::make_unique<PlanHandle>(PlanHandle{handle.loaded, std::move(answer)});
  return dict;
}

plan::BrushRequest strokes_in(const py::list& strokes, const py::dict& given) {
  plan::BrushRequest request{.body = given["of_fixed"].cast<bool>() ? BodyRole::fixed : BodyRole::mobile,
                             .stays = given["keep"].cast<std::vector<std::uint8_t>>()};
  for (const py::handle each : strokes) {
    const auto stroke = each.cast<py::tuple>();
    request.strokes.push_back(
        {.action = stroke[0].cast<bool>() ? plan::BrushAction::restore : plan::BrushAction::lower,
         .along = stroke[1].cast<std::vector<Index>>(),
         .radius_mm = stroke[2].cast<double>(),
         .depth_mm = stroke[3].cast<double>()});
  }
  request.range.bearing = bearing_in(given);
  return request;
}

py::dict brushed(const JointHandle& handle, const py::list& motions, const py::list& strokes,
                 const py::dict& given) {
  const plan::BrushRequest request = strokes_in(strokes, given);
  const std::vector<motion::Motion> known = motions_in(motions);
  plan::BrushedJoint done = without_lock([&] { return plan::brush_joint(handle.joint(), request, known); });
  py::list outcomes;
  for (const plan::StrokeOutcome& each : done.strokes)
    outcomes.append(py::make_tuple(each.moved, each.kept, each.limited));
  const py::list after = limits_of(done.joint, done.after);
  py::dict dict;
  dict["joint"] = handle_of(handle, std::move(done.joint));
  dict["strokes"] = outcomes;
  dict["volume_mm3"] = done.removed.volume_mm3;
  dict["deepest_mm"] = done.removed.deepest_mm;
  dict["depth_mm"] = array_of(std::move(done.depth_mm));
  dict["before"] = limits_of(handle.joint(), done.before);
  dict["after"] = after;
  return dict;
}

/// With this mesh in the mobile body's place, in its frame. Where a head is known it stays the one that it is.
std::unique_ptr<JointHandle> with_mobile(const JointHandle& handle, const Mesh& mesh) {
  const py::gil_scoped_release released;
  return handle_of(handle, plan::with_mobile_mesh(handle.joint(), mesh));
}

}  // namespace

plan::ResectionOptions cut_in(const py::dict& given) {
  const auto optional = [&](const char* name) { return given[name].cast<std::optional<double>>(); };
  const plan::KeptBone kept{optional("deepest_mm"), optional("within_mm"), {}};
  plan::ResectionOptions request;
  request.fixed_share = given["fixed_share"].cast<double>();
  request.mobile = kept;
  request.fixed = kept;
  request.margin_mm = optional("margin_mm").value_or(0);
  request.burr_mm = optional("burr_mm");
  request.edge_mm = given["edge_mm"].cast<double>();
  return request;
}

void bind_resection(py::module_& module) {
  py::class_<PlanHandle>(module, "Plan");
  module.def("resection", &resection);
  module.def("brushed", &brushed);
  module.def("with_mobile", &with_mobile);
}

}  // namespace condyle::python
