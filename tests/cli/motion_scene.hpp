#pragma once

#include <cmath>

#include "command.hpp"
#include "support/cup.hpp"
#include "support/knee.hpp"

/// Joints that commands on motions and loads are asked of, and what reads their answers.

namespace condyle::test {

/// A CSV file's numbers; an empty field is NaN.
inline NumberTable csv_of(const fs::path& path) {
  std::vector<std::string> lines = lines_of(io::read_whole_file(path));
  NumberTable table{fields_of(lines.at(0)), {}};
  lines.erase(lines.begin());
  for (const std::string& line : lines) {
    std::vector<double>& row = table.rows.emplace_back();
    for (const std::string& field : fields_of(line))
      row.push_back(field.empty() ? std::nan("") : std::stod(field));
  }
  return table;
}

/// A ball in a cup, and a shank that swings against a post.
class Motion : public CommandTest {
 protected:
  void SetUp() override {
    io::write_mesh(here / "cup.ply", cup(25, 5));
    io::write_mesh(here / "ball.ply", sphere(Vec3::Zero(), 24.8, 5));
    write("cup.toml",
          joint("free", "cup.ply", "ball.ply", "[contact]\ncasting = \"fixed\"\n" + layer("fixed")));
    io::write_mesh(here / "post.ply", box({40, -120, -50}, {60, -80, 50}));
    io::write_mesh(here / "shank.ply", box({-1, -100, -2}, {1, -10, 2}));
    write("shank.toml", joint("ball", "post.ply", "shank.ply", ""));
  }
  static std::string layer(const std::string& body) {
    return "[contact." + body + "]\nyoungs_modulus_mpa = 10\npoisson_ratio = 0.45\nthickness = 6\n";
  }
  static std::string joint(const std::string& kind, const std::string& fixed, const std::string& mobile,
                           const std::string& more) {
    return text_of_joint(
        {.fixed = fixed, .mobile = mobile, .more = more, .kind = kind, .name = "hip", .joint = "hip"});
  }
};

}  // namespace condyle::test
