#include "io/joint/proposal_lines.hpp"

#include <toml++/toml.h>

#include <sstream>

#include "condyle/joint_checks.hpp"
#include "condyle/version.hpp"
#include "io/file/format_version.hpp"
#include "io/file/path_from.hpp"
#include "io/mesh/polygon_rule.hpp"

namespace condyle::io {
namespace {

void add_keys(ProposalLines& lines, std::string_view role, const ProposedBody& body,
              const std::filesystem::path& joint_file) {
  lines.add(fmt::format("\n[{}]", role));
  for (const std::string& comment : body.comments) lines.add("# " + comment);
  lines.add("name = " + toml_text(body.name));
  lines.add("mesh = " + toml_text(path_from(joint_file, body.file)));
  if (body.scale != 1) lines.key("scale", fmt::format("[{0:g}, {0:g}, {0:g}]", body.scale), body.scale_by);
  if (body.polygons != PolygonRule::refuse)
    lines.add(fmt::format("polygons = \"{}\"", name_of(body.polygons)));
  if (body.is_piece_at_joint)
    lines.key("pieces", "\"at_joint\"",
              "the mesh has another large piece beside this one, as a whole pelvis has");
}

}  // namespace

std::string toml_text(std::string_view text) {
  std::ostringstream out;
  out.exceptions(std::ios::badbit);  // no memory is an error, not half a text
  out << toml::value<std::string>(std::string(text));
  return out.str();
}

std::string toml_vector(const Vec3& v) {
  return fmt::format("[{:g}, {:g}, {:g}]", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);  // no -0
}

void add_head(ProposalLines& lines, const ProposedBody& fixed, const ProposedBody& mobile,
              const ProposalFacts& facts) {
  lines.add(fmt::format("# Proposed by condyle init {} from {}. Each value has a comment with its evidence;",
                        version, facts.from));
  lines.add("# lines that begin with # and a key could not be inferred and are to be filled in.");
  lines.add(fmt::format("condyle = {}", io::format_version));
  lines.add("name = " + toml_text(mobile.name + " in " + fixed.name));
}

void add_units(ProposalLines& lines, const std::optional<Stated<LengthUnit>>& units,
               const ProposedBody& fixed, const ProposedBody& mobile) {
  if (!units)
    return lines.missing(
        "units", "\"mm\", \"cm\", \"in\" or \"m\"",
        "the sizes of the meshes do not speak for one unit of human bones: --units mm, cm, in "
        "or m says which, and --species whose they are if not a human's");
  lines.key("units", fmt::format("\"{}\"", name_of(units->value)), units->by);
  std::string note;
  if (units->value != LengthUnit::millimetres && units->by.starts_with("inferred"))
    note = fmt::format("the meshes are taken to be in {}, {}", plural_of(units->value), units->by);
  for (const ProposedBody* body : {&fixed, &mobile})
    if (body->scale != 1)
      note += fmt::format("{}{} is scaled by {:g}, {}", note.empty() ? "" : "; ", body->name, body->scale,
                          body->scale_by);
  if (!note.empty()) lines.units_note = note + ": --units mm, or --species of an animal, says otherwise";
}

void add_image(ProposalLines& lines, std::string_view role, const std::optional<BodyImage>& image) {
  if (!image) return;
  const auto exact = [](const Vec3& v) {
    return fmt::format("[{}, {}, {}]", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
  };
  lines.add(fmt::format(
      "\n[{}.image]  # the edges of a voxel, mm: bands take a quarter of it as the surface's uncertainty",
      role));
  constexpr std::string_view edges[] = {"voxel_i", "voxel_j", "voxel_k"};
  for (int i = 0; i < 3; ++i) lines.add(fmt::format("{} = {}", edges[i], exact(image->voxel.col(i))));
  for (const ImageCut& cut : image->cuts) {
    lines.add(fmt::format("[[{}.image.cut]]  # a flat face that closes the bone where the image ends", role));
    lines.add("normal = " + exact(cut.normal));
    lines.add(fmt::format("offset = {}", cut.offset_mm));
  }
  for (const JointNote& note : image->notes) {
    lines.add(fmt::format("[[{}.image.note]]  # repeated in every answer", role));
    lines.add(fmt::format("code = \"{}\"", name_of(note.code)));
    lines.add("text = " + toml_text(note.text));
  }
}

void add_body(ProposalLines& lines, std::string_view role, const ProposedBody& body,
              const std::filesystem::path& joint_file) {
  add_keys(lines, role, body, joint_file);
  add_image(lines, role, body.image);
}

}  // namespace condyle::io
