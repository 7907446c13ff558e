// The cartilages of a hip deform as the femur walks: contact in each step of a millisecond, both layers following. Springs hold
// every vertex of the articular surfaces to its place on the bone and to its neighbours; a step of the tissue is implicit, then
// what overlaps is pushed apart along the rays, half by half, until nothing is deeper than a hundredth of a millimetre. The femur turns
// as it was recorded and is pressed into the socket by the load of a walk: its centre goes where the springs carry the load.
//
//     walking_cartilages [STEPS]                               the sample hip, rotating as a walk does about
//     walking_cartilages STEPS FIXED.ply MOBILE.ply WALK.mot   cartilages about the hip centre, a recorded walk of the left hip
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <condyle/condyle.hpp>
#include <condyle/io/mesh_file.hpp>
#include <condyle/io/recorded_motion.hpp>
#include <condyle/sample/cartilages.hpp>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <string>

namespace {

using namespace condyle;

constexpr double time_step = 1e-3;        // s
constexpr double confined_modulus = 12;   // MPa, of a layer that cannot spread sideways
constexpr double thickness = 1.6;         // mm
constexpr double density = 1.1e-9;        // tonnes per mm^3: forces are then N
constexpr double relaxation_time = 0.05;  // s, of the tissue's damping
constexpr double most_left = 0.01;        // mm of overlap
constexpr int most_rounds = 30;
constexpr double least_load = 300, peak_load = 1500;  // N
constexpr double bone_damping = 20;                   // N s/mm, of the centre's motion

/// A layer whose articular side moves: masses on springs to the bone and along edges.
class Tissue {
 public:
  /// `outward` is 1 for a layer whose articular side faces away from the joint centre, and -1 for one that faces it.
  Tissue(TriMesh rest, double outward) : rest_(std::move(rest)), at_(rest_.vertices) {
    find_free(outward);
    displacement_ = velocity_ = Eigen::MatrixX3d::Zero(Eigen::Index(free_.size()), 3);
    const auto [mass, foundation, stiffness] = assembled();
    foundation_ = foundation;
    mass_ = mass / (time_step * time_step);
    damping_ = stiffness * (relaxation_time / time_step);
    system_.compute(stiffness + damping_ + Eigen::SparseMatrix<double>(mass_.asDiagonal()));
  }

  const TriMesh& rest() const { return rest_; }
  const Points& at() const { return at_; }
  bool is_free(Index v) const { return number_[v] != no_index; }

  /// One implicit step of the springs alone.
  void step() {
    before_ = displacement_;
    const Eigen::MatrixX3d load =
        mass_.asDiagonal() * (displacement_ + time_step * velocity_) + damping_ * displacement_;
    displacement_ = system_.solve(load);
    place();
  }
  void push(Index vertex, const Vec3& by) {
    displacement_.row(number_[vertex]) += by.transpose();
    at_.set(vertex, at_[vertex] + by);
  }
  /// After the last push of a step.
  void end_step() { velocity_ = (displacement_ - before_) / time_step; }
  /// What the springs to the bone, and their damping, exert on it, N.
  Vec3 force_on_bone() const {
    return (displacement_ + relaxation_time * velocity_).transpose() * foundation_;
  }

  double largest_displacement() const { return displacement_.rowwise().norm().maxCoeff(); }

 private:
  void find_free(double outward) {
    Points normals(rest_.vertices.size());
    for (std::size_t t = 0; t < rest_.triangles.size(); ++t) {
      const Vec3 a = rest_.corner(t, 0);
      const Vec3 area = (rest_.corner(t, 1) - a).cross(rest_.corner(t, 2) - a);
      for (const Index v : rest_.triangles[t]) normals.set(v, normals[v] + area);
    }
    number_.assign(rest_.vertices.size(), no_index);
    for (Index v = 0; v < number_.size(); ++v) {
      // The side that lies on the bone is held.
      if (outward * normals[v].normalized().dot(rest_.vertices[v].normalized()) < 0.5) continue;
      number_[v] = Index(free_.size());
      free_.push_back(v);
    }
  }

