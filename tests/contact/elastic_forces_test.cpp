#include "condyle/pressure.hpp"
#include "contact/elastic_parts.hpp"
#include "support/cup.hpp"
#include "support/test.hpp"

/// Forces for a simulator, against closed forms, sums and differences.

namespace condyle::contact {
namespace {

using test::layer_of_stiffness;
using test::translated;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

struct ForceScene {
  std::string name;
  ElasticContact contact;
  Pose X_FM;
};

Pose pose_turned(double angle, const Vec3& axis, const Vec3& by) {
  Pose X = translated(by);
  X.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  return X;
}

/// A ball in a cup, its centre away from the origin of M.
ForceScene cup_scene(Casting casting, FaceRule rule) {
  const Vec3 centre_M(15, -20, 10);
  Pose X_MB = test::generic_turn();
  X_MB.translation() = centre_M;
  Pose X_FM = pose_turned(0.3, {1, -2, 1}, {});
  X_FM.translation() = Vec3(0.1, -0.4, 0.05) - X_FM.linear() * centre_M;
  return {"ball in cup",
          {test::cup(25, 4),
           posed(X_MB, test::sphere(Vec3::Zero(), 24.8, 4)),
           {.casting = casting, .rays = {.rule = rule}, .fixed = layer_of_stiffness(6.3)}},
          X_FM};
}
/// A slab tilted into a sheet, whose sides cut triangles. It grows narrower upwards.
ForceScene slab_in_sheet() {
  TriMesh slab = test::box({-4.1, 0, -3.3}, {4.3, 3, 3.7});
  for (std::size_t v = 0; v < slab.vertices.size(); ++v)
    if (slab.vertices.y[v] > 1) slab.vertices.x[v] *= 0.8, slab.vertices.z[v] *= 0.8;
  Pose X_FM = translated({0.31, 0.05, -0.17});
  X_FM.linear() =
      (Eigen::AngleAxisd(0.04, Vec3::UnitZ()) * Eigen::AngleAxisd(0.35, Vec3::UnitY())).toRotationMatrix();
  return {"slab in sheet",
          {test::plane(6, 23), slab, {.casting = Casting::fixed, .fixed = layer_of_stiffness(6)}},
          X_FM};
}
/// Deep in the ring some faces of the ball meet its rim.
ForceScene ball_in_ring(PressureLaw law, double height = 7.2) {
  return {"ball in ring",
          {test::torus(12, 6, 60, 40),
           test::sphere(Vec3::Zero(), 10, 4),
           {.law = law, .fixed = ElasticLayer{12, 0.42, 2.0}, .mobile = ElasticLayer{8, 0.45, 1.5}}},
          pose_turned(0.7, {1, 2, 3}, {0.2, -0.1, height})};
}
std::vector<ForceScene> all_scenes() {
  std::vector<ForceScene> scenes;
  for (const Casting casting : {Casting::fixed, Casting::mobile, Casting::both})
    for (const FaceRule rule : {FaceRule::cut_faces, FaceRule::face_centre})
      scenes.push_back(cup_scene(casting, rule));
  scenes.push_back(slab_in_sheet());
  scenes.push_back(ball_in_ring(PressureLaw::linear));
  scenes.push_back(ball_in_ring(PressureLaw::logarithmic));
  return scenes;
}

const RelativeMotion some_motion{{3, -2, 1.5}, {0.1, -0.2, 0.15}};

/// Adds up the forces on vertices of a body with the pose X_FB, in F, about the origin of M; and reports how large the terms are.
struct VertexSum {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};
VertexSum sum_of(const std::vector<VertexForce>& forces, const Mesh& mesh, const Pose& X_FB,
                 const Vec3& origin_M) {
  VertexSum sum;
  for (const VertexForce& each : forces) {
    const Vec3 force = X_FB.linear() * each.force_n;
    sum.force += force;
    sum.moment += Vec3(X_FB * mesh.vertices()[each.vertex] - origin_M).cross(force);
  }
  return sum;
}
void expect_sums(const ForceScene& scene, const ForceOptions& options) {
  const ContactForces found = scene.contact.forces(scene.X_FM, options);
  const Vec3 origin_M = scene.X_FM.translation();
  const VertexSum fixed = sum_of(found.on_fixed, scene.contact.fixed(), Pose::Identity(), origin_M),
                  mobile = sum_of(found.on_mobile, scene.contact.mobile(), scene.X_FM, origin_M);
  const auto& [force, moment] = found.on_mobile_body;
  ASSERT_GT(force.norm(), 0.1) << scene.name;
  EXPECT_LE((mobile.force - force).norm(), 1e-12 * force.norm()) << scene.name;
  EXPECT_LE((fixed.force + force).norm(), 1e-12 * force.norm()) << scene.name;
  EXPECT_LE((mobile.moment - moment).norm(), 1e-12 * moment.norm()) << scene.name;
  EXPECT_LE((fixed.moment + moment).norm(), 1e-12 * moment.norm()) << scene.name;
  for (const auto* list : {&found.on_fixed, &found.on_mobile})
    for (std::size_t i = 1; i < list->size(); ++i) EXPECT_LT((*list)[i - 1].vertex, (*list)[i].vertex);
}

TEST(ContactForces, AreThoseOfAt) {
  for (const ForceScene& scene : all_scenes()) {
    const auto at = scene.contact.at(scene.X_FM);
    const ContactForces found = scene.contact.forces(scene.X_FM);
    EXPECT_LE((found.on_mobile_body.force_n - at.on_mobile.force_n).norm(),
              1e-13 * at.on_mobile.force_n.norm())
        << scene.name;
    EXPECT_LE((found.on_mobile_body.moment_nmm - at.on_mobile.moment_nmm).norm(),
              1e-13 * at.on_mobile.moment_nmm.norm())
        << scene.name;
    EXPECT_NEAR(found.energy_nmm, at.energy_nmm, 1e-13 * at.energy_nmm);
    EXPECT_TRUE(found.on_fixed.empty() && found.on_mobile.empty() && found.patches.empty());
    EXPECT_EQ(found.factor, 1);
  }
}

TEST(ContactForces, OfVerticesAddUpToTheWrench) {
  for (const ForceScene& scene : all_scenes()) {
    expect_sums(scene, {.vertex_forces = true});
    expect_sums(scene, {.motion = some_motion,
                        .friction = 0.3,
                        .damping_s_per_mm = 0.1,
                        .factor = 0.7,
                        .vertex_forces = true});
  }
}

TEST(ContactForces, OfVerticesAddUpWhereTrianglesAreNarrow) {
  // A column of the target's vertices lies 0.5 micrometres beside the next, and rays end between the two.
  TriMesh sheet = test::flipped(test::plane(4, 4));
  for (std::size_t v = 0; v < sheet.vertices.size(); ++v)
    if (sheet.vertices.x[v] == 0) sheet.vertices.x[v] = 2 - 0.0005;
  const ForceScene scene{
      "narrow",
      {test::plane(6, 24), sheet, {.casting = Casting::fixed, .fixed = layer_of_stiffness(6)}},
      translated({0.00025, -0.3, 0.1})};
  expect_sums(scene, {.motion = some_motion, .friction = 0.3, .vertex_forces = true});
  const ContactForces found =
      scene.contact.forces(scene.X_FM, {.motion = some_motion, .friction = 0.3, .vertex_forces = true});
  const double whole = found.on_mobile_body.force_n.norm();
  for (const VertexForce& each : found.on_mobile) EXPECT_LT(each.force_n.norm(), whole);
}

/// The wrench after a small motion about the origin of M.
Vec6 wrench_after(const ForceScene& scene, const Vec6& by) {
  Pose X = scene.X_FM;
  X.translation() += by.head<3>();
  if (const double angle = by.tail<3>().norm(); angle > 0)
    X.linear() = Eigen::AngleAxisd(angle, by.tail<3>() / angle) * X.linear();
  const Wrench wrench = scene.contact.forces(X).on_mobile_body;
  Vec6 both;
  both << wrench.force_n, wrench.moment_nmm;
  return both;
}
void expect_stiffness(const ForceScene& scene) {
  const Mat6 stiffness = scene.contact.forces(scene.X_FM, {.stiffness = true}).stiffness;
  for (int i = 0; i < 6; ++i) {
    // Rays that pass from one triangle to the next within a step change the rate of their depth: small steps, few rays.
    // Rounding is some 1e-13 of 100 N.
    const double step = i < 3 ? 1e-6 : 5e-8;
    const Vec6 by = step * Vec6::Unit(i);
    const Vec6 measured = -(wrench_after(scene, by) - wrench_after(scene, -by)) / (2 * step);
    const Vec6 apart = measured - stiffness.col(i);
    EXPECT_LE(apart.head<3>().norm(), 1e-6 * measured.head<3>().norm()) << scene.name << " " << i;
    EXPECT_LE(apart.tail<3>().norm(), 1e-6 * measured.tail<3>().norm()) << scene.name << " " << i;
  }
}

TEST(ContactForces, StiffnessIsThatOfDifferences) {
  for (const Casting casting : {Casting::fixed, Casting::mobile, Casting::both})
    for (const FaceRule rule : {FaceRule::cut_faces, FaceRule::face_centre})
      expect_stiffness(cup_scene(casting, rule));
  expect_stiffness(slab_in_sheet());
  expect_stiffness(ball_in_ring(PressureLaw::linear, 10));
}

TEST(ContactForces, StiffnessIsNearlyThatOfDifferencesAtRimsOfCurvedBodies) {
  // Depths of a face that a rim cuts are taken to run on, and are mixed from the corners of the part in contact: as that changes
  // its shape the mixture changes, which no derivative knows.
  const ForceScene scene = ball_in_ring(PressureLaw::linear);
  ASSERT_GT(scene.contact.at(scene.X_FM).mobile->rim_faces, 50u);
  const Mat6 stiffness = scene.contact.forces(scene.X_FM, {.stiffness = true}).stiffness;
  Mat6 measured;
  for (int i = 0; i < 6; ++i) {
    const Vec6 by = 1e-6 * Vec6::Unit(i);
    measured.col(i) = -(wrench_after(scene, by) - wrench_after(scene, -by)) / 2e-6;
  }
  // With turns about arms of 10 mm, as the ball has, all is in N / mm.
  Vec6 unit;
  unit << Vec3::Ones(), Vec3::Constant(0.1);
  const Mat6 apart = unit.asDiagonal() * (stiffness - measured) * unit.asDiagonal();
  const Mat6 whole = unit.asDiagonal() * measured * unit.asDiagonal();
  EXPECT_LE(apart.norm(), 1e-3 * whole.norm());
}

TEST(ContactForces, StiffnessIsThatOfBalanceWhereLoadsStayInPlace) {
  const ForceScene scene = slab_in_sheet();
  ElasticContact::Parts::Answers answers;
  scene.contact.parts().answer(scene.X_FM, answers);
  Mat6 held = scene.contact.parts().change_of(answers, scene.X_FM, Motions::all);
  const ContactForces found = scene.contact.forces(scene.X_FM, {.stiffness = true});
  // The origin of M is carried along, away from the loads: a moment of F x s.
  const Vec3 f = found.on_mobile_body.force_n;
  for (int i = 0; i < 3; ++i) held.col(i).tail<3>() += f.cross(Vec3(Vec3::Unit(i)));
  EXPECT_LE((found.stiffness + held).norm(), 1e-10 * held.norm());
}

TEST(ContactForces, PushAsTheEnergyOfAFlatFoundationFalls) {
  // The depth of a flat casting surface falls by 1 for each mm along its normal, whatever it meets.
  const ElasticContact contact(test::plane(9, 40),
                               posed(test::generic_turn(), test::sphere({1, 2, 3}, 24, 5)),
                               {.casting = Casting::fixed, .fixed = layer_of_stiffness(10)});
  Pose X_FM = pose_turned(0.4, {3, -1, 2}, {});
  X_FM.translation() = Vec3(0.3, 23.2, -0.2) - X_FM.linear() * (test::generic_turn() * Vec3(1, 2, 3));
  const double step = 1e-5;
  const auto energy = [&](double up) {
    Pose X = X_FM;
    X.translation().y() += up;
    return contact.forces(X).energy_nmm;
  };
  const double force = contact.forces(X_FM).on_mobile_body.force_n.y();
  ASSERT_GT(force, 100);
  EXPECT_NEAR(-(energy(step) - energy(-step)) / (2 * step), force, 1e-6 * force);
}

/// F = K pi d^2 (3 R - d) / 3, and E its integral: a sphere pressed by d into a plane layer.
struct SphereOnLayer {
  double R = 24, K = 10;

