// Condyle's elastic contact as a force element of Simbody.
//
//     simbody_contact                                a ball bounces on a flat layer: period and energy beside the closed form
//     simbody_contact KNEE.toml STATES.sto           a knee comes to rest under a load, where balance() says that it does
#include <chrono>
#include <cmath>
#include <condyle/condyle.hpp>
#include <condyle/io/joint_file.hpp>
#include <condyle/io/recorded_motion.hpp>
#include <cstdio>
#include <exception>
#include <numbers>

#include "shapes.hpp"
#include "simbody_bodies.hpp"

namespace {

using condyle::Pose;
using condyle::Vec3;
using condyle::contact::ElasticContact;

Pose pose_of(const examples::PoseRows& rows) {
  Pose X = Pose::Identity();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 4; ++k) X.matrix()(i, k) = rows[std::size_t(i)][std::size_t(k)];
  return X;
}

examples::PoseRows rows_of(const Pose& X) {
  examples::PoseRows rows;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 4; ++k) rows[std::size_t(i)][std::size_t(k)] = X.matrix()(i, k);
  return rows;
}

std::array<double, 3> array_of(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// The whole force element: fixed body on ground, mobile body on the one that moves.
auto load_of(const ElasticContact& contact) {
  return [&contact](const examples::PoseRows& X_FM) {
    const auto found = contact.at(pose_of(X_FM));
    return examples::ContactLoad{array_of(found.on_mobile.force_n), array_of(found.on_mobile.moment_nmm),
                                 found.energy_nmm};
  };
}

/// Largest difference that the example lets pass.
bool is_within(const char* what, double found, double known, double share) {
  const double off = std::abs(found / known - 1);
  std::printf("%s %.6g, closed form %.6g: off by %.1e\n", what, found, known, off);
  return off <= share;
}

// A ball of steel on a flat layer of stiffness K = M / h on a rigid plate: pressure K times the depth below the plane.
constexpr double radius = 12, stiffness = 10, mass = 5e-5, gravity = 9810,
                 drop = 2;  // mm, MPa/mm, tonnes, mm/s^2, mm

/// Energy stored at this depth of the ball's lowest point, N mm: the layer's and that of its weight.
double energy_at(double depth) {
  return stiffness * std::numbers::pi * std::pow(depth, 3) * (radius / 3 - depth / 12) -
         mass * gravity * depth;
}

/// From one top of the flight to the next: both ways of the fall, and of the depth.
double period() {
  const double speed = std::sqrt(2 * gravity * drop), kinetic = mass * speed * speed / 2;
  double deepest = 0;
  for (double step = 1; step > 1e-15; step /= 2)
    while (energy_at(deepest + step) < kinetic) deepest += step;
  // With depth = deepest sin(a) the integrand of dt = d(depth) / speed has no pole at the end.
  double in_contact = 0;
  constexpr int parts = 20000;
  for (int i = 0; i < parts; ++i) {
    const double a = std::numbers::pi / 2 * (i + 0.5) / parts, depth = deepest * std::sin(a);
    in_contact += deepest * std::cos(a) / std::sqrt(2 * (kinetic - energy_at(depth)) / mass);
  }
  return 2 * speed / gravity + 2 * in_contact * std::numbers::pi / 2 / parts;
}

bool bounce() {
  const ElasticContact contact(examples::sheet(3, 120), examples::ball(radius, 255),
                               {.casting = condyle::contact::Casting::fixed,
                                .fixed = condyle::contact::ElasticLayer{stiffness, 0, 1.0}});
  Pose start = Pose::Identity();
  start.translation().y() = radius + drop;
  examples::SimbodyWorld world({mass, 0.4 * mass * radius * radius, {0, -mass * gravity, 0}, 0},
                               rows_of(start), load_of(contact));
  const double energy = world.energy(), fallen = mass * gravity * drop;
  // Tops of the flight are where the upward speed passes through 0.
  constexpr int bounces = 8;
  constexpr double step = 2.5e-4;
  double last_top = 0, largest_drift = 0, before = 0;
  int tops = 0;
  for (int i = 1; tops < bounces; ++i) {
    world.advance_to(i * step);
    largest_drift = std::max(largest_drift, std::abs(world.energy() - energy) / fallen);
    const double speed = world.upward_speed();
    if (before > 0 && speed <= 0) {
      ++tops;
      last_top = i * step + speed / gravity;
    }
    before = speed;
  }
  std::printf("ball: %d bounces, %ld evaluations of the contact\n", bounces, world.contact_calls());
  std::printf("energy drift %.1e of what the ball fell\n", largest_drift);
  return is_within("period, s:", last_top / bounces, period(), 1e-3) && largest_drift < 5e-3;
}

bool rest(const char* joint_file, const char* states_file) {
  const condyle::io::LoadedJoint knee = condyle::io::read_joint(joint_file);
  const auto& entry = knee.report.file.contact.value();
  const auto surfaces = surfaces_of(entry, knee.joint);
  const ElasticContact contact(surfaces.fixed.mesh, surfaces.mobile.mesh,
                               elastic_options(entry, surfaces, knee));
  const Pose extended =
      condyle::io::motion_of(knee, condyle::io::read_motion_table(states_file)).X_FM.front().value();
  // What the contact carries there presses the bodies together; they are let go a little aside.
  const Vec3 load = -contact.at(extended).on_mobile.force_n;
  const auto balanced = condyle::contact::balance(contact, extended, {.on_mobile = {.force_n = load}});
  Pose start = extended;
  start.translation() += Vec3(0.3, -0.1, 0.2);
  examples::SimbodyWorld world({4e-3, 1, array_of(load), 0.5}, rows_of(start), load_of(contact));
  const auto begin = std::chrono::steady_clock::now();
  constexpr double seconds = 1;
  world.advance_to(seconds);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const Pose X = pose_of(world.pose());
  const double off = (X.translation() - balanced.X_FM.translation()).norm();
  const double moved = (X.translation() - start.translation()).norm();
  std::printf("knee: load %.0f N, moved %.3f mm; at rest %.1e mm from its balance, %.1e of the load left\n",
              load.norm(), moved, off, (contact.at(X).on_mobile.force_n + load).norm() / load.norm());
  std::printf("%ld evaluations of the contact, real-time factor %.2f\n", world.contact_calls(),
              seconds / wall);
  return balanced.carries_load() && off < 1e-2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return (argc == 3 ? rest(argv[1], argv[2]) : bounce()) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "simbody_contact: %s\n", error.what());
    return 2;
  }
}
