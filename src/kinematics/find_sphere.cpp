#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/fit.hpp"
#include "core/parallel.hpp"
#include "core/symmetric.hpp"
#include "kinematics/resampling.hpp"
#include "kinematics/surface_points.hpp"
#include "mesh/edge_balance.hpp"
#include "mesh/surface_pieces.hpp"

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

/// Fullest cells refined at each radius. Two are enough for every head and socket tried, down to edges of half the
/// radius, where normals are off by 10 degrees; the rest is margin.
constexpr std::size_t kept_per_radius = 4;

/// A candidate this near (in radii) to a part already found would grow into the same part.
constexpr double same_ball = 0.25;

/// ... and what has come this near to one, in radii, ends in it: parts differ by more.
constexpr double arrived = 0.02;

/// A vertex belongs to a sphere while its normal is within 30 degrees of its ray (cosine).
constexpr double smallest_ball_cosine = 0.866;

/// ... and its distance within 3 robust deviations, at least and at most these parts of the radius: a head is
/// round to 1 or 2 % of its radius, its neck leaves it by more.
constexpr double ball_deviations_kept = 3;
constexpr double narrowest_ball_band = 1e-6;
constexpr double first_band = 0.10;
constexpr double widest_band = 0.05;

/// A sphere that moves by less, in parts of its radius, stays where it is.
constexpr double settled = 1e-4;

/// Robust deviations from a socket within which a vertex belongs to it and not to its fossa's floor.
constexpr double floor_deviations = 3;

/// Requirements on a spherical part: a tenth of its sphere, and rays spread in all three directions. The
/// smallest eigenvalue of the mean of u u^T is 1/3 for a hemisphere and 0.15 for a cap of 48 degrees; for the
/// strip where a tube touches a sphere from inside (2 sqrt(4 widest_band) radii wide) it is 4 widest_band / 3
/// = 0.07, on coarse meshes up to 0.12.
/// A socket's ring without its fossa has less of the spread than a cap: 0.13 is one of 45 degrees.
constexpr double smallest_coverage = 0.10;
constexpr double smallest_head_spread = 0.15, smallest_socket_spread = 0.13;
constexpr std::size_t fewest_ball_vertices = 12;

/// The normals of a socket are means over this distance, mm for a head of the usual size, and of the root of the surface's area if there is
/// none: more than the voxels of most label maps, whose steps turn normals by
/// 30 degrees and more. At twice that the wall of a fossa 2 mm deep is no longer seen.
constexpr double normals_reach = 1.2, normals_share = 0.005;

/// A socket is no larger than its head and its cartilages: radii that it is looked for with about the head's centre, in those of the head.
constexpr double socket_ratios[] = {1.02, 1.08, 1.15, 1.25};
/// Several spheres of an uneven socket hold nearly the same area, and which holds most is left to the grid of a label map. Centres of head and socket
/// are 1 mm apart: half of what a part supports counts if it is so many radii of the head away, 4 mm of a man's.
constexpr double half_worth_off = 0.15;

/// Candidates with less than this share of the votes of the fullest grow into parts that others grow into, or into none.
constexpr double smallest_vote_share = 0.25;

/// Surfaces of this flatness or less are stairs: those of voxels have 0.7 to 0.8, bones with edges of a sixth of a head's radius 0.95. Their normals
/// are means over more than a step, here over so many of their longest edges.
constexpr double flatness_of_stairs = 0.9;
constexpr double steps_reach = 1.2;

