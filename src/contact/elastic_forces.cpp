#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "condyle/error.hpp"
#include "condyle/pressure.hpp"
#include "contact/elastic_parts.hpp"
#include "core/coordinate_range.hpp"
#include "core/cross_matrix.hpp"
#include "core/trigonometry.hpp"

/// docs/contact.md.

namespace condyle::contact {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A triangle whose height over its longest edge is less than about a hundredth of that takes no couple about the edge: the forces
/// would be a hundred times those they turn, and rounded as much worse.
constexpr double narrow_triangle = 1e-4;

/// How a force of one sample is spread over the vertices of the target. It acts at the sample, off the triangle: shares of the
/// place where the ray ends give its sum, and a couple on the triangle the rest of its moment.
class TargetSpread {
 public:
  struct Corner {
    Index vertex;
    double share;
    Vec3 arm;  ///< from the middle of its triangle
    std::size_t end;
    Vec3 growth;  ///< of the depth when the vertex is moved
  };

  TargetSpread(const OverlapSampler::SampleEnds& ends, const Vec3& acting_C, const Mesh& target,
               const Pose& X_TC) {
    Vec3 middle_of_shares = Vec3::Zero();
    for (const OverlapSampler::SampleEnd& end : ends) {
      const auto& vertices = target.triangles()[end.triangle];
      const std::array<Vec3, 3> p{target.corner(end.triangle, 0), target.corner(end.triangle, 1),
                                  target.corner(end.triangle, 2)};
      const Vec3 met = X_TC * end.met, gradient = X_TC.linear() * end.gradient;
      const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]), middle = (p[0] + p[1] + p[2]) / 3;
      const double squared = normal.squaredNorm();
      std::array<double, 3> shares{1.0 / 3, 1.0 / 3, 1.0 / 3};
      if (squared > 0) {
        shares[1] = (met - p[0]).cross(p[2] - p[0]).dot(normal) / squared;
        shares[2] = (p[1] - p[0]).cross(met - p[0]).dot(normal) / squared;
        shares[0] = 1 - shares[1] - shares[2];
      }
      Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
      double size = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 arm = p[k] - middle;
        corners_[3 * ends_ + k] = {vertices[k], end.weight * shares[k], arm, ends_,
                                   end.weight * shares[k] * gradient};
        middle_of_shares += end.weight * shares[k] * p[k];
        size += arm.squaredNorm();
        inertia += arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
      }
      if (squared > narrow_triangle * size * size)
        turn_[ends_] = end.weight * inertia.inverse();
      else
        turn_[ends_].setZero(), narrow_ += end.weight;
      ++ends_;
    }
    arm_ = X_TC * acting_C - middle_of_shares;
  }

  std::span<const Corner> corners() const noexcept { return {corners_.data(), 3 * ends_}; }
  /// On a corner, of a force at the sample.
  Vec3 force(const Corner& corner, const Vec3& whole) const {
    return corner.share * whole + Vec3(turn_[corner.end] * arm_.cross(whole)).cross(corner.arm);
  }
  /// What triangles too narrow for a couple leave.
  Vec3 couple_left(const Vec3& whole) const { return narrow_ * arm_.cross(whole); }

 private:
  std::array<Corner, 9> corners_;
  std::array<Eigen::Matrix3d, 3> turn_;
  std::size_t ends_ = 0;
  double narrow_ = 0;
  Vec3 arm_;
};

/// The forces of one surface that is cast. `sense` is 1 of the fixed body and -1 of the mobile one; a pose brings what is in C
/// to F, another to the target's frame T. In C where nothing else is said.
class CastForces {
 public:
  CastForces(const ElasticCast& cast, const ElasticCast::Answer& answer, BodyRole casting, double share,
             const Pose& X_FM, const ForceOptions& options, ForceScratch& scratch)
      : cast_(cast),
        answer_(answer),
        casting_(casting),
        share_(share),
        options_(options),
        scratch_(scratch),
        X_FC_(casting == BodyRole::fixed ? Pose::Identity() : X_FM),
        X_TC_(casting == BodyRole::fixed ? inverted(X_FM) : X_FM),
        origin_M_(X_FM.translation()),
        sense_(casting == BodyRole::fixed ? 1 : -1),
        loads_(casting == BodyRole::fixed ? scratch.on_fixed : scratch.on_mobile),
        target_loads_(casting == BodyRole::fixed ? scratch.on_mobile : scratch.on_fixed) {
    const Eigen::Matrix3d to_C = X_FC_.linear().transpose();
    const RelativeMotion& motion = options.motion;
    turning_ = to_C * motion.angular_velocity_rad_s;
    sliding_ = to_C * (motion.velocity_mm_s +
                       motion.angular_velocity_rad_s.cross(Vec3(X_FC_.translation() - origin_M_)));
  }

