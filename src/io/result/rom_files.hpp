#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/result/rom_result.hpp"

namespace condyle::io {

/// Throws FileError if write_rom() could not write into the folder, or would write over a file that was read
/// (Provenance::read): to be called before long work. Leaves nothing.
void check_rom_folder(const std::filesystem::path& folder, const Provenance* from);

/// Writes everything a result has into a folder: rom.json, limits.csv, bearing.vtp where a bearing surface is known, map.csv,
/// map_intervals.csv and map.vtp of a map, zone_*.vtp of zones, both bodies in the fixed one's frame; with the date of a crate
/// (check_crate_date()), and provenance, ro-crate-metadata.json. All files appear or none, and files of an earlier result go. Returns what
/// was written. Throws FileError.
std::vector<std::filesystem::path> write_rom(const std::filesystem::path& folder, const RomResult& result,
                                             VtpEncoding encoding = VtpEncoding::binary,
                                             const std::optional<std::string>& crate_date = {});

}  // namespace condyle::io
