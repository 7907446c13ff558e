#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "answer/limit_facts.hpp"
#include "answer/surface_notes.hpp"
#include "condyle/answer.hpp"
#include "core/formatted.hpp"
#include "kinematics/body_pieces.hpp"
#include "kinematics/ligament_checks.hpp"

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
std::vector<Change> changes_between(const Joint& joint, std::span<const motion::Motion> motions,
                                    const motion::RangeOptions& range, const Vec3& head, const Vec3& socket) {
  const std::array centres{head, socket};
  const std::vector<motion::DisplacedLimit> limits = motion::limits_about(joint, motions, range, centres);
  std::vector<Change> changes;
  for (std::size_t m = 0; m < motions.size(); ++m)
    changes.push_back({m, limits[m].turned.degrees(), limits[motions.size() + m].turned.degrees()});
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.size_deg() < b.size_deg(); });
  return changes;
}

/// Limits about the head's centre and about the socket's, if these are apart.
void note_centres(const Joint& joint, std::span<const motion::Motion> motions,
                  const motion::RangeOptions& range, const motion::BearingSurface& surface,
                  std::vector<RangeNote>& notes) {
  const auto centres = answer::centres_apart(joint, range, surface);
  if (!centres || motions.empty()) return;
  const double apart = (centres->socket - centres->head).norm();
  const std::vector<Change> changes = changes_between(joint, motions, range, centres->head, centres->socket);
  const Change &most = changes.back(), &middle = changes[changes.size() / 2];
  std::string text = formatted("head and socket have their centres %.1f mm apart: ", apart);
  text += formatted("limits about the socket's centre instead of the head's differ by up to %.1f degrees (",
                    most.size_deg());
  text += motions[most.motion].name + formatted(": %.1f, not %.1f", most.to_deg, most.from_deg);
  text += changes.size() > 1 ? formatted("), by %.1f in the median", middle.size_deg()) : ")";
  notes.push_back({RangeNoteCode::centre_moves_limits, std::move(text)});
}

/// The body on whose cut a motion ends; null if it ends elsewhere. The missing bone goes on beyond the cut, and would have met the other bone
/// no later.
const Body* cut_body_of(const Joint& joint, const motion::BearingFinding& bearing,
                        const motion::MotionLimit& limit) {
  const std::optional<motion::ContactWitness>& contact = limit.end.contact;
  if (!contact) return nullptr;
  if (is_on_cut(bearing.fixed_cuts, contact->fixed_point)) return &joint.fixed;
  return is_on_cut(bearing.mobile_cuts, contact->mobile_point) ? &joint.mobile : nullptr;
}

void note_cuts(const Joint& joint, std::span<const motion::MotionLimit> limits,
               const motion::BearingFinding& bearing, std::vector<RangeNote>& notes) {
  for (const Body* body : {&joint.fixed, &joint.mobile}) {
    std::string motions;
    for (const motion::MotionLimit& limit : limits)
      if (cut_body_of(joint, bearing, limit) == body)
        motions += (motions.empty() ? "" : ", ") + limit.motion.name;
    if (!motions.empty())
      notes.push_back(
          {RangeNoteCode::limit_on_cut,
           "no limits: " + motions + " on the face that closes " + body->name +
               " where its image, or the bone, was cut off; the joint stops there at the latest"});
  }
}

/// Whether a feature is of a face in which a part was cut, or at its edge.
bool is_of_cut(const Body& body, const motion::Feature& feature) {
  if (feature.kind == motion::FeatureKind::face) return is_cut_face(body, feature.id);
  for (std::size_t t = 0; t < body.mesh.triangles().size(); ++t) {
    if (!is_cut_face(body, t)) continue;
    const Triangle& corners = body.mesh.triangles()[t];
    const auto has = [&](Index v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); };
    if (has(feature.id) && (feature.kind == motion::FeatureKind::vertex || has(feature.other_end)))
      return true;
  }
  return false;
}

