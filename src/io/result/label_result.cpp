#include "io/result/label_result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "condyle/version.hpp"
#include "io/file/plain_text.hpp"
#include "io/result/json.hpp"
#include "mesh/label_surface/voxel_pieces.hpp"

namespace condyle::io {
namespace {

constexpr const char* side_names[] = {"first i", "last i", "first j", "last j", "first k", "last k"};

/// The names of a layer's label, in the order of the file.
class SegmentNames {
 public:
  explicit SegmentNames(const LabelInspection& image) {
    for (const LabelSegment& segment : image.segments)
      names_[{segment.layer, segment.label}].push_back(segment.name);
  }

  const std::vector<std::string>& of(const LabelSummary& summary) const {
    static const std::vector<std::string> none;
    const auto found = names_.find({summary.layer, summary.label});
    return found == names_.end() ? none : found->second;
  }

 private:
  std::map<std::pair<std::size_t, std::uint32_t>, std::vector<std::string>> names_;
};

std::string touched(const LabelSummary& summary) {
  std::string sides;
  for (std::size_t i = 0; i < 6; ++i)
    if (summary.touches[i]) sides += (sides.empty() ? "" : ", ") + std::string(side_names[i]);
  return sides.empty() ? sides : "; reaches the border: " + sides;
}

Json notes_json(const std::vector<LabelNote>& notes) {
  Json json = Json::array();
  for (const LabelNote& note : notes) json.push_back({{"code", name_of(note.code)}, {"text", note.text}});
  return json;
}

Json rows_json(const Eigen::Affine3d& X) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({X(i, 0), X(i, 1), X(i, 2), X(i, 3)});
  return rows;
}

Json provenance_json(const std::filesystem::path& image, const std::vector<std::string>& command) {
  return {{"version", version}, {"command", command}, {"image", image.string()}};
}

void append(std::string& text, const LabelInspection& image) {
  const auto& size = image.grid.size;
  const Eigen::RowVector3d h = image.grid.X_WI.linear().colwise().norm();
  text += fmt::format("{}\n  {} x {} x {} voxels of {:.4g} x {:.4g} x {:.4g} mm{}\n",
                      plain_text(image.image.string()), size[0], size[1], size[2], h(0), h(1), h(2),
                      image.layers > 1 ? fmt::format(", {} layers", image.layers) : "");
  for (const LabelNote& note : image.notes)
    text += fmt::format("  note: {}: {}\n", name_of(note.code), plain_text(note.text));
  const SegmentNames segment_names(image);
  for (std::size_t i = 0; i < image.labels.size(); ++i) {
    const LabelSummary& summary = image.labels[i];
    const std::string names = plain_text(fmt::format("{}", fmt::join(segment_names.of(summary), ", ")));
    const std::string label = image.layers > 1 ? fmt::format("{}:{}", summary.layer, summary.label)
                                               : fmt::format("{}", summary.label);
    text += fmt::format("  {:>5} {}: {} voxels in {} piece{}, box of {} x {} x {}{}\n", label,
                        names.empty() ? "(no name)" : names, summary.voxels, image.pieces[i],
                        image.pieces[i] == 1 ? "" : "s", summary.size[0], summary.size[1], summary.size[2],
                        touched(summary));
  }
  if (image.labels.empty()) text += "  no voxel has a label above 0\n";
}

Json inspection_json(const LabelInspection& image) {
  Json labels = Json::array();
  const SegmentNames segment_names(image);
  for (std::size_t l = 0; l < image.labels.size(); ++l) {
    const LabelSummary& summary = image.labels[l];
    Json touches = Json::array();
    for (std::size_t i = 0; i < 6; ++i)
      if (summary.touches[i]) touches.push_back(side_names[i]);
    labels.push_back({{"label", summary.label},
                      {"layer", summary.layer},
                      {"names", segment_names.of(summary)},
                      {"voxels", summary.voxels},
                      {"pieces", image.pieces[l]},
                      {"first", summary.first},
                      {"size", summary.size},
                      {"reaches_border", std::move(touches)}});
  }
  return {{"file", image.image.string()}, {"size", image.grid.size},
          {"layers", image.layers},       {"lps_from_index", rows_json(image.grid.X_WI)},
          {"labels", std::move(labels)},  {"notes", notes_json(image.notes)}};
}

}  // namespace

