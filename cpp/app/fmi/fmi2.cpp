/// Functions of FMI 2.0 for co-simulation; the standard defines them.

#include "hydrodae/cosim/fmi2.h"

#include "instance.h"

using namespace hydrodae::fmi;

HYDRODAE_FMI const char* fmi2GetTypesPlatform() { return "default"; }
HYDRODAE_FMI const char* fmi2GetVersion() { return "2.0"; }

HYDRODAE_FMI fmi2Status fmi2SetDebugLogging(fmi2Component, fmi2Boolean, std::size_t,
                                            const fmi2String*) {
  return fmi2OK; // errors are always reported; there are no other categories
}

HYDRODAE_FMI fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid,
                                           fmi2String resources,
                                           const fmi2CallbackFunctions* functions, fmi2Boolean,
                                           fmi2Boolean) {
  const Instance::Log log = [logger = functions ? functions->logger : nullptr,
                             environment = functions ? functions->componentEnvironment : nullptr,
                             who = std::string(name ? name : "")](
                                Status status, const char* category, const char* message) {
    if (logger)
      logger(environment, who.c_str(), static_cast<fmi2Status>(status), category, "%s", message);
  };
  return make_instance(log, guid, [&] {
    if (type != fmi2CoSimulation)
      throw hydrodae::CaseError("this FMU is for co-simulation, not for model exchange");
    return folder_of_uri(resources ? resources : "");
  });
}

HYDRODAE_FMI void fmi2FreeInstance(fmi2Component c) { delete static_cast<Instance*>(c); }

HYDRODAE_FMI fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start,
                                            fmi2Boolean stops, fmi2Real stop) {
  return call<fmi2Status>(c, [&](Instance& i) {
    i.component.require("fmi2SetupExperiment", Phase::instantiated);
    i.start = start;
    i.stop = stops ? std::optional(stop) : std::nullopt;
  });
}

HYDRODAE_FMI fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return call<fmi2Status>(c, [&](Instance& i) { i.component.begin(i.start, i.stop); });
}

HYDRODAE_FMI fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return call<fmi2Status>(c, [](Instance& i) { i.component.enter(); });
}

HYDRODAE_FMI fmi2Status fmi2Terminate(fmi2Component c) {
  return call<fmi2Status>(c, [&](Instance& i) { i.component.finish(); });
}

HYDRODAE_FMI fmi2Status fmi2Reset(fmi2Component c) {
  return call<fmi2Status>(c, [&](Instance& i) { i.component.reset(); });
}

#define HYDRODAE_VALUES(NAME, TYPE)                                                                \
  HYDRODAE_FMI fmi2Status fmi2Get##NAME(fmi2Component c, const fmi2ValueReference* references,     \
                                        std::size_t n, fmi2##NAME* values) {                       \
    return get_values<fmi2Status>(c, TYPE, references, n, values);                                 \
  }                                                                                                \
  HYDRODAE_FMI fmi2Status fmi2Set##NAME(fmi2Component c, const fmi2ValueReference* references,     \
                                        std::size_t n, const fmi2##NAME* values) {                 \
    return set_values<fmi2Status>(c, TYPE, references, n, values);                                 \
  }

HYDRODAE_VALUES(Real, Type::number)
HYDRODAE_VALUES(Integer, Type::integer)
HYDRODAE_VALUES(Boolean, Type::boolean)

#undef HYDRODAE_VALUES // the next file may be in the same compilation unit

HYDRODAE_FMI fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference* references,
                                      std::size_t n, fmi2String* values) {
  return get_texts<fmi2Status>(c, references, n, values);
}
HYDRODAE_FMI fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference* references,
                                      std::size_t n, const fmi2String* values) {
  return set_texts<fmi2Status>(c, references, n, values);
}

HYDRODAE_FMI fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return get_state<fmi2Status>(c, state);
}
HYDRODAE_FMI fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return set_state<fmi2Status>(c, state);
}
HYDRODAE_FMI fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return free_state<fmi2Status>(c, state);
}
HYDRODAE_FMI fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state,
                                                   std::size_t* size) {
  return size_of_state<fmi2Status>(c, state, size);
}
HYDRODAE_FMI fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte* out,
                                              std::size_t size) {
  return write_state<fmi2Status>(c, state, out, size);
}
HYDRODAE_FMI fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte* bytes,
                                                std::size_t size, fmi2FMUstate* state) {
  return read_state<fmi2Status>(c, bytes, size, state);
}

HYDRODAE_FMI fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference*,
                                                     std::size_t n, const fmi2ValueReference*,
                                                     std::size_t, const fmi2Real*, fmi2Real*) {
  return nothing_of<fmi2Status>(c, n, "directional derivatives");
}

HYDRODAE_FMI fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference*,
                                                    std::size_t n, const fmi2Integer*,
                                                    const fmi2Real*) {
  return nothing_of<fmi2Status>(c, n, "derivatives of inputs");
}

HYDRODAE_FMI fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference*,
                                                     std::size_t n, const fmi2Integer*, fmi2Real*) {
  return nothing_of<fmi2Status>(c, n, "derivatives of outputs");
}

HYDRODAE_FMI fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean) {
  return call<fmi2Status>(c, [&](Instance& i) { i.component.step(t, h); });
}

HYDRODAE_FMI fmi2Status fmi2CancelStep(fmi2Component c) {
  return nothing_of<fmi2Status>(c, 1, "steps in the background");
}

HYDRODAE_FMI fmi2Status fmi2GetStatus(fmi2Component c, fmi2StatusKind, fmi2Status*) {
  return nothing_of<fmi2Status>(c, 1, "steps in the background");
}

HYDRODAE_FMI fmi2Status fmi2GetRealStatus(fmi2Component c, fmi2StatusKind kind, fmi2Real* value) {
  if (kind != fmi2LastSuccessfulTime)
    return nothing_of<fmi2Status>(c, 1, "such status");
  return call<fmi2Status>(c, [&](Instance& i) { *value = i.component.time(); });
}

HYDRODAE_FMI fmi2Status fmi2GetIntegerStatus(fmi2Component c, fmi2StatusKind, fmi2Integer*) {
  return nothing_of<fmi2Status>(c, 1, "such status");
}

HYDRODAE_FMI fmi2Status fmi2GetBooleanStatus(fmi2Component c, fmi2StatusKind kind,
                                             fmi2Boolean* value) {
  if (kind != fmi2Terminated)
    return nothing_of<fmi2Status>(c, 1, "such status");
  *value = 0; // the importer ends the run, never the FMU
  return fmi2OK;
}

HYDRODAE_FMI fmi2Status fmi2GetStringStatus(fmi2Component c, fmi2StatusKind, fmi2String*) {
  return nothing_of<fmi2Status>(c, 1, "steps in the background");
}