  double force(double d) const { return d > 0 ? K * std::numbers::pi * d * d * (3 * R - d) / 3 : 0; }
  double stiffness(double d) const { return K * std::numbers::pi * d * (2 * R - d); }
  double energy(double d) const { return d > 0 ? K * std::numbers::pi * d * d * d * (R / 3 - d / 12) : 0; }
  ElasticContact contact(double half, int n, int levels) const {
    return {test::plane(half, n),
            posed(test::generic_turn(), test::sphere(Vec3::Zero(), R, levels)),
            {.casting = Casting::fixed, .fixed = layer_of_stiffness(K)}};
  }
};

struct Height {
  double y, v;
};
/// Runge and Kutta's step of order 4.
Height stepped(const Height& s, double dt, const auto& acceleration) {
  const auto rate = [&](const Height& at) { return Height{at.v, acceleration(at.y, at.v)}; };
  const auto plus = [](const Height& a, double by, const Height& b) {
    return Height{a.y + by * b.y, a.v + by * b.v};
  };
  const Height a = rate(s), b = rate(plus(s, dt / 2, a)), c = rate(plus(s, dt / 2, b)),
               d = rate(plus(s, dt, c));
  return {s.y + dt / 6 * (a.y + 2 * b.y + 2 * c.y + d.y), s.v + dt / 6 * (a.v + 2 * b.v + 2 * c.v + d.v)};
}

TEST(ContactForces, CarryASphereThatOscillatesAsItsClosedFormSays) {
  const SphereOnLayer known;
  const ElasticContact contact = known.contact(14, 200, 7);
  // Kilograms: N / kg are 1000 mm/s^2. The weight presses it in by 4 mm.
  const double depth = 4, mass = 2, weight = known.force(depth);
  ContactForces forces;
  const auto push = [&](double y) {
    contact.forces(translated({0, y, 0}), {}, forces);
    return forces.on_mobile_body.force_n.y();
  };
  const double amplitude = 0.02, rest = known.R - depth;
  const double period = 2 * std::numbers::pi * std::sqrt(mass / (1000 * known.stiffness(depth)));
  const double dt = period / 24;
  Height state{rest + amplitude, 0};
  const auto energy = [&] {
    push(state.y);
    return forces.energy_nmm + weight * state.y + mass * state.v * state.v / 2000;
  };
  const double at_first = energy();
  EXPECT_NEAR(forces.energy_nmm, known.energy(depth - amplitude), 1e-3 * known.energy(depth - amplitude));
  std::vector<double> downwards;  // times at which it passes the middle
  std::vector<Height> path{state};
  for (int i = 0; i < 60; ++i) {
    state = stepped(state, dt, [&](double y, double) { return 1000 * (push(y) - weight) / mass; });
    path.push_back(state);
  }
  // Energy is kept: of what oscillates, k a^2 / 2, to a thousandth.
  const double oscillating = known.stiffness(depth) * amplitude * amplitude / 2;
  EXPECT_NEAR(energy(), at_first, 1e-3 * oscillating);
  // The velocity changes its sign at each turn.
  for (std::size_t i = 1; i + 1 < path.size(); ++i)
    if (path[i].v < 0 && path[i + 1].v >= 0)
      downwards.push_back(dt * (static_cast<double>(i) + path[i].v / (path[i].v - path[i + 1].v)));
  ASSERT_EQ(downwards.size(), 2u);
  // Halves of an oscillation differ by (a k' / k)^2 / 24 or so: 1e-5.
  EXPECT_NEAR(downwards[1] - downwards[0], period, 1e-3 * period);
}

TEST(ContactForces, BounceASphereBackToTheHeightItWasDroppedFrom) {
  const SphereOnLayer known;
  const ElasticContact contact = known.contact(9, 90, 7);
  const double mass = 2, weight = 2 * 9.81, drop = 5;
  ContactForces forces;
  const auto acceleration = [&](double y, double) {
    contact.forces(translated({0, y, 0}), {}, forces);
    return 1000 * (forces.on_mobile_body.force_n.y() - weight) / mass;
  };
  Height state{known.R + drop, 0};
  double deepest = 0;
  while (state.y <= known.R || state.v <= 0) {
    // A step in the air is exact at any length; one in contact goes 0.03 mm at most.
    const double dt = state.y > known.R + 0.3 ? 5e-4 : 1e-4;
    state = stepped(state, dt, acceleration);
    deepest = std::max(deepest, known.R - state.y);
    ASSERT_LT(deepest, 2);
  }
  const double highest = state.y + state.v * state.v / (2 * 9810.0);
  EXPECT_NEAR(highest - known.R, drop, 1e-3 * drop);
  // Deepest where the layers hold what it fell by.
  double lower = 0, upper = 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (lower + upper) / 2;
    (known.energy(middle) < weight * (drop + middle) ? lower : upper) = middle;
  }
  // Faces of the sphere sag by 0.0008 mm, and those of the plane by as much.
  EXPECT_NEAR(deepest, lower, 0.0015);
}

/// A block of 10 by 10 mm pressed by 0.3 mm into a layer of 6 MPa per mm.
struct Block {
  ElasticContact contact;
  double N = 6 * 0.3 * 100;
  Pose X_FM = translated({0, -0.3, 0});
};
Block pressed_block(Casting casting = Casting::mobile) {
  return {{test::box({-40, -10, -40}, {40, 0, 40}),
           test::box({-3, 0, -6}, {7, 5, 4}),
           {.casting = casting, .fixed = layer_of_stiffness(6)}}};
}

TEST(ContactForces, FrictionOfASlidingBlockHasItsClosedForm) {
  const Block on = pressed_block();
  for (const double speed : {1e-3, 0.5, 2.0, 40.0}) {
    const double slip = 0.8, mu = 0.25;
    // Moving into the layer at the same time rubs no more.
    const Vec3 along(0.6, 0, -0.8), v = speed * along + Vec3(0, -7, 0);
    const ContactForces found = on.contact.forces(
        on.X_FM,
        {.motion = {.velocity_mm_s = v}, .friction = mu, .slip_velocity_mm_s = slip, .vertex_forces = true});
    const double expected = mu * on.N * speed / std::hypot(speed, slip);
    const Vec3 force = found.on_mobile_body.force_n;
    EXPECT_NEAR(force.dot(along), -expected, 1e-12 * expected);
    EXPECT_NEAR(force.y(), on.N, 1e-12 * on.N);
    EXPECT_NEAR(found.friction_power, expected * speed, 1e-12 * expected * speed);
    EXPECT_EQ(found.damping_power, 0);
    expect_sums({"block", pressed_block().contact, on.X_FM},
                {.motion = {.velocity_mm_s = v}, .friction = mu, .vertex_forces = true});
  }
}

TEST(ContactForces, ATurningBlockIsBrakedByAMoment) {
  // Far above the slip velocity friction is mu p everywhere: a moment of mu p times the mean distance from the axis of a
  // square of side a, a^3 (sqrt 2 + asinh 1) / 6. The faces' four-point sums miss that by little.
  const ElasticContact contact(test::plane(5, 40), test::box({-5, 0, -5}, {5, 5, 5}),
                               {.casting = Casting::fixed, .fixed = layer_of_stiffness(6)});
  const ContactForces found = contact.forces(
      translated({0, -0.3, 0}),
      {.motion = {.angular_velocity_rad_s = {0, 5, 0}}, .friction = 0.1, .slip_velocity_mm_s = 1e-6});
  const double expected = 0.1 * 6 * 0.3 * 1000 * (std::sqrt(2.0) + std::asinh(1.0)) / 6;
  EXPECT_NEAR(found.on_mobile_body.moment_nmm.y(), -expected, 1e-3 * expected);
  EXPECT_NEAR(found.friction_power, 5 * expected, 5e-3 * expected);
}

TEST(ContactForces, DampingTakesThePowerOfItsClosedForm) {
  for (const Casting casting : {Casting::mobile, Casting::both}) {
    const Block on = pressed_block(casting);
    const double c = 0.05;
    for (const double down : {0.0, 3.0, 10.0, -4.0, -30.0}) {
      const ContactForces found =
          on.contact.forces(on.X_FM, {.motion = {.velocity_mm_s = {2, -down, 1}}, .damping_s_per_mm = c});
      const double whole = on.contact.at(on.X_FM).on_mobile.force_n.y();
      const double times = std::max(0.0, 1 + c * down);
      EXPECT_NEAR(found.on_mobile_body.force_n.y(), times * whole, 1e-12 * whole);
      EXPECT_NEAR(found.damping_power, (times - 1) * whole * down, 1e-11 * whole);
      EXPECT_GE(found.damping_power, 0);
    }
  }
}

TEST(ContactForces, AllPowerThatFlatBodiesLoseIsFriction) {
  // What pushes against the motion either fills the layers or is lost.
  const Block on = pressed_block();
  const ForceOptions options{
      .motion = {.velocity_mm_s = {3, -2, 1}}, .friction = 0.2, .damping_s_per_mm = 0.03};
  const ContactForces found = on.contact.forces(on.X_FM, options);
  const double in = -found.on_mobile_body.force_n.dot(options.motion.velocity_mm_s), stored = on.N * 2;
  EXPECT_NEAR(in, stored + found.friction_power + found.damping_power, 1e-11 * in);
}

/// Rows of the stiffness of vertices times a translation of all vertices of one body, in its own frame.
std::vector<Vec3> times(const ContactForces& found, bool mobile, const Vec3& by) {
  std::vector<Vec3> rows(found.on_fixed.size() + found.on_mobile.size(), Vec3::Zero());
  for (const VertexStiffness& each : found.vertex_stiffness)
    if ((each.column >= found.on_fixed.size()) == mobile) rows[each.row] += each.block * by;
  return rows;
}

TEST(VertexStiffness, OnTheCastingBodyIsThatOfDifferencesWhateverTheTarget) {
  // With the casting body in its place, translations of the target change depths and no more.
  const ForceScene scene = cup_scene(Casting::fixed, FaceRule::cut_faces);
  const ContactForces found = scene.contact.forces(scene.X_FM, {.stiffness = true, .vertex_stiffness = true});
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double step = 1e-6;
    const auto forces_at = [&](double by) {
      Pose X = scene.X_FM;
      X.translation()[axis] += by;
      return scene.contact.forces(X, {.vertex_forces = true});
    };
    const ContactForces above = forces_at(step), below = forces_at(-step);
    const auto rows = times(found, true, scene.X_FM.linear().transpose() * Vec3::Unit(axis));
    for (const Vec3& row : rows) largest = std::max(largest, row.norm());
    ASSERT_EQ(above.on_fixed.size(), found.on_fixed.size());
    Vec3 on_mobile = Vec3::Zero();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i >= found.on_fixed.size()) {
        on_mobile += scene.X_FM.linear() * rows[i];
        continue;
      }
      const Vec3 measured = -(above.on_fixed[i].force_n - below.on_fixed[i].force_n) / (2 * step);
      EXPECT_LE((rows[i] - measured).norm(), 1e-6 * largest) << axis << " " << i;
    }
    // And all of the mobile body's vertices have the stiffness of the body.
    EXPECT_LE((on_mobile - found.stiffness.col(axis).head<3>()).norm(), 1e-9 * on_mobile.norm());
  }
}

