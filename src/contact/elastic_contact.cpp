#include <algorithm>
#include <cmath>
#include <string>

#include "condyle/error.hpp"
#include "condyle/pressure.hpp"
#include "contact/elastic_parts.hpp"
#include "core/coordinate_range.hpp"
#include "core/cross_matrix.hpp"
#include "core/formatted.hpp"

namespace condyle::contact {
namespace {

void check_layer(const std::optional<ElasticLayer>& layer, const Mesh& mesh, const char* body) {
  if (!layer) return;
  const auto fail = [&](const std::string& what) { throw UsageError(std::string(body) + " layer: " + what); };
  if (!(layer->youngs_modulus_mpa > 0) || std::isinf(layer->youngs_modulus_mpa))
    fail("Young's modulus must be above 0 MPa");
  if (!(layer->poisson_ratio > -1 && layer->poisson_ratio < 0.5))
    fail("Poisson's ratio must be above -1 and below 0.5");
  if (const auto* one = std::get_if<double>(&layer->thickness_mm)) {
    if (!(*one > 0) || std::isinf(*one)) fail("the thickness must be above 0 mm");
    return;
  }
  const auto& many = std::get<std::vector<double>>(layer->thickness_mm);
  if (many.size() != mesh.vertices().size())
    fail(std::to_string(many.size()) + " thicknesses for " + std::to_string(mesh.vertices().size()) +
         " vertices");
  for (std::size_t v = 0; v < many.size(); ++v)
    if (!(many[v] > 0) || std::isinf(many[v]))
      fail("the thickness of vertex " + std::to_string(v) + " must be above 0 mm");
}

LayerHere uniform(const std::optional<ElasticLayer>& layer) {
  if (!layer) return {0, 0};
  const auto* one = std::get_if<double>(&layer->thickness_mm);
  return {layer->confined_modulus_mpa(), one ? *one : 1};
}

std::vector<double> varying(const std::optional<ElasticLayer>& layer) {
  if (!layer || std::holds_alternative<double>(layer->thickness_mm)) return {};
  return std::get<std::vector<double>>(layer->thickness_mm);
}

}  // namespace

ElasticCast::ElasticCast(Mesh casting, Mesh target, const NormalDepthOptions& rays, PressureLaw law,
                         const std::optional<ElasticLayer>& of_casting,
                         const std::optional<ElasticLayer>& of_target)
    : sampler_(std::move(casting), std::move(target), rays),
      law_(law),
      casting_layer_(uniform(of_casting)),
      target_layer_(uniform(of_target)),
      casting_thickness_(varying(of_casting)),
      target_thickness_(varying(of_target)) {}

LayerAnswer ElasticCast::layers_at(const auto& place) const {
  LayerHere casting = casting_layer_, target = target_layer_;
  if (!casting_thickness_.empty()) casting.thickness = place.casting_thickness;
  if (!target_thickness_.empty()) target.thickness = place.target_thickness;
  const double thickness = casting.thickness + target.thickness;
  if (law_ == PressureLaw::logarithmic && !(place.depth < thickness))
    throw MeshError("triangle " + std::to_string(place.face) + " of the casting surface overlaps by " +
                    core::formatted("%.3g", place.depth) + " mm, and its layers are " +
                    core::formatted("%.3g", thickness) + " mm thick: the logarithmic law needs less");
  return answer_of(law_, casting, target, place.depth);
}

void ElasticCast::answer(const Pose& X_CT, Answer& out) const {
  const bool varies = !casting_thickness_.empty() || !target_thickness_.empty();
  sampler_.sample(
      X_CT, varies || law_ == PressureLaw::logarithmic ? Quadrature::of_degree_5 : Quadrature::of_degree_2,
      {casting_thickness_, target_thickness_}, out.found);
  answer_samples(out);
}

void ElasticCast::answer_by_parts(const Pose& X_CT, Answer& out) const {
  sampler_.sample_by_parts(X_CT, {casting_thickness_, target_thickness_}, out.found);
  answer_samples(out);
}

void ElasticCast::answer_samples(Answer& out) const {
  out.of_sample.clear();
  for (const OverlapSample& sample : out.found.samples) out.of_sample.push_back(layers_at(sample));
  out.of_border.clear();
  for (const OverlapBorder& border : out.found.borders) out.of_border.push_back(layers_at(border).pressure);
}

LayerAnswer ElasticCast::answer_at(const OverlapCorner& corner) const {
  return layers_at(corner);
}

void ElasticCast::add_up(const Answer& answer, SurfaceContact& out) const {
  std::vector<double> of_samples, of_corners;
  double strain = 0;
  const auto take = [&](const LayerAnswer& layers, std::vector<double>& pressures) {
    pressures.push_back(layers.pressure);
    strain = std::max(strain, layers.strain);
  };
  for (const LayerAnswer& layers : answer.of_sample) take(layers, of_samples);
  for (const OverlapCorner& corner : answer.found.corners) take(layers_at(corner), of_corners);
  contact::add_up(sampler_, answer.found, OverlapPressures{of_samples, of_corners}, out);
  out.max_strain = strain;
}

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A surface that is cast: `sense` is 1 of the fixed body and -1 of the mobile one; the pose and the origin bring what is in C
/// to F.
struct CastInF {
  const ElasticCast& cast;
  const ElasticCast::Answer& answer;
  Pose X_FC;
  Vec3 origin_M;
  double sense, share;

