#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "answer/records/limit_record.hpp"
#include "answer/records/measure_record.hpp"
#include "answer/records/touch_table.hpp"
#include "condyle/error.hpp"
#include "condyle/joint_checks.hpp"
#include "io/file/whole_file.hpp"
#include "io/record/table_of.hpp"
#include "kinematics/wrong_set_up.hpp"

/// condyle_describe ROOT [--check]: writes what is made from the tables of records into the repository at ROOT: the classes of Python, the
/// types of the page and the tables of docs/. With --check it names each file that is not what would be written, with exit code 1.

namespace condyle {
namespace {

/// Whether an enum has this value: GCC and clang write the others as casts.
template <auto value>
constexpr bool is_enumerator() {
  constexpr std::string_view signature = __PRETTY_FUNCTION__;
  constexpr std::string_view before = "value = ";
  return signature[signature.find(before) + before.size()] != '(';
}

template <class Enum, class Visit>
void for_each_enumerator(const Visit& visit) {
  const auto one = [&]<int value>() {
    if constexpr (is_enumerator<static_cast<Enum>(value)>()) visit(static_cast<Enum>(value));
  };
  [&]<int... values>(std::integer_sequence<int, values...>) {
    (one.template operator()<values - std::is_signed_v<std::underlying_type_t<Enum>>>(), ...);
  }
  (std::make_integer_sequence<int, 64>());
}

/// The names of an enum in files, each in quotes and behind `separator` but the first.
template <class Enum>
std::string names_of(std::string_view separator) {
  std::string names;
  for_each_enumerator<Enum>([&](Enum value) {
    if (const std::string_view name = name_of(value); name != "none")
      names += fmt::format("{}\"{}\"", names.empty() ? "" : separator, name);
  });
  return names;
}

// ---- Python

/// As a type hint of a value that is not None.
template <class Value>
std::string hint_of() {
  if constexpr (is_optional<Value>)
    return hint_of<typename Value::value_type>();
  else if constexpr (IsRecord<Value>)
    return table<Value>.name;
  else if constexpr (io::cells::is_point<Value>)
    return "NDArray[np.float64]";
  else if constexpr (is_of_angles<Value>)
    return "Angles";
  else if constexpr (is_list<Value>)
    return fmt::format("list[{}]", hint_of<typename Value::value_type>());
  else if constexpr (std::same_as<Value, JointAngle>)
    return "str";
  else if constexpr (std::is_enum_v<Value>)
    return fmt::format("Literal[{}]", names_of<Value>(", "));
  else if constexpr (std::same_as<Value, bool>)
    return "bool";
  else if constexpr (std::is_integral_v<Value>)
    return "int";
  else if constexpr (io::cells::is_angle<Value> || std::is_floating_point_v<Value>)
    return "float";
  else
    return "str";
}

/// The lines of a text of at most so many characters, each behind these blanks.
std::string wrapped(std::string_view text, std::string_view blanks) {
  constexpr std::size_t most = 130;
  std::string lines;
  while (!text.empty()) {
    std::size_t end = text.size();
    if (blanks.size() + end > most) end = text.rfind(' ', most - blanks.size());
    lines += fmt::format("{}{}\n", blanks, text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// "a `key` or `\"word\"`" as a docstring has it.
std::string plain(std::string_view meaning) {
  std::string text(meaning);
  for (std::size_t at = 0; (at = text.find("](", at)) != text.npos;)  // a link is its text
    text.erase(at, text.find(')', at) + 1 - at), text.erase(text.rfind('[', at), 1);
  return text;
}

/// Every record, each behind those that it holds, as `of.operator()<Record>()` has it.
template <class Of>
std::string each_record(const Of& of) {
  const auto all = [&]<class... Records>(std::type_identity<Records>...) {
    return (std::string() + ... + of.template operator()<Records>());
  };
  return all(std::type_identity<FeatureRecord>(), std::type_identity<FeaturesRecord>(),
             std::type_identity<PartsRecord>(), std::type_identity<motion::DepthLimit>(),
             std::type_identity<plan::ClosedLimit>(), std::type_identity<BandWidthRecord>(),
             std::type_identity<BandRecord>(), std::type_identity<BoneReferenceRecord>(),
             std::type_identity<SoftTissueGap>(), std::type_identity<PeopleRange>(),
             std::type_identity<LivingLimit>(), std::type_identity<MotionCaveat>(),
             std::type_identity<FixedZoneRecord>(), std::type_identity<MobileZoneRecord>(),
             std::type_identity<ZoneRecord>(), std::type_identity<LimitRecord>(),
             std::type_identity<NormalRangeRecord>(), std::type_identity<measure::MeasureBand>(),
             std::type_identity<MeasureRecord>(), std::type_identity<measure::NeckHour>(),
             std::type_identity<measure::RimHour>(), std::type_identity<ShapeRecord>());
}

/// The same of two meshes without a joint, of which the page has none.
template <class Of>
std::string each_touch_record(const Of& of) {
  return of.template operator()<JointNote>() + of.template operator()<TouchDepth>() +
         of.template operator()<FreeTranslation>() + of.template operator()<TouchAnswer>() +
         of.template operator()<motion::Limit>() + of.template operator()<motion::FreeInterval>() +
         of.template operator()<TurnAnswer>() + of.template operator()<motion::SlideEnd>() +
         of.template operator()<motion::FreeSlide>() + of.template operator()<SlideAnswer>();
}

template <class Record>
std::string python_class() {
  std::string meanings, members;
  for_each_field<Record>([&]<class Field>(const Field& field) {
    if (*field.key == 0) return;
    using Value = ValueOf<Record, std::remove_cvref_t<decltype(field)>>;
    const std::string hint = hint_of<Value>();
    members += is_optional<Value> ? fmt::format("    {}: Optional[{}] = None\n", field.key, hint)
                                  : fmt::format("    {}: {}\n", field.key, hint);
    if (*field.meaning)
      meanings += fmt::format("    {} : {}{}\n", field.key, hint, is_optional<Value> ? " or None" : "") +
                  wrapped(plain(field.meaning), "        ");
  });
  return fmt::format(
      "\n\nclass {}(Record):\n    \"\"\"{}{}\"\"\"\n\n{}", table<Record>.name, table<Record>.meaning,
      meanings.empty() ? "" : "\n\n    Attributes\n    ----------\n" + meanings + "    ", members);
}

std::string python_records() {
  return R"("""Records of answers, by the keys of their files. Made by `make describe` from the tables in src/answer/records/."""

from __future__ import annotations

from typing import Literal, Optional

import numpy as np
from numpy.typing import NDArray

from ._motion import Angles
from ._record import Record
)" + each_record([]<class Record>() { return python_class<Record>(); }) +
         each_touch_record([]<class Record>() { return python_class<Record>(); });
}

// ---- TypeScript

/// "limitRecord" of LimitRecord.
std::string check_name(std::string name) {
  name[0] = static_cast<char>(name[0] - 'A' + 'a');
  return name;
}

/// As a check of checks.ts, which has its type too; of a value that is not null.
template <class Value>
std::string check_of() {
  if constexpr (is_optional<Value>) {
    return check_of<typename Value::value_type>();
  } else if constexpr (IsRecord<Value>) {
    return check_name(table<Value>.name);
  } else if constexpr (io::cells::is_point<Value>) {
    return "three";
  } else if constexpr (is_of_angles<Value>) {
    return "each(number)";
  } else if constexpr (is_list<Value>) {
    return "list(" + check_of<typename Value::value_type>() + ")";
  } else if constexpr (std::is_enum_v<Value> && !std::same_as<Value, JointAngle>) {
    return "oneOf(" + names_of<Value>(", ") + ")";
  } else {
    const std::string hint = hint_of<Value>();
    return hint == "bool" ? "flag" : hint == "str" ? "text" : "number";
  }
}

/// Whether JSON has null of some of a record's values.
template <class Value>
constexpr bool can_be_null(IfEmpty if_empty) {
  if constexpr (!is_optional<Value>)
    return false;
  else
    return if_empty == IfEmpty::null || is_optional<typename Value::value_type>;
}

/// A text with members in braces, on as few lines as fit: they fill lines as those of other files of the page do.
std::string braced(const std::string& before, const std::vector<std::string>& members,
                   std::string_view after) {
  constexpr std::size_t widest = 120;
  const std::string whole = fmt::format("{}{{ {} }}{}\n", before, fmt::join(members, ", "), after);
  if (whole.size() <= widest) return whole;
  std::string lines, line = " ";
  for (const std::string& member : members) {
    if (line.size() + member.size() + 2 > widest) {
      lines += line + "\n";
      line = " ";
    }
    line += " " + member + ",";
  }
  return fmt::format("{}{{\n{}{}\n}}{}\n", before, lines, line, after);
}

template <class Record>
std::string page_type() {
  std::vector<std::string> checks;
  for_each_field<Record>([&](const auto& field) {
    if (*field.key == 0) return;
    using Value = ValueOf<Record, std::remove_cvref_t<decltype(field)>>;
    std::string check = check_of<Value>();
    if (can_be_null<Value>(field.if_empty)) check = "orNull(" + check + ")";
    if (field.if_empty == IfEmpty::left_out) check = "ifThere(" + check + ")";
    checks.push_back(fmt::format("{}: {}", field.key, check));
  });
  return fmt::format("\n/// {}\n", table<Record>.meaning) +
         braced(fmt::format("export const {} = object(", check_name(table<Record>.name)), checks, ");");
}

/// Codes of the notes that are no findings.
std::string note_grades() {
  std::vector<std::string> grades;
  for_each_enumerator<JointNoteCode>([&](JointNoteCode code) {
    if (kinematics::is_wrong_set_up(code)) grades.push_back(fmt::format("{}: \"wrong\"", name_of(code)));
  });
  for_each_enumerator<RangeNoteCode>(
      [&](RangeNoteCode code) { grades.push_back(fmt::format("{}: \"remark\"", name_of(code))); });
  return "\n/// Notes by which no number holds, and those on how exact limits are, which `--strict` lets "
         "pass; others are findings.\n" +
         braced("export const noteGrades: Record<string, \"wrong\" | \"remark\"> = ", grades, ";");
}

std::string page_records() {
  return R"(// Records of answers, and checks of them. Made by `make describe` from the tables in src/answer/records/.
import { each, flag, ifThere, list, number, object, oneOf, orNull, text, three } from "./checks";
)" + each_record([]<class Record>() { return page_type<Record>(); }) +
         note_grades();
}

// ---- docs/

/// A page with the table below this header replaced.
std::string with_table(std::string page, std::string_view header, std::string_view rows) {
  const std::size_t begin = page.find(header);
  if (begin == page.npos) throw FileError(fmt::format("a page has no table below: {}", header));
  const std::size_t end = std::min(page.find("\n\n", begin), page.size() - 1);
  return page.replace(begin, end + 1 - begin, std::string(header) + std::string(rows));
}

template <class Record>
std::string key_rows() {
  std::string rows;
  for_each_field<Record>([&](const auto& field) {
    if (*field.key) rows += fmt::format("| `{}` | {} |\n", field.key, field.meaning);
  });
  return rows;
}

template <class Record>
std::string column_rows() {
  std::string rows;
  for (const io::ResultColumn& column :
       io::columns_of<Record>(Anatomy::hip, [](const FieldColumn&) { return true; }))
    rows += fmt::format("| `{}` | {} | {} |\n", column.name, column.unit, column.meaning);
  return rows;
}

std::string limits_page(std::string page) {
  page = with_table(std::move(page), "| key | value |\n|---|---|\n", key_rows<LimitRecord>());
  return with_table(std::move(page), "| column | unit | value |\n|---|---|---|\n",
                    column_rows<LimitRecord>());
}

std::string measures_page(std::string page) {
  page =
      with_table(std::move(page), "| key of `measures.json` | value |\n|---|---|\n", key_rows<ShapeRecord>());
  return with_table(std::move(page), "| key of a measure | value |\n|---|---|\n", key_rows<MeasureRecord>());
}

std::string touch_page(std::string page) {
  page = with_table(std::move(page), "| key of `touch.json` | value |\n|---|---|\n", key_rows<TouchAnswer>());
  page = with_table(std::move(page), "| key of `deepest` | value |\n|---|---|\n", key_rows<TouchDepth>());
  page = with_table(std::move(page), "| key of one of `free` | value |\n|---|---|\n",
                    key_rows<FreeTranslation>());
  page = with_table(std::move(page), "| key of a turn | value |\n|---|---|\n", key_rows<TurnAnswer>());
  page = with_table(std::move(page), "| key of a slide | value |\n|---|---|\n", key_rows<SlideAnswer>());
  page = with_table(std::move(page), "| key of an end of a turn | value |\n|---|---|\n",
                    key_rows<motion::Limit>());
  return with_table(std::move(page), "| key of an end of a slide | value |\n|---|---|\n",
                    key_rows<motion::SlideEnd>());
}

int described(const std::filesystem::path& root, bool only_check) {
  const std::filesystem::path limits = root / "docs/formats-rom.md", measures = root / "docs/measures.md",
                              touch = root / "docs/touch.md";
  const std::pair<std::filesystem::path, std::string> files[] = {
      {root / "python/condyle/_records.py", python_records()},
      {root / "viewer/src/records.ts", page_records()},
      {limits, limits_page(io::read_whole_file(limits))},
      {measures, measures_page(io::read_whole_file(measures))},
      {touch, touch_page(io::read_whole_file(touch))}};
  int stale = 0;
  for (const auto& [path, text] : files) {
    if (std::filesystem::exists(path) && io::read_whole_file(path) == text) continue;
    if (only_check) {
      std::cerr << path.string() << " is not what the tables of records say: run make describe\n";
      stale = 1;
    } else {
      io::write_whole_file(path, text);
    }
  }
  return stale;
}

}  // namespace
}  // namespace condyle

int main(int count, char** words) {
  if (count < 2) return 2;
  try {
    return condyle::described(words[1], count > 2 && std::string_view(words[2]) == "--check");
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
