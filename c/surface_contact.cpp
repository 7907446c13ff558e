#include <utility>
#include <vector>

#include "boundary.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"
#include "elastic.hpp"

struct condyle_normal_depth {
  condyle::contact::NormalDepth depth;
};

namespace condyle::c {

/// A surface's results, and its faces as C has them. Copied: they are some hundred bytes each, and a ray costs more.
struct Surface {
  contact::SurfaceContact found = {};
  std::vector<condyle_face_contact> faces = {};

  void read_faces();
  condyle_surface_contact view() const noexcept;
};

}  // namespace condyle::c

struct condyle_normal_results {
  bool has_answer = false;
  condyle::c::Surface surface = {};
};

struct condyle_elastic_options {
  condyle::contact::ElasticContactOptions options = {};
};

struct condyle_elastic_results {
  bool has_answer = false;
  bool fixed_is_cast = false, mobile_is_cast = false;
  condyle::c::Surface fixed = {}, mobile = {};
  condyle::contact::Wrench on_mobile = {};
  double energy_nmm = 0;
};

namespace condyle::c {

static_assert(static_cast<int>(contact::FaceRule::face_centre) == CONDYLE_FACE_CENTRE &&
              static_cast<int>(contact::FaceRule::cut_faces) == CONDYLE_CUT_FACES);
static_assert(static_cast<int>(contact::Casting::fixed) == CONDYLE_CAST_FIXED &&
              static_cast<int>(contact::Casting::mobile) == CONDYLE_CAST_MOBILE &&
              static_cast<int>(contact::Casting::both) == CONDYLE_CAST_BOTH);
static_assert(static_cast<int>(contact::PressureLaw::linear) == CONDYLE_LINEAR &&
              static_cast<int>(contact::PressureLaw::logarithmic) == CONDYLE_LOGARITHMIC);

void Surface::read_faces() {
  faces.clear();
  faces.reserve(found.faces.size());
  for (const contact::FaceContact& face : found.faces) {
    condyle_face_contact& out = faces.emplace_back();
    out.face = face.face;
    out.area_mm2 = face.area_mm2;
    out.max_depth_mm = face.max_depth_mm;
    out.overlap_mm3 = face.overlap_mm3;
    copy(face.overlap_moment, out.overlap_moment_mm4);
    out.max_pressure_mpa = face.max_pressure_mpa;
    out.load_n = face.load_n;
    copy(face.load_moment, out.load_moment_nmm);
  }
}

condyle_surface_contact Surface::view() const noexcept {
  const contact::ContactTotals& totals = found.totals;
  condyle_surface_contact out = {};
  out.is_cast = 1;
  out.face_count = faces.size();
  out.faces = faces.data();
  out.area_mm2 = totals.area_mm2;
  out.mean_depth_mm = totals.mean_depth_mm;
  out.max_depth_mm = totals.max_depth_mm;
  out.mean_pressure_mpa = totals.mean_pressure_mpa;
  out.max_pressure_mpa = totals.max_pressure_mpa;
  out.has_centre_of_depth = totals.centre_of_depth.has_value();
  out.has_centre_of_pressure = totals.centre_of_pressure.has_value();
  if (totals.centre_of_depth) copy(*totals.centre_of_depth, out.centre_of_depth_mm);
  if (totals.centre_of_pressure) copy(*totals.centre_of_pressure, out.centre_of_pressure_mm);
  copy(totals.force_n, out.force_n);
  copy(totals.moment_nmm, out.moment_nmm);
  out.met_from_front = found.met_from_front;
  out.rim_faces = found.rim_faces;
  out.oblique_area_mm2 = found.oblique_area_mm2;
  out.peak_is_oblique = found.peak_is_oblique;
  out.max_strain = found.max_strain;
  return out;
}

namespace {

contact::NormalDepthOptions rays_of(condyle_face_rule rule, double reach_mm) {
  return {one_of(rule, contact::FaceRule::cut_faces, "rule"), reach_mm};
}

/// Whether the surface was cast.
bool take(std::optional<contact::SurfaceContact>& from, Surface& to) {
  if (!from) return false;
  to.found = std::move(*from);
  to.read_faces();
  return true;
}

void answer(const contact::ElasticContact& contact, const Pose& X_FM, condyle_elastic_results& out) {
  contact::ElasticContactResults results = contact.at(X_FM);
  out.fixed_is_cast = take(results.fixed, out.fixed);
  out.mobile_is_cast = take(results.mobile, out.mobile);
  out.on_mobile = results.on_mobile;
  out.energy_nmm = results.energy_nmm;
}

}  // namespace
}  // namespace condyle::c

