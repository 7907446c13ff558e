#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/io/model_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/mesh/polygon_rule.hpp"
#include "joint.hpp"

namespace condyle::python {
namespace {

std::unique_ptr<io::Model> model_in(const std::filesystem::path& path,
                                    const std::vector<std::filesystem::path>& folders) {
  const py::gil_scoped_release released;
  return std::make_unique<io::Model>(io::read_model(path, folders));
}

io::ModelJointRequest request_in(const std::string& joint, const std::string& joint_file,
                                 const std::string& anatomy, const std::string& side,
                                 const std::string& contact, const std::string& polygons) {
  io::ModelJointRequest request{.joint = joint, .joint_file = joint_file};
  for (const Anatomy known : all_anatomies)
    if (anatomy == name_of(known)) request.anatomy = known;
  if (!side.empty()) request.side = side == name_of(Side::right) ? Side::right : Side::left;
  request.contact = contact;
  request.polygons = io::polygon_rule_named(polygons);
  return request;
}

/// Names and types, and why some cannot be read.
py::list model_joints(const io::Model& model) {
  py::list joints;
  for (const io::ModelJoint& joint : model.joints) {
    if (joint.name.empty()) continue;  // nobody can ask for it
    joints.append(
        py::make_tuple(joint.name, joint.type, joint.parent_body, joint.child_body,
                       joint.transform ? py::object(py::none()) : py::object(py::str(joint.why_not))));
  }
  return joints;
}

py::list model_coordinates(const io::Model& model, const std::string& name) {
  py::list coordinates;
  for (const io::ModelCoordinate& coordinate : io::joint_named(model, name).coordinates)
    coordinates.append(py::make_tuple(coordinate.name, std::string(name_of(coordinate.motion)),
                                      coordinate.default_value, coordinate.range, coordinate.is_clamped,
                                      coordinate.is_locked, coordinate.is_prescribed, coordinate.stop));
  return coordinates;
}

/// Rows of coordinates to an array (N, 4, 4) of X_parent_child.
py::array model_poses(const io::Model& model, const std::string& name,
                      const py::array_t<double, py::array::c_style | py::array::forcecast>& rows) {
  const io::ModelJoint& joint = io::joint_named(model, name);
  const auto in = rows.unchecked<2>();
  py::array_t<double> out({in.shape(0), py::ssize_t{4}, py::ssize_t{4}});
  auto values = out.mutable_unchecked<3>();
  std::vector<double> q(static_cast<std::size_t>(in.shape(1)));
  for (py::ssize_t n = 0; n < in.shape(0); ++n) {
    for (py::ssize_t i = 0; i < in.shape(1); ++i) q[static_cast<std::size_t>(i)] = in(n, i);
    const Pose X = io::pose_of(joint, q);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) values(n, i, j) = X.matrix()(i, j);
  }
  return out;
}

py::list model_meshes(const io::Model& model) {
  py::list meshes;
  for (const io::ModelMesh& mesh : model.meshes)
    meshes.append(py::make_tuple(
        mesh.body, mesh.file, mesh.path ? py::object(py::str(mesh.path->string())) : py::object(py::none())));
  return meshes;
}

py::tuple proposed_of_model(const io::Model& model, const std::string& joint, const std::string& joint_file,
                            const std::string& anatomy, const std::string& side, const std::string& contact,
                            const std::string& polygons) {
  io::ModelJointProposal proposed =
      io::propose_joint(model, request_in(joint, joint_file, anatomy, side, contact, polygons));
  for (std::string* missing : {&proposed.missing_body, &proposed.unreadable})
    if (!missing->empty()) proposed.proposal.to_fill_in.push_back(std::move(*missing));
  return py::make_tuple(proposed.proposal.toml, proposed.proposal.to_fill_in, notes_of(proposed.notes));
}

std::unique_ptr<JointHandle> joint_of_model(const io::Model& model, const std::string& joint,
                                            const std::string& anatomy, const std::string& side,
                                            const std::string& contact, const std::string& polygons) {
  const py::gil_scoped_release released;
  return std::make_unique<JointHandle>(
      io::read_joint(model, request_in(joint, "", anatomy, side, contact, polygons)));
}

}  // namespace

void bind_model(py::module_& module) {
  py::class_<io::Model>(module, "Model")
      .def_readonly("name", &io::Model::name)
      .def_readonly("version", &io::Model::version)
      .def_readonly("bodies", &io::Model::bodies)
      .def_readonly("ignored", &io::Model::ignored)
      .def_property_readonly("notes", [](const io::Model& model) { return notes_of(model.notes); })
      .def_property_readonly("contacts",
                             [](const io::Model& model) {
                               std::vector<std::string> names;
                               for (const io::ModelContact& contact : model.contacts)
                                 names.push_back(contact.name);
                               return names;
                             })
      .def_property_readonly("joints", &model_joints)
      .def_property_readonly("meshes", &model_meshes)
      .def("coordinates_of", &model_coordinates)
      .def("poses", &model_poses)
      .def("proposed", &proposed_of_model)
      .def("joint", &joint_of_model);
  module.def("read_model", &model_in);
}

}  // namespace condyle::python