struct BallCandidate {
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
std::vector<BallCandidate> votes(const std::vector<kinematics::SurfacePoint>& points, double inwards,
                                 double radius) {
  struct CellSum {
    Cell cell;
    double area = 0;
    Vec3 weighted = Vec3::Zero();
  };
  // A table with open addressing: `slots` has the number of the cell that lies there, from 1.
  std::vector<CellSum> cells;
  std::vector<Index> slots(std::bit_ceil(2 * points.size()), 0);
  const auto sum_of = [&](const Cell& cell) -> CellSum& {
    std::size_t slot = CellHash{}(cell) & (slots.size() - 1);
    while (slots[slot] != 0 && !(cells[slots[slot] - 1].cell == cell)) slot = (slot + 1) & (slots.size() - 1);
    if (slots[slot] == 0) {
      cells.push_back({cell});
      slots[slot] = static_cast<Index>(cells.size());
    }
    return cells[slots[slot] - 1];
  };
  const double side = cell_in_radii * radius, whole = 4 * std::numbers::pi * radius * radius;
  // Positions relative to one vertex keep cell numbers small wherever the mesh lies.
  const Vec3 origin = points.front().position;
  for (const kinematics::SurfacePoint& p : points) {
    const Vec3 centre = p.position - inwards * radius * p.normal;
    const Vec3 scaled = (centre - origin) / side;
    if (!(scaled.cwiseAbs().maxCoeff() < farthest_cell)) continue;
    CellSum& sum = sum_of({static_cast<std::int32_t>(std::floor(scaled.x())),
                           static_cast<std::int32_t>(std::floor(scaled.y())),
                           static_cast<std::int32_t>(std::floor(scaled.z()))});
    const double area = std::min(p.area, largest_vote * whole);
    sum.area += area;
    sum.weighted += area * centre;
  }
  std::vector<BallCandidate> out;
  for (const CellSum& sum : cells) {
    const BallCandidate candidate{{sum.weighted / sum.area, radius}, sum.area / whole};
    if (candidate.sphere.centre.allFinite()) out.push_back(candidate);
  }
  return out;
}

/// The order does not depend on that of the hash table.
bool fuller(const BallCandidate& a, const BallCandidate& b) {
  const auto key = [](const BallCandidate& c) {
    return std::array{-c.votes, c.sphere.radius, c.sphere.centre.x(), c.sphere.centre.y(),
                      c.sphere.centre.z()};
  };
  return key(a) < key(b);
}

/// The radii that a sphere may have.
struct Radii {
  double smallest, largest;
};

/// By the root of the surface's area unless they are given. `is_open`: whether the surface is, if that is known.
Radii radii_of(const TriMesh& surface, const SphereSearch& search, std::optional<bool> is_open = {}) {
  if (search.smallest_radius && search.largest_radius)
    return {*search.smallest_radius, *search.largest_radius};
  const double size = kinematics::root_of_area(surface);
  if (!is_open) is_open = mesh::first_unbalanced_edge(surface).has_value();
  const double largest = *is_open ? largest_radius_share_of_sheet : largest_radius_share;
  return {search.smallest_radius.value_or(smallest_radius_share * size),
          search.largest_radius.value_or(largest * size)};
}

std::vector<BallCandidate> candidates(const std::vector<kinematics::SurfacePoint>& points, double inwards,
                                      const Radii& radii) {
  std::vector<double> tried;
  for (double radius = radii.smallest; radius <= radii.largest * radius_ratio; radius *= radius_ratio)
    tried.push_back(radius);
  std::vector<std::vector<BallCandidate>> of_radius(tried.size());
  core::parallel_chunks(tried.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      auto here = votes(points, inwards, tried[i]);
      const auto kept = static_cast<std::ptrdiff_t>(std::min(here.size(), kept_per_radius));
      std::partial_sort(here.begin(), here.begin() + kept, here.end(), fuller);
      of_radius[i].assign(here.begin(), here.begin() + kept);
    }
  });
  std::vector<BallCandidate> found;
  for (const auto& here : of_radius) found.insert(found.end(), here.begin(), here.end());
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

/// Points whose distance and normal are those of a sphere, as positions in `points`; `places` has where those are.
std::vector<Index> on_sphere(const std::vector<SurfacePoint>& points, const Points& places,
                             const Sphere& sphere, double inwards, double band) {
  // Most points are farther off than rounding could mend: no root is taken of their squares.
  constexpr double slack = 1e-12;
  const double inner = std::max(sphere.radius - band, 0.0), outer = sphere.radius + band;
  const double least = inner * inner * (1 - slack), most = outer * outer * (1 + slack);
  const double x = sphere.centre.x(), y = sphere.centre.y(), z = sphere.centre.z();
  constexpr std::size_t block = 512;
  std::array<double, block> squared;
  std::array<Index, block> near;
  std::vector<Index> on;
  for (std::size_t first = 0; first < points.size(); first += block) {
    const std::size_t count = std::min(block, points.size() - first);
    for (std::size_t k = 0; k < count; ++k) {
      const double dx = places.x[first + k] - x, dy = places.y[first + k] - y, dz = places.z[first + k] - z;
      squared[k] = dx * dx + dy * dy + dz * dz;
    }
    // Without branches: which points are near cannot be predicted.
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count; ++k) {
      near[kept] = static_cast<Index>(first + k);
      kept +=
          static_cast<std::size_t>(!(squared[k] < least)) & static_cast<std::size_t>(!(squared[k] > most));
    }
    for (std::size_t k = 0; k < kept; ++k) {
      const SurfacePoint& point = points[near[k]];
      const Vec3 ray = point.position - sphere.centre;
      const double distance = ray.norm();
      if (std::abs(distance - sphere.radius) > band) continue;
      if (inwards * point.normal.dot(ray) < smallest_ball_cosine * distance) continue;
      on.push_back(near[k]);
    }
  }
  return on;
}

