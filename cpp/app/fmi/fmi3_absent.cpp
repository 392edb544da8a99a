/// Functions that FMI 3.0 requires of every FMU for co-simulation, and that this one does not need:
/// variables of other types, clocks, events, derivatives. A request for none of them succeeds.

#include "hydrodae/cosim/fmi3.h"
#include "instance.h"

using namespace hydrodae::fmi;

#define HYDRODAE_NO_TYPE(TYPE, WHAT)                                                               \
  HYDRODAE_FMI fmi3Status fmi3Get##TYPE(fmi3Instance i, const fmi3ValueReference*, std::size_t n,  \
                                        fmi3##TYPE*, std::size_t) {                                \
    return nothing_of<fmi3Status>(i, n, WHAT);                                                     \
  }                                                                                                \
  HYDRODAE_FMI fmi3Status fmi3Set##TYPE(fmi3Instance i, const fmi3ValueReference*, std::size_t n,  \
                                        const fmi3##TYPE*, std::size_t) {                          \
    return nothing_of<fmi3Status>(i, n, WHAT);                                                     \
  }

HYDRODAE_NO_TYPE(Float32, "variables of type Float32")
HYDRODAE_NO_TYPE(Int8, "variables of type Int8")
HYDRODAE_NO_TYPE(UInt8, "variables of type UInt8")
HYDRODAE_NO_TYPE(Int16, "variables of type Int16")
HYDRODAE_NO_TYPE(UInt16, "variables of type UInt16")
HYDRODAE_NO_TYPE(UInt32, "variables of type UInt32")
HYDRODAE_NO_TYPE(Int64, "variables of type Int64")
HYDRODAE_NO_TYPE(UInt64, "variables of type UInt64")

HYDRODAE_FMI fmi3Status fmi3GetBinary(fmi3Instance i, const fmi3ValueReference*, std::size_t n,
                                      std::size_t*, fmi3Binary*, std::size_t) {
  return nothing_of<fmi3Status>(i, n, "binary variables");
}
HYDRODAE_FMI fmi3Status fmi3SetBinary(fmi3Instance i, const fmi3ValueReference*, std::size_t n,
                                      const std::size_t*, const fmi3Binary*, std::size_t) {
  return nothing_of<fmi3Status>(i, n, "binary variables");
}
HYDRODAE_FMI fmi3Status fmi3GetClock(fmi3Instance i, const fmi3ValueReference*, std::size_t n,
                                     fmi3Clock*) {
  return nothing_of<fmi3Status>(i, n, "clocks");
}
HYDRODAE_FMI fmi3Status fmi3SetClock(fmi3Instance i, const fmi3ValueReference*, std::size_t n,
                                     const fmi3Clock*) {
  return nothing_of<fmi3Status>(i, n, "clocks");
}

HYDRODAE_FMI fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String,
                                                       fmi3Boolean, fmi3Boolean,
                                                       fmi3InstanceEnvironment environment,
                                                       fmi3LogMessageCallback log) {
  if (log)
    log(environment, fmi3Error, "logStatusError",
        "this FMU is for co-simulation, not for model exchange");
  return nullptr;
}
HYDRODAE_FMI fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String,
                                                            fmi3Boolean, fmi3Boolean,
                                                            fmi3InstanceEnvironment environment,
                                                            fmi3LogMessageCallback log, void*,
                                                            void*, void*) {
  if (log)
    log(environment, fmi3Error, "logStatusError",
        "this FMU is for co-simulation, not for scheduled execution");
  return nullptr;
}

HYDRODAE_FMI fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance i, fmi3ValueReference,
                                                            std::size_t*) {
  return nothing_of<fmi3Status>(i, 1, "dependencies that change");
}
HYDRODAE_FMI fmi3Status fmi3GetVariableDependencies(fmi3Instance i, fmi3ValueReference,
                                                    std::size_t*, fmi3ValueReference*, std::size_t*,
                                                    fmi3DependencyKind*, std::size_t n) {
  return nothing_of<fmi3Status>(i, n, "dependencies that change");
}
HYDRODAE_FMI fmi3Status fmi3GetDirectionalDerivative(fmi3Instance i, const fmi3ValueReference*,
                                                     std::size_t n, const fmi3ValueReference*,
                                                     std::size_t, const fmi3Float64*, std::size_t,
                                                     fmi3Float64*, std::size_t) {
  return nothing_of<fmi3Status>(i, n, "directional derivatives");
}
HYDRODAE_FMI fmi3Status fmi3GetAdjointDerivative(fmi3Instance i, const fmi3ValueReference*,
                                                 std::size_t n, const fmi3ValueReference*,
                                                 std::size_t, const fmi3Float64*, std::size_t,
                                                 fmi3Float64*, std::size_t) {
  return nothing_of<fmi3Status>(i, n, "adjoint derivatives");
}
HYDRODAE_FMI fmi3Status fmi3GetOutputDerivatives(fmi3Instance i, const fmi3ValueReference*,
                                                 std::size_t n, const std::int32_t*, fmi3Float64*,
                                                 std::size_t) {
  return nothing_of<fmi3Status>(i, n, "derivatives of outputs");
}