  struct Assembled {
    Eigen::VectorXd mass, foundation;
    Eigen::SparseMatrix<double> stiffness;
  };
  Assembled assembled() const {
    const auto count = Eigen::Index(free_.size());
    Assembled out{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count),
                  Eigen::SparseMatrix<double>(count, count)};
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t t = 0; t < rest_.triangles.size(); ++t) {
      const Triangle& corners = rest_.triangles[t];
      const Vec3 a = rest_.corner(t, 0);
      const double third = (rest_.corner(t, 1) - a).cross(rest_.corner(t, 2) - a).norm() / 6;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index i = number_[corners[k]], j = number_[corners[(k + 1) % 3]];
        if (i == no_index) continue;
        out.mass[i] += density * third * thickness;
        out.foundation[i] += confined_modulus * third / thickness;
        entries.emplace_back(i, i, confined_modulus * third / thickness);
        if (j == no_index) continue;
        // A strip of the layer along the edge; each edge is met twice.
        const double along = 0.1 * confined_modulus * thickness / 2;
        entries.emplace_back(i, i, along), entries.emplace_back(j, j, along);
        entries.emplace_back(i, j, -along), entries.emplace_back(j, i, -along);
      }
    }
    out.stiffness.setFromTriplets(entries.begin(), entries.end());
    return out;
  }

  void place() {
    for (std::size_t i = 0; i < free_.size(); ++i)
      at_.set(free_[i], rest_.vertices[free_[i]] + Vec3(displacement_.row(Eigen::Index(i)).transpose()));
  }

  TriMesh rest_;
  Points at_;
  std::vector<Index> free_, number_;
  Eigen::MatrixX3d displacement_, velocity_, before_;
  Eigen::VectorXd mass_, foundation_;
  Eigen::SparseMatrix<double> damping_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> system_;
};

/// The largest push that each vertex of a body gets in a round.
class Pushes {
 public:
  explicit Pushes(const Tissue& tissue) : tissue_(tissue), push_(tissue.rest().vertices.size()) {}
  void add(Index vertex, const Vec3& by) {
    if (!tissue_.is_free(vertex)) return;
    if (by.squaredNorm() > push_[vertex].squaredNorm()) push_.set(vertex, by);
  }
  void apply(Tissue& tissue) {
    for (Index v = 0; v < push_.size(); ++v) {
      if (push_[v].isZero()) continue;
      tissue.push(v, push_[v]);
      push_.set(v, Vec3::Zero());
    }
  }

 private:
  const Tissue& tissue_;
  Points push_;
};

class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_;
};

struct Seconds {
  double tissue = 0, update = 0, query = 0;
};

class Hip {
 public:
  Hip(TriMesh fixed, TriMesh mobile)
      : fixed_(std::move(fixed), -1),
        mobile_(std::move(mobile), 1),
        contact_(fixed_.rest(), mobile_.rest()),
        fixed_pushes_(fixed_),
        mobile_pushes_(mobile_) {}

  /// The femur's rotation, and the load on it.
  void step(Pose X_FM, const Vec3& load) {
    X_FM.translation() = centre_;
    {
      const Stopwatch watch(seconds.tissue);
      fixed_.step(), mobile_.step();
    }
    double left = 0;
    for (int round = 0;; ++round) {
      {
        const Stopwatch watch(seconds.update);
        contact_.update(BodyRole::fixed, fixed_.at());
        contact_.update(BodyRole::mobile, mobile_.at());
      }
      {
        const Stopwatch watch(seconds.query);
        contact_.mobile_in_fixed(X_FM, in_fixed_);
        contact_.fixed_in_mobile(X_FM, in_mobile_);
      }
      left = std::max(deepest_of(in_fixed_), deepest_of(in_mobile_));
      if (round == 0) deepest_met = std::max(deepest_met, left);
      ++rounds;
      if (left <= most_left || round == most_rounds) break;
      const Stopwatch watch(seconds.tissue);
      push_apart(X_FM);
    }
    deepest_left = std::max(deepest_left, left);
    const Stopwatch watch(seconds.tissue);
    fixed_.end_step(), mobile_.end_step();
    const Vec3 carried = X_FM.linear() * mobile_.force_on_bone();
    centre_ += time_step / bone_damping * (load + carried);
    farthest_centre = std::max(farthest_centre, centre_.norm());
    largest_displacement =
        std::max({largest_displacement, fixed_.largest_displacement(), mobile_.largest_displacement()});
  }

  Seconds seconds;
  std::size_t rounds = 0;
  double deepest_met = 0, deepest_left = 0, largest_displacement = 0, farthest_centre = 0;

 private:
  static double deepest_of(const radial::Penetrations& inside) {
    return inside.size() == 0 ? 0 : *std::max_element(inside.depth_mm.begin(), inside.depth_mm.end());
  }

  /// A vertex and the triangle that it went through share its way out.
  void push_apart(const Pose& X_FM) {
    const Pose X_MF = X_FM.inverse();
    const auto share = [](const radial::Penetrations& inside, const Pose& X, const Tissue& points,
                          Pushes& of_points, const Tissue& surface, Pushes& of_surface) {
      for (std::size_t i = 0; i < inside.size(); ++i) {
        const Index v = inside.point[i];
        const Vec3 ray = (X * points.at()[v]).normalized();
        const double sense = inside.direction[i] == radial::RayDirection::away_from_centre ? 1 : -1;
        const Vec3 out = (inside.depth_mm[i] / 2 + 0.2 * most_left) * sense * ray;
        of_points.add(v, X.linear().transpose() * out);
        for (const Index corner : surface.rest().triangles[inside.triangle[i]]) of_surface.add(corner, -out);
      }
    };
    share(in_fixed_, X_FM, mobile_, mobile_pushes_, fixed_, fixed_pushes_);
    share(in_mobile_, X_MF, fixed_, fixed_pushes_, mobile_, mobile_pushes_);
    fixed_pushes_.apply(fixed_), mobile_pushes_.apply(mobile_);
  }

