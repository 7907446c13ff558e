#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <optional>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/fit.hpp"
#include "kinematics/resampling.hpp"
#include "kinematics/surface_points.hpp"

namespace condyle {
namespace {

using kinematics::SurfacePoint;

/// Radii tried, each this much larger than the one before: every head is within 5 % of one of them, a fifth
/// of a cell.
constexpr double radius_ratio = 1.1;

/// Side of the cells in which votes are gathered, in radii: the spread, on a head of radius r, of p - r n for
/// normals off by up to 7 degrees in both directions.
constexpr double cell_in_radii = 0.25;

/// Most that one vertex votes for, in parts of the whole sphere: a sphere of a dozen vertices gives each so
/// much. The corners of large flat faces have more area than any head and would outvote it.
constexpr double largest_vote = 1.0 / 12;

/// Vertices farther than this many cells from the first one (3,000 km) are on no joint and would overflow
/// cell numbers.
constexpr double farthest_cell = 1e9;

/// Fullest cells followed up at each radius. Two are enough for every head and socket tried, down to edges of
/// half the radius, where normals are off by 10 degrees; the rest is margin.
constexpr std::size_t kept_per_radius = 4;

/// A candidate this near (in radii) to a part already found would grow into the same part.
constexpr double same_part = 0.25;

/// A vertex belongs to a sphere while its normal is within 30 degrees of its ray (cosine).
constexpr double smallest_cosine = 0.866;

/// ... and its distance within 3 robust deviations, at least and at most these parts of the radius: a head is
/// round to 1 or 2 % of its radius, its neck leaves it by more.
constexpr double deviations_kept = 3;
constexpr double narrowest_band = 1e-6;
constexpr double first_band = 0.10;
constexpr double widest_band = 0.05;

/// Robust deviations from a socket within which a vertex belongs to it and not to its fossa's floor.
constexpr double floor_deviations = 3;

/// What a spherical part must have: a tenth of its sphere, and rays spread in all three directions. The
/// smallest eigenvalue of the mean of u u^T is 1/3 for a hemisphere and 0.15 for a cap of 48 degrees; for the
/// strip where a tube touches a sphere from inside (2 sqrt(4 widest_band) radii wide) it is 4 widest_band / 3
/// = 0.07, on coarse meshes up to 0.12.
constexpr double smallest_coverage = 0.10;
constexpr double smallest_spread = 0.15;
constexpr std::size_t fewest_vertices = 12;

struct Candidate {
  Sphere sphere;
  double votes;  ///< area that voted for it, in parts of the whole sphere
};

/// A cell of space at one radius.
struct Cell {
  std::int32_t x, y, z;
  friend bool operator==(const Cell&, const Cell&) = default;
};
struct CellHash {
  std::size_t operator()(const Cell& c) const noexcept {
    const auto mix = [](std::uint64_t h, std::int32_t v) {
      return (h ^ static_cast<std::uint32_t>(v)) * 0x9e3779b97f4a7c15u;
    };
    const std::uint64_t h = mix(mix(mix(1, c.x), c.y), c.z);
    return static_cast<std::size_t>(h ^ (h >> 29));
  }
};

/// Votes for centres at one radius: moved inwards by r along its normals, a head of radius r collapses to a
/// point.
///
///      . - ~ - .              every point goes to p - r n; the area that
///    /  \  |  /  \            arrives in one cell, over 4 pi r^2, is the
///   |  -- cell --  |          part of the sphere that is there
///    \  /  |  \  /
///         | |   neck: goes elsewhere
std::vector<Candidate> votes(const std::vector<kinematics::SurfacePoint>& points, double inwards,
                             double radius) {
  struct CellSum {
    double area = 0;
    Vec3 weighted = Vec3::Zero();
  };
  std::unordered_map<Cell, CellSum, CellHash> cells;
  const double side = cell_in_radii * radius, whole = 4 * std::numbers::pi * radius * radius;
  // Positions relative to one vertex keep cell numbers small wherever the mesh lies.
  const Vec3 origin = points.front().position;
  for (const kinematics::SurfacePoint& p : points) {
    const Vec3 centre = p.position - inwards * radius * p.normal;
    const Vec3 scaled = (centre - origin) / side;
    if (!(scaled.cwiseAbs().maxCoeff() < farthest_cell)) continue;
    const Cell cell{static_cast<std::int32_t>(std::floor(scaled.x())),
                    static_cast<std::int32_t>(std::floor(scaled.y())),
                    static_cast<std::int32_t>(std::floor(scaled.z()))};
    CellSum& sum = cells[cell];
    const double area = std::min(p.area, largest_vote * whole);
    sum.area += area;
    sum.weighted += area * centre;
  }
  std::vector<Candidate> out;
  for (const auto& [cell, sum] : cells) {
    const Candidate candidate{{sum.weighted / sum.area, radius}, sum.area / whole};
    if (candidate.sphere.centre.allFinite()) out.push_back(candidate);
  }
  return out;
}

/// The order does not depend on that of the hash table.
bool fuller(const Candidate& a, const Candidate& b) {
  const auto key = [](const Candidate& c) {
    return std::array{-c.votes, c.sphere.radius, c.sphere.centre.x(), c.sphere.centre.y(),
                      c.sphere.centre.z()};
  };
  return key(a) < key(b);
}

std::vector<Candidate> candidates(const std::vector<kinematics::SurfacePoint>& points, double inwards,
                                  const SphereSearch& search) {
  std::vector<Candidate> found;
  for (double radius = search.smallest_radius; radius <= search.largest_radius * radius_ratio;
       radius *= radius_ratio) {
    auto here = votes(points, inwards, radius);
    const auto kept = static_cast<std::ptrdiff_t>(std::min(here.size(), kept_per_radius));
    std::partial_sort(here.begin(), here.begin() + kept, here.end(), fuller);
    found.insert(found.end(), here.begin(), here.begin() + kept);
  }
  std::sort(found.begin(), found.end(), fuller);
  return found;
}

double area_of(const Sphere& sphere) noexcept {
  return 4 * std::numbers::pi * sphere.radius * sphere.radius;
}

double area_of(const std::vector<kinematics::SurfacePoint>& points, const std::vector<Index>& part) noexcept {
  double area = 0;
  for (const Index i : part) area += points[i].area;
  return area;
}

/// Points whose distance and normal are those of a sphere, as positions in `points`.
std::vector<Index> on_sphere(const std::vector<kinematics::SurfacePoint>& points, const Sphere& sphere,
                             double inwards, double band) {
  std::vector<Index> on;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 ray = points[i].position - sphere.centre;
    const double distance = ray.norm();
    if (std::abs(distance - sphere.radius) > band) continue;
    if (inwards * points[i].normal.dot(ray) < smallest_cosine * distance) continue;
    on.push_back(static_cast<Index>(i));
  }
  return on;
}

struct Part {
  SphericalPatch patch;
  double spread;  ///< smallest eigenvalue of the mean of u u^T over the area, u the unit rays
};

Part measured(const std::vector<kinematics::SurfacePoint>& points, const std::vector<Index>& part,
              SphereFit fit) {
  Eigen::Matrix3d rays = Eigen::Matrix3d::Zero();
  const double area = area_of(points, part);
  for (const Index i : part) {
    const Vec3 u = (points[i].position - fit.sphere.centre).normalized();
    rays += points[i].area / area * u * u.transpose();
  }
  const Vec3 spread =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(rays, Eigen::EigenvaluesOnly).eigenvalues();
  const double coverage = area / area_of(fit.sphere);
  return {{std::move(fit), coverage}, spread[0]};
}

bool near(const Sphere& a, const Sphere& b) noexcept {
  return (a.centre - b.centre).norm() < same_part * b.radius &&
         std::abs(a.radius - b.radius) < same_part * b.radius;
}

/// Fits, keeps what lies within the band of the fit, connected, and fits again until the same vertices come
/// back.
std::optional<Part> grown(const TriMesh& mesh, const std::vector<kinematics::SurfacePoint>& points,
                          Sphere sphere, double inwards, const SphereSearch& search) {
  constexpr int most_rounds = 60;
  double band = first_band * sphere.radius;
  std::vector<Index> part;
  for (int round = 0; round < most_rounds; ++round) {
    auto next = kinematics::largest_connected_part(mesh, points, on_sphere(points, sphere, inwards, band));
    if (next.size() < fewest_vertices) return std::nullopt;
    // With the widest band of all in the first round, what is too small now will not grow.
    if (area_of(points, next) < smallest_coverage * area_of(sphere)) return std::nullopt;
    const bool same = next == part;
    part = std::move(next);
    const auto vertices = kinematics::vertices_of(points, part);
    SphereFit fit;
    try {
      fit = fit_sphere(mesh.vertices, vertices);
    } catch (const MeshError&) {
      return std::nullopt;
    }
    sphere = fit.sphere;
    if (sphere.radius < search.smallest_radius || sphere.radius > search.largest_radius) return std::nullopt;
    if (same) return measured(points, part, std::move(fit));
    std::vector<double> residuals;
    for (const Index v : vertices)
      residuals.push_back((mesh.vertices[v] - sphere.centre).norm() - sphere.radius);
    band = std::clamp(deviations_kept * kinematics::robust_deviation(std::move(residuals)),
                      narrowest_band * sphere.radius, widest_band * sphere.radius);
  }
  return std::nullopt;
}

/// A socket without the floor of its fossa, which lies a few millimetres deeper and draws the sphere towards it: fitted to
/// the nearer two thirds of the part, again until they stay the same (concentration steps of least trimmed squares,
/// Rousseeuw and Van Driessen 2006), then to all that lies within the deviations of these.
SphericalPatch without_floor(const TriMesh& mesh, const std::vector<kinematics::SurfacePoint>& points,
                             SphericalPatch whole) {
  constexpr int most_rounds = 100;
  SphereFit fit = whole.fit;
  std::vector<Index> part;  // positions in `points`; both are ascending by vertex
  for (std::size_t i = 0; i < points.size() && part.size() < fit.vertices.size(); ++i)
    if (points[i].vertex == whole.fit.vertices[part.size()]) part.push_back(static_cast<Index>(i));
  const auto distance = [&](Index i) {
    return std::abs((points[i].position - fit.sphere.centre).norm() - fit.sphere.radius);
  };
  const auto held = static_cast<std::ptrdiff_t>(part.size() * 2 / 3);
  const auto refitted = [&](std::vector<Index> kept) {
    std::sort(kept.begin(), kept.end());
    fit = fit_sphere(mesh.vertices, kinematics::vertices_of(points, kept));
    return kept;
  };
  std::vector<Index> kept = part;
  try {
    for (int round = 0; round < most_rounds; ++round) {
      std::vector<Index> nearer = part;
      std::nth_element(nearer.begin(), nearer.begin() + held, nearer.end(), [&](Index a, Index b) {
        return std::pair(distance(a), a) < std::pair(distance(b), b);
      });
      nearer.resize(static_cast<std::size_t>(held));
      nearer = refitted(std::move(nearer));
      if (std::exchange(kept, nearer) == nearer) break;
    }
    std::vector<double> distances;
    for (const Index i : part) distances.push_back(distance(i));
    const double band = std::max(floor_deviations * kinematics::robust_deviation(std::move(distances)),
                                 narrowest_band * fit.sphere.radius);
    std::vector<Index> all;
    std::copy_if(part.begin(), part.end(), std::back_inserter(all),
                 [&](Index i) { return distance(i) <= band; });
    kept = refitted(std::move(all));
    return measured(points, kept, std::move(fit)).patch;
  } catch (const MeshError&) {
    return whole;
  }
}

/// Bound on the centre from patches: cells of a cube about it.
double centre_bound(const TriMesh& mesh, const SphereFit& fit, std::size_t resamples) {
  constexpr int across = 2;
  const Vec3 centre = fit.sphere.centre;
  const auto block_of = [&](Index v) {
    const Vec3 ray = mesh.vertices[v] - centre;
    Eigen::Index axis = 0;
    const double largest = ray.cwiseAbs().maxCoeff(&axis);
    const auto part = [&](Eigen::Index other) {
      const double share = largest > 0 ? (ray[other] / largest + 1) / 2 : 0;
      return std::min(static_cast<std::int64_t>(share * across), std::int64_t{across - 1});
    };
    const std::int64_t face = 2 * axis + (ray[axis] > 0 ? 1 : 0);
    return (face * across + part((axis + 1) % 3)) * across + part((axis + 2) % 3);
  };
  constexpr std::size_t unknowns = 4;
  const auto drawn_parts = kinematics::resampled(fit.vertices, resamples, unknowns, block_of);
  std::vector<double> moves;
  for (const std::vector<Index>& drawn : drawn_parts.draws) {
    try {
      moves.push_back((fit_sphere(mesh.vertices, drawn).sphere.centre - centre).norm());
    } catch (const MeshError&) {  // no centre at all
      moves.push_back(fit.sphere.radius);
    }
  }
  return kinematics::upper_bound_of(std::move(moves)) * drawn_parts.widening;
}

}  // namespace

