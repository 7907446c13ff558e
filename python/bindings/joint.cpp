#include "joint.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <optional>
#include <string>
#include <tuple>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/joint_checks.hpp"
#include "io/mesh/polygon_rule.hpp"
#include "io/result/parameters.hpp"
#include "io/result/scope_text.hpp"

namespace condyle::python {
namespace {

std::unique_ptr<JointHandle> read_handle(const std::filesystem::path& path) {
  const py::gil_scoped_release released;
  return std::make_unique<JointHandle>(io::read_joint(path));
}

std::unique_ptr<JointHandle> made(const py::dict& description, const std::string& fixed_name,
                                  const Mesh& fixed, const BodyImage* fixed_image,
                                  const std::string& mobile_name, const Mesh& mobile,
                                  const BodyImage* mobile_image) {
  io::JointReport report;
  report.file.joint = description_in(description);
  const py::gil_scoped_release released;
  const auto body = [](const std::string& name, const Mesh& mesh, const BodyImage* image) {
    return Body{name, mesh, {}, image ? std::optional(*image) : std::nullopt};
  };
  auto [joint, placement] = make_joint(report.file.joint, body(fixed_name, fixed, fixed_image),
                                       body(mobile_name, mobile, mobile_image));
  report.processing = placement.processing;
  report.placement = std::move(placement);
  return std::make_unique<JointHandle>(io::LoadedJoint{std::move(joint), std::move(report)});
}

/// Rows of degrees and of mm to an array (N, 4, 4).
py::array poses_at(const JointHandle& handle, const py::object& angles_deg,
                   const py::object& translation_mm) {
  const PointsIn angles(angles_deg, "pose"), translations(translation_mm, "pose");
  const auto count = static_cast<py::ssize_t>(angles.size());
  py::array_t<double> array({count, py::ssize_t{4}, py::ssize_t{4}});
  auto values = array.mutable_unchecked<3>();
  const Joint& joint = handle.joint();
  for (py::ssize_t n = 0; n < count; ++n) {
    const Vec3 degrees = angles.view()[static_cast<std::size_t>(n)];
    const io::PoseDegrees pose{degrees[0], degrees[1], degrees[2],
                               translations.view()[static_cast<std::size_t>(n)]};
    const Pose X_FM = pose_at(joint.coordinates(), pose.coordinates(), joint.translation_frame);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) values(n, i, j) = X_FM.matrix()(i, j);
  }
  return array;
}

/// Poses to (N, 3) degrees and (N, 3) mm.
py::tuple coordinates_of(const JointHandle& handle, const py::object& given) {
  const PosesIn in = poses_in(given, "pose");
  Points degrees(in.poses.size()), mm(in.poses.size());
  for (std::size_t n = 0; n < in.poses.size(); ++n) {
    const auto [angles, translation] =
        coordinates_at(handle.joint().coordinates(), in.poses[n], handle.joint().translation_frame);
    degrees.set(n,
                {angles.flexion.degrees(), angles.adduction.degrees(), angles.internal_rotation.degrees()});
    mm.set(n, translation);
  }
  return py::make_tuple(array_of(degrees), array_of(mm));
}

py::list checks_of(const JointHandle& handle) {
  const std::vector<JointNote> notes =
      without_lock([&] { return check_joint(handle.joint(), handle.loaded.report.placement); });
  return notes_of(notes);
}

using AngleNamesList = std::vector<std::pair<std::string, std::string>>;

AngleNamesList angle_names(Anatomy joint) {
  AngleNamesList names;
  for (const auto& [positive, negative] : coordinate_names(joint)) names.emplace_back(positive, negative);
  return names;
}

Anatomy anatomy_named(const std::string& word) {
  for (const Anatomy joint : all_anatomies)
    if (word == name_of(joint)) return joint;
  throw UsageError("joint: unknown " + word);
}

AngleNamesList angle_names_of(const std::string& word) {
  return angle_names(anatomy_named(word));
}

py::list parts_of(const Body& body) {
  py::list parts;
  for (const BodyPart& part : body.parts)
    parts.append(py::make_tuple(part.name, part.first_vertex, part.vertices, part.first_triangle,
                                part.triangles, std::string(name_of(part.contact)), part.cut_triangles));
  return parts;
}

/// (name, kind, body, value, unit, in_joint_file, as_given, low, high, sigma) of each.
py::list parameters_of(const JointHandle& handle) {
  py::list list;
  if (!handle.joint().posed) return list;
  for (const PosedPart& part : handle.joint().posed->parts)
    for (const PartParameter& p : part.parameters)
      list.append(py::make_tuple(part.name + "." + p.name, std::string(name_of(p.kind)),
                                 part.body == BodyRole::fixed ? "fixed" : "mobile", p.value,
                                 std::string(unit_of(p.kind)), p.described, p.as_given, p.low, p.high,
                                 p.sigma));
  return list;
}

std::unique_ptr<JointHandle> moved_to(const JointHandle& handle,
                                      const std::vector<std::pair<std::string, double>>& given) {
  std::vector<ParameterValue> values;
  for (const auto& [name, value] : given) values.push_back({name, value});
  const py::gil_scoped_release released;
  return std::make_unique<JointHandle>(with_parameters(handle.loaded, values));
}

/// The text of the file, the keys that it leaves to fill in, and the evidence for a unit that is not mm, for side and axes.
py::tuple proposed(const std::filesystem::path& fixed, const std::filesystem::path& mobile,
                   const std::filesystem::path& joint_file, const std::optional<std::string>& joint,
                   const std::optional<std::string>& side, const std::optional<std::string>& units,
                   const std::string& polygons, const std::string& species, bool seat) {
  io::ProposalRequest request{.fixed = fixed,
                              .mobile = mobile,
                              .joint_file = joint_file,
                              .polygons = io::polygon_rule_named(polygons),
                              .person = {.species = species},
                              .seat = seat};
  if (joint) request.anatomy = anatomy_named(*joint);
  if (side) request.side = *side == name_of(Side::right) ? Side::right : Side::left;
  if (units) request.units = length_unit_named(*units);
  const io::JointProposal proposal = without_lock([&] { return io::propose_joint(request); });
  std::vector<std::string> evidence = proposal.evidence;
  if (!proposal.units_note.empty()) evidence.insert(evidence.begin(), proposal.units_note);
  return py::make_tuple(proposal.toml, proposal.to_fill_in, evidence);
}

}  // namespace

