#include "io/joint/motion_lines.hpp"

#include "condyle/io/pose_text.hpp"

namespace condyle::io {

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

}  // namespace condyle::io
