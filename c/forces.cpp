#include <span>
#include <string>
#include <vector>

#include "boundary.hpp"
#include "condyle/pressure.hpp"
#include "elastic.hpp"

struct condyle_force_options {
  condyle::contact::ForceOptions options = {};
};

namespace condyle::c {

/// Forces on the vertices of a body, as C has them.
struct VertexForces {
  std::vector<std::uint32_t> vertex = {};
  std::vector<double> force_n = {};

  void read(std::span<const contact::VertexForce> forces);
  condyle_vertex_forces view() const noexcept { return {vertex.size(), vertex.data(), force_n.data()}; }
};

/// Results of C++, and what C reads of them one array for each quantity. Copied: a copy costs little beside the forces.
struct Forces {
  contact::ContactForces found = {};
  VertexForces on_fixed = {}, on_mobile = {};
  std::vector<std::uint32_t> row = {}, column = {};
  std::vector<double> block = {};
  std::vector<condyle_force_patch> patches = {};

  void read();
};

}  // namespace condyle::c

struct condyle_force_results {
  bool has_answer = false;
  int requested = 0;
  condyle::c::Forces forces = {};
};

struct condyle_ramp {
  condyle::contact::ContactRamp ramp;
};

namespace condyle::c {

void VertexForces::read(std::span<const contact::VertexForce> forces) {
  vertex.clear();
  force_n.clear();
  for (const contact::VertexForce& force : forces) {
    vertex.push_back(force.vertex);
    force_n.insert(force_n.end(), force.force_n.data(), force.force_n.data() + 3);
  }
}

void Forces::read() {
  on_fixed.read(found.on_fixed);
  on_mobile.read(found.on_mobile);
  row.clear();
  column.clear();
  block.clear();
  for (const contact::VertexStiffness& pair : found.vertex_stiffness) {
    row.push_back(pair.row);
    column.push_back(pair.column);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) block.push_back(pair.block(i, k));
  }
  patches.clear();
  for (const contact::ForcePatch& patch : found.patches) {
    condyle_force_patch& out = patches.emplace_back();
    const auto faces = found.faces_of(patch);
    out.casting = patch.casting == BodyRole::fixed ? CONDYLE_FIXED : CONDYLE_MOBILE;
    out.face_count = faces.size();
    out.faces = faces.data();
    out.area_mm2 = patch.area_mm2;
    out.max_pressure_mpa = patch.max_pressure_mpa;
    out.load_n = patch.load_n;
    copy(patch.on_mobile_body.force_n, out.on_mobile.force_n);
    copy(patch.on_mobile_body.moment_nmm, out.on_mobile.moment_nmm);
    copy(patch.centre_of_pressure, out.centre_of_pressure_mm);
    copy(patch.centre_of_area, out.centre_of_area_mm);
  }
}

namespace {

/// Changes an option, or leaves all as they are if its value is refused.
template <class Change>
condyle_status set_force_option(condyle_force_options* options, const Change& change) noexcept {
  return guarded([&] {
    contact::ForceOptions changed = required(options, "options").options;
    change(changed);
    contact::check_force_options(changed);
    options->options = changed;
  });
}

/// Answers of results that have this part.
const Forces& answered_with(const condyle_force_results* results, int part, const char* name) {
  const condyle_force_results& in = answered(results);
  if (!(in.requested & part))
    throw UsageError(std::string("the results have no ") + name + " among their parts");
  return in.forces;
}

}  // namespace
}  // namespace condyle::c

using namespace condyle;

condyle_status condyle_force_options_create(condyle_force_options** options) {
  return c::make(options, "options");
}

void condyle_force_options_destroy(condyle_force_options* options) {
  delete options;
}

condyle_status condyle_force_options_set_motion(condyle_force_options* options, const double velocity_mm_s[3],
                                                const double angular_velocity_rad_s[3]) {
  return c::set_force_option(options, [&](contact::ForceOptions& out) {
    out.motion = {c::vector_of(velocity_mm_s, "velocity_mm_s"),
                  c::vector_of(angular_velocity_rad_s, "angular_velocity_rad_s")};
  });
}

condyle_status condyle_force_options_set_friction(condyle_force_options* options, double coefficient,
                                                  double slip_velocity_mm_s) {
  return c::set_force_option(options, [&](contact::ForceOptions& out) {
    out.friction = coefficient;
    out.slip_velocity_mm_s = slip_velocity_mm_s;
  });
}

condyle_status condyle_force_options_set_damping(condyle_force_options* options, double damping_s_per_mm) {
  return c::set_force_option(options,
                             [&](contact::ForceOptions& out) { out.damping_s_per_mm = damping_s_per_mm; });
}

condyle_status condyle_force_options_set_factor(condyle_force_options* options, double factor) {
  return c::set_force_option(options, [&](contact::ForceOptions& out) { out.factor = factor; });
}

