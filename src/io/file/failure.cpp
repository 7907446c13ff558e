#include "io/file/failure.hpp"

#include <exception>
#include <new>
#include <string_view>

#include "condyle/error.hpp"
#include "condyle/range_of_motion.hpp"
#include "io/file/plain_text.hpp"

namespace condyle::io {

std::string one_line(std::string text) {
  std::string line = plain_text(text);
  if (line.size() <= longest_message) return line;
  constexpr std::string_view between = " ... ";
  constexpr std::size_t at_end = longest_message / 4, at_start = longest_message - at_end - between.size();
  const auto begins_a_character = [&](std::size_t at) {
    return (static_cast<unsigned char>(line[at]) & 0xc0) != 0x80;
  };
  std::size_t end_of_start = at_start, start_of_end = line.size() - at_end;
  while (!begins_a_character(end_of_start)) --end_of_start;
  while (!begins_a_character(start_of_end)) ++start_of_end;
  return line.substr(0, end_of_start) + std::string(between) + line.substr(start_of_end);
}

Failure failure_of_current_exception() {
  try {
    throw;
  } catch (const UsageError& error) {
    return {bad_usage, one_line(error.what())};
  } catch (const FileError& error) {
    return {bad_file, one_line(error.what())};
  } catch (const motion::ReferenceContactError& error) {
    return {reference_contact, one_line(error.what())};
  } catch (const MeshError& error) {
    return {unfit_mesh, one_line(error.what())};
  } catch (const std::bad_alloc&) {
    return {internal_error, "out of memory"};
  } catch (const std::exception& error) {
    return {internal_error, one_line(std::string("internal error: ") + error.what())};
  }
}

}  // namespace condyle::io
