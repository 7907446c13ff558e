#include "io/study/study_load.hpp"

#include <fmt/format.h>

#include <utility>

#include "condyle/answer.hpp"
#include "condyle/error.hpp"

namespace condyle::io {
namespace {

using Cells = std::vector<std::string>;

/// Columns that stay empty without a force.
constexpr std::size_t of_balance = 5;

void add(Cells& fields, double value) {
  fields.push_back(fmt::format("{}", value));
}

void add(Cells& fields, const Vec3& v) {
  for (int axis = 0; axis < 3; ++axis) add(fields, v[axis]);
}

/// Empty if the body's surface was not cast, a mean or a centre also where nothing of it is in contact.
void add_surface(Cells& fields, const std::optional<contact::SurfaceContact>& surface) {
  const std::size_t end = fields.size() + 9;
  if (surface) {
    const contact::ContactTotals& totals = surface->totals;
    add(fields, totals.area_mm2);
    if (totals.triangles > 0)
      for (const double value :
           {totals.mean_depth_mm, totals.max_depth_mm, totals.mean_pressure_mpa, totals.max_pressure_mpa})
        add(fields, value);
    fields.resize(end - 4);
    if (totals.centre_of_pressure) add(fields, *totals.centre_of_pressure);
    fields.resize(end - 1);
    add(fields, surface->oblique_area_mm2);
  }
  fields.resize(end);
}

LoadRequest request_of(const Joint& joint, const StudyLoad& load, const motion::BodyNames& names) {
  LoadRequest request{.X_FM = pose_at(joint.coordinates(), load.at.angles()), .names = names};
  if (load.force_n)
    request.load = contact::Load{.on_mobile = {.force_n = in_joint_frame(joint, *load.force_n)}};
  for (const Vec3& direction : load.free_directions)
    request.balance.free_directions.push_back(in_joint_frame(joint, direction));
  return request;
}

}  // namespace

ContactEntry study_contact_of(const LoadedJoint& loaded, const ContactChanges& changes) {
  const JointFile& file = loaded.report.file;
  ContactEntry contact = changed(file.contact.value_or(ContactEntry{}), changes);
  if (!contact.fixed && !contact.mobile)
    throw FileError(fmt::format("{}: {}: no layers to carry a load", file.path.string(), loaded.joint.name));
  return contact;
}

Vec3 in_joint_frame(const Joint& joint, const Vec3& anterior_superior_lateral) {
  const Vec3& v = anterior_superior_lateral;
  return {v.x(), v.y(), joint.side == Side::left ? -v.z() : v.z()};
}

std::vector<ResultColumn> load_columns() {
  std::vector<ResultColumn> columns = {
      {"load_outcome", "", text_column,
       "balanced, at_jump or unstable; pulled_apart, over_the_rim, too_large or free_direction, where the "
       "other columns are empty; empty without a force"},
      {"load_residual_n", "N", number_column, "what contact and force add up to; empty without a force"}};
  for (const char* axis : {"x", "y", "z"})
    columns.push_back({fmt::format("load_moved_{}_mm", axis), "mm", number_column,
                       "from the pose asked to the balanced one, joint frame; empty without a force"});
  for (const char* body : {"fixed", "mobile"}) {
    const auto add = [&](const char* name, const char* unit, const char* meaning) {
      columns.push_back({fmt::format("load_{}_{}", body, name), unit, number_column,
                         fmt::format("{}, of the {} body's surface", meaning, body)});
    };
    add("area_mm2", "mm^2", "in contact");
    add("mean_depth_mm", "mm", "overlap in the mean over the area in contact");
    add("max_depth_mm", "mm", "greatest overlap");
    add("mean_pressure_mpa", "MPa", "pressure in the mean over the area in contact");
    add("max_pressure_mpa", "MPa", "greatest pressure");
    for (const char* axis : {"x", "y", "z"})
      columns.push_back({fmt::format("load_{}_centre_{}_mm", body, axis), "mm", number_column,
                         fmt::format("centre of pressure on the {} body, its own frame", body)});
    add("oblique_area_mm2", "mm^2", "overlap without a depth, as rays meet the other surface at a slant");
  }
  for (const char* axis : {"x", "y", "z"})
    columns.push_back({fmt::format("load_force_{}_n", axis), "N", number_column,
                       "of the contact on the mobile body, joint frame"});
  columns.push_back({"load_refined_force_n", "N", number_column,
                     "length of that force with 16 rays in each triangle: what the meshes' edges leave open; "
                     "empty with one ray for each triangle"});
  columns.push_back({"load_cut_off_by_reach", "", number_column,
                     "rays that a longer reach would find in contact; 0: the reach suffices"});
  return columns;
}

StudyLoadAnswer study_load_answer(const LoadedJoint& loaded, const StudyLoad& load) {
  const ContactEntry contact = study_contact_of(loaded, load.contact);
  const ContactSurfaces surfaces = surfaces_of(contact, loaded.joint);
  const contact::ElasticContact layers(surfaces.fixed.mesh, surfaces.mobile.mesh,
                                       elastic_options(contact, surfaces, loaded));
  LoadRequest request = request_of(loaded.joint, load, {surfaces.fixed.name, surfaces.mobile.name});
  LoadAnswer answer = answer_load(layers, request);
  return {std::move(request), std::move(answer)};
}

LoadFields load_fields(const LoadedJoint& loaded, const StudyLoad& load) {
  auto [request, answer] = study_load_answer(loaded, load);
  Cells fields;
  if (answer.balanced) {
    fields.emplace_back(name_of(answer.balanced->outcome));
    if (!answer.carries_load()) {
      fields.resize(load_columns().size());
      return {std::move(fields), std::move(answer.notes)};
    }
    add(fields, answer.balanced->residual.force_n.norm());
    add(fields, answer.X_FM.translation() - request.X_FM.translation());
  } else {
    fields.resize(of_balance);
  }
  add_surface(fields, answer.contact.fixed);
  add_surface(fields, answer.contact.mobile);
  add(fields, answer.contact.on_mobile.force_n);
  fields.push_back(answer.refined_force_n ? fmt::format("{}", answer.refined_force_n->norm()) : "");
  fields.push_back(fmt::format("{}", answer.cut_off_by_reach));
  return {std::move(fields), std::move(answer.notes)};
}

}  // namespace condyle::io
