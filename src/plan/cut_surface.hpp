#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "condyle/joint.hpp"
#include "condyle/resection.hpp"
#include "plan/bends.hpp"
#include "plan/refine.hpp"
#include "plan/swept_interval.hpp"

namespace condyle::plan {

/// A place that still obstructs a target.
struct Obstruction {
  std::size_t target;
  double from_rad;  ///< where its motion is stopped
  KeptBy by;
  Vec3 point;  ///< of the surface before, in the cut bone's frame
};

/// A part of a bone.
struct Place {
  Vec3 centre;
  double radius_mm;
};

/// A point of a surface between corners, by their weights: of a triangle, an edge or a vertex, whose corners come first. The others are
/// no_index and weigh nothing.
struct SurfacePoint {
  std::array<Index, 3> corners;
  std::array<double, 3> weights;
};

/// A point of the surface that meets the other bone on the way to a target.
struct Met {
  SurfacePoint point;
  Need need;
};

/// The surface of a bone that is lowered along directions that stay what they are: at each vertex inwards along the normal, smoothed
/// over some millimetres. Raw normals would cross where triangles are smaller than the depth.
class CutSurface {
 public:
  struct Vertex {
    Vec3 before, inwards;
    double depth_mm = 0;
    std::optional<KeptBy> kept = {};
    double room_mm = std::numeric_limits<double>::infinity();
    std::optional<Need> need = {};
    double looked_mm = 0;     ///< so deep beside it bone was looked for below
    bool bends_seen = false;  ///< whether bends() has asked for the depth beside it
  };

  /// `near`: of the triangles, 1 where bone may have to go. `kept`: of the vertices.
  CutSurface(Body body, const std::vector<std::uint8_t>& near, std::vector<std::optional<KeptBy>> kept,
             std::optional<double> deepest_mm, double edge_mm);

  /// The inward directions: mean normals over about this length.
  void smooth_directions(double over_mm);
  /// Goes on from another surface some of whose edges were split: the inward directions are between those at their ends, so that no triangle is
  /// turned over as long as the whole one was not.
  void go_on_from(const CutSurface& whole, const std::vector<Between>& vertices);
  /// Where edges are to be split so that triangles can follow the bottom of a cut: near the bend of the depth along each, if a straight line
  /// between its ends misses the depth by more than this, or by more than half a per cent of the deepest place. Shares as of split_at(). Lowers the
  /// vertices.
  std::vector<double> bends(const std::vector<SweepTo>& sweeps, double missed_mm);
  /// Restores the surface.
  void restore();
  /// Lowers the vertices until the surface is clear of everything that the sweeps cover, and returns the remaining obstructions.
  std::vector<Obstruction> lower(const std::vector<SweepTo>& sweeps);
  /// Bone that still blocks, however far the surface is lowered: below triangles whose corners all have their largest depth.
  std::vector<Obstruction> left_at_room(const std::vector<SweepTo>& sweeps) const;
  /// Scales depths, and how deep vertices may go.
  void scale_depths(double by);
  /// Lowers a vertex to this depth, or as deep as it may go; never raises it.
  void lower_to(Index vertex, double depth_mm, const Need& need);
  /// Lowers what is higher around steep walls until no triangle is turned over; false if kept bone does not let it.
  bool unfold();
  SurfacePoint on_surface(const motion::Feature& feature, const Vec3& point) const;
  /// Where the point was before anything was lowered.
  Vec3 before(const SurfacePoint& point) const;
  enum class MayGo { some, kept, elsewhere };
  /// Whether something may be lowered there: a corner, or only what is beside it; or whether a corner is not near.
  MayGo may_go(const SurfacePoint& point) const;
  /// Why what is there stays.
  KeptBy kept_by(const SurfacePoint& point) const;
  /// Lowers obstructing bone, in each point to where it is clear and by this at least. If no corner may go, those beside them do, in the
  /// triangles that share one: these triangles obstruct, except where they come into the bearing ball.
  void lower_met(const std::vector<Met>& met, const std::vector<SweepTo>& sweeps, double by_mm);
  /// The triangles with a vertex that is elsewhere than before, or a corner of what met: no other one can meet if it did not.
  std::vector<Index> beside_changed(const std::vector<Vertex>& before, const std::vector<Met>& met) const;

  const Body& body() const noexcept { return body_; }
  const std::vector<Vertex>& vertices() const noexcept { return vertices_; }
  Vec3 at(Index vertex) const {
    return vertices_[vertex].before + vertices_[vertex].depth_mm * vertices_[vertex].inwards;
  }
  /// With its vertices where they are now.
  Mesh mesh() const;
  /// Triangles where bone may have to go, and all that have a corner of one of them: those that may have moved.
  const std::vector<Index>& near() const noexcept { return near_; }
  const std::vector<Index>& moving() const noexcept { return moving_; }

 private:
  struct Swept;
  class Deeper;
  void lower_vertices(const std::vector<Index>& which, const std::vector<SweepTo>& sweeps);
  void lower_overhangs(const std::vector<SweepTo>& sweeps);
  std::vector<Swept> swept_between(const std::vector<Index>& triangles, const std::vector<SweepTo>& sweeps,
                                   Deeper* deeper = nullptr) const;
  bool any_may_go(Index triangle) const;
  std::vector<Index> lower_between_vertices(const std::vector<Index>& triangles,
                                            const std::vector<SweepTo>& sweeps);
  std::vector<Obstruction> left_obstructions(const std::vector<Index>& triangles,
                                             const std::vector<SweepTo>& sweeps) const;
  Probe probe_below(const SurfacePoint& point) const;
  std::vector<Index> beside(const SurfacePoint& point) const;
  void take(Index vertex, double depth, const Need& need);
  bool may_go(Index vertex) const { return vertices_[vertex].depth_mm < vertices_[vertex].room_mm; }

  Body body_;
  double edge_mm_;
  std::vector<Vertex> vertices_;
  std::vector<Index> near_, near_vertices_, moving_;
};

}  // namespace condyle::plan