/// Motions that end on the face in which a part was cut from a bone: the planes are the joint file's.
void note_part_cuts(const Joint& joint, std::span<const motion::MotionLimit> limits,
                    std::vector<RangeNote>& notes) {
  for (const Body* body : {&joint.fixed, &joint.mobile}) {
    if (!is_cut(*body)) continue;
    std::string motions;
    for (const motion::MotionLimit& limit : limits) {
      const std::optional<motion::ContactWitness>& contact = limit.end.contact;
      if (!contact) continue;
      const motion::Feature& feature =
          body == &joint.fixed ? contact->fixed_feature : contact->mobile_feature;
      if (is_of_cut(*body, feature)) motions += (motions.empty() ? "" : ", ") + limit.motion.name;
    }
    if (!motions.empty())
      notes.push_back({RangeNoteCode::limit_on_part_cut,
                       motions + (motions.find(',') == motions.npos ? " ends" : " end") +
                           " on a face or an edge in which a part of " + body->name +
                           " is cut: where the planes lie decides " +
                           (motions.find(',') == motions.npos ? "this limit" : "these limits")});
  }
}

/// A vertex of a feature.
Index vertex_of(const Body& body, const motion::Feature& feature) {
  return feature.kind == motion::FeatureKind::face ? body.mesh.triangles()[feature.id][0] : feature.id;
}

/// Motions that end on a speck, another bone or another leg.
void note_pieces(const Joint& joint, std::span<const motion::MotionLimit> limits,
                 const motion::BearingFinding& bearing, std::vector<RangeNote>& notes) {
  const kinematics::OwnVertices own =
      kinematics::own_vertices(joint, bearing.surface ? std::optional(bearing.surface->head) : std::nullopt);
  for (const Body* body : {&joint.fixed, &joint.mobile}) {
    const bool is_fixed = body == &joint.fixed;
    const std::vector<Index>& own_here = is_fixed ? own.fixed : own.mobile;
    const std::string which =
        own_here.empty()
            ? " that is not most of it: "
            : " that holds neither its " + std::string(is_fixed ? "socket" : "head") + " nor most of it: ";
    std::map<std::size_t, std::string> motions;
    for (const motion::MotionLimit& limit : limits) {
      const std::optional<motion::ContactWitness>& contact = limit.end.contact;
      if (!contact) continue;
      const Index v = vertex_of(*body, is_fixed ? contact->fixed_feature : contact->mobile_feature);
      const auto piece = kinematics::stray_piece(*body, v, own_here);
      if (!piece) continue;
      std::string& names = motions[*piece];
      names += (names.empty() ? "" : ", ") + limit.motion.name;
    }
    for (const auto& [piece, names] : motions)
      notes.push_back({RangeNoteCode::limit_on_piece,
                       names + (names.find(',') == names.npos ? " ends" : " end") + " on a piece of " +
                           body->name + which + kinematics::piece_text(body->mesh, piece)});
  }
}

/// A ligament that runs through bone where it ends a motion would be longer round it, and end the motion earlier.
void note_ligaments(const Joint& joint, std::span<const motion::MotionLimit> limits,
                    std::vector<RangeNote>& notes) {
  std::string motions;
  for (const motion::MotionLimit& limit : limits) {
    if (limit.end.reason != motion::LimitReason::ligament) continue;
    const Ligament& ligament = joint.ligaments[*limit.end.ligament];
    const JointCoordinates at{limit.angles_at_limit(), limit.translation_mm.value_or(Vec3::Zero())};
    const auto run =
        kinematics::run_through(joint, ligament, pose_at(joint.coordinates(), at, joint.translation_frame));
    if (run)
      motions += (motions.empty() ? "" : "; ") + limit.motion.name + ", where ligament " + ligament.name +
                 " " + kinematics::text_of(*run, joint);
  }
  if (!motions.empty())
    notes.push_back({RangeNoteCode::limit_through_bone,
                     "limits are upper bounds, as the way round the bone is longer: " + motions});
}

std::string_view with_article(const Joint& joint) noexcept {
  if (!joint.names_its_joint()) return "a hinge";
  switch (joint.anatomy) {
    case Anatomy::knee:
      return "a knee";
    case Anatomy::ankle:
      return "an ankle";
    case Anatomy::elbow:
      return "an elbow";
    case Anatomy::hip:
      return "a hip";
    case Anatomy::shoulder:
      break;
  }
  return "a shoulder";
}

