#include "io/joint/contact_table.hpp"
#include "io/joint/depth_surfaces.hpp"

#include <fmt/format.h>

#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/motion/motion_text.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

constexpr const char* layer = "youngs_modulus_mpa = 10\npoisson_ratio = 0.45\n";

io::ContactEntry entry_of(std::string_view keys, double mm_per_unit = 1) {
  const toml::table file = toml::parse("[contact]\n" + std::string(keys));
  const std::filesystem::path path = "knee.toml";
  io::TomlTable table(path, *file["contact"].as_table(), "contact");
  return io::contact_entry(table, mm_per_unit, "joints");
}

std::string refusal(std::string_view keys) {
  return test::complaint_of<FileError>([&] { entry_of(keys); });
}

/// Each with the number of its line and what follows the name of the table.
void expect_refused(const std::string& before, const std::string& table,
                    const std::vector<test::Refusal>& all) {
  for (const auto& [keys, says] : all)
    EXPECT_EQ(refusal(before + keys), "knee.toml: line " + says.substr(0, 3) + table + says.substr(3));
}

TEST(ContactTable, LeftOutKeysAreThoseOfTheDocumentation) {
  const io::ContactEntry entry = entry_of("");
  EXPECT_EQ(entry.fixed_part, "");
  EXPECT_EQ(entry.mobile_part, "");
  EXPECT_EQ(entry.casting, contact::Casting::both);
  EXPECT_EQ(entry.rays.rule, contact::FaceRule::cut_faces);
  EXPECT_EQ(entry.rays.reach_mm, 20);
  EXPECT_EQ(entry.law, contact::PressureLaw::linear);
  EXPECT_EQ(entry.moment_on, io::MomentOn::casting);
  EXPECT_TRUE(entry.regions.empty());
  EXPECT_FALSE(entry.fixed || entry.mobile);
}

TEST(ContactTable, GivesEveryKey) {
  const io::ContactEntry entry = entry_of(
      "fixed_part = \"cartilage\"\nmobile_part = \"meniscus\"\ncasting = \"fixed\"\nrule = \"face_centre\"\n"
      "reach = 12.5\nlaw = \"logarithmic\"\nmoment_on = \"target\"\n"
      "[[contact.region]]\nname = \"medial_2\"\nhalf_space = [{ normal = [0, 0, -4], offset = 1.5 }, { "
      "normal = "
      "[3, 4, 0] }]\n[[contact.region]]\nname = \"lateral\"\nhalf_space = [{ normal = [0, 0, 1] }]\n"
      "[contact.fixed]\nyoungs_modulus_mpa = 12\npoisson_ratio = 0.42\nthickness = 1.5\n"
      "[contact.mobile]\nyoungs_modulus_mpa = 8\npoisson_ratio = -0.1\nbehind = \"bones/tibia.ply\"\n");
  EXPECT_EQ(entry.fixed_part, "cartilage");
  EXPECT_EQ(entry.mobile_part, "meniscus");
  EXPECT_EQ(entry.casting, contact::Casting::fixed);
  EXPECT_EQ(entry.rays.rule, contact::FaceRule::face_centre);
  EXPECT_EQ(entry.rays.reach_mm, 12.5);
  EXPECT_EQ(entry.law, contact::PressureLaw::logarithmic);
  EXPECT_EQ(entry.moment_on, io::MomentOn::target);

  ASSERT_EQ(entry.regions.size(), 2u);
  EXPECT_EQ(entry.regions[0].name, "medial_2");
  ASSERT_EQ(entry.regions[0].half_spaces.size(), 2u);
  EXPECT_EQ(entry.regions[0].half_spaces[0].normal, Vec3(0, 0, -1)) << "of length 1";
  EXPECT_EQ(entry.regions[0].half_spaces[0].offset_mm, 1.5);
  EXPECT_LT((entry.regions[0].half_spaces[1].normal - Vec3(0.6, 0.8, 0)).norm(), 1e-15);
  EXPECT_EQ(entry.regions[0].half_spaces[1].offset_mm, 0);
  EXPECT_EQ(entry.regions[1].name, "lateral");

  ASSERT_TRUE(entry.fixed && entry.mobile);
  EXPECT_EQ(entry.fixed->youngs_modulus_mpa, 12);
  EXPECT_EQ(entry.fixed->poisson_ratio, 0.42);
  EXPECT_EQ(entry.fixed->thickness_mm, 1.5);
  EXPECT_FALSE(entry.fixed->behind);
  EXPECT_EQ(entry.mobile->poisson_ratio, -0.1);
  EXPECT_EQ(entry.mobile->thickness_mm, 0) << "not given";
  EXPECT_EQ(entry.mobile->behind, std::filesystem::path("joints/bones/tibia.ply"));
}

