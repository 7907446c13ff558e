#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <memory>

#include "condyle/mesh.hpp"

namespace bench {

/// Whether the first crossing of a ray leaves the solid: the ray then started inside.
inline bool leaves(float normal_x, float normal_y, float normal_z, float x, float y, float z) noexcept {
  return normal_x * x + normal_y * y + normal_z * z > 0;
}

enum class RayRounding {
  robust,  ///< watertight along edges: no ray slips between neighbours
  fast,
};

/// A closed mesh as Embree 3.13 keeps it: single precision, one device thread.
///
/// Made as a static scene at medium quality, Embree's default, which traces fastest. The first deformation
/// makes it again as a dynamic scene whose tree is refitted from then on: Embree refits in no other kind, and
/// pays for it with a second level that each ray goes through.
class EmbreeScene {
 public:
  EmbreeScene(const condyle::TriMesh& mesh, RayRounding rounding);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  void deform(condyle::PointsView vertices);

  RTCScene get() const noexcept { return scene_; }
  bool centre_is_inside() const noexcept { return centre_is_inside_; }
  /// Memory that Embree has allocated, its copy of the mesh included.
  std::size_t bytes() const noexcept { return static_cast<std::size_t>(bytes_); }

 private:
  void make(RTCBuildQuality scene_quality, RTCBuildQuality quality);
  void place(condyle::PointsView vertices);
  void commit();
  static bool count_bytes(void* scene, ssize_t bytes, bool post) noexcept;

  std::vector<condyle::Triangle> triangles_;
  RTCSceneFlags rounding_;
  std::atomic<ssize_t> bytes_ = 0;
  RTCDevice device_;
  RTCScene scene_ = nullptr;
  RTCGeometry geometry_ = nullptr;
  std::size_t vertex_count_;
  bool is_dynamic_ = false;
  bool centre_is_inside_ = false;
};

/// Denormals count as zero while this lives, as Embree asks; exact arithmetic elsewhere must not see it.
class FlushDenormals {
 public:
  FlushDenormals() noexcept;
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned before_;
};

}  // namespace bench
