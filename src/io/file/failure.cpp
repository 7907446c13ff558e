#include "io/file/failure.hpp"

#include <exception>
#include <new>

#include "condyle/error.hpp"
#include "condyle/range_of_motion.hpp"
#include "io/file/plain_text.hpp"

namespace condyle::io {

std::string one_line(std::string text) {
  return plain_text(text);
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
