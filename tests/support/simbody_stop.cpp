#include "support/simbody_stop.hpp"

#include <SimTKsimbody.h>

#include <cmath>

// Simbody 3.7 is C++17: its indices compare in two ways in C++20.

namespace condyle::test {
namespace {

class PinnedBody {
 public:
  explicit PinnedBody(const SimbodyStop& stop) : matter_(system_), forces_(system_) {
    // A pin turns about Z of both frames.
    const SimTK::Transform X(
        SimTK::Rotation(SimTK::UnitVec3(stop.axis[0], stop.axis[1], stop.axis[2]), SimTK::ZAxis));
    const SimTK::Body::Rigid rod(SimTK::MassProperties(1, SimTK::Vec3(0), SimTK::Inertia(1)));
    body_ = SimTK::MobilizedBody::Pin(matter_.Ground(), X, rod, X);
    SimTK::Force::MobilityLinearStop(forces_, body_, SimTK::MobilizerQIndex(0), 1, 0, stop.ends[0],
                                     stop.ends[1]);
    state_ = system_.realizeTopology();
  }

  bool acts_at(double q) {
    body_.setOneQ(state_, 0, q);
    system_.realize(state_, SimTK::Stage::Dynamics);
    return system_.getMobilityForces(state_, SimTK::Stage::Dynamics)[0] != 0;
  }

  SimTK::Vec3 posed(const SimTK::Vec3& point, double q) {
    body_.setOneQ(state_, 0, q);
    system_.realize(state_, SimTK::Stage::Position);
    return body_.findStationLocationInGround(state_, point);
  }

 private:
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::MobilizedBody::Pin body_;
  SimTK::State state_;
};

}  // namespace

double SimbodyStop::begin(double towards) const {
  PinnedBody body(*this);
  double free = 0, acting = towards;
  while (std::abs(acting - free) > 1e-13) {
    const double middle = (free + acting) / 2;
    (body.acts_at(middle) ? acting : free) = middle;
  }
  return free;
}

std::array<double, 3> SimbodyStop::posed(const std::array<double, 3>& point, double angle) const {
  const SimTK::Vec3 at = PinnedBody(*this).posed(SimTK::Vec3(point[0], point[1], point[2]), angle);
  return {at[0], at[1], at[2]};
}

}  // namespace condyle::test
