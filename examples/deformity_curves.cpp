// The curves of docs/deformities.md: internal rotation at 90 degrees of flexion against the alpha angle (cam)
// and against the lateral centre-edge angle (pincer), as SVG files in the folder given and as tables.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "condyle/range_of_motion.hpp"
#include "condyle/sample/hip.hpp"
#include "io/result/plot_axes.hpp"
#include "sample/femur_shape.hpp"

namespace {

using condyle::Angle, condyle::HipParameters;

struct CurvePoint {
  double parameter_deg, rotation_deg;
};

struct Curve {
  std::string title, file, parameter;
  double low, high;  // degrees, of the axis
  std::vector<CurvePoint> points;
};

double internal_rotation_at_90_flexion_deg(const HipParameters& parameters) {
  const condyle::SampleHip hip = condyle::sample_hip(parameters, condyle::Scenario::three);
  const condyle::RangeOfMotion range({"sample hip",
                                      condyle::JointKind::ball,
                                      condyle::Side::right,
                                      {"hip bone", hip.hip_bone},
                                      {"femur", hip.femur}});
  const auto motions = condyle::hip_motions();
  return range.limit(condyle::motion_named(motions, "internal_rotation_at_90_flexion")).end.turned.degrees();
}

/// Evenly spaced values, both ends included; at least two.
std::vector<double> values(double first, double last, int count) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(first + (last - first) * i / (count - 1));
  return all;
}

Curve cam_curve(int count) {
  Curve curve = {"Cam: the alpha angle", "alpha_angle.svg", "alpha angle", 50, 90, {}};
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
  Curve curve = {"Pincer: the lateral centre-edge angle",
                 "centre_edge_angle.svg",
                 "lateral centre-edge angle",
                 15,
                 45,
                 {}};
  HipParameters hip;
  for (const double centre_edge : values(18, 45, count)) {
    hip.lateral_centre_edge_angle = Angle::degrees(centre_edge);
    curve.points.push_back({centre_edge, internal_rotation_at_90_flexion_deg(hip)});
  }
  return curve;
}

std::string drawing(const Curve& curve) {
  namespace palette = condyle::io::palette;
  constexpr double width = 640, height = 420;
  condyle::io::SvgCanvas canvas(width, height, curve.title);
  condyle::io::draw_heading(canvas, {curve.title, "Internal rotation at 90\xC2\xB0 flexion, sample hip"});
  const condyle::io::PlotScale x{curve.low, curve.high, 84, width - 40}, y{0, 60, height - 92, 84};
  constexpr int x_steps = 8, y_steps = 6;
  for (const double value :
       condyle::io::ticks(y.low, y.high, condyle::io::tick_step(y.high - y.low, y_steps)))
    canvas.line({x.px_low, y(value)}, {x.px_high, y(value)}, {.stroke = palette::light_grey});
  condyle::io::draw_bottom_axis(canvas, x, y.px_low, x_steps, curve.parameter + ", degrees");
  condyle::io::draw_left_axis(canvas, y, x.px_low, y_steps, "internal rotation, degrees");
  std::vector<condyle::io::ScreenPoint> line;
  for (const auto& [parameter, rotation] : curve.points) line.push_back({x(parameter), y(rotation)});
  canvas.polyline(line, {.stroke = palette::blue, .stroke_width = 2});
  for (const condyle::io::ScreenPoint& at : line)
    canvas.circle(at, 4.5, {.fill = palette::blue, .stroke = palette::paper, .stroke_width = 1.2});
  condyle::io::draw_footer(canvas);
  return canvas.document();
}

void write(const std::filesystem::path& folder, const Curve& curve) {
  std::ofstream out(folder / curve.file);
  out << drawing(curve);
  if (!out.flush()) throw std::runtime_error((folder / curve.file).string() + ": cannot be written");
  std::printf("| %s | internal rotation |\n|---:|---:|\n", curve.parameter.c_str());
  for (const auto& [parameter, rotation] : curve.points)
    std::printf("| %.1f\xC2\xB0 | %.1f\xC2\xB0 |\n", parameter, rotation);
  std::printf("\n");
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