TEST(ContactTable, EveryWordIsKnown) {
  EXPECT_EQ(entry_of("casting = \"mobile\"").casting, contact::Casting::mobile);
  EXPECT_EQ(entry_of("casting = \"both\"").casting, contact::Casting::both);
  EXPECT_EQ(entry_of("rule = \"cut_faces\"").rays.rule, contact::FaceRule::cut_faces);
  EXPECT_EQ(entry_of("law = \"linear\"").law, contact::PressureLaw::linear);
  EXPECT_EQ(entry_of("moment_on = \"casting\"").moment_on, io::MomentOn::casting);
}

TEST(ContactTable, LengthsAreInTheUnitsOfTheFile) {
  const io::ContactEntry entry = entry_of(
      "reach = 0.0125\n[[contact.region]]\nname = \"a\"\nhalf_space = [{ normal = [1, 0, 0], offset = 0.002 "
      "}]\n[contact.fixed]\n" +
          std::string(layer) + "behind = \"bone.ply\"\nthickness = 0.003\n",
      1000);
  EXPECT_EQ(entry.rays.reach_mm, 12.5);
  EXPECT_EQ(entry.regions[0].half_spaces[0].offset_mm, 2);
  EXPECT_EQ(entry.fixed->thickness_mm, 3) << "where nothing lies behind";
  EXPECT_TRUE(entry.fixed->behind);
  EXPECT_EQ(entry.fixed->youngs_modulus_mpa, 10) << "no length";
}

TEST(ContactTable, RefusesByLineAndKey) {
  expect_refused(
      "", "contact",
      {{"casting = \"tibia\"\n", "2: .casting: must be \"fixed\" or \"mobile\" or \"both\", not \"tibia\""},
       {"rule = 1\n", "2: .rule: must be a text in quotes, not a whole number"},
       {"casting = \"both\"\nreach = 0\n", "3: .reach: must be above 0"},
       {"reach = inf\n", "2: .reach: must be a finite number"},
       {"law = \"quadratic\"\n", "2: .law: must be \"linear\" or \"logarithmic\", not \"quadratic\""},
       {"moment_on = \"fixed\"\n", "2: .moment_on: must be \"casting\" or \"target\", not \"fixed\""},
       {"mobile_part = [\"meniscus\"]\n", "2: .mobile_part: must be a text in quotes, not a list"},
       {"rech = 5\n",
        "2: .rech: unknown key (did you mean \"reach\"?); known here: casting, fixed, fixed_part, law, "
        "mobile, mobile_part, moment_on, reach, region, rule"},
       {"fixed = 3.0\n", "2: .fixed: must be a table, not a number"},
       {"region = \"medial\"\n", "2: .region: must be tables written as [[region]], not a text"}});
}

TEST(ContactTable, RefusesLayersByLineAndKey) {
  const std::string of_layer = layer;
  expect_refused(
      "[contact.fixed]\n", "contact.fixed",
      {{of_layer, "2: .thickness: is missing"},
       {"poisson_ratio = 0.45\nthickness = 3\n", "2: .youngs_modulus_mpa: is missing"},
       {"young_modulus_mpa = 10\n",
        "2: .youngs_modulus_mpa: is missing; there is \"young_modulus_mpa\" (did you mean "
        "\"youngs_modulus_mpa\"?)"},
       {"youngs_modulus_mpa = -1\n", "3: .youngs_modulus_mpa: must be above 0"},
       {of_layer + "thickness = 0\n", "5: .thickness: must be above 0"},
       {of_layer + "behind = \"bone.ply\"\nthickness = -3\n", "6: .thickness: must be above 0"},
       {of_layer + "behind = \"\"\n", "5: .behind: must name a file"},
       {of_layer + "behind = \"${NO_SUCH_FOLDER_OF_BONES}/bone.ply\"\n",
        "5: .behind: the environment variable 'NO_SUCH_FOLDER_OF_BONES' is not set"},
       {of_layer + "thickness = \"3 mm\"\n", "5: .thickness: must be a number, not a text"},
       {of_layer + "thickness = 3\nstiffness = 4\n",
        "6: .stiffness: unknown key; known here: behind, poisson_ratio, thickness, thickness_bounds, "
        "thickness_file, youngs_modulus_mpa"}});
  for (const std::string ratio : {"0.5", "-1", "0.6"})
    expect_refused("[contact.fixed]\n", "contact.fixed",
                   {{"youngs_modulus_mpa = 10\npoisson_ratio = " + ratio + "\nthickness = 3\n",
                     "4: .poisson_ratio: must be above -1 and below 0.5"}});
}

