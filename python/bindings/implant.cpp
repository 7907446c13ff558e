#include "implant.hpp"

#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/answer.hpp"
#include "io/result/implant_result.hpp"
#include "joint.hpp"

namespace condyle::python {
namespace {

/// A joint with an implant as Python holds it, for its files.
struct PlacedImplantHandle {
  io::LoadedJoint loaded;
  ImplantAnswer answer;

  io::ImplantResult result() const { return {loaded.joint, answer, {}, nullptr, &loaded.report.file}; }
};

ImplantRequest implant_request_in(const std::map<std::string, double>& sizes, const std::string& definition,
                                  int facets, const std::string& centre, bool as_rim) {
  plan::Implant implant = plan::TotalHip{};
  set_sizes(implant, sizes);
  plan::TotalHip& hip = std::get<plan::TotalHip>(implant);
  hip.cup.definition = cup_definition_named(definition);
  hip.facets = facets;
  const auto is_left = [&](const char* size) { return !sizes.contains(size); };
  return {.hip = hip,
          .of_bones = {.neck_shaft = is_left("neck_shaft_deg"),
                       .stem_version = is_left("stem_version_deg"),
                       .offset = is_left("offset_mm"),
                       .cup_radius = is_left("cup_radius_mm"),
                       .cup = as_rim},
          .centre = implant_centre_named(centre)};
}

/// (name, mesh) of each part.
py::list meshes_by_part(const Body& body) {
  py::list list;
  for (const BodyPart& part : body.parts)
    list.append(py::make_tuple(part.name, mesh_of_part(body, part.name)));
  return list;
}

py::dict placed_implant(const JointHandle& handle, const std::map<std::string, double>& sizes,
                        const std::string& definition, int facets, const std::string& centre, bool as_rim) {
  const ImplantRequest request = implant_request_in(sizes, definition, facets, centre, as_rim);
  std::unique_ptr<PlacedImplantHandle> placed;
  std::unique_ptr<JointHandle> joint;
  std::string json;
  {
    const py::gil_scoped_release released;
    placed = std::make_unique<PlacedImplantHandle>(
        PlacedImplantHandle{handle.loaded, answer_implant(handle.loaded, request)});
    joint = std::make_unique<JointHandle>(io::joint_with_implant(placed->result()));
    json = io::implant_json(placed->result());
  }
  const ImplantAnswer& answer = placed->answer;
  py::dict dict;
  dict["joint"] = std::move(joint);
  dict["fixed"] = meshes_by_part(answer.joint.fixed);
  dict["mobile"] = meshes_by_part(answer.joint.mobile);
  dict["centre_mm"] = array_of(answer.centre_mm);
  dict["femur_shift_mm"] = array_of(answer.femur_shift_mm);
  dict["cut_normal"] = array_of(answer.cut.normal);
  dict["notes"] = notes_of(answer.notes);
  dict["caveats"] = answer.caveats;
  dict["json"] = json;
  dict["placed"] = std::move(placed);
  return dict;
}

std::vector<std::string> write_placed_implant(const PlacedImplantHandle& placed, const std::string& folder) {
  const py::gil_scoped_release released;
  std::vector<std::string> written;
  for (const auto& path : io::write_implant(folder, placed.result())) written.push_back(path.string());
  return written;
}

}  // namespace

void set_sizes(plan::Implant& implant, const std::map<std::string, double>& given) {
  for (const plan::ImplantParameter& each : plan::implant_parameters(implant))
    if (const auto found = given.find(std::string(each.name) + "_" + std::string(each.unit));
        found != given.end())
      each.set(implant, found->second);
}

void bind_implant(py::module_& module) {
  py::class_<PlacedImplantHandle>(module, "PlacedImplant").def("write", &write_placed_implant);
  module.def("implant", &placed_implant);
}

}  // namespace condyle::python
