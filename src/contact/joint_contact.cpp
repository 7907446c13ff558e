#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "condyle/contact.hpp"
#include "condyle/error.hpp"
#include "contact/body_pair.hpp"
#include "contact/chosen_arcs.hpp"
#include "contact/moved_vertices.hpp"
#include "core/coordinate_range.hpp"
#include "core/lazy.hpp"
#include "core/turned.hpp"

namespace condyle::contact {
namespace {

bool any_not_outside(const std::vector<PointState>& states) {
  return std::any_of(states.begin(), states.end(),
                     [](PointState state) { return state != PointState::outside; });
}

template <class VertexResults>
bool any_contact(const ContactResults<VertexResults>& contact) {
  const auto& [mobile, fixed, pairs, in_contact] = contact;
  return !pairs.empty() || (mobile && any_not_outside(mobile->state)) ||
         (fixed && any_not_outside(fixed->state));
}

/// Ring tables of one body about the axes that were asked last.
class RingTables {
 public:
  void clear() {
    for (Kept& kept : kept_) kept.table.reset();
  }
  std::shared_ptr<const tangential::RingTable> about(const Mesh& mesh, const Vec3& point,
                                                     const Vec3& direction) {
    const std::scoped_lock lock(mutex_);
    const auto known = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
      return kept.table && kept.point == point && kept.direction == direction;
    });
    if (known != kept_.end()) {
      std::rotate(kept_.begin(), known, known + 1);
    } else {
      std::rotate(kept_.begin(), kept_.end() - 1, kept_.end());
      kept_.front() = {point, direction, nullptr};
      kept_.front().table = std::make_shared<const tangential::RingTable>(mesh, AxisFrame(point, direction));
    }
    return kept_.front().table;
  }

 private:
  struct Kept {
    Vec3 point = Vec3::Zero(), direction = Vec3::Zero();
    std::shared_ptr<const tangential::RingTable> table;
  };
  /// The three axes of a joint coordinate system and one more; a table has some 50 bytes for each triangle.
  static constexpr std::size_t most_axes = 4;

  std::mutex mutex_;
  std::array<Kept, most_axes> kept_;  ///< The latest first.
};

template <class Part>
void discard(core::Lazy<std::optional<Part>>& part) noexcept {
  if (std::optional<Part>* made = part.current()) made->reset();
  part.make_out_of_date();
}

/// For a part that is checked already, so that it cannot be refused: without memory it is made anew when it is next needed.
template <class Part, class Update>
void update_or_discard(core::Lazy<std::optional<Part>>& part, const Update& update) {
  std::optional<Part>* made = part.current();
  if (!made) return;
  try {
    update(**made);
  } catch (const std::bad_alloc&) {
    discard(part);
  }
}

/// One of the two bodies, and what is made of it when it is first needed.
class ContactBody {
 public:
  ContactBody(std::string role, Mesh mesh, const radial::RadialOptions& options)
      : role_(std::move(role)), mesh_(std::move(mesh)), options_(options) {}

  const Mesh& mesh() const noexcept { return mesh_; }

  /// A refused update leaves everything as it was: what may refuse comes first. A table or blocks that memory runs out for are
  /// half updated: they are made anew when they are next needed.
  void update(const MovedVertices& moved) {
    if (std::optional<radial::RadialTable>* table = table_.current()) {
      try {
        if (moved.are_all())
          (*table)->update(moved.positions);
        else
          (*table)->update(moved.some, moved.positions);
      } catch (const MeshError& error) {
        throw MeshError(role_ + ": " + error.what());
      } catch (const std::bad_alloc&) {
        discard(table_);
        throw;
      }
    }
    update_or_discard(sorted_vertices_, [&](radial::SortedPoints& points) {
      points.update(moved.mesh.vertices(), moved.is_moved);
    });
    ring_tables_.clear();
    mesh_ = moved.mesh;
  }
  /// The body as it is now, apart from this one: nothing is made of it yet.
  std::shared_ptr<ContactBody> with_mesh(const Mesh& mesh) const {
    return std::make_shared<ContactBody>(role_, mesh, options_);
  }