  void add_to(ContactForces& out) {
    for (const OverlapCorner& corner : answer_.found.corners)
      out.max_strain = std::max(out.max_strain, cast_.answer_at(corner).strain);
    if (options_.patches) find_patches(out);
    const auto& samples = answer_.found.samples;
    for (std::size_t begin = 0, end = 0; begin < samples.size(); begin = end) {
      while (end < samples.size() && samples[end].face == samples[begin].face) ++end;
      if (options_.vertex_stiffness) begin_vertex_stiffness();
      for (std::size_t i = begin; i < end; ++i) add_sample(i, out);
      if (options_.vertex_stiffness) end_vertex_stiffness();
    }
    if (options_.patches) finish_patches(out);
    if (options_.stiffness) add_stiffness(out);
  }

 private:
  using Ends = OverlapSampler::SampleEnds;

  const Mesh& casting_mesh() const { return cast_.sampler().casting(); }
  const Mesh& target_mesh() const { return cast_.sampler().target(); }
  /// How fast the mobile body moves there relative to the fixed one.
  Vec3 velocity_at(const Vec3& point) const { return sliding_ + turning_.cross(point); }

  void add_sample(std::size_t i, ContactForces& out) {
    const OverlapSample& sample = answer_.found.samples[i];
    const LayerAnswer& layers = answer_.of_sample[i];
    const Vec3& normal = cast_.sampler().face_normals()[sample.face];
    const double area = options_.factor * share_ * sample.area;
    const double elastic = area * layers.pressure;
    out.energy_nmm += area * layers.energy;
    out.max_strain = std::max(out.max_strain, layers.strain);
    Ends ends;
    if (options_.damping_s_per_mm > 0 || options_.vertex_forces || options_.vertex_stiffness ||
        options_.stiffness)
      ends = cast_.sampler().ends_of(sample, answer_.found);

    double pressing = elastic;
    if (options_.damping_s_per_mm > 0) {
      double rate = 0;
      for (const auto& end : ends) rate += end.weight * sense_ * end.gradient.dot(velocity_at(end.met));
      pressing *= std::max(0.0, 1 + options_.damping_s_per_mm * rate);
      out.damping_power += (pressing - elastic) * rate;
    }
    Vec3 on_mobile = sense_ * pressing * normal;
    if (options_.friction > 0) {
      const Vec3 velocity = velocity_at(sample.point), sliding = velocity - velocity.dot(normal) * normal;
      const double slip = options_.slip_velocity_mm_s;
      const Vec3 friction = -options_.friction * pressing / core::hypotenuse(sliding.norm(), slip) * sliding;
      on_mobile += friction;
      out.friction_power -= friction.dot(sliding);
    }

    const Vec3 force = X_FC_.linear() * on_mobile, arm = X_FC_ * sample.point - origin_M_;
    const Vec3 moment = arm.cross(force);
    out.on_mobile_body.force_n += force;
    out.on_mobile_body.moment_nmm += moment;
    if (options_.patches) add_to_patch(i, pressing / share_, {force, moment}, out);
    if (options_.stiffness) add_change(sample, ends, area * layers.slope, elastic);
    if (!options_.vertex_forces && !options_.vertex_stiffness) return;

    const TargetSpread spread(ends, sample.point, target_mesh(), X_TC_);
    const auto& vertices = casting_mesh().triangles()[sample.face];
    for (std::size_t k = 0; k < 3; ++k) loads_.add(vertices[k], -sense_ * sample.at[k] * on_mobile);
    const Vec3 on_target = sense_ * (X_TC_.linear() * on_mobile);
    for (const auto& corner : spread.corners())
      target_loads_.add(corner.vertex, spread.force(corner, on_target));
    target_loads_.add_couple(spread.couple_left(on_target));
    if (options_.vertex_stiffness) add_vertex_stiffness(sample, ends, spread, area * layers.slope);
  }

