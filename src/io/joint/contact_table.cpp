#include "io/joint/contact_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/provenance.hpp"
#include "io/file/whole_file.hpp"
#include "io/joint/mesh_path.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

LayerEntry layer_entry(TomlTable& table, double mm_per_unit, const std::filesystem::path& folder) {
  LayerEntry layer;
  layer.youngs_modulus_mpa = table.required("youngs_modulus_mpa", table.number("youngs_modulus_mpa"));
  if (!(layer.youngs_modulus_mpa > 0)) table.fail("youngs_modulus_mpa", "must be above 0");
  layer.poisson_ratio = table.required("poisson_ratio", table.number("poisson_ratio"));
  if (!(layer.poisson_ratio > -1 && layer.poisson_ratio < 0.5))
    table.fail("poisson_ratio", "must be above -1 and below 0.5");
  if (const auto behind = table.text("behind")) layer.behind = folder / mesh_path(table, "behind", *behind);
  if (const auto file = table.text("thickness_file")) {
    for (const auto key : {"thickness", "behind"})
      if (table.has(key))
        table.fail(key, "stands beside thickness_file, which has the thickness of each vertex");
    layer.thickness_file = folder / mesh_path(table, "thickness_file", *file);
    layer.mm_per_unit = mm_per_unit;
  }
  const auto thickness = table.number("thickness");
  if (!layer.behind && !layer.thickness_file) table.required("thickness", thickness);
  if (thickness) {
    if (!(*thickness > 0)) table.fail("thickness", "must be above 0");
    layer.thickness_mm = mm_per_unit * *thickness;
  }
  if (const auto bounds = table.pair("thickness_bounds")) {
    if (!layer.behind && !layer.thickness_file)
      table.fail("thickness_bounds", "is of a thickness that varies: by behind or thickness_file");
    if (!(bounds->front() >= 0 && bounds->front() <= bounds->back()))
      table.fail("thickness_bounds", "must be [least, greatest], both 0 or more");
    layer.thickness_bounds_mm = {mm_per_unit * bounds->front(), mm_per_unit * bounds->back()};
  }
  table.finish();
  return layer;
}

RegionEntry region_entry(TomlTable& table, double mm_per_unit) {
  RegionEntry region{table.required("name", table.text("name")), {}};
  // The name begins names of columns.
  if (region.name.empty() ||
      region.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
    table.fail("name", "must be of small letters, digits and _");
  for (TomlTable& half : table.tables("half_space")) {
    const Vec3 normal = half.required("normal", half.triple("normal"));
    if (normal.isZero()) half.fail("normal", "must not be zero");
    region.half_spaces.push_back({normal.normalized(), mm_per_unit * half.number("offset").value_or(0)});
    half.finish();
  }
  if (region.half_spaces.empty()) table.fail_missing("half_space");
  table.finish();
  return region;
}

}  // namespace

ContactEntry contact_entry(TomlTable& table, double mm_per_unit, const std::filesystem::path& folder) {
  ContactEntry entry;
  entry.fixed_part = table.text("fixed_part").value_or("");
  entry.mobile_part = table.text("mobile_part").value_or("");
  constexpr contact::Casting castings[] = {contact::Casting::fixed, contact::Casting::mobile,
                                           contact::Casting::both};
  if (const auto word = table.word("casting", {"fixed", "mobile", "both"})) entry.casting = castings[*word];
  if (const auto word = table.word("rule", {"face_centre", "cut_faces"}))
    entry.rays.rule = *word == 0 ? contact::FaceRule::face_centre : contact::FaceRule::cut_faces;
  if (const auto reach = table.number("reach")) {
    if (!(*reach > 0)) table.fail("reach", "must be above 0");
    entry.rays.reach_mm = mm_per_unit * *reach;
  }
  if (const auto word = table.word("law", {"linear", "logarithmic"}))
    entry.law = *word == 0 ? contact::PressureLaw::linear : contact::PressureLaw::logarithmic;
  if (const auto word = table.word("moment_on", {"casting", "target"}))
    entry.moment_on = *word == 0 ? MomentOn::casting : MomentOn::target;
  std::set<std::string> names;
  for (TomlTable& region : table.tables("region")) {
    entry.regions.push_back(region_entry(region, mm_per_unit));
    const std::string& name = entry.regions.back().name;
    if (!names.insert(name).second) region.fail("name", fmt::format("\"{}\" is given twice", name));
  }
  if (auto layer = table.table("fixed")) entry.fixed = layer_entry(*layer, mm_per_unit, folder);
  if (auto layer = table.table("mobile")) entry.mobile = layer_entry(*layer, mm_per_unit, folder);
  table.finish();
  return entry;
}

