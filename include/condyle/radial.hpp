#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

/// The radial method: rays from one centre. docs/mathematics/02-radial-method.md; Arbabi et al. 2009.

namespace condyle::radial {

class DirectionTable;
class PointBlocks;
/// Which of the two maps from directions to cells.
enum class DirectionMapKind {
  cartesian,  ///< the paper's: (x/R, y/R, sign z), N x N x 2 cells, uneven near z = 0
  cube,       ///< the largest |component| picks a face, the others divided by it are coordinates there
};

struct RadialOptions {
  DirectionMapKind map = DirectionMapKind::cube;
  /// Cells along one side of a face (cube) or of the disc's square (cartesian), 1 to 2048. Finer cells shorten
  /// lists and grow the table; empty chooses about as many cells as fit the number of triangles.
  std::optional<int> cells_per_side;
};

/// Above this angle between ray and surface normal the radial depth is no longer a depth: the ray grazes the
/// wall, and the tangential depth is the one to read. docs/mathematics/02-radial-method.md.
inline constexpr Angle oblique_ray = Angle::degrees(60);

/// Direction along its ray in which a vertex reaches the surface that its gap or depth is measured to.
enum class RayDirection : std::uint8_t { towards_centre, away_from_centre };

/// The answer for each query point, one array per quantity, all of one length, in the order of the points.
struct RadialResults {
  std::vector<PointState> state;
  /// Winding number; for a point on the surface that of the side facing the centre.
  std::vector<int> winding;
  /// Signed, mm, along the ray: > 0 apart, < 0 penetrating, 0 on the surface; +infinity if the ray meets
  /// nothing.
  std::vector<double> radial_gap_mm;
  /// Triangle that the gap or depth is measured to; no_index if there is none.
  std::vector<Index> triangle;
  std::vector<RayDirection> direction;
  /// Between the ray and the normal of that triangle, 0 to a right angle; 0 if there is no triangle.
  std::vector<Angle> ray_to_normal;

  [[nodiscard]] std::size_t size() const noexcept { return state.size(); }
  void resize(std::size_t count);
  friend bool operator==(const RadialResults&, const RadialResults&) = default;
};

/// The points that are not outside at one pose, one array per quantity, in the order of SortedPoints: points
/// that are neighbours in space follow each other.
struct Penetrations {
  /// Number of the point among those that SortedPoints was made from.
  std::vector<Index> point;
  /// Inside, or on the surface.
  std::vector<PointState> state;
  /// Winding number; for a point on the surface that of the side facing the centre.
  std::vector<int> winding;
  /// Triangle that the point leaves through by its nearer exit; for a point on the surface a triangle that it lies
  /// on.
  std::vector<Index> triangle;
  /// Along the ray to that triangle, mm, >= 0; 0 on the surface.
  std::vector<double> depth_mm;
  std::vector<RayDirection> direction;
  /// Between the ray and the normal of that triangle, 0 to a right angle. Filled by
  /// RadialTable::add_ray_to_normal, empty until then: an arctangent costs more than all else of a point.
  std::vector<Angle> ray_to_normal;

  [[nodiscard]] std::size_t size() const noexcept { return point.size(); }
  void clear();
  /// All but ray_to_normal.
  void resize(std::size_t count);
  friend bool operator==(const Penetrations&, const Penetrations&) = default;
};

/// Work counters of a penetration query; numbers add up over queries.
struct PenetrationWork {
  std::uint64_t blocks = 0;       ///< of 16 points: all
  std::uint64_t near_blocks = 0;  ///< of those, not rejected by the table's min-max pyramid
  std::uint64_t near_points = 0;  ///< not rejected by the radii of their cell
  std::uint64_t triangles = 0;    ///< edge functions evaluated, in float
  std::uint64_t uncertain = 0;    ///< points decided in double, or exactly
};

/// Points of the mobile body, sorted once into blocks of neighbours for RadialTable::penetrations. A copy costs a pointer, and
/// an update of one changes no other.
class SortedPoints {
 public:
  /// Points in M's frame, mm; `centre` is the joint centre in that frame. UsageError for a coordinate that is not finite or
  /// beyond 1e30 mm. n log n.
  explicit SortedPoints(PointsView points, const Vec3& centre = Vec3::Zero());

  /// The points have moved: new positions of all, as many as there were. Blocks keep their points, so results keep their
  /// order; blocks of points that have moved apart are slower to ask. UsageError if the number differs or a coordinate is not finite
  /// or beyond 1e30 mm. Linear.
  void update(PointsView points);
  /// The same of those points that are marked, one mark for each; `points` are all. Little more than reading the marks if they
  /// are few.
  void update(PointsView points, std::span<const char> is_moved);

  [[nodiscard]] std::size_t size() const noexcept;

  /// For the library's own use.
  [[nodiscard]] const PointBlocks& blocks() const noexcept { return *blocks_; }

