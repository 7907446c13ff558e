#include "answered_motion.hpp"

#include <utility>

#include "followed.hpp"

namespace condyle::cli {

ContactEntry motion_contact_of(const ContactChanges& options, const JointFile& file, bool with_pressure) {
  ContactEntry contact = contact_of(options, file, with_pressure);
  // Depths alone have no mean of two castings: the surface that moves casts.
  if (!with_pressure && contact.casting == Casting::both) contact.casting = Casting::mobile;
  return contact;
}

MotionAnswer answered_motion(const MotionQuestion& question, MotionRequest request) {
  const Body &fixed = question.surfaces.fixed, &mobile = question.surfaces.mobile;
  request.names = {fixed.name, mobile.name};
  request.casting = question.contact.casting == Casting::fixed ? BodyRole::fixed : BodyRole::mobile;
  const auto answer_by = [&](const SurfaceQuestion& surfaces) {
    const JointContact bodies(fixed.mesh, mobile.mesh);
    return followed_by_stage(
        [&](const AnswerControl& control) { return answer_motion(bodies, surfaces, request, control); });
  };
  MotionAnswer answer = [&] {
    if (question.with_pressure) {
      const ElasticContact elastic(fixed.mesh, mobile.mesh,
                                   elastic_options(question.contact, question.surfaces, question.joint));
      return answer_by(&elastic);
    }
    const bool fixed_casts = request.casting == BodyRole::fixed;
    const NormalDepth depth(fixed_casts ? fixed.mesh : mobile.mesh, fixed_casts ? mobile.mesh : fixed.mesh,
                            question.contact.rays);
    return answer_by(&depth);
  }();
  std::vector<ContactNote> notes = question.motion.notes;
  add_new(notes, std::move(answer.notes));
  answer.notes = std::move(notes);
  return answer;
}

}  // namespace condyle::cli