namespace {

/// Distance from each vertex of a body's mesh to the mesh behind it, which is brought into the joint as the body's
/// own mesh was.
std::vector<double> measured(const Body& layer, const LayerEntry& entry, const MeshOrigin& origin,
                             double reach) {
  TriMesh bone = read_mesh(*entry.behind).mesh;
  for (std::size_t v = 0; v < bone.vertices.size(); ++v)
    bone.vertices.set(v, origin.joint_from_source * bone.vertices[v]);
  std::vector<double> thickness = contact::thickness_to(layer.mesh, Mesh(std::move(bone)), reach);
  std::size_t without = 0, first = 0;
  for (std::size_t v = thickness.size(); v-- > 0;)
    if (!(thickness[v] > 0)) thickness[v] = entry.thickness_mm, ++without, first = v;
  if (without > 0 && entry.thickness_mm == 0)
    throw MeshError(
        fmt::format("{}: {} of {} vertices, vertex {} the first, have nothing of {} behind them within {} mm "
                    "(a thickness beside it would count there)",
                    layer.name, without, thickness.size(), first, entry.behind->string(), reach));
  return thickness;
}

/// One number in a line for each vertex of the surface.
std::vector<double> read_thickness(const LayerEntry& entry, const Body& surface) {
  const std::filesystem::path& path = *entry.thickness_file;
  const std::string text = io::read_whole_file(path), name = path.string();
  const Source source{text, name};
  TextCursor cursor(source);
  std::vector<double> thickness;
  for (auto word = cursor.word(); !word.empty(); word = cursor.word()) {
    double value = 0;
    if (!io::parse_number(word, value) || !(value > 0) || !std::isfinite(value))
      source.fail(
          fmt::format("line {}: {} is no thickness: a number above 0", cursor.line(), io::in_quotes(word)));
    thickness.push_back(entry.mm_per_unit * value);
  }
  if (thickness.size() != surface.mesh.vertices().size())
    source.fail(fmt::format("{} thicknesses for the {} vertices of {}", thickness.size(),
                            surface.mesh.vertices().size(), surface.name));
  return thickness;
}

}  // namespace

ContactSurfaces surfaces_of(const ContactEntry& entry, const Joint& joint) {
  const auto surface = [](const Body& body, const std::string& part) {
    return part.empty() ? body : Body{part, mesh_of_part(body, part)};
  };
  return {surface(joint.fixed, entry.fixed_part), surface(joint.mobile, entry.mobile_part)};
}

contact::ElasticContactOptions elastic_options(const ContactEntry& entry, const ContactSurfaces& surfaces,
                                               const LoadedJoint& joint) {
  const Provenance from = provenance_of(joint, {});
  const auto layer = [&](const std::optional<LayerEntry>& of, const Body& surface, const MeshOrigin& origin) {
    std::optional<contact::ElasticLayer> made;
    if (!of) return made;
    made.emplace(contact::ElasticLayer{of->youngs_modulus_mpa, of->poisson_ratio, of->thickness_mm,
                                       of->thickness_bounds_mm});
    if (of->thickness_file) made->thickness_mm = read_thickness(*of, surface);
    if (of->behind) made->thickness_mm = measured(surface, *of, origin, entry.rays.reach_mm);
    return made;
  };
  return {entry.casting, entry.rays, entry.law, layer(entry.fixed, surfaces.fixed, from.fixed),
          layer(entry.mobile, surfaces.mobile, from.mobile)};
}

}  // namespace condyle::io
