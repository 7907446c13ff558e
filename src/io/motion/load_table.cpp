#include "io/motion/load_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "condyle/error.hpp"
#include "core/near_name.hpp"
#include "io/motion/column_names.hpp"

namespace condyle::io {
namespace {

using Column = const std::vector<double>*;

constexpr std::array forces = {"force_x_n", "force_y_n", "force_z_n"};
constexpr std::array moments = {"moment_x_nmm", "moment_y_nmm", "moment_z_nmm"};

/// Null if there is none of this name.
Column column_of(const MotionTable& table, const char* name) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  return found == table.columns.end()
             ? nullptr
             : &table.values[static_cast<std::size_t>(found - table.columns.begin())];
}

std::array<Column, 3> columns_of(const MotionTable& table, const std::array<const char*, 3>& names) {
  std::array<Column, 3> columns;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    columns[axis] = column_of(table, names[axis]);
    if (columns[axis]) continue;
    std::vector<std::string> others = table.columns;  // that of another axis was not meant
    std::erase_if(others, [&](const std::string& name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    });
    throw FileError(fmt::format("{}: has no column '{}'{}{}", table.path.string(), names[axis],
                                core::did_you_mean(names[axis], others), those_there(table.columns)));
  }
  return columns;
}

void check_times(const MotionTable& table, const FrameTimes& wanted) {
  const FrameTimes given = frame_times(table);
  const auto fail = [&](const std::string& what) {
    throw FileError(
        fmt::format("{}: {}: its rows are not at the times of the motion", table.path.string(), what));
  };
  if (given.values.size() != wanted.values.size())
    fail(fmt::format("has {} rows, and the motion {}", given.values.size(), wanted.values.size()));
  for (std::size_t i = 0; i < given.values.size(); ++i)
    if (given.values[i] != wanted.values[i])
      fail(fmt::format("line {}: is at {}, and the motion at {}", table.line_of_row[i], given.values[i],
                       wanted.values[i]));
}

}  // namespace

std::vector<std::optional<contact::Load>> loads_of(const MotionTable& table, const FrameTimes& times,
                                                   BodyRole frame, bool free_rotations) {
  check_times(table, times);
  const std::array<Column, 3> force = columns_of(table, forces);
  std::array<Column, 3> moment = {};
  const auto given = std::find_if(moments.begin(), moments.end(),
                                  [&](const char* name) { return column_of(table, name) != nullptr; });
  if (given != moments.end()) {
    if (!free_rotations)
      throw FileError(fmt::format("{}: column '{}': moments are balanced with --free-rotations only",
                                  table.path.string(), *given));
    moment = columns_of(table, moments);
  }
  std::vector<std::optional<contact::Load>> loads(times.values.size(),
                                                  contact::Load{.on_mobile = {}, .frame = frame});
  for (std::size_t i = 0; i < loads.size(); ++i) {
    contact::Wrench& wrench = loads[i]->on_mobile;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      wrench.force_n[static_cast<Eigen::Index>(axis)] = (*force[axis])[i];
      if (moment[axis]) wrench.moment_nmm[static_cast<Eigen::Index>(axis)] = (*moment[axis])[i];
    }
    if (!wrench.force_n.allFinite() || !wrench.moment_nmm.allFinite()) loads[i].reset();
  }
  return loads;
}

}  // namespace condyle::io
