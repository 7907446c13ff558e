#include "embree_scene.hpp"

#include <immintrin.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace bench {
namespace {

constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;

}  // namespace

EmbreeScene::EmbreeScene(const condyle::TriMesh& mesh, RayRounding rounding)
    : triangles_(mesh.triangles),
      rounding_(rounding == RayRounding::robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE),
      device_(rtcNewDevice("threads=1")),
      vertex_count_(mesh.vertices.size()) {
  if (device_ == nullptr) throw std::runtime_error("Embree gives no device");
  rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, this);
  make(RTC_BUILD_QUALITY_MEDIUM, RTC_BUILD_QUALITY_MEDIUM);
  place(mesh.vertices.view());
  commit();
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseGeometry(geometry_);
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void EmbreeScene::deform(condyle::PointsView vertices) {
  if (!is_dynamic_) {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
    make(RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_REFIT);
    is_dynamic_ = true;
  }
  place(vertices);
  commit();
}

void EmbreeScene::make(RTCBuildQuality scene_quality, RTCBuildQuality quality) {
  scene_ = rtcNewScene(device_);
  const bool is_static = scene_quality == RTC_BUILD_QUALITY_MEDIUM;
  rtcSetSceneFlags(scene_, rounding_ | (is_static ? RTC_SCENE_FLAG_NONE : RTC_SCENE_FLAG_DYNAMIC));
  rtcSetSceneBuildQuality(scene_, scene_quality);
  geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry_, quality);
  rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                          vertex_count_);
  auto* corners = static_cast<condyle::Triangle*>(rtcSetNewGeometryBuffer(
      geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(condyle::Triangle), triangles_.size()));
  std::copy(triangles_.begin(), triangles_.end(), corners);
  rtcAttachGeometry(scene_, geometry_);
}

void EmbreeScene::place(condyle::PointsView vertices) {
  auto* out = static_cast<float*>(rtcGetGeometryBufferData(geometry_, RTC_BUFFER_TYPE_VERTEX, 0));
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    *out++ = static_cast<float>(vertices.x[v]);
    *out++ = static_cast<float>(vertices.y[v]);
    *out++ = static_cast<float>(vertices.z[v]);
  }
  rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
}

void EmbreeScene::commit() {
  const FlushDenormals flush;
  rtcCommitGeometry(geometry_);
  rtcCommitScene(scene_);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray{};
  ray.ray.dir_z = 1;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_, &context, &ray);
  centre_is_inside_ =
      ray.hit.geomID != RTC_INVALID_GEOMETRY_ID && leaves(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z, 0, 0, 1);
}

bool EmbreeScene::count_bytes(void* scene, ssize_t bytes, bool) noexcept {
  static_cast<EmbreeScene*>(scene)->bytes_ += bytes;
  return true;
}

FlushDenormals::FlushDenormals() noexcept : before_(_mm_getcsr()) {
  _mm_setcsr(before_ | flush_to_zero | denormals_are_zero);
}

FlushDenormals::~FlushDenormals() {
  _mm_setcsr(before_);
}

}  // namespace bench
