#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "condyle/normal_depth.hpp"
#include "contact/casting_rays.hpp"
#include "contact/points_inside.hpp"
#include "core/pool.hpp"
#include "mesh/ray_hits.hpp"

namespace condyle::contact {

/// A place of the casting surface in contact, and how much area it stands for: sums over samples are integrals over what
/// is in contact. In the frame of the casting body.
struct OverlapSample {
  Index face;
  double area;
  double depth;
  Vec3 point;                                  ///< on the casting surface
  Vec3 gradient;                               ///< of the depth when the target is translated
  double casting_thickness, target_thickness;  ///< where asked for, else 0
  std::array<double, 3> at;                    ///< the point, in shares of the face's corners
  /// The target's triangle that the sample's own ray ends on; none if the depth is linear between the rays of the corners.
  Index triangle = no_index;
  Index run_on = no_index;  ///< in Results::run_on, at a rim that cuts the face
};

/// Which rays give the depth of a sample at a rim, where a corner's ray is taken to run on: row k is of the ray of corner k, and
/// has the place that it is taken at, in shares of the face's corners, times what it counts for.
using RunOn = std::array<std::array<double, 3>, 3>;

/// A corner of the part of a face in contact: it stands for no area, and may be where depth or pressure is largest. Where
/// thicknesses are not asked for, the deepest of a face.
struct OverlapCorner {
  Index face;
  double depth;
  double casting_thickness, target_thickness;  ///< where asked for, else 0
};

/// A place of the line along which the part of a face in contact ends because the target does, not because the depth is 0 there: it
/// stands for a piece of that line.
struct OverlapBorder {
  Index face;
  double depth;
  Vec3 point;  ///< on the casting surface
  /// Growth of the area in contact: when the target is translated, mm^2 per mm, and turned about the casting body's
  /// origin, mm^2 per rad.
  Vec3 growth, growth_turned;
  double casting_thickness, target_thickness;  ///< where asked for, else 0
};

/// One thickness for each vertex of a mesh; empty: not asked for.
struct LayerThicknesses {
  std::span<const double> casting, target;
};

/// How exactly samples integrate over a part of a face: products of depth and place, or smooth functions of both.
enum class Quadrature { of_degree_2, of_degree_5 };

/// Rays from a casting surface, made ready; asked at a pose it gives samples in the order of casting faces.
class OverlapSampler {
 public:
  OverlapSampler(Mesh casting, Mesh target, NormalDepthOptions options);

  /// A surface has deformed: the mesh now, moved from the one before, and a mark for each vertex that says whether it has moved;
  /// without marks, all have. Samples are those of a sampler made anew, to the bit.
  void update_casting(const Mesh& casting, std::span<const char> is_moved = {});
  void update_target(const Mesh& target, std::span<const char> is_moved = {});

  /// End of a ray: the depth is below 0 if a ray outwards met the target.
  struct RayEnd {
    double depth;
    Index triangle;
    Vec3 gradient;  ///< of the depth when the target is translated, in the casting body's frame
  };
  /// The ends of those rays inwards that have one.
  class RayEnds {
   public:
    void clear(std::size_t rays) { of_ray_.assign(rays, no_index), ends_.clear(); }
    void set(Index ray, const RayEnd& end) {
      of_ray_[ray] = static_cast<Index>(ends_.size());
      ends_.push_back(end);
    }
    std::size_t rays() const noexcept { return of_ray_.size(); }
    bool has(Index ray) const noexcept { return of_ray_[ray] != no_index; }
    const RayEnd& operator[](Index ray) const noexcept { return ends_[of_ray_[ray]]; }

   private:
    std::vector<Index> of_ray_;
    std::vector<RayEnd> ends_;
  };

  struct Results {
    std::vector<OverlapSample> samples;
    std::vector<OverlapCorner> corners;
    std::vector<OverlapBorder> borders;
    std::size_t met_from_front = 0, rim_faces = 0;
    double oblique_area = 0;  ///< whose rays meet the target too far off its normal to have a depth
    std::vector<Index>
        oblique_faces;     ///< with face centres, which count all the same: those faces, ascending
    std::size_t rays = 0;  ///< cast
    RayEnds ends;          ///< of sample(): where rays inwards, and outwards beside them, end
    std::vector<RunOn> run_on;
  };
  void sample(const Pose& X_CT, Quadrature quadrature, const LayerThicknesses& thicknesses,
              Results& out) const;
  /// With cut faces: samples of each face that has a corner in contact at the centres of 16 parts, in place of depths that are linear
  /// from corner to corner. No corners and no borders.
  void sample_by_parts(const Pose& X_CT, const LayerThicknesses& thicknesses, Results& out) const;
  std::size_t cut_off_by_reach(const Pose& X_CT) const;

  /// A place of the target that gives a sample its depth: a ray through the sample, or one of those that its depth is linear between.
  struct SampleEnd {
    Index triangle;
    double weight;                ///< of its depth in the sample's
    Vec3 met;                     ///< in the plane of the triangle, in the casting body's frame
    Vec3 gradient;                ///< of its depth when the target is translated
    std::array<double, 3> start;  ///< where its ray starts, in shares of the face's corners
  };
  /// Three at most. Their weights add up to 1.
  class SampleEnds {
   public:
    void add(const SampleEnd& end) { ends_[count_++] = end; }
    const SampleEnd* begin() const noexcept { return ends_.data(); }
    const SampleEnd* end() const noexcept { return ends_.data() + count_; }

   private:
    std::array<SampleEnd, 3> ends_;
    std::size_t count_ = 0;
  };
  /// The ray ends that determine the depth of a sample from sample().
  SampleEnds ends_of(const OverlapSample& sample, const Results& found) const;