  void add_load(MobileLoad& out) const {
    const auto normals = cast.sampler().face_normals();
    Index face = no_index;
    Vec3 n = Vec3::Zero();
    for (std::size_t i = 0; i < answer.found.samples.size(); ++i) {
      const OverlapSample& sample = answer.found.samples[i];
      const LayerAnswer& layers = answer.of_sample[i];
      if (sample.face != face) face = sample.face, n = sense * (X_FC.linear() * normals[face]);
      const Vec3 arm = X_FC * sample.point - origin_M;
      const double force = share * sample.area * layers.pressure;
      out.wrench.head<3>() += force * n;
      out.wrench.tail<3>() += force * arm.cross(n);
      out.energy += share * sample.area * layers.energy;
      out.strain = std::max(out.strain, layers.strain);
    }
    out.samples += answer.found.samples.size();
  }

  // Moving the mobile body is moving the target, or moving the casting surface and so the target the other way: what changes
  // and what it changes have one sense. Sums of a face are in C, over what all its samples are pushed along.
  Eigen::Matrix3d change_of_force() const {
    Eigen::Matrix3d change = Eigen::Matrix3d::Zero();
    for_each_face([&](const Vec3& normal, std::size_t begin, std::size_t end) {
      Vec3 growth = Vec3::Zero();
      for (std::size_t i = begin; i < end; ++i) growth += weight(i) * answer.found.samples[i].gradient;
      change += normal * growth.transpose();
    });
    for (std::size_t i = 0; i < answer.found.borders.size(); ++i) {
      const OverlapBorder& border = answer.found.borders[i];
      change += cast.sampler().face_normals()[border.face] *
                (share * answer.of_border[i] * border.growth).transpose();
    }
    return X_FC.linear() * change * X_FC.linear().transpose();
  }
  Matrix6 change_of_wrench() const {
    Matrix6 change = Matrix6::Zero();  // of what is in C, about its origin
    for_each_face([&](const Vec3& normal, std::size_t begin, std::size_t end) {
      Eigen::Matrix<double, 1, 6> growth = Eigen::Matrix<double, 1, 6>::Zero();
      Eigen::Matrix<double, 3, 6> moments = Eigen::Matrix<double, 3, 6>::Zero();
      for (std::size_t i = begin; i < end; ++i) {
        const OverlapSample& sample = answer.found.samples[i];
        const Vec3 met = sample.point - sample.depth * normal;
        Eigen::Matrix<double, 1, 6> g;
        g << sample.gradient.transpose(), met.cross(sample.gradient).transpose();
        growth += weight(i) * g;
        moments += sample.point * (weight(i) * g);
      }
      change.topRows<3>() += normal * growth;
      change.bottomRows<3>() -= core::cross_matrix(normal) * moments;
    });
    for (std::size_t i = 0; i < answer.found.borders.size(); ++i) {
      const OverlapBorder& border = answer.found.borders[i];
      const Vec3 normal = cast.sampler().face_normals()[border.face];
      Eigen::Matrix<double, 1, 6> g;
      g << border.growth.transpose(), border.growth_turned.transpose();
      g *= share * answer.of_border[i];
      change.topRows<3>() += normal * g;
      change.bottomRows<3>() += border.point.cross(normal) * g;
    }
    Matrix6 to_F = Matrix6::Zero();
    to_F.topLeftCorner<3, 3>() = to_F.bottomRightCorner<3, 3>() = X_FC.linear();
    to_F.bottomLeftCorner<3, 3>() = core::cross_matrix(X_FC.translation() - origin_M) * X_FC.linear();
    return to_F * change * to_F.transpose();
  }

 private:
  /// How the force of a sample grows with its depth.
  double weight(std::size_t i) const {
    return share * answer.found.samples[i].area * answer.of_sample[i].slope;
  }
  void for_each_face(const auto& take) const {
    const auto normals = cast.sampler().face_normals();
    const auto& samples = answer.found.samples;
    for (std::size_t begin = 0, end = 0; begin < samples.size(); begin = end) {
      while (end < samples.size() && samples[end].face == samples[begin].face) ++end;
      take(normals[samples[begin].face], begin, end);
    }
  }
};

}  // namespace
ElasticContact::ElasticContact(Mesh fixed, Mesh mobile, ElasticContactOptions options)
    : parts_(new Parts{std::move(fixed), std::move(mobile), std::move(options), {}, {}, {}, {}}) {
  Parts& p = *parts_;
  const auto& o = p.options;
  contact::check_layer(o.fixed, p.fixed, "fixed");
  contact::check_layer(o.mobile, p.mobile, "mobile");
  if (!o.fixed && !o.mobile)
    throw UsageError("two rigid bodies have no contact pressure: one of them needs a layer");
  if (o.casting != Casting::mobile) p.from_fixed.emplace(p.fixed, p.mobile, o.rays, o.law, o.fixed, o.mobile);
  if (o.casting != Casting::fixed) p.from_mobile.emplace(p.mobile, p.fixed, o.rays, o.law, o.mobile, o.fixed);
}
ElasticContact::~ElasticContact() = default;
ElasticContact::ElasticContact(ElasticContact&&) noexcept = default;
ElasticContact& ElasticContact::operator=(ElasticContact&&) noexcept = default;