  // Stiffness of the bodies: docs/contact.md. Changes are those of the load on the target when the target is moved, which is
  // that on the mobile body when the mobile body is.
  void add_change(const OverlapSample& sample, const Ends& ends, double slope, double elastic) {
    const Vec3& normal = cast_.sampler().face_normals()[sample.face];
    Vector6d load, growth = Vector6d::Zero();
    load << normal, sample.point.cross(normal);
    for (const auto& end : ends) {
      growth.head<3>() += end.weight * end.gradient;
      growth.tail<3>() += end.weight * end.met.cross(end.gradient);
    }
    change_ += slope * load * growth.transpose();
    const Vec3 force = sense_ * elastic * (X_FC_.linear() * normal);
    elastic_.head<3>() += force;
    elastic_.tail<3>() += (X_FC_ * sample.point - origin_M_).cross(force);
  }
  void add_stiffness(ContactForces& out) {
    for (std::size_t i = 0; i < answer_.found.borders.size(); ++i) {
      const OverlapBorder& border = answer_.found.borders[i];
      const Vec3& normal = cast_.sampler().face_normals()[border.face];
      Vector6d load, growth;
      load << normal, border.point.cross(normal);
      growth << border.growth, border.growth_turned;
      change_ += options_.factor * share_ * answer_.of_border[i] * load * growth.transpose();
    }
    Matrix6d to_F = Matrix6d::Zero();
    to_F.topLeftCorner<3, 3>() = to_F.bottomRightCorner<3, 3>() = X_FC_.linear();
    to_F.bottomLeftCorner<3, 3>() = core::cross_matrix(X_FC_.translation() - origin_M_) * X_FC_.linear();
    Matrix6d change = to_F * change_ * to_F.transpose();
    // Loads of the fixed body's faces stay where they are, and the origin of M leaves them; those of the mobile body's turn with it.
    if (casting_ == BodyRole::fixed) {
      change.bottomLeftCorner<3, 3>() += core::cross_matrix(elastic_.head<3>());
    } else {
      change.topRightCorner<3, 3>() -= core::cross_matrix(elastic_.head<3>());
      change.bottomRightCorner<3, 3>() -= core::cross_matrix(elastic_.tail<3>());
    }
    out.stiffness -= change;
  }

