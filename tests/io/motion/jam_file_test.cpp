#include "condyle/io/jam_file.hpp"

#include <hdf5.h>

#include "condyle/io/recorded_motion.hpp"
#include "io/file/whole_file.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

using test::TemporaryFolder;

struct Dataset {
  std::vector<hsize_t> shape;
  std::vector<double> values;
};

/// All that a file has: datasets of eight-byte floats by path, and groups, which have no shape.
using Contents = std::map<std::string, Dataset>;

Dataset dataset_of(hid_t set, const std::string& name) {
  Dataset dataset;
  const hid_t space = H5Dget_space(set), type = H5Dget_type(set);
  EXPECT_EQ(H5Tget_class(type), H5T_FLOAT) << name;
  EXPECT_EQ(H5Tget_size(type), sizeof(double)) << name;
  dataset.shape.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, dataset.shape.data(), nullptr);
  dataset.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, dataset.values.data()), 0) << name;
  H5Tclose(type), H5Sclose(space);
  return dataset;
}

/// What lies below a group: by calls that HDF5 1.10 and 1.14 have alike, which H5Ovisit is not.
void add_below(hid_t group, const std::string& path, Contents& contents) {
  H5G_info_t info;
  ASSERT_GE(H5Gget_info(group, &info), 0) << path;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const auto name_into = [&](char* place, std::size_t bytes) {
      return H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, place, bytes, H5P_DEFAULT);
    };
    std::string name(static_cast<std::size_t>(name_into(nullptr, 0)), '\0');
    name_into(name.data(), name.size() + 1);
    const std::string at = path + "/" + name;
    const hid_t object = H5Oopen(group, name.c_str(), H5P_DEFAULT);
    if (H5Iget_type(object) == H5I_DATASET) {
      contents.emplace(at, dataset_of(object, at));
    } else {
      contents.emplace(at, Dataset{});
      add_below(object, at, contents);
    }
    H5Oclose(object);
  }
}

Contents contents_of(const std::filesystem::path& path) {
  Contents contents;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  EXPECT_GE(file, 0);
  add_below(file, "", contents);
  H5Fclose(file);
  return contents;
}

/// Numbers that differ in every place.
io::JamFrame frame_of(double first, std::size_t triangles, std::size_t regions = 0) {
  double next = first;
  const auto one = [&] { return next += 1.0 / 128; };
  const auto three = [&] {
    const double x = one(), y = one();
    return Vec3(x, y, one());
  };
  const auto totals = [&] {
    return io::JamTotals{.contact_area_m2 = one(),
                         .mean_proximity_m = one(),
                         .max_proximity_m = one(),
                         .centre_of_proximity_m = three(),
                         .mean_pressure_pa = one(),
                         .max_pressure_pa = one(),
                         .centre_of_pressure_m = three(),
                         .contact_force_n = three(),
                         .contact_moment_nm = three()};
  };
  io::JamFrame frame{
      .total = totals(), .regional = {}, .triangle_proximity_m = {}, .triangle_pressure_pa = {}};
  for (std::size_t r = 0; r < regions; ++r) frame.regional.push_back(totals());
  for (std::size_t t = 0; t < triangles; ++t)
    frame.triangle_proximity_m.push_back(one()), frame.triangle_pressure_pa.push_back(-one());
  return frame;
}

const std::string forces = "/model/forceset/Smith2018ArticularContactForce";
const std::array times = {0.0, 0.01, 0.02};

std::vector<io::JamContact> two_contacts() {
  return {{"tf_contact",
           {"tibia_cartilage", {frame_of(0, 4, 6), frame_of(100, 4, 6), frame_of(200, 4, 6)}},
           {"femur_cartilage", {frame_of(300, 2), frame_of(400, 2), frame_of(500, 2)}}},
          {"pf_contact",
           {"patella_cartilage", {frame_of(600, 0), frame_of(700, 0), frame_of(800, 0)}},
           {"femur_cartilage", {}}}};
}

void expect_dataset(const Contents& contents, const std::string& path, const std::vector<hsize_t>& shape,
                    const std::vector<double>& values) {
  const auto found = contents.find(path);
  ASSERT_NE(found, contents.end()) << path;
  EXPECT_EQ(found->second.shape, shape) << path;
  EXPECT_EQ(found->second.values, values) << path;
}

