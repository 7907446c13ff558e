#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/control.hpp"
#include "condyle/first_contact.hpp"

/// Contact in a recorded motion, between its samples too. docs/mathematics/06-range-of-motion.md.

namespace condyle {

/// How contact was searched for between two neighbouring samples.
enum class BetweenSamples : std::uint8_t {
  exact,    ///< The mobile body rotates about its held origin: closed form, no contact missed, however short.
  bounded,  ///< Its origin moves: free where no point can come far enough to make contact, and only there.
};

/// How one end of a contact is known.
enum class ContactEndKind : std::uint8_t {
  exact,      ///< from the closed form
  bounded,    ///< between a free moment and one in contact, both certain
  recording,  ///< The recording begins or ends before it.
};

/// Where a contact begins or ends.
struct ContactEnd {
  ContactEndKind kind = ContactEndKind::exact;
  double time_s = 0;
  /// Contact begins at time_s or later by at most this, and ends at time_s or earlier by at most this. Where contact is
  /// only possible, up to its other end.
  double uncertainty_s = 0;
  std::size_t sample = 0;  ///< between `sample` and the next one
  Angle turned = {};       ///< by the mobile body since that sample, about the axis of the segment, >= 0
  /// Features that meet there; from a bound two faces that cross at the nearest moment known to be in contact. Empty
  /// where one body is inside the other and their surfaces do not meet, and where contact is only possible.
  std::optional<ContactWitness> contact = {};
};

/// From entry to exit the bodies are in contact, but for what is undecided; before and after they are free for
/// certain.
struct ContactInterval {
  ContactEnd entry, exit;
  /// Whether they are in contact for certain at some moment: otherwise the surfaces pass so near to each other that
  /// neither contact nor its absence was shown within the resolution.
  bool is_certain = false;
  double undecided_s =
      0;  ///< how much of it was shown neither to be in contact nor free; 0 from the closed form
};

/// Contact in a whole recording: free outside the intervals, between the samples too.
struct RecordedContact {
  std::vector<ContactInterval> contacts;  ///< ascending and apart
  std::vector<BetweenSamples> searched;   ///< by the sample that a segment begins at; one fewer than samples
  std::size_t poses = 0;                  ///< evaluated if bounded
};

struct RecordedContactOptions {
  /// Where a bound decides: what is still undecided in pieces shorter than this stays so, and what is free for less
  /// between contacts counts as undecided. A point at 1 m/s moves by 0.01 mm in the default. Smaller costs a few more
  /// poses at each end of a contact, and many more where surfaces touch and slide along each other.
  double resolution_s = 1e-5;
};

/// When the bodies are in contact in a motion recorded as poses X_FM at times, s.
///
///     sample 11              12              13              14       contact of 2 ms between two samples 33 ms apart
///       o---------------------o-----[=]-------o---------------o       is found as one of a second is
///
/// Between two neighbouring samples the mobile body moves along one screw motion. If both have the same translation
/// that is a rotation about M's origin, which is the joint centre: entry and exit are the angles of FirstContact, in
/// closed form, with its error bound; free moments of less than 1e-9 rad between contacts count as contact.
/// Translations that differ by no more than placing a point rounds (4 * 2^-53 of its size) are the same. If the
/// translation changes there is no closed form: a segment is then called free only if that is proven, and an end of
/// contact lies between two moments whose state is certain.
///
/// Contact is that of JointContact::in_contact(): surfaces that meet, or one body inside the other if that one is
/// closed. On a hip of 30,000 and 15,000 triangles some 0.6 ms for a segment about a held centre, and 1 ms for each
/// pose that a bound evaluates: one if a segment is clearly free, dozens if contact begins or ends.
///
/// The same bits whatever the threads. Throws UsageError for fewer than two samples, not as many times as poses,
/// times that are not finite or do not ascend, poses that are not rotations to 1e-9 with a finite translation,
/// neighbours more than 179 degrees apart (the sense of rotation is not known), or a resolution that is not above 0;
/// the first bad sample is named, counted from 0.
RecordedContact contact_between(const JointContact& bodies, std::span<const double> time_s,
                                std::span<const Pose> X_FM, const RecordedContactOptions& options = {});
/// The same; empty if it was stopped before all ways were done.
std::optional<RecordedContact> contact_between(const JointContact& bodies, std::span<const double> time_s,
                                               std::span<const Pose> X_FM,
                                               const RecordedContactOptions& options, const Control& control);

}  // namespace condyle
