/// Functions of FMI 3.0 for co-simulation; the standard defines them.

#include "hydrodae/cosim/fmi3.h"

#include "instance.h"

using namespace hydrodae::fmi;

namespace {

/// Refuses arrays: all variables are scalars, so that there are as many variables as values.
fmi3Status refuse_arrays(fmi3Instance i) { return nothing_of<fmi3Status>(i, 1, "arrays"); }

} // namespace

HYDRODAE_FMI const char* fmi3GetVersion() { return "3.0"; }

HYDRODAE_FMI fmi3Status fmi3SetDebugLogging(fmi3Instance, fmi3Boolean, std::size_t,
                                            const fmi3String*) {
  return fmi3OK; // errors are always reported; there are no other categories
}

HYDRODAE_FMI fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String, fmi3String token, fmi3String resources, fmi3Boolean, fmi3Boolean,
    fmi3Boolean event_mode, fmi3Boolean, const fmi3ValueReference*, std::size_t intermediate,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
    fmi3IntermediateUpdateCallback) {
  const Instance::Log log = [logger, environment](Status status, const char* category,
                                                  const char* message) {
    if (logger)
      logger(environment, static_cast<fmi3Status>(status), category, message);
  };
  return make_instance(log, token, [&] {
    if (event_mode || intermediate > 0)
      throw hydrodae::CaseError("this FMU has no event mode and no intermediate updates");
    return std::string(resources ? resources : "");
  });
}

HYDRODAE_FMI void fmi3FreeInstance(fmi3Instance i) { delete static_cast<Instance*>(i); }

HYDRODAE_FMI fmi3Status fmi3EnterInitializationMode(fmi3Instance i, fmi3Boolean, fmi3Float64,
                                                    fmi3Float64 start, fmi3Boolean stops,
                                                    fmi3Float64 stop) {
  return call<fmi3Status>(i, [&](Instance& instance) {
    instance.component.begin(start, stops ? std::optional(stop) : std::nullopt);
  });
}

HYDRODAE_FMI fmi3Status fmi3ExitInitializationMode(fmi3Instance i) {
  return call<fmi3Status>(i, [](Instance& instance) { instance.component.enter(); });
}

HYDRODAE_FMI fmi3Status fmi3Terminate(fmi3Instance i) {
  return call<fmi3Status>(i, [&](Instance& instance) { instance.component.finish(); });
}

HYDRODAE_FMI fmi3Status fmi3Reset(fmi3Instance i) {
  return call<fmi3Status>(i, [&](Instance& instance) { instance.component.reset(); });
}

HYDRODAE_FMI fmi3Status fmi3DoStep(fmi3Instance i, fmi3Float64 t, fmi3Float64 h, fmi3Boolean,
                                   fmi3Boolean* event, fmi3Boolean* terminate, fmi3Boolean* early,
                                   fmi3Float64* last_time) {
  const auto tell = [](fmi3Boolean* flag) {
    if (flag)
      *flag = false;
  };
  tell(event), tell(terminate), tell(early);
  const fmi3Status status =
      call<fmi3Status>(i, [&](Instance& instance) { instance.component.step(t, h); });
  if (i && last_time)
    *last_time = instance_of(i).component.time();
  return status;
}

#define HYDRODAE_VALUES(NAME, TYPE)                                                                \
  HYDRODAE_FMI fmi3Status fmi3Get##NAME(fmi3Instance i, const fmi3ValueReference* references,      \
                                        std::size_t count, fmi3##NAME* values, std::size_t n) {    \
    return count == n ? get_values<fmi3Status>(i, TYPE, references, count, values)                 \
                      : refuse_arrays(i);                                                          \
  }                                                                                                \
  HYDRODAE_FMI fmi3Status fmi3Set##NAME(fmi3Instance i, const fmi3ValueReference* references,      \
                                        std::size_t count, const fmi3##NAME* values,               \
                                        std::size_t n) {                                           \
    return count == n ? set_values<fmi3Status>(i, TYPE, references, count, values)                 \
                      : refuse_arrays(i);                                                          \
  }

HYDRODAE_VALUES(Float64, Type::number)
HYDRODAE_VALUES(Int32, Type::integer)
HYDRODAE_VALUES(Boolean, Type::boolean)

#undef HYDRODAE_VALUES // the next file may be in the same compilation unit

HYDRODAE_FMI fmi3Status fmi3GetString(fmi3Instance i, const fmi3ValueReference* references,
                                      std::size_t count, fmi3String* values, std::size_t n) {
  return count == n ? get_texts<fmi3Status>(i, references, count, values) : refuse_arrays(i);
}
HYDRODAE_FMI fmi3Status fmi3SetString(fmi3Instance i, const fmi3ValueReference* references,
                                      std::size_t count, const fmi3String* values, std::size_t n) {
  return count == n ? set_texts<fmi3Status>(i, references, count, values) : refuse_arrays(i);
}

HYDRODAE_FMI fmi3Status fmi3GetFMUState(fmi3Instance i, fmi3FMUState* state) {
  return get_state<fmi3Status>(i, state);
}
HYDRODAE_FMI fmi3Status fmi3SetFMUState(fmi3Instance i, fmi3FMUState state) {
  return set_state<fmi3Status>(i, state);
}
HYDRODAE_FMI fmi3Status fmi3FreeFMUState(fmi3Instance i, fmi3FMUState* state) {
  return free_state<fmi3Status>(i, state);
}
HYDRODAE_FMI fmi3Status fmi3SerializedFMUStateSize(fmi3Instance i, fmi3FMUState state,
                                                   std::size_t* size) {
  return size_of_state<fmi3Status>(i, state, size);
}
HYDRODAE_FMI fmi3Status fmi3SerializeFMUState(fmi3Instance i, fmi3FMUState state, fmi3Byte* out,
                                              std::size_t size) {
  return write_state<fmi3Status>(i, state, out, size);
}
HYDRODAE_FMI fmi3Status fmi3DeserializeFMUState(fmi3Instance i, const fmi3Byte* bytes,
                                                std::size_t size, fmi3FMUState* state) {
  return read_state<fmi3Status>(i, bytes, size, state);
}
