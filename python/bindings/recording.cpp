#include <memory>
#include <stdexcept>

#include <pybind11/stl.h>

#include "bindings.h"
#include "hydrodae/core/error.h"
#include "hydrodae/io/results_reader.h"

namespace py = pybind11;

namespace hydrodae::bindings {
namespace {

using io::ResultsReader;

/// What cannot be read is a RuntimeError; Python adds which file and channel.
template <class Work> auto reading(Work work) {
  try {
    return work();
  } catch (const CaseError& error) {
    throw std::runtime_error(error.what());
  }
}

/// Texts may repeat bytes of a path, which are not UTF-8.
py::object as_object(const ResultsReader::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value))
    return py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
        text->data(), static_cast<Py_ssize_t>(text->size()), "surrogateescape"));
  return std::visit([](const auto& v) -> py::object { return py::cast(v); }, value);
}

py::dict attributes(const ResultsReader& file, const std::string& object) {
  py::dict out;
  for (const auto& [name, value] : reading([&] { return file.attributes(object); })) {
    const py::object key = py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(name.data(), static_cast<Py_ssize_t>(name.size()), "replace"));
    out[key] = as_object(value);
  }
  return out;
}

py::list datasets(const ResultsReader& file) {
  py::list out;
  for (const std::string& name : reading([&] { return file.datasets(); }))
    out.append(py::bytes(name));
  return out;
}

py::tuple read(const ResultsReader& file, const std::string& dataset, unsigned long long rows) {
  const ResultsReader::Shape shape = reading([&] { return file.shape_of_rows(dataset, rows); });
  std::size_t bytes = sizeof(double);
  for (const unsigned long long n : shape)
    bytes *= static_cast<std::size_t>(n);
  // NumPy and memoryview share its memory.
  const auto numbers = py::reinterpret_steal<py::object>(
      PyByteArray_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(bytes)));
  if (!numbers)
    throw py::error_already_set();
  auto* out = reinterpret_cast<double*>(PyByteArray_AsString(numbers.ptr()));
  reading([&] { file.read(dataset, shape, out); });
  return py::make_tuple(numbers, py::tuple(py::cast(shape)));
}

} // namespace

void bind_recording(py::module_& module) {
  py::class_<ResultsReader>(module, "ResultsReader",
                            "A results file of this process, open for reading.")
      .def(py::init([](const std::string& path) {
             return reading([&] { return std::make_unique<ResultsReader>(path); });
           }),
           py::arg("path"))
      .def("close", &ResultsReader::close)
      .def("datasets", &datasets, "Paths of all datasets.")
      .def("has", &ResultsReader::has, py::arg("member"),
           "Whether there is such a member of the root.")
      .def("attributes", &attributes, py::arg("object"), "Attributes of a group or dataset.")
      .def(
          "shape",
          [](const ResultsReader& file, const std::string& dataset) {
            return py::tuple(py::cast(reading([&] { return file.shape(dataset); })));
          },
          py::arg("dataset"))
      .def("read", &read, py::arg("dataset"), py::arg("rows"),
           "The first rows of a dataset as float64 numbers, and their shape.");
}

} // namespace hydrodae::bindings