/// A flat sheet over a flat one, the upper tilted: rays run straight down from the lower.
struct Sheets {
  TriMesh upper;
  Pose X_FM;
  double K = 6;

  ElasticContact contact() const {
    return {test::plane(6, 24), upper, {.casting = Casting::fixed, .fixed = layer_of_stiffness(K)}};
  }
};
Sheets sheets(double height = -0.4) {
  Pose X_FM = pose_turned(0.03, {2, 0, 1}, {0.1, height, 0.13});
  X_FM.linear() = X_FM.linear() * Eigen::AngleAxisd(0.5, Vec3::UnitY()).toRotationMatrix();
  return {test::flipped(test::plane(4, 3)), X_FM};
}

TEST(VertexStiffness, OfAWholeBodyIsThatOfDifferencesBetweenPlanes) {
  // Along the rays of a flat casting surface all that is held stays as it is, also where the depth is 0.
  for (const double height : {-0.4, -0.03}) {
    const Sheets of_sheets = sheets(height);
    const ForceScene scene{"sheets", of_sheets.contact(), of_sheets.X_FM};
    const ContactForces found = scene.contact.forces(scene.X_FM, {.vertex_stiffness = true});
    ASSERT_FALSE(found.on_mobile.empty());
    const double step = 1e-5;
    const auto forces_at = [&](double up) {
      Pose X = scene.X_FM;
      X.translation().y() += up;
      return scene.contact.forces(X, {.vertex_forces = true});
    };
    const ContactForces above = forces_at(step), below = forces_at(-step);
    ASSERT_EQ(above.on_fixed.size(), found.on_fixed.size());
    ASSERT_EQ(below.on_mobile.size(), found.on_mobile.size());
    const auto with_mobile = times(found, true, scene.X_FM.linear().transpose() * Vec3::UnitY());
    const auto with_fixed = times(found, false, Vec3::UnitY());
    double largest = 0;
    for (const Vec3& row : with_mobile) largest = std::max(largest, row.norm());
    for (std::size_t i = 0; i < with_mobile.size(); ++i) {
      const std::size_t fixed = found.on_fixed.size();
      const auto of = [&](const ContactForces& at) {
        return i < fixed ? at.on_fixed[i].force_n : at.on_mobile[i - fixed].force_n;
      };
      const Vec3 measured = -(of(above) - of(below)) / (2 * step);
      EXPECT_LE((with_mobile[i] - measured).norm(), 1e-6 * largest) << i;
      EXPECT_LE((with_fixed[i] + measured).norm(), 1e-6 * largest) << i;
    }
  }
}

