/// An instance of an FMU of FMI 3.0; the standard says what each function does.

#include "hydrodae/core/text.h"
#include "hydrodae/cosim/fmi3.h"
#include "hydrodae/cosim/fmu_slave.h"
#include "hydrodae/cosim/foreign_text.h"

namespace hydrodae::cosim {

namespace {

struct Fmi3 {
  using References = const fmi3ValueReference*;
  fmi3Instance (*instantiate)(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                              fmi3Boolean, fmi3Boolean, References, std::size_t,
                              fmi3InstanceEnvironment, fmi3LogMessageCallback,
                              fmi3IntermediateUpdateCallback);
  void (*free_instance)(fmi3Instance);
  fmi3Status (*enter)(fmi3Instance, fmi3Boolean, fmi3Float64, fmi3Float64, fmi3Boolean,
                      fmi3Float64);
  fmi3Status (*leave)(fmi3Instance), (*terminate)(fmi3Instance), (*reset)(fmi3Instance);
  fmi3Status (*get)(fmi3Instance, References, std::size_t, fmi3Float64*, std::size_t);
  fmi3Status (*set)(fmi3Instance, References, std::size_t, const fmi3Float64*, std::size_t);
  fmi3Status (*step)(fmi3Instance, fmi3Float64, fmi3Float64, fmi3Boolean, fmi3Boolean*,
                     fmi3Boolean*, fmi3Boolean*, fmi3Float64*);
  // Where states can be saved:
  fmi3Status (*get_state)(fmi3Instance, fmi3FMUState*), (*set_state)(fmi3Instance, fmi3FMUState),
      (*free_state)(fmi3Instance, fmi3FMUState*);
  fmi3Status (*size)(fmi3Instance, fmi3FMUState, std::size_t*);
  fmi3Status (*write)(fmi3Instance, fmi3FMUState, fmi3Byte*, std::size_t);
  fmi3Status (*read)(fmi3Instance, const fmi3Byte*, std::size_t, fmi3FMUState*);

  Fmi3(const FmuLibrary& library, bool states) {
    library.find("fmi3InstantiateCoSimulation", instantiate);
    library.find("fmi3FreeInstance", free_instance);
    library.find("fmi3EnterInitializationMode", enter);
    library.find("fmi3ExitInitializationMode", leave);
    library.find("fmi3Terminate", terminate);
    library.find("fmi3Reset", reset);
    library.find("fmi3GetFloat64", get);
    library.find("fmi3SetFloat64", set);
    library.find("fmi3DoStep", step);
    if (!states)
      return;
    library.find("fmi3GetFMUState", get_state);
    library.find("fmi3SetFMUState", set_state);
    library.find("fmi3FreeFMUState", free_state);
    library.find("fmi3SerializedFMUStateSize", size);
    library.find("fmi3SerializeFMUState", write);
    library.find("fmi3DeserializeFMUState", read);
  }
};

void log_of_fmi3(fmi3InstanceEnvironment log, fmi3Status status, fmi3String, fmi3String message) {
  if (status != fmi3OK && log && message)
    static_cast<FmuLog*>(log)->text = message;
}

class Slave3 final : public FmuSlave {
public:
  Slave3(const FmuDescription& fmu, const FmuLibrary& library, const std::string& resources,
         const std::string& name)
      : f_(library, fmu.saves_states),
        i_(f_.instantiate(name.c_str(), fmu.token.c_str(), (resources + "/").c_str(), false, false,
                          false, false, nullptr, 0, &log_, log_of_fmi3, nullptr)) {
    if (!i_)
      throw CaseError("fmi3InstantiateCoSimulation has given no instance" +
                      (log_.text.empty() ? "" : ": " + foreign_text(log_.text)));
  }
  Slave3(const Slave3&) = delete;
  Slave3& operator=(const Slave3&) = delete;
  ~Slave3() override {
    if (!log_.fatal)
      f_.free_instance(i_);
  }

  void set(const References& variables, std::span<const double> values) override {
    log_.require(f_.set(i_, variables.data(), variables.size(), values.data(), variables.size()),
                 "fmi3SetFloat64");
  }
  void get(const References& variables, std::span<double> values) override {
    log_.require(f_.get(i_, variables.data(), variables.size(), values.data(), variables.size()),
                 "fmi3GetFloat64");
  }

  void begin(double t, double end) override {
    log_.require(f_.enter(i_, false, 0.0, t, true, end), "fmi3EnterInitializationMode");
  }
  void enter() override { log_.require(f_.leave(i_), "fmi3ExitInitializationMode"); }

  bool step(double t, double h) override {
    fmi3Boolean event = false, ends = false, early = false;
    fmi3Float64 last = t;
    log_.require(f_.step(i_, t, h, false, &event, &ends, &early, &last), "fmi3DoStep");
    if (early && !ends)
      throw CaseError("fmi3DoStep has returned early, at " + number_text(last) +
                      " s, though it was not allowed to");
    return ends;
  }

  void terminate() override { log_.require(f_.terminate(i_), "fmi3Terminate"); }
  void reset() override { log_.require(f_.reset(i_), "fmi3Reset"); }

  std::vector<char> save() override {
    fmi3FMUState state = nullptr;
    std::size_t size = 0;
    log_.require(f_.get_state(i_, &state), "fmi3GetFMUState");
    log_.require(f_.size(i_, state, &size), "fmi3SerializedFMUStateSize");
    std::vector<char> out(room_of_state(size));
    log_.require(f_.write(i_, state, reinterpret_cast<fmi3Byte*>(out.data()), size),
                 "fmi3SerializeFMUState");
    log_.require(f_.free_state(i_, &state), "fmi3FreeFMUState");
    return out;
  }

  void load(const std::vector<char>& bytes) override {
    fmi3FMUState state = nullptr;
    log_.require(f_.read(i_, reinterpret_cast<const fmi3Byte*>(bytes.data()), bytes.size(), &state),
                 "fmi3DeserializeFMUState");
    log_.require(f_.set_state(i_, state), "fmi3SetFMUState");
    log_.require(f_.free_state(i_, &state), "fmi3FreeFMUState");
  }

private:
  Fmi3 f_;
  FmuLog log_;
  fmi3Instance i_ = nullptr;
};

} // namespace

std::unique_ptr<FmuSlave> make_fmu3_slave(const FmuDescription& fmu, const FmuLibrary& library,
                                          const std::string& resources, const std::string& name) {
  return std::make_unique<Slave3>(fmu, library, resources, name);
}

} // namespace hydrodae::cosim