 private:
  std::shared_ptr<PointBlocks> blocks_;
};

/// Contents of a table, for tuning and for the figures of docs/performance.md.
struct RadialTableSize {
  std::size_t cells, entries, bytes;
  Index longest_list;
};

/// Which triangles of one body can be met in each direction from the joint centre, which is the origin of the
/// mesh's frame.
///
/// Built once for a mesh and a centre: every rigid pose of the query points reuses it. All decisions (which
/// triangles a ray crosses, on which side of each crossing the point lies) are exact for the doubles given: a
/// zero is broken by an infinitesimal shift of the ray, the same for all triangles, so that neighbours never
/// disagree. Gaps and depths are double, within 1e-12 of the vertex's radius, whatever the angle at which the
/// ray meets the surface.
///
/// A table that is not being updated may be queried from many threads at once. A table that was moved from
/// may only be assigned to or destroyed.
class RadialTable {
 public:
  /// Raises MeshError if the origin lies exactly on the surface or nearer than 1e-36 mm to a vertex, and UsageError for
  /// options out of range.
  /// Open meshes are accepted; queries of them are not. Linear in triangles and cells.
  explicit RadialTable(Mesh mesh, RadialOptions options = {});
  RadialTable(const RadialTable&);
  RadialTable(RadialTable&&) noexcept;
  RadialTable& operator=(const RadialTable&);
  RadialTable& operator=(RadialTable&&) noexcept;
  ~RadialTable();

  /// The surface has deformed: new positions of all vertices, as many as there were. Answers are those of a
  /// table made anew for the mesh as it is now. Raises UsageError if the number differs and MeshError if
  /// a coordinate is not finite or the surface now holds the origin; the table is then what it was before. After
  /// std::bad_alloc it may only be assigned to or destroyed.
  ///
  /// The first update gives each vertex a slack rectangle on the cube: triangles are binned by the rectangles
  /// of their vertices. Later updates bin only those triangles again whose vertices leave their rectangles,
  /// which then grow: a surface that goes to and fro soon stays in them, and an update costs looking at the vertices. Queries
  /// read the radii of the surface as it was, with slack for how far it has moved, and measure the triangles that points come
  /// near to; once they have measured as many as there are, all is measured anew. Lists are longer by a quarter to a half
  /// than those of a new table.
  void update(PointsView vertices);

  /// New positions of some vertices, each named once. The same otherwise; UsageError also if a number is no vertex's.
  ///
  /// Cost: the triangles at those vertices, the rows of the cells they are in, and a scan of the radii of all cells.
  /// The first such update also finds which triangles each vertex has, and the radii of each triangle in each of its
  /// cells, which takes some 30 bytes per triangle.
  void update(std::span<const Index> moved, PointsView positions);

  /// State, winding number, gap or depth, triangle of every point, given in the table's frame, mm. The gap's
  /// direction: a point outside reaches the surface away from the centre if the centre is outside (ball seen from the
  /// socket: the joint space), and towards it if the centre is inside the solid (socket seen from the ball). A point
  /// inside leaves by its nearer exit. A point exactly at the centre has no ray: its gap is infinite, negative if it
  /// is inside.
  ///
  /// Raises MeshError for an open mesh, naming an edge of its boundary: without an inside there is no answer.
  /// UsageError for a coordinate that is not finite or beyond 1e30 mm. Linear in points; a point costs a scan of its
  /// cell's list, sixteen triangles at a time, and the few of them that its ray comes near. On all threads of the
  /// calling oneTBB arena.
  void query(PointsView points, RadialResults& out) const;
  [[nodiscard]] RadialResults query(PointsView points) const;

  /// Only the radial_gap_mm of query(), one number for each point, sooner: for colours and curves. The same errors;
  /// the angle between ray and normal costs an arctangent each.
  [[nodiscard]] std::vector<double> radial_gaps(PointsView points) const;

  /// Every point that is not outside at a pose X_FM, with what query() says of it, byte for byte: points posed
  /// and rounded once (condyle/pose.hpp), signs exact, on every instruction set alike. All other points are
  /// outside.
  ///
  /// Three passes in vectors of floats: blocks of points and then points are rejected by the radii of the
  /// surface around them; what is left is held against the triangles of its cell, and points that floats do
  /// not settle are decided as query() does. For the paper's map, for a pose that is no rigid motion or moves
  /// the centre by more than four times the distance of the nearest surface, all points are.
  ///
  /// Raises MeshError for an open mesh, UsageError for a pose that is not finite or translates beyond 1e30 mm. Cost: blocks, plus points near the surface; the first call on a table
  /// also what prepare_penetrations() does.
  void penetrations(const SortedPoints& points, const Pose& X_FM, Penetrations& out,
                    PenetrationWork* work = nullptr) const;
  /// The same at each of several poses, on all threads; `out` has as many elements as there are poses.
  void penetrations(const SortedPoints& points, std::span<const Pose> X_FM,
                    std::span<Penetrations> out) const;
  /// Fills out.ray_to_normal; `points` are those that the sorted ones were made from, the pose is the one
  /// of the query.
  void add_ray_to_normal(PointsView points, const Pose& X_FM, Penetrations& out) const;
  /// Builds what penetrations() reads and query() does not: the radii of the surface in each cell and their
  /// min-max pyramid. Done by the first penetrations() otherwise, once after construction and after each
  /// update of all vertices. Linear in triangles and cells.
  void prepare_penetrations() const;

  /// As it is now, after all updates.
  [[nodiscard]] const TriMesh& mesh() const noexcept;
  [[nodiscard]] bool is_closed() const noexcept;
  /// Winding number of the centre; empty for an open mesh.
  [[nodiscard]] std::optional<int> winding_at_centre() const noexcept;
  /// Size of the parts built so far.
  [[nodiscard]] RadialTableSize table_size() const noexcept;

 private:
  std::unique_ptr<DirectionTable> table_;
};

}  // namespace condyle::radial
