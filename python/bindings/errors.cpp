#include "bindings.h"
#include "hydrodae/control/law.h"
#include "hydrodae/core/error.h"

namespace py = pybind11;

namespace hydrodae::bindings {
namespace {

/// The exceptions themselves are Python's: hydrodae/errors.py.
py::object error_type(const char* name) {
  return py::module_::import("hydrodae.errors").attr(name);
}

/// Text of a message, which may repeat bytes of a file that are not UTF-8.
py::str text(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(
      bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "backslashreplace"));
}

void raise(const char* type, const std::exception& error) {
  py::set_error(error_type(type), text(error.what()));
}

void raise_solver_error(const SolverError& error) {
  const py::object type = error_type("SolverError");
  const py::object exception = type(text(error.what()));
  exception.attr("time") = error.time;
  exception.attr("reason") = std::string(name_of(error.halt.reason));
  exception.attr("subject") = error.halt.subject;
  exception.attr("advice") = error.halt.advice;
  py::dict numbers;
  for (const auto& [name, value] : error.halt.numbers)
    numbers[py::str(name)] = value;
  exception.attr("numbers") = numbers;
  py::set_error(type, exception);
}

void raise_case_error(const FilePlace& place, const std::string& key, const std::string& fault,
                      const char* message) {
  const py::object type = error_type("CaseError");
  const py::object exception = type(text(message));
  exception.attr("file") = text(place.file);
  exception.attr("line") = place.line;
  exception.attr("column") = place.column;
  exception.attr("key") = text(key);
  exception.attr("fault") = text(fault);
  py::set_error(type, exception);
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer)
      std::rethrow_exception(pointer);
  } catch (const SolverError& error) {
    raise_solver_error(error);
  } catch (const CaseError& error) {
    raise_case_error(error.place, error.key, error.fault, error.what());
  } catch (const ModelError& error) { // without a place in a file; see simulation.cpp
    raise_case_error({}, error.key, error.what(), error.what());
  } catch (const control::Stopped& stopped) {
    raise("RunInterrupted", stopped);
  } catch (const Error& error) {
    raise("HydrodaeError", error);
  }
}

} // namespace

void bind_errors() { py::register_local_exception_translator(translate); }

} // namespace hydrodae::bindings