TEST(VertexStiffness, OfAVertexOfTheTargetIsThatOfDifferences) {
  const Sheets of = sheets();
  const ContactForces found = of.contact().forces(of.X_FM, {.vertex_stiffness = true});
  ASSERT_EQ(found.on_mobile.size(), 16u);
  // Along the rays what is met stays what it is, with the shares of the vertices.
  const Vec3 along = of.X_FM.linear().transpose() * Vec3::UnitY();
  const double step = 1e-5;
  const std::size_t fixed = found.on_fixed.size();
  for (const Index vertex : {5u, 6u, 9u, 0u}) {
    const auto forces_with = [&](double by) {
      Sheets moved = of;
      const Vec3 to = of.upper.vertices[vertex] + by * along;
      moved.upper.vertices.x[vertex] = to.x();
      moved.upper.vertices.y[vertex] = to.y();
      moved.upper.vertices.z[vertex] = to.z();
      return moved.contact().forces(of.X_FM, {.vertex_forces = true});
    };
    const ContactForces above = forces_with(step), below = forces_with(-step);
    std::vector<Vec3> rows(fixed + found.on_mobile.size(), Vec3::Zero());
    for (const VertexStiffness& each : found.vertex_stiffness)
      if (each.column == fixed + vertex) rows[each.row] += each.block * along;
    double largest = 0;
    for (const Vec3& row : rows) largest = std::max(largest, row.norm());
    ASSERT_GT(largest, 1);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto on = [&](const ContactForces& at) {
        return i < fixed ? at.on_fixed[i].force_n : at.on_mobile[i - fixed].force_n;
      };
      EXPECT_LE((rows[i] + (on(above) - on(below)) / (2 * step)).norm(), 1e-6 * largest)
          << vertex << " " << i;
    }
  }
}

