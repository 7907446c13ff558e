#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "io/report/report.hpp"

/// All that a report of a joint shows, answered in one order: plan, recorded motion, layers, limits, the joint before, sweep, shape.

namespace condyle::io {

/// What a report is to show beside the joint and its limits.
struct ReportRequest {
  RangeRequest range = {};
  /// The bone that must go. The page then shows the joint without it; its motions and its options of limits are those of `range`.
  std::optional<ResectionRequest> plan = {};
  std::optional<SweepRequest> sweep = {};  ///< by check_shown_sweep(); not computed if there are no limits
  std::optional<MotionTable> motion = {};  ///< that was recorded
  bool with_pressure = false;              ///< of the layers of the joint file, in the motion too
  bool with_measures = false;              ///< of a hip, with bands if the limits have them
  /// The joint with which the page compares its own, by check_comparable(): it has limits of the same motions, without a map and zones.
  const LoadedJoint* before = nullptr;
  /// Called before the frames of a motion, which take long, with how it was read, and before the limits; each time with the notes on contact
  /// that are known by then. What it throws ends the work.
  std::function<void(const std::vector<std::string>& processing, const std::vector<motion::ContactNote>&)>
      look_at_notes = {};
};

/// Limits, or in one line why there are none: the page shows the joint all the same.
struct RangeOrReason {
  std::optional<RangeAnswer> answer = {};
  std::string why_none = {};
};

/// A recorded motion of the joint that is shown.
struct RecordedAnswer {
  JointMotion motion;
  ContactEntry contact;
  ContactSurfaces surfaces;
  MotionAnswer answer;
};

struct ReportAnswer {
  std::optional<ResectionAnswer> plan = {};
  std::optional<RecordedAnswer> recorded = {};
  std::optional<ReportedLayers> layers = {};
  /// Notes on what the limits follow, on the motion and on the layers; those of the limits too.
  std::vector<motion::ContactNote> contact_notes = {};
  RangeOrReason range = {};
  RangeOrReason before = {};  ///< neither if there is no joint before
  std::optional<SweepAnswer> sweep = {};
  std::optional<MeasureAnswer> measures = {};
};

/// Answers what is requested and not `known` already. Empty if it was stopped.
///
/// Throws UsageError as check_range_request() and the other checks do, and for pressure without layers; MeshError as MotionOfJoint and
/// answer_sweep() do, and if a plan or a shape has no answer, with the joint file's name before it.
std::optional<ReportAnswer> answer_report(const LoadedJoint& loaded, const ReportRequest& request,
                                          const Control& control, ReportAnswer known = {});

/// What a page says beside the answers.
struct ReportWords {
  std::optional<std::string> title = {};  ///< the joint's name if empty
  ReportLabels labels = {};
  std::span<const JointNote> notes = {}, notes_before = {};
  Provenance *from = nullptr, *from_before = nullptr;  ///< null: not known
};

/// write_report() of an answer to that request. Throws FileError.
void write_report(const std::filesystem::path& path, const LoadedJoint& loaded, const ReportRequest& request,
                  const ReportAnswer& answer, const ReportWords& words);

}  // namespace condyle::io
