#include "core/formatted.hpp"
#include "core/rotation_about.hpp"
#include "motion_scene.hpp"

/// Further contents of answers on recorded motions, beside their curves.

namespace condyle::test {
namespace {

using core::formatted;

TEST_F(Motion, FramesThatTheReachCutsOffAreCounted) {
  write("lower.csv", "time,y_mm\n0,-0.25\n0.1,-0.45\n0.2,-0.6\n");
  const auto cut_off = [&](const std::string& options) {
    const Ran ran = done("motion cup.toml --motion lower.csv --json " + options);
    return Json::parse(ran.out)["frames_cut_off_by_reach"].get<int>();
  };
  // 24.8 mm in 25 mm: depths of 0.05, 0.25 and 0.4 mm.
  EXPECT_EQ(cut_off(""), 0);
  EXPECT_EQ(cut_off("--reach 0.2"), 2);
  EXPECT_EQ(cut_off("--reach 0.2 --load"), 2);
  EXPECT_EQ(cut_off("--reach 0.3"), 1);
  const std::string text = run("motion cup.toml --motion lower.csv --reach 0.3").out;
  EXPECT_TRUE(says(text, "in 1 frame the reach of 0.3 mm cuts off rays"));
}

/// Rays from the top of the ball go through it and, with a long reach, to the inner side of the open cup.
TEST_F(Motion, FramesMetFromTheFrontAreCounted) {
  write("lower.csv", "time,y_mm\n0,0\n0.1,-0.1\n0.2,-0.6\n");
  const auto met = [&](const std::string& reach) {
    const Ran ran = done("motion cup.toml --motion lower.csv --casting mobile --json --reach " + reach);
    return Json::parse(ran.out)["frames_met_from_front"].get<int>();
  };
  EXPECT_EQ(met("20"), 0);
  EXPECT_EQ(met("60"), 3);
  const std::string text = run("motion cup.toml --motion lower.csv --casting mobile --reach 60").out;
  EXPECT_TRUE(says(text, "in 3 frames rays met the open target from its front"));
}

/// Matrices of both bones in the scanner's frame; the bodies are what the frames of the meshes are.
TEST_F(Motion, AMeasuredKneeIsWhereItsReadmeSays) {
  FOUND_OR_SKIP(data, shared_data());
  std::string knee = joint("free", "post.ply", "shank.ply",
                           "[recorded_motion]\nfixed_body = \"femur_distal_r\"\nmobile_body = "
                           "\"tibia_proximal_r\"\nunits = \"m\"\n");
  knee.replace(knee.find("joint = \"hip\""), 13, "joint = \"knee\"");
  write("knee.toml", knee);
  const auto file = fs::absolute(*data / "motion_mri_knee" / "passive_body_transformations.sto");
  const Ran ran = done("motion knee.toml --motion " + file.string() + " --out out");
  EXPECT_TRUE(says(ran.err, "promises 48 rows and the file has 60"));
  EXPECT_TRUE(says(ran.err, "the nearest ones are used"));
  const NumberTable curves = csv_of(folder / "out/curves.csv");
  ASSERT_EQ(curves.rows.size(), 60u);
  const auto value = [&](const char* name) { return curves.rows[20][curves.column(name)]; };
  const std::pair<const char*, double> known[] = {
      {"x_mm", 2.44138},         {"y_mm", -1.15345},         {"z_mm", -2.36312},
      {"flexion_deg", 41.61138}, {"adduction_deg", 1.66967}, {"internal_rotation_deg", -1.78322}};
  for (const auto& [name, expected] : known)
    EXPECT_NEAR(value(name), expected, std::string_view(name).ends_with("_mm") ? 0.001 : 0.01) << name;
}

/// A living knee turns about the cylinder of its condyles, as far as either is known.
TEST_F(Motion, AMeasuredKneeTurnsAboutItsCondyles) {
  FOUND_OR_SKIP(data, shared_data());
  const std::string bones = fs::absolute(*data / "knee_lenhart2015_right").string(),
                    motion = " --from-motion " + fs::absolute(*data / "motion_mri_knee").string() +
                             "/passive_body_transformations.sto";
  done("init " + bones + "/femur_bone.ply " + bones +
       "/tibia_bone.ply --joint knee --side right --out k.toml");
  write("knee.toml", text_of("k.toml") +
                         "\n[recorded_motion]\nfixed_body = \"femur_distal_r\"\nmobile_body = "
                         "\"tibia_proximal_r\"\nunits = \"m\"\n");
  const Json by_motion = answer("frame knee.toml" + motion)["by_motion"];
  EXPECT_EQ(by_motion["poses"], 60);
  EXPECT_NEAR(by_motion["from_joint_axis_deg"].get<double>(), 0, 4);
  EXPECT_NEAR(by_motion["from_joint_centre_mm"].get<double>(), 0, 4);
  EXPECT_TRUE(says(done("frame knee.toml" + motion).out, "promises 48 rows and the file has 60"));
  // Columns of coordinates turn about the joint's own centre.
  expect_refused(3, "frame k.toml" + motion, "no poses of both bodies");
}

/// The ball of a joint in centimetres turns about (0.1, 0.2, -0.1) cm.
TEST_F(Motion, ACentreByMotionIsInTheUnitOfTheJointFile) {
  std::string ball = joint("ball", "cup.ply", "ball.ply",
                           "[recorded_motion]\nfixed_body = \"p\"\nmobile_body = \"f\"\nunits = \"cm\"\n");
  ball.replace(ball.find("units = \"mm\""), 12, "units = \"cm\"");
  write("ball.toml", ball);
  const auto table = [&](double off_axis) {
    std::string text = "time";
    for (const char body : {'p', 'f'})
      for (int k = 0; k < 16; ++k) text += formatted(",%c_T%d%d", body, k / 4 + 1, k % 4 + 1);
    for (int i = 0; i < 40; ++i) {
      const Vec3 turn(0.5 * std::sin(0.3 * i), off_axis * std::sin(0.7 * i), off_axis * std::cos(0.9 * i));
      Pose X = core::moved_by(Pose::Identity(), Vec3::Zero(), turn);
      const Vec3 centre(0.1, 0.2, -0.1);
      X.translation() = centre - X.linear() * centre;
      text += formatted("\n%d,1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1", i);
      for (int k = 0; k < 16; ++k) text += formatted(",%.17g", X.matrix()(k / 4, k % 4));
    }
    return text + "\n";
  };
  write("turns.csv", table(0.3));
  const Json found = answer("frame ball.toml --from-motion turns.csv")["by_motion"];
  EXPECT_NEAR(found["centre_mm"][1].get<double>(), 2, 1e-9);
  EXPECT_NEAR(found["from_joint_centre_mm"].get<double>(), std::sqrt(6.0), 1e-9);
  EXPECT_NEAR(found["apart_as_given_mm"].get<double>(), 0, 1e-9);
  EXPECT_TRUE(says(done("frame ball.toml --from-motion turns.csv").out, "frame.centre = [0.1, 0.2, -0.1]"));
  write("turns.csv", table(0.02));
  expect_refused(4, "frame ball.toml --from-motion turns.csv", "turns.csv: poses: they turn by 2");
}

TEST_F(Motion, LoadReportsTheMomentOnTheBodyThatTheJointFileNames) {
  const auto surface_of = [&](const std::string& moment_on) {
    write("on.toml",
          joint("free", "cup.ply", "ball.ply",
                "[contact]\ncasting = \"fixed\"\nmoment_on = \"" + moment_on +
                    "\"\n[[contact.region]]\nname = \"all\"\nhalf_space = [{ normal = [0, -1, 0] }]\n" +
                    layer("fixed")));
    write("one.csv", "time,x_mm,y_mm\n0,0.2,-0.5\n");
    const Ran load = run("load on.toml --pose \"x=0.2 y=-0.5\" --json"),
              motion = run("motion on.toml --motion one.csv --load --out out");
    EXPECT_EQ(load.exit_code, 0) << load.err;
    EXPECT_EQ(motion.exit_code, 0) << motion.err;
    const NumberTable curves = csv_of(folder / "out/curves.csv");
    const Json json = Json::parse(load.out);
    EXPECT_EQ(json["contact"]["moment_on"], moment_on);
    EXPECT_EQ(json["translation_mm"], Json::array({0.2, -0.5, 0.0}));
    EXPECT_EQ(json["translation_frame"], "fixed");
    const char* axes[] = {"moment_in_fixed_x_nmm", "moment_in_fixed_y_nmm", "moment_in_fixed_z_nmm"};
    for (std::size_t i = 0; i < 3; ++i) {
      const double moment = json["fixed_surface"]["moment_nmm"][i].get<double>();
      EXPECT_EQ(curves.rows[0][curves.column(axes[i])], moment) << "as in the motion's answer";
      EXPECT_NEAR(json["fixed_regions"][0]["moment_nmm"][i], moment, 1e-9 * (1 + std::abs(moment)));
    }
    return json;
  };
  const Json casting = surface_of("casting"), target = surface_of("target");
  EXPECT_EQ(casting["fixed_surface"]["force_n"], target["fixed_surface"]["force_n"]);
  EXPECT_EQ(casting["on_mobile"], target["on_mobile"]);
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto moment = [&](const Json& of) { return of["fixed_surface"]["moment_nmm"][i].get<double>(); };
    EXPECT_EQ(moment(target), -moment(casting));
    largest = std::max(largest, std::abs(moment(casting)));
  }
  EXPECT_GT(largest, 1e-3) << "a sign to compare";
}

TEST_F(Motion, ACentreHeldOffTheOriginIsExactToo) {
  write("free.toml", joint("free", "post.ply", "shank.ply", ""));
  write("swing.csv", "time,flexion_deg,x_mm,y_mm\n0,0,3,-2\n0.1,5,3,-2\n0.2,30,3,-2\n");
  const Json between = answer("motion free.toml --motion swing.csv")["between_samples"];
  ASSERT_FALSE(between.is_null());
  EXPECT_EQ(between["ways_exact"], 2);
  EXPECT_EQ(between["ways_bounded"], 0);
  // The front corner (1, -100) goes round (3, -2) and meets the post at x = 40.
  const double radius = std::hypot(1, 100);
  const double angle = (std::asin(37 / radius) - std::asin(1 / radius)) * 180 / std::numbers::pi;
  ASSERT_EQ(between["contacts"].size(), 1u);
  EXPECT_NEAR(between["contacts"][0]["entry"]["turned_deg"], angle - 5, 1e-9);
  write("moves.csv", "time,flexion_deg,x_mm\n0,0,3\n0.1,5,3\n0.2,30,3.1\n");
  EXPECT_TRUE(answer("motion free.toml --motion moves.csv")["between_samples"].is_null());
}

TEST_F(Motion, BetweenIsRefusedWhereItIsNotLookedFor) {
  write("good.csv", "time,flexion_deg\n0,0\n0.1,5\n");
  write("frames.csv", "flexion_deg\n0\n5\n");
  write("loads.csv", "time,force_x_n,force_y_n,force_z_n\n0,0,-1000,0\n0.1,0,-1000,0\n");
  const auto refused = [&](const std::string& arguments, const char* saying) {
    expect_refusal(run(arguments), 2, saying, arguments);
  };
  refused("motion cup.toml --motion good.csv --between --force 0 -1000 0", "--between");
  refused("motion cup.toml --motion good.csv --between --loads loads.csv", "--between");
  refused("motion cup.toml --motion frames.csv --between", "between: needs times in seconds");
  done("motion cup.toml --motion good.csv --between");
}

/// The swing of a gait carries nothing, and a force plate may miss a step: the other frames are answered.
TEST_F(Motion, FramesWithoutALoadAreLeftUnanswered) {
  write("rock.csv", "time,flexion_deg\n0,0\n0.1,5\n0.2,10\n0.3,5\n");
  write("loads.csv",
        "time,force_x_n,force_y_n,force_z_n\n0,0,-1000,0\n0.1,0,0,0\n0.2,0,nan,0\n0.3,0,-1000,0\n");
  const Ran ran = done("motion cup.toml --motion rock.csv --loads loads.csv --json --out out");
  EXPECT_TRUE(says(ran.err, "loads.csv: 1 of 4 frames are gaps, the first in line 4"));
  const Json json = Json::parse(ran.out);
  EXPECT_EQ(json["gaps"], 1);
  EXPECT_EQ(json["frames_balanced"], 2);
  ASSERT_EQ(json["without_balance"].size(), 1u);
  EXPECT_EQ(json["without_balance"][0]["time_s"], 0.1);
  EXPECT_EQ(json["without_balance"][0]["outcome"], "no_load");
  EXPECT_EQ(json["without_balance"][0]["carries_load"], false);
  const NumberTable curves = csv_of(folder / "out/curves.csv");
  for (const std::size_t row : {1u, 2u})
    for (std::size_t c = 1; c < curves.columns.size(); ++c)
      EXPECT_TRUE(std::isnan(curves.rows[row][c])) << row << curves.columns[c];
  for (const std::size_t row : {0u, 3u})
    EXPECT_NEAR(curves.rows[row][curves.column("force_in_fixed_y_n")], -1000, 1e-5);
  const std::string text = run("motion cup.toml --motion rock.csv --loads loads.csv").out;
  EXPECT_TRUE(says(text, "balanced in 2 of 3 frames"));
  EXPECT_TRUE(says(text, "0.1 s: the load is zero along the free directions"));

  // A load across the only free direction leaves no residual either.
  const Json across = answer("motion cup.toml --motion rock.csv --loads loads.csv --along 1 0 0");
  EXPECT_EQ(across["frames_balanced"], 0);
  EXPECT_EQ(across["without_balance"].size(), 3u);
}

TEST_F(Motion, LoadsThatNothingWouldAskAreRefused) {
  write("rock.csv", "time,flexion_deg\n0,0\n0.1,5\n");
  write("loads.csv", "time,force_x_n,force_y_n,force_z_n\n0,0,-1000,0\n0.1,0,-1000,0\n");
  write("moments.csv",
        "time,force_x_n,force_y_n,force_z_n,moment_x_nmm,moment_y_nmm,moment_z_nmm\n0,0,-1000,0,0,0,5\n0.1,0,"
        "-1000,0,"
        "0,0,5\n");
  write("two.csv",
        "time,force_x_n,force_y_n,force_z_n,moment_x_nmm,moment_y_nmm\n0,0,-1000,0,0,0\n0.1,0,-1000,0,0,0\n");
  const auto refused = [&](const std::string& options, int exit_code, const char* saying) {
    expect_refusal(run("motion cup.toml --motion rock.csv " + options), exit_code, saying, options);
  };
  refused("--loads loads.csv --force 0 -100 0", 2, "--force");
  refused("--loads loads.csv --free-rotations --moment 0 0 5", 2, "--moment");
  refused("--along 1 0 0", 2, "--along: needs --force");
  refused("--free-rotations", 2, "--free-rotations: needs a force or a moment");
  refused("--force-frame mobile", 2, "--force-frame: needs --force");
  refused("--loads moments.csv", 3,
          "moments.csv: column 'moment_x_nmm': moments are balanced with --free-rotations only");
  refused("--loads two.csv --free-rotations", 3, "two.csv: has no column 'moment_z_nmm'");
}

/// A body of two meshes: wherever contact is reported, the mesh that touches is named.
TEST_F(Motion, WithoutContactReportsTheSmallestGap) {
  // The end of the shank passes the post's edge, (40, -80), at 15 and at 20 degrees: nearest at the second time.
  write("swing.csv", "time,flexion_deg\n2,0\n2.5,10\n3,5\n");
  const Ran text = done("motion shank.toml --motion swing.csv --to-limits --out out");
  const NumberTable curves = csv_of(folder / "out/curves.csv");
  const double gap = curves.rows[1][curves.column("smallest_gap_mm")];
  for (const auto& row : curves.rows) EXPECT_GE(row[curves.column("smallest_gap_mm")], gap);
  EXPECT_GT(gap, 0);
  EXPECT_TRUE(
      says(text.out,
           fmt::format("0 frames in contact\n  smallest clearance {:.4g} mm at 2.5 s, of surfaces", gap)));
  const Json json = json_of("out/motion.json");
  EXPECT_EQ(json["smallest_gap_mm"], (Json{{"value", gap}, {"time_s", 2.5}}));
  EXPECT_EQ(json["smallest_clearance_mm"], json["smallest_gap_mm"]);
  EXPECT_EQ(json["states"]["free"], 3);
  EXPECT_EQ(json["least_to_limit_deg"]["time_s"], 2.5);
  const std::size_t left = curves.column("to_limit_deg");
  EXPECT_NEAR(curves.rows[0][left] - curves.rows[2][left], 5, 1e-9);
  for (const char* key : {"largest_area_mm2", "largest_depth_mm"})
    EXPECT_EQ(json[key], (Json{{"value", 0.0}, {"time_s", nullptr}})) << key;
  // Nothing is known of frames that are gaps; contact has no gap.
  write("gaps.csv", "time,flexion_deg\n0,\n1,\n");
  EXPECT_TRUE(answer("motion shank.toml --motion gaps.csv")["smallest_gap_mm"].is_null());
  write("on.csv", "time,flexion_deg\n0,0\n1,30\n");
  const Json on = answer("motion shank.toml --motion on.csv");
  EXPECT_EQ(on["smallest_gap_mm"], (Json{{"value", 0.0}, {"time_s", 1.0}}));
  EXPECT_EQ(on["states"]["contact"], 1);
  EXPECT_FALSE(on["state_unknown_why"].is_null());
  EXPECT_FALSE(says(run("motion shank.toml --motion on.csv").out, "smallest gap"));
}

/// About a held centre a step's screw is the axis of the angle that changes.
TEST_F(Motion, DepthsAboutScrewsAreThoseAboutTheAxesOfTheSteps) {
  write("swing.csv", "time,flexion_deg\n0,20\n1,26\n2,31\n3,31\n4,\n5,30\n");
  const Ran text = done("motion shank.toml --motion swing.csv --screws --out out");
  const Json depth = answer("depth shank.toml --method tangential --pose flexion=31"),
             screws = json_of("out/motion.json")["screws"];
  EXPECT_TRUE(says(
      text.out,
      fmt::format("  largest arc about the screw of a step {:.4g} mm at 2 s\n  1 slide without an axis\n",
                  depth["max_tangential_depth_mm"].get<double>())));
  const NumberTable curves = csv_of(folder / "out/curves.csv");
  const auto value = [&](std::size_t row, const char* name) { return curves.rows[row][curves.column(name)]; };
  EXPECT_NEAR(value(2, "screw_depth_deg"), depth["max_tangential_depth_deg"].get<double>(), 1e-11);
  EXPECT_EQ(screws["largest_depth_mm"], (Json{{"value", value(2, "screw_depth_mm")}, {"time_s", 2.0}}));
  EXPECT_EQ(screws["slides"], 1);
  EXPECT_TRUE(value(3, "screw_is_slide") == 1 && std::isnan(value(3, "screw_depth_mm")));
  EXPECT_TRUE(answer("motion shank.toml --motion swing.csv")["screws"].is_null());
}

TEST_F(Motion, AnswersNameThePartThatTouches) {
  const TriMesh bone = box({-5, 100, -5}, {5, 110, 5});
  io::write_mesh(folder / "bone.ply", bone);
  write("parts.toml",
        joint("free",
              "meshes = [{ name = \"bone\", mesh = \"bone.ply\" }, { name = \"cartilage\", mesh = "
              "\"cup.ply\" }]",
              "ball.ply", "[contact]\ncasting = \"fixed\"\n" + layer("fixed")));
  write("lower.csv", "time,y_mm\n0,0\n0.1,-0.5\n");

  const Ran load = done("load parts.toml --pose y=-0.5 --json --out load --ascii");
  const Json surface = Json::parse(load.out)["fixed_surface"];
  EXPECT_EQ(surface["deepest_part"]["name"], "cartilage");
  EXPECT_EQ(surface["deepest_part"]["triangle"].get<std::size_t>() + bone.triangles.size(),
            surface["deepest_triangle"].get<std::size_t>());
  EXPECT_TRUE(says(text_of("load/fixed.vtp"), "Name=\"part\""));
  EXPECT_FALSE(says(text_of("load/mobile.vtp"), "Name=\"part\""));
  EXPECT_TRUE(says(run("load parts.toml --pose y=-0.5").out, " of cartilage)"));

  const Ran motion = done("motion parts.toml --motion lower.csv --load --maps --json --out motion --ascii");
  const Json deepest = Json::parse(motion.out)["largest_depth_mm"];
  EXPECT_EQ(deepest["time_s"], 0.1);
  EXPECT_EQ(deepest["triangle"], surface["deepest_triangle"]);
  EXPECT_EQ(deepest["part"], surface["deepest_part"]);
  EXPECT_TRUE(says(text_of("motion/map_fixed_00001.vtp"), "Name=\"part\""));
  EXPECT_TRUE(says(run("motion parts.toml --motion lower.csv").out, " of cartilage)"));

  // One mesh: no part is named, and the answer is the same.
  const Json whole = answer("load cup.toml --pose y=-0.5")["fixed_surface"];
  EXPECT_FALSE(whole.contains("deepest_part"));
  EXPECT_EQ(whole["deepest_triangle"], surface["deepest_part"]["triangle"]);
  EXPECT_EQ(whole["area_mm2"], surface["area_mm2"]);
}

TEST_F(Motion, ContactBetweenSamplesReportsPlaceAndParts) {
  io::write_mesh(folder / "upper.ply", box({-1, -60, -2}, {1, -10, 2}));
  io::write_mesh(folder / "lower.ply", box({-1, -100, -2}, {1, -60, 2}));
  write("parts.toml",
        joint("ball", "post.ply",
              "meshes = [{ name = \"upper\", mesh = \"upper.ply\" }, { name = \"lower\", mesh = "
              "\"lower.ply\" }]",
              ""));
  write("swing.csv", "time,flexion_deg\n0,0\n0.1,30\n");
  const Json contact =
      answer("motion parts.toml --motion swing.csv --out out")["between_samples"]["contacts"][0];
  EXPECT_EQ(contact["entry"]["mobile_part"], "lower");
  EXPECT_FALSE(contact["entry"].contains("fixed_part")) << "one mesh";
  // The front corner of the shank goes round with radius hypot(1, 100) and meets the post at x = 40.
  EXPECT_NEAR(contact["entry"]["point_mm"][0], 40, 1e-9);
  EXPECT_NEAR(contact["entry"]["point_mm"][1], -std::sqrt(1 + 100 * 100 - 40 * 40), 1e-9);
  EXPECT_EQ(contact["exit"]["point_mm"], nullptr) << "the recording ends in contact";
  const std::vector<std::string> lines = lines_of(text_of("out/contacts.csv"));
  const std::string &names = lines.at(0), &row = lines.at(1);
  EXPECT_TRUE(
      names.ends_with("is_certain,entry_x_mm,entry_y_mm,entry_z_mm,entry_fixed_part,entry_mobile_part,"
                      "exit_x_mm,exit_y_mm,exit_z_mm,exit_fixed_part,exit_mobile_part"))
      << names;
  EXPECT_TRUE(row.ends_with(",,lower,,,,,")) << row;
  EXPECT_EQ(fields_of(row).size(), fields_of(names).size());
}

}  // namespace
}  // namespace condyle::test