TEST(VertexStiffness, OfAVertexThatCastsIsThatOfItsRay) {
  const Sheets of = sheets();
  const ElasticContact contact = of.contact();
  const ContactForces found = contact.forces(of.X_FM, {.vertex_stiffness = true});
  const Mesh& lower = contact.fixed();
  const Vec3 m = of.X_FM.linear() * Vec3(0, -1, 0), a = of.X_FM.translation();
  // The integral of the products of shares over a triangle is A / 12 for two corners and A / 6 for one.
  const auto on_vertices = [&](const Points& starts) {
    std::map<Index, double> pressed;
    for (const Triangle& t : lower.triangles())
      for (const Index i : t)
        for (const Index k : t) {
          const double depth = Vec3(a - starts[k]).dot(m) / Vec3(0, -1, 0).dot(m);
          const double area = 0.5 * 0.5 * 0.5;
          pressed[i] += of.K * area * (i == k ? 2 : 1) / 12 * depth;
        }
    return pressed;
  };
  const Index middle = 12 * 25 + 12;
  for (int axis = 0; axis < 3; ++axis) {
    Points above = lower.vertices(), below = lower.vertices();
    const double step = 1e-5;
    auto& coordinate = axis == 0 ? above.x : axis == 1 ? above.y : above.z;
    auto& other = axis == 0 ? below.x : axis == 1 ? below.y : below.z;
    coordinate[middle] += step, other[middle] -= step;
    auto up = on_vertices(above), down = on_vertices(below);
    int compared = 0;
    for (const VertexStiffness& each : found.vertex_stiffness) {
      if (each.column >= found.on_fixed.size() || found.on_fixed[each.column].vertex != middle ||
          each.row >= found.on_fixed.size())
        continue;
      const Index row = found.on_fixed[each.row].vertex;
      // The fixed body is pressed down.
      const Vec3 measured = Vec3(0, 1, 0) * (up[row] - down[row]) / (2 * step);
      EXPECT_LE((each.block.col(axis) - measured).norm(), 1e-6 * std::max(measured.norm(), 1e-3))
          << axis << " " << row;
      ++compared;
    }
    EXPECT_EQ(compared, 7) << "the vertex and its six neighbours";
  }
}

