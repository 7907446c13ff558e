#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/joint_checks.hpp"
#include "io/motion/curve_files.hpp"

/// Results of `condyle motion`, for files. Every column, key and array is in docs/motion-files.md.

namespace condyle::io {

struct MotionQuestion {
  const LoadedJoint& joint;
  const JointMotion& motion;
  const ContactSurfaces& surfaces;
  ContactEntry contact;
  bool with_pressure = false;
  std::vector<JointNote> notes = {};
  const Provenance* provenance = nullptr;
  bool to_limits = false;  ///< of each frame, degrees to the nearest limit
};

/// How one end of a contact is known: "exact", "bounded", "recording_begins" of an entry or "recording_ends" of an exit: the bodies
/// were in contact before the first, or are after the last sample.
enum class ContactEndRole { entry, exit };
std::string_view name_of(motion::ContactEndKind kind, ContactEndRole role) noexcept;

/// One curve for each number of a frame; nothing for gaps, and for centres of frames without contact.
Curves curves_of(const MotionQuestion& question, const MotionAnswer& answer);

/// The same of each region of the casting surface, under names that begin with the region's: "medial_area_mm2". With pressure, last, how much
/// of that surface's force it carries along it: "medial_share_percent", NaN in a frame without force.
Curves region_curves_of(const MotionQuestion& question, const MotionAnswer& answer);

/// As here, or as OpenSim names them: NAME.length in m, NAME.strain, NAME.force_spring.
enum class LigamentNames { ours, of_opensim };
/// Length, strain and tension of each ligament; its speed, damping and total force if any has damping and speeds are known; and under names
/// of ours the force and moment of all on the body and in the frame of the contact's forces, which the names say. Nothing where a
/// length is not known.
Curves ligament_curves_of(const MotionQuestion& question, const MotionAnswer& answer, LigamentNames names);

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

/// Throws FileError if write_motion() could not write into the folder, or would write over a file that was read
/// (Provenance::read): to be called before long work. Leaves nothing.
void check_motion_folder(const std::filesystem::path& folder, const Provenance* from);

/// Writes curves.csv, curves.sto and motion.json into a folder, ligaments.csv and ligaments.sto of a joint that has some, contacts.csv where contact between the samples was looked
/// for, regions.csv where the contact has regions, and what else is asked for; all or none. Returns what was
/// written. FileError; UsageError for a cycle that is not within the motion.
std::vector<std::filesystem::path> write_motion(const std::filesystem::path& folder,
                                                const MotionQuestion& question, const MotionAnswer& answer,
                                                const MotionFiles& files = {});

}  // namespace condyle::io
