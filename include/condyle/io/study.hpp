#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/control.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/motion_map.hpp"
#include "condyle/range_of_motion.hpp"

/// Many joints of one table: `condyle study` and `condyle merge`. Every column of the table and of what is written is in
/// docs/cohort.md.

namespace condyle::io {

/// A pose at which every joint is queried, read as parse_pose() reads it. Whether a joint reaches it is decided joint
/// by joint, as `condyle depth` decides it: a pose that a hinge cannot reach ends the study. Throws UsageError; a
/// matrix is refused too.
[[nodiscard]] PoseDegrees study_pose(std::string_view text, Anatomy joint);

/// Contact pressure in one pose, or in the place nearby where the contact carries a force.
struct StudyLoad {
  PoseDegrees at = {};  ///< study_pose()
  /// Layers for joints whose files have none, and what else differs from their files.
  ContactChanges contact = {};
  /// On the mobile body, N: anterior, superior, lateral, the same for both sides.
  std::optional<Vec3> force_n = {};
  /// Directions of the same components that the mobile body may be translated in: BalanceOptions::free_directions.
  std::vector<Vec3> free_directions = {};
};

/// The translation of free joints follows this force on the mobile body: FollowLoad.
struct StudyFollowLoad {
  Vec3 force_n = Vec3::Zero();             ///< as of StudyLoad
  std::vector<Vec3> free_directions = {};  ///< likewise
  ContactChanges contact = {};             ///< likewise
};

/// The bone of each joint that must go so that motions reach these targets.
struct StudyResection {
  std::vector<NamedReach> targets = {};
  /// How; its targets and its range are those of each joint. No vertex is marked to stay.
  plan::ResectionOptions cut = {};
};

/// Queries for every joint of a study: its limits, and other options.
struct StudyOptions {
  Anatomy anatomy = Anatomy::hip;         ///< of all of them; one of another is a failure
  std::vector<std::string> motions = {};  ///< by their names; all that a joint has where empty
  motion::BearingOptions bearing = {};
  motion::ReferenceContact reference_contact = motion::ReferenceContact::refuse;
  std::optional<motion::LeaveOutReferenceContacts> leave_out_reference_contacts = {};
  std::optional<motion::MapGrid> map = {};
  std::optional<BandRequest> bands = {};  ///< of every joint; what is left open is as its own file says
  /// How deep the bodies are in each other in this pose: study_pose().
  std::optional<PoseDegrees> depth_at = {};
  std::optional<StudyLoad> load = {};
  /// Free joints are answered with this, or with a recorded motion of their row; without either they are failures.
  std::optional<StudyFollowLoad> follow_load = {};
  /// The shape of each hip, with bands where `bands` says so: docs/measures.md. UsageError for other joints.
  bool measures = false;
  std::optional<StudyResection> resection = {};
};

/// A part of the table: of n rows shard i of N has those after (i-1) n / N, up to i n / N, both rounded down.
struct Shard {
  std::size_t number = 1, of = 1;  ///< 1 <= number <= of

  /// As "3/7"; throws UsageError.
  [[nodiscard]] static Shard parse(std::string_view text);
  [[nodiscard]] bool is_whole() const noexcept { return of == 1; }
};

/// Effect on a study of a joint that cannot be answered.
enum class BadJoint {
  is_a_row,  ///< of failures.csv
  ends_run,  ///< with its own error, as does one that looks wrong (MeshError); that of the lowest row of several
};

/// Input and output of a study.
struct Study {
  std::filesystem::path table, folder;
  StudyOptions options = {};
  /// One shard, into a folder of its own below `folder`; all rows where empty.
  std::optional<Shard> shard = {};
  BadJoint bad_joint = BadJoint::is_a_row;
  /// A day, YYYY-MM-DD: ro-crate-metadata.json of this date is written too, of a whole study.
  std::optional<std::string> crate_date = {};
};

/// A joint that looks wrong: docs/checks.md.
struct NotedJoint {
  std::string id, codes;  ///< codes with blanks between
};

/// Why a joint could not be answered, as failures.csv has it.
struct StudyFailure {
  int exit_code;
  std::string message;
};

/// Outcome of a study.
struct StudyDone {
  std::size_t joints = 0, failures = 0;
  std::optional<StudyFailure> first_failure = {};  ///< of the lowest row
  bool was_there = false;                          ///< with the same key, and nothing was done
  std::vector<std::filesystem::path> written = {};
  std::vector<NotedJoint> noted = {};  ///< of those answered, in the order of the table
  std::size_t earlier = 0;             ///< rows whose answers a run that was broken off had left
};

/// Answers for every row of the table, on all threads, and writes limits.csv, hips.csv, failures.csv, columns.csv, study.h5 and
/// study.json: all or nothing, the last one last. What lies there with the same key (the rows and their places, the contents of the files they
/// name, the options and the version) and whole is left. The same bytes whatever the threads; several runs may write the same
/// folder at a time.
///
/// Throws FileError for a table that cannot be read and a folder that cannot be written; UsageError for options that do not
/// fit a joint, a date that is none, or one of a shard. Memory: some kB a row, and the joints at work, one per thread. Empty if it was stopped: no table is written.
/// Rows answered until a run is stopped, fails or is killed are kept in the folder, and taken by the next run if rows, files, options and version are the same.
[[nodiscard]] std::optional<StudyDone> run_study(const Study& study, const Control& control = {});

/// Throws if no joint was answered, which is no result: the error of the first failure, naming `table`.
void require_answered(const StudyDone& done, const std::filesystem::path& table);

/// Puts the shards below the folder together: the tables are those of a run of all rows, byte for byte. Throws FileError if
/// a shard is missing, or is of another table, other options or another version than the first, or was changed. Reads all tables
/// into memory. `crate_date` as of a Study.
[[nodiscard]] StudyDone merge_study(const std::filesystem::path& folder,
                                    const std::optional<std::string>& crate_date = {});

}  // namespace condyle::io
