#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/fit.hpp"
#include "condyle/impingement_zone.hpp"
#include "condyle/joint.hpp"
#include "condyle/limit_band.hpp"

/// Measures of a hip from its meshes: definitions, sources and known answers in docs/mathematics/11-measures.md.

namespace condyle {
struct FrameDescription;
}  // namespace condyle

namespace condyle::measure {

/// A measure of one hip. Its definition is a row of measure_definitions().
struct Measure {
  std::optional<double> value = {};
  std::string why_none = {};  ///< one sentence; empty if there is a value
  std::string note = {};      ///< one sentence to be read with the value; usually empty
};

/// Between these values lie the measures of other people.
struct NormalRange {
  double low, high;
  std::string_view people;   ///< whose: "skeletally mature femora, by CT"
  int count;                 ///< of these; 0 if the source at hand does not say
  bool are_patients;         ///< They were examined because of their hips: their range is not called normal.
  std::string_view meaning;  ///< "interquartile range, median 122.2"
  std::string_view source;
};

struct HipMeasures;

enum class MeasuredPart : std::uint8_t { femur, acetabulum, both };
/// As in files: "acetabulum".
[[nodiscard]] std::string_view name_of(MeasuredPart part) noexcept;

/// One measure: what texts, tables and columns are made of.
struct MeasureDefinition {
  std::string_view key;   ///< with its unit at the end, as in "alpha_1_30_deg"
  std::string_view unit;  ///< "mm", "deg", "h" or "1"
  MeasuredPart part;
  bool in_pelvis_frame;         ///< It turns with the frame of the pelvis, and with its tilt.
  std::string_view definition;  ///< one line
  /// The planes, axes and points that it is measured by, as files name them: "neck, shaft". Pictures draw them.
  std::string_view measured_by;
  std::string_view source;            ///< of the definition
  std::optional<NormalRange> normal;  ///< only with a source and for this definition
  const Measure& (*of)(const HipMeasures&);
};

/// Every measure, in the order of reports.
[[nodiscard]] std::span<const MeasureDefinition> measure_definitions() noexcept;
/// Null if no measure has this key.
[[nodiscard]] const MeasureDefinition* measure_definition(std::string_view key) noexcept;

/// Forwards or backwards.
inline constexpr double largest_pelvic_tilt_deg = 60;

struct MeasureOptions {
  /// By which the pelvis is tilted forwards from how its frame shows it: acetabular angles are those of the tilted pelvis.
  Angle pelvic_tilt = {};
  /// Source of the hip bone's axes: pelvis_frame_of(); empty: not stated, taken as scanned.
  std::string pelvis_frame = {};
  /// Pose of the femur at which the ischiofemoral distance is measured.
  JointAngles ischiofemoral_pose = {};
};

// Points of the femur are in M, those of the hip bone in F; directions are unit; mm.

/// One direction around the neck.
struct NeckHour {
  double hour;  ///< 0 to below 12, in steps of five minutes
  /// Circle of the head's contour on this side and the other: its centre from the head's, along the neck and beside it.
  double circle_along_mm, circle_beside_mm, circle_radius_mm;
  double circle_rms_mm;
  std::optional<double> alpha_deg;  ///< at 0.5 mm
  std::optional<double> alpha_at_1mm_deg;
  std::string why_no_alpha, why_no_alpha_at_1mm;
  /// The two differ by more than alpha_doubt_deg: where the contour leaves its circle depends on how closely one looks.
  bool is_doubtful = false;
  /// Nearer to the head the contour is farther than 0.5 mm outside again, up to this angle: a cam with a groove behind it.
  std::optional<double> outside_again_deg;
  std::optional<Vec3> alpha_point;  ///< where the contour comes within 0.5 mm of the circle
  std::optional<double> offset_mm;
  std::optional<Vec3> offset_point;
};
inline constexpr double alpha_doubt_deg = 5;

/// Where 12 o'clock of the neck is from.
enum class ClockSource : std::uint8_t { shaft, frame };

struct NeckGeometry {
  Sphere head;
  Vec3 direction;             ///< from the head's centre to the foot
  std::vector<Vec3> outline;  ///< where the femur crosses a sphere of 1.4 R, in no order
  motion::ClockFace clock;
  ClockSource clock_from;
};

struct ShaftGeometry {
  Vec3 first, last;  ///< ends of the part of the axis that was used
  double bound_deg;  ///< of its direction: two standard errors
};

struct CondyleGeometry {
  Vec3 middle;           ///< of the condyles' common axis
  Vec3 medial, lateral;  ///< points of the line that touches both condyles from behind
};

struct FemurMeasures {
  Measure head_radius, head_rms, head_largest_residual, head_roundness, head_coverage;
  Measure neck_shaft, version, torsion_in_frame;
  Measure alpha_12, alpha_1_30, alpha_3, alpha_12_at_1mm, alpha_1_30_at_1mm, alpha_3_at_1mm;
  Measure alpha_largest, alpha_largest_hour, alpha_largest_at_1mm;
  Measure offset_12, offset_1_30, offset_3, offset_ratio_12, offset_ratio_1_30, offset_ratio_3;
  Measure trochanter_height;

