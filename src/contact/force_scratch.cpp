#include "contact/force_scratch.hpp"

#include <algorithm>

#include "core/symmetric.hpp"

namespace condyle::contact {

void VertexLoads::clear(std::size_t vertices) {
  for (const Index v : loaded_) force_[v].setZero(), place_[v] = no_index;
  loaded_.clear();
  force_.resize(vertices, Vec3::Zero());
  place_.resize(vertices, no_index);
  couple_.setZero();
}

void VertexLoads::add(Index vertex, const Vec3& force) {
  if (place_[vertex] == no_index) {
    place_[vertex] = 0;
    loaded_.push_back(vertex);
  }
  force_[vertex] += force;
}

void VertexLoads::spread_couple(const Points& vertices) {
  if (couple_.isZero(0)) return;
  Vec3 middle = Vec3::Zero();
  for (const Index v : loaded_) middle += vertices[v] / static_cast<double>(loaded_.size());
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const Index v : loaded_) {
    const Vec3 arm = vertices[v] - middle;
    inertia += arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
  }
  const Vec3 turn = core::shortest_solved(inertia, couple_);
  for (const Index v : loaded_) force_[v] += turn.cross(Vec3(vertices[v] - middle));
}

const std::vector<Index>& VertexLoads::sorted() {
  std::sort(loaded_.begin(), loaded_.end());
  for (std::size_t i = 0; i < loaded_.size(); ++i) place_[loaded_[i]] = static_cast<Index>(i);
  return loaded_;
}

void VertexSets::clear(std::size_t vertices) {
  for (const Index v : added_) parent_[v] = number_[v] = no_index;
  added_.clear();
  // Meshes of two bodies take turns: what the larger one needs is kept.
  if (parent_.size() >= vertices) return;
  parent_.resize(vertices, no_index);
  number_.resize(vertices, no_index);
}

void VertexSets::add(Index vertex) {
  if (has(vertex)) return;
  parent_[vertex] = vertex;
  added_.push_back(vertex);
}

Index VertexSets::root(Index vertex) {
  while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
  return vertex;
}

void VertexSets::join(Index a, Index b) {
  add(a);
  add(b);
  parent_[root(b)] = root(a);
}

}  // namespace condyle::contact