using namespace condyle;

condyle_status condyle_normal_depth_create(const condyle_mesh* casting, const condyle_mesh* target,
                                           condyle_face_rule rule, double reach_mm,
                                           condyle_normal_depth** depth) {
  return c::guarded([&] {
    condyle_normal_depth*& out = c::required(depth, "depth");
    out = new condyle_normal_depth{contact::NormalDepth(c::required(casting, "casting").mesh,
                                                        c::required(target, "target").mesh,
                                                        c::rays_of(rule, reach_mm))};
  });
}

void condyle_normal_depth_destroy(condyle_normal_depth* depth) {
  delete depth;
}

condyle_status condyle_normal_depth_update_casting(condyle_normal_depth* depth, const double* xyz_mm,
                                                   size_t vertex_count) {
  return c::guarded([&] {
    contact::NormalDepth& out = c::required(depth, "depth").depth;
    out.update_casting(c::all_points_of(out.casting(), xyz_mm, vertex_count));
  });
}

condyle_status condyle_normal_depth_update_casting_some(condyle_normal_depth* depth, const uint32_t* vertices,
                                                        size_t count, const double* xyz_mm) {
  return c::guarded([&] {
    contact::NormalDepth& out = c::required(depth, "depth").depth;
    const c::SomePoints some = c::some_points_of(out.casting(), vertices, count, xyz_mm);
    out.update_casting(some.vertices, some.points);
  });
}

condyle_status condyle_normal_depth_update_target(condyle_normal_depth* depth, const double* xyz_mm,
                                                  size_t vertex_count) {
  return c::guarded([&] {
    contact::NormalDepth& out = c::required(depth, "depth").depth;
    out.update_target(c::all_points_of(out.target(), xyz_mm, vertex_count));
  });
}

condyle_status condyle_normal_depth_update_target_some(condyle_normal_depth* depth, const uint32_t* vertices,
                                                       size_t count, const double* xyz_mm) {
  return c::guarded([&] {
    contact::NormalDepth& out = c::required(depth, "depth").depth;
    const c::SomePoints some = c::some_points_of(out.target(), vertices, count, xyz_mm);
    out.update_target(some.vertices, some.points);
  });
}

condyle_status condyle_normal_results_create(condyle_normal_results** results) {
  return c::make(results, "results");
}

void condyle_normal_results_destroy(condyle_normal_results* results) {
  delete results;
}

condyle_status condyle_normal_depth_at(const condyle_normal_depth* depth, const condyle_pose* X_CT,
                                       condyle_normal_results* results) {
  return c::guarded([&] {
    condyle_normal_results& out = c::required(results, "results");
    out.has_answer = false;
    c::required(depth, "depth").depth.at(c::pose_of(X_CT, "X_CT"), out.surface.found);
    out.surface.read_faces();
    out.has_answer = true;
  });
}

condyle_status condyle_normal_results_surface(const condyle_normal_results* results,
                                              condyle_surface_contact* out) {
  return c::guarded([&] {
    const c::Surface& surface = c::answered(results).surface;
    c::required(out, "out") = surface.view();
  });
}

condyle_status condyle_elastic_options_create(condyle_elastic_options** options) {
  return c::make(options, "options");
}

void condyle_elastic_options_destroy(condyle_elastic_options* options) {
  delete options;
}

condyle_status condyle_elastic_options_set_casting(condyle_elastic_options* options,
                                                   condyle_casting casting) {
  return c::guarded([&] {
    c::required(options, "options").options.casting = c::one_of(casting, contact::Casting::both, "casting");
  });
}

condyle_status condyle_elastic_options_set_law(condyle_elastic_options* options, condyle_pressure_law law) {
  return c::guarded([&] {
    c::required(options, "options").options.law = c::one_of(law, contact::PressureLaw::logarithmic, "law");
  });
}

condyle_status condyle_elastic_options_set_rays(condyle_elastic_options* options, condyle_face_rule rule,
                                                double reach_mm) {
  return c::guarded([&] { c::required(options, "options").options.rays = c::rays_of(rule, reach_mm); });
}

