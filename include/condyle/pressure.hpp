#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "condyle/normal_depth.hpp"

/// Contact pressure of thin layers on rigid bones: the elastic foundation (Blankevoort et al., J Biomech 24, 1991).
/// docs/mathematics/07-contact-pressure.md. A layer of thickness h, modulus E and Poisson's ratio nu that cannot spread sideways
/// answers an overlap d by the pressure
///
///     linear        p = M d / h                  M = (1 - nu) E / ((1 + nu)(1 - 2 nu))
///     logarithmic   p = -M ln(1 - d / h)
///
/// each place for itself: no shear and no lateral spread, so peaks run above those of finite elements.
///
///     const ElasticLayer cartilage{.youngs_modulus_mpa = 10, .poisson_ratio = 0.45, .thickness_mm = 3.0};
///     const ElasticContact knee(femur, tibia, {.casting = Casting::mobile, .fixed = cartilage, .mobile = cartilage});
///     const double peak = knee.at(X_FM).mobile->totals.max_pressure_mpa;

namespace condyle {

struct ElasticLayer {
  double youngs_modulus_mpa;  ///< > 0
  double poisson_ratio;       ///< > -1 and < 0.5
  /// One value for the whole layer, or one for each vertex of its mesh; > 0.
  std::variant<double, std::vector<double>> thickness_mm;

  /// Modulus of a layer that cannot spread sideways, MPa.
  double confined_modulus_mpa() const noexcept {
    return (1 - poisson_ratio) * youngs_modulus_mpa / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
  }
};

enum class PressureLaw { linear, logarithmic };

/// Which body's surface is cast. With `both` each is, and the load is the mean of the two: exchanging the bodies then
/// exchanges the signs of forces and nothing else.
enum class Casting { fixed, mobile, both };

struct ElasticContactOptions {
  Casting casting = Casting::both;
  NormalDepthOptions rays = {};
  PressureLaw law = PressureLaw::linear;
  /// At least one of the two; a body without one is rigid.
  std::optional<ElasticLayer> fixed = {}, mobile = {};
};

/// Force and moment about a point, N and N mm.
struct Wrench {
  Vec3 force_n = Vec3::Zero(), moment_nmm = Vec3::Zero();
};

/// Results at one pose.
struct ElasticContactResults {
  /// Results for the surfaces that were cast, each in its own body's frame; pressures and loads are filled in.
  std::optional<SurfaceContact> fixed, mobile;
  /// Wrench of the fixed body on the mobile one, in F, about the origin of M. With one casting, plus or minus its
  /// totals; with both, the mean.
  Wrench on_mobile;
  /// Stored in the layers, N mm.
  double energy_nmm = 0;
};

/// Two surfaces with their layers, queried at any pose. Any number of threads may query.
class ElasticContact {
 public:
  /// UsageError if an option is outside its domain or thicknesses are not as many as vertices.
  ElasticContact(Mesh fixed, Mesh mobile, ElasticContactOptions options);
  ~ElasticContact();
  ElasticContact(ElasticContact&&) noexcept;
  ElasticContact& operator=(ElasticContact&&) noexcept;

  /// MeshError with the logarithmic law if the overlap reaches the thickness, naming the triangle.
  ElasticContactResults at(const Pose& X_FM) const;

  /// The force on the mobile body, in F, with the depth evaluated at 16 points of each face in contact: it shows the
  /// effect of mesh edges on `at(X_FM).on_mobile`, whose depths are linear from corner to corner. Sixteen times the
  /// rays. Empty with the rule face_centre, whose depths have no such effect, and if the logarithmic law has no
  /// answer at one of these points.
  std::optional<Vec3> refined_force_n(const Pose& X_FM) const;

  /// Rays of this pose that a longer reach would find in contact: NormalDepth::cut_off_by_reach().
  std::size_t cut_off_by_reach(const Pose& X_FM) const;

  const Mesh& fixed() const noexcept;
  const Mesh& mobile() const noexcept;
  const ElasticContactOptions& options() const noexcept;

  /// Internal data of balance(); not for use outside the library.
  struct Parts;
  const Parts& parts() const noexcept { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace condyle
