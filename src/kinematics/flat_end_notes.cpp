#include "kinematics/flat_end_notes.hpp"

#include "core/formatted.hpp"
#include "kinematics/flat_ends.hpp"

namespace condyle::kinematics {

std::vector<JointNote> flat_end_notes(const Joint& joint) {
  std::vector<JointNote> notes;
  for (const BodyRole role : {BodyRole::fixed, BodyRole::mobile}) {
    const Body& body = role == BodyRole::fixed ? joint.fixed : joint.mobile;
    for (const ImageCut& plane : flat_ends_near_joint(joint, role)) {
      const FlatFace face = face_in(body.mesh, plane);
      notes.push_back(
          {JointNoteCode::flat_end,
           body.name + core::formatted(" ends in a plane %.0f mm from the joint centre, a face of %.0f mm2, "
                                       "as a bone that was cut for export does: what is missing may end a "
                                       "motion earlier, and limits are upper bounds",
                                       face.distance_mm, face.area_mm2)});
    }
  }
  return notes;
}

}  // namespace condyle::kinematics