JointAngle angle_numbered(std::size_t number) {
  return all_joint_angles.at(number);
}

contact::ArcsAbout about_in(const py::object& given) {
  if (py::isinstance<py::int_>(given)) return angle_numbered(given.cast<std::size_t>());
  const std::vector<double> n = doubles_in(given, "about");
  return contact::AxisLine{{n.at(0), n.at(1), n.at(2)},
                           n.size() == 3 ? Vec3(Vec3::Zero()) : Vec3(n.at(3), n.at(4), n.at(5))};
}

void bind_joint(py::module_& module) {
  py::class_<JointHandle>(module, "Joint")
      .def_property_readonly("name", [](const JointHandle& h) { return h.joint().name; })
      .def_property_readonly("person",
                             [](const JointHandle& h) {
                               const Person& person = h.joint().person;
                               return std::tuple(
                                   person.age_years,
                                   person.sex ? std::optional(name_of(*person.sex)) : std::nullopt,
                                   person.species.empty() ? std::nullopt : std::optional(person.species));
                             })
      .def_property_readonly("planned", [](const JointHandle& h) { return io::planned_text(h.joint()); })
      .def_property_readonly("kind", [](const JointHandle& h) { return name_of(h.joint().kind); })
      .def_property_readonly("side", [](const JointHandle& h) { return name_of(h.joint().side); })
      .def_property_readonly("anatomy", [](const JointHandle& h) { return name_of(h.joint().anatomy); })
      .def_property_readonly("translation_frame",
                             [](const JointHandle& h) { return name_of(h.joint().translation_frame); })
      .def_property_readonly("fixed", [](const JointHandle& h) { return h.joint().fixed.mesh; })
      .def_property_readonly("mobile", [](const JointHandle& h) { return h.joint().mobile.mesh; })
      .def_property_readonly("fixed_name", [](const JointHandle& h) { return h.joint().fixed.name; })
      .def_property_readonly("mobile_name", [](const JointHandle& h) { return h.joint().mobile.name; })
      .def_property_readonly("fixed_parts", [](const JointHandle& h) { return parts_of(h.joint().fixed); })
      .def_property_readonly("mobile_parts", [](const JointHandle& h) { return parts_of(h.joint().mobile); })
      .def_property_readonly("angle_names",
                             [](const JointHandle& h) { return angle_names(h.joint().anatomy); })
      .def_property_readonly("scope", [](const JointHandle& h) { return io::scope_text(h.joint()); })
      .def_property_readonly("processing", [](const JointHandle& h) { return h.loaded.report.processing; })
      .def_property_readonly("X_WF",
                             [](const JointHandle& h) { return array_of(h.loaded.report.placement.X_WF); })
      .def_property_readonly("reference_pose",
                             [](const JointHandle& h) {
                               const auto& [angles, translation] = h.loaded.report.placement.reference_pose;
                               return std::array{angles.flexion.degrees(),
                                                 angles.adduction.degrees(),
                                                 angles.internal_rotation.degrees(),
                                                 translation.x(),
                                                 translation.y(),
                                                 translation.z()};
                             })
      .def("zero",
           [](const JointHandle& h) {
             const ZeroPose zero = without_lock([&] { return zero_pose(h.joint()); });
             std::optional<std::array<double, 3>> femur;
             if (zero.femur)
               femur = {zero.femur->flexion.degrees(), zero.femur->adduction.degrees(),
                        zero.femur->internal_rotation.degrees()};
             return std::tuple(std::string(name_of(zero.from)), zero.is_neutral(), femur,
                               zero_text(h.joint(), zero));
           })
      .def("part",
           [](const JointHandle& h, bool of_fixed, const std::string& part) {
             const py::gil_scoped_release released;
             return mesh_of_part(of_fixed ? h.joint().fixed : h.joint().mobile, part);
           })
      .def("poses_at", &poses_at)
      .def("coordinates_of", &coordinates_of)
      .def("checks", &checks_of)
      .def("parameters", &parameters_of)
      .def("with_parameters", &moved_to)
      .def(py::pickle([](const JointHandle& h) { return py::bytes(state_of(h.loaded)); },
                      [](const py::bytes& state) {
                        return std::make_unique<JointHandle>(joint_of_state(std::string_view(state)));
                      }));
  module.def("propose_joint", &proposed);
  module.def("angle_names_of", &angle_names_of);
  module.def("read_joint", &read_handle);
  module.def("make_joint", &made);
}

}  // namespace condyle::python