TEST(ContactTable, RefusesRegionsByLineAndKey) {
  const std::string half = "half_space = [{ normal = [0, 0, 1] }]\n", region = "[[contact.region]]\n";
  EXPECT_EQ(refusal(region + "name = \"medial\"\n" + half), "accepted");
  expect_refused(
      region, "contact.region",
      {{half, "2: [0].name: is missing"},
       {"name = \"Medial side\"\n" + half, "3: [0].name: must be of small letters, digits and _"},
       {"name = \"medial\"\n", "2: [0].half_space: is missing"},
       {"name = \"a\"\nhalf_space = [{ normal = [0, 0, 0] }]\n",
        "4: [0].half_space[0].normal: must not be zero"},
       {"name = \"a\"\nhalf_space = [{ offset = 1 }]\n", "4: [0].half_space[0].normal: is missing"},
       {"name = \"a\"\n" + half + region + "name = \"a\"\n" + half, "6: [1].name: \"a\" is given twice"}});
}

/// A flat layer, normal +y, 2 mm above a bone; of the small bone half of the layer is.
class ContactSurfacesOfAJoint : public ::testing::Test {
 protected:
  void SetUp() override {
    TriMesh square = test::mesh_of({{-5, 0, -5}, {-5, 0, 5}, {5, 0, -5}, {5, 0, 5}}, {{0, 1, 2}, {2, 1, 3}});
    io::write_mesh(folder / "layer.ply", square);
    io::write_mesh(folder / "bone.ply", test::box({-20, -10, -20}, {20, -2, 20}));
    io::write_mesh(folder / "small.ply", test::box({-20, -10, -20}, {0, -2, 20}));
    io::write_mesh(folder / "ball.ply", test::sphere({0, 20, 0}, 5, 2));
  }
  io::LoadedJoint joint(const std::string& more) const {
    return io::read_joint(folder.file(
        "joint.toml", test::joint_text({.kind = "free",
                                        .keys = "joint = \"knee\"\n",
                                        .fixed = "name = \"plate\"\nmeshes = [{ name = \"layer\", mesh = "
                                                 "\"layer.ply\" }, { name = \"bone\", mesh = \"bone.ply\" }]",
                                        .mobile = "name = \"ball\"\nmesh = \"ball.ply\"",
                                        .centre = "[1, 2, 3]",
                                        .more = more})));
  }
  static contact::ElasticContactOptions options_of(const io::LoadedJoint& loaded) {
    const io::ContactEntry& entry = *loaded.report.file.contact;
    return io::elastic_options(entry, io::surfaces_of(entry, loaded.joint), loaded);
  }

  const test::TemporaryFolder folder;
};

TEST_F(ContactSurfacesOfAJoint, AreItsPartsByName) {
  const io::LoadedJoint loaded = joint("[contact]\nfixed_part = \"layer\"\n");
  const io::ContactSurfaces surfaces = io::surfaces_of(*loaded.report.file.contact, loaded.joint);
  EXPECT_EQ(surfaces.fixed.name, "layer");
  EXPECT_EQ(surfaces.fixed.mesh.arrays(), mesh_of_part(loaded.joint.fixed, "layer").arrays());
  EXPECT_EQ(surfaces.mobile.name, "ball");
  EXPECT_THROW(io::surfaces_of({.mobile_part = "layer"}, loaded.joint), UsageError) << "the ball is one mesh";
}

TEST_F(ContactSurfacesOfAJoint, TakeThePlaceOfBodiesForDepthsAlongNormals) {
  const io::LoadedJoint loaded =
      joint("[contact]\nfixed_part = \"layer\"\ncasting = \"mobile\"\nrule = \"face_centre\"\nreach = 7\n");
  const io::ContactEntry& entry = *loaded.report.file.contact;
  const Joint of_surfaces = io::joint_of_surfaces(entry, loaded.joint);
  EXPECT_EQ(of_surfaces.fixed.name, "layer");
  EXPECT_EQ(of_surfaces.fixed.mesh.triangles().size(), 2u);
  EXPECT_EQ(of_surfaces.mobile.mesh.arrays(), loaded.joint.mobile.mesh.arrays());
  const DepthRequest request = io::cast_as(entry, {.method = DepthMethod::normal});
  EXPECT_EQ(request.method, DepthMethod::normal);
  EXPECT_EQ(request.casting, contact::Casting::mobile);
  EXPECT_EQ(request.rays->rule, contact::FaceRule::face_centre);
  EXPECT_EQ(request.rays->reach_mm, 7);
}