condyle_status condyle_force_options_set_parts(condyle_force_options* options, int parts) {
  return c::set_force_option(options, [&](contact::ForceOptions& out) {
    constexpr int all =
        CONDYLE_STIFFNESS | CONDYLE_VERTEX_FORCES | CONDYLE_VERTEX_STIFFNESS | CONDYLE_PATCHES;
    if (parts & ~all) throw UsageError("parts: there is no value " + std::to_string(parts));
    out.stiffness = parts & CONDYLE_STIFFNESS;
    out.vertex_forces = parts & (CONDYLE_VERTEX_FORCES | CONDYLE_VERTEX_STIFFNESS);
    out.vertex_stiffness = parts & CONDYLE_VERTEX_STIFFNESS;
    out.patches = parts & CONDYLE_PATCHES;
  });
}

condyle_status condyle_force_results_create(condyle_force_results** results) {
  return c::make(results, "results");
}

void condyle_force_results_destroy(condyle_force_results* results) {
  delete results;
}

condyle_status condyle_elastic_contact_forces(const condyle_elastic_contact* contact,
                                              const condyle_pose* X_FM, const condyle_force_options* options,
                                              condyle_force_results* results) {
  return c::guarded([&] {
    condyle_force_results& out = c::required(results, "results");
    out.has_answer = false;
    const contact::ForceOptions& in = c::required(options, "options").options;
    c::required(contact, "contact").contact.forces(c::pose_of(X_FM, "X_FM"), in, out.forces.found);
    out.forces.read();
    out.requested = (in.stiffness ? CONDYLE_STIFFNESS : 0) | (in.vertex_forces ? CONDYLE_VERTEX_FORCES : 0) |
                    (in.vertex_stiffness ? CONDYLE_VERTEX_STIFFNESS : 0) | (in.patches ? CONDYLE_PATCHES : 0);
    out.has_answer = true;
  });
}

condyle_status condyle_force_results_load(const condyle_force_results* results, condyle_force_load* out) {
  return c::guarded([&] {
    const contact::ContactForces& in = c::answered(results).forces.found;
    condyle_force_load& load = c::required(out, "out");
    c::copy(in.on_mobile_body.force_n, load.on_mobile.force_n);
    c::copy(in.on_mobile_body.moment_nmm, load.on_mobile.moment_nmm);
    load.energy_nmm = in.energy_nmm;
    load.friction_power = in.friction_power;
    load.damping_power = in.damping_power;
    load.max_strain = in.max_strain;
    load.factor = in.factor;
  });
}

condyle_status condyle_force_results_stiffness(const condyle_force_results* results, double stiffness[36]) {
  return c::guarded([&] {
    const auto& in = c::answered_with(results, CONDYLE_STIFFNESS, "stiffness").found.stiffness;
    c::require(stiffness, "stiffness");
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 6; ++k) stiffness[6 * i + k] = in(i, k);
  });
}

condyle_status condyle_force_results_vertices(const condyle_force_results* results, condyle_body body,
                                              condyle_vertex_forces* out) {
  return c::guarded([&] {
    const c::Forces& in = c::answered_with(results, CONDYLE_VERTEX_FORCES, "vertex forces");
    const bool of_fixed = c::role_of(body) == BodyRole::fixed;
    c::required(out, "out") = (of_fixed ? in.on_fixed : in.on_mobile).view();
  });
}

condyle_status condyle_force_results_vertex_stiffness(const condyle_force_results* results,
                                                      condyle_vertex_stiffness* out) {
  return c::guarded([&] {
    const c::Forces& in = c::answered_with(results, CONDYLE_VERTEX_STIFFNESS, "vertex stiffness");
    c::required(out, "out") = {in.row.size(), in.row.data(), in.column.data(), in.block.data()};
  });
}

condyle_status condyle_force_results_patches(const condyle_force_results* results,
                                             const condyle_force_patch** patches, size_t* patch_count) {
  return c::guarded([&] {
    const c::Forces& in = c::answered_with(results, CONDYLE_PATCHES, "patches");
    const condyle_force_patch*& first = c::required(patches, "patches");
    c::required(patch_count, "patch_count") = in.patches.size();
    first = in.patches.data();
  });
}

condyle_status condyle_ramp_create(const condyle_elastic_contact* contact, const condyle_pose* X_FM,
                                   double duration_s, condyle_ramp** ramp) {
  return c::guarded([&] {
    condyle_ramp*& out = c::required(ramp, "ramp");
    out = new condyle_ramp{
        contact::ContactRamp(c::required(contact, "contact").contact, c::pose_of(X_FM, "X_FM"), duration_s)};
  });
}

void condyle_ramp_destroy(condyle_ramp* ramp) {
  delete ramp;
}

double condyle_ramp_max_depth_mm(const condyle_ramp* ramp) {
  return ramp ? ramp->ramp.max_depth_mm() : 0;
}

double condyle_ramp_energy_nmm(const condyle_ramp* ramp) {
  return ramp ? ramp->ramp.energy_nmm() : 0;
}

double condyle_ramp_factor_at(const condyle_ramp* ramp, double time_s) {
  return ramp ? ramp->ramp.factor_at(time_s) : 1;
}
