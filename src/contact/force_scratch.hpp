#pragma once

#include <cstdint>
#include <vector>

#include "condyle/pose.hpp"

namespace condyle::contact {

/// Forces on the vertices of one body, added up in any order.
class VertexLoads {
 public:
  void clear(std::size_t vertices);
  void add(Index vertex, const Vec3& force);
  /// Couples that no triangle can take are spread over all vertices loaded.
  void add_couple(const Vec3& moment) { couple_ += moment; }
  void spread_couple(const Points& vertices);
  /// Ascending; each then has its place.
  const std::vector<Index>& sorted();

  const Vec3& force(Index vertex) const noexcept { return force_[vertex]; }
  Index place(Index vertex) const noexcept { return place_[vertex]; }

 private:
  std::vector<Vec3> force_;
  std::vector<Index> place_;  ///< no_index of those not loaded
  std::vector<Index> loaded_;
  Vec3 couple_ = Vec3::Zero();
};

/// Sets of vertices joined by faces.
class VertexSets {
 public:
  void clear(std::size_t vertices);
  void join(Index a, Index b);
  Index root(Index vertex);
  Index& number(Index root) noexcept { return number_[root]; }
  bool has(Index vertex) const noexcept { return parent_[vertex] != no_index; }

 private:
  void add(Index vertex);

  std::vector<Index> parent_, number_;  ///< no_index of vertices in no set
  std::vector<Index> added_;
};

/// A block of the stiffness of vertices, before those of one row and column are added up.
struct StiffnessTerm {
  std::uint64_t key;  ///< row and column: vertices of the fixed body, after them those of the mobile one
  std::size_t block;
};

/// How the pressure of a sample depends on a vertex, and acts on it; in the frame of the vertex's body.
struct SampleVertex {
  std::size_t local;
  Vec3 force;   ///< of a pressure that presses with 1 N
  Vec3 growth;  ///< of the depth when the vertex is moved
};

struct ForceScratch {
  VertexLoads on_fixed, on_mobile;
  VertexSets sets;
  std::vector<StiffnessTerm> terms;
  std::vector<Eigen::Matrix3d> blocks;
  // These are filled for one face at a time.
  std::vector<std::uint64_t> face_vertices;
  std::vector<SampleVertex> sample_vertices;
  std::vector<std::size_t> sample_begin;
  std::vector<double> sample_slope;
};

}  // namespace condyle::contact
