#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/answer/case.hpp"
#include "condyle/answer/depth.hpp"
#include "condyle/range_of_motion.hpp"
#include "condyle/sample/hip.hpp"
#include "page_core.hpp"
#include "page_edit.hpp"
#include "page_joint.hpp"
#include "page_ligaments.hpp"
#include "page_pressure.hpp"

/// Asks a joint a thousand poses, its limits and a map through the functions of the page, compiled natively, and writes the
/// answers. The joint and the poses are those of FOLDER/scene.bin, which is made of a sample hip with --sample, and then brushed:
///     page_core_answers [--sample] FOLDER

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

/// A file of whole numbers, doubles and words, as scene.mjs reads and writes it.
struct Scene {
  std::vector<double> fixed, mobile;
  std::vector<double> questions;  ///< angles in degrees and a translation in mm each
  std::vector<std::uint32_t> fixed_triangles, mobile_triangles;
};

Scene sample_scene() {
  const sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::two);
  Scene scene{.fixed = flat(hip.hip_bone),
              .mobile = flat(hip.femur),
              .questions = {},
              .fixed_triangles = flat_triangles(hip.hip_bone),
              .mobile_triangles = flat_triangles(hip.femur)};
  constexpr int poses = 1000;
  std::mt19937_64 random(7);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int i = 0; i < poses; ++i) {
    const double slip = i % 2 == 0 ? 0 : 1.5;
    scene.questions.insert(scene.questions.end(),
                           {uniform(-30, 150), uniform(-60, 60), uniform(-60, 60), uniform(-slip, slip),
                            uniform(-slip, slip), uniform(-slip, slip)});
  }
  return scene;
}

void write_scene(const std::string& path, const Scene& scene) {
  std::ofstream file(path, std::ios::binary);
  const std::uint32_t head[] = {static_cast<std::uint32_t>(scene.fixed.size()),
                                static_cast<std::uint32_t>(scene.mobile.size()),
                                static_cast<std::uint32_t>(scene.questions.size()),
                                0,
                                static_cast<std::uint32_t>(scene.fixed_triangles.size()),
                                static_cast<std::uint32_t>(scene.mobile_triangles.size())};
  write(file, head, std::size(head));
  for (const auto* values : {&scene.fixed, &scene.mobile, &scene.questions})
    write(file, values->data(), values->size());
  for (const auto* values : {&scene.fixed_triangles, &scene.mobile_triangles})
    write(file, values->data(), values->size());
}

