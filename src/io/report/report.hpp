#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "condyle/io/joint_file.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "condyle/joint.hpp"
#include "io/result/measure_result.hpp"
#include "io/result/motion_result.hpp"
#include "io/result/resection_result.hpp"
#include "io/result/rom_result.hpp"
#include "io/sweep/sweep_result.hpp"

/// The output of `condyle report`: one HTML file that shows a joint in any browser and computes with it there. It
/// loads nothing and sends nothing. Its contents, key by key, are in docs/report-data.md.

namespace condyle::io {

/// A recorded motion in a report: its frames and their curves.
struct ReportedMotion {
  std::string name;
  const MotionQuestion& question;
  const MotionAnswer& answer;
};

/// Layers that carry load, in a report: the page computes pressures with them.
struct ReportedLayers {
  ContactEntry contact;
  contact::ElasticContactOptions options;  ///< elastic_options() of the entry
};

/// Texts that the page shows as they were given: any text, which stays text; nothing of it is taken from the machine.
struct ReportLabels {
  std::optional<std::string> case_name = {}, note = {}, date = {};
  /// Whether files are named by their whole paths, and the command as it was given; else by their names alone.
  bool whole_paths = false;
};

/// The joint with which that of a report is compared: the same one before a change.
struct ReportedBefore {
  const Joint& joint;
  std::filesystem::path file = {};  ///< the joint file; empty of a joint that has none
  /// The limits of the motions of the report's joint; null if they cannot be answered, and `rom_error` says why.
  const RomResult* rom = nullptr;
  std::string rom_error = {};
};

/// Throws UsageError, which names both, unless joints are of the same kind, anatomy and side.
void check_comparable(const Joint& before, const std::string& before_name, const Joint& after,
                      const std::string& after_name);

/// Throws UsageError for a sweep that a page does not show: over more than two parameters, of more designs or targets than it draws.
void check_shown_sweep(std::span<const plan::SweptParameter> parameters, std::size_t targets);

/// Contents of a report.
struct Report {
  std::string title;  ///< any text; it stays text on the page
  const Joint& joint;
  JointCoordinates reference_pose = {};  ///< in which the mobile mesh was given
  /// The limits of the joint, of a free one where it is held or where its translation leads; null if they cannot be answered, and
  /// `rom_error` says why.
  const RomResult* rom = nullptr;
  std::string rom_error = {};
  std::optional<ReportedMotion> recorded = {};
  /// How the joint file reads a table of a motion, so that the page can; null if it does not say.
  const RecordedMotionMapping* recorded_motion = nullptr;
  std::optional<ReportedLayers> layers = {};
  const MeasureResult* measures = nullptr;  ///< of a hip
  /// The bone that must go: `joint` is the joint without it, and `rom` has its limits.
  const ResectionResult* plan = nullptr;
  std::optional<ReportedBefore> before = {};
  const SweepResult* sweep = nullptr;  ///< of the joint of the page, by check_shown_sweep()
  /// BearingOptions::margin_mm of the limits: the page finds the bearing surface anew where it turns a part.
  std::optional<double> bearing_margin_mm = {};
  ReportLabels labels = {};
};

/// The page of a joint with these limits, or without any; all else is left open.
Report report_of(const LoadedJoint& loaded, const RomResult* rom, std::string why_none);

/// The page. Vertices keep every bit. Radial gaps of all vertices are computed in the reference pose and at the
/// end of each limit; the rest is linear in meshes, map and frames. The same bytes whatever the threads.
std::string report_html(const Report& report);

/// Throws FileError if write_report() could not put a file there, or would write over a file that was read
/// (Provenance::read): to be called before long work. Leaves nothing.
void check_report_file(const std::filesystem::path& path, const Provenance* from);

/// Writes it: whole or not at all; a folder that is missing is made. Throws FileError.
void write_report(const std::filesystem::path& path, const Report& report);

/// The page without a joint: it takes files that are dropped on it, in any browser, and has those of the sample hip to try.
std::string empty_report_html();
/// Writes it; as write_report().
void write_empty_report(const std::filesystem::path& path);

}  // namespace condyle::io