/// Paths and shapes as JAM's own scripts take them apart (jam_analysis.m of opensim-jam-org/jam-resources, matlab/analysis: it
/// reads /time, and of /model/forceset the names of components, forces, meshes and datasets as the 4th to 7th word of a
/// path, two meshes to a contact) and its writer makes them (writeH5File of OpenSim/JAM/JointMechanicsTool.cpp and
/// H5FileAdapter.cpp of opensim-jam-org/opensim-core: frames first, vectors in rows of 3, triangles and regions in rows, vectors of
/// regions in a group with a data set each).
TEST(JamFile, HasTheGroupsAndDatasetsThatScriptsRead) {
  const TemporaryFolder folder;
  const auto contacts = two_contacts();
  const std::vector<io::JamCoordinate> coordinates = {{"flexion", {10, 20, 30}}, {"x", {1e-3, 2e-3, 4e-3}}};
  io::write_jam_file(folder / "knee.h5", times, contacts, coordinates);
  Contents contents = contents_of(folder / "knee.h5");

  expect_dataset(contents, "/time", {3}, {0, 0.01, 0.02});
  expect_dataset(contents, "/model/coordinateset/flexion/value", {3}, {10, 20, 30});
  expect_dataset(contents, "/model/coordinateset/x/value", {3}, {1e-3, 2e-3, 4e-3});
  std::size_t datasets = 3;
  for (const io::JamContact& contact : contacts)
    for (const io::JamSurface* surface : {&contact.casting, &contact.target}) {
      const std::string group = forces + "/" + contact.name + "/" + surface->mesh + "/";
      if (surface->frames.empty()) continue;
      const auto expect_scalar = [&](const std::string& name, double io::JamTotals::*member) {
        std::vector<double> total, regional;
        for (const io::JamFrame& frame : surface->frames) {
          total.push_back(frame.total.*member);
          for (const io::JamTotals& region : frame.regional) regional.push_back(region.*member);
        }
        expect_dataset(contents, group + "total_" + name, {3}, total), ++datasets;
        if (!regional.empty())
          expect_dataset(contents, group + "regional_" + name, {3, 6}, regional), ++datasets;
      };
      const auto expect_vector = [&](const std::string& name, Vec3 io::JamTotals::*member) {
        const auto expect_rows = [&](const std::string& path, const auto& totals_of) {
          std::vector<double> values;
          for (const io::JamFrame& frame : surface->frames)
            for (int i = 0; i < 3; ++i) values.push_back((totals_of(frame).*member)[i]);
          expect_dataset(contents, group + path, {3, 3}, values), ++datasets;
        };
        expect_rows("total_" + name, [](const io::JamFrame& frame) { return frame.total; });
        for (std::size_t r = 0; r < surface->frames[0].regional.size(); ++r)
          expect_rows("regional_" + name + "/" + std::to_string(r),
                      [&](const io::JamFrame& frame) { return frame.regional[r]; });
      };
      const auto expect_triangles = [&](const char* name, std::vector<double> io::JamFrame::*member) {
        const std::size_t count = (surface->frames[0].*member).size();
        std::vector<double> values;
        for (const io::JamFrame& frame : surface->frames)
          for (const double value : frame.*member) values.push_back(value);
        if (count > 0) expect_dataset(contents, group + name, {3, count}, values), ++datasets;
      };
      expect_scalar("contact_area", &io::JamTotals::contact_area_m2);
      expect_scalar("mean_proximity", &io::JamTotals::mean_proximity_m);
      expect_scalar("max_proximity", &io::JamTotals::max_proximity_m);
      expect_vector("center_of_proximity", &io::JamTotals::centre_of_proximity_m);
      expect_scalar("mean_pressure", &io::JamTotals::mean_pressure_pa);
      expect_scalar("max_pressure", &io::JamTotals::max_pressure_pa);
      expect_vector("center_of_pressure", &io::JamTotals::centre_of_pressure_m);
      expect_vector("contact_force", &io::JamTotals::contact_force_n);
      expect_vector("contact_moment", &io::JamTotals::contact_moment_nm);
      expect_triangles("triangle_proximity", &io::JamFrame::triangle_proximity_m);
      expect_triangles("triangle_pressure", &io::JamFrame::triangle_pressure_pa);
    }

  std::vector<std::string> groups;
  for (const auto& [path, dataset] : contents)
    if (dataset.shape.empty()) groups.push_back(path);
  const std::string tibia = forces + "/tf_contact/tibia_cartilage";
  EXPECT_EQ(groups, (std::vector<std::string>{
                        "/model", "/model/coordinateset", "/model/coordinateset/flexion",
                        "/model/coordinateset/x", "/model/forceset", forces, forces + "/pf_contact",
                        forces + "/pf_contact/femur_cartilage", forces + "/pf_contact/patella_cartilage",
                        forces + "/tf_contact", forces + "/tf_contact/femur_cartilage", tibia,
                        tibia + "/regional_center_of_pressure", tibia + "/regional_center_of_proximity",
                        tibia + "/regional_contact_force", tibia + "/regional_contact_moment"}));
  EXPECT_EQ(contents.size(), groups.size() + datasets) << "nothing else";
}