template <class T>
void read(std::ifstream& file, std::vector<T>& values, std::size_t count) {
  values.resize(count);
  file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

Scene read_scene(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::uint32_t> head;
  read(file, head, 6);
  Scene scene;
  read(file, scene.fixed, head[0]);
  read(file, scene.mobile, head[1]);
  read(file, scene.questions, head[2]);
  read(file, scene.fixed_triangles, head[4]);
  read(file, scene.mobile_triangles, head[5]);
  if (!file) throw std::runtime_error(path + " is no scene");
  return scene;
}

int checked(int answer) {
  if (answer < 0) throw std::runtime_error(condyle_error());
  return answer;
}

std::string penetrations(CondyleJoint* joint, const double* pose, int of_fixed) {
  const int count = checked(condyle_penetrations(joint, pose, of_fixed));
  std::string text = std::to_string(count);
  for (int i = 0; i < count; ++i)
    text +=
        ' ' + std::to_string(condyle_penetrating_vertices(joint)[i]) + ':' + bits(condyle_depths(joint)[i]);
  return text;
}

void answer_pose(CondyleJoint* joint, const double* question, double X[16], std::ostream& answers) {
  checked(condyle_pose(joint, question, question + 3, X));
  answers << "pose";
  for (int i = 0; i < 16; ++i) answers << ' ' << bits(X[i]);
  for (const int of_fixed : {0, 1})
    answers << (of_fixed ? "\nfixed " : "\nmobile ") << penetrations(joint, X, of_fixed);
  answers << "\ncontact " << checked(condyle_in_contact(joint, X)) << "\npairs";
  const int pairs = checked(condyle_pairs(joint, X));
  for (int k = 0; k < 2 * pairs; ++k) answers << ' ' << condyle_pair_triangles(joint)[k];
  answers << '\n';
}

/// The answer of `condyle depth` there, and where the surfaces are nearest to each other; the query's angles come first.
void answer_depth(CondyleJoint* joint, const double* question, const double X[16], std::ostream& answers) {
  double depth[16];
  checked(condyle_depth(joint, X, question, depth));
  answers << "depth";
  for (const double value : depth) answers << ' ' << (std::isnan(value) ? "none" : bits(value));
  answers << "\nnearest";
  for (const int counted : {0, 1}) {
    double nearest[7];
    checked(condyle_nearest(joint, X, counted, nearest));
    for (const double value : nearest) answers << ' ' << bits(value);
  }
  answers << '\n';
}

/// The movement from the question before; of an axis the command's depths about it are those of the page.
void answer_screw(const CondyleJoint* joint, const double before[16], const double X[16],
                  std::ostream& answers) {
  double screw[9];
  checked(condyle_screw(joint, before, X, screw));
  answers << "screw";
  for (const double value : screw) answers << ' ' << (std::isnan(value) ? "none" : bits(value));
  answers << '\n';
  if (std::isnan(screw[1])) return;
  const contact::AxisLine axis{{screw[1], screw[2], screw[3]}, {screw[4], screw[5], screw[6]}};
  const DepthAnswer commands = answer_depth(
      joint->bodies, joint->joint, {.X_FM = pose_of(X), .method = DepthMethod::tangential, .about = axis});
  double deg = 0, mm = 0;
  const contact::TangentialContact& arcs = std::get<ArcDepths>(commands.depths).contact;
  for (const auto& body : {arcs.mobile_in_fixed, arcs.fixed_in_mobile})
    if (const auto summary = contact::summarise(*body); summary.deepest) {
      deg = std::max(deg, summary.largest_angle->depth.degrees());
      mm = std::max(mm, summary.deepest->depth_mm);
    }
  if (!std::isnan(screw[7]) && (deg != screw[7] || mm != screw[8]))
    throw std::runtime_error("the command's depth about the axis of a movement is " + std::to_string(deg));
}

/// What the pose is to the limits; `limits` are those by which the command judges it.
void answer_standing(CondyleJoint* joint, const motion::RangeOfMotion& limits, const double* question,
                     const double X[16], std::ostream& answers) {
  double standing[4];
  const Vec3 held(question[3], question[4], question[5]);
  checked(condyle_standing(joint, question, held.data(), standing));
  const PoseState commands =
      pose_standing(limits, angles_of(question), held, checked(condyle_in_contact(joint, X)) == 1).state;
  if (static_cast<double>(commands) != standing[0])
    throw std::runtime_error("the command says " + std::string(name_of(commands)) + " of a pose");
  answers << "standing";
  for (const double value : standing) answers << ' ' << value;
  answers << '\n';
}

/// Values of all vertices at a pose, byte by byte.
void answer_shown(CondyleJoint* joint, const double X[16], const std::size_t (&vertices)[2],
                  std::ofstream& shown) {
  constexpr int pressure = 3;  // after the quantities of condyle_shown()
  for (int quantity = 0; quantity <= pressure; ++quantity)
    for (const int of_fixed : {0, 1}) {
      std::vector<float> values(vertices[of_fixed]);
      std::vector<std::uint8_t> marks(values.size());
      checked(quantity == pressure
                  ? condyle_pressure(joint, X, of_fixed, values.data(), marks.data())
                  : condyle_shown(joint, X, quantity, of_fixed, values.data(), marks.data()));
      write(shown, values.data(), values.size());
      write(shown, marks.data(), marks.size());
    }
}

std::array<double, 3> start_of(const motion::Motion& motion) {
  return {motion.start.flexion.degrees(), motion.start.adduction.degrees(),
          motion.start.internal_rotation.degrees()};
}

void answer_limit(CondyleJoint* joint, const motion::Motion& motion, std::ostream& answers) {
  const std::array start = start_of(motion);
  const double held[] = {0, 0, 0};
  double limit[8];
  checked(condyle_limit(joint, static_cast<int>(motion.vary), motion.sense == RotationSense::positive,
                        start.data(), held, motion.range.degrees(), limit));
  answers << "limit " << static_cast<int>(motion.vary) << ' ' << (motion.sense == RotationSense::positive);
  for (const double value : start) answers << ' ' << bits(value);
  answers << ' ' << bits(motion.range.degrees());
  for (const double value : limit) answers << ' ' << bits(value);
  answers << '\n';
}

/// Free internal rotation over flexion and adduction, every ten degrees.
void answer_map(CondyleJoint* joint, std::ostream& answers) {
  for (int adduction = -40; adduction <= 30; adduction += 10)
    for (int flexion = -20; flexion <= 120; flexion += 10) {
      const double start[] = {double(flexion), double(adduction), 0}, held[] = {0, 0, 0};
      const int count = checked(condyle_free_angles(joint, 2, start, held, 180, 180));
      answers << "free " << flexion << ' ' << adduction;
      for (int i = 0; i < 4 * count; ++i) answers << ' ' << bits(condyle_intervals(joint)[i]);
      answers << '\n';
    }
}

/// A layer of 2 mm on either bone: the sample's bones overlap in its poses as much.
void add_layers(CondyleJoint* joint, const Scene& scene) {
  const int vertices[] = {static_cast<int>(scene.mobile.size() / 3),
                          static_cast<int>(scene.fixed.size() / 3)};
  const int triangles[] = {static_cast<int>(scene.mobile_triangles.size() / 3),
                           static_cast<int>(scene.fixed_triangles.size() / 3)};
  for (const int of_fixed : {0, 1}) {
    const std::vector<double> thickness(static_cast<std::size_t>(vertices[of_fixed]), 2.0);
    checked(condyle_surface(joint, of_fixed, 0, vertices[of_fixed], 0, triangles[of_fixed], 10, 0.45,
                            thickness.data()));
  }
  checked(condyle_elastic(joint, 2, 0, 1, 20));
}

CondyleJoint* joint_of(const Scene& scene) {
  CondyleJoint* joint =
      condyle_joint(0, 0, 0, 0, scene.fixed.data(), static_cast<int>(scene.fixed.size() / 3),
                    scene.fixed_triangles.data(), static_cast<int>(scene.fixed_triangles.size() / 3),
                    scene.mobile.data(), static_cast<int>(scene.mobile.size() / 3),
                    scene.mobile_triangles.data(), static_cast<int>(scene.mobile_triangles.size() / 3));
  if (!joint) throw std::runtime_error(condyle_error());
  return joint;
}

/// Vertices of a body from the nearest to the farthest from a point; only the first are in order.
std::vector<std::uint32_t> vertices_near(const std::vector<double>& xyz, const Vec3& point,
                                         std::size_t count) {
  std::vector<std::uint32_t> vertices(xyz.size() / 3);
  for (std::uint32_t v = 0; v < vertices.size(); ++v) vertices[v] = v;
  const auto distance = [&](std::uint32_t v) {
    return (Vec3(xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]) - point).norm();
  };
  std::partial_sort(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(count), vertices.end(),
                    [&](auto a, auto b) { return distance(a) < distance(b); });
  vertices.resize(count);
  return vertices;
}

