#include "command.hpp"
#include "condyle/contact.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/model_file.hpp"
#include "support/duct_model.hpp"

/// Limits written for other programs: what the files hold is what bone does, and they are read back.

namespace condyle::test {
namespace {

class WrittenLimits : public CommandTest {
 protected:
  void SetUp() override {
    write_duct_model(folder / "model.osim");
    done("init model.osim --joint hip_r -o hip.toml");
  }
  Ran written(const std::string& arguments) const {
    return done("rom hip.toml --motion flexion " + arguments);
  }
  const io::ModelCoordinate coordinate(const char* model, std::size_t i) const {
    return io::joint_named(io::read_model(folder / model), "hip_r").coordinates.at(i);
  }
};

TEST_F(WrittenLimits, OfACopyOfTheModelAreThoseOfBoneAndReadBack) {
  for (const char* stop : {"limit", "linear"}) {
    written(fmt::format("--write-limits {0}.osim --model model.osim --stop {0}", stop));
    const std::string copy = std::string(stop) + ".osim";
    const io::Model model = io::read_model(folder / copy);
    EXPECT_TRUE(model.notes.empty());
    const auto [forwards, backwards] = duct_flexion_deg();
    const auto [inwards, outwards] = duct_adduction_deg();
    // The model's flexion grows backwards, and its adduction is ours.
    const double wanted[][2] = {{-forwards, backwards}, {-outwards, inwards}};
    for (std::size_t i = 0; i < 2; ++i) {
      const io::ModelCoordinate of = coordinate(copy.c_str(), i);
      EXPECT_TRUE(of.is_clamped);
      ASSERT_TRUE(of.range && of.stop) << of.name;
      for (std::size_t end = 0; end < 2; ++end) {
        EXPECT_NEAR((*of.range)[end] * 180 / std::numbers::pi, wanted[i][end], 1e-9) << of.name;
        EXPECT_NEAR((*of.stop)[end] * 180 / std::numbers::pi, wanted[i][end], 1e-9) << of.name;
      }
    }
    done(fmt::format("init {0} --joint hip_r -o {1}.toml", copy, stop));
    const auto file = io::read_joint_file(folder / (std::string(stop) + ".toml"));
    const auto& columns = std::get<std::vector<io::ColumnOfCoordinate>>(*file.recorded_motion);
    ASSERT_TRUE(columns[0].range);
    EXPECT_NEAR(columns[0].range->front(), -forwards, 1e-9);
    EXPECT_NEAR(columns[0].range->back(), backwards, 1e-9);
    EXPECT_TRUE(says(text_of(std::string(stop) + ".toml"), "# flex: held from -"));
  }
  const Json of = answer("inspect linear.osim")["models"][0]["joints"][0]["coordinates"];
  EXPECT_NEAR(of[1]["stop"][1], duct_adduction_deg()[0] * std::numbers::pi / 180, 1e-11);
  EXPECT_TRUE(says(run("inspect linear.osim").out, "flex (held from -"));
}

TEST_F(WrittenLimits, LeaveTheRestOfAModelAsItIs) {
  written("--write-limits once.osim --model model.osim");
  const std::string before = text_of("model.osim");
  std::string after = text_of("once.osim");
  // What was put in goes, and what is left is the model but for its ranges.
  const auto cut = [&](std::string_view from, std::string_view to) {
    const std::size_t begin = after.find(from), end = after.find(to, begin);
    ASSERT_NE(end, after.npos) << from;
    after.erase(begin, end + to.size() - begin);
  };
  cut("\n<!--", "-->\n");
  cut("\n<ForceSet", "</ForceSet>");
  for (const char* element : {"range", "clamped"})
    for (int i = 0; i < 3; ++i)
      if (const auto begin = after.find(fmt::format("<{}>", element)); begin != after.npos)
        cut(fmt::format("<{}>", element), fmt::format("</{}>", element));
  std::string bare = before;
  bare.erase(bare.find("<range>"), bare.find("</range>") + 8 - bare.find("<range>"));
  bare.replace(bare.find("<Coordinate name=\"add\"/>"), 24, "<Coordinate name=\"add\"></Coordinate>");
  EXPECT_EQ(after, bare);
  // Written again, the forces are replaced.
  written("--write-limits twice.osim --model once.osim");
  EXPECT_EQ(io::read_model(folder / "twice.osim").ignored, io::read_model(folder / "once.osim").ignored);
  // Somebody else's stays, and is named.
  std::string mixed = text_of("once.osim");
  mixed.replace(mixed.find("condyle_limit_flex"), 18, "soft stop");
  write("mixed.osim", mixed);
  const std::string said = written("--write-limits thrice.osim --model mixed.osim").out;
  EXPECT_TRUE(says(said, "flex has a stop of the model's own too, which stays: 'soft stop': held"));
  EXPECT_TRUE(says(text_of("thrice.osim"), "which stays: 'soft stop'"));
}

TEST_F(WrittenLimits, OfMuJoCoTurnAboutTheModelsAxesInItsSense) {
  written("--write-limits hip.xml");
  const std::string text = text_of("hip.xml");
  const auto [forwards, backwards] = duct_flexion_deg();
  const std::string line = text.substr(text.find("<joint name=\"flex\""));
  double x = 0, y = 0, z = 0, low = 0, high = 0;
  ASSERT_EQ(std::sscanf(line.c_str(),
                        "<joint name=\"flex\" type=\"hinge\" axis=\"%lf %lf %lf\" pos=\"0 0 0\" "
                        "limited=\"true\" range=\"%lf %lf\"/>",
                        &x, &y, &z, &low, &high),
            5)
      << text;
  EXPECT_EQ((Vec3(x, y, z)), -Vec3::UnitZ());
  EXPECT_NEAR(low, -forwards, 1e-9);
  EXPECT_NEAR(high, backwards, 1e-9);
  EXPECT_TRUE(says(text, "<mujocoinclude>"));
  EXPECT_EQ(text.find("<!-- angles are degrees, of <compiler angle=\"degree\"/>, MuJoCo's default"), 0u);
}

TEST_F(WrittenLimits, OfAMapAreItsFreeIntervalsInTheModelsCoordinates) {
  written("--map adduction=-20:10:10 internal_rotation=0:60:20 --write-limits coupled.csv");
  const Json said = Json::parse(
      written("--map adduction=-20:10:10 internal_rotation=0:60:20 --write-limits again.csv --json").out);
  const Json& intervals = said["map"]["intervals"];
  const std::vector<std::string> lines = lines_of(text_of("coupled.csv"));
  EXPECT_EQ(lines[0], "add_deg,rot_deg,flex_lower_deg,flex_upper_deg,flex_lower_reason,flex_upper_reason");
  ASSERT_EQ(lines.size(), 17u);
  for (std::size_t i = 0; i < 16; ++i) {
    const std::string& line = lines[i + 1];
    double adduction = 0, rotation = 0, lower = 0, upper = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,", &adduction, &rotation, &lower, &upper), 4)
        << line;
    EXPECT_EQ(adduction, -20 + 10.0 * static_cast<double>(i % 4));
    EXPECT_EQ(rotation, 20.0 * static_cast<double>(i / 4));
    // The free interval about zero; flex is negative flexion.
    std::size_t k = intervals["offset"][i];
    while (intervals["high_deg"][k] < 0) ++k;
    ASSERT_LT(k, intervals["offset"][i + 1].get<std::size_t>());
    EXPECT_EQ(lower, -intervals["high_deg"][k].get<double>());
    EXPECT_EQ(upper, -intervals["low_deg"][k].get<double>());
  }
}

/// Whether the bodies meet with the model's coordinates at these degrees.
class Poses {
 public:
  explicit Poses(const fs::path& joint) : loaded_(io::read_joint(joint)), contact_(loaded_.joint) {}
  bool meet(double flex, double add, double rot) const {
    return contact_.in_contact(pose_at(loaded_.joint.coordinates(),
                                       {Angle::degrees(-flex), Angle::degrees(add), Angle::degrees(rot)}));
  }