  std::optional<Sphere> head;
  std::vector<NeckHour> around_neck;  ///< empty without a neck
  std::optional<NeckGeometry> neck;
  std::optional<ShaftGeometry> shaft;
  std::optional<CondyleGeometry> condyles;
  std::optional<Vec3> trochanter_top;
};

/// One direction around the opening of the socket.
struct RimHour {
  double hour;  ///< 0 to below 12, in steps of ten minutes: 12 superior, 3 anterior, about the opening
  std::optional<Vec3> point;  ///< empty where no wall faces the head
  double cover_deg;           ///< from the inward axis to the point, seen from the head's centre
  double centre_edge_deg;     ///< from superior to the point, likewise
  bool is_in_plane;           ///< whether the rim's plane was fitted to it
};

/// The plane of the rim and the circle in it.
struct RimGeometry {
  Vec3 centre, normal;  ///< out of the socket
  double radius_mm;
  motion::ClockFace clock;
};

/// Front and back of the rim in one transverse plane.
struct RimChord {
  double height_mm;
  Vec3 front, back;
};

struct AcetabulumMeasures {
  Measure inclination, version, inclination_radiographic, version_radiographic;
  Measure version_0mm, version_5mm, version_10mm, version_15mm;
  Measure centre_edge_lateral, centre_edge_anterior, centre_edge_posterior;
  Measure coverage, rim_radius, rim_height;

  std::vector<RimHour> rim;  ///< empty without a socket
  std::optional<RimGeometry> plane;
  std::vector<RimChord> chords;
  std::optional<Vec3> lateral_edge, anterior_edge, posterior_edge;
  Vec3 anterior, superior,
      lateral;  ///< the axes of the pelvis that the angles are measured in, with its tilt
};

struct ClosestBones {
  Vec3 fixed_point, mobile_point;  ///< both in F
};

struct BothMeasures {
  Measure joint_space_least, joint_space_median, ischiofemoral;

  std::optional<ClosestBones> joint_space_at;
  std::optional<ClosestBones> ischiofemoral_at;
  JointAngles ischiofemoral_pose;
};

struct HipMeasures {
  FemurMeasures femur;
  AcetabulumMeasures acetabulum;
  BothMeasures both;
  Angle pelvic_tilt;
  std::string pelvis_frame;
  /// Pieces of a bone's mesh near the head that are not measured, such as the wall of its marrow or another bone: a sentence for each bone.
  std::vector<std::string> left_out;
};

/// Source of a joint's axes: "anterior pelvic plane", "plane of ASIS and PSIS", "the femur's epicondyles, not the pelvis"; empty
/// for directions, which do not say how the pelvis lay. The pose of the femur in the scan says nothing of it either.
[[nodiscard]] std::string pelvis_frame_of(const FrameDescription& frame);
/// The frame of every measure that turns with the pelvis: "as scanned", "anterior pelvic plane, tilt 10 deg given".
[[nodiscard]] std::string stated_frame(const HipMeasures& measures);

/// Measures of a hip as its meshes show it. What cannot be measured is empty and says why. If a body has several meshes, those called
/// bearing or soft are left out. Throws UsageError for another joint than a hip, a hinge, and a request outside its ranges.
///
/// Some tens of milliseconds for 50,000 triangles, after the searches for head, socket and condyles, which are kept with the meshes.
[[nodiscard]] HipMeasures measure_hip(const Joint& joint, const MeasureOptions& request = {});

/// The spread of one measure.
struct MeasureBand {
  std::optional<double> p5, median, p95;  ///< of the joints in which it could be measured; empty if in none
  std::size_t samples_without_value = 0;  ///< in which it could not be measured
};

/// Bands of all measures, in the order of measure_definitions(): each of `samples` joints is displaced as for limit_bands(), by
/// the same draws, and measured anew. The vertices of head and socket are those of the joint as given;
/// the head's centre moves with the joint's. The same bits whatever the threads; empty if it was stopped before all samples were done.
///
/// Throws UsageError as measure_hip() and limit_bands() do.
[[nodiscard]] std::optional<std::vector<MeasureBand>> measure_bands(const Joint& joint,
                                                                    const MeasureOptions& request,
                                                                    const motion::BandOptions& options,
                                                                    const Control& control);
[[nodiscard]] std::vector<MeasureBand> measure_bands(const Joint& joint, const MeasureOptions& request = {},
                                                     const motion::BandOptions& options = {});

}  // namespace condyle::measure
