#include <numeric>
#include <sstream>

#include "motion_scene.hpp"

/// Options of recorded motions that change the answer, and what maps hold.

namespace condyle::test {
namespace {

/// A ball lowered by half a millimetre into its cup, 0.3 mm deep.
class MotionOptions : public Motion {
 protected:
  void SetUp() override {
    Motion::SetUp();
    write("lower.csv", "time,y_mm\n0,-0.3\n0.1,-0.5\n");
  }
  /// A number of the last frame.
  std::function<double(const char*)> last_frame(const std::string& options) const {
    const Ran ran = run("motion cup.toml --motion lower.csv --load --out out " + options);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    const NumberTable curves = csv_of(folder / "out/curves.csv");
    return [curves](const char* name) { return curves.rows.back()[curves.column(name)]; };
  }
  static double modulus(double e, double nu) { return (1 - nu) * e / ((1 + nu) * (1 - 2 * nu)); }
};

/// The deepest place has pressure M d / h, or -M ln(1 - d / h), of the layer that is asked for.
TEST_F(MotionOptions, LayersAndLawsAreThoseGiven) {
  struct Case {
    const char* options;
    double e, nu, h;
    bool is_logarithmic;
  };
  for (const Case& c :
       {Case{"", 10, 0.45, 6, false}, Case{"--e 20", 20, 0.45, 6, false}, Case{"--nu 0.3", 10, 0.3, 6, false},
        Case{"--thickness 2", 10, 0.45, 2, false}, Case{"--law logarithmic --thickness 2", 10, 0.45, 2, true},
        Case{"--law linear --e 5 --nu 0.4", 5, 0.4, 6, false}}) {
    const auto value = last_frame(c.options);
    const double share = value("max_depth_mm") / c.h;
    const double expected = modulus(c.e, c.nu) * (c.is_logarithmic ? -std::log1p(-share) : share);
    EXPECT_NEAR(value("max_pressure_mpa"), expected, 1e-12 * expected) << c.options;
  }
}

/// Two layers are as soft as both together: 1 / K = h_1 / M_1 + h_2 / M_2. All three values given once are of both bodies.
TEST_F(MotionOptions, LayersOfBothBodiesAreThoseGiven) {
  const auto value = last_frame("--e 10 20 --nu 0.45 0.3 --thickness 6 2");
  const double expected = value("max_depth_mm") / (6 / modulus(10, 0.45) + 2 / modulus(20, 0.3));
  EXPECT_NEAR(value("max_pressure_mpa"), expected, 1e-12 * expected);
  const auto alike = last_frame("--e 5 --nu 0.4 --thickness 1");
  const double half = modulus(5, 0.4) * alike("max_depth_mm") / 2;
  EXPECT_NEAR(alike("max_pressure_mpa"), half, 1e-12 * half);
}

TEST_F(MotionOptions, RulesAndCastingsAreThoseOfALoad) {
  for (const char* options : {"--rule face_centre", "--rule cut_faces", "--casting mobile --rule face_centre",
                              "--casting fixed --reach 0.1"}) {
    const auto value = last_frame(options);
    const Json load = answer("load cup.toml --pose y=-0.5 " + std::string(options));
    const bool of_mobile = std::string(options).find("mobile") != std::string::npos;
    const Json& surface = load[of_mobile ? "mobile_surface" : "fixed_surface"];
    for (const char* name :
         {"area_mm2", "mean_depth_mm", "max_depth_mm", "mean_pressure_mpa", "max_pressure_mpa"})
      EXPECT_EQ(value(name), surface[name].get<double>()) << options << " " << name;
    EXPECT_EQ(value(of_mobile ? "force_in_mobile_y_n" : "force_in_fixed_y_n"),
              surface["force_n"][1].get<double>())
        << options;
  }
  const auto centres = last_frame("--rule face_centre"), cut = last_frame("--rule cut_faces");
  EXPECT_NE(centres("area_mm2"), cut("area_mm2"));
  // Whole triangles or parts of them: no further apart than a row of triangles, 1.5 mm wide, along the border.
  EXPECT_NEAR(centres("area_mm2"), cut("area_mm2"), 2 * std::numbers::pi * 25 * 1.5);
}

/// The numbers of an array of a text file.
std::vector<double> array_of(const std::string& vtp, const std::string& name) {
  const std::size_t at = vtp.find("Name=\"" + name + "\"");
  EXPECT_NE(at, vtp.npos) << name;
  if (at == vtp.npos) return {};
  const std::size_t from = vtp.find('>', at) + 1;
  std::istringstream numbers(vtp.substr(from, vtp.find('<', from) - from));
  std::vector<double> values;
  for (double value; numbers >> value;) values.push_back(value);
  return values;
}

TEST_F(MotionOptions, MapsAddUpToTheCurves) {
  const auto value = last_frame("--maps --ascii");
  const std::string fixed = text_of("out/map_fixed_00001.vtp"), mobile = text_of("out/map_mobile_00001.vtp");
  const auto area = array_of(fixed, "contact_area_mm2"), depth = array_of(fixed, "depth_mm"),
             pressure = array_of(fixed, "pressure_mpa");
  ASSERT_EQ(area.size(), cup(25, 5).triangles.size());
  ASSERT_EQ(depth.size(), area.size());
  ASSERT_EQ(pressure.size(), area.size());
  const double whole = std::accumulate(area.begin(), area.end(), 0.0);
  EXPECT_NEAR(whole, value("area_mm2"), 1e-10 * whole);
  const auto mean = [&](const std::vector<double>& of) {
    return std::inner_product(of.begin(), of.end(), area.begin(), 0.0) / whole;
  };
  EXPECT_NEAR(mean(depth), value("mean_depth_mm"), 1e-10);
  EXPECT_NEAR(mean(pressure), value("mean_pressure_mpa"), 1e-10);
  for (std::size_t t = 0; t < area.size(); ++t) {
    EXPECT_EQ(area[t] > 0, depth[t] > 0) << t;
    EXPECT_LE(depth[t], value("max_depth_mm")) << t;
    EXPECT_LE(pressure[t], value("max_pressure_mpa")) << t;
  }
  EXPECT_FALSE(says(mobile, "pressure_mpa")) << "it does not cast";
  // The ball is where the frame has it: lowered by half a millimetre.
  const auto points = array_of(mobile, "Points");
  double lowest = 0;
  for (std::size_t i = 1; i < points.size(); i += 3) lowest = std::min(lowest, points[i]);
  EXPECT_NEAR(lowest, -24.8 - 0.5, 0.02) << "facets of 1.5 mm sag by 0.012 mm";
  const std::string series = text_of("out/motion.pvd");
  for (const char* file :
       {"map_fixed_00000.vtp", "map_mobile_00000.vtp", "map_fixed_00001.vtp", "map_mobile_00001.vtp"})
    EXPECT_TRUE(says(series, file)) << file;
}

}  // namespace
}  // namespace condyle::test
