#pragma once

#include <string>

namespace condyle::test {

/// A joint file of two meshes about the origin, with X anterior and Y superior.
struct JointText {
  std::string fixed = "post.ply", mobile = "arm.ply";  ///< a mesh, or the lines of the body's table
  std::string more = "";                               ///< tables after these
  std::string kind = "ball", name = "arm and post", side = "right";
  std::string joint = "";  ///< none is stated
  std::string units = "mm", centre = "[0, 0, 0]", anterior = "[1, 0, 0]";
};

inline std::string joint_text(const JointText& joint) {
  const auto body = [](const std::string& body) {
    return body.find('=') == body.npos ? "mesh = \"" + body + "\"\n" : body + "\n";
  };
  return "condyle = 1\nname = \"" + joint.name + "\"\nkind = \"" + joint.kind + "\"\n" +
         (joint.joint.empty() ? "" : "joint = \"" + joint.joint + "\"\n") + "side = \"" + joint.side +
         "\"\nunits = \"" + joint.units + "\"\n[fixed]\n" + body(joint.fixed) + "[mobile]\n" +
         body(joint.mobile) + "[frame]\ncentre = " + joint.centre + "\nanterior = " + joint.anterior +
         "\nsuperior = [0, 1, 0]\n" + joint.more;
}

}  // namespace condyle::test
