#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/impingement_zone.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/motion_contact.hpp"
#include "condyle/motion_map.hpp"
#include "condyle/range_of_motion.hpp"

/// Results of `condyle rom`, as text for people and for programs. Every key, column, unit and sign is in
/// docs/formats-rom.md.

namespace condyle::io {

/// The limits of a joint and what they must be read with.
struct RomResult {
  const Joint& joint;
  std::span<const motion::MotionLimit> limits;
  /// The bearing surface that labels contacts, and whether bearing contact counts.
  motion::BearingFinding bearing = {};
  motion::BearingRule bearing_rule = motion::BearingRule::count;
  /// The clock on which contacts are read, and which one it is.
  motion::ClockFace clock = motion::sagittal_clock();
  motion::ClockPlane clock_plane = motion::ClockPlane::sagittal;
  /// Contacts that were left out or allowed, one line each; empty if any contact at all ends a motion.
  std::vector<std::string> caveats = {};
  /// Translation at which a free `joint` is held (held_at()), along the fixed body's axes.
  std::optional<Vec3> held_translation_mm = {};
  /// The centre is not held: limits are bounded, not exact.
  bool follows = false;
  /// Notes on the joint's set-up.
  std::span<const JointNote> notes = {};
  /// Caveats on the limits because of the joint's shape.
  std::span<const RangeNote> range_notes = {};
  /// Notes on the layers and the motion that a report shows beside the limits.
  std::span<const motion::ContactNote> contact_notes = {};
  /// One per limit where a depth was allowed, none where limits are exact.
  std::span<const motion::DepthLimit> depths = {};
  /// One per limit of an implant that has a closed form, none if not.
  std::span<const plan::ClosedLimit> closed = {};
  /// One per limit where zones were computed, none if not.
  std::span<const std::optional<motion::ImpingementZone>> zones = {};
  /// Null if none was computed.
  const motion::MotionMap* map = nullptr;
  /// One per limit where bands were computed, none if not, and what they were computed with.
  std::span<const motion::LimitBand> bands = {};
  motion::BandOptions band_options = {};
  /// Where the answer comes from and in which frame it is given; null: not known, and the joint frame.
  const Provenance* provenance = nullptr;
  VtpEncoding vtp_encoding = VtpEncoding::binary;
};

/// Shows an answer, with what looks wrong with its joint. All three must outlive the result; `from`, which may be null, gets the
/// frame of a joint that is held at a translation.
RomResult rom_result_of(const RangeAnswer& answer, std::span<const JointNote> notes, Provenance* from);

/// "contact", "end_of_range", "contact_at_start".
std::string_view name_of(motion::LimitReason reason) noexcept;
/// "unknown", "bearing", "impingement".
std::string_view name_of(motion::ContactKind kind) noexcept;

/// Guarantee of the limit, in one sentence.
std::string guarantee_text(const motion::MotionLimit& limit);
/// The same of a limit with a depth allowed, which is searched for and not exact.
std::string guarantee_text(const motion::DepthLimit& limit);

/// The frame in which it gives points and meshes.
AnswerFrame frame_of(const RomResult& result);

/// The summary as JSON text, with a newline at its end.
std::string rom_json(const RomResult& result);

/// A table for people, one line per motion, then what the map comes to.
std::string rom_text(const RomResult& result);

/// One line per motion, with a header line; numbers to the last bit.
std::string rom_csv(const RomResult& result);

}  // namespace condyle::io
