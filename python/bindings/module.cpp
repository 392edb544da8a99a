#include "bindings.h"
#include "hydrodae/simulation.h"

PYBIND11_MODULE(_core, module) {
  using namespace hydrodae::bindings;
  module.doc() = "The compiled kernel. Users call it through hydrodae.Case and hydrodae.run.";
  module.attr("version") = hydrodae::version;
  bind_errors();
  bind_model(module);
  bind_tables(module);
  bind_io(module);
  bind_mooring(module);
  bind_simulation(module);
  bind_stepping(module);
  bind_recording(module);
  bind_analysis(module);
}