/// The sphere of least squares through some of the places to a ten-thousandth of its radius, by a few Gauss-Newton steps from one
/// that is near it: all sums of fit_sphere() in one pass, and none of its care. Empty if that is not enough.
std::optional<Sphere> roughly_fitted(const Points& places, const std::vector<Index>& part, Sphere sphere) {
  constexpr int most_steps = 6;
  const auto count = static_cast<double>(part.size());
  for (int step = 0; step < most_steps; ++step) {
    const double x = sphere.centre.x(), y = sphere.centre.y(), z = sphere.centre.z();
    double lengths = 0, ux = 0, uy = 0, uz = 0, bx = 0, by = 0, bz = 0;
    double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
    for (const Index i : part) {
      const double wx = places.x[i] - x, wy = places.y[i] - y, wz = places.z[i] - z;
      const double length = std::sqrt(wx * wx + wy * wy + wz * wz), share = 1 / length;
      const double a = wx * share, b = wy * share, c = wz * share;
      lengths += length, ux += a, uy += b, uz += c, bx += wx, by += wy, bz += wz;
      xx += a * a, yy += b * b, zz += c * c, xy += a * b, yz += b * c, zx += c * a;
    }
    const Vec3 u(ux, uy, uz);
    Eigen::Matrix3d A;
    A << xx, xy, zx, xy, yy, yz, zx, yz, zz;
    A -= u * u.transpose() / count;
    const Vec3 move = core::solved(A, Vec3(bx, by, bz) - lengths / count * u);
    sphere.radius = lengths / count - move.dot(u) / count;
    sphere.centre += move;
    if (!(move.norm() < sphere.radius)) return std::nullopt;
    if (move.norm() < settled * sphere.radius) return sphere;
  }
  return std::nullopt;
}

struct BallPart {
  SphericalPatch patch;
  double spread;  ///< smallest eigenvalue of the mean of u u^T over the area, u the unit rays
  double
      support;  ///< area, mm^2: all of it where normals are along the rays, none if they are 30 degrees off
};

BallPart measured(const std::vector<kinematics::SurfacePoint>& points, const std::vector<Index>& part,
                  SphereFit fit) {
  Eigen::Matrix3d rays = Eigen::Matrix3d::Zero();
  const double area = area_of(points, part);
  double support = 0;
  for (const Index i : part) {
    const Vec3 u = (points[i].position - fit.sphere.centre).normalized();
    rays += points[i].area / area * u * u.transpose();
    support += points[i].area * (std::abs(points[i].normal.dot(u)) - smallest_ball_cosine) /
               (1 - smallest_ball_cosine);
  }
  const double coverage = area / area_of(fit.sphere);
  return {{std::move(fit), coverage}, core::axes_of(rays).values[0], support};
}

bool are_stairs(const std::vector<SurfacePoint>& points) noexcept {
  double flat = 0, area = 0;
  for (const SurfacePoint& point : points) flat += point.area * point.flatness, area += point.area;
  return flat <= flatness_of_stairs * area;
}

/// Normals as the search needs them: of a socket, and of any surface of stairs, means. The area of stairs becomes that of the slope.
void smooth_normals(const kinematics::PointNeighbours& neighbours, SphericalPart part, double socket_reach,
                    std::vector<SurfacePoint>& points) {
  const bool is_socket = part == SphericalPart::socket;
  if (!are_stairs(points)) {
    if (is_socket) neighbours.average_normals(points, socket_reach);
    return;
  }
  const std::vector<SurfacePoint> stairs = points;
  const double reach = steps_reach * neighbours.longest_usual_edge(points);
  neighbours.average_normals(points, is_socket ? std::max(reach, socket_reach) : reach);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].area *= points[i].flatness * std::max(0.0, points[i].normal.dot(stairs[i].normal));
}

