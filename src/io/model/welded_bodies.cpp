#include "io/model/welded_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/error.hpp"
#include "io/file/in_quotes.hpp"

namespace condyle::io {
namespace {

/// Relative: welds in a circle come back to where they began but for rounding.
constexpr double same_place = 1e-9;

const std::string& body_of(const ModelJoint& joint, BodyRole role) {
  return role == BodyRole::fixed ? joint.parent_body : joint.child_body;
}

template <class Value>
const std::vector<Value>& all_of(const std::map<std::string_view, std::vector<Value>>& by_body,
                                 std::string_view body) {
  static const std::vector<Value> none;
  const auto found = by_body.find(body);
  return found == by_body.end() ? none : found->second;
}

}  // namespace

WeldedBodies::WeldedBodies(const Model& model) : model_(model) {
  for (const ModelJoint& joint : model.joints) {
    if (joint.type != "WeldJoint") continue;
    welds_[joint.parent_body].push_back(&joint);
    if (joint.child_body != joint.parent_body) welds_[joint.child_body].push_back(&joint);
  }
  for (const ModelMesh& mesh : model.meshes) meshes_[mesh.body].push_back(&mesh);
  find_groups();
}

void WeldedBodies::find_groups() {
  for (const ModelJoint& joint : model_.joints)
    for (const std::string_view first :
         {std::string_view(joint.parent_body), std::string_view(joint.child_body)}) {
      const std::size_t number = group_size_.size();
      if (!group_.emplace(first, number).second) continue;
      std::vector<std::string_view> bodies{first};
      std::size_t size = 0;
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        const auto& welds = all_of(welds_, bodies[i]);
        size += 1 + welds.size() + all_of(meshes_, bodies[i]).size();
        for (const ModelJoint* weld : welds)
          for (const std::string_view body :
               {std::string_view(weld->parent_body), std::string_view(weld->child_body)})
            if (group_.emplace(body, number).second) bodies.push_back(body);
      }
      group_size_.push_back(size);
    }
}

WeldedBodies::Group WeldedBodies::group_of(const ModelJoint& joint, BodyRole role) const {
  const std::size_t number = group_.at(body_of(joint, role));
  return {number, group_size_[number]};
}

std::vector<WeldedBody> WeldedBodies::of(const ModelJoint& joint, BodyRole role) const {
  std::vector<WeldedBody> bodies{{body_of(joint, role)}};
  std::map<std::string_view, Pose> places{{body_of(joint, role), Pose::Identity()}};
  const auto add = [&](const ModelJoint& weld, const std::string& body, const Pose& X) {
    const auto [known, is_new] = places.emplace(body, X);
    if (is_new)
      bodies.push_back({body, X});
    else if (!known->second.isApprox(X, same_place))
      throw FileError(fmt::format("{}: line {}: joint {}: welds body {} where other welds do not have it",
                                  model_.path.string(), weld.line, in_quotes(weld.name), in_quotes(body)));
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const WeldedBody body = bodies[i];
    for (const ModelJoint* weld : all_of(welds_, body.name)) {
      if (weld->line == joint.line && weld->name == joint.name) continue;
      const Pose X_parent_child = pose_of(*weld, {});
      if (weld->parent_body == body.name) add(*weld, weld->child_body, body.X * X_parent_child);
      if (weld->child_body == body.name) add(*weld, weld->parent_body, body.X * inverted(X_parent_child));
    }
  }
  return bodies;
}

std::vector<ModelMesh> WeldedBodies::meshes_of(const ModelJoint& joint, BodyRole role) const {
  std::vector<ModelMesh> meshes;
  for (const WeldedBody& body : of(joint, role)) {
    for (const ModelMesh* of_body : all_of(meshes_, body.name)) {
      if (!of_body->why_not.empty()) throw FileError(of_body->why_not);
      meshes.push_back(*of_body);
      meshes.back().X_BG = body.X * of_body->X_BG;
    }
  }
  return meshes;
}

std::vector<ModelMesh> meshes_of(const Model& model, const ModelJoint& joint, BodyRole role) {
  return WeldedBodies(model).meshes_of(joint, role);
}

}  // namespace condyle::io
