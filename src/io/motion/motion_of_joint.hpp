#pragma once

#include <optional>
#include <vector>

#include "condyle/answer/motion.hpp"
#include "io/result/motion_result.hpp"

namespace condyle::io {

/// The surfaces of a recorded motion. Depths have no mean of two castings: without pressure the surface that moves casts where both would.
ContactEntry motion_contact(ContactEntry entry, bool with_pressure);

/// answer_motion() of a question's surfaces, by depth or with the pressure of its layers.
class MotionOfJoint {
 public:
  /// The request takes names, casting and rays from the question, which outlives this. Throws as ElasticContact and NormalDepth do.
  MotionOfJoint(const MotionQuestion& question, MotionRequest request);

  /// What is known before the frames, which take long: notes on the numbers of the motion, its layers and its loads.
  const std::vector<motion::ContactNote>& notes() const noexcept { return notes_; }
  /// Its notes begin with these. Empty if it was stopped.
  std::optional<MotionAnswer> answer(const Control& control) const;

 private:
  const contact::ElasticContact* layers() const noexcept { return layers_ ? &*layers_ : nullptr; }

  const Joint& joint_;
  const ContactSurfaces& surfaces_;
  MotionRequest request_;
  bool to_limits_;
  std::optional<contact::ElasticContact> layers_;
  std::vector<motion::ContactNote> notes_;
};

}  // namespace condyle::io