bool near(const Sphere& a, const Sphere& b, double in_radii) noexcept {
  return (a.centre - b.centre).norm() < in_radii * b.radius &&
         std::abs(a.radius - b.radius) < in_radii * b.radius;
}

/// The points of one search, their places side by side, and which of them are joined.
struct SearchedPoints {
  const TriMesh& mesh;
  const std::vector<SurfacePoint>& points;
  kinematics::PointNeighbours neighbours{mesh, points};
  Points places = {};

  SearchedPoints(const TriMesh& of, const std::vector<SurfacePoint>& surface) : mesh(of), points(surface) {
    places.reserve(points.size());
    for (const SurfacePoint& p : points) places.push_back(p.position);
  }
};

/// Fits, keeps what lies within the band of the fit, connected, and fits again until the same vertices come
/// back. On the way a rough fit does; where the vertices stay, they are fitted with care and must stay again. A vertex at the
/// edge of the band may come and go for ever, as on surfaces of voxels: then the last vertices are taken if the sphere stays
/// where it is, else, if it goes to and fro near one place, those that were in all of the last parts. Empty where it comes to a part that is
/// known.
std::optional<BallPart> grown(const SearchedPoints& searched, Sphere sphere, double inwards,
                              const Radii& radii, const std::vector<BallPart>& known) {
  const auto& [mesh, points, neighbours, places] = searched;
  constexpr int most_rounds = 60, last_rounds = 12;
  double band = first_band * sphere.radius;
  std::vector<Index> part, always;
  std::optional<SphereFit> fit;
  bool same = false;
  double moved = std::numeric_limits<double>::infinity();
  for (int round = 0; round < most_rounds; round += same ? 0 : 1) {
    const std::vector<Index> on = on_sphere(points, places, sphere, inwards, band);
    // With the widest band of all in the first round, what is too small now will not grow; and what all together is too
    // small has no part that is not.
    const double least_area = smallest_coverage * area_of(sphere);
    if (area_of(points, on) < least_area) return std::nullopt;
    auto next = neighbours.largest_connected_part(points, on);
    if (next.size() < fewest_ball_vertices || area_of(points, next) < least_area) return std::nullopt;
    same = next == part;
    if (same && fit) return measured(points, part, std::move(*fit));
    part = std::move(next);
    if (round == most_rounds - last_rounds) always = part;
    std::erase_if(always, [&](Index i) { return !std::binary_search(part.begin(), part.end(), i); });
    fit.reset();
    const auto rough = same ? std::nullopt : roughly_fitted(places, part, sphere);
    try {
      if (!rough) fit = fit_sphere(mesh.vertices, kinematics::vertices_of(points, part));
    } catch (const MeshError&) {
      return std::nullopt;
    }
    const Sphere before = std::exchange(sphere, rough ? *rough : fit->sphere);
    moved = (sphere.centre - before.centre).norm() + std::abs(sphere.radius - before.radius);
    if (sphere.radius < radii.smallest || sphere.radius > radii.largest) return std::nullopt;
    const auto is_there = [&](const BallPart& other) {
      return near(sphere, other.patch.fit.sphere, arrived);
    };
    if (std::any_of(known.begin(), known.end(), is_there)) return std::nullopt;
    std::vector<double> residuals;
    residuals.reserve(part.size());
    for (const Index i : part)
      residuals.push_back((points[i].position - sphere.centre).norm() - sphere.radius);
    band = std::clamp(ball_deviations_kept * kinematics::robust_deviation(std::move(residuals)),
                      narrowest_ball_band * sphere.radius, widest_band * sphere.radius);
  }
  if (!(moved < arrived * sphere.radius)) return std::nullopt;
  if (!(moved < settled * sphere.radius)) part = std::move(always);
  if (part.size() < fewest_ball_vertices) return std::nullopt;
  try {
    return measured(points, part, fit_sphere(mesh.vertices, kinematics::vertices_of(points, part)));
  } catch (const MeshError&) {
    return std::nullopt;
  }
}

