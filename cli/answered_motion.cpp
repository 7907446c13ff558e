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

MotionAnswer answered_motion(const MotionQuestion& question, MotionRequest request, Strictness strictness) {
  const Body &fixed = question.surfaces.fixed, &mobile = question.surfaces.mobile;
  request.names = {fixed.name, mobile.name};
  request.casting = question.contact.casting == Casting::fixed ? BodyRole::fixed : BodyRole::mobile;
  request.rays = question.contact.rays;
  std::optional<ElasticContact> elastic;
  if (question.with_pressure)
    elastic.emplace(fixed.mesh, mobile.mesh,
                    elastic_options(question.contact, question.surfaces, question.joint));
  const ElasticContact* layers = elastic ? &*elastic : nullptr;
  std::vector<ContactNote> notes = question.motion.notes;
  add_new(notes, motion_request_notes(layers, request));
  // Frames take long: notes that are errors end the command before them.
  if (strictness == Strictness::errors) note_contact(notes, question.joint, strictness);
  const JointContact bodies(fixed.mesh, mobile.mesh);
  MotionAnswer answer = followed_by_stage(
      [&](const AnswerControl& control) { return answer_motion(bodies, layers, request, control); });
  add_new(notes, std::move(answer.notes));
  answer.notes = std::move(notes);
  return answer;
}

}  // namespace condyle::cli
