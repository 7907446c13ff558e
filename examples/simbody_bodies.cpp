#include "simbody_bodies.hpp"

#include <Simbody.h>

#include <utility>

namespace examples {
namespace {

PoseRows rows_of(const SimTK::Transform& X) {
  PoseRows rows;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) rows[i][k] = X.R()[i][k];
    rows[i][3] = X.p()[i];
  }
  return rows;
}

SimTK::Rotation rotation_of(const PoseRows& X) {
  return SimTK::Rotation(
      SimTK::Mat33(X[0][0], X[0][1], X[0][2], X[1][0], X[1][1], X[1][2], X[2][0], X[2][1], X[2][2]), true);
}

SimTK::Vec3 vector_of(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

/// The force element of any simulator: the pose in, force, moment and energy out.
class ContactForce : public SimTK::Force::Custom::Implementation {
 public:
  ContactForce(SimTK::MobilizedBody body, std::function<ContactLoad(const PoseRows&)> contact, long& calls)
      : body_(std::move(body)), contact_(std::move(contact)), calls_(calls) {}

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& on_bodies,
                 SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector&) const override {
    ++calls_;
    const ContactLoad load = contact_(rows_of(body_.getBodyTransform(state)));
    body_.applyBodyForce(state, SimTK::SpatialVec(vector_of(load.moment), vector_of(load.force)), on_bodies);
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State& state) const override {
    return contact_(rows_of(body_.getBodyTransform(state))).energy;
  }

 private:
  SimTK::MobilizedBody body_;
  std::function<ContactLoad(const PoseRows&)> contact_;
  long& calls_;
};

}  // namespace

struct SimbodyWorld::System {
  System(const MovedBody& body, const PoseRows& start, std::function<ContactLoad(const PoseRows&)> contact)
      : other_force(vector_of(body.other_force)) {
    const SimTK::Body::Rigid rigid(SimTK::MassProperties(
        body.mass, SimTK::Vec3(0), SimTK::Inertia(body.inertia, body.inertia, body.inertia)));
    const SimTK::Vec3 at(start[0][3], start[1][3], start[2][3]);
    const SimTK::Transform X(rotation_of(start), at);
    if (body.damping > 0)
      moved = SimTK::MobilizedBody::Translation(matter.Ground(), X, rigid, SimTK::Transform());
    else
      moved = SimTK::MobilizedBody::Free(matter.Ground(), X, rigid, SimTK::Transform());
    if (body.damping > 0) SimTK::Force::GlobalDamper(forces, matter, body.damping);
    SimTK::Force::ConstantForce(forces, moved, SimTK::Vec3(0), other_force);
    SimTK::Force::Custom(forces, new ContactForce(moved, std::move(contact), calls));
    system.realizeTopology();
    integrator = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(system);
    integrator->setAccuracy(1e-6);
    integrator->setMaximumStepSize(1e-3);
    stepper = std::make_unique<SimTK::TimeStepper>(system, *integrator);
    stepper->initialize(system.getDefaultState());
  }

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::MobilizedBody moved;
  SimTK::Vec3 other_force;
  long calls = 0;
  std::unique_ptr<SimTK::RungeKuttaMersonIntegrator> integrator;
  std::unique_ptr<SimTK::TimeStepper> stepper;
};

SimbodyWorld::SimbodyWorld(const MovedBody& body, const PoseRows& start,
                           std::function<ContactLoad(const PoseRows&)> contact)
    : system_(std::make_unique<System>(body, start, std::move(contact))) {}
SimbodyWorld::~SimbodyWorld() = default;

void SimbodyWorld::advance_to(double seconds) {
  system_->stepper->stepTo(seconds);
}

PoseRows SimbodyWorld::pose() const {
  return rows_of(system_->moved.getBodyTransform(system_->integrator->getState()));
}

double SimbodyWorld::upward_speed() const {
  return system_->moved.getBodyOriginVelocity(system_->integrator->getState())[1];
}

double SimbodyWorld::energy() const {
  const SimTK::State& state = system_->integrator->getState();
  system_->system.realize(state, SimTK::Stage::Dynamics);
  const SimTK::Vec3 at = system_->moved.getBodyOriginLocation(state);
  return system_->system.calcEnergy(state) - SimTK::dot(system_->other_force, at);
}

long SimbodyWorld::contact_calls() const {
  return system_->calls;
}

}  // namespace examples