/// A socket without the floor of its fossa, which lies a few millimetres deeper and draws the sphere towards it: fitted to
/// the nearer two thirds of the part, again until they stay the same (concentration steps of least trimmed squares,
/// Rousseeuw and Van Driessen 2006), then to all that lies within the deviations of these.
BallPart without_floor(const TriMesh& mesh, const std::vector<kinematics::SurfacePoint>& points,
                       BallPart whole) {
  constexpr int most_rounds = 100;
  SphereFit fit = whole.patch.fit;
  std::vector<Index> part;  // positions in `points`; both are ascending by vertex
  for (std::size_t i = 0; i < points.size() && part.size() < fit.vertices.size(); ++i)
    if (points[i].vertex == whole.patch.fit.vertices[part.size()]) part.push_back(static_cast<Index>(i));
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
                                 narrowest_ball_band * fit.sphere.radius);
    std::vector<Index> all;
    std::copy_if(part.begin(), part.end(), std::back_inserter(all),
                 [&](Index i) { return distance(i) <= band; });
    kept = refitted(std::move(all));
    return measured(points, kept, std::move(fit));
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
  std::vector<double> moves(drawn_parts.draws.size());
  core::parallel_chunks(moves.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      try {
        moves[i] = (fit_sphere(mesh.vertices, drawn_parts.draws[i]).sphere.centre - centre).norm();
      } catch (const MeshError&) {  // no centre at all
        moves[i] = fit.sphere.radius;
      }
    }
  });
  return kinematics::upper_bound_of(std::move(moves)) * drawn_parts.widening;
}

}  // namespace

SphericalPatch kinematics::patch_of(const TriMesh& mesh, const std::vector<Index>& vertices) {
  auto points = surface_points(mesh, std::nullopt);
  if (are_stairs(points)) smooth_normals(PointNeighbours(mesh, points), SphericalPart::head, 0, points);
  std::vector<Index> part;
  part.reserve(vertices.size());
  for (std::size_t i = 0; i < points.size() && part.size() < vertices.size(); ++i)
    if (points[i].vertex == vertices[part.size()]) part.push_back(static_cast<Index>(i));
  return measured(points, part, fit_sphere(mesh.vertices, vertices)).patch;
}

std::optional<SphericalPatch> kinematics::patch_on(const TriMesh& mesh, const Sphere& sphere,
                                                   SphericalPart of) {
  const bool is_head = of == SphericalPart::head;
  auto points = is_head ? surface_points(mesh, std::nullopt)
                        : surface_points(mesh, Sphere{sphere.centre, (1 + widest_band) * sphere.radius});
  const SearchedPoints searched(mesh, points);
  smooth_normals(searched.neighbours, of, by_head(normals_reach, sphere), points);
  const auto distance = [&](Index i) {
    return std::abs((points[i].position - sphere.centre).norm() - sphere.radius);
  };
  const auto within = [&](double band) {
    return searched.neighbours.largest_connected_part(
        points, on_sphere(points, searched.places, sphere, is_head ? 1.0 : -1.0, band));
  };
  // All that may belong to it; and of that, what lies within the deviations, as a sphere that is fitted keeps it.
  const double widest = widest_band * sphere.radius;
  std::vector<double> distances;
  for (const Index i : within(widest)) distances.push_back(distance(i));
  const std::vector<Index> part =
      within(std::clamp(ball_deviations_kept * kinematics::robust_deviation(std::move(distances)),
                        narrowest_ball_band * sphere.radius, widest));
  if (part.size() < fewest_ball_vertices) return std::nullopt;
  // By area: the mesh may be finer in some places than in others.
  SphereFit fit{sphere, 0, 0, vertices_of(points, part)};
  for (const Index i : part) {
    fit.rms_residual += points[i].area * distance(i) * distance(i);
    fit.largest_residual = std::max(fit.largest_residual, distance(i));
  }
  fit.rms_residual = std::sqrt(fit.rms_residual / area_of(points, part));
  return measured(points, part, std::move(fit)).patch;
}

SphericalPatch kinematics::stated_patch(const TriMesh& mesh, const Sphere& sphere, SphericalPart of) {
  return patch_on(mesh, sphere, of).value_or(SphericalPatch{{sphere, 0, 0, {}}, 0});
}

