#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/error.hpp"
#include "condyle/io/label_file.hpp"
#include "interrupts.hpp"

/// Label maps, and surfaces and joints made of them.

namespace condyle::python {
namespace {

io::LabelMap read_label_map(const std::filesystem::path& path, const std::string& affine,
                            std::optional<std::int64_t> volume, const std::string& axes, bool elsewhere) {
  io::LabelFileOptions options{.volume = volume, .outside_folder = elsewhere};
  if (!affine.empty()) options.affine = affine == "qform" ? io::AffineChoice::qform : io::AffineChoice::sform;
  if (!axes.empty())
    options.axes = axes == "LPS"   ? io::StatedAxes::lps
                   : axes == "RAS" ? io::StatedAxes::ras
                                   : io::StatedAxes::las;
  const py::gil_scoped_release released;
  return io::read_labels(path, options);
}

py::array affine_array(const Eigen::Affine3d& X) {
  py::array_t<double> array({4, 4});
  auto values = array.mutable_unchecked<2>();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) values(i, j) = X.matrix()(i, j);
  return array;
}

/// (label, layer, names, voxels, first, size, touches) of each label above 0.
py::list labels_of(const io::LabelMap& map) {
  const std::vector<io::LabelSummary> summaries = without_lock([&] { return io::summaries_of(map); });
  py::list list;
  for (const io::LabelSummary& summary : summaries) {
    if (summary.label == 0) continue;
    std::vector<std::string> names;
    for (const io::LabelSegment& segment : map.segments)
      if (segment.layer == summary.layer && segment.label == summary.label) names.push_back(segment.name);
    list.append(py::make_tuple(summary.label, summary.layer, py::tuple(py::cast(names)), summary.voxels,
                               py::tuple(py::cast(summary.first)), py::tuple(py::cast(summary.size)),
                               py::tuple(py::cast(summary.touches))));
  }
  return list;
}

/// Voxels of one layer as their labels, (I, J, K), i fastest in memory.
py::array voxels_of(const io::LabelMap& map, std::size_t layer) {
  if (layer >= map.layers.size())
    throw UsageError("layer: the label map has " + std::to_string(map.layers.size()));
  const auto& indices = map.layers[layer];
  std::vector<std::uint32_t> labels(indices.size());
  for (std::size_t v = 0; v < indices.size(); ++v) labels[v] = map.labels[indices[v]];
  const auto [i, j, k] = map.grid.size;
  return array_of(std::move(labels))
      .attr("reshape")(py::make_tuple(k, j, i))
      .attr("transpose")()
      .cast<py::array>();
}

py::dict surface_dict(LabelSurface&& surface, const BodyImage& image) {
  py::dict dict;
  py::list cuts, pieces;
  for (const CapPlane& cap : surface.caps)
    cuts.append(py::make_tuple(std::string(1, "ijk"[cap.axis]), cap.high ? "last" : "first",
                               array_of(cap.normal), cap.offset, cap.area,
                               array_of(std::vector<Index>(cap.triangles))));
  for (const LabelPiece& piece : surface.pieces)
    pieces.append(py::make_tuple(piece.voxels, piece.volume, piece.kept));
  dict["cuts"] = cuts;
  dict["pieces"] = pieces;
  dict["cavities"] = py::make_tuple(surface.cavities.count, surface.cavities.voxels, surface.cavities.volume);
  dict["spacing_mm"] = array_of(surface.spacing);
  dict["digitisation_mm"] = surface.digitisation;
  dict["simplification_error_mm"] =
      surface.simplification ? py::object(py::float_(surface.simplification->largest_error)) : py::none();
  dict["image"] = py::cast(image);
  dict["mesh"] = without_lock([&] { return Mesh(std::move(surface.mesh)); });
  return dict;
}

py::dict bone_dict(io::LabelBone&& bone) {
  py::dict dict = surface_dict(std::move(bone.surface), bone.image);
  dict["name"] = bone.name;
  dict["label"] = bone.label.label;
  dict["voxels"] = bone.voxels;
  dict["notes"] = notes_of(bone.notes);
  return dict;
}

LabelSurfaceOptions surface_options_in(const py::dict& given) {
  LabelSurfaceOptions options;
  options.sigma_voxels = given["sigma_voxels"].cast<double>();
  options.all_pieces = given["all_pieces"].cast<bool>();
  options.keep_cavities = given["keep_cavities"].cast<bool>();
  options.triangles = given["triangles"].cast<std::optional<std::size_t>>();
  return options;
}

io::LabelBoneRequest bone_request_in(const std::string& label, const std::string& task,
                                     const py::dict& surface) {
  return {label, task.empty() ? std::nullopt : io::label_task_of(task), surface_options_in(surface)};
}

py::dict label_bone(const io::LabelMap& map, const std::string& file, const std::string& label,
                    const std::string& task, const py::dict& surface, const py::object& progress) {
  const io::LabelBoneRequest request = bone_request_in(label, task, surface);
  auto bone = with_progress(progress,
                            [&](const Control& control) { return io::bone_of(map, file, request, control); });
  return bone_dict(std::move(*bone));
}

/// A surface of voxels that numpy holds: the box of those inside, (I, J, K) of uint8 with i fastest, and where it lies.
py::dict mask_surface(const py::array_t<std::uint8_t, py::array::f_style>& inside,
                      const std::array<std::int64_t, 3>& first, const std::array<std::int64_t, 3>& image_size,
                      const py::array_t<double, py::array::c_style | py::array::forcecast>& affine,
                      const py::dict& options, const py::object& progress) {
  VoxelMask mask;
  mask.image.size = image_size;
  mask.first = first;
  for (int i = 0; i < 3; ++i) {
    mask.size[static_cast<std::size_t>(i)] = inside.shape(i);
    for (int j = 0; j < 4; ++j) mask.image.X_WI(i, j) = affine.at(i, j);
  }
  mask.inside.assign(inside.data(), inside.data() + inside.size());
  const LabelSurfaceOptions surface_options = surface_options_in(options);
  auto surface = with_progress(
      progress, [&](const Control& control) { return surface_of(mask, surface_options, control); });
  const BodyImage image = io::image_of(mask.image, *surface);
  return surface_dict(std::move(*surface), image);
}

/// (bone, bone, side or None, keys to fill in, notes) of two bones that make a joint.
py::tuple label_joint(const io::LabelMap& map, const io::LabelMap* mobile_map, const std::string& file,
                      const std::optional<std::string>& mobile_file, const std::array<std::string, 2>& labels,
                      const std::string& task, const std::string& side, const py::dict& surface,
                      const py::object& progress) {
  io::LabelJointRequest request{.labels = file,
                                .fixed = bone_request_in(labels[0], task, surface),
                                .mobile = bone_request_in(labels[1], task, surface),
                                .joint_file = "joint.toml"};
  if (mobile_file) request.mobile_labels = *mobile_file;
  if (!side.empty()) request.side = side == "right" ? Side::right : Side::left;
  auto joint = with_progress(
      progress, [&](const Control& control) { return io::propose_joint(map, mobile_map, request, control); });
  const auto& found = joint->proposal.side;
  return py::make_tuple(bone_dict(std::move(joint->fixed)), bone_dict(std::move(joint->mobile)),
                        found ? py::object(py::str(std::string(name_of(*found)))) : py::none(),
                        joint->proposal.to_fill_in, notes_of(joint->notes));
}

}  // namespace

void bind_labels(py::module_& module) {
  py::class_<BodyImage>(module, "BodyImage");
  py::class_<io::LabelMap>(module, "LabelMap")
      .def_property_readonly("size",
                             [](const io::LabelMap& map) { return py::tuple(py::cast(map.grid.size)); })
      .def_property_readonly("lps_from_index",
                             [](const io::LabelMap& map) { return affine_array(map.grid.X_WI); })
      .def_property_readonly("layers", [](const io::LabelMap& map) { return map.layers.size(); })
      .def_property_readonly("notes", [](const io::LabelMap& map) { return notes_of(map.notes); })
      .def("labels", &labels_of)
      .def("voxels", &voxels_of);
  module.def("read_labels", &read_label_map);
  module.def("label_bone", &label_bone);
  module.def("mask_surface", &mask_surface);
  module.def("label_joint", &label_joint, py::arg("map"), py::arg("mobile_map").none(true), py::arg("file"),
             py::arg("mobile_file"), py::arg("labels"), py::arg("task"), py::arg("side"), py::arg("surface"),
             py::arg("progress"));
}

}  // namespace condyle::python