  Tissue fixed_, mobile_;
  contact::JointContact contact_;
  Pushes fixed_pushes_, mobile_pushes_;
  radial::Penetrations in_fixed_, in_mobile_;
  Vec3 centre_ = Vec3::Zero();
};

/// Angles of a walk.
struct Walk {
  std::vector<double> times;
  std::vector<std::array<double, 3>> degrees;  // flexion, adduction, internal rotation

  double duration() const { return times.back() - times.front(); }
  Pose at(double time, Side side) const {
    const double t = times.front() + time;
    const auto after = std::clamp<std::size_t>(
        std::size_t(std::upper_bound(times.begin(), times.end(), t) - times.begin()), 1, times.size() - 1);
    const double share = (t - times[after - 1]) / (times[after] - times[after - 1]);
    const auto angle = [&](std::size_t k) {
      return Angle::degrees((1 - share) * degrees[after - 1][k] + share * degrees[after][k]);
    };
    return pose_at({Anatomy::hip, side}, {angle(0), angle(1), angle(2)});
  }
  /// Two peaks in a step, mainly upwards: about what instrumented hips measure.
  Vec3 load_at(double time, Side side) const {
    const double share = std::pow(std::sin(2 * std::numbers::pi * time / duration()), 2);
    return (least_load + (peak_load - least_load) * share) *
           Vec3(0.1, 0.95, side == Side::right ? -0.3 : 0.3).normalized();
  }
};

Walk drawn_walk() {
  Walk walk;
  for (int i = 0; i <= 60; ++i) {
    const double phase = 2 * std::numbers::pi * i / 60;
    walk.times.push_back(1.1 * i / 60);
    walk.degrees.push_back({12 + 22 * std::cos(phase), 5 * std::sin(phase), 4 * std::cos(phase + 1)});
  }
  return walk;
}

Walk recorded_walk(const std::string& file) {
  const io::MotionTable table = io::read_motion_table(file);
  const io::NamedCoordinates recorded =
      io::recorded_coordinates(table, {{.coordinate = "flexion", .column = "hip_flexion_l"},
                                       {.coordinate = "adduction", .column = "hip_adduction_l"},
                                       {.coordinate = "rotation", .column = "hip_rotation_l"}});
  Walk walk{recorded.times.values, {}};
  for (const auto& frame : recorded.frames)
    walk.degrees.push_back({frame->at(0), frame->at(1), frame->at(2)});
  return walk;
}

int run(int argc, char** argv) {
  const int asked = argc > 1 ? std::stoi(argv[1]) : 200;
  const bool is_recorded = argc == 5;
  const Walk walk = is_recorded ? recorded_walk(argv[4]) : drawn_walk();
  TriMesh fixed, mobile;
  if (is_recorded) {
    fixed = io::read_mesh(argv[2]).mesh, mobile = io::read_mesh(argv[3]).mesh;
  } else {
    auto layers = sample::sample_cartilages({}, {.clearance_mm = 0}, sample::CartilageScenario::five);
    fixed = std::move(layers.acetabular), mobile = std::move(layers.femoral);
  }
  Hip hip(std::move(fixed), std::move(mobile));
  const int steps = std::min(asked, int(walk.duration() / time_step));
  double wall = 0;
  {
    const Stopwatch watch(wall);
    const Side side = is_recorded ? Side::left : Side::right;
    for (int i = 1; i <= steps; ++i)
      hip.step(walk.at(i * time_step, side), walk.load_at(i * time_step, side));
  }
  const auto ms = [&](double seconds) { return 1e3 * seconds / steps; };
  std::printf("%d steps of 1 ms, %.1f rounds each: update %.2f ms, query %.2f ms, tissue %.2f ms\n", steps,
              double(hip.rounds) / steps, ms(hip.seconds.update), ms(hip.seconds.query),
              ms(hip.seconds.tissue));
  std::printf("real-time factor %.2f\n", steps * time_step / wall);
  std::printf("overlap met %.3f mm, left %.4f mm\n", hip.deepest_met, hip.deepest_left);
  std::printf("surfaces give way by up to %.3f mm, the centre moves by up to %.3f mm\n",
              hip.largest_displacement, hip.farthest_centre);
  return hip.deepest_left <= most_left ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "walking_cartilages: %s\n", error.what());
    return 2;
  }
}
