#pragma once

#include <string>

#include "support/joint_text.hpp"

namespace condyle::test {

/// A joint file of an arm on a post about the origin, with X anterior and Y superior, unless it says otherwise.
struct JointOfFile {
  std::string fixed = "post.ply", mobile = "arm.ply";  ///< a mesh, or the lines of the body's table
  std::string more = "";                               ///< tables after these
  std::string kind = "ball", name = "arm and post", side = "right";
  std::string joint = "";  ///< none is stated
  std::string units = "mm", centre = "[0, 0, 0]", anterior = "[1, 0, 0]";
};

inline std::string text_of_joint(const JointOfFile& joint) {
  const auto body = [](const std::string& body) {
    return body.find('=') == body.npos ? mesh_key(body) : body;
  };
  // The joint's key stands below its kind, where tests replace both.
  const std::string kind = joint.joint.empty() ? joint.kind : joint.kind + "\"\njoint = \"" + joint.joint,
                    axes = "anterior = " + joint.anterior + "\nsuperior = [0, 1, 0]\n",
                    fixed = body(joint.fixed), mobile = body(joint.mobile);
  return joint_text({.name = joint.name,
                     .kind = kind,
                     .side = joint.side,
                     .units = joint.units,
                     .fixed = fixed,
                     .mobile = mobile,
                     .centre = joint.centre,
                     .axes = axes,
                     .more = joint.more});
}

}  // namespace condyle::test
