#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/input_recorder.hpp"

/// Which files a run made of which, as a Process Run Crate (https://w3id.org/ro/wfrun/process/0.5) of RO-Crate 1.1: docs/formats.md.

namespace condyle::io {

class OutputFolder;
struct Provenance;

/// The name that RO-Crate gives to the file.
inline constexpr const char* crate_name = "ro-crate-metadata.json";

/// What a crate says of a run. RO-Crate asks for a date; results have none, so whoever asks for the crate gives it.
struct CrateRun {
  std::string date;               ///< check_crate_date()
  std::string name, description;  ///< "condyle rom", and how it was asked
  std::vector<Input> inputs;      ///< those of kind file whose state is a digest
};

/// Throws UsageError for what is no day as YYYY-MM-DD.
void check_crate_date(std::string_view date);

/// The document for these files of a folder, named from there with '/'. It has their sizes and digests.
std::string crate_document(const CrateRun& run, const std::filesystem::path& folder,
                           std::span<const std::filesystem::path> files);

/// Adds the document for all files that were written for the folder so far.
void write_crate(OutputFolder& out, const CrateRun& run);

/// A run that answered for one joint; `name` is that of its command.
CrateRun crate_run_of(const Provenance& from, std::string date, std::string name);

}  // namespace condyle::io
