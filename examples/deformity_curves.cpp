// The curves of docs/sample-hips.md: internal rotation at 90 degrees of flexion against the alpha angle (cam)
// and against the lateral centre-edge angle (pincer), as CSV files in the folder given and as tables.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "condyle/range_of_motion.hpp"
#include "condyle/sample/hip.hpp"
#include "sample/femur_shape.hpp"

namespace {

using condyle::Angle, condyle::sample::HipParameters;

struct CurvePoint {
  double parameter_deg, rotation_deg;
};

struct Curve {
  std::string name;  // of what was varied: "alpha_angle"
  std::vector<CurvePoint> points;
};

double internal_rotation_at_90_flexion_deg(const HipParameters& parameters) {
  const condyle::sample::SampleHip hip =
      condyle::sample::sample_hip(parameters, condyle::sample::Scenario::three);
  const condyle::motion::RangeOfMotion range({"sample hip",
                                              condyle::JointKind::ball,
                                              condyle::Side::right,
                                              {"hip bone", hip.hip_bone},
                                              {"femur", hip.femur}});
  const auto motions = condyle::motion::hip_motions();
  return range.limit(condyle::motion::motion_named(motions, "internal_rotation_at_90_flexion"))
      .end.turned.degrees();
}

/// Evenly spaced values, both ends included; at least two.
std::vector<double> values(double first, double last, int count) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(first + (last - first) * i / (count - 1));
  return all;
}

Curve cam_curve(int count) {
  Curve curve = {"alpha_angle", {}};
  // The first point is the hip without a cam.
  HipParameters hip;
  const double native = condyle::sample::native_alpha_angle(hip).degrees();
  curve.points.push_back({native, internal_rotation_at_90_flexion_deg(hip)});
  for (const double alpha : values(54, 90, count)) {
    hip.alpha_angle = Angle::degrees(alpha);
    curve.points.push_back({alpha, internal_rotation_at_90_flexion_deg(hip)});
  }
  return curve;
}

Curve pincer_curve(int count) {
  Curve curve = {"lateral_centre_edge_angle", {}};
  HipParameters hip;
  for (const double centre_edge : values(18, 45, count)) {
    hip.lateral_centre_edge_angle = Angle::degrees(centre_edge);
    curve.points.push_back({centre_edge, internal_rotation_at_90_flexion_deg(hip)});
  }
  return curve;
}

void write(const std::filesystem::path& folder, const Curve& curve) {
  const std::filesystem::path path = folder / (curve.name + ".csv");
  std::ofstream out(path);
  out << curve.name << "_deg,internal_rotation_deg\n";
  std::string words = curve.name;
  std::replace(words.begin(), words.end(), '_', ' ');
  std::printf("| %s | internal rotation |\n|---:|---:|\n", words.c_str());
  for (const auto& [parameter, rotation] : curve.points) {
    out << parameter << ',' << rotation << '\n';
    std::printf("| %.1f\xC2\xB0 | %.1f\xC2\xB0 |\n", parameter, rotation);
  }
  std::printf("\n");
  if (!out.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 2 ? std::atoi(argv[2]) : 10;
  if (argc < 2 || count < 2) {
    std::fprintf(stderr, "usage: %s FOLDER [POINTS]   at least two points per curve; 10 if not given\n",
                 argv[0]);
    return 2;
  }
  try {
    std::filesystem::create_directories(argv[1]);
    write(argv[1], cam_curve(count));
    write(argv[1], pincer_curve(count));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