TEST(JamFile, ItsTotalsAreNamedAsThePublishedOnes) {
  FOUND_OR_SKIP(data, test::shared_data());
  const io::MotionTable published =
      io::read_motion_table(*data / "knee_lenhart2015_right" / "passive_flexion_contact_reference.sto");
  const TemporaryFolder folder;
  io::write_jam_file(folder / "knee.h5", times, two_contacts());
  const Contents contents = contents_of(folder / "knee.h5");
  const std::string start = "tf_contact.casting.total.";
  std::size_t totals = 0;
  for (std::string name : published.columns) {
    if (!name.starts_with(start)) continue;
    name = "total_" + name.substr(start.size());
    const bool is_vector = name.ends_with("_x") || name.ends_with("_y") || name.ends_with("_z");
    if (is_vector) name.resize(name.size() - 2);
    const auto found = contents.find(forces + "/tf_contact/tibia_cartilage/" + name);
    ASSERT_NE(found, contents.end()) << name;
    EXPECT_EQ(found->second.shape.size(), is_vector ? 2u : 1u) << name;
    ++totals;
  }
  EXPECT_EQ(totals, 17u);
}

TEST(JamFile, HasTheSameBytesEveryTimeAndKeepsNan) {
  const TemporaryFolder folder;
  auto contacts = two_contacts();
  contacts[0].casting.frames[1].total.max_pressure_pa = std::nan("");
  io::write_jam_file(folder / "a.h5", times, contacts);
  io::write_jam_file(folder / "b.h5", times, contacts);
  EXPECT_EQ(io::read_whole_file(folder / "a.h5"), io::read_whole_file(folder / "b.h5"));
  const Contents contents = contents_of(folder / "a.h5");
  EXPECT_TRUE(std::isnan(contents.at(forces + "/tf_contact/tibia_cartilage/total_max_pressure").values[1]));
  EXPECT_EQ(test::count_entries(folder.path()), 2u) << "nothing is left beside them";
}

TEST(JamFile, NamesThatScriptsCouldNotReadAreRefused) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::vector<io::JamContact>& contacts,
                             const std::vector<io::JamCoordinate>& coordinates = {}) {
    const std::string said = test::complaint_of<FileError>(
        [&] { io::write_jam_file(folder / "a.h5", times, contacts, coordinates); });
    EXPECT_EQ(test::count_entries(folder.path()), said == "accepted" ? 1u : 0u);
    std::filesystem::remove(folder / "a.h5");
    return said.substr(said == "accepted" ? 0 : (folder / "a.h5: cannot be written: ").string().size());
  };
  const auto named = [](const std::string& contact, const std::string& casting, const std::string& target) {
    return io::JamContact{contact, {casting, {}}, {target, {}}};
  };
  const std::string longest(63, 'a');
  EXPECT_EQ(complaint({named("a", "B_1", longest)}), "accepted");
  for (const std::string& name : {std::string(), std::string("hip bone"), std::string("a/b"),
                                  std::string("_a"), std::string("1a"), std::string("\xC3\xA4")})
    for (const io::JamContact& contact :
         {named(name, "a", "b"), named("a", name, "b"), named("a", "b", name)})
      test::expect_says(complaint({contact}), "must be a letter and then up to 62 letters, digits and _");
  EXPECT_NE(complaint({named("a", "b", longest + "a")}), "accepted");
  EXPECT_EQ(complaint({named("a", "b", "c"), named("a", "d", "e")}), "contact 'a' is there twice");
  EXPECT_EQ(complaint({named("a", "b", "b")}), "contact 'a' has two meshes of one name, 'b'");
  const std::vector<double> values(times.size());
  test::expect_says(complaint({}, {{"knee flexion", values}}), "'knee flexion' must be a letter");
  test::expect_says(complaint({}, {{"x", values}, {"x", values}}), "coordinate 'x' is there twice");
  EXPECT_THROW(io::write_jam_file(folder / "nowhere" / "a.h5", times, two_contacts()), FileError);
}

}  // namespace
}  // namespace condyle
