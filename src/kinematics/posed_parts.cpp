#include "kinematics/posed_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/make_joint.hpp"
#include "core/coordinate_range.hpp"
#include "core/formatted.hpp"
#include "core/one_line.hpp"
#include "core/ordered_sums.hpp"
#include "core/pair.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/hip_parts.hpp"
#include "kinematics/ligament_path.hpp"

namespace condyle {
namespace kinematics {
namespace {

using core::formatted;

/// A rotation about an axis of the frame: 0, 1, 2 for X, Y, Z.
Eigen::Matrix3d rotation_about(int axis, double degrees) {
  const auto [sine, cosine] = core::sine_cosine(degrees * (std::numbers::pi / 180));
  const int i = (axis + 1) % 3, k = (axis + 2) % 3;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R(i, i) = R(k, k) = cosine;
  R(k, i) = sine;
  R(i, k) = -sine;
  return R;
}

/// The axis that a parameter turns about; empty if it does not turn.
std::optional<int> axis_of(ParameterKind kind) noexcept {
  switch (kind) {
    case ParameterKind::frontal:
    case ParameterKind::inclination:
      return 0;
    case ParameterKind::version:
      return 1;
    case ParameterKind::sagittal:
    case ParameterKind::tilt:
      return 2;
    default:
      return std::nullopt;
  }
}

/// The rotation of a value, about its axis of the frame and in degrees.
double turn_of(const PartParameter& parameter, BodyRole body, Side side) noexcept {
  const double degrees = parameter.value - parameter.as_given;
  const double sense = side == Side::right ? 1 : -1;
  switch (parameter.kind) {
    case ParameterKind::frontal:
      return sense * degrees;
    case ParameterKind::inclination:
      return -sense * degrees;
    case ParameterKind::version:
      return (body == BodyRole::fixed ? sense : -sense) * degrees;
    case ParameterKind::tilt:
      return -degrees;
    default:
      return degrees;
  }
}

bool is_of_cup(ParameterKind kind) noexcept {
  return kind == ParameterKind::cup_inclination || kind == ParameterKind::cup_anteversion;
}

const PartParameter* parameter_of(const PosedPart& part, ParameterKind kind) noexcept {
  for (const PartParameter& parameter : part.parameters)
    if (parameter.kind == kind) return &parameter;
  return nullptr;
}

/// Brings an axis that points down to the one out of a cup of these angles, in degrees, and the rest of the cup with it.
Eigen::Matrix3d cup_rotation(double inclination, double anteversion, CupDefinition definition, Side side) {
  const double sense = side == Side::right ? 1 : -1;
  const Eigen::Matrix3d opened = rotation_about(0, -sense * inclination);
  switch (definition) {
    case CupDefinition::radiographic:
      return core::ordered_product(opened, rotation_about(2, anteversion));
    case CupDefinition::anatomic:
      return core::ordered_product(rotation_about(1, sense * anteversion), opened);
    case CupDefinition::operative:
      break;
  }
  return core::ordered_product(rotation_about(2, anteversion), opened);
}

/// From the angles at which the meshes of a cup stand as they are given to those that it has; the identity, to the bit, if these are
/// the same.
Eigen::Matrix3d cup_turn(const PosedPart& part, Side side) {
  const PartParameter* inclination = parameter_of(part, ParameterKind::cup_inclination);
  const PartParameter* anteversion = parameter_of(part, ParameterKind::cup_anteversion);
  if (!inclination || !anteversion ||
      (inclination->value == inclination->as_given && anteversion->value == anteversion->as_given))
    return Eigen::Matrix3d::Identity();
  const auto rotation = [&](double i, double a) { return cup_rotation(i, a, part.definition, side); };
  return core::ordered_product(rotation(inclination->value, anteversion->value),
                               rotation(inclination->as_given, anteversion->as_given).transpose());
}

bool is_name(std::string_view text) noexcept {
  return !text.empty() && text.size() <= 100 && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw UsageError(where + ": " + what);
}

void check_name(const std::string& name, const std::string& where) {
  if (!is_name(name)) refuse(where, "a name has letters, digits, _ and - only, one or more");
}

void check_parameter(const PartParameter& parameter, const std::string& where) {
  for (const double number : {parameter.low, parameter.high, parameter.value, parameter.as_given,
                              parameter.sigma, parameter.direction.sum()})
    if (!std::isfinite(number)) refuse(where, "has a number that is not finite");
  if (!(parameter.low <= parameter.high))
    refuse(where, formatted("range: %.10g lies above %.10g", parameter.low, parameter.high));
  if (parameter.value < parameter.low || parameter.value > parameter.high)
    refuse(where, formatted("value: %.10g is outside of its range, %.10g to %.10g", parameter.value,
                            parameter.low, parameter.high));
  if (parameter.sigma < 0) refuse(where, "sigma: must be 0 or more");
  if (axis_of(parameter.kind) && std::max(-parameter.low, parameter.high) > 360)
    refuse(where, "range: must lie within -360 and 360 degrees");
  // Beyond these an axis has other angles too.
  const double least = parameter.kind == ParameterKind::cup_inclination ? 0 : -90;
  if (is_of_cup(parameter.kind) && (std::min(parameter.low, parameter.as_given) < least ||
                                    std::max(parameter.high, parameter.as_given) > 90))
    refuse(where, formatted("range: the angles of a cup lie within %g and 90 degrees", least));
  if (parameter.kind == ParameterKind::translation &&
      !(std::abs(parameter.direction.norm() - 1) <= axis_tolerance))
    refuse(where, "along: must be a unit vector");
  if (parameter.kind != ParameterKind::size) return;
  if (!(parameter.low > 0 && parameter.as_given > 0)) refuse(where, "a size must be above 0");
  // A band draws no value farther than some five standard deviations from the mean: sizes stay above 0.
  if (parameter.sigma > parameter.low / 10)
    refuse(where, "sigma: must be at most a tenth of the smallest size");
}

void check_cup(const PosedPart& part, const std::string& where) {
  const auto count = [&](const auto& is_one) {
    return std::count_if(part.parameters.begin(), part.parameters.end(),
                         [&](const PartParameter& parameter) { return is_one(parameter.kind); });
  };
  const auto angles = count(&is_of_cup);
  if (angles == 0) return;
  if (angles != 2 || !parameter_of(part, ParameterKind::cup_inclination) ||
      !parameter_of(part, ParameterKind::cup_anteversion))
    refuse(where, "a cup has one cup_inclination and one cup_anteversion");
  if (count([](ParameterKind kind) { return axis_of(kind).has_value(); }) > 0)
    refuse(where,
           "a part that has the angles of a cup is not turned by others: these go into a part that holds it");
  if (part.body == BodyRole::mobile) refuse(where, "the angles of a cup are those of the fixed body");
}

void check_parameters(const PosedPart& part, const std::string& where) {
  if (part.parameters.empty()) refuse(where, "needs one parameter or more");
  for (std::size_t i = 0; i < part.parameters.size(); ++i) {
    const PartParameter& parameter = part.parameters[i];
    check_name(parameter.name, where + ": name of a parameter");
    check_parameter(parameter, where + "." + parameter.name);
    for (std::size_t k = 0; k < i; ++k) {
      const PartParameter& other = part.parameters[k];
      if (other.name == parameter.name) refuse(where, "parameter " + parameter.name + " is given twice");
      const auto axis = axis_of(parameter.kind);
      if (axis && axis == axis_of(other.kind))
        refuse(where, other.name + " and " + parameter.name + " turn about the same axis");
      if (parameter.kind == ParameterKind::size && other.kind == ParameterKind::size)
        refuse(where, other.name + " and " + parameter.name + " are both sizes");
    }
  }
  check_cup(part, where);
}

void check_meshes(const PosedPart& part, const Body& body, const std::string& where) {
  for (std::size_t i = 0; i < part.meshes.size(); ++i) {
    const std::string& mesh = part.meshes[i];
    if (std::none_of(body.parts.begin(), body.parts.end(),
                     [&](const BodyPart& known) { return known.name == mesh; })) {
      std::string names;
      for (const BodyPart& known : body.parts) names += (names.empty() ? "" : ", ") + known.name;
      refuse(where, "the body has no mesh \"" + core::one_line(mesh) + "\"" +
                        (names.empty() ? ": it is one mesh, which a part without meshes moves"
                                       : "; there are " + core::one_line(names, 2000)));
    }
    if (std::find(part.meshes.begin(), part.meshes.begin() + static_cast<std::ptrdiff_t>(i), mesh) !=
        part.meshes.begin() + static_cast<std::ptrdiff_t>(i))
      refuse(where, "mesh " + core::one_line(mesh) + " is named twice");
  }
}

/// `next` of what `first` has moved.
Eigen::Affine3d after(const Eigen::Affine3d& next, const Eigen::Affine3d& first) noexcept {
  Eigen::Affine3d both = Eigen::Affine3d::Identity();
  both.linear() = core::ordered_product(next.linear(), first.linear());
  both.translation() = core::ordered_image(next.linear(), first.translation()) + next.translation();
  return both;
}

bool moves_nothing(const Eigen::Affine3d& motion) noexcept {
  return motion.matrix().isIdentity(0);
}

/// A uniform scale.
double scale_of(const Eigen::Affine3d& motion) noexcept {
  return core::ordered_norm(motion.linear().col(0));
}

/// Rounded once from some 106 bits, the same on every machine: what a page moves lies where the command moves it, to the bit.
Vec3 moved_by(const Eigen::Affine3d& motion, const Vec3& point) noexcept {
  const auto row = [&](int i) {
    core::Pair sum{motion(i, 3), 0};
    for (int k = 0; k < 3; ++k) sum = sum + core::exact_product(motion(i, k), point[k]);
    return sum.high;
  };
  return {row(0), row(1), row(2)};
}

void move_image(std::optional<BodyImage>& image, const Eigen::Affine3d& motion) {
  if (!image) return;
  const double scale = scale_of(motion);
  image->voxel = motion.linear() * image->voxel;
  for (ImageCut& cut : image->cuts) {
    cut.normal = (motion.linear() * cut.normal).normalized();
    cut.offset_mm = scale * cut.offset_mm + cut.normal.dot(motion.translation());
  }
}

/// The body where its parts have it. What was known of a head or socket goes with the vertices that it lies on.
void pose_body(Body& body, BodyRole role, const UnposedBody& given, std::span<const PosedPart> parts,
               Side side) {
  const PartMotions groups(body, role, parts);
  const std::vector<Eigen::Affine3d> motions = groups.motions(parts, side);
  body.mesh = given.mesh;
  body.image = given.image;
  body.head = given.head;
  if (std::all_of(motions.begin(), motions.end(), moves_nothing)) return;
  if (given.head) {
    const Eigen::Affine3d& motion = motions[groups.group_on(given.mesh.vertices(), *given.head)];
    body.head = Sphere{motion * given.head->centre, scale_of(motion) * given.head->radius};
  }
  Points points = given.mesh.vertices();
  groups.move(motions, points);
  for (std::size_t v = 0; v < points.size(); ++v)
    if (!(points[v].cwiseAbs().maxCoeff() <= core::largest_coordinate))
      throw UsageError(body.name + ": vertex " + std::to_string(v) + ": its part moves it too far");
  body.mesh = given.mesh.moved_to(std::move(points));
  if (groups.is_whole()) move_image(body.image, motions.front());
  if (role == BodyRole::fixed) return;
  if (body.head) return keep_head(body.mesh, *body.head);
  const auto& fitted = fitted_head(given.mesh);
  if (fitted && groups.in_one_group(fitted->fit.vertices)) keep_head(body.mesh, fitted->fit.vertices);
}

}  // namespace

Eigen::Affine3d motion_of(const PosedPart& part, Side side) {
  Eigen::Matrix3d turns[3] = {Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity(),
                              Eigen::Matrix3d::Identity()};
  double scale = 1;
  Vec3 translation = Vec3::Zero();
  for (const PartParameter& parameter : part.parameters) {
    if (const auto axis = axis_of(parameter.kind))
      turns[*axis] = rotation_about(*axis, turn_of(parameter, part.body, side));
    else if (parameter.kind == ParameterKind::size)
      scale = parameter.value / parameter.as_given;
    else if (parameter.kind == ParameterKind::translation)
      translation += (parameter.value - parameter.as_given) * parameter.direction;
  }
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  const Eigen::Matrix3d R = parameter_of(part, ParameterKind::cup_inclination)
                                ? cup_turn(part, side)
                                : core::ordered_product(core::ordered_product(turns[0], turns[2]), turns[1]);
  motion.linear() = scale * R;
  if (!motion.linear().isIdentity(0))
    motion.translation() = part.centre - core::ordered_image(motion.linear(), part.centre);
  motion.translation() += translation;
  return motion;
}

bool moves_mesh(const PosedPart& part, BodyRole role, std::string_view mesh) noexcept {
  return part.body == role && (part.meshes.empty() ||
                               std::find(part.meshes.begin(), part.meshes.end(), mesh) != part.meshes.end());
}

Eigen::Affine3d motion_of_mesh(std::span<const PosedPart> parts, Side side, BodyRole role,
                               std::string_view mesh) {
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  for (const PosedPart& part : parts)
    if (moves_mesh(part, role, mesh)) motion = after(motion_of(part, side), motion);
  return motion;
}

PartMotions::PartMotions(const Body& body, BodyRole role, std::span<const PosedPart> parts) {
  const auto add = [&](const BodyPart* mesh, std::size_t first, std::size_t count) {
    std::vector<std::size_t> in;
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (moves_mesh(parts[p], role, mesh ? mesh->name : std::string_view())) in.push_back(p);
    auto group = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.parts == in; });
    if (group == groups_.end()) group = groups_.insert(groups_.end(), {std::move(in), {}});
    group->vertices.emplace_back(first, count);
  };
  if (body.parts.empty()) add(nullptr, 0, body.mesh.vertices().size());
  for (const BodyPart& mesh : body.parts) add(&mesh, mesh.first_vertex, mesh.vertices);
}

