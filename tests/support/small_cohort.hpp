#pragma once

#include <fmt/format.h>

#include "condyle/io/mesh_file.hpp"
#include "mesh/subdivide.hpp"
#include "support/test.hpp"

namespace condyle::test {

/// A table of joints of a few triangles: arms that hang from the joint centre, each with its post in front of it, at 30 to
/// 60 mm, and one each of what can go wrong.
///
///     rows      1 ... good    good + 1    good + 2        good + 3       good + 4
///     joint     answered      no file     open, 4         in contact, 6  no column filled, 3
class SmallCohort {
 public:
  SmallCohort(const std::filesystem::path& folder, std::size_t good, int subdivisions = 0)
      : folder_(folder), good_(good) {
    std::filesystem::create_directories(folder);
    arm_ = box({-1, -100, -2}, {1, -10, 2});
    for (int level = 0; level < subdivisions; ++level) arm_ = mesh::subdivided(arm_);
    io::write_mesh(folder / "arm.ply", arm_);
    io::write_mesh(folder / "inside.ply", box({35, -110, -2}, {45, -90, 2}));
    for (std::size_t k = 1; k <= good; ++k) {
      write_post(k, wall_mm(k));
      write_joint(fmt::format("hip{}.toml", k), fmt::format("post{}.ply", k), "arm.ply");
    }
    write_post(0, 40);
    write_joint("open.toml", "post0.ply", "no_such.ply");
    write_joint("in_contact.toml", "post0.ply", "inside.ply");
    write_table("open.toml");
  }

  static double wall_mm(std::size_t k) { return 30 + static_cast<double>(k * 7 % 31); }
  std::filesystem::path table() const { return folder_ / "table.csv"; }
  std::size_t rows() const { return good_ + failures; }
  static constexpr std::size_t failures = 4;

  void write_post(std::size_t k, double wall) const {
    TriMesh post = box({wall, -120, -50}, {wall + 20, -80, 50});
    io::write_mesh(folder_ / fmt::format("post{}.ply", k), post);
  }

  void write_joint(const std::string& name, const std::string& fixed, const std::string& mobile) const {
    std::ofstream(folder_ / name)
        << "condyle = 1\nname = \"arm and post\"\nkind = \"ball\"\nside = \"right\"\n"
           "units = \"mm\"\n[fixed]\nmesh = \""
        << fixed << "\"\n[mobile]\nmesh = \"" << mobile
        << "\"\n[frame]\ncentre = [0, 0, 0]\nanterior = [1, 0, 0]\n"
           "superior = [0, 1, 0]\n";
  }

  void write_table(const std::string& open, const std::string& last_group = "b") const {
    std::ofstream out(table());
    out << "id,joint,group,weight_kg\n";
    for (std::size_t k = 1; k <= good_; ++k)
      out << fmt::format("h{0},hip{0}.toml,\"{1}, x\",{2}\n", k, k % 2 ? "a" : "b",
                         60.5 + static_cast<double>(k));
    out << "gone,nothere.toml,a,\nopen," << open << ",a,70\ncontact,in_contact.toml,b,70\nempty,,"
        << last_group << ",70\n";
  }

 private:
  std::filesystem::path folder_;
  std::size_t good_;
  TriMesh arm_;
};

}  // namespace condyle::test