  const radial::RadialTable& table() const {
    return *table_.get([&](std::optional<radial::RadialTable>& table) {
      try {
        table.emplace(mesh_, options_);
      } catch (const MeshError& error) {
        throw MeshError(role_ + ": " + error.what());
      }
    });
  }
  const radial::SortedPoints& sorted_vertices() const {
    return *sorted_vertices_.get(
        [&](std::optional<radial::SortedPoints>& points) { points.emplace(mesh_.vertices()); });
  }
  std::shared_ptr<const tangential::RingTable> ring_table(const Vec3& point, const Vec3& direction) const {
    return ring_tables_.about(mesh_, point, direction);
  }

 private:
  std::string role_;
  Mesh mesh_;
  radial::RadialOptions options_;
  core::Lazy<std::optional<radial::RadialTable>> table_;
  core::Lazy<std::optional<radial::SortedPoints>> sorted_vertices_;
  mutable RingTables ring_tables_;
};

}  // namespace

struct JointContact::Parts {
  /// Joints that differ in the other body share it.
  std::shared_ptr<ContactBody> fixed, mobile;
  radial::RadialOptions options;
  core::Lazy<std::optional<BodyPair>> trees = {};

  const BodyPair& bodies() const {
    return *trees.get([&](std::optional<BodyPair>& pair) { pair.emplace(fixed->mesh(), mobile->mesh()); });
  }
  std::shared_ptr<const tangential::RingTable> fixed_rings(const AxisLine& axis) const {
    return fixed->ring_table(axis.point, axis.direction);
  }
  std::shared_ptr<const tangential::RingTable> mobile_rings(const Pose& X_MF, const AxisLine& axis) const {
    // To the bit, without the signs of zeros that products would add.
    const bool through_centre = axis.point == Vec3::Zero();
    return mobile->ring_table(through_centre ? Vec3(X_MF.translation()) : posed(X_MF, axis.point),
                              core::turned(X_MF, axis.direction));
  }
};

namespace {

std::shared_ptr<ContactBody> fixed_body(Mesh mesh, const radial::RadialOptions& options) {
  return std::make_shared<ContactBody>("fixed body", std::move(mesh), options);
}
std::shared_ptr<ContactBody> mobile_body(Mesh mesh, const radial::RadialOptions& options) {
  return std::make_shared<ContactBody>("mobile body", std::move(mesh), options);
}

}  // namespace

JointContact::JointContact(const Joint& joint, radial::RadialOptions options)
    : JointContact(joint.fixed.mesh, joint.mobile.mesh, options) {}
JointContact::JointContact(Mesh fixed, Mesh mobile, radial::RadialOptions options)
    : parts_(new Parts{fixed_body(std::move(fixed), options), mobile_body(std::move(mobile), options),
                       options}) {}
JointContact::JointContact(const JointContact& before, BodyRole changed, Mesh mesh) {
  const auto& [fixed, mobile, options, trees] = *before.parts_;
  parts_.reset(changed == BodyRole::fixed ? new Parts{fixed_body(std::move(mesh), options), mobile, options}
                                          : new Parts{fixed, mobile_body(std::move(mesh), options), options});
}
JointContact::~JointContact() = default;
JointContact::JointContact(JointContact&&) noexcept = default;
JointContact& JointContact::operator=(JointContact&&) noexcept = default;

void JointContact::update(BodyRole body, PointsView vertices) {
  const Mesh& mesh = body == BodyRole::fixed ? fixed() : mobile();
  update(body, moved_vertices(mesh, vertices));
}

void JointContact::update(BodyRole body, std::span<const Index> moved, PointsView positions) {
  const Mesh& mesh = body == BodyRole::fixed ? fixed() : mobile();
  update(body, moved_vertices(mesh, moved, positions));
}

void JointContact::update(BodyRole body, const MovedVertices& moved) {
  std::shared_ptr<ContactBody>& part = body == BodyRole::fixed ? parts_->fixed : parts_->mobile;
  if (part.use_count() > 1)
    part = part->with_mesh(moved.mesh);
  else
    part->update(moved);
  update_or_discard(parts_->trees, [&](BodyPair& pair) { pair.update(body, moved.mesh, moved.is_moved); });
}