/// FNV-1a of 32 bits.
std::uint32_t digest_of(const std::vector<double>& values) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  std::uint32_t hash = 2166136261u;
  for (std::size_t i = 0; i < values.size() * sizeof(double); ++i) hash = (hash ^ bytes[i]) * 16777619u;
  return hash;
}

/// Volume, deepest place, its vertex, edges; and every vertex with its depth.
std::string brushed(const CondyleJoint* joint, int of_fixed, std::size_t vertices) {
  double removed[4];
  checked(condyle_removed(joint, of_fixed, removed));
  std::vector<double> xyz(3 * vertices), depths(vertices);
  checked(condyle_brushed(joint, of_fixed, xyz.data(), depths.data()));
  std::string text;
  for (const double value : removed) text += bits(value) + ' ';
  return text + std::to_string(digest_of(xyz)) + ' ' + std::to_string(digest_of(depths));
}

void answer_stroke(CondyleJoint* joint, int of_fixed, int action, const std::vector<std::uint32_t>& along,
                   double radius_mm, double depth_mm, std::size_t vertices, std::ostream& answers) {
  std::uint32_t outcome[3];
  checked(condyle_stroke(joint, of_fixed, action, along.data(), static_cast<int>(along.size()), radius_mm,
                         depth_mm, outcome));
  answers << "stroke " << of_fixed << ' ' << action << ' ' << bits(radius_mm) << ' ' << bits(depth_mm);
  for (const std::uint32_t v : along) answers << ' ' << v;
  answers << " =";
  for (const std::uint32_t count : outcome) answers << ' ' << count;
  answers << ' ' << brushed(joint, of_fixed, vertices) << '\n';
}

