#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/normal_depth.hpp"

/// Answers of C++ at the poses of a file, as doubles, for the tests of the Python module to compare with:
///
///     python_reference JOINT POSES ANSWERS      POSES: 16 doubles each, row by row
///     python_reference --times JOINT POSES      median seconds of all poses, one after the other on one core, without and with
///                                               keeping the answers, and of one pose with the bodies apart
///
/// For each pose, each list with its length before it: vertices and depths of the mobile body, of the fixed body, pairs; and
/// at every tenth pose the radial gaps of both bodies, their tangential gaps about flexion, and areas and depths of the faces
/// in contact along normals.

namespace condyle {
namespace {

class Answers {
 public:
  template <class Values>
  void add(const Values& values) {
    numbers_.push_back(static_cast<double>(std::size(values)));
    for (const auto& value : values) numbers_.push_back(static_cast<double>(value));
  }
  void add(const radial::Penetrations& found) {
    add(found.point);
    add(found.depth_mm);
  }
  void add(const contact::SurfaceContact& found) {
    std::vector<double> values;
    for (const contact::FaceContact& face : found.faces) {
      values.push_back(face.face);
      values.push_back(face.area_mm2);
      values.push_back(face.max_depth_mm);
      values.push_back(face.overlap_mm3);
    }
    add(values);
  }
  void write(const char* path) const {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(numbers_.data()),
               static_cast<std::streamsize>(numbers_.size() * sizeof(double)));
  }

 private:
  std::vector<double> numbers_;
};

std::vector<Pose> poses_in(const char* path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<Pose> poses;
  double rows[16];
  while (file.read(reinterpret_cast<char*>(rows), sizeof rows)) {
    Pose& pose = poses.emplace_back();
    for (int i = 0; i < 16; ++i) pose.matrix()(i / 4, i % 4) = rows[i];
  }
  return poses;
}

void answer(const char* joint_file, const char* poses_file, const char* answers_file) {
  const io::LoadedJoint loaded = io::read_joint(joint_file);
  const contact::JointContact joint(loaded.joint);
  const contact::NormalDepth from_mobile(joint.mobile(), joint.fixed());
  Answers answers;
  radial::Penetrations inside;
  const std::vector<Pose> poses = poses_in(poses_file);
  for (std::size_t n = 0; n < poses.size(); ++n) {
    const Pose& X_FM = poses[n];
    joint.mobile_in_fixed(X_FM, inside);
    answers.add(inside);
    joint.fixed_in_mobile(X_FM, inside);
    answers.add(inside);
    std::vector<Index> pairs;
    for (const auto& [fixed, mobile] : joint.pairs(X_FM)) pairs.insert(pairs.end(), {fixed, mobile});
    answers.add(pairs);
    if (n % 10 != 0) continue;
    const contact::RadialContact radial = joint.radial(X_FM);
    answers.add(radial.mobile_in_fixed->radial_gap_mm);
    answers.add(radial.fixed_in_mobile->radial_gap_mm);
    const CoordinateSystem system = loaded.joint.coordinates();
    const contact::TangentialContact turned =
        joint.tangential(X_FM, axis_of(JointAngle::flexion, system, angles_at(system, X_FM)));
    answers.add(turned.mobile_in_fixed->arc_gap_mm);
    answers.add(turned.fixed_in_mobile->arc_gap_mm);
    answers.add(from_mobile.at(inverted(X_FM)));
  }
  answers.write(answers_file);
}

template <class Act>
double median_seconds(int repetitions, const Act& act) {
  std::vector<double> seconds;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    act();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(seconds.begin(), seconds.begin() + repetitions / 2, seconds.end());
  return seconds[static_cast<std::size_t>(repetitions) / 2];
}

/// As bench/python_overhead.py measures them in Python.
void print_times(const char* joint_file, const char* poses_file) {
  const io::LoadedJoint loaded = io::read_joint(joint_file);
  const contact::JointContact joint(loaded.joint);
  const std::vector<Pose> poses = poses_in(poses_file);
  radial::Penetrations inside;
  const auto ask = [&](const Pose& X_FM) {
    joint.mobile_in_fixed(X_FM, inside);
    joint.fixed_in_mobile(X_FM, inside);
  };
  ask(poses.front());
  const double all = median_seconds(15, [&] {
    for (const Pose& X_FM : poses) ask(X_FM);
  });
  std::vector<radial::Penetrations> mobile(poses.size()), fixed(poses.size());
  const double kept = median_seconds(15, [&] {
    for (std::size_t n = 0; n < poses.size(); ++n) {
      joint.mobile_in_fixed(poses[n], mobile[n]);
      joint.fixed_in_mobile(poses[n], fixed[n]);
    }
  });
  const double apart = median_seconds(5000, [&] { ask(Pose::Identity()); });
  std::printf("{\"poses_s\": %.9g, \"kept_s\": %.9g, \"apart_s\": %.9g}\n", all, kept, apart);
}

}  // namespace
}  // namespace condyle

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: python_reference JOINT POSES ANSWERS, or --times JOINT POSES\n");
    return EXIT_FAILURE;
  }
  try {
    if (std::string_view(argv[1]) == "--times")
      condyle::print_times(argv[2], argv[3]);
    else
      condyle::answer(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