  /// Memory for samples, kept between queries.
  core::Pool<Results>& found_pool() const noexcept { return found_; }

  const Mesh& casting() const noexcept { return casting_; }
  const Mesh& target() const noexcept { return target_; }
  const NormalDepthOptions& options() const noexcept { return options_; }
  /// Outward, of length 1; zero of a face without area.
  std::span<const Vec3> face_normals() const noexcept { return rays_.face_normals(); }

 private:
  /// UsageError if an update ended halfway. Each query and update begins with it.
  void require_whole() const;
  double nearest_of_target() const;
  Points ray_origins() const;

  /// Where an edge of a face leaves the target.
  struct Crossing {
    double share;    ///< of the edge, from the corner inside
    Index triangle;  ///< of the target
  };
  /// A face at the rim. Edges are numbered by the corner that they start from.
  struct RimFace {
    Index face;
    std::array<std::optional<Crossing>, 3> crossings{};
    bool by_parts = false;
    Index first_part = no_index;  ///< the ray of its first part, where parts decide
  };
  struct Scratch {
    mesh::RayHits hits;
    RayEnds ends;
    radial::Penetrations inside;  ///< the origins in the target
    std::vector<char> outwards;   ///< per ray inwards: whether its other direction is cast too
    std::vector<char> oblique;  ///< per ray inwards: whether it meets the target, and too far off its normal
    std::vector<mesh::Ray> rays;
    std::vector<Index> owner;
    std::vector<Index> active;  ///< faces, in their order
    std::vector<RimFace> rim;   ///< those of them at the rim, in their order
  };

  static void clear(Results& out);
  /// Every ray inwards that can be in contact: its end.
  void cast_inwards(const Pose& X_CT, Scratch& scratch, Results& out) const;
  /// Where a ray inwards ends; whether it met the target from its front, which counts of an open target; and whether it met it too
  /// far off its normal for a depth.
  struct Overlap {
    RayEnd end;
    bool met_from_front, oblique;
  };
  std::optional<Overlap> overlap_of(const Vec3& direction_C, const mesh::RayHits& hits, std::size_t ray,
                                    const Pose& X_CT) const;
  double target_thickness(const RayEnd& end, const Vec3& origin_C, const Vec3& direction_C, const Pose& X_TC,
                          std::span<const double> of_vertices) const;

  void sample_centres(const Pose& X_CT, const LayerThicknesses& thicknesses, Scratch& scratch,
                      Results& out) const;
  void sample_faces(const Pose& X_CT, Quadrature quadrature, const LayerThicknesses& thicknesses,
                    Scratch& scratch, Results& out) const;
  /// Rays outwards from corners outside the target next to one inside it: how far outside.
  void cast_outwards(const Pose& X_CT, Scratch& scratch, Results& out) const;
  static bool is_inside(const RayEnds& ends, Index ray) { return ends.has(ray) && ends[ray].depth > 0; }
  /// Whether the depth is taken to be linear from one end to the other.
  bool runs_on(Index face, const RayEnds& ends, Index a, Index b) const;
  bool is_rim(Index face, const RayEnds& ends) const;
  /// An edge with one corner inside the target, by the corner it starts from: its two corners.
  struct LeavingEdge {
    std::size_t in, out;
  };
  std::optional<LeavingEdge> leaving_edge(Index face, std::size_t edge, const RayEnds& ends) const;
  Vec3 casting_corner(Index face, std::size_t k) const {
    return casting_.vertices()[casting_.triangles()[face][k]];
  }
  /// Whether no line is known that cuts a face at the rim.
  bool is_decided_by_parts(Index face, const Scratch& scratch) const;
  /// How many of a face's corners have rays that meet the target too far off its normal.
  int oblique_corners(Index face, const Scratch& scratch) const;
  /// Rays from corners inside the target along edges of rim faces that leave it other than where the depth is 0.
  void cast_along_edges(const Pose& X_CT, Scratch& scratch, Results& out) const;
  /// Rays from the parts of the rim faces that no line cuts.
  void cast_parts(const Pose& X_CT, Scratch& scratch, Results& out) const;
  /// Corner of a face's part in contact, a triangle or the part that a line leaves of one.
  struct PartCorner;
  class Part;
  Part part_of(Index face, const RimFace* rim, const LayerThicknesses& thicknesses, const Pose& X_TC,
               const RayEnds& ends) const;
  void sample_part(Index face, const Part& part, Quadrature quadrature, bool with_thickness,
                   Results& out) const;
  void sample_border(const RimFace& rim, const Part& part, const Pose& X_CT, const RayEnds& ends,
                     Results& out) const;
  void sample_parts_of(const RimFace& rim, const LayerThicknesses& thicknesses, const Pose& X_CT,
                       const Pose& X_TC, const Scratch& scratch, Results& out) const;

  Mesh casting_, target_;
  NormalDepthOptions options_;
  bool target_is_closed_;
  mesh::RayTarget ray_target_;
  std::vector<Vec3> target_normal_;  ///< per triangle, length 1
  CastingRays rays_;
  std::optional<PointsInside> origins_inside_;
  bool is_whole_ = true;  ///< false during an update, and for good once memory runs out in one
  mutable core::Pool<Scratch> scratch_;
  mutable core::Pool<Results> found_;
};

/// MPa, of the samples and of the corners.
struct OverlapPressures {
  std::span<const double> of_samples, of_corners;
};
/// Sums of the samples, face by face and in all; without pressures of depths only.
void add_up(const OverlapSampler& sampler, const OverlapSampler::Results& found,
            const std::optional<OverlapPressures>& pressures, SurfaceContact& out);

/// From each vertex along its negative normal to the other surface; NaN if there is none within the reach.
std::vector<double> distances_along_normals(const Mesh& from, const Mesh& to, double reach);

}  // namespace condyle::contact