const BodyPair& body_pair_of(const JointContact& joint) {
  return joint.parts_->bodies();
}

const Mesh& JointContact::fixed() const noexcept {
  return parts_->fixed->mesh();
}
const Mesh& JointContact::mobile() const noexcept {
  return parts_->mobile->mesh();
}
const radial::RadialTable& JointContact::fixed_table() const {
  return parts_->fixed->table();
}
const radial::RadialTable& JointContact::mobile_table() const {
  return parts_->mobile->table();
}

Contact JointContact::at(const Pose& X_FM) const {
  Contact contact;
  if (fixed().is_closed()) mobile_in_fixed(X_FM, contact.mobile_in_fixed.emplace());
  if (mobile().is_closed()) fixed_in_mobile(X_FM, contact.fixed_in_mobile.emplace());
  contact.pairs = pairs(X_FM);
  contact.in_contact = any_contact(contact);
  return contact;
}

void JointContact::mobile_in_fixed(const Pose& X_FM, radial::Penetrations& out) const {
  core::require_rotation(X_FM);
  parts_->fixed->table().penetrations(parts_->mobile->sorted_vertices(), X_FM, out);
}

void JointContact::fixed_in_mobile(const Pose& X_FM, radial::Penetrations& out) const {
  core::require_rotation(X_FM);
  parts_->mobile->table().penetrations(parts_->fixed->sorted_vertices(), inverted(X_FM), out);
}

RadialContact JointContact::radial(const Pose& X_FM) const {
  core::require_rotation(X_FM);
  RadialContact contact;
  if (fixed().is_closed()) contact.mobile_in_fixed = fixed_table().query(posed(X_FM, mobile().vertices()));
  if (mobile().is_closed())
    contact.fixed_in_mobile = mobile_table().query(posed(inverted(X_FM), fixed().vertices()));
  contact.pairs = pairs(X_FM);
  contact.in_contact = any_contact(contact);
  return contact;
}

TangentialContact JointContact::tangential(const Pose& X_FM, const Vec3& axis_F,
                                           tangential::TangentialRule rule) const {
  return tangential(X_FM, AxisLine{axis_F}, rule);
}

TangentialContact JointContact::tangential(const Pose& X_FM, const AxisLine& axis,
                                           tangential::TangentialRule rule) const {
  core::require_rotation(X_FM);
  TangentialContact contact;
  if (fixed().is_closed())
    contact.mobile_in_fixed = parts_->fixed_rings(axis)->query(posed(X_FM, mobile().vertices()), rule);
  if (mobile().is_closed()) {
    const Pose X_MF = inverted(X_FM);
    contact.fixed_in_mobile = parts_->mobile_rings(X_MF, axis)->query(posed(X_MF, fixed().vertices()), rule);
  }
  contact.pairs = pairs(X_FM);
  contact.in_contact = any_contact(contact);
  return contact;
}

ChosenArcs arcs_of(const JointContact& joint, const Pose& X_FM, const Vec3& axis_F,
                   const ChosenVertices& vertices) {
  core::require_rotation(X_FM);
  const auto chosen = [](const Mesh& mesh, const std::vector<Index>& of) {
    Points points;
    points.reserve(of.size());
    for (const Index v : of) points.push_back(mesh.vertices()[v]);
    return points;
  };
  ChosenArcs arcs;
  if (!vertices.mobile.empty())
    arcs.mobile =
        joint.parts_->fixed_rings({axis_F})->query(posed(X_FM, chosen(joint.mobile(), vertices.mobile)));
  if (!vertices.fixed.empty()) {
    const Pose X_MF = inverted(X_FM);
    arcs.fixed =
        joint.parts_->mobile_rings(X_MF, {axis_F})->query(posed(X_MF, chosen(joint.fixed(), vertices.fixed)));
  }
  return arcs;
}

std::vector<TrianglePair> JointContact::pairs(const Pose& X_FM) const {
  core::require_rotation(X_FM);
  return parts_->bodies().pairs(X_FM);
}

bool JointContact::in_contact(const Pose& X_FM) const {
  core::require_rotation(X_FM);
  return parts_->bodies().touch(X_FM);
}

}  // namespace condyle::contact