  // Stiffness of the vertices, face by face: the samples of a face have most vertices in common.
  void begin_vertex_stiffness() {
    scratch_.face_vertices.clear();
    scratch_.sample_vertices.clear();
    scratch_.sample_begin.assign(1, 0);
    scratch_.sample_slope.clear();
  }
  std::uint64_t numbered(Index vertex, bool is_of_casting) const {
    const bool is_mobile = is_of_casting == (casting_ == BodyRole::mobile);
    const Mesh& fixed = casting_ == BodyRole::fixed ? casting_mesh() : target_mesh();
    return std::uint64_t{vertex} + (is_mobile ? fixed.vertices().size() : 0);
  }
  std::size_t local(std::uint64_t vertex) {
    auto& of_face = scratch_.face_vertices;
    const auto at = std::find(of_face.begin(), of_face.end(), vertex);
    const auto place = static_cast<std::size_t>(at - of_face.begin());
    if (at == of_face.end()) of_face.push_back(vertex);
    return place;
  }
  void add_vertex_stiffness(const OverlapSample& sample, const Ends& ends, const TargetSpread& spread,
                            double slope) {
    const Vec3& normal = cast_.sampler().face_normals()[sample.face];
    const Vec3 normal_T = X_TC_.linear() * normal;
    const auto& vertices = casting_mesh().triangles()[sample.face];
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 growth = Vec3::Zero();
      for (const auto& end : ends) growth -= end.start[k] * end.gradient;
      scratch_.sample_vertices.push_back(
          {local(numbered(vertices[k], true)), -sample.at[k] * normal, growth});
    }
    for (const auto& corner : spread.corners())
      scratch_.sample_vertices.push_back(
          {local(numbered(corner.vertex, false)), spread.force(corner, normal_T), corner.growth});
    scratch_.sample_begin.push_back(scratch_.sample_vertices.size());
    scratch_.sample_slope.push_back(slope);
  }
  void end_vertex_stiffness() {
    const auto& vertices = scratch_.face_vertices;
    auto& blocks = scratch_.blocks;
    const std::size_t first = blocks.size(), count = vertices.size();
    blocks.resize(first + count * count, Eigen::Matrix3d::Zero());
    for (std::size_t s = 0; s < scratch_.sample_slope.size(); ++s)
      for (std::size_t a = scratch_.sample_begin[s]; a < scratch_.sample_begin[s + 1]; ++a)
        for (std::size_t b = scratch_.sample_begin[s]; b < scratch_.sample_begin[s + 1]; ++b) {
          const SampleVertex &row = scratch_.sample_vertices[a], &column = scratch_.sample_vertices[b];
          blocks[first + row.local * count + column.local] -=
              scratch_.sample_slope[s] * row.force * column.growth.transpose();
        }
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < count; ++b)
        scratch_.terms.push_back({vertices[a] << 32 | vertices[b], first + a * count + b});
  }

  // Patches. A face whose part in contact is no more than rounding is none of a patch.
  void for_each_face_in_contact(const auto& take) const {
    const auto& samples = answer_.found.samples;
    for (std::size_t begin = 0, end = 0; begin < samples.size(); begin = end) {
      double overlap = 0;
      for (; end < samples.size() && samples[end].face == samples[begin].face; ++end)
        overlap += samples[end].area * samples[end].depth;
      if (overlap > 0) take(samples[begin].face);
    }
  }
  Index patch_of(Index face) {
    return scratch_.sets.number(scratch_.sets.root(casting_mesh().triangles()[face][0]));
  }
  void find_patches(ContactForces& out) {
    VertexSets& sets = scratch_.sets;
    const std::size_t first_face = out.patch_faces.size();
    first_patch_ = out.patches.size();
    sets.clear(casting_mesh().vertices().size());
    for_each_face_in_contact([&](Index face) {
      const auto& [a, b, c] = casting_mesh().triangles()[face];
      sets.join(a, b);
      sets.join(a, c);
    });
    std::size_t faces = 0;
    for_each_face_in_contact([&](Index face) {
      Index& number = sets.number(sets.root(casting_mesh().triangles()[face][0]));
      if (number == no_index) {
        number = static_cast<Index>(out.patches.size());
        out.patches.push_back({casting_, 0, 0, 0, 0, 0, {}});
      }
      ++out.patches[number].faces, ++faces;
    });
    out.patch_faces.resize(first_face + faces);
    std::size_t next = first_face;
    for (std::size_t p = first_patch_; p < out.patches.size(); ++p) {
      out.patches[p].first_face = next;
      next += out.patches[p].faces;
      out.patches[p].faces = 0;
    }
    for_each_face_in_contact([&](Index face) {
      ForcePatch& patch = out.patches[patch_of(face)];
      out.patch_faces[patch.first_face + patch.faces++] = face;
    });
    for (const OverlapCorner& corner : answer_.found.corners)
      if (scratch_.sets.has(casting_mesh().triangles()[corner.face][0])) {
        ForcePatch& patch = out.patches[patch_of(corner.face)];
        patch.max_pressure_mpa =
            std::max(patch.max_pressure_mpa, options_.factor * cast_.answer_at(corner).pressure);
      }
  }
  void add_to_patch(std::size_t i, double load, const Wrench& wrench, ContactForces& out) {
    const OverlapSample& sample = answer_.found.samples[i];
    if (!scratch_.sets.has(casting_mesh().triangles()[sample.face][0])) return;
    ForcePatch& patch = out.patches[patch_of(sample.face)];
    patch.area_mm2 += sample.area;
    patch.load_n += load;
    patch.max_pressure_mpa =
        std::max(patch.max_pressure_mpa, options_.factor * answer_.of_sample[i].pressure);
    patch.on_mobile_body.force_n += wrench.force_n;
    patch.on_mobile_body.moment_nmm += wrench.moment_nmm;
    patch.centre_of_pressure += load * sample.point;
    patch.centre_of_area += sample.area * sample.point;
  }
  void finish_patches(ContactForces& out) const {
    for (std::size_t p = first_patch_; p < out.patches.size(); ++p) {
      ForcePatch& patch = out.patches[p];
      patch.centre_of_area = X_FC_ * Vec3(patch.centre_of_area / patch.area_mm2);
      patch.centre_of_pressure = patch.load_n > 0
                                     ? Vec3(X_FC_ * Vec3(patch.centre_of_pressure / patch.load_n))
                                     : patch.centre_of_area;
    }
  }

  const ElasticCast& cast_;
  const ElasticCast::Answer& answer_;
  BodyRole casting_;
  double share_;
  const ForceOptions& options_;
  ForceScratch& scratch_;
  Pose X_FC_, X_TC_;
  Vec3 origin_M_;
  double sense_;
  VertexLoads &loads_, &target_loads_;
  Vec3 sliding_, turning_;  ///< velocity of the mobile body at the origin of C, and angular velocity
  Matrix6d change_ = Matrix6d::Zero();   ///< about the origin of C
  Vector6d elastic_ = Vector6d::Zero();  ///< on the mobile body, in F, about the origin of M
  std::size_t first_patch_ = 0;
};

void take_forces(VertexLoads& loads, const Mesh& mesh, std::vector<VertexForce>& out) {
  loads.spread_couple(mesh.vertices());
  for (const Index vertex : loads.sorted()) out.push_back({vertex, loads.force(vertex)});
}