condyle_status condyle_elastic_options_set_layer(condyle_elastic_options* options, condyle_body body,
                                                 double youngs_modulus_mpa, double poisson_ratio,
                                                 const double* thickness_mm, size_t thickness_count) {
  return c::guarded([&] {
    contact::ElasticContactOptions& out = c::required(options, "options").options;
    const BodyRole role = c::role_of(body);
    c::require(thickness_mm, "thickness_mm");
    if (thickness_count == 0) throw UsageError("thickness_count is 0: a layer has a thickness");
    c::check_countable(thickness_count);
    contact::ElasticLayer layer{youngs_modulus_mpa, poisson_ratio, *thickness_mm};
    if (thickness_count > 1)
      layer.thickness_mm = std::vector<double>(thickness_mm, thickness_mm + thickness_count);
    (role == BodyRole::fixed ? out.fixed : out.mobile) = std::move(layer);
  });
}

condyle_status condyle_elastic_contact_create(const condyle_mesh* fixed, const condyle_mesh* mobile,
                                              const condyle_elastic_options* options,
                                              condyle_elastic_contact** contact) {
  return c::guarded([&] {
    condyle_elastic_contact*& out = c::required(contact, "contact");
    out = new condyle_elastic_contact{contact::ElasticContact(c::required(fixed, "fixed").mesh,
                                                              c::required(mobile, "mobile").mesh,
                                                              c::required(options, "options").options)};
  });
}

void condyle_elastic_contact_destroy(condyle_elastic_contact* contact) {
  delete contact;
}

condyle_status condyle_elastic_contact_update(condyle_elastic_contact* contact, condyle_body body,
                                              const double* xyz_mm, size_t vertex_count) {
  return c::guarded([&] {
    contact::ElasticContact& out = c::required(contact, "contact").contact;
    const BodyRole role = c::role_of(body);
    out.update(role, c::all_points_of(c::mesh_of(out, role), xyz_mm, vertex_count));
  });
}

condyle_status condyle_elastic_contact_update_some(condyle_elastic_contact* contact, condyle_body body,
                                                   const uint32_t* vertices, size_t count,
                                                   const double* xyz_mm) {
  return c::guarded([&] {
    contact::ElasticContact& out = c::required(contact, "contact").contact;
    const BodyRole role = c::role_of(body);
    const c::SomePoints some = c::some_points_of(c::mesh_of(out, role), vertices, count, xyz_mm);
    out.update(role, some.vertices, some.points);
  });
}

condyle_status condyle_elastic_results_create(condyle_elastic_results** results) {
  return c::make(results, "results");
}

void condyle_elastic_results_destroy(condyle_elastic_results* results) {
  delete results;
}

condyle_status condyle_elastic_contact_at(const condyle_elastic_contact* contact, const condyle_pose* X_FM,
                                          condyle_elastic_results* results) {
  return c::guarded([&] {
    condyle_elastic_results& out = c::required(results, "results");
    out.has_answer = false;
    c::answer(c::required(contact, "contact").contact, c::pose_of(X_FM, "X_FM"), out);
    out.has_answer = true;
  });
}

condyle_status condyle_elastic_results_load(const condyle_elastic_results* results, condyle_wrench* on_mobile,
                                            double* energy_nmm) {
  return c::guarded([&] {
    const condyle_elastic_results& in = c::answered(results);
    condyle_wrench& wrench = c::required(on_mobile, "on_mobile");
    c::required(energy_nmm, "energy_nmm") = in.energy_nmm;
    c::copy(in.on_mobile.force_n, wrench.force_n);
    c::copy(in.on_mobile.moment_nmm, wrench.moment_nmm);
  });
}

condyle_status condyle_elastic_results_surface(const condyle_elastic_results* results, condyle_body body,
                                               condyle_surface_contact* out) {
  return c::guarded([&] {
    const condyle_elastic_results& in = c::answered(results);
    condyle_surface_contact& view = c::required(out, "out");
    const bool of_fixed = c::role_of(body) == BodyRole::fixed;
    view = {};
    if (of_fixed ? in.fixed_is_cast : in.mobile_is_cast) view = (of_fixed ? in.fixed : in.mobile).view();
  });
}