SphericalPatch find_sphere(const TriMesh& mesh, const SphereSearch& search) {
  const auto points = kinematics::surface_points(mesh, search.within);
  std::vector<Part> parts;
  if (points.size() >= fewest_vertices) {
    const double inwards = search.part == SphericalPart::head ? 1.0 : -1.0;
    for (const Candidate& candidate : candidates(points, inwards, search)) {
      const auto known = [&](const Part& part) { return near(candidate.sphere, part.patch.fit.sphere); };
      if (std::any_of(parts.begin(), parts.end(), known)) continue;
      if (auto part = grown(mesh, points, candidate.sphere, inwards, search))
        parts.push_back(std::move(*part));
    }
  }
  std::erase_if(parts, [](const Part& part) {
    return part.patch.coverage < smallest_coverage || part.spread < smallest_spread;
  });
  if (parts.empty()) {
    std::ostringstream message;
    message << "no spherical " << (search.part == SphericalPart::head ? "head" : "socket")
            << " with a radius from " << search.smallest_radius << " to " << search.largest_radius
            << " mm among " << points.size() << " vertices";
    if (search.part == SphericalPart::head)
      message << " (a mesh of inverted orientation has sockets for heads)";
    throw MeshError(message.str());
  }
  const auto best = std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return a.patch.coverage < b.patch.coverage;
  });
  if (search.part == SphericalPart::socket) best->patch = without_floor(mesh, points, std::move(best->patch));
  if (search.resamples > 0)
    best->patch.centre_bound_mm = centre_bound(mesh, best->patch.fit, search.resamples);
  return std::move(best->patch);
}

}  // namespace condyle