void take_vertex_stiffness(ForceScratch& scratch, std::size_t fixed_vertices, ContactForces& out) {
  auto& terms = scratch.terms;
  std::sort(terms.begin(), terms.end(), [](const StiffnessTerm& a, const StiffnessTerm& b) {
    return a.key != b.key ? a.key < b.key : a.block < b.block;
  });
  const auto place = [&](std::uint64_t vertex) {
    return vertex < fixed_vertices ? scratch.on_fixed.place(static_cast<Index>(vertex))
                                   : static_cast<Index>(out.on_fixed.size()) +
                                         scratch.on_mobile.place(static_cast<Index>(vertex - fixed_vertices));
  };
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (i == 0 || terms[i].key != terms[i - 1].key)
      out.vertex_stiffness.push_back(
          {place(terms[i].key >> 32), place(terms[i].key & 0xffffffffu), Eigen::Matrix3d::Zero()});
    out.vertex_stiffness.back().block += scratch.blocks[terms[i].block];
  }
}

}  // namespace

void check_force_options(const ForceOptions& options) {
  const auto require = [](bool is_good, const char* what) {
    if (!is_good) throw UsageError(what);
  };
  const auto is_at_least_0 = [](double value) { return value >= 0 && std::isfinite(value); };
  require(options.motion.velocity_mm_s.allFinite(), "the velocity must be finite");
  require(options.motion.angular_velocity_rad_s.allFinite(), "the angular velocity must be finite");
  require(is_at_least_0(options.friction), "the coefficient of friction must be 0 or more");
  require(options.slip_velocity_mm_s > 0 && std::isfinite(options.slip_velocity_mm_s),
          "the slip velocity must be above 0 mm/s");
  require(is_at_least_0(options.damping_s_per_mm), "the damping must be 0 s/mm or more");
  require(options.factor >= 0 && options.factor <= 1, "the factor must be from 0 to 1");
}

ContactForces ElasticContact::forces(const Pose& X_FM, const ForceOptions& options) const {
  ContactForces out;
  forces(X_FM, options, out);
  return out;
}

void ElasticContact::forces(const Pose& X_FM, const ForceOptions& options, ContactForces& out) const {
  core::require_rotation(X_FM);
  check_force_options(options);
  out.on_mobile_body = {};
  out.energy_nmm = out.friction_power = out.damping_power = out.max_strain = 0;
  out.factor = options.factor;
  out.stiffness.setZero();
  out.on_fixed.clear();
  out.on_mobile.clear();
  out.vertex_stiffness.clear();
  out.patches.clear();
  out.patch_faces.clear();

  const Parts& p = *parts_;
  auto answers = p.pool.take();
  auto scratch = p.force_pool.take();
  p.answer(X_FM, *answers);
  scratch->on_fixed.clear(p.fixed.vertices().size());
  scratch->on_mobile.clear(p.mobile.vertices().size());
  scratch->terms.clear();
  scratch->blocks.clear();
  const double share = p.options.casting == Casting::both ? 0.5 : 1;
  if (p.from_fixed)
    CastForces(*p.from_fixed, answers->of_fixed, BodyRole::fixed, share, X_FM, options, *scratch).add_to(out);
  if (p.from_mobile)
    CastForces(*p.from_mobile, answers->of_mobile, BodyRole::mobile, share, X_FM, options, *scratch)
        .add_to(out);
  take_forces(scratch->on_fixed, p.fixed, out.on_fixed);
  take_forces(scratch->on_mobile, p.mobile, out.on_mobile);
  take_vertex_stiffness(*scratch, p.fixed.vertices().size(), out);
  p.force_pool.put_back(std::move(scratch));
  p.pool.put_back(std::move(answers));
}

ContactRamp::ContactRamp(const ElasticContact& contact, const Pose& start, double duration_s)
    : duration_s_(duration_s) {
  if (!(duration_s > 0) || std::isinf(duration_s))
    throw UsageError("the duration of a ramp must be above 0 s");
  const ElasticContactResults results = contact.at(start);
  for (const auto* surface : {&results.fixed, &results.mobile})
    if (*surface) max_depth_mm_ = std::max(max_depth_mm_, (*surface)->totals.max_depth_mm);
  energy_nmm_ = results.energy_nmm;
}

double ContactRamp::factor_at(double time_s) const noexcept {
  if (!has_overlap()) return 1;
  const double s = std::clamp(time_s / duration_s_, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

}  // namespace condyle::contact
