#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/contact_checks.hpp"
#include "condyle/io/contact_entry.hpp"
#include "condyle/io/curve_files.hpp"
#include "condyle/io/joint_motion.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/motion_contact.hpp"
#include "condyle/recorded_contact.hpp"

/// What `condyle motion` found, for files. Every column, key and array is in docs/motion-files.md.

namespace condyle {

struct MotionQuestion {
  const LoadedJoint& joint;
  const JointMotion& motion;
  const ContactSurfaces& surfaces;
  ContactEntry contact;
  bool with_pressure = false;
  std::vector<JointNote> notes = {};
  const Provenance* provenance = nullptr;
};

/// Contact of all frames, and where a load was balanced, how.
struct MotionAnswer {
  std::vector<std::optional<FrameContact>> frames;
  std::vector<std::optional<BalancedPose>> balanced = {};  ///< none where no load was given
  /// Frames whose load is zero along what is free, ascending: no pose was looked for, and they have no answer.
  std::vector<std::size_t> without_load = {};
  /// Contact between the samples too, where that was asked for; samples are numbered as the frames.
  std::optional<RecordedContact> between = {};
  /// The force of the frame with the largest one, computed from the depth at 16 places of each face:
  /// ElasticContact::refined_force_n(). Empty without pressure.
  std::optional<double> refined_largest_force_n = {};
  /// What looks wrong with layers, loads and the motion.
  std::vector<ContactNote> notes = {};
};

/// The frame with the largest force on the mobile body; empty where there is none above 0.
std::optional<std::size_t> frame_of_largest_force(const MotionAnswer& answer);

/// How one end of a contact is known: "exact", "bounded", "recording_begins" of an entry or "recording_ends" of an exit: the bodies
/// were in contact before the first, or are after the last sample.
enum class ContactEndRole { entry, exit };
std::string_view name_of(ContactEndKind kind, ContactEndRole role) noexcept;

/// contact_between() over frames with gaps: each run of frames without one is a recording of its own. Empty where it was
/// stopped. UsageError where times are not in seconds.
std::optional<RecordedContact> contact_between_frames(const JointContact& bodies, const JointMotion& motion,
                                                      const RecordedContactControl& control = {});

/// One curve for each number of a frame; nothing for gaps, and for centres of frames without contact.
Curves curves_of(const MotionQuestion& question, const MotionAnswer& answer);

/// The same of each region of the casting surface, under names that begin with the region's: "medial_area_mm2".
Curves region_curves_of(const MotionQuestion& question, const MotionAnswer& answer);

/// The curves' largest values and when, frames in contact, gaps: a few lines.
std::string motion_text(const MotionQuestion& question, const MotionAnswer& answer);
std::string motion_json(const MotionQuestion& question, const MotionAnswer& answer);

struct Cycle {
  double start_s, end_s;
};

struct MotionFiles {
  std::optional<Cycle> cycle = {};  ///< also cycle.csv, 101 points
  bool maps = false;                ///< also a VTP file per frame and body, and motion.pvd
  bool jam = false;                 ///< also jam.h5
  VtpEncoding encoding = VtpEncoding::binary;
};

/// Throws FileError where write_motion() could not write into the folder, or would write over a file that was read
/// (Provenance::read): to be called before long work. Leaves nothing.
void check_motion_folder(const std::filesystem::path& folder, const Provenance* from);

/// Writes curves.csv, curves.sto and motion.json into a folder, contacts.csv where contact between the samples was looked
/// for, regions.csv where the contact has regions, and what else is asked for; all or none. Returns what was
/// written. FileError; UsageError for a cycle that is not within the motion.
std::vector<std::filesystem::path> write_motion(const std::filesystem::path& folder,
                                                const MotionQuestion& question, const MotionAnswer& answer,
                                                const MotionFiles& files = {});

}  // namespace condyle