/// Where nothing distinguishes bearing contact from impingement because there is no head and no mesh is called bearing, and
/// surfaces ended a motion.
void note_sliding(const Joint& joint, std::span<const motion::MotionLimit> limits,
                  const motion::BearingFinding& bearing, std::vector<RangeNote>& notes) {
  const bool any_contact = std::any_of(
      limits.begin(), limits.end(), [](const motion::MotionLimit& limit) { return ends_in_contact(limit); });
  if (joint.has_head() || bearing.roles.distinguish_bearing() || !any_contact) return;
  notes.push_back({RangeNoteCode::sliding_surfaces,
                   "the surfaces of " + std::string(with_article(joint)) +
                       " slide on each other by nature, and a motion ends where the meshes first touch, "
                       "sliding contact included: limits are lower bounds of how far the joint turns, unless "
                       "the space of its cartilage keeps those surfaces apart"});
}

void note_narrow_margin(const Joint& joint, const motion::NarrowMargin& narrow,
                        std::vector<RangeNote>& notes) {
  const bool is_rim = narrow.by == motion::MarginLimit::rim;
  std::string text = !std::isfinite(narrow.gap_mm) ? "no rim was found round the head: "
                     : is_rim
                         ? formatted("head and rim are only %.2f mm apart: ", narrow.gap_mm)
                         : joint.fixed.name + formatted(" leaves the head only %.2f mm beside its socket: ",
                                                        std::max(0.0, narrow.gap_mm));
  text += formatted(
      "contact counts as bearing within %.2f mm of the head only, and contact inside the socket may be "
      "called impingement",
      std::max(0.0, narrow.margin_mm));
  notes.push_back({RangeNoteCode::narrow_bearing_margin, std::move(text)});
}

}  // namespace

std::optional<answer::CentresApart> answer::centres_apart(const Joint& joint,
                                                          const motion::RangeOptions& range,
                                                          const motion::BearingSurface& surface) {
  if (!surface.socket) return std::nullopt;
  const Vec3 head = pose_at(joint.coordinates(), range.overlap.reference_pose) * surface.head.centre;
  const Vec3& socket = surface.socket->centre;
  // A larger head than usual turns as far about a centre that is as far off.
  if ((socket - head).norm() <= std::min(centres_apart_mm, by_head(centres_apart_mm, surface.head)))
    return std::nullopt;
  return CentresApart{head, socket};
}

std::string_view name_of(RangeNoteCode code) noexcept {
  switch (code) {
    case RangeNoteCode::centre_moves_limits:
      return "centre_moves_limits";
    case RangeNoteCode::narrow_bearing_margin:
      return "narrow_bearing_margin";
    case RangeNoteCode::limit_on_cut:
      return "limit_on_cut";
    case RangeNoteCode::limit_on_part_cut:
      return "limit_on_part_cut";
    case RangeNoteCode::limit_on_piece:
      return "limit_on_piece";
    case RangeNoteCode::sliding_surfaces:
      return "sliding_surfaces";
    case RangeNoteCode::translation_ends:
      return "translation_ends";
    case RangeNoteCode::bones_touch:
      return "bones_touch";
    case RangeNoteCode::coarse_mesh:
      return "coarse_mesh";
    case RangeNoteCode::differs_from_closed_form:
      return "differs_from_closed_form";
    case RangeNoteCode::last_value_left_out:
      return "last_value_left_out";
    case RangeNoteCode::nothing_holds_joint:
      return "nothing_holds_joint";
    case RangeNoteCode::limit_through_bone:
      return "limit_through_bone";
  }
  return "";
}

std::vector<RangeNote> range_notes(const Joint& joint, std::span<const motion::MotionLimit> limits,
                                   const motion::RangeOptions& range, const motion::BearingFinding& bearing) {
  std::vector<RangeNote> notes;
  note_cuts(joint, limits, bearing, notes);
  note_part_cuts(joint, limits, notes);
  note_ligaments(joint, limits, notes);
  std::vector<motion::Motion> motions;
  for (const motion::MotionLimit& limit : limits) motions.push_back(limit.motion);
  // A shallow socket is wider than its head and has another centre by nature, about which nothing turns.
  if (bearing.surface && joint.is_hip()) note_centres(joint, motions, range, *bearing.surface, notes);
  if (range.bearing.rule == motion::BearingRule::leave_out && bearing.narrow_margin)
    note_narrow_margin(joint, *bearing.narrow_margin, notes);
  note_sliding(joint, limits, bearing, notes);
  for (RangeNote& note : answer::surface_notes(joint, range, bearing)) notes.push_back(std::move(note));
  note_pieces(joint, limits, bearing, notes);
  return notes;
}

}  // namespace condyle
