#pragma once
/// One function for each file of bindings. Names are those of C++; defaults are Python's business.

#include <pybind11/pybind11.h>

namespace hydrodae::bindings {

void bind_errors();
void bind_model(pybind11::module_& module);
void bind_tables(pybind11::module_& module);
void bind_io(pybind11::module_& module);
void bind_mooring(pybind11::module_& module);
void bind_simulation(pybind11::module_& module);
void bind_stepping(pybind11::module_& module);
void bind_recording(pybind11::module_& module);
void bind_analysis(pybind11::module_& module);

} // namespace hydrodae::bindings
