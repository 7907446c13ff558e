#include "io/joint/settings_lines.hpp"

#include "condyle/io/pose_text.hpp"
#include "io/joint/ligament_tables.hpp"
#include "io/motion/column_zero.hpp"

namespace condyle::io {
namespace {

void add_motions(ProposalLines& lines, std::span<const motion::Motion> motions, Anatomy anatomy) {
  for (const motion::Motion& motion : motions) {
    const double from = angle_of(motion.start, motion.vary).degrees();
    lines.add("\n[[motion]]");
    lines.add("name = " + toml_text(motion.name));
    lines.add(fmt::format("vary = \"{}\"", name_of(motion.vary, anatomy)));
    lines.add(fmt::format("range = [{:.12g}, {:.12g}]", from,
                          from + sign_of(motion.sense) * motion.range.degrees()));
    for (const JointAngle angle : all_joint_angles)
      if (angle != motion.vary && angle_of(motion.start, angle) != Angle())
        lines.add(
            fmt::format("{} = {:.12g}", name_of(angle, anatomy), angle_of(motion.start, angle).degrees()));
  }
}

void add_uncertainty(ProposalLines& lines, const motion::Uncertainty& sigma, std::uint64_t seed) {
  lines.add("\n[uncertainty]");
  lines.add(
      fmt::format("centre = {}\naxes = {:.12g}\nseed = {}", sigma.centre_mm, sigma.axes.degrees(), seed));
  if (!sigma.surface_from.empty())
    lines.add("surface = " + toml_text(sigma.surface_from));
  else if (sigma.surface_voxels == 0)
    lines.add(fmt::format("surface = {}", sigma.surface_mm));
}

/// { column = "knee_flex_r", unit = "rad", sign = -1, offset = 0.5 }
std::string column_text(const ColumnOfCoordinate& from) {
  std::string text = "{ column = " + toml_text(from.column);
  if (from.unit) text += fmt::format(", unit = \"{}\"", name_of(*from.unit));
  if (from.sign != 1) text += fmt::format(", sign = {}", from.sign);
  if (from.offset != 0) text += fmt::format(", offset = {}", from.offset);
  if (from.otherwise) text += fmt::format(", default = {}", *from.otherwise);
  if (from.range) text += fmt::format(", range = [{}, {}]", (*from.range)[0], (*from.range)[1]);
  return text + (from.is_locked ? ", locked = true }" : " }");
}

void add_recorded_motion(ProposalLines& lines, const RecordedMotionMapping& mapping,
                         const std::optional<ZeroOfColumns>& zero, const Joint& joint) {
  const auto* columns = std::get_if<std::vector<ColumnOfCoordinate>>(&mapping);
  if (!columns)
    return lines.add(
        "\n# [recorded_motion] is left out: it has poses of the meshes as they were given, and these meshes "
        "are "
        "in the joint frame.");
  lines.add("\n[recorded_motion]");
  for (const ColumnOfCoordinate& each : *columns)
    lines.add(fmt::format("{} = {}", each.coordinate, column_text(each)));
  if (zero) lines.add(io::zero_text_in_joint(*zero, *columns, joint));
}

}  // namespace

std::string person_text(const Person& person) {
  if (!person.age_years && !person.sex && person.species.empty()) return {};
  std::string text = "\n[person]\n";
  if (person.age_years) text += fmt::format("age = {}\n", *person.age_years);
  if (person.sex) text += fmt::format("sex = \"{}\"\n", name_of(*person.sex));
  if (!person.species.empty()) text += "species = " + toml_text(person.species) + "\n";
  return text;
}

void add_settings(ProposalLines& lines, const JointFile& file, const Joint& joint,
                  const motion::Uncertainty& sigma) {
  if (const std::string text = person_text(joint.person) + ligaments_text(joint.ligaments, 1); !text.empty())
    lines.add(text);
  add_motions(lines, file.motions, file.joint.anatomy);
  add_uncertainty(lines, sigma, file.band_seed);
  if (file.recorded_motion) add_recorded_motion(lines, *file.recorded_motion, file.recorded_zero, joint);
}

}  // namespace condyle::io