std::vector<Eigen::Affine3d> PartMotions::motions(std::span<const PosedPart> parts, Side side) const {
  std::vector<Eigen::Affine3d> motions;
  for (const Group& group : groups_) {
    Eigen::Affine3d motion = Eigen::Affine3d::Identity();
    for (const std::size_t p : group.parts) motion = after(motion_of(parts[p], side), motion);
    motions.push_back(motion);
  }
  return motions;
}

void PartMotions::move(std::span<const Eigen::Affine3d> motions, Points& points) const {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (moves_nothing(motions[g])) continue;
    for (const auto& [first, count] : groups_[g].vertices)
      for (std::size_t v = first; v < first + count; ++v) points.set(v, moved_by(motions[g], points[v]));
  }
}

std::size_t PartMotions::group_of(std::size_t vertex) const {
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (const auto& [first, count] : groups_[g].vertices)
      if (vertex - first < count) return g;
  return 0;
}

std::size_t PartMotions::group_on(const Points& points, const Sphere& sphere) const {
  // In parts of the radius: with cartilage between, bone lies at most this far from a head's sphere.
  constexpr double near = 0.2;
  std::vector<std::size_t> counts(groups_.size(), 0);
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (const auto& [first, count] : groups_[g].vertices)
      for (std::size_t v = first; v < first + count; ++v)
        counts[g] += std::abs((points[v] - sphere.centre).norm() - sphere.radius) <= near * sphere.radius;
  return static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

bool PartMotions::in_one_group(std::span<const Index> vertices) const {
  return std::all_of(vertices.begin(), vertices.end(),
                     [&](Index v) { return group_of(v) == group_of(vertices.front()); });
}

std::size_t uncertain_parameters(const Joint& joint) {
  std::size_t count = 0;
  if (joint.posed)
    for (const PosedPart& part : joint.posed->parts)
      for (const PartParameter& parameter : part.parameters) count += parameter.sigma > 0;
  // A joint has parts that move, or ligaments.
  for (const LigamentSigma& sigma : ligament_sigmas(joint)) count += sigma.numbers;
  return count;
}

DisplacedParts::DisplacedParts(const Joint& joint, BodyRole role)
    : parts_(joint.posed ? joint.posed->parts : std::vector<PosedPart>{}),
      side_(joint.side),
      groups_(role == BodyRole::fixed ? joint.fixed : joint.mobile, role, parts_),
      back_(groups_.motions(parts_, side_)) {
  for (Eigen::Affine3d& motion : back_) motion = motion.inverse();
}

std::vector<Eigen::Affine3d> DisplacedParts::motions(std::span<const double> standard_deviations) const {
  if (standard_deviations.empty()) return {};
  std::vector<PosedPart> displaced = parts_;
  std::size_t next = 0;
  for (PosedPart& part : displaced)
    for (PartParameter& parameter : part.parameters)
      if (parameter.sigma > 0) parameter.value += parameter.sigma * standard_deviations[next++];
  std::vector<Eigen::Affine3d> motions = groups_.motions(displaced, side_);
  const std::vector<Eigen::Affine3d> undisplaced = groups_.motions(parts_, side_);
  for (std::size_t g = 0; g < motions.size(); ++g)
    motions[g] = motions[g].matrix() == undisplaced[g].matrix() ? Eigen::Affine3d::Identity()
                                                                : Eigen::Affine3d(motions[g] * back_[g]);
  return motions;
}

void take_as_moved(Joint& joint) {
  if (!joint.posed) return;
  for (const BodyRole role : {BodyRole::fixed, BodyRole::mobile}) {
    const Body& body = role == BodyRole::fixed ? joint.fixed : joint.mobile;
    UnposedBody& given = role == BodyRole::fixed ? joint.posed->fixed : joint.posed->mobile;
    const PartMotions groups(body, role, joint.posed->parts);
    std::vector<Eigen::Affine3d> back = groups.motions(joint.posed->parts, joint.side);
    Points points = given.mesh.vertices();
    if (points.size() == body.mesh.vertices().size()) groups.move(back, points);
    const bool is_as_posed = points == body.mesh.vertices();
    for (Eigen::Affine3d& motion : back) motion = motion.inverse();
    if (!is_as_posed) {
      points = body.mesh.vertices();
      groups.move(back, points);
      given.mesh = body.mesh.moved_to(std::move(points));
    }
    if (!body.head) continue;
    const Eigen::Affine3d& motion = back[groups.group_on(body.mesh.vertices(), *body.head)];
    given.head = Sphere{motion * body.head->centre, scale_of(motion) * body.head->radius};
  }
}

void check_parts(std::span<const PosedPart> parts, const Body& fixed, const Body& mobile) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const PosedPart& part = parts[i];
    check_name(part.name, "part");
    const std::string where = "part " + part.name;
    for (std::size_t k = 0; k < i; ++k)
      if (parts[k].name == part.name) refuse(where, "is given twice");
    check_meshes(part, part.body == BodyRole::fixed ? fixed : mobile, where);
    if (!std::isfinite(part.centre.sum())) refuse(where, "centre: must be finite");
    check_parameters(part, where);
  }
}

void pose_parts(Joint& joint) {
  if (!joint.posed) return;
  pose_body(joint.fixed, BodyRole::fixed, joint.posed->fixed, joint.posed->parts, joint.side);
  pose_body(joint.mobile, BodyRole::mobile, joint.posed->mobile, joint.posed->parts, joint.side);
}

}  // namespace kinematics
}  // namespace condyle