TEST(VertexStiffness, HasEachPairOnceInOrder) {
  const ForceScene scene = ball_in_ring(PressureLaw::linear);
  const ContactForces found = scene.contact.forces(scene.X_FM, {.vertex_stiffness = true});
  ASSERT_GT(found.vertex_stiffness.size(), 100u);
  for (std::size_t i = 1; i < found.vertex_stiffness.size(); ++i) {
    const auto &a = found.vertex_stiffness[i - 1], &b = found.vertex_stiffness[i];
    EXPECT_TRUE(a.row < b.row || (a.row == b.row && a.column < b.column)) << i;
  }
  EXPECT_LT(found.vertex_stiffness.back().row, found.on_fixed.size() + found.on_mobile.size());
}

TEST(ContactForces, PatchesAreThoseOfEachBall) {
  const ElasticContactOptions options{.casting = Casting::fixed, .fixed = layer_of_stiffness(10)};
  const TriMesh near = test::sphere({-6, 4.7, 0}, 5, 5), far = test::sphere({6, 4.5, 1}, 5, 5);
  const ElasticContact pair(test::plane(16, 120), test::joined(near, far), options);
  const ContactForces found = pair.forces(Pose::Identity(), {.factor = 0.5, .patches = true});
  ASSERT_EQ(found.patches.size(), 2u);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (const ForcePatch& patch : found.patches) {
    const bool is_left = patch.centre_of_pressure.x() < 0;
    const auto alone =
        ElasticContact(test::plane(16, 120), is_left ? near : far, options).at(Pose::Identity());
    const ContactTotals& totals = alone.fixed->totals;
    EXPECT_EQ(patch.casting, BodyRole::fixed);
    EXPECT_EQ(patch.faces, totals.triangles);
    const auto faces = found.faces_of(patch);
    ASSERT_EQ(faces.size(), alone.fixed->faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) EXPECT_EQ(faces[i], alone.fixed->faces[i].face);
    EXPECT_NEAR(patch.area_mm2, totals.area_mm2, 1e-12 * totals.area_mm2);
    EXPECT_NEAR(patch.max_pressure_mpa, 0.5 * totals.max_pressure_mpa, 1e-12);
    EXPECT_NEAR(patch.load_n, 0.5 * totals.force_n.norm(), 1e-9);
    EXPECT_LE((patch.centre_of_pressure - *totals.centre_of_pressure).norm(), 1e-9);
    EXPECT_LE((patch.on_mobile_body.force_n + 0.5 * totals.force_n).norm(), 1e-9);
    force += patch.on_mobile_body.force_n, moment += patch.on_mobile_body.moment_nmm;
  }
  EXPECT_LE((force - found.on_mobile_body.force_n).norm(), 1e-12 * force.norm());
  EXPECT_LE((moment - found.on_mobile_body.moment_nmm).norm(), 1e-12 * moment.norm());
}

