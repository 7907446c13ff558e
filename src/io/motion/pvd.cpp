#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "io/file/whole_file.hpp"
#include "io/file/xml_escaped.hpp"
#include "io/motion/curve_files.hpp"

namespace condyle::io {
/// ParaView's format: https://www.paraview.org/Wiki/ParaView/Data_formats#PVD_File_Format. Files of one time are
/// blocks, each with a number of its own.
void write_pvd(const std::filesystem::path& path, std::span<const SeriesFile> files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  std::vector<std::string> parts;
  for (const SeriesFile& entry : files) {
    auto part = std::find(parts.begin(), parts.end(), entry.part);
    if (part == parts.end()) part = parts.insert(parts.end(), entry.part);
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", entry.time_s,
                        part - parts.begin(), io::xml_escaped(entry.part), io::xml_escaped(entry.file));
  }
  io::write_whole_file(path, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace condyle::io