void answer_about(CondyleJoint* joint, const motion::Motion& motion, std::ostream& answers) {
  const std::array start = start_of(motion);
  double limit[8];
  checked(condyle_limit_about(joint, static_cast<int>(motion.vary), motion.sense == RotationSense::positive,
                              start.data(), motion.range.degrees(), limit));
  answers << "about " << static_cast<int>(motion.vary) << ' ' << (motion.sense == RotationSense::positive);
  for (const double value : start) answers << ' ' << bits(value);
  answers << ' ' << bits(motion.range.degrees()) << " =";
  for (const double value : limit) answers << ' ' << bits(value);
  answers << '\n';
}

/// A string in front, one behind over the head, and one from the fixed body over its own cylinder; of nobody.
constexpr const char* ligaments =
    "[[ligament]]\nname = \"front\"\nfixed = [30, 28, 8]\nmobile = [12, -38, 30]\nslack_length = "
    "74\nstiffness_n = 500\n"
    "ends_at_strain = 0.1\n[[ligament]]\nname = \"behind\"\nfixed = [-28, -15, 10]\nmobile = [2, 5, "
    "48]\nslack_length = 62\n"
    "ends_at_strain = 0.2\nwrap = { shape = \"sphere\", body = \"mobile\", centre = [0, 0, 0], radius = 24 "
    "}\n[[ligament]]\n"
    "name = \"over\"\nfixed = [0, 60, 30]\nmobile = [0, -20, 60]\nslack_length = 80\n"
    "wrap = { shape = \"cylinder\", body = \"fixed\", centre = [0, 10, 40], axis = [1, 0, 0], radius = 15 "
    "}\n";

/// The limits that ligaments leave, about both centres, and what is shown of them at some poses.
void answer_ligaments(CondyleJoint* joint, const std::string& folder, std::ostream& answers) {
  std::ofstream(folder + "/ligaments.toml") << ligaments;
  checked(condyle_set_ligaments(joint, ligaments));
  answers << "strings = 0\n";
  for (const motion::Motion& motion : motion::hip_motions()) answer_limit(joint, motion, answers);
  const double centre[] = {1.5, -2, 0.5}, reference[] = {0, 0, 0};
  checked(condyle_move_centre(joint, centre, reference));
  answers << "centre " << bits(centre[0]) << ' ' << bits(centre[1]) << ' ' << bits(centre[2]) << " = 0\n";
  for (const motion::Motion& motion : motion::hip_motions()) answer_about(joint, motion, answers);
  for (int flexion = -20; flexion <= 120; flexion += 20) {
    const double angles[] = {double(flexion), 5, -10}, none[] = {0, 0, 0};
    double X[16];
    checked(condyle_pose(joint, angles, none, X));
    const char* said = condyle_ligaments(joint, X);
    if (!said) throw std::runtime_error(condyle_error());
    answers << "shown " << flexion << " = " << said << '\n';
  }
}

