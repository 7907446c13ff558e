#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "command.hpp"
#include "condyle/io/mesh_file.hpp"
#include "support/cup.hpp"
#include "support/knee.hpp"
#include "support/temporary_folder.hpp"

/// Joints that commands on motions and loads are asked of, and what reads their answers.

namespace condyle::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

inline std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// A CSV file's numbers; an empty field is NaN.
inline NumberTable csv_of(const fs::path& path) {
  std::ifstream file(path);
  NumberTable table;
  std::string line, field;
  std::getline(file, line);
  for (std::istringstream names(line); std::getline(names, field, ',');) table.columns.push_back(field);
  while (std::getline(file, line)) {
    std::vector<double> row;
    line += ",";
    for (std::istringstream fields(line); std::getline(fields, field, ',');)
      row.push_back(field.empty() ? std::nan("") : std::stod(field));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// A ball in a cup, and a shank that swings against a post.
class Motion : public ::testing::Test {
 protected:
  void SetUp() override {
    io::write_mesh(folder / "cup.ply", cup(25, 5));
    io::write_mesh(folder / "ball.ply", sphere(Vec3::Zero(), 24.8, 5));
    write("cup.toml",
          joint("free", "cup.ply", "ball.ply", "[contact]\ncasting = \"fixed\"\n" + layer("fixed")));
    io::write_mesh(folder / "post.ply", box({40, -120, -50}, {60, -80, 50}));
    io::write_mesh(folder / "shank.ply", box({-1, -100, -2}, {1, -10, 2}));
    write("shank.toml", joint("ball", "post.ply", "shank.ply", ""));
  }
  static std::string layer(const std::string& body) {
    return "[contact." + body + "]\nyoungs_modulus_mpa = 10\npoisson_ratio = 0.45\nthickness = 6\n";
  }
  static std::string joint(const std::string& kind, const std::string& fixed, const std::string& mobile,
                           const std::string& more) {
    return of_bodies(kind, "mesh = \"" + fixed + "\"", "mesh = \"" + mobile + "\"", more);
  }
  /// The same with what the tables of the bodies say.
  static std::string of_bodies(const std::string& kind, const std::string& fixed, const std::string& mobile,
                               const std::string& more) {
    return "condyle = 1\nname = \"hip\"\nkind = \"" + kind +
           "\"\njoint = \"hip\"\nside = \"right\"\nunits = \"mm\"\n[fixed]\n" + fixed + "\n[mobile]\n" +
           mobile + "\n[frame]\ncentre = [0, 0, 0]\nanterior = [1, 0, 0]\nsuperior = [0, 1, 0]\n" + more;
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  Ran run(const std::string& arguments) const { return run_condyle(folder / ".", arguments); }

  const TemporaryFolder folder;
};

}  // namespace condyle::test
