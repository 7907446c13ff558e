#pragma once

#include <array>
#include <functional>
#include <memory>

/// One body that Simbody moves in ground under gravity and a contact force, behind plain C++17: two of Simbody's comparisons are
/// ambiguous in C++20. Units: mm, s, N, tonnes.

namespace examples {

/// Rows of a pose X_FM: rotation and translation.
using PoseRows = std::array<std::array<double, 4>, 3>;

/// What ground does to the body: force and moment about its origin, in ground; and the energy stored.
struct ContactLoad {
  std::array<double, 3> force, moment;
  double energy;
};

struct MovedBody {
  double mass;                        ///< tonnes; its centre is the body's origin
  double inertia;                     ///< about any axis, tonnes mm^2
  std::array<double, 3> other_force;  ///< on its origin, constant, N
  double damping;                     ///< of each velocity, N s/mm; rotations are held if it is above 0
};

class SimbodyWorld {
 public:
  SimbodyWorld(const MovedBody& body, const PoseRows& start,
               std::function<ContactLoad(const PoseRows&)> contact);
  ~SimbodyWorld();

  void advance_to(double seconds);
  PoseRows pose() const;
  double height() const { return pose()[1][3]; }
  double upward_speed() const;
  /// Kinetic and stored, and the potential of the other force, N mm.
  double energy() const;
  long contact_calls() const;

 private:
  struct System;
  std::unique_ptr<System> system_;
};

}  // namespace examples
