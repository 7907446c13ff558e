#include <iomanip>
#include <sstream>

#include "motion_scene.hpp"
#include "support/knee_model.hpp"

/// Recorded motions and loads on the command line.

namespace condyle::test {
namespace {

constexpr std::string_view contact_columns =
    "time_s,area_mm2,mean_depth_mm,max_depth_mm,centre_of_depth_x_mm,centre_of_depth_y_mm,centre_of_depth_z_"
    "mm,"
    "mean_pressure_mpa,max_pressure_mpa,centre_of_pressure_x_mm,centre_of_pressure_y_mm,"
    "centre_of_pressure_z_mm,force_in_mobile_x_n,force_in_mobile_y_n,force_in_mobile_z_n,"
    "moment_in_mobile_x_nmm,moment_in_mobile_y_nmm,moment_in_mobile_z_nmm,";

/// Joints of the published model, and nothing written by hand but the compartments, which a model does not have.
struct Published {
  const char *joint, *mobile, *contact;
};
class PublishedMotion : public CommandTest, public ::testing::WithParamInterface<Published> {
 protected:
  void SetUp() override {
    if (!has_knee_model()) GTEST_SKIP() << "the shared knee or its model is missing";
    knee = shared_knee();
    write_knee_model(here, {"femur", GetParam().mobile});
    done(std::string("init lenhart2015.osim -o joint.toml --joint ") + GetParam().joint);
    if (GetParam().contact == std::string("tf"))
      append("joint.toml",
             "[[contact.region]]\nname = \"medial\"\nhalf_space = [{ normal = [0, 0, -1] }]\n"
             "[[contact.region]]\nname = \"lateral\"\nhalf_space = [{ normal = [0, 0, 1] }]\n");
  }