 private:
  io::LoadedJoint loaded_;
  contact::JointContact contact_;
};

TEST_F(WrittenLimits, SayByHowMuchTheyDifferFromCoupledOnes) {
  const std::string question =
      "--map adduction=-30:10:10 internal_rotation=0:60:30 --write-limits hip.xml --json";
  const Json said = Json::parse(written(question).out)["written_limits"];
  const Json &sides = said["coordinates"], &error = said["error"];
  const auto end = [&](std::size_t i, const char* which) {
    return sides[i][which]["limit_deg"].get<double>();
  };
  const Poses poses(folder / "hip.toml");
  // By steps of flexion from where it is free, as far as the box goes and past it.
  constexpr double step = 0.05;
  double beyond = 0, forbidden = 0;
  for (double add = -30; add <= 10; add += 10)
    for (double rot = 0; rot <= 60; rot += 30) {
      const double held = std::max(
          {end(1, "lower") - add, add - end(1, "upper"), end(2, "lower") - rot, rot - end(2, "upper"), 0.0});
      for (const int sense : {-1, 1}) {
        double free = 0;
        while (std::abs(free) < 180 && !poses.meet(free + sense * step, add, rot)) free += sense * step;
        const double past = sense > 0 ? free - end(0, "upper") : end(0, "lower") - free;
        if (held == 0) beyond = std::max(beyond, -past);
        forbidden = std::max({forbidden, held, past});
      }
    }
  EXPECT_GT(beyond, 0.3);
  EXPECT_GT(forbidden, 1);
  EXPECT_NEAR(error["beyond_deg"], beyond, step);
  EXPECT_NEAR(error["forbidden_deg"], forbidden, step);
  const auto at = error["beyond_at_deg"].get<std::vector<double>>();
  EXPECT_TRUE(poses.meet(at[0], at[1], at[2]));
  const double back = (at[0] > 0 ? -1 : 1) * (error["beyond_deg"].get<double>() + 1e-6);
  EXPECT_FALSE(poses.meet(at[0] + back, at[1], at[2]));
  const auto free_at = error["forbidden_at_deg"].get<std::vector<double>>();
  EXPECT_FALSE(poses.meet(free_at[0] - std::copysign(1e-6, free_at[0]), free_at[1], free_at[2]));
  EXPECT_TRUE(
      says(text_of("hip.xml"), fmt::format("by up to {:.2f} deg", error["beyond_deg"].get<double>())));
}

TEST_F(WrittenLimits, AreTheLivingOnesOnlyWhereStudiesSayOne) {
  sample_into(folder / "sample", "hip");
  const auto limits = [&](const char* of) {
    const Ran ran = done(fmt::format(
        "rom sample/hip.toml --motion flexion --map flexion=0:90:90 adduction=0:10:10 --write-limits hip.xml "
        "--limits {} --json",
        of));
    return Json::parse(ran.out);
  };
  const Json bony = limits("bony"), living = limits("living");
  const Json& sides = living["written_limits"]["coordinates"];
  // Studies say one of flexion, and of no other motion from zero.
  const Json flexion = sides[0]["upper"];
  EXPECT_EQ(flexion["source"], "living");
  EXPECT_EQ(flexion["limit_deg"], living["motions"][0]["living"]["expected_deg"]);
  EXPECT_EQ(flexion["bony_deg"], living["motions"][0]["limit_deg"]);
  EXPECT_EQ(bony["written_limits"]["coordinates"][0]["upper"]["limit_deg"], bony["motions"][0]["limit_deg"]);
  for (std::size_t i = 0; i < 3; ++i)
    for (const char* end : {"lower", "upper"}) {
      EXPECT_EQ(bony["written_limits"]["coordinates"][i][end]["source"], "bony");
      if (i > 0 || end == std::string_view("lower")) {
        EXPECT_EQ(sides[i][end], bony["written_limits"]["coordinates"][i][end]);
      }
    }
  // The joint has names of no model: its own angles, under names that no other joint of a body has.
  EXPECT_EQ(sides[0]["coordinate"], "hip_r_flexion");
  EXPECT_TRUE(says(text_of("hip.xml"), "living, bone 1"));
}

TEST_F(WrittenLimits, AreRefusedInOneLine) {
  const std::string whole = text_of("hip.toml"), bare = whole.substr(0, whole.find("[recorded_motion]"));
  write("bare.toml", bare);
  write("posed.toml", bare + "[recorded_motion]\nmodel = \"model.osim\"\njoint = \"hip_r\"\n");
  write("two.toml", bare + "[recorded_motion]\nflexion = \"flex\"\nadduction = \"add\"\n");
  write("other.toml", bare +
                          "[recorded_motion]\nflexion = \"hip_r/flexion\"\nadduction = \"hip_r/add\"\n"
                          "internal_rotation = \"hip_r/rot\"\n");
  write_edited("free.toml", "bare.toml", "\"ball\"", "\"free\"");
  append("free.toml", "[recorded_motion]\nflexion = \"flex\"\nx = { column = \"tx\", unit = \"m\" }\n");
  write("mine.csv", "angle,limit\n1,2\n");
  const auto changed_model = [&](const char* name, std::string_view from, std::string_view to) {
    write_edited(name, "model.osim", from, to);
  };
  changed_model(
      "coupled.osim", "</Model>",
      "<ConstraintSet><objects><CoordinateCouplerConstraint name=\"c\"><isEnforced>true</isEnforced>"
      "<coupled_coordinates_function><LinearFunction><coefficients>1 0</coefficients></LinearFunction>"
      "</coupled_coordinates_function><independent_coordinate_names>add</independent_coordinate_names>"
      "<dependent_coordinate_name>rot</dependent_coordinate_name></CoordinateCouplerConstraint>"
      "</objects></ConstraintSet></Model>");
  constexpr std::string_view range = "-2 2", axis = "<axis>0 0 -1</axis>";
  changed_model("infinite.osim", range, "-inf inf");
  changed_model("nan.osim", range, "nan 2");
  changed_model("word.osim", range, "abc");
  changed_model("one.osim", range, "1");
  changed_model("sine.osim", axis, "<axis>0 0 -1</axis><Sine name=\"function\"/>");
  changed_model("sense.osim", axis, "<axis>0 0 1</axis>");
  changed_model("slope.osim", axis,
                "<axis>0 0 -1</axis><LinearFunction name=\"function\"><coefficients>1 0.1</coefficients>"
                "</LinearFunction>");
  for (const auto& [arguments, exit_code, line] : std::vector<std::tuple<std::string, int, std::string>>{
           {"hip.toml --write-limits hip.osim --model coupled.osim", 3,
            "constraint 'c' moves coordinate 'rot'"},
           {"hip.toml --write-limits hip.osim --model infinite.osim", 3, "infinite.osim: line "},
           {"hip.toml --write-limits hip.osim --model nan.osim", 3, "nan.osim: line "},
           {"hip.toml --write-limits hip.osim --model word.osim", 3, "word.osim: line "},
           {"hip.toml --write-limits hip.osim --model one.osim", 3, "one.osim: line "},
           {"hip.toml --write-limits hip.osim --model sine.osim", 3, "sine.osim: line "},
           {"hip.toml --write-limits hip.osim --model sense.osim", 3,
            "coordinate 'flex' turns the joint otherwise"},
           {"hip.toml --write-limits hip.osim --model slope.osim", 3,
            "joint 'hip_r' stands at zero otherwise"},
           {"hip.toml --write-limits model.osim", 3, "model.osim: is there, was not written by condyle"},
           {"hip.toml --write-limits mine.csv", 3, "mine.csv: is there, was not written by condyle"},
           {"hip.toml --write-limits hip.csv --angle-unit radian", 2,
            "the unit of angles is chosen of an .xml"},
           {"posed.toml --write-limits posed.xml", 2, "the model poses this joint by its functions"},
           {"free.toml --write-limits free.xml", 2,
            "the translation of this joint moves by [recorded_motion]"},
           {"hip.toml --write-limits hip.txt", 2, "limits are written as .osim, .xml of MuJoCo or .csv"},
           {"hip.toml --write-limits hip.xml --model model.osim", 2, "a copy of a model is an .osim"},
           {"hip.toml --write-limits hip.xml --stop linear", 2, "a linear stop is of an .osim"},
           {"hip.toml --write-limits hip.csv --limits living", 2, "coupled limits are those of bone"},
           {"hip.toml --write-limits model.osim --model model.osim", 3, "model.osim: "},
           {"hip.toml --write-limits hip.osim --model none.osim", 3, "none.osim: no such file"},
           {"hip.toml --write-limits hip.osim --model hip.toml", 2, "hip.toml: is no model of OpenSim"},
           {"hip.toml --limits living", 2, "--write-limits"},
           {"bare.toml --write-limits hip.osim", 2, "no model was read into this joint"},
           {"posed.toml --write-limits hip.osim", 2, "the model poses this joint by its functions"},
           {"two.toml --write-limits hip.osim", 2, "no coordinate turns the joint in internal_rotation"},
           {"other.toml --write-limits hip.osim --model model.osim", 3,
            "model.osim: joint 'hip_r' has no coordinate 'flexion'"},
       }) {
    expect_refused(exit_code, "rom " + arguments + " --motion flexion", line);
    EXPECT_FALSE(fs::exists(here / "hip.osim")) << arguments;
  }
}

TEST_F(WrittenLimits, AreRefusedOfACoordinateThatMovesNothing) {
  write_duct_model(folder / "stuck.osim", 0.005);
  done("init stuck.osim --joint hip_r -o stuck.toml");
  const Ran ran = run("rom stuck.toml --accept-reference-contact --write-limits stuck.xml");
  EXPECT_EQ(ran.exit_code, 2) << ran.err;
  EXPECT_TRUE(says(ran.err, "coordinate flex moves nothing: contact or a ligament holds it"));
  EXPECT_FALSE(fs::exists(folder / "stuck.xml"));
  const Ran missing =
      run("rom stuck.toml --accept-reference-contact --write-limits stuck.osim --model none.osim");
  EXPECT_EQ(missing.exit_code, 3) << "the model is looked at before the limits: " << missing.err;
}

}  // namespace
}  // namespace condyle::test
