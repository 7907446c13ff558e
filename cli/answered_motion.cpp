#include "answered_motion.hpp"

#include <utility>

#include "followed.hpp"

namespace condyle::cli {

io::ContactEntry motion_contact_of(const io::ContactChanges& options, const io::JointFile& file,
                                   bool with_pressure) {
  io::ContactEntry contact = contact_of(options, file, with_pressure);
  // Depths alone have no mean of two castings: the surface that moves casts.
  if (!with_pressure && contact.casting == contact::Casting::both) contact.casting = contact::Casting::mobile;
  return contact;
}

MotionAnswer answered_motion(const io::MotionQuestion& question, MotionRequest request,
                             Strictness strictness) {
  const Body &fixed = question.surfaces.fixed, &mobile = question.surfaces.mobile;
  request.names = {fixed.name, mobile.name};
  request.casting = question.contact.casting == contact::Casting::fixed ? BodyRole::fixed : BodyRole::mobile;
  request.rays = question.contact.rays;
  std::optional<contact::ElasticContact> elastic;
  if (question.with_pressure)
    elastic.emplace(fixed.mesh, mobile.mesh,
                    io::elastic_options(question.contact, question.surfaces, question.joint));
  const contact::ElasticContact* layers = elastic ? &*elastic : nullptr;
  std::vector<motion::ContactNote> notes = question.motion.notes;
  motion::add_new(notes, motion_request_notes(layers, request));
  // Frames take long: notes that are errors end the command before them.
  if (strictness == Strictness::errors) note_contact(notes, question.joint, strictness);
  const contact::JointContact bodies(fixed.mesh, mobile.mesh);
  MotionAnswer answer = followed_by_stage(
      [&](const AnswerControl& control) { return answer_motion(bodies, layers, request, control); });
  motion::add_new(notes, std::move(answer.notes));
  answer.notes = std::move(notes);
  return answer;
}

}  // namespace condyle::cli
