#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "condyle/answer.hpp"
#include "core/formatted.hpp"

namespace condyle {
namespace {

using core::formatted;

/// By how much the limit of one motion differs between two centres.
struct Change {
  std::size_t motion;
  double from_deg, to_deg;

  double size_deg() const noexcept { return std::abs(to_deg - from_deg); }
};

/// The changes between the head's and the socket's centre, the smallest first; empty if neither moves a limit.
std::vector<Change> changes_between(const Joint& joint, std::span<const Motion> motions,
                                    const RangeOptions& range, const Vec3& head, const Vec3& socket) {
  const std::array centres{head, socket};
  const std::vector<DisplacedLimit> limits = limits_about(joint, motions, range, centres);
  std::vector<Change> changes;
  for (std::size_t m = 0; m < motions.size(); ++m)
    changes.push_back({m, limits[m].turned.degrees(), limits[motions.size() + m].turned.degrees()});
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.size_deg() < b.size_deg(); });
  return changes;
}

/// Limits about the head's centre and about the socket's, if these are apart.
void note_centres(const Joint& joint, std::span<const Motion> motions, const RangeOptions& range,
                  const BearingSurface& surface, std::vector<RangeNote>& notes) {
  if (!surface.socket || motions.empty()) return;
  const Vec3 head = pose_at(joint.coordinates(), range.overlap.reference_pose) * surface.head.centre;
  const Vec3& socket = surface.socket->centre;
  const double apart = (socket - head).norm();
  if (apart <= centres_apart_mm) return;
  const std::vector<Change> changes = changes_between(joint, motions, range, head, socket);
  const Change &most = changes.back(), &middle = changes[changes.size() / 2];
  std::string text = formatted("head and socket have their centres %.1f mm apart: ", apart);
  text += formatted("limits about the socket's centre instead of the head's differ by up to %.1f degrees (",
                    most.size_deg());
  text += motions[most.motion].name + formatted(": %.1f, not %.1f", most.to_deg, most.from_deg);
  text += changes.size() > 1 ? formatted("), by %.1f in the median", middle.size_deg()) : ")";
  notes.push_back({RangeNoteCode::centre_moves_limits, std::move(text)});
}

/// Whose cut a motion ends on; null if it ends elsewhere. The missing bone goes on beyond the cut, and would have met the other bone
/// no later.
const Body* cut_body_of(const Joint& joint, const MotionLimit& limit) {
  const std::optional<ContactWitness>& contact = limit.end.contact;
  if (!contact) return nullptr;
  if (is_on_cut(joint.fixed, contact->fixed_point)) return &joint.fixed;
  return is_on_cut(joint.mobile, contact->mobile_point) ? &joint.mobile : nullptr;
}

void note_cuts(const Joint& joint, std::span<const MotionLimit> limits, std::vector<RangeNote>& notes) {
  for (const Body* body : {&joint.fixed, &joint.mobile}) {
    std::string motions;
    for (const MotionLimit& limit : limits)
      if (cut_body_of(joint, limit) == body) motions += (motions.empty() ? "" : ", ") + limit.motion.name;
    if (!motions.empty())
      notes.push_back(
          {RangeNoteCode::limit_on_cut, "no limits: " + motions + " on the face that closes " + body->name +
                                            " where its image ends; the joint stops there at the latest"});
  }
}

}  // namespace

std::string_view name_of(RangeNoteCode code) noexcept {
  switch (code) {
    case RangeNoteCode::centre_moves_limits:
      return "centre_moves_limits";
    case RangeNoteCode::narrow_bearing_margin:
      return "narrow_bearing_margin";
    case RangeNoteCode::limit_on_cut:
      return "limit_on_cut";
  }
  return "";
}

std::vector<RangeNote> range_notes(const Joint& joint, std::span<const MotionLimit> limits,
                                   const RangeOptions& range, const BearingFinding& bearing) {
  std::vector<RangeNote> notes;
  note_cuts(joint, limits, notes);
  std::vector<Motion> motions;
  for (const MotionLimit& limit : limits) motions.push_back(limit.motion);
  if (bearing.surface) note_centres(joint, motions, range, *bearing.surface, notes);
  if (range.bearing.rule == BearingRule::leave_out && bearing.narrow_margin)
    notes.push_back(
        {RangeNoteCode::narrow_bearing_margin,
         formatted(
             "head and rim are only %.2f mm apart: contact counts as bearing within %.2f mm of the head "
             "only, and contact inside the socket may be called impingement",
             bearing.narrow_margin->rim_gap_mm, std::max(0.0, bearing.narrow_margin->margin_mm))});
  return notes;
}

}  // namespace condyle
