#include "motion_surfaces.hpp"

#include "followed.hpp"

namespace condyle::cli {

ContactEntry motion_contact_of(const ContactChanges& options, const JointFile& file, bool with_pressure) {
  ContactEntry contact = contact_of(options, file, with_pressure);
  // Depths alone have no mean of two castings: the surface that moves casts.
  if (!with_pressure && contact.casting == Casting::both) contact.casting = Casting::mobile;
  return contact;
}

MotionSurfaces::MotionSurfaces(const MotionQuestion& question)
    : bodies_(question.surfaces.fixed.mesh, question.surfaces.mobile.mesh),
      casting_(question.contact.casting == Casting::fixed ? BodyRole::fixed : BodyRole::mobile) {
  const Mesh &fixed = question.surfaces.fixed.mesh, &mobile = question.surfaces.mobile.mesh;
  if (question.with_pressure) {
    elastic_.emplace(fixed, mobile, elastic_options(question.contact, question.surfaces, question.joint));
  } else {
    const bool fixed_casts = casting_ == BodyRole::fixed;
    depth_.emplace(fixed_casts ? fixed : mobile, fixed_casts ? mobile : fixed, question.contact.rays);
  }
}

std::vector<std::optional<FrameContact>> MotionSurfaces::frames(
    std::span<const std::optional<Pose>> X_FM) const {
  const SurfaceQuestion surfaces = elastic_ ? SurfaceQuestion(&*elastic_) : SurfaceQuestion(&*depth_);
  return followed("frames", [&](const auto& follow, std::stop_token stop) {
    return contact_along(bodies_, surfaces, X_FM, {.casting = casting_, .progress = follow, .stop = stop});
  });
}

}  // namespace condyle::cli
