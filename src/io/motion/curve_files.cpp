#include "io/motion/curve_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "condyle/error.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/whole_file.hpp"

namespace condyle::io {
namespace {

/// Refuses names that a reader cannot distinguish, and numbers that it does not take.
void check(const std::filesystem::path& path, const Curves& curves, std::string_view not_in_names) {
  assert(curves.values.size() == curves.names.size());
  const auto fail = [&](const std::string& name, std::string_view what) {
    throw FileError(
        fmt::format("{}: cannot be written: column {} {}", path.string(), io::in_quotes(name), what));
  };
  std::set<std::string_view> known = {curves.axis};
  for (std::size_t c = 0; c < curves.names.size(); ++c) {
    const std::string& name = curves.names[c];
    if (name.empty() || name.find_first_of(not_in_names) != name.npos)
      fail(name, "has a name that cannot be read back");
    if (!known.insert(name).second) fail(name, "is there twice");
    assert(curves.values[c].size() == curves.at.size());
    if (std::any_of(curves.values[c].begin(), curves.values[c].end(),
                    [](double value) { return std::isinf(value); }))
      fail(name, "has a number that is not finite");
  }
}

}  // namespace

void write_sto(const std::filesystem::path& path, std::string_view title, const Curves& curves,
               AngleUnit unit) {
  assert(curves.axis == "time" && "OpenSim's tables are over time");
  assert(title.find_first_of("\r\n") == title.npos);
  check(path, curves, " \t\r\n");
  std::string text = fmt::format("{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees={}\nendheader\n{}", title,
                                 curves.at.size(), curves.names.size() + 1,
                                 unit == AngleUnit::degrees ? "yes" : "no", curves.axis);
  for (const std::string& name : curves.names) text += "\t" + name;
  text += "\n";
  for (std::size_t row = 0; row < curves.at.size(); ++row) {
    text += fmt::format("{}", curves.at[row]);
    for (const std::vector<double>& column : curves.values)
      text += std::isnan(column[row]) ? "\tnan" : fmt::format("\t{}", column[row]);
    text += "\n";
  }
  io::write_whole_file(path, text);
}

void write_curves_csv(const std::filesystem::path& path, const Curves& curves, std::string_view comments) {
  assert(comments.empty() || (comments.starts_with('#') && comments.ends_with('\n')));
  check(path, curves, "\r\n");
  std::string text(comments);
  text += io::csv_field(curves.axis);
  for (const std::string& name : curves.names) text += "," + io::csv_field(name);
  text += "\n";
  for (std::size_t row = 0; row < curves.at.size(); ++row) {
    text += fmt::format("{}", curves.at[row]);
    for (const std::vector<double>& column : curves.values)
      text += std::isnan(column[row]) ? "," : fmt::format(",{}", column[row]);
    text += "\n";
  }
  io::write_whole_file(path, text);
}

}  // namespace condyle::io
