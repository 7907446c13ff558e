#include <bit>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "condyle/range_of_motion.hpp"
#include "condyle/sample/hip.hpp"
#include "page_core.hpp"

/// Asks a sample hip a thousand poses and its limits through the functions of the page, compiled natively, and writes both the
/// questions and the answers for same_bits.mjs: page_core_answers FOLDER.

namespace {

using namespace condyle;

template <class T>
void write(std::ofstream& file, const T* values, std::size_t count) {
  file.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
}

std::string bits(double value) {
  char text[20];
  std::snprintf(text, sizeof text, "%016llx",
                static_cast<unsigned long long>(std::bit_cast<std::uint64_t>(value)));
  return text;
}

std::vector<double> flat(const TriMesh& mesh) {
  std::vector<double> values;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 p = mesh.vertices[v];
    values.insert(values.end(), {p.x(), p.y(), p.z()});
  }
  return values;
}
std::vector<std::uint32_t> flat_triangles(const TriMesh& mesh) {
  std::vector<std::uint32_t> values;
  for (const Triangle& t : mesh.triangles) values.insert(values.end(), {t[0], t[1], t[2]});
  return values;
}

std::string penetrations(CondyleJoint* joint, const double* pose, int of_fixed) {
  const int count = condyle_penetrations(joint, pose, of_fixed);
  std::string text = std::to_string(count);
  for (int i = 0; i < count; ++i)
    text +=
        ' ' + std::to_string(condyle_penetrating_vertices(joint)[i]) + ':' + bits(condyle_depths(joint)[i]);
  return text;
}

int failed() {
  std::fprintf(stderr, "%s\n", condyle_error());
  return 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::string folder = arguments[1];
  const SampleHip hip = sample_hip({}, Scenario::two);
  const std::vector<double> fixed = flat(hip.hip_bone), mobile = flat(hip.femur);
  const auto fixed_triangles = flat_triangles(hip.hip_bone), mobile_triangles = flat_triangles(hip.femur);

  constexpr int poses = 1000;
  std::vector<double> questions;  // angles and a translation each
  std::mt19937_64 random(7);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int i = 0; i < poses; ++i) {
    const double slip = i % 2 == 0 ? 0 : 1.5;
    questions.insert(questions.end(), {uniform(-30, 150), uniform(-60, 60), uniform(-60, 60),
                                       uniform(-slip, slip), uniform(-slip, slip), uniform(-slip, slip)});
  }

  std::ofstream scene(folder + "/scene.bin", std::ios::binary);
  const std::int32_t head[] = {
      static_cast<std::int32_t>(fixed.size()),           static_cast<std::int32_t>(mobile.size()),
      static_cast<std::int32_t>(questions.size()),       0,
      static_cast<std::int32_t>(fixed_triangles.size()), static_cast<std::int32_t>(mobile_triangles.size())};
  write(scene, head, 6);
  write(scene, fixed.data(), fixed.size());
  write(scene, mobile.data(), mobile.size());
  write(scene, questions.data(), questions.size());
  write(scene, fixed_triangles.data(), fixed_triangles.size());
  write(scene, mobile_triangles.data(), mobile_triangles.size());

  CondyleJoint* joint = condyle_joint(0, 0, 0, fixed.data(), static_cast<int>(fixed.size() / 3),
                                      fixed_triangles.data(), static_cast<int>(fixed_triangles.size() / 3),
                                      mobile.data(), static_cast<int>(mobile.size() / 3),
                                      mobile_triangles.data(), static_cast<int>(mobile_triangles.size() / 3));
  if (!joint) return failed();
  std::ofstream answers(folder + "/answers.txt");
  for (int i = 0; i < poses; ++i) {
    double X[16];
    if (condyle_pose(joint, &questions[6 * i], &questions[6 * i + 3], X) != 0) return failed();
    answers << "pose";
    for (const double entry : X) answers << ' ' << bits(entry);
    answers << "\nmobile " << penetrations(joint, X, 0) << "\nfixed " << penetrations(joint, X, 1);
    answers << "\ncontact " << condyle_in_contact(joint, X) << "\npairs";
    const int pairs = condyle_pairs(joint, X);
    for (int k = 0; k < 2 * pairs; ++k) answers << ' ' << condyle_pair_triangles(joint)[k];
    answers << '\n';
  }
  for (const Motion& motion : hip_motions()) {
    const double start[] = {motion.start.flexion.degrees(), motion.start.adduction.degrees(),
                            motion.start.internal_rotation.degrees()};
    double limit[7];
    if (condyle_limit(joint, static_cast<int>(motion.vary), motion.sense == RotationSense::positive, start,
                      motion.range.degrees(), limit) != 0)
      return failed();
    answers << "limit " << static_cast<int>(motion.vary) << ' ' << (motion.sense == RotationSense::positive);
    for (const double value : start) answers << ' ' << bits(value);
    answers << ' ' << bits(motion.range.degrees());
    for (const double value : limit) answers << ' ' << bits(value);
    answers << '\n';
  }
  condyle_free(joint);
  return answers && scene ? 0 : 1;
}
