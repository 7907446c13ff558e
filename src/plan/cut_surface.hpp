#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "condyle/joint.hpp"
#include "condyle/resection.hpp"
#include "plan/refine.hpp"
#include "plan/sweep.hpp"

namespace condyle::plan {

/// A motion and how far it shall go.
struct SweepTo {
  const Sweep* sweep;
  Angle reach;
};

/// Which target needs a piece of bone, and from which angle of its motion on.
struct Need {
  std::size_t target = 0;
  double from_rad = std::numeric_limits<double>::infinity();
};

/// A place that stays in the way of a target.
struct InTheWay {
  std::size_t target;
  double from_rad;  ///< where its motion is stopped
  KeptBy by;
  Vec3 point;  ///< of the surface before, in the cut bone's frame
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

  /// The ways inwards: mean normals over about this length.
  void smooth_directions(double over_mm);
  /// Goes on from another surface some of whose edges were split: the ways inwards are between those at their ends, so that no triangle is
  /// turned over as long as the whole one was not.
  void go_on_from(const CutSurface& whole, const std::vector<Between>& vertices);
  /// Where edges are to be split so that triangles can follow the bottom of a cut: near the bend of the depth along each, if a straight line
  /// between its ends misses the depth by more than this. Shares as of split_at(). Lowers the vertices.
  std::vector<double> bends(const std::vector<SweepTo>& sweeps, double missed_mm);
  /// Back to where it was.
  void restore();
  /// Lowers the vertices until the surface is clear of everything that the sweeps cover, and says what stays in the way.
  std::vector<InTheWay> lower(const std::vector<SweepTo>& sweeps);
  /// Depths, and how deep vertices may go.
  void scale_depths(double by);
  /// A vertex so deep, or as deep as it may go; never higher than it is.
  void lower_to(Index vertex, double depth_mm, const Need& need);
  /// Lowers what is higher around steep walls until no triangle is turned over; false if kept bone does not let it.
  bool unfold();
  enum class Lowered { some, kept, elsewhere };
  /// Lowers the corners of a feature of this mesh by a little: those that may be, if some may, and are near. If none may, those beside
  /// them, in the triangles that share one: it is these triangles that are in the way, and where they come into the bearing ball they
  /// are not.
  Lowered lower_feature(const Feature& feature, const Need& need, double by_mm);

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
  struct Probe;
  struct Stretch;
  std::vector<Stretch> stretches(const std::vector<Probe>& probes, const std::vector<SweepTo>& sweeps) const;
  std::vector<double> depths(const std::vector<Probe>& probes, const std::vector<SweepTo>& sweeps) const;
  void lower_vertices(const std::vector<Index>& which, const std::vector<SweepTo>& sweeps);
  void lower_overhangs(const std::vector<SweepTo>& sweeps);
  struct LatticeStretch;
  std::vector<LatticeStretch> stretches_between(const std::vector<Index>& triangles,
                                                const std::vector<SweepTo>& sweeps) const;
  std::vector<Index> lower_between_vertices(const std::vector<Index>& triangles,
                                            const std::vector<SweepTo>& sweeps);
  std::vector<InTheWay> left_in_the_way(const std::vector<SweepTo>& sweeps) const;
  void take(Index vertex, double depth, const Need& need);

  Body body_;
  double edge_mm_;
  std::vector<Vertex> vertices_;
  std::vector<Index> near_, near_vertices_, moving_;
};

}  // namespace condyle::plan