TEST(ContactForces, AFactorMultipliesAllThatIsElastic) {
  const ForceScene scene = ball_in_ring(PressureLaw::logarithmic);
  const ForceOptions all{.vertex_forces = true, .stiffness = true, .vertex_stiffness = true, .patches = true};
  ForceOptions part = all;
  part.factor = 0.3;
  const ContactForces whole = scene.contact.forces(scene.X_FM, all),
                      some = scene.contact.forces(scene.X_FM, part);
  EXPECT_EQ(some.factor, 0.3);
  EXPECT_NEAR(some.energy_nmm, 0.3 * whole.energy_nmm, 1e-12 * whole.energy_nmm);
  EXPECT_LE((some.on_mobile_body.force_n - 0.3 * whole.on_mobile_body.force_n).norm(),
            1e-12 * whole.on_mobile_body.force_n.norm());
  EXPECT_LE((some.stiffness - 0.3 * whole.stiffness).norm(), 1e-12 * whole.stiffness.norm());
  ASSERT_EQ(some.vertex_stiffness.size(), whole.vertex_stiffness.size());
  for (std::size_t i = 0; i < some.vertex_stiffness.size(); ++i)
    EXPECT_LE((some.vertex_stiffness[i].block - 0.3 * whole.vertex_stiffness[i].block).norm(), 1e-9);
  part.factor = 0;
  const ContactForces none = scene.contact.forces(scene.X_FM, part);
  EXPECT_EQ(none.on_mobile_body.force_n, Vec3(Vec3::Zero()));
  ASSERT_FALSE(none.patches.empty());
  EXPECT_EQ(none.patches[0].centre_of_pressure, none.patches[0].centre_of_area);
}

TEST(ContactRamp, BringsInWhatOverlapsSmoothly) {
  const Block on = pressed_block();
  const ContactRamp ramp(on.contact, on.X_FM, 0.2);
  EXPECT_TRUE(ramp.has_overlap());
  EXPECT_NEAR(ramp.max_depth_mm(), 0.3, 1e-12);
  EXPECT_NEAR(ramp.energy_nmm(), on.N * 0.3 / 2, 1e-10);
  EXPECT_EQ(ramp.factor_at(-1), 0);
  EXPECT_EQ(ramp.factor_at(0), 0);
  EXPECT_EQ(ramp.factor_at(0.1), 0.5);
  EXPECT_EQ(ramp.factor_at(0.2), 1);
  EXPECT_EQ(ramp.factor_at(7), 1);
  const double h = 1e-6;
  for (int i = 0; i < 100; ++i) {
    const double t = 0.002 * i, s = t / 0.2;
    EXPECT_LE(ramp.factor_at(t), ramp.factor_at(t + 0.002));
    EXPECT_NEAR((ramp.factor_at(t + h) - ramp.factor_at(t - h)) / (2 * h), 6 * s * (1 - s) / 0.2, 1e-4);
  }
  const ContactRamp apart(on.contact, translated({0, 0.1, 0}), 0.2);
  EXPECT_FALSE(apart.has_overlap());
  for (const double t : {-1.0, 0.0, 0.1, 1.0}) EXPECT_EQ(apart.factor_at(t), 1);
}

