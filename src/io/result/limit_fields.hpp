#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/result/json.hpp"
#include "io/result/result_column.hpp"
#include "io/result/rom_result.hpp"

/// The fields of a limit, described once: an element of `motions` in rom.json, a line of limits.csv and one of a
/// study's are made from this table, and a test compares docs/formats-limits.md with it. Whoever adds a value adds an
/// entry.

namespace condyle::io {

/// One limit of a result.
struct LimitOf {
  const RomResult& result;
  std::size_t index;

  const motion::MotionLimit& limit() const { return result.answer.limits[index]; }
  const Joint& joint() const { return result.joint; }
};

/// How a value stands in tables.
enum class LimitColumns : std::uint8_t {
  none,    ///< It is in rom.json only.
  one,     ///< a number or a text
  point,   ///< NAME_x_mm, NAME_y_mm, NAME_z_mm
  angles,  ///< NAME_ANGLE_deg for each angle of the joint
};

/// The command whose tables have the columns.
enum class LimitTables : std::uint8_t {
  rom,
  studies,
  studies_with_bands,
  studies_that_follow,  ///< a recorded motion or a load
};

/// Whether `condyle rom` has the columns for hips and other joints, hips only, or shoulders only.
enum class LimitJoints : std::uint8_t { all, hips, shoulders };

struct LimitField {
  const char* key;      ///< in rom.json; empty: in tables only
  const char* meaning;  ///< of the key, as docs/formats-limits.md has it
  /// Null if there is no value, left_out() if this answer does not have the key.
  Json (*json)(const LimitOf&);
  LimitColumns columns = LimitColumns::none;
  const char* column = "";  ///< name, or what the names begin with
  const char* unit = "";    ///< "": a text or a share
  ColumnKind kind = ColumnKind::text;
  const char* column_meaning = "";
  LimitTables tables = LimitTables::rom;
  LimitJoints joints = LimitJoints::all;
};

/// In the order of the files.
std::span<const LimitField> limit_fields() noexcept;

/// Value of a key that an answer does not have.
Json left_out();

/// The columns of a field, by the names of the joint's angles.
std::vector<ResultColumn> columns_of(const LimitField& field, Anatomy joint);

/// The texts of a field's columns, as CSV has them: numbers to the last bit, empty if there is no value.
void append_texts(std::vector<std::string>& texts, const LimitField& field, const LimitOf& of);

/// As one line of a table, with its end.
std::string csv_line(const std::vector<std::string>& fields);

}  // namespace condyle::io
