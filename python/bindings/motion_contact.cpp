#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/answer.hpp"
#include "interrupts.hpp"
#include "joint.hpp"
#include "json_object.hpp"
#include "mesh/require_solid.hpp"
#include "surface_contact.hpp"

/// Poses that balance loads, and contact along a motion.

namespace condyle::python {
namespace {

py::dict balance_dict(contact::BalancedPose&& found, const contact::ElasticContact& surfaces,
                      const contact::Load& load) {
  py::dict dict;
  dict["outcome"] = name_of(found.outcome);
  dict["reason"] = contact::reason_of(found);
  dict["X_FM"] = array_of(found.X_FM);
  dict["residual"] = tuple_of(found.residual);
  dict["steps"] = found.steps;
  std::vector<motion::ContactNote> notes = motion::check_load(load);
  motion::add_new(notes, motion::check_contact(found.contact));
  dict["notes"] = notes_of(notes);
  dict["contact"] = dict_of(std::move(found.contact), surfaces);
  return dict;
}

contact::BalanceOptions options_in(const py::dict& given) {
  contact::BalanceOptions options{.free_rotations = given["free_rotations"].cast<bool>(),
                                  .force_tolerance_n = given["force_tolerance_n"].cast<double>(),
                                  .moment_tolerance_nmm = given["moment_tolerance_nmm"].cast<double>(),
                                  .farthest_mm = given["farthest_mm"].cast<double>(),
                                  .most_steps = given["most_steps"].cast<int>(),
                                  .most_left_at_jump = given["most_left_at_jump"].cast<double>()};
  if (!given["ligaments"].is_none())
    options.ligaments = given["ligaments"].cast<const JointHandle&>().joint().ligaments;
  const PointsIn directions(given["free_directions"], "free_directions");
  for (std::size_t i = 0; i < directions.size(); ++i) options.free_directions.push_back(directions.view()[i]);
  return options;
}

BodyRole frame_in(const py::dict& given) {
  return given["goes_along"].cast<bool>() ? BodyRole::mobile : BodyRole::fixed;
}

py::dict balanced(const contact::ElasticContact& surfaces, const py::object& start, const py::object& force_n,
                  const py::object& moment_nmm, const py::dict& given) {
  const Pose X_FM = one_pose(start, "start");
  const contact::Load load{{vector_in(force_n, "force_n"), vector_in(moment_nmm, "moment_nmm")},
                           frame_in(given)};
  const contact::BalanceOptions options = options_in(given);
  contact::BalancedPose found = without_lock([&] { return contact::balance(surfaces, X_FM, load, options); });
  return balance_dict(std::move(found), surfaces, load);
}

/// Forces and moments have a row for all frames, or one for each; None for gaps.
py::list balanced_along(const contact::ElasticContact& surfaces, const py::object& poses,
                        const py::object& force_n, const py::object& moment_nmm, const py::dict& given,
                        const py::object& progress) {
  const std::vector<std::optional<Pose>> X_FM = poses_with_gaps_in(poses, "poses");
  const PointsIn forces(force_n, "force_n"), moments(moment_nmm, "moment_nmm");
  std::vector<contact::Load> loads;
  for (std::size_t i = 0; i < forces.size(); ++i)
    loads.push_back({{forces.view()[i], moments.view()[i]}, frame_in(given)});
  const contact::BalanceOptions options = options_in(given);
  auto found = with_progress(progress, [&](const Control& control) {
    return motion::balance_along(surfaces, X_FM, loads, options, control);
  });
  py::list answers;
  for (std::size_t i = 0; i < found->size(); ++i) {
    std::optional<contact::BalancedPose>& pose = (*found)[i];
    const contact::Load& load = loads.size() == 1 ? loads.front() : loads[i];
    answers.append(pose ? py::object(balance_dict(std::move(*pose), surfaces, load)) : py::none());
  }
  return answers;
}

py::object screw_dict(const std::optional<motion::ScrewStep>& step) {
  if (!step) return py::none();
  py::dict dict;
  dict["rotation_deg"] = step->rotation.degrees();
  dict["is_slide"] = step->is_slide();
  dict["axis"] = step->axis ? array_of(step->axis->direction) : py::object(py::none());
  dict["point_mm"] = step->axis ? array_of(step->axis->point) : py::object(py::none());
  dict["depth_deg"] = optional_number(step->depth ? std::optional(step->depth->degrees()) : std::nullopt);
  dict["depth_mm"] = optional_number(step->depth_mm);
  return dict;
}

/// Frames of a motion with the surfaces of an ElasticContact, or else of rays that `casting` sends; None for gaps. And the notes on
/// them.
py::tuple along(const JointHandle& handle, const py::object& poses, const contact::ElasticContact* elastic,
                const std::string& casting, const std::string& rule, double reach_mm, bool with_screws,
                const py::object& progress) {
  const std::vector<std::optional<Pose>> X_FM = poses_with_gaps_in(poses, "poses");
  const Mesh &fixed = handle.contact.fixed(), &mobile = handle.contact.mobile();
  const bool fixed_casts = casting_in(casting) == contact::Casting::fixed;
  const contact::NormalDepthOptions rays = elastic ? elastic->options().rays : rays_in(rule, reach_mm);
  if (!elastic) {
    mesh::require_oriented(fixed, handle.joint().fixed.name);
    mesh::require_oriented(mobile, handle.joint().mobile.name);
  }
  const MotionRequest request{.X_FM = X_FM,
                              .between = BetweenFrames::never,
                              .casting = fixed_casts ? BodyRole::fixed : BodyRole::mobile,
                              .rays = rays,
                              .limits = handle.limits(),
                              .screws = with_screws};
  const auto found = with_progress(progress, [&](const Control& control) {
    return answer_motion(handle.contact, elastic, request, control);
  });
  const bool casts_fixed = elastic ? elastic->options().casting == contact::Casting::fixed : fixed_casts;
  const Mesh& caster =
      elastic ? (casts_fixed ? elastic->fixed() : elastic->mobile()) : (casts_fixed ? fixed : mobile);
  py::list answers;
  for (std::size_t i = 0; i < found->frames.size(); ++i) {
    const std::optional<motion::FrameContact>& frame = found->frames[i];
    if (!frame) {
      answers.append(py::none());
      continue;
    }
    py::dict dict;
    dict["X_FM"] = array_of(frame->X_FM);
    dict["in_contact"] = frame->in_contact;
    dict["intersecting_pairs"] = frame->intersecting_pairs;
    dict["smallest_gap_mm"] = frame->smallest_gap_mm;
    dict["surface"] = dict_of(contact::SurfaceContact(frame->surface), caster, rays.rule);
    dict["force_n"] = array_of(frame->on_mobile.force_n);
    dict["moment_nmm"] = array_of(frame->on_mobile.moment_nmm);
    dict["cut_off_by_reach"] = frame->cut_off_by_reach;
    dict["standing"] =
        standing_of(found->standings.empty() ? std::nullopt : found->standings[i], handle.joint().anatomy);
    dict["screw"] = found->screws.empty() ? py::none() : screw_dict(found->screws[i]);
    answers.append(dict);
  }
  return py::make_tuple(answers, notes_of(found->notes));
}

}  // namespace

void bind_motion_contact(py::module_& module) {
  module.def("balance", &balanced);
  module.def("balance_along", &balanced_along);
  module.def("contact_along", &along);
}

}  // namespace condyle::python
