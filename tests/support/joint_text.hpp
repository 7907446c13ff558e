#pragma once

#include <initializer_list>

#include "condyle/io/joint_file.hpp"
#include "support/test.hpp"

/// Joint files for tests, which say only what they are about.

namespace condyle::test {

inline std::string mesh_key(const std::filesystem::path& file) {
  return "mesh = \"" + file.string() + "\"";
}

inline constexpr std::string_view plain_axes = "anterior = [1, 0, 0]\nsuperior = [0, 1, 0]\n";

/// A right hip of two meshes in its own axes, unless it says otherwise. Views of what the caller has.
struct JointText {
  std::string_view name = "hip", kind = "ball", side = "right", units = "mm";
  /// Further lines before the bodies, in their tables and about the frame (without a centre if it is empty), and further tables.
  std::string_view keys = "", fixed = "mesh = \"fixed.ply\"", mobile = "mesh = \"mobile.ply\"";
  std::string_view centre = "[0, 0, 0]", axes = plain_axes, more = "";
};

inline std::string joint_text(const JointText& joint) {
  std::string text;
  for (const std::string_view part :
       std::initializer_list<std::string_view>{"condyle = 1\nname = \"",
                                               joint.name,
                                               "\"\nkind = \"",
                                               joint.kind,
                                               "\"\nside = \"",
                                               joint.side,
                                               "\"\nunits = \"",
                                               joint.units,
                                               "\"\n",
                                               joint.keys,
                                               "[fixed]\n",
                                               joint.fixed,
                                               "\n[mobile]\n",
                                               joint.mobile,
                                               "\n[frame]\n",
                                               joint.centre.empty() ? "" : "centre = ",
                                               joint.centre,
                                               "\n",
                                               joint.axes,
                                               joint.more})
    text += part;
  return text;
}

/// What a joint file is refused with behind its name, or "accepted".
inline std::string joint_refusal(const std::filesystem::path& file) {
  return complaint_about<FileError>(file, [](const auto& path) { io::read_joint(path); });
}

}  // namespace condyle::test