TEST_F(ContactSurfacesOfAJoint, AThicknessCanBeGivenForEachVertex) {
  const std::string fixed = "[contact]\nfixed_part = \"layer\"\n[contact.fixed]\n" + std::string(layer) +
                            "thickness_file = \"thickness.txt\"\n";
  folder.file("thickness.txt", "1\n1.5\n2\n+2.5\n");
  EXPECT_EQ(std::get<std::vector<double>>(options_of(joint(fixed)).fixed->thickness_mm),
            (std::vector<double>{1, 1.5, 2, 2.5}));
  EXPECT_THROW(joint(fixed + "thickness = 2\n"), FileError) << "both";
  const auto no_thickness = [](int line, const std::string& what) {
    return fmt::format("line {}: '{}' is no thickness: a number above 0", line, what);
  };
  test::expect_complaints(
      "thickness.txt", "1\n1\n2\n2\n",
      {{"", "0 thicknesses for the 4 vertices of layer"},
       {"1\n1\n2\n", "3 thicknesses for the 4 vertices of layer"},
       {"1\n1\n2\n2\n3\n", "5 thicknesses for the 4 vertices of layer"},
       {"1\n0\n2\n2\n", no_thickness(2, "0")},
       {"1\n-1\n2\n2\n", no_thickness(2, "-1")},
       {"1\n1\nnan\n2\n", no_thickness(3, "nan")},
       {"1\n1\n2\ninf\n", no_thickness(4, "inf")},
       {"1,1,2,2\n", no_thickness(1, "1,1,2,2")},
       {"1\n1,5\n2\n2\n", no_thickness(2, "1,5")},
       {"mm\n1\n1\n2\n2\n", no_thickness(1, "mm")},
       {"1\n1\n2e999\n2\n", no_thickness(3, "2e999")},
       {"1\n1\n\x01\n2\n", no_thickness(3, "?")}},
      [&](const std::filesystem::path& path) {
        options_of(joint("[contact]\nfixed_part = \"layer\"\n[contact.fixed]\n" + std::string(layer) +
                         "thickness_file = \"" + path.string() + "\"\n"));
      });
}

TEST_F(ContactSurfacesOfAJoint, AThicknessIsMeasuredToTheMeshBehind) {
  const std::string fixed = "[contact]\nfixed_part = \"layer\"\n[contact.fixed]\n" + std::string(layer);
  const contact::ElasticContactOptions options = options_of(joint(fixed + "behind = \"bone.ply\"\n"));
  ASSERT_TRUE(options.fixed);
  EXPECT_FALSE(options.mobile) << "rigid";
  EXPECT_EQ(options.fixed->youngs_modulus_mpa, 10);
  const auto& all = std::get<std::vector<double>>(options.fixed->thickness_mm);
  ASSERT_EQ(all.size(), 4u);
  for (const double thickness : all) EXPECT_NEAR(thickness, 2, 1e-12);

  const contact::ElasticContactOptions with_half =
      options_of(joint(fixed + "behind = \"small.ply\"\nthickness = 4\n"));
  const auto& half = std::get<std::vector<double>>(with_half.fixed->thickness_mm);
  for (const std::size_t v : {0, 1}) EXPECT_NEAR(half[v], 2, 1e-12);
  for (const std::size_t v : {2, 3}) EXPECT_EQ(half[v], 4) << "nothing lies behind";

  const io::LoadedJoint without = joint(fixed + "behind = \"small.ply\"\n");
  test::expect_begins(test::complaint_of<MeshError>([&] { options_of(without); }),
                      "layer: 2 of 4 vertices, vertex 2 the first, have nothing of ");
  EXPECT_THROW(options_of(joint(fixed + "behind = \"none.ply\"\n")), FileError);
}

TEST_F(ContactSurfacesOfAJoint, AnErrorInTheTableNamesTheJointFile) {
  test::expect_says(test::complaint_of<FileError>([&] { joint("[contact]\ncasting = \"ball\"\n"); }),
                    "joint.toml: line 18: contact.casting: must be ");
}

}  // namespace
}  // namespace condyle