std::string surface_text(const LabelBone& bone) {
  const LabelSurface& surface = bone.surface;
  const Vec3& h = surface.spacing;
  std::string text = fmt::format(
      "{}: {} vertices, {} triangles\n"
      "  {} voxels of {:.4g} x {:.4g} x {:.4g} mm; off by about {:.2g} mm at most by the grid, by the "
      "segmentation "
      "unknown\n",
      plain_text(bone.name), surface.mesh.vertices.size(), surface.mesh.triangles.size(), bone.voxels, h.x(),
      h.y(), h.z(), surface.digitisation);
  if (surface.simplification)
    text += fmt::format("  simplified from {} triangles, within {:.3g} mm\n",
                        surface.simplification->triangles_before, surface.simplification->largest_error);
  return text;
}

std::string surface_json(const LabelBone& bone, const std::filesystem::path& image,
                         const std::vector<std::string>& command) {
  const LabelSurface& surface = bone.surface;
  Json caps = Json::array(), pieces = Json::array();
  for (const CapPlane& cap : surface.caps)
    caps.push_back({{"axis", std::string(1, "ijk"[cap.axis])},
                    {"side", cap.high ? "last" : "first"},
                    {"normal", numbers(cap.normal)},
                    {"offset_mm", cap.offset},
                    {"area_mm2", cap.area},
                    {"triangles", cap.triangles.size()}});
  for (const LabelPiece& piece : surface.pieces)
    pieces.push_back({{"voxels", piece.voxels}, {"volume_mm3", piece.volume}, {"kept", piece.kept}});
  Json json{{"name", bone.name},
            {"label", bone.label.label},
            {"layer", bone.label.layer},
            {"voxels", bone.voxels},
            {"spacing_mm", numbers(surface.spacing)},
            {"vertices", surface.mesh.vertices.size()},
            {"triangles", surface.mesh.triangles.size()},
            {"digitisation_mm", surface.digitisation},
            {"cuts", std::move(caps)},
            {"pieces", std::move(pieces)},
            {"cavities",
             {{"count", surface.cavities.count},
              {"voxels", surface.cavities.voxels},
              {"volume_mm3", surface.cavities.volume}}},
            {"simplification", nullptr},
            {"notes", notes_json(bone.notes)},
            {"provenance", provenance_json(image, command)}};
  if (surface.simplification)
    json["simplification"] = {{"triangles_before", surface.simplification->triangles_before},
                              {"largest_error_mm", surface.simplification->largest_error}};
  return document(json);
}

LabelInspection inspect_labels(const std::filesystem::path& image, const LabelFileOptions& options) {
  const LabelMap map = read_labels(image, options);
  std::vector<LabelSummary> labels = summaries_of(map);
  std::erase_if(labels, [](const LabelSummary& summary) { return summary.label == 0; });
  std::vector<std::vector<std::size_t>> of_layer;
  for (const std::vector<std::uint16_t>& layer : map.layers)
    of_layer.push_back(mesh::count_pieces(layer, map.grid.size, map.labels.size()));
  std::vector<std::size_t> pieces;
  for (const LabelSummary& summary : labels) {
    const auto label = std::lower_bound(map.labels.begin(), map.labels.end(), summary.label);
    pieces.push_back(of_layer[summary.layer][static_cast<std::size_t>(label - map.labels.begin())]);
  }
  return {image, map.grid, map.layers.size(), std::move(labels), std::move(pieces), map.segments, map.notes};
}

std::string labels_text(std::span<const LabelInspection> images) {
  std::string text;
  for (const LabelInspection& image : images) append(text, image);
  return text;
}

std::string labels_json(std::span<const LabelInspection> images, const std::vector<std::string>& command) {
  Json maps = Json::array(), files = Json::array();
  for (const LabelInspection& image : images) {
    maps.push_back(inspection_json(image));
    files.push_back(image.image.string());
  }
  return document(
      {{"label_maps", std::move(maps)},
       {"provenance", {{"version", version}, {"command", command}, {"images", std::move(files)}}}});
}

}  // namespace condyle::io
