#include <cmath>
#include <string>

#include "condyle/error.hpp"
#include "condyle/pressure.hpp"
#include "contact/elastic_parts.hpp"
#include "core/coordinate_range.hpp"
#include "core/formatted.hpp"

namespace condyle {
namespace contact {
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

void ElasticCast::answer(const Pose& X_CT, Answer& out) const {
  const bool varies = !casting_thickness_.empty() || !target_thickness_.empty();
  sampler_.sample(
      X_CT, varies || law_ == PressureLaw::logarithmic ? Quadrature::of_degree_5 : Quadrature::of_degree_2,
      {casting_thickness_, target_thickness_}, out.found);
  out.of_sample.clear();
  out.pressures.clear();
  LayerHere casting = casting_layer_, target = target_layer_;
  for (const OverlapSample& sample : out.found.samples) {
    if (!casting_thickness_.empty()) casting.thickness = sample.casting_thickness;
    if (!target_thickness_.empty()) target.thickness = sample.target_thickness;
    const double thickness = casting.thickness + target.thickness;
    if (law_ == PressureLaw::logarithmic && !(sample.depth < thickness))
      throw MeshError("triangle " + std::to_string(sample.face) + " of the casting surface overlaps by " +
                      core::formatted("%.3g", sample.depth) + " mm, and its layers are " +
                      core::formatted("%.3g", thickness) + " mm thick: the logarithmic law needs less");
    out.of_sample.push_back(answer_of(law_, casting, target, sample.depth));
    out.pressures.push_back(out.of_sample.back().pressure);
  }
}

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Vector6 stacked(const Vec3& a, const Vec3& b) {
  Vector6 both;
  both << a, b;
  return both;
}

/// A surface that is cast: `sense` is 1 of the fixed body and -1 of the mobile one; the pose and the origin bring what is in C
/// to F.
struct CastInF {
  const ElasticCast& cast;
  const ElasticCast::Answer& answer;
  Pose X_FC;
  Vec3 origin_M;
  double sense, share;

  /// Each sample that stands for an area, with its direction and arm in F.
  void for_each(const auto& take) const {
    const auto normals = cast.sampler().face_normals();
    for (std::size_t i = 0; i < answer.found.samples.size(); ++i) {
      const OverlapSample& sample = answer.found.samples[i];
      if (sample.area == 0) continue;
      const Vec3 n = sense * (X_FC.linear() * normals[sample.face]);
      const Vec3 arm = X_FC * sample.point - origin_M;
      take(sample, answer.of_sample[i], stacked(n, arm.cross(n)), arm);
    }
  }

  void add_load(MobileLoad& out) const {
    for_each(
        [&](const OverlapSample& sample, const LayerAnswer& layer, const Vector6& direction, const Vec3&) {
          ++out.samples;
          out.wrench += share * sample.area * layer.pressure * direction;
          out.energy += share * sample.area * layer.energy;
        });
  }

  void add_change(LoadChange& out) const {
    const auto normals = cast.sampler().face_normals();
    for_each([&](const OverlapSample& sample, const LayerAnswer& layer, const Vector6& direction,
                 const Vec3& arm) {
      // Moving the mobile body is moving the target, or moving the casting surface and so the target the other way.
      const Vec3 g = sense * (X_FC.linear() * sample.gradient);
      const Vec3 met = arm + sample.depth * -(X_FC.linear() * normals[sample.face]);
      out += share * sample.area * layer.slope * direction * stacked(g, met.cross(g)).transpose();
    });
  }
};

}  // namespace
}  // namespace contact

ElasticContact::ElasticContact(Mesh fixed, Mesh mobile, ElasticContactOptions options)
    : parts_(new Parts{std::move(fixed), std::move(mobile), std::move(options), {}, {}, {}}) {
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

ElasticContactResults ElasticContact::at(const Pose& X_FM) const {
  core::require_in_range(X_FM);
  auto answers = parts_->spare.take();
  parts_->answer(X_FM, *answers);
  ElasticContactResults results = parts_->results_of(*answers, parts_->load_of(*answers, X_FM));
  parts_->spare.put_back(std::move(answers));
  return results;
}

void ElasticContact::Parts::answer(const Pose& X_FM, Answers& out) const {
  if (from_fixed) from_fixed->answer(X_FM, out.of_fixed);
  if (from_mobile) from_mobile->answer(inverted(X_FM), out.of_mobile);
}

void ElasticContact::Parts::for_each_cast(const Answers& answers, const Pose& X_FM, const auto& take) const {
  const double share = options.casting == Casting::both ? 0.5 : 1;
  const Vec3 origin_M = X_FM.translation();
  if (from_fixed) take(contact::CastInF{*from_fixed, answers.of_fixed, Pose::Identity(), origin_M, 1, share});
  if (from_mobile) take(contact::CastInF{*from_mobile, answers.of_mobile, X_FM, origin_M, -1, share});
}

contact::MobileLoad ElasticContact::Parts::load_of(const Answers& answers, const Pose& X_FM) const {
  contact::MobileLoad load;
  for_each_cast(answers, X_FM, [&](const contact::CastInF& cast) { cast.add_load(load); });
  return load;
}

contact::LoadChange ElasticContact::Parts::change_of(const Answers& answers, const Pose& X_FM) const {
  contact::LoadChange change = contact::LoadChange::Zero();
  for_each_cast(answers, X_FM, [&](const contact::CastInF& cast) { cast.add_change(change); });
  return change;
}

ElasticContactResults ElasticContact::Parts::results_of(const Answers& answers,
                                                        const contact::MobileLoad& load) const {
  ElasticContactResults out;
  const auto add = [](const contact::ElasticCast& cast, const contact::ElasticCast::Answer& answer,
                      SurfaceContact& surface) {
    contact::add_up(cast.sampler(), answer.found, answer.pressures, surface);
  };
  if (from_fixed) add(*from_fixed, answers.of_fixed, out.fixed.emplace());
  if (from_mobile) add(*from_mobile, answers.of_mobile, out.mobile.emplace());
  out.on_mobile = {load.wrench.head<3>(), load.wrench.tail<3>()};
  out.energy_nmm = load.energy;
  return out;
}

std::size_t ElasticContact::cut_off_by_reach(const Pose& X_FM) const {
  std::size_t rays = 0;
  if (parts_->from_fixed) rays += parts_->from_fixed->sampler().cut_off_by_reach(X_FM);
  if (parts_->from_mobile) rays += parts_->from_mobile->sampler().cut_off_by_reach(inverted(X_FM));
  return rays;
}

}  // namespace condyle
