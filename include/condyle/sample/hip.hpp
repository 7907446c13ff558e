#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <variant>

#include "condyle/mesh.hpp"
#include "condyle/sample/hip_parameters.hpp"

namespace condyle {

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
SampleHip sample_hip(const HipParameters& parameters, const Resolution& resolution);
/// The same; empty if it was stopped.
std::optional<SampleHip> sample_hip(const HipParameters& parameters, const Resolution& resolution,
                                    const std::stop_token& stop);

/// The other side: Z negated, triangles flipped so that they face outwards again.
TriMesh mirrored(const TriMesh& mesh);
SampleHip mirrored(const SampleHip& hip);

}  // namespace condyle