namespace {

/// The spherical parts, the best first; one at least. Of a socket round a head, spheres about its centre are grown too, and a part counts less
/// the farther its centre is from that.
std::vector<BallPart> found_spheres(const TriMesh& mesh, const Radii& radii, const SphereSearch& search,
                                    const Sphere* head) {
  const double reach = head ? by_head(normals_reach, *head) : normals_share * kinematics::root_of_area(mesh);
  const bool is_head = search.part == SphericalPart::head;
  auto points = kinematics::surface_points(mesh, search.within);
  std::vector<BallPart> parts;
  if (points.size() >= fewest_ball_vertices) {
    const SearchedPoints searched(mesh, points);
    smooth_normals(searched.neighbours, search.part, reach, points);
    const double inwards = is_head ? 1.0 : -1.0;
    auto all = candidates(points, inwards, radii);
    if (head)
      for (const double ratio : socket_ratios)
        all.insert(all.begin(), {{head->centre, ratio * head->radius}, all.empty() ? 1 : all.front().votes});
    const std::vector<BallPart> none;
    for (const BallCandidate& candidate : all) {
      if (candidate.votes < smallest_vote_share * all.front().votes) break;
      const auto known = [&](const BallPart& part) {
        return near(candidate.sphere, part.patch.fit.sphere, same_ball);
      };
      const bool is_about_head = head && candidate.sphere.centre == head->centre;
      if (!is_about_head && std::any_of(parts.begin(), parts.end(), known)) continue;
      // Sockets lie close to each other, the fossa beside the rest: none of them stands for another.
      auto part = grown(searched, candidate.sphere, inwards, radii, is_head ? parts : none);
      // Most candidates of a socket grow into the same part.
      const auto same = [&](const BallPart& other) {
        return other.patch.fit.vertices == part->patch.fit.vertices;
      };
      if (part && std::none_of(parts.begin(), parts.end(), same)) parts.push_back(std::move(*part));
    }
  }
  std::erase_if(parts, [&](const BallPart& part) {
    return part.patch.coverage < smallest_coverage ||
           part.spread < (is_head ? smallest_head_spread : smallest_socket_spread);
  });
  if (parts.empty()) {
    std::ostringstream message;
    message.exceptions(std::ios::badbit);  // no memory is an error, not half a message
    message << "no spherical " << (is_head ? "head" : "socket") << " with a radius from " << radii.smallest
            << " to " << radii.largest << " mm among " << points.size() << " vertices";
    if (is_head) message << " (a mesh of inverted orientation has sockets for heads)";
    throw MeshError(message.str());
  }
  // A head is what covers most of its sphere. A socket covers little of its own: a part of it, or the fossa, covers as much
  // of a smaller one.
  if (!is_head)
    for (BallPart& part : parts) part = without_floor(mesh, points, std::move(part));
  const auto worth = [&](const BallPart& part) {
    if (is_head) return part.patch.coverage;
    if (!head) return part.support;
    const double off = (part.patch.fit.sphere.centre - head->centre).norm() / (half_worth_off * head->radius);
    return part.support / (1 + off * off);
  };
  std::stable_sort(parts.begin(), parts.end(),
                   [&](const BallPart& a, const BallPart& b) { return worth(a) > worth(b); });
  return parts;
}

SphericalPatch found_sphere(const TriMesh& mesh, const Radii& radii, const SphereSearch& search,
                            const Sphere* head) {
  SphericalPatch best = std::move(found_spheres(mesh, radii, search, head).front().patch);
  if (search.resamples > 0) best.centre_bound_mm = centre_bound(mesh, best.fit, search.resamples);
  return best;
}

}  // namespace

SphericalPatch find_sphere(const Mesh& mesh, const SphereSearch& search) {
  const Mesh& outer = mesh::outer_surface(mesh);
  return found_sphere(outer, radii_of(outer, search, !outer.is_closed()), search, nullptr);
}

SphericalPatch kinematics::find_sphere_on(const TriMesh& mesh, const SphereSearch& search) {
  return found_sphere(mesh, radii_of(mesh, search), search, nullptr);
}

std::optional<SphericalPatch> kinematics::find_sphere_where(
    const TriMesh& mesh, const SphereSearch& search, const std::function<bool(const SphericalPatch&)>& fits,
    std::optional<bool> is_open) {
  try {
    for (BallPart& part : found_spheres(mesh, radii_of(mesh, search, is_open), search, nullptr)) {
      if (!fits(part.patch)) continue;
      if (search.resamples > 0)
        part.patch.centre_bound_mm = centre_bound(mesh, part.patch.fit, search.resamples);
      return std::move(part.patch);
    }
  } catch (const MeshError&) {  // nothing spherical
  }
  return std::nullopt;
}

SphericalPatch kinematics::find_socket_round(const TriMesh& mesh, const Sphere& head,
                                             const SphereSearch& search) {
  return found_sphere(mesh, radii_of(mesh, search), search, &head);
}

}  // namespace condyle