TEST(ContactForces, AStepKeepsTheMemoryOfTheLast) {
  const ForceScene scene = ball_in_ring(PressureLaw::linear);
  const ForceOptions all{.vertex_forces = true, .stiffness = true, .vertex_stiffness = true, .patches = true};
  ContactForces forces;
  scene.contact.forces(scene.X_FM, all, forces);
  const ContactForces first = forces;
  const auto* vertices = forces.on_fixed.data();
  const auto* blocks = forces.vertex_stiffness.data();
  const auto* patches = forces.patches.data();
  scene.contact.forces(translated({100, 0, 0}), all, forces);
  EXPECT_TRUE(forces.on_fixed.empty() && forces.on_mobile.empty() && forces.vertex_stiffness.empty() &&
              forces.patches.empty() && forces.patch_faces.empty());
  EXPECT_TRUE(forces.stiffness.isZero(0));
  scene.contact.forces(scene.X_FM, all, forces);
  EXPECT_EQ(forces.on_fixed.data(), vertices);
  EXPECT_EQ(forces.vertex_stiffness.data(), blocks);
  EXPECT_EQ(forces.patches.data(), patches);
  EXPECT_EQ(forces.on_mobile_body.force_n, first.on_mobile_body.force_n);
  ASSERT_EQ(forces.vertex_stiffness.size(), first.vertex_stiffness.size());
  for (std::size_t i = 0; i < first.vertex_stiffness.size(); ++i)
    EXPECT_EQ(forces.vertex_stiffness[i].block, first.vertex_stiffness[i].block);
}

TEST(ContactForces, AfterAnUpdateAreThoseOfAContactMadeAnew) {
  const ForceOptions all{.vertex_forces = true, .stiffness = true, .vertex_stiffness = true, .patches = true};
  ForceScene scene = ball_in_ring(PressureLaw::linear);
  scene.contact.forces(scene.X_FM, all);
  TriMesh ball = scene.contact.mobile();
  for (std::size_t v = 0; v < ball.vertices.size(); ++v) ball.vertices.z[v] *= 1.01;
  scene.contact.update(BodyRole::mobile, ball.vertices);
  const ContactForces found = scene.contact.forces(scene.X_FM, all);
  const ContactForces anew =
      ElasticContact(scene.contact.fixed(), ball, scene.contact.options()).forces(scene.X_FM, all);
  EXPECT_EQ(found.on_mobile_body.force_n, anew.on_mobile_body.force_n);
  EXPECT_EQ(found.stiffness, anew.stiffness);
  ASSERT_EQ(found.on_mobile.size(), anew.on_mobile.size());
  for (std::size_t i = 0; i < found.on_mobile.size(); ++i)
    EXPECT_EQ(found.on_mobile[i].force_n, anew.on_mobile[i].force_n);
  EXPECT_EQ(found.vertex_stiffness.size(), anew.vertex_stiffness.size());
  EXPECT_EQ(found.patch_faces, anew.patch_faces);
}

TEST(ContactForces, OptionsOutsideTheirDomainAreRefusedInOneLine) {
  const Block on = pressed_block();
  const double nan = std::nan(""), infinite = HUGE_VAL;
  const auto refused = [&](const ForceOptions& options, const std::string& says) {
    try {
      on.contact.forces(on.X_FM, options);
      ADD_FAILURE() << says;
    } catch (const UsageError& error) {
      EXPECT_EQ(error.what(), says);
    }
  };
  for (const double wrong : {-1e-9, nan, infinite}) {
    refused({.friction = wrong}, "the coefficient of friction must be 0 or more");
    refused({.damping_s_per_mm = wrong}, "the damping must be 0 s/mm or more");
  }
  for (const double wrong : {0.0, -1.0, nan, infinite})
    refused({.slip_velocity_mm_s = wrong}, "the slip velocity must be above 0 mm/s");
  for (const double wrong : {-0.1, 1.0001, nan}) refused({.factor = wrong}, "the factor must be from 0 to 1");
  refused({.motion = {.velocity_mm_s = {nan, 0, 0}}}, "the velocity must be finite");
  refused({.motion = {.angular_velocity_rad_s = {0, infinite, 0}}}, "the angular velocity must be finite");
  for (const double wrong : {0.0, -1.0, nan, infinite})
    EXPECT_THROW(ContactRamp(on.contact, on.X_FM, wrong), UsageError);
  Pose broken = on.X_FM;
  broken.translation().x() = nan;
  EXPECT_THROW(on.contact.forces(broken), UsageError);
}

}  // namespace
}  // namespace condyle::contact