/// Strokes on both bones where internal rotation ends at 90 degrees of flexion, the limits after each, one stroke taken back, and the limits
/// about another centre.
void answer_edits(const Scene& scene, const std::string& folder) {
  CondyleJoint* joint = joint_of(scene);
  std::ofstream answers(folder + "/edits.txt");
  const std::size_t vertices[] = {scene.mobile.size() / 3, scene.fixed.size() / 3};
  const sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::two);
  const Joint named{"sample", JointKind::ball, Side::right, {"hip bone", hip.hip_bone}, {"femur", hip.femur}};
  const auto contact =
      *motion::RangeOfMotion(named)
           .limit(motion::motion_named(motion::hip_motions(), "internal_rotation_at_90_flexion"))
           .end.contact;
  const std::vector<std::uint32_t> along[] = {vertices_near(scene.mobile, contact.mobile_point, 3),
                                              vertices_near(scene.fixed, contact.fixed_point, 3)};
  const auto answer_limits = [&] {
    for (const motion::Motion& motion : motion::hip_motions()) answer_limit(joint, motion, answers);
  };
  for (const int of_fixed : {0, 1}) {
    answers << "brush " << of_fixed << " = " << checked(condyle_brush(joint, of_fixed, nullptr)) << '\n';
    answer_stroke(joint, of_fixed, 0, along[of_fixed], 6, 1.5, vertices[of_fixed], answers);
    answer_limits();
    answer_stroke(joint, of_fixed, 0, {along[of_fixed][0]}, 3, 12, vertices[of_fixed], answers);
    answer_stroke(joint, of_fixed, 1, {along[of_fixed][1]}, 4, 1, vertices[of_fixed], answers);
    answer_limits();
    answers << "undo " << of_fixed << " = " << checked(condyle_undo_stroke(joint, of_fixed)) << ' '
            << brushed(joint, of_fixed, vertices[of_fixed]) << '\n';
  }
  const double centre[] = {1.5, -2, 0.5}, reference[] = {0, 0, 0};
  checked(condyle_move_centre(joint, centre, reference));
  answers << "centre " << bits(centre[0]) << ' ' << bits(centre[1]) << ' ' << bits(centre[2]) << " = 0\n";
  for (const motion::Motion& motion : motion::hip_motions()) answer_about(joint, motion, answers);
  answer_ligaments(joint, folder, answers);
  condyle_free(joint);
  if (!answers) throw std::runtime_error(folder + " cannot be written");
}

void answer(const Scene& scene, const std::string& folder) {
  CondyleJoint* joint = joint_of(scene);
  add_layers(joint, scene);
  const auto limits = limits_of_poses(joint->joint);
  const std::size_t vertices[] = {scene.mobile.size() / 3, scene.fixed.size() / 3};
  std::ofstream answers(folder + "/answers.txt"), shown(folder + "/shown.bin", std::ios::binary);
  double X[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  for (std::size_t i = 0; i < scene.questions.size() / 6; ++i) {
    double before[16];
    std::copy_n(X, 16, before);
    answer_pose(joint, &scene.questions[6 * i], X, answers);
    constexpr std::size_t every = 50;  // distances of all vertices take long
    if (i % every == 0) answer_shown(joint, X, vertices, shown);
    constexpr std::size_t every_depth = 10;  // tables about the joint's axes are made for each
    if (i % every_depth == 0) {
      answer_depth(joint, &scene.questions[6 * i], X, answers);
      answer_screw(joint, before, X, answers);
      answer_standing(joint, *limits, &scene.questions[6 * i], X, answers);
    }
  }
  for (const motion::Motion& motion : motion::hip_motions()) answer_limit(joint, motion, answers);
  answer_map(joint, answers);
  condyle_free(joint);
  if (!answers || !shown) throw std::runtime_error(folder + " cannot be written");
}

}  // namespace

int main(int count, char** arguments) try {
  const bool is_sample = count == 3 && std::string_view(arguments[1]) == "--sample";
  if (count != 2 && !is_sample) return 2;
  const std::string folder = arguments[count - 1], path = folder + "/scene.bin";
  if (is_sample) write_scene(path, sample_scene());
  const Scene scene = read_scene(path);
  answer(scene, folder);
  if (is_sample) answer_edits(scene, folder);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