const Mesh& ElasticContact::fixed() const noexcept {
  return parts_->fixed;
}
const Mesh& ElasticContact::mobile() const noexcept {
  return parts_->mobile;
}
const ElasticContactOptions& ElasticContact::options() const noexcept {
  return parts_->options;
}

void ElasticContact::update(BodyRole body, PointsView vertices) {
  parts_->update(body, moved_vertices(body == BodyRole::fixed ? fixed() : mobile(), vertices));
}

void ElasticContact::update(BodyRole body, std::span<const Index> moved, PointsView positions) {
  parts_->update(body, moved_vertices(body == BodyRole::fixed ? fixed() : mobile(), moved, positions));
}

void ElasticContact::Parts::update(BodyRole body, const MovedVertices& moved) {
  const bool is_fixed = body == BodyRole::fixed;
  (is_fixed ? fixed : mobile) = moved.mesh;
  std::optional<ElasticCast>& from_body = is_fixed ? from_fixed : from_mobile;
  std::optional<ElasticCast>& from_other = is_fixed ? from_mobile : from_fixed;
  if (from_body) from_body->sampler().update_casting(moved.mesh, moved.is_moved);
  if (from_other) from_other->sampler().update_target(moved.mesh, moved.is_moved);
}

ElasticContactResults ElasticContact::at(const Pose& X_FM) const {
  core::require_rotation(X_FM);
  auto answers = parts_->pool.take();
  parts_->answer(X_FM, *answers);
  ElasticContactResults results = parts_->results_of(*answers, parts_->load_of(*answers, X_FM));
  parts_->pool.put_back(std::move(answers));
  return results;
}

void ElasticContact::Parts::answer(const Pose& X_FM, Answers& out) const {
  if (from_fixed) from_fixed->answer(X_FM, out.of_fixed);
  if (from_mobile) from_mobile->answer(inverted(X_FM), out.of_mobile);
}

void ElasticContact::Parts::for_each_cast(const Answers& answers, const Pose& X_FM, const auto& take) const {
  const double share = options.casting == Casting::both ? 0.5 : 1;
  const Vec3 origin_M = X_FM.translation();
  if (from_fixed) take(CastInF{*from_fixed, answers.of_fixed, Pose::Identity(), origin_M, 1, share});
  if (from_mobile) take(CastInF{*from_mobile, answers.of_mobile, X_FM, origin_M, -1, share});
}

MobileLoad ElasticContact::Parts::load_of(const Answers& answers, const Pose& X_FM) const {
  MobileLoad load;
  for_each_cast(answers, X_FM, [&](const CastInF& cast) { cast.add_load(load); });
  return load;
}

LoadChange ElasticContact::Parts::change_of(const Answers& answers, const Pose& X_FM, Motions motions) const {
  LoadChange change = LoadChange::Zero();
  for_each_cast(answers, X_FM, [&](const CastInF& cast) {
    if (motions == Motions::all)
      change += cast.change_of_wrench();
    else
      change.topLeftCorner<3, 3>() += cast.change_of_force();
  });
  return change;
}

ElasticContactResults ElasticContact::Parts::results_of(const Answers& answers,
                                                        const MobileLoad& load) const {
  ElasticContactResults out;
  if (from_fixed) from_fixed->add_up(answers.of_fixed, out.fixed.emplace());
  if (from_mobile) from_mobile->add_up(answers.of_mobile, out.mobile.emplace());
  out.on_mobile = {load.wrench.head<3>(), load.wrench.tail<3>()};
  out.energy_nmm = load.energy;
  return out;
}

std::optional<Vec3> ElasticContact::refined_force_n(const Pose& X_FM) const {
  core::require_rotation(X_FM);
  const Parts& p = *parts_;
  if (p.options.rays.rule == FaceRule::face_centre) return std::nullopt;
  auto answers = p.pool.take();
  try {
    if (p.from_fixed) p.from_fixed->answer_by_parts(X_FM, answers->of_fixed);
    if (p.from_mobile) p.from_mobile->answer_by_parts(inverted(X_FM), answers->of_mobile);
  } catch (const MeshError&) {
    return std::nullopt;
  }
  const Vec3 force = p.load_of(*answers, X_FM).wrench.head<3>();
  p.pool.put_back(std::move(answers));
  return force;
}

std::size_t ElasticContact::cut_off_by_reach(const Pose& X_FM) const {
  core::require_rotation(X_FM);
  std::size_t rays = 0;
  if (parts_->from_fixed) rays += parts_->from_fixed->sampler().cut_off_by_reach(X_FM);
  if (parts_->from_mobile) rays += parts_->from_mobile->sampler().cut_off_by_reach(inverted(X_FM));
  return rays;
}

}  // namespace condyle::contact
