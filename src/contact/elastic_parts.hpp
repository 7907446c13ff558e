#pragma once

#include <vector>

#include "condyle/pressure.hpp"
#include "contact/force_scratch.hpp"
#include "contact/layer_law.hpp"
#include "contact/moved_vertices.hpp"
#include "contact/overlap_sampler.hpp"
#include "core/pool.hpp"

namespace condyle::contact {

/// A casting surface with its layer and that of the target, for sums of pressure.
class ElasticCast {
 public:
  ElasticCast(Mesh casting, Mesh target, const NormalDepthOptions& rays, PressureLaw law,
              const std::optional<ElasticLayer>& of_casting, const std::optional<ElasticLayer>& of_target);

  struct Answer {
    OverlapSampler::Results found;
    std::vector<LayerAnswer> of_sample;
    std::vector<double> of_border;  ///< pressures, MPa
  };
  void answer(const Pose& X_CT, Answer& out) const;
  /// The same from 16 places of each face, for sums of loads only. Throws as answer() does.
  void answer_by_parts(const Pose& X_CT, Answer& out) const;
  void add_up(const Answer& answer, SurfaceContact& out) const;
  /// MPa.
  LayerAnswer answer_at(const OverlapCorner& corner) const;

  OverlapSampler& sampler() noexcept { return sampler_; }
  const OverlapSampler& sampler() const noexcept { return sampler_; }

 private:
  void answer_samples(Answer& out) const;
  /// Layers at an OverlapSample, an OverlapCorner or an OverlapBorder.
  LayerAnswer layers_at(const auto& place) const;

  OverlapSampler sampler_;
  PressureLaw law_;
  LayerHere casting_layer_{0, 0}, target_layer_{0, 0};  ///< thickness 1 where it varies
  std::vector<double> casting_thickness_, target_thickness_;
};

/// The load that one pose puts on the mobile body. In F; moments about the origin of M.
struct MobileLoad {
  Eigen::Matrix<double, 6, 1> wrench = Eigen::Matrix<double, 6, 1>::Zero();  ///< force, then moment
  double energy = 0;
  double strain = 0;  ///< the largest
  std::size_t samples = 0;
};

/// How the wrench changes when the mobile body is translated and turned (radians) a little about the origin of M, loads held in
/// place.
using LoadChange = Eigen::Matrix<double, 6, 6>;
/// Requested derivatives: how forces change with translations, the others zero, or all.
enum class Motions { translations, all };

struct ElasticContact::Parts {
  Mesh fixed, mobile;
  ElasticContactOptions options;
  std::optional<ElasticCast> from_fixed, from_mobile;

  /// Results at a pose for the surfaces that are cast.
  struct Answers {
    ElasticCast::Answer of_fixed, of_mobile;
  };
  void update(BodyRole body, const MovedVertices& moved);
  void answer(const Pose& X_FM, Answers& out) const;
  MobileLoad load_of(const Answers& answers, const Pose& X_FM) const;
  LoadChange change_of(const Answers& answers, const Pose& X_FM, Motions motions) const;
  void for_each_cast(const Answers& answers, const Pose& X_FM, const auto& take) const;
  ElasticContactResults results_of(const Answers& answers, const MobileLoad& load) const;

  mutable core::Pool<Answers> pool;
  mutable core::Pool<ForceScratch> force_pool;
};

}  // namespace condyle::contact
