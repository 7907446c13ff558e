#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/answer/measures.hpp"
#include "io/result/result_of.hpp"

/// Results of `condyle measure`: text, JSON, tables. Rows and keys are those of measure_definitions(); docs/measures.md.

namespace condyle::io {

using MeasureResult = ResultOf<MeasureAnswer>;

/// Adds the definition of each measure if these are wanted.
std::string measure_text(const MeasureResult& result, bool with_definitions = false);
std::string measure_json(const MeasureResult& result);
/// A row for each measure.
std::string measures_csv(const MeasureResult& result);
/// A row for each direction around the neck: alpha angles and offset.
std::string neck_csv(const MeasureResult& result);
/// A row for each direction around the socket: its rim and edge angles.
std::string rim_csv(const MeasureResult& result);

/// FileError if the folder is not to be written to.
void check_measure_folder(const std::filesystem::path& folder, const Provenance* from);
/// Writes measures.json, measures.csv, and neck.csv and rim.csv where there are a neck and a socket. FileError.
std::vector<std::filesystem::path> write_measures(const std::filesystem::path& folder,
                                                  const MeasureResult& result);

}  // namespace condyle::io
