#include "boundary.hpp"

#include <array>
#include <cmath>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "condyle/version.hpp"

namespace condyle::c {
namespace {

/// In place, so that an error can be reported when there is no memory left.
thread_local std::array<char, 1024> last_error = {};

condyle_status failed(condyle_status status, const char* text) noexcept {
  const std::size_t length = std::min(std::char_traits<char>::length(text), last_error.size() - 1);
  std::copy_n(text, length, last_error.data());
  last_error[length] = '\0';
  return status;
}

/// Rotations written with six decimals pass, as they do in joint files.
constexpr double rotation_tolerance = 1e-6;

/// Vertices and triangles have numbers of 32 bits, of which one is needed elsewhere.
constexpr std::size_t most_counted = std::size_t{1} << 31;

}  // namespace

condyle_status status_of_exception() noexcept {
  try {
    throw;
  } catch (const UsageError& error) {
    return failed(CONDYLE_BAD_ARGUMENT, error.what());
  } catch (const MeshError& error) {
    return failed(CONDYLE_BAD_MESH, error.what());
  } catch (const std::bad_alloc&) {
    return failed(CONDYLE_OUT_OF_MEMORY, "out of memory");
  } catch (const std::length_error&) {
    return failed(CONDYLE_OUT_OF_MEMORY, "out of memory: more elements than an array can have");
  } catch (const std::exception& error) {
    return failed(CONDYLE_INTERNAL_ERROR, error.what());
  } catch (...) {
    return failed(CONDYLE_INTERNAL_ERROR, "an unknown exception");
  }
}

void require(const void* argument, const char* name) {
  if (!argument) throw UsageError(std::string(name) + " is a null pointer");
}

Pose pose_of(const condyle_pose* pose, const char* name) {
  const auto& [rotation, translation_mm] = required(pose, name);
  Pose X = Pose::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) X.matrix()(i, k) = rotation[3 * i + k];
    X.matrix()(i, 3) = translation_mm[i];
  }
  const auto fail = [&](const std::string& what) { throw UsageError(std::string(name) + ": " + what); };
  for (int i = 0; i < 9; ++i)
    if (!std::isfinite(rotation[i])) fail("rotation[" + std::to_string(i) + "] is not finite");
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(translation_mm[i])) fail("translation_mm[" + std::to_string(i) + "] is not finite");
  const Eigen::Matrix3d R = X.linear();
  const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= rotation_tolerance))
    fail("the rotation is not orthonormal, but off by " + std::to_string(off));
  if (R.determinant() < 0) fail("a reflection is no pose");
  return X;
}

BodyRole role_of(condyle_body body) {
  if (body != CONDYLE_FIXED && body != CONDYLE_MOBILE)
    throw UsageError("body: there is no value " + std::to_string(body));
  return body == CONDYLE_FIXED ? BodyRole::fixed : BodyRole::mobile;
}

void check_countable(std::size_t count) {
  if (count > most_counted) throw std::length_error("more than can be numbered");
}

Points points_of(const double* xyz_mm, std::size_t count, const char* name) {
  if (count > 0) require(xyz_mm, name);
  Points points(count);
  for (std::size_t i = 0; i < count; ++i)
    points.set(i, {xyz_mm[3 * i], xyz_mm[3 * i + 1], xyz_mm[3 * i + 2]});
  return points;
}

Points all_points_of(const Mesh& body, const double* xyz_mm, std::size_t count) {
  if (count > 0) require(xyz_mm, "xyz_mm");
  if (const std::size_t vertices = body.vertices().size(); count != vertices)
    throw UsageError("an update of " + std::to_string(vertices) + " vertices gives " + std::to_string(count));
  return points_of(xyz_mm, count, "xyz_mm");
}

SomePoints some_points_of(const Mesh& body, const std::uint32_t* vertices, std::size_t count,
                          const double* xyz_mm) {
  if (count > 0) require(vertices, "vertices");
  if (count > 0) require(xyz_mm, "xyz_mm");
  if (const std::size_t all = body.vertices().size(); count > all)
    throw UsageError("an update moves " + std::to_string(count) + " vertices of " + std::to_string(all));
  return {{vertices, count}, points_of(xyz_mm, count, "xyz_mm")};
}

Vec3 vector_of(const double* xyz, const char* name) {
  require(xyz, name);
  return {xyz[0], xyz[1], xyz[2]};
}

}  // namespace condyle::c

using namespace condyle;

const char* condyle_last_error() {
  return c::last_error.data();
}

const char* condyle_version() {
  return version.data();
}

condyle_status condyle_mesh_create(const double* xyz_mm, size_t vertex_count, const uint32_t* triangles,
                                   size_t triangle_count, condyle_mesh** mesh) {
  return c::guarded([&] {
    condyle_mesh*& out = c::required(mesh, "mesh");
    c::check_countable(vertex_count);
    c::check_countable(triangle_count);
    TriMesh arrays{c::points_of(xyz_mm, vertex_count, "xyz_mm"), {}};
    if (triangle_count > 0) c::require(triangles, "triangles");
    arrays.triangles.resize(triangle_count);
    for (std::size_t t = 0; t < triangle_count; ++t)
      std::copy_n(triangles + 3 * t, 3, arrays.triangles[t].begin());
    out = new condyle_mesh{Mesh(std::move(arrays))};
  });
}

void condyle_mesh_destroy(condyle_mesh* mesh) {
  delete mesh;
}

size_t condyle_mesh_vertex_count(const condyle_mesh* mesh) {
  return mesh ? mesh->mesh.vertices().size() : 0;
}

size_t condyle_mesh_triangle_count(const condyle_mesh* mesh) {
  return mesh ? mesh->mesh.triangles().size() : 0;
}

int condyle_mesh_is_closed(const condyle_mesh* mesh) {
  return mesh && mesh->mesh.is_closed();
}
