#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string_view>
#include <variant>

#include "condyle/angle.hpp"
#include "condyle/implant.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

namespace condyle::sample {

/// The measures of the sample hip, as a clinician or a designer of implants would state them. Defaults are
/// those of an average adult; ranges are what adult hips show, somewhat widened. Sizes not named here grow
/// with the head (femur) or the socket (hip bone).
struct HipParameters {
  /// Radius of the femoral head, mm, 18 to 32.
  double head_radius_mm = 24;
  /// Bony joint space: radius of the socket less radius of the head, which are concentric; mm, 2 to 6.
  double joint_space_mm = 3.5;

  /// Between the neck's axis and the shaft's axis, both pointing away from where they meet; 110 to 145
  /// degrees.
  Angle neck_shaft_angle = Angle::degrees(127);
  /// Angle about the shaft by which the neck points forward of the frontal plane; -15 to 45 degrees.
  Angle femoral_anteversion = Angle::degrees(15);
  /// Half the neck's front-to-back width where it is narrowest; mm, 8 to 0.8 head radii.
  double neck_radius_mm = 13;
  /// Along the neck's axis from the head's centre to the shaft's axis; mm, 40 to 65.
  double neck_length_mm = 50;
  /// Along the shaft's axis from there to the cut at its lower end; mm, 60 to 250.
  double shaft_length_mm = 100;
  /// With this set, a cam bump on the head-neck junction at half past one around the neck's axis,
  /// anterosuperior, that makes this alpha angle there; from sample::native_alpha_angle(), but at least 50,
  /// to 90 degrees. Without, no bump: head and neck make the native angle, which no constant could stand for.
  std::optional<Angle> alpha_angle = {};

  /// Between the socket's opening direction and the vertical, Murray's anatomical inclination; 35 to 65
  /// degrees.
  Angle acetabular_inclination = Angle::degrees(50);
  /// By which the opening direction, seen from above, points forward of straight lateral, Murray's anatomical
  /// anteversion; -10 to 35 degrees.
  Angle acetabular_version = Angle::degrees(18);
  /// In the frontal plane through the head's centre, from the vertical to the socket's edge, positive
  /// laterally; 15 to 45 degrees.
  Angle lateral_centre_edge_angle = Angle::degrees(33);

  friend bool operator==(const HipParameters&, const HipParameters&) = default;
};

/// Resolutions of the founding paper's Table 1 (Arbabi, Boulic, Thalmann 2009). Each is the 1-to-4
/// subdivision of the one before, laid back on the surface.
///
///                femur               hip bone
///            vertices triangles   vertices triangles
///      one        773      1542       1221      2442
///      two       3086      6168       4884      9768
///      three    12338     24672      19536     39072
///      four     49346     98688      78144    156288
enum class Scenario { one = 1, two, three, four };

/// Exact numbers of triangles: even; femur 600 to 4 million, hip bone 1600 to 4 million.
struct TriangleCounts {
  std::size_t hip_bone, femur;
};

/// Typical edge length in mm; 0.3 to 9. The joint surfaces have edges about a quarter shorter.
struct EdgeLength {
  double mm;
};

using Resolution = std::variant<Scenario, TriangleCounts, EdgeLength>;

/// Two bones in the joint frame: millimetres, X anterior, Y superior, Z to the subject's right, the origin at
/// the hip centre, which is the head's and the socket's. Both meshes are closed, wound outwards, without
/// self-intersections; the femur has genus 0, the hip bone, with its obturator hole, genus 1.
struct SampleHip {
  TriMesh hip_bone, femur;
};

/// A right hip with these measures in the neutral pose, bones apart. Same parameters, same bytes, on any
/// number of threads. Raises UsageError naming the parameter that is out of its range, or saying what the
/// parameters together make impossible.
[[nodiscard]] SampleHip sample_hip(const HipParameters& parameters, const Resolution& resolution);
/// The same; empty if it was stopped.
[[nodiscard]] std::optional<SampleHip> sample_hip(const HipParameters& parameters,
                                                  const Resolution& resolution, const std::stop_token& stop);

/// The other side: Z negated, triangles flipped so that they face outwards again.
[[nodiscard]] TriMesh mirrored(const TriMesh& mesh);
[[nodiscard]] SampleHip mirrored(const SampleHip& hip);

/// A measure of the sample hip by the name it has in tables and in Python: "neck_shaft_angle_deg". Values are mm or degrees.
struct HipMeasure {
  std::string_view name, unit, meaning;
  std::optional<double> (*value)(const HipParameters&);
  void (*set)(HipParameters&, double);
};

/// All measures of HipParameters, in their order.
[[nodiscard]] std::span<const HipMeasure> hip_measures() noexcept;

/// Null if no measure has this name.
[[nodiscard]] const HipMeasure* hip_measure_named(std::string_view name) noexcept;

// Hips with measures drawn at random, for anybody to try a study on. docs/cohort.md has where the distributions come from.

/// A normal distribution cut off at both ends. Of a measure that goes with the head, in head radii.
struct MeasureDistribution {
  std::string_view measure;  ///< its name in hip_measures()
  std::string_view unit;     ///< "mm", "deg", or "head radii"
  double mean, standard_deviation, low, high;
};

/// One for each measure that is drawn, each independent of the others; those not drawn are as HipParameters has them.
[[nodiscard]] std::span<const MeasureDistribution> cohort_distributions() noexcept;

/// A hip of a cohort.
struct CohortHip {
  HipParameters measures;  ///< rounded to 0.1 mm and 0.1 degrees
  bool is_left;
  /// The alpha angle that the femur has: of its cam, or without one that of head and neck.
  Angle alpha_angle;
};

/// Hip k of the cohort of this seed, which does not depend on how many there are. An alpha angle drawn below the least of a
/// cam makes a hip without one. Some microseconds.
[[nodiscard]] CohortHip cohort_hip(std::uint64_t seed, std::uint64_t k);

/// The sample hip with a total hip in it, as parts of two bodies in the joint frame at zero angles:
///
///     fixed   hip_bone, liner               the cup lies in the socket, with its centre
///     mobile  femur, head, neck, stem       the femur is cut across its neck where neck and stem of the implant meet
///
/// The axis of the femur's shaft is moved onto that of the stem, so that offset and version of the stem move the bone, and the bone down by
/// the leg's lengthening: none of them changes the limits of neck and liner. The cup is as large as it is whatever the socket is; it must
/// fit into it. Bones that the implant brings into contact are in contact, as a joint file says when it is read.
///
/// Throws UsageError as check_implant() and sample_hip() do, for a cup larger than the socket, and for a neck of the femur that cannot be cut
/// there. Empty if it was stopped. Same parameters, same bytes.
[[nodiscard]] std::optional<plan::ImplantMeshes> sample_replacement(const plan::TotalHip& implant,
                                                                    const HipParameters& bones,
                                                                    const Resolution& resolution, Side side,
                                                                    const std::stop_token& stop = {});

}  // namespace condyle::sample
