#include "command.hpp"
#include "condyle/hip_measures.hpp"
#include "condyle/io/joint_file.hpp"

/// `condyle measure` says what measure_hip() answers, every measure once.

namespace condyle::test {
namespace {

class MeasureCommand : public CommandTest {
 protected:
  void SetUp() override { sample_into(here, "hip"); }
  Json measured(const std::string& arguments) const { return answer("measure hip.toml " + arguments); }
  static double value_of(const Json& json, std::string_view key) {
    for (const Json& each : json["measures"])
      if (each["key"] == key) return each["value"].get<double>();
    ADD_FAILURE() << key;
    return 0;
  }
};

TEST_F(MeasureCommand, SaysWhatTheLibraryAnswers) {
  const measure::HipMeasures expected = measure::measure_hip(io::read_joint(folder / "hip.toml").joint);
  const Json json = measured("");
  ASSERT_EQ(json["measures"].size(), measure::measure_definitions().size());
  for (std::size_t i = 0; i < measure::measure_definitions().size(); ++i) {
    const measure::MeasureDefinition& definition = measure::measure_definitions()[i];
    const measure::Measure& measure = definition.of(expected);
    const Json& said = json["measures"][i];
    EXPECT_EQ(said["key"], definition.key);
    if (measure.value) {
      EXPECT_EQ(said["value"], *measure.value) << definition.key;
    } else {
      EXPECT_EQ(said["why_none"], measure.why_none);
    }
  }
  EXPECT_EQ(json["around_neck"].size(), expected.femur.around_neck.size());
  EXPECT_EQ(json["rim"].size(), expected.acetabulum.rim.size());
  const std::string text = run("measure hip.toml").out;
  for (const measure::MeasureDefinition& definition : measure::measure_definitions())
    EXPECT_TRUE(says(text, " " + std::string(definition.key) + " ")) << definition.key;
  EXPECT_TRUE(says(text, "femoral_version_deg: the mesh ends above the knee"));
}

TEST_F(MeasureCommand, TiltsThePelvisAndNotTheFemur) {
  const Json level = measured(""), tilted = measured("--tilt 10");
  EXPECT_EQ(value_of(level, "alpha_3_deg"), value_of(tilted, "alpha_3_deg"));
  // Tilted forwards a socket comes over the head from in front: seen from above it opens less to the front.
  EXPECT_LT(value_of(tilted, "acetabular_version_deg"), value_of(level, "acetabular_version_deg") - 3);
  EXPECT_EQ(run("measure hip.toml --tilt 61").exit_code, 2);
}

/// The frame of a sample's joint file by landmarks in place of axes.
void by_landmarks(const TemporaryFolder& folder, const char* name, const std::string& landmarks) {
  const std::string text = io::read_whole_file(folder / "hip.toml");
  const std::size_t axes = text.find("anterior = "), end = text.find('\n', text.find("superior = "));
  ASSERT_NE(axes, text.npos);
  std::ofstream(folder / name) << text.substr(0, axes) << "[frame.landmarks]\n"
                               << landmarks << text.substr(end);
}

TEST_F(MeasureCommand, NamesTheFrameOfEveryAngleThatTurnsWithThePelvis) {
  // Upwards in the anterior pelvic plane is from the symphysis to between the spines: as if the scan were tilted by 10 degrees.
  constexpr double tilt = 10 * 3.14159265358979323846 / 180;
  const std::string spines = "right_asis = [0, 0, 120]\nleft_asis = [0, 0, -120]\n";
  by_landmarks(folder, "plane.toml",
               spines + fmt::format("pubic_symphysis = [{}, -90, 0]\n", 90 * std::tan(tilt)));
  by_landmarks(folder, "isb.toml", spines + "right_psis = [-150, 0, 45]\nleft_psis = [-150, 0, -45]\n");
  const Json scanned = measured(""), tilted = measured("--tilt 10");
  const Json plane = answer("measure plane.toml");
  EXPECT_EQ(scanned["pelvis_frame"], "as scanned");
  EXPECT_EQ(tilted["pelvis_frame"], "as scanned, tilt 10 deg given");
  EXPECT_EQ(plane["pelvis_frame"], "anterior pelvic plane");
  EXPECT_EQ(answer("measure isb.toml --tilt -5")["pelvis_frame"],
            "plane of ASIS and PSIS, tilt -5 deg given");
  std::size_t turning = 0;
  for (std::size_t i = 0; i < measure::measure_definitions().size(); ++i) {
    const Json &at = tilted["measures"][i], &in_plane = plane["measures"][i];
    if (!measure::measure_definitions()[i].in_pelvis_frame) {
      EXPECT_TRUE(at["frame"].is_null());
      continue;
    }
    ++turning;
    EXPECT_EQ(at["frame"], tilted["pelvis_frame"]);
    EXPECT_EQ(in_plane["frame"], "anterior pelvic plane");
    EXPECT_NEAR(at["value"], in_plane["value"], 1e-6) << at["key"];
  }
  EXPECT_EQ(turning, 11u);
  EXPECT_TRUE(says(run("measure hip.toml").out, "pelvis: as scanned: the pelvis may have lain turned"));
  EXPECT_TRUE(says(run("measure plane.toml").out, "pelvis: anterior pelvic plane\n"));
}

TEST_F(MeasureCommand, SaysThatAxesOfTheFemurAreNotThePelvis) {
  by_landmarks(folder, "femur.toml",
               "medial_epicondyle = [0, -400, -40]\nlateral_epicondyle = [0, -400, 40]\n");
  EXPECT_EQ(answer("measure femur.toml")["pelvis_frame"], "the femur's epicondyles, not the pelvis");
}

TEST_F(MeasureCommand, GivesTheLibrarysBands) {
  const Json json = measured("--band=20 --seed 3");
  const auto bands =
      measure::measure_bands(io::read_joint(folder / "hip.toml").joint, {}, {.samples = 20, .seed = 3});
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const Json& band = json["measures"][i]["band"];
    EXPECT_EQ(band["p5"], bands[i].p5 ? Json(*bands[i].p5) : Json(nullptr)) << json["measures"][i]["key"];
    EXPECT_EQ(band["p95"], bands[i].p95 ? Json(*bands[i].p95) : Json(nullptr));
    EXPECT_EQ(band["samples_without_value"], bands[i].samples_without_value);
  }
  EXPECT_TRUE(says(run("measure hip.toml --band=20").out, "5 to 95 % of 20 joints"));
  EXPECT_TRUE(measured("")["band"].is_null());
}

TEST_F(MeasureCommand, WritesTables) {
  done("measure hip.toml --out out");
  const auto rows = [&](const char* name) { return lines_of(text_of(name)).size() - 1; };
  EXPECT_EQ(rows("out/measures.csv"), measure::measure_definitions().size());
  EXPECT_GT(rows("out/neck.csv"), 30u);
  EXPECT_GT(rows("out/rim.csv"), 30u);
  EXPECT_EQ(json_of("out/measures.json")["measures"], measured("")["measures"]);
}

TEST_F(MeasureCommand, RefusesWhatIsNoHip) {
  write_edited("hinge.toml", "hip.toml", "kind = \"ball\"", "kind = \"hinge\"");
  expect_refused(2, "measure hinge.toml", "hip");
}

}  // namespace
}  // namespace condyle::test