  std::optional<Knee> knee;
};

TEST_P(PublishedMotion, OfTheModelHasThePublishedCurves) {
  const auto states =
      fs::absolute(shared_data_folder() / "knee_lenhart2015_right" / "passive_flexion_states.sto");
  done("motion joint.toml --motion " + states.string() + " --load --out out --cycle 0 2.5 --jam");
  const NumberTable curves = csv_of(folder / "out/curves.csv");
  ASSERT_EQ(curves.rows.size(), 251u);
  EXPECT_TRUE(text_of("out/curves.csv").starts_with(contact_columns));
  const std::vector<std::pair<std::string, double>> of_column = {
      {"contact_area", 1e6},          {"mean_proximity", 1e3},        {"max_proximity", 1e3},
      {"center_of_proximity_x", 1e3}, {"center_of_proximity_y", 1e3}, {"center_of_proximity_z", 1e3},
      {"mean_pressure", 1e-6},        {"max_pressure", 1e-6},         {"center_of_pressure_x", 1e3},
      {"center_of_pressure_y", 1e3},  {"center_of_pressure_z", 1e3},  {"contact_force_x", 1},
      {"contact_force_y", 1},         {"contact_force_z", 1},         {"contact_moment_x", 1e3},
      {"contact_moment_y", 1e3},      {"contact_moment_z", 1e3}};
  // Half of the last published digit, and 2e-5: tests/contact holds vectors by their own lengths.
  double largest_force = 0;
  for (const auto& row : curves.rows)
    largest_force = std::max(largest_force, std::hypot(row[12], row[13], row[14]));
  for (std::size_t frame = 0; frame < 251; ++frame) {
    for (std::size_t c = 0; c < of_column.size(); ++c) {
      const double published =
          of_column[c].second * knee->published(GetParam().contact, frame, of_column[c].first);
      const double size = c < 3 || (c > 5 && c < 8) ? std::abs(published)
                          : c < 11                  ? 30
                          : c < 14                  ? largest_force
                                                    : 40 * largest_force;
      EXPECT_NEAR(curves.rows[frame][c + 1], published, 2e-5 * size + 0.5000001e-8 * of_column[c].second)
          << of_column[c].first << " frame " << frame;
    }
  }
  // The compartments of the tibia, on either side of its sagittal plane, carry all of its load.
  if (fs::exists(folder / "out/regions.csv")) {
    const NumberTable regions = csv_of(folder / "out/regions.csv");
    ASSERT_EQ(regions.rows.size(), 251u);
    for (std::size_t frame = 0; frame < 251; ++frame) {
      for (const char* name :
           {"area_mm2", "force_in_mobile_x_n", "force_in_mobile_y_n", "force_in_mobile_z_n",
            "moment_in_mobile_x_nmm", "moment_in_mobile_y_nmm", "moment_in_mobile_z_nmm"}) {
        const double medial = regions.rows[frame][regions.column(std::string("medial_") + name)],
                     lateral = regions.rows[frame][regions.column(std::string("lateral_") + name)];
        // Sums of some 1500 faces in another order.
        EXPECT_NEAR(medial + lateral, curves.rows[frame][curves.column(name)],
                    1e-12 * (std::abs(medial) + std::abs(lateral) + 1))
            << name << " frame " << frame;
      }
      const double medial = regions.rows[frame][regions.column("medial_share_percent")],
                   lateral = regions.rows[frame][regions.column("lateral_share_percent")];
      // A hundred by the sums above; the force is of hundreds of newtons in every frame.
      EXPECT_NEAR(medial + lateral, 100, 1e-9) << "frame " << frame;
      const auto z = [&](const char* of) { return regions.rows[frame][regions.column(of)]; };
      if (!std::isnan(z("medial_centre_of_pressure_z_mm"))) {
        EXPECT_LT(z("medial_centre_of_pressure_z_mm"), 0);
      }
      if (!std::isnan(z("lateral_centre_of_pressure_z_mm"))) {
        EXPECT_GT(z("lateral_centre_of_pressure_z_mm"), 0);
      }
    }
  }
  EXPECT_EQ(fs::exists(folder / "out/regions.csv"), GetParam().contact == std::string("tf"));
  EXPECT_EQ(csv_of(folder / "out/cycle.csv").rows.size(), 101u);
  EXPECT_GT(fs::file_size(folder / "out/jam.h5"), 1000u);
  EXPECT_FALSE(says(text_of("out/curves.sto"), "nan"));
  const Json json = json_of("out/motion.json");
  EXPECT_EQ(json["frames"], 251);
  EXPECT_EQ(json["contact"]["casting"], "mobile");
}

TEST_P(PublishedMotion, StatesInDegreesGiveTheCurvesOfThoseInRadians) {
  for (const bool in_degrees : {false, true}) {
    std::ostringstream text;
    text << std::setprecision(17) << "inDegrees=" << (in_degrees ? "yes" : "no") << "\nendheader\n";
    for (const std::string& name : knee->states.columns) text << name << '\t';
    for (const std::size_t frame : {0u, 100u, 250u}) {
      text << '\n';
      for (std::size_t c = 0; c < knee->states.columns.size(); ++c) {
        const std::string& name = knee->states.columns[c];
        const auto has = [&](const char* part) { return name.find(part) != name.npos; };
        const bool turns = name != "time" && !has("_tx") && !has("_ty") && !has("_tz");
        text << knee->states.rows[frame][c] * (turns && in_degrees ? 180 / std::numbers::pi : 1) << '\t';
      }
    }
    const std::string unit = in_degrees ? "deg" : "rad";
    write(unit + ".sto", text.str() + '\n');
    done("motion joint.toml --motion " + unit + ".sto --load --out " + unit);
  }
  const std::string of_radians = text_of("rad/curves.csv");
  EXPECT_EQ(csv_of(folder / "rad/curves.csv").rows.size(), 3u);
  EXPECT_EQ(text_of("deg/curves.csv"), of_radians);
}

INSTANTIATE_TEST_SUITE_P(Models, PublishedMotion,
                         ::testing::Values(Published{"knee_r", "tibia", "tf"},
                                           Published{"pf_r", "patella", "pf"}),
                         [](const auto& param) { return std::string(param.param.contact); });

TEST_F(Motion, ContactBetweenTwoSamplesIsFound) {
  // The shank, 1 mm before its axis, meets the post where its front corner does: at 100 mm below and 40 in front.
  write("swing.csv", "time,flexion_deg\n0,0\n0.1,10\n0.2,10\n0.3,0\n0.4,30\n");
  const Json between = answer("motion shank.toml --motion swing.csv --out out")["between_samples"];
  EXPECT_EQ(between["ways_exact"], 4);
  ASSERT_EQ(between["contacts"].size(), 1u);
  // The corner (1, -100) goes round with radius hypot(1, 100); x = 40 is met at this angle.
  const double radius = std::hypot(1, 100);
  const double angle = (std::asin(40 / radius) - std::asin(1 / radius)) * 180 / std::numbers::pi;
  EXPECT_NEAR(between["contacts"][0]["entry"]["turned_deg"], angle, 1e-9);
  EXPECT_NEAR(between["contacts"][0]["entry"]["time_s"], 0.3 + 0.1 * angle / 30, 1e-9);
  EXPECT_EQ(between["contacts"][0]["exit"]["kind"], "recording_ends");
  const std::string contacts = text_of("out/contacts.csv");
  EXPECT_EQ(std::count(contacts.begin(), contacts.end(), '\n'), 2);
  EXPECT_EQ(csv_of(folder / "out/curves.csv").rows[4][csv_of(folder / "out/curves.csv").column("in_contact")],
            1);
}

TEST_F(Motion, AGapStaysAGap) {
  write("gap.csv", "time,flexion_deg\n0,0\n0.1,\n0.2,10\n");
  const Ran ran = done("motion shank.toml --motion gap.csv --out out");
  EXPECT_TRUE(says(ran.out, "1 frame is a gap"));
  const NumberTable curves = csv_of(folder / "out/curves.csv");
  ASSERT_EQ(curves.rows.size(), 3u);
  for (std::size_t c = 1; c < curves.columns.size(); ++c)
    EXPECT_TRUE(std::isnan(curves.rows[1][c])) << curves.columns[c];
}

TEST_F(Motion, FramesAreTheSameOnAnyNumberOfThreads) {
  io::write_mesh(folder / "coarse_cup.ply", cup(25, 4));
  io::write_mesh(folder / "coarse_ball.ply", sphere(Vec3::Zero(), 24.8, 4));
  write("coarse.toml",
        joint("free", "coarse_cup.ply", "coarse_ball.ply",
              "[contact]\ncasting = \"fixed\"\n[[contact.region]]\nname = \"front\"\nhalf_space = "
              "[{ normal = [1, 0, 0] }]\n" +
                  layer("fixed")));
  // In contact, apart, and apart from the first frame to the last.
  write("rock.csv", "time,y_mm,x_mm\n0,-0.3,0\n0.1,0,0\n0.2,-0.5,0\n0.3,-0.4,-0.1\n0.4,0.1,0.1\n");
  write("apart.csv", "time,flexion_deg\n0,0\n0.1,5\n0.2,9\n0.3,14\n");
  write("swing.csv", "time,flexion_deg\n0,0\n0.1,10\n0.2,30\n0.3,0\n");
  write("lower.csv", "time,y_mm\n0,0\n0.1,-0.3\n");
  const auto expect_same = [&](const std::string& question, std::vector<std::string> files) {
    std::string out[2];
    for (const char* threads : {"1", "2"}) {
      const std::string to = "t" + std::string(threads);
      fs::remove_all(folder / to);
      const Ran ran = done("motion " + question + " --out " + to + " --threads " + threads);
      out[threads[0] - '1'] = ran.out;
    }
    EXPECT_EQ(out[0], out[1]) << question;
    // The command line that they keep has neither threads nor folders.
    for (const auto& file : fs::directory_iterator(folder / "t1")) files.push_back(file.path().filename());
    for (const std::string& file : files) {
      EXPECT_FALSE(text_of(folder / "t1" / file).empty()) << question << ": " << file;
      EXPECT_EQ(text_of(folder / "t1" / file), text_of(folder / "t2" / file)) << question << ": " << file;
    }
  };
  const std::vector<std::string> every = {"curves.csv",  "curves.sto",          "cycle.csv",
                                          "regions.csv", "map_fixed_00002.vtp", "map_mobile_00003.vtp",
                                          "motion.pvd",  "motion.json",         "jam.h5"};
  expect_same("coarse.toml --motion rock.csv --load --maps --jam --cycle 0 0.4", every);
  expect_same("coarse.toml --motion apart.csv --load --maps --jam --cycle 0 0.3", every);
  expect_same("shank.toml --motion apart.csv --jam", {"contacts.csv", "jam.h5"});
  expect_same("shank.toml --motion swing.csv", {"contacts.csv"});
  expect_same("coarse.toml --motion lower.csv --between", {"contacts.csv"});
}

TEST_F(Motion, ALoadIsBalancedFrameAfterFrame) {
  write("rock.csv", "time,flexion_deg\n0,0\n0.1,5\n0.2,10\n");
  write("loads.csv", "time,force_x_n,force_y_n,force_z_n\n0,0,-1000,0\n0.1,0,-1500,0\n0.2,0,-2000,0\n");
  const Ran ran = done("motion cup.toml --motion rock.csv --loads loads.csv --out out");
  EXPECT_TRUE(says(ran.out, "balanced in 3 of 3 frames"));
  const NumberTable curves = csv_of(folder / "out/curves.csv");
  BallInCup known{25, 24.8, 0, 6.321839};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(curves.rows[i][curves.column("force_in_fixed_y_n")], -1000 - 500.0 * static_cast<double>(i),
                1e-5);
    known.d = -curves.rows[i][curves.column("y_mm")];
    // Edges of 1.5 mm: ball and cup sag by up to edge^2 / (8 R) = 0.012 mm each.
    const double sag = 2 * 0.012;
    BallInCup less = known;
    less.d -= sag;
    EXPECT_GT(known.force(), 1000 + 500.0 * static_cast<double>(i));
    EXPECT_LT(less.force(), 1000 + 500.0 * static_cast<double>(i));
  }
}

TEST_F(Motion, BadInputGetsOneLine) {
  write("names.csv", "time,bending\n0,0\n");
  write("word.csv", "time,flexion_deg\n0,zero\n");
  write("times.csv", "time,force_x_n,force_y_n,force_z_n\n0,0,-1000,0\n");
  write("good.csv", "time,flexion_deg\n0,0\n0.1,5\n");
  write("frames.csv", "flexion_deg\n0\n5\n");
  const auto refused = [&](const std::string& arguments, int exit_code, const char* saying) {
    expect_refusal(run(arguments), exit_code, saying, arguments);
  };
  refused("motion shank.toml --motion none.csv", 3, "none.csv");
  refused("motion shank.toml --motion names.csv", 3, "flexion_deg");
  refused("motion shank.toml --motion word.csv", 3, "line 2");
  refused("motion shank.toml --motion good.csv --load", 2, "no layers");
  refused("motion cup.toml --motion good.csv --loads times.csv", 3, "not at the times");
  refused("motion shank.toml --motion good.csv --cycle 0 9 --out out", 2, "cycle");
  refused("motion shank.toml --motion frames.csv --cycle 0 1 --out out", 2, "times");
  refused("motion shank.toml --motion good.csv --e 10", 2, "a layer needs all three");
  refused("motion cup.toml --motion good.csv --force 0 -100 0 --moment 1 0 0", 2,
          "moment: needs free rotations");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(Motion, LoadReportsPressureAndBalances) {
  const Json json = answer("load cup.toml --force 0 -2000 0 --out out");
  EXPECT_EQ(json["balance"]["outcome"], "balanced");
  EXPECT_NEAR(json["on_mobile"]["force_n"][1], 2000, 1e-5);
  // d = 0.530583 for a perfect ball; facets of 1.5 mm sag by 0.012 mm on either side.
  EXPECT_NEAR(json["X_FM"][1][3], -0.530583, 2 * 0.012);
  EXPECT_EQ(json["mobile_surface"], nullptr);
  EXPECT_GT(json["fixed_surface"]["area_mm2"].get<double>(), 2000);
  for (const char* file : {"fixed.vtp", "mobile.vtp", "load.json"})
    EXPECT_TRUE(fs::exists(folder / "out" / file));
}

TEST_F(Motion, LoadRefusesWhatNoContactCarries) {
  const auto refused = [&](const std::string& arguments, const char* saying) {
    expect_refusal(run(arguments), 2, saying, arguments);
  };
  refused("load cup.toml --force 0 2000 0", "pulls the bodies apart");
  refused("load cup.toml --force 0 0 0", "zero");
  refused("load shank.toml", "no layers");
  refused("load cup.toml --nu 0.5", "Poisson");
  refused("load cup.toml --force 0 -2000 0 --along 0 1 0 1", "--along");
  refused("load cup.toml --force 0 -2000 0 --along 0 1 0 0 2 0", "depend on each other");
}

TEST_F(Motion, LoadIsBalancedInThePlaneOfTwoDirections) {
  const Json json = answer("load cup.toml --force 300 -2000 100 --along 0 1 0 1 0 0");
  EXPECT_NEAR(json["on_mobile"]["force_n"][0], -300, 1e-5);
  EXPECT_NEAR(json["on_mobile"]["force_n"][1], 2000, 1e-5);
  EXPECT_EQ(json["X_FM"][2][3].get<double>(), 0) << "not moved along Z";
}

TEST_F(Motion, LoadReportsWhatEachRegionCarries) {
  append("cup.toml",
         "[[contact.region]]\nname = \"front\"\nhalf_space = [{ normal = [1, 0, 0] }]\n"
         "[[contact.region]]\nname = \"back\"\nhalf_space = [{ normal = [-1, 0, 0] }]\n");
  const Json json = answer("load cup.toml --force 0 -2000 0");
  const Json& regions = json["fixed_regions"];
  ASSERT_EQ(regions.size(), 2u);
  EXPECT_EQ(regions[0]["name"], "front");
  const auto y = [](const Json& of) { return of["force_n"][1].get<double>(); };
  EXPECT_NEAR(y(regions[0]) + y(regions[1]), y(json["fixed_surface"]), 1e-9);
  EXPECT_NEAR(y(regions[0]), y(regions[1]), 20) << "front and back alike up to the facets";
  EXPECT_EQ(json["mobile_regions"], nullptr);
  const std::string text = run("load cup.toml --force 0 -2000 0").out;
  for (const char* name : {"    front: ", "    back: "}) EXPECT_TRUE(says(text, name));
  EXPECT_TRUE(says(run("load cup.toml").out, "no contact")) << "apart";
}

TEST(GaitOnAHip, IsFreeInEveryFrameAndBetween) {
  FOUND_OR_SKIP(data, shared_data());
  const TemporaryFolder folder;
  const std::string hip = fs::absolute(*data / "hip_vhf_right").string();
  std::ofstream(folder / "hip.toml") << text_of_joint(
      {.fixed = hip + "/hip_bone.ply",
       .mobile = hip + "/femur.ply",
       .more = "[recorded_motion]\nflexion = \"hip_flexion_r\"\nadduction = \"hip_adduction_r\"\n"
               "internal_rotation = \"hip_rotation_r\"\n"});
  const std::string walk = fs::absolute(*data / "motion_gait2354_walk" / "subject01_walk1_ik.mot").string();
  const Ran ran = run_well(folder.path(), "motion hip.toml --motion " + walk + " --out out");
  EXPECT_TRUE(says(ran.out, "between the samples too (exact): no contact"));
  const NumberTable curves = csv_of(folder / "out/curves.csv");
  ASSERT_EQ(curves.rows.size(), 73u);
  // Degrees of the file come back.
  EXPECT_NEAR(curves.rows[0][curves.column("flexion_deg")], 19.56730088, 1e-10);
  for (const auto& row : curves.rows) EXPECT_GT(row[curves.column("smallest_gap_mm")], 0);
}

}  // namespace
}  // namespace condyle::test
