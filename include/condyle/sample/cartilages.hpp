#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <variant>

#include "condyle/mesh.hpp"
#include "condyle/sample/hip.hpp"

namespace condyle::sample {

/// The cartilages of the sample hip. They lie on the bones, without a gap between: the joint space is the sum
/// of femoral thickness, clearance and acetabular thickness.
struct CartilageParameters {
  /// Gap between the two articular surfaces, spheres about the hip centre; below zero they overlap by so
  /// much. mm, -0.5 to 1.
  double clearance_mm = 0.2;
  /// Thickness of the femoral cartilage, mm, 1 to 3. The acetabular one has what is left of the joint space,
  /// which must be at least 1 mm: 1.65 mm at the defaults.
  double femoral_thickness_mm = 1.65;

  friend bool operator==(const CartilageParameters&, const CartilageParameters&) = default;
};

/// Resolutions of the cartilages in the founding paper's Table 2 (Arbabi, Boulic, Thalmann 2009).
///
///              femoral cartilage   acetabular cartilage with labrum
///            vertices triangles    vertices triangles
///      five      1414      2824        1438      2876
///      six       2171      4338        2111      4222
///      seven     3869      7734        3935      7870
///      eight     8649     17294        7412     14824
enum class CartilageScenario { five = 5, six, seven, eight };

/// Exact numbers of triangles: even, 2000 to 4 million.
struct CartilageCounts {
  std::size_t acetabular, femoral;
};

/// An edge length may be 0.3 to 3 mm here.
using CartilageResolution = std::variant<CartilageScenario, CartilageCounts, EdgeLength>;

/// Two cartilages in the joint frame of the bones, see SampleHip. Both meshes are closed, wound outwards,
/// without self-intersections; the femoral one is a cap of genus 0, the acetabular one with its labrum a ring
/// of genus 1.
struct SampleCartilages {
  TriMesh acetabular, femoral;
};

/// The cartilages of the sample hip with these measures, in the neutral pose; they fit sample_hip() of the
/// same measures. Vertices of the articular surfaces lie on two concentric spheres `clearance_mm` apart, to
/// 1e-9 mm. Flat triangles bring the meshes nearer to each other by no more than the acetabular ones sag:
/// about r^2 / (2 R), with r their circumradius and R that of the sphere; less than 0.1 mm at the defaults.
///
/// Bones and cartilages have surfaces in common, but not triangles: each cuts into the other by what they
/// sag, tenths of a millimetre at the coarsest. A cam is bone, and stands out through the cartilage. Same
/// parameters, same bytes, on any number of threads. Raises UsageError as sample_hip() does.
[[nodiscard]] SampleCartilages sample_cartilages(const HipParameters& hip,
                                                 const CartilageParameters& cartilage,
                                                 const CartilageResolution& resolution);
/// The same; empty if it was stopped.
[[nodiscard]] std::optional<SampleCartilages> sample_cartilages(const HipParameters& hip,
                                                                const CartilageParameters& cartilage,
                                                                const CartilageResolution& resolution,
                                                                const std::stop_token& stop);

/// The other side: Z negated, triangles flipped so that they face outwards again.
[[nodiscard]] SampleCartilages mirrored(const SampleCartilages& cartilages);

}  // namespace condyle::sample
