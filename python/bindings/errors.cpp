#include "bindings.hpp"
#include "condyle/error.hpp"
#include "condyle/range_of_motion.hpp"

namespace condyle::python {
namespace {

/// The exceptions of condyle._errors, which live as long as the interpreter.
struct Exceptions {
  PyObject *file, *mesh, *reference_contact, *usage;
};
Exceptions exceptions;

PyObject* exception_named(const py::module_& errors, const char* name) {
  return errors.attr(name).cast<py::object>().release().ptr();
}

}  // namespace

void bind_errors(py::module_&) {
  const py::module_ errors = py::module_::import("condyle._errors");
  exceptions = {exception_named(errors, "FileError"), exception_named(errors, "MeshError"),
                exception_named(errors, "ReferenceContactError"), exception_named(errors, "UsageError")};
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const motion::ReferenceContactError& error) {
      PyErr_SetString(exceptions.reference_contact, error.what());
    } catch (const MeshError& error) {
      PyErr_SetString(exceptions.mesh, error.what());
    } catch (const FileError& error) {
      PyErr_SetString(exceptions.file, error.what());
    } catch (const UsageError& error) {
      PyErr_SetString(exceptions.usage, error.what());
    }
  });
}

}  // namespace condyle::python