HYDRODAE_FMI fmi3Status fmi3EnterConfigurationMode(fmi3Instance i) {
  return nothing_of<fmi3Status>(i, 1, "structural parameters");
}
HYDRODAE_FMI fmi3Status fmi3ExitConfigurationMode(fmi3Instance i) {
  return nothing_of<fmi3Status>(i, 1, "structural parameters");
}
HYDRODAE_FMI fmi3Status fmi3EnterEventMode(fmi3Instance i) {
  return nothing_of<fmi3Status>(i, 1, "event mode");
}
HYDRODAE_FMI fmi3Status fmi3EnterStepMode(fmi3Instance i) {
  return nothing_of<fmi3Status>(i, 1, "event mode");
}
HYDRODAE_FMI fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance i) {
  return nothing_of<fmi3Status>(i, 1, "event mode");
}
HYDRODAE_FMI fmi3Status fmi3UpdateDiscreteStates(fmi3Instance i, fmi3Boolean*, fmi3Boolean*,
                                                 fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                                                 fmi3Float64*) {
  return nothing_of<fmi3Status>(i, 1, "event mode");
}

HYDRODAE_FMI fmi3Status fmi3GetIntervalDecimal(fmi3Instance i, const fmi3ValueReference*,
                                               std::size_t n, fmi3Float64*,
                                               fmi3IntervalQualifier*) {
  return nothing_of<fmi3Status>(i, n, "clocks");
}
HYDRODAE_FMI fmi3Status fmi3GetIntervalFraction(fmi3Instance i, const fmi3ValueReference*,
                                                std::size_t n, fmi3UInt64*, fmi3UInt64*,
                                                fmi3IntervalQualifier*) {
  return nothing_of<fmi3Status>(i, n, "clocks");
}
HYDRODAE_FMI fmi3Status fmi3GetShiftDecimal(fmi3Instance i, const fmi3ValueReference*,
                                            std::size_t n, fmi3Float64*) {
  return nothing_of<fmi3Status>(i, n, "clocks");
}
HYDRODAE_FMI fmi3Status fmi3GetShiftFraction(fmi3Instance i, const fmi3ValueReference*,
                                             std::size_t n, fmi3UInt64*, fmi3UInt64*) {
  return nothing_of<fmi3Status>(i, n, "clocks");
}
HYDRODAE_FMI fmi3Status fmi3SetIntervalDecimal(fmi3Instance i, const fmi3ValueReference*,
                                               std::size_t n, const fmi3Float64*) {
  return nothing_of<fmi3Status>(i, n, "clocks");
}
HYDRODAE_FMI fmi3Status fmi3SetIntervalFraction(fmi3Instance i, const fmi3ValueReference*,
                                                std::size_t n, const fmi3UInt64*,
                                                const fmi3UInt64*) {
  return nothing_of<fmi3Status>(i, n, "clocks");
}
HYDRODAE_FMI fmi3Status fmi3SetShiftDecimal(fmi3Instance i, const fmi3ValueReference*,
                                            std::size_t n, const fmi3Float64*) {
  return nothing_of<fmi3Status>(i, n, "clocks");
}
HYDRODAE_FMI fmi3Status fmi3SetShiftFraction(fmi3Instance i, const fmi3ValueReference*,
                                             std::size_t n, const fmi3UInt64*, const fmi3UInt64*) {
  return nothing_of<fmi3Status>(i, n, "clocks");
}

HYDRODAE_FMI fmi3Status fmi3ActivateModelPartition(fmi3Instance i, fmi3ValueReference,
                                                   fmi3Float64) {
  return nothing_of<fmi3Status>(i, 1, "clocks");
}

// Functions of model exchange; some importers look up all functions of the standard.
constexpr const char* exchange = "model exchange";

HYDRODAE_FMI fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance i) {
  return nothing_of<fmi3Status>(i, 1, exchange);
}
HYDRODAE_FMI fmi3Status fmi3CompletedIntegratorStep(fmi3Instance i, fmi3Boolean, fmi3Boolean*,
                                                    fmi3Boolean*) {
  return nothing_of<fmi3Status>(i, 1, exchange);
}
HYDRODAE_FMI fmi3Status fmi3SetTime(fmi3Instance i, fmi3Float64) {
  return nothing_of<fmi3Status>(i, 1, exchange);
}
HYDRODAE_FMI fmi3Status fmi3SetContinuousStates(fmi3Instance i, const fmi3Float64*, std::size_t n) {
  return nothing_of<fmi3Status>(i, n, exchange);
}
HYDRODAE_FMI fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance i, fmi3Float64*,
                                                          std::size_t n) {
  return nothing_of<fmi3Status>(i, n, exchange);
}
HYDRODAE_FMI fmi3Status fmi3GetEventIndicators(fmi3Instance i, fmi3Float64*, std::size_t n) {
  return nothing_of<fmi3Status>(i, n, exchange);
}
HYDRODAE_FMI fmi3Status fmi3GetContinuousStates(fmi3Instance i, fmi3Float64*, std::size_t n) {
  return nothing_of<fmi3Status>(i, n, exchange);
}
HYDRODAE_FMI fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance i, fmi3Float64*,
                                                          std::size_t n) {
  return nothing_of<fmi3Status>(i, n, exchange);
}
HYDRODAE_FMI fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance i, std::size_t*) {
  return nothing_of<fmi3Status>(i, 1, exchange);
}
HYDRODAE_FMI fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance i, std::size_t*) {
  return nothing_of<fmi3Status>(i, 1, exchange);
}
