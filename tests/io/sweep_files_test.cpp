#include "io/sweep/sweep_files.hpp"
#include "answer/sweep_summary.hpp"
#include "support/test.hpp"

/// A sweep that is written and read again says the same to the last bit.

namespace condyle::test {
namespace {

io::SweepResult made_sweep() {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  io::SweepResult result;
  result.joint = "a hip, \"made\"";
  result.scope = "what it is";
  SweepAnswer& sweep = result.answer;
  sweep.parameters = {{"cup.inclination", 30, 40, 10}, {"cup.anteversion", -0.1, 0.2, 0.1}};
  plan::SweepTarget sitting{"sitting, low", motion::motion_named(motion::hip_motions(), "flexion"),
                            Angle::degrees(110)};
  sitting.pelvic_tilt = Angle::degrees(-12.3);
  sitting.source = "a book";
  plan::SweepTarget own{
      "tailor", {"tailor", JointAngle::internal_rotation, RotationSense::negative}, Angle::degrees(33.3)};
  own.motion.start.flexion = Angle::degrees(71.7);
  own.motion.range = Angle::degrees(50);
  sweep.targets = {sitting, own};
  sweep.pairs = {{"liner", "neck"}, {"hip bone on its own", "femur"}};
  for (int i = 0; i < 8; ++i) {
    const bool in_contact = i == 5;
    const double first = in_contact ? none : 100 + 20.0 / (1 + i), second = in_contact ? none : 50;
    sweep.limits.push_back({first,
                            in_contact ? motion::LimitReason::contact_at_start : motion::LimitReason::contact,
                            plan::LimitKnownBy::closed_form, 0});
    sweep.limits.push_back(
        {second, in_contact ? motion::LimitReason::contact_at_start : motion::LimitReason::end_of_range,
         plan::LimitKnownBy::meshes, in_contact ? std::uint16_t{1} : plan::DesignLimit::no_pair});
    sweep.margin_deg.push_back(first - 110);
    sweep.probability.push_back(1.0 / (3 + i));
  }
  sweep.safe = {{0, -0.1, 1.0 / 3 - 0.3, std::nullopt, 0}};
  sweep.here = {37, 0.15};
  sweep.limits_here = {{101.0 / 3, motion::LimitReason::contact, plan::LimitKnownBy::meshes, 1},
                       {50, motion::LimitReason::end_of_range, plan::LimitKnownBy::meshes}};
  sweep.notes = {{SweepNoteCode::differs_from_closed_form, "meshes differ"}};
  sweep.caveats = {"one", "two"};
  result.units = {"deg", "mm"};
  result.answer.band_options.emplace();
  result.answer.band_options->samples = 77;
  result.answer.band_options->seed = 5;
  answer::summarise_sweep(sweep);
  return result;
}

TEST(SweepFiles, SayAgainWhatWasWritten) {
  const io::SweepResult written = made_sweep();
  const io::SweepResult read = io::read_sweep_result(io::sweep_object(written), io::designs_csv(written),
                                                     io::safe_csv(written), "zone");
  EXPECT_EQ(io::designs_csv(read), io::designs_csv(written));
  EXPECT_EQ(io::safe_csv(read), io::safe_csv(written));
  const SweepAnswer &a = read.answer, &b = written.answer;
  ASSERT_EQ(a.limits.size(), b.limits.size());
  for (std::size_t i = 0; i < b.limits.size(); ++i) {
    if (!std::isnan(b.limits[i].turned_deg)) {
      EXPECT_EQ(a.limits[i].turned_deg, b.limits[i].turned_deg);
    }
    EXPECT_EQ(a.limits[i].reason, b.limits[i].reason);
    EXPECT_EQ(a.limits[i].by, b.limits[i].by);
    EXPECT_EQ(a.limits[i].pair, b.limits[i].pair);
  }
  EXPECT_EQ(a.probability, b.probability);
  ASSERT_EQ(a.safe.size(), 1u);
  EXPECT_EQ(a.safe[0].low, b.safe[0].low);
  EXPECT_EQ(a.safe[0].high, b.safe[0].high);
  EXPECT_EQ(a.safe[0].low_target, b.safe[0].low_target);
  EXPECT_EQ(a.safe[0].high_target, b.safe[0].high_target);
  EXPECT_EQ(a.here, b.here);
  EXPECT_EQ(a.targets[1].motion.sense, RotationSense::negative);
  EXPECT_EQ(a.caveats, b.caveats);
  EXPECT_EQ(read.answer.band_options->samples, 77u);
  EXPECT_EQ(read.joint, written.joint);
  EXPECT_EQ(read.units, written.units);
}

TEST(SweepFiles, AreFoundAgainByTheirKeyOnly) {
  const TemporaryFolder folder;
  const io::SweepResult written = made_sweep();
  io::write_sweep(folder / "zone", written, io::sweep_key("options", {}), nullptr);
  const auto read = io::sweep_there(folder / "zone", "options");
  ASSERT_TRUE(read);
  EXPECT_EQ(io::designs_csv(*read), io::designs_csv(written));
  ASSERT_TRUE(read->answer.best);
  EXPECT_EQ(read->answer.best, written.answer.best);
  EXPECT_EQ(io::sweep_text(*read), io::sweep_text(written));
  EXPECT_EQ(io::sweep_json(*read), io::sweep_json(written));
  EXPECT_FALSE(io::sweep_there(folder / "zone", "other options"));
  EXPECT_FALSE(io::sweep_there(folder / "elsewhere", "options"));
}

TEST(SweepFiles, ThatDoNotFitTogetherAreRefused) {
  const io::SweepResult written = made_sweep();
  const auto refusal = [&](const io::Json& json, const std::string& designs, const std::string& safe) {
    return complaint_of<FileError>([&] { io::read_sweep_result(json, designs, safe, "zone"); });
  };
  const io::Json json = io::sweep_object(written);
  const std::string designs = io::designs_csv(written), safe = io::safe_csv(written);
  EXPECT_EQ(refusal(json, designs, safe), "accepted");
  io::Json without = json;
  without.erase("targets");
  expect_begins(refusal(without, designs, safe), "zone: sweep.json: is not whole: ");
  EXPECT_EQ(refusal(json, "", safe), "zone/designs.csv: is empty");
  EXPECT_EQ(refusal(json, "a,b\n1,2\n", safe), "zone/designs.csv: has other columns than sweep.json says");
  EXPECT_EQ(refusal(json, designs.substr(0, designs.size() - 30), safe),
            "zone/designs.csv: line 9: is not whole");
  EXPECT_EQ(refusal(json, designs, "a\n1\n"), "zone/safe.csv: has other columns than sweep.json says");
  std::string wrong = designs;
  wrong.replace(wrong.find("\n30,") + 1, 2, "x");
  EXPECT_EQ(refusal(json, wrong, safe), "accepted");  // values of designs follow from the parameters
  wrong = designs;
  const std::size_t margin = wrong.find(',', wrong.find(',', wrong.find("\n30,")) + 1) + 1;
  wrong.replace(margin, 2, "xx");
  EXPECT_EQ(refusal(json, wrong, safe), "zone/designs.csv: 'xx' is no number");
}

}  // namespace
}  // namespace condyle::test
