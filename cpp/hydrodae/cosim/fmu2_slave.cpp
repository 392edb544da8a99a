/// An instance of an FMU of FMI 2.0; the standard says what each function does.

#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include "hydrodae/cosim/fmi2.h"
#include "hydrodae/cosim/fmu_slave.h"
#include "hydrodae/cosim/foreign_text.h"

namespace hydrodae::cosim {

namespace {

struct Fmi2 {
  using References = const fmi2ValueReference*;
  /// Gets or sets values of a type.
  template <class Values> using Access = fmi2Status(fmi2Component, References, std::size_t, Values);

  fmi2Component (*instantiate)(fmi2String, fmi2Type, fmi2String, fmi2String,
                               const fmi2CallbackFunctions*, fmi2Boolean, fmi2Boolean);
  void (*free_instance)(fmi2Component);
  fmi2Status (*setup)(fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real);
  fmi2Status (*enter)(fmi2Component), (*leave)(fmi2Component), (*terminate)(fmi2Component),
      (*reset)(fmi2Component);
  fmi2Status (*step)(fmi2Component, fmi2Real, fmi2Real, fmi2Boolean);
  fmi2Status (*boolean_status)(fmi2Component, fmi2StatusKind, fmi2Boolean*);
  // Functions of FMUs that can save states:
  fmi2Status (*get_state)(fmi2Component, fmi2FMUstate*), (*set_state)(fmi2Component, fmi2FMUstate),
      (*free_state)(fmi2Component, fmi2FMUstate*);
  fmi2Status (*size)(fmi2Component, fmi2FMUstate, std::size_t*);
  fmi2Status (*write)(fmi2Component, fmi2FMUstate, fmi2Byte*, std::size_t);
  fmi2Status (*read)(fmi2Component, const fmi2Byte*, std::size_t, fmi2FMUstate*);

  Fmi2(const FmuLibrary& library, bool states) {
    library.find("fmi2Instantiate", instantiate);
    library.find("fmi2FreeInstance", free_instance);
    library.find("fmi2SetupExperiment", setup);
    library.find("fmi2EnterInitializationMode", enter);
    library.find("fmi2ExitInitializationMode", leave);
    library.find("fmi2Terminate", terminate);
    library.find("fmi2Reset", reset);
    library.find("fmi2DoStep", step);
    library.find("fmi2GetBooleanStatus", boolean_status);
    if (!states)
      return;
    library.find("fmi2GetFMUstate", get_state);
    library.find("fmi2SetFMUstate", set_state);
    library.find("fmi2FreeFMUstate", free_state);
    library.find("fmi2SerializedFMUstateSize", size);
    library.find("fmi2SerializeFMUstate", write);
    library.find("fmi2DeSerializeFMUstate", read);
  }
};

void log_of_fmi2(fmi2ComponentEnvironment log, fmi2String, fmi2Status status, fmi2String,
                 fmi2String message, ...) {
  if (status == fmi2OK || !log || !message)
    return;
  std::array<char, 1024> text;
  va_list arguments;
  va_start(arguments, message);
  std::vsnprintf(text.data(), text.size(), message, arguments);
  va_end(arguments);
  static_cast<FmuLog*>(log)->text = text.data();
}

class Slave2 final : public FmuSlave {
public:
  Slave2(const FmuDescription& fmu, const FmuLibrary& library, const std::string& resources,
         const std::string& name)
      : library_(library), f_(library, fmu.saves_states),
        functions_{log_of_fmi2, std::calloc, std::free, nullptr, &log_} {
    const std::string uri = "file://" + uri_text(resources);
    c_ = f_.instantiate(name.c_str(), fmi2CoSimulation, fmu.token.c_str(), uri.c_str(), &functions_,
                        0, 0);
    if (!c_)
      throw CaseError("fmi2Instantiate has given no instance" +
                      (log_.text.empty() ? "" : ": " + foreign_text(log_.text)));
  }
  Slave2(const Slave2&) = delete;
  Slave2& operator=(const Slave2&) = delete;
  ~Slave2() override {
    if (!log_.fatal)
      f_.free_instance(c_);
  }

  void set_text(unsigned reference, const std::string& value) override {
    const fmi2String text = value.c_str();
    log_.require(function<const fmi2String*>("fmi2SetString")(c_, &reference, 1, &text),
                 "fmi2SetString");
  }

  void begin(double t, double end) override {
    log_.require(f_.setup(c_, 0, 0.0, t, 1, end), "fmi2SetupExperiment");
    log_.require(f_.enter(c_), "fmi2EnterInitializationMode");
  }
  void enter() override { log_.require(f_.leave(c_), "fmi2ExitInitializationMode"); }

  bool step(double t, double h) override {
    const fmi2Status status = f_.step(c_, t, h, 0);
    fmi2Boolean ends = 0;
    if (status == fmi2Discard && f_.boolean_status(c_, fmi2Terminated, &ends) == fmi2OK && ends)
      return true;
    log_.require(status, "fmi2DoStep");
    return false;
  }

  void terminate() override { log_.require(f_.terminate(c_), "fmi2Terminate"); }
  void reset() override { log_.require(f_.reset(c_), "fmi2Reset"); }

  std::vector<char> save() override {
    fmi2FMUstate state = nullptr;
    std::size_t size = 0;
    log_.require(f_.get_state(c_, &state), "fmi2GetFMUstate");
    log_.require(f_.size(c_, state, &size), "fmi2SerializedFMUstateSize");
    std::vector<char> out(room_of_state(size));
    log_.require(f_.write(c_, state, out.data(), size), "fmi2SerializeFMUstate");
    log_.require(f_.free_state(c_, &state), "fmi2FreeFMUstate");
    return out;
  }

  void load(const std::vector<char>& bytes) override {
    fmi2FMUstate state = nullptr;
    log_.require(f_.read(c_, bytes.data(), bytes.size(), &state), "fmi2DeSerializeFMUstate");
    log_.require(f_.set_state(c_, state), "fmi2SetFMUstate");
    log_.require(f_.free_state(c_, &state), "fmi2FreeFMUstate");
  }

protected:
  void set_group(const FmuGroup& group, std::span<const double> values) override {
    if (group.type == FmuType::float64)
      set_as<fmi2Real>("fmi2SetReal", group, values);
    else if (group.type == FmuType::boolean)
      set_as<fmi2Boolean>("fmi2SetBoolean", group, values);
    else
      set_as<fmi2Integer>("fmi2SetInteger", group, values);
  }
  void get_group(const FmuGroup& group, std::span<double> values) override {
    if (group.type == FmuType::float64)
      get_as<fmi2Real>("fmi2GetReal", group, values);
    else if (group.type == FmuType::boolean)
      get_as<fmi2Boolean>("fmi2GetBoolean", group, values);
    else
      get_as<fmi2Integer>("fmi2GetInteger", group, values);
  }

private:
  /// Looked up where there is a variable of its type only.
  template <class Values> Fmi2::Access<Values>* function(const char* name) const {
    Fmi2::Access<Values>* out = nullptr;
    library_.find(name, out);
    return out;
  }
  template <class T>
  void set_as(const char* name, const FmuGroup& group, std::span<const double> values) {
    give_as<T>(group, values, [&](const unsigned* references, const T* numbers, std::size_t n) {
      log_.require(function<const T*>(name)(c_, references, n, numbers), name);
    });
  }
  template <class T>
  void get_as(const char* name, const FmuGroup& group, std::span<double> values) {
    take_as<T>(group, values, [&](const unsigned* references, T* numbers, std::size_t n) {
      log_.require(function<T*>(name)(c_, references, n, numbers), name);
    });
  }

  const FmuLibrary& library_;
  Fmi2 f_;
  FmuLog log_;
  fmi2CallbackFunctions functions_; ///< the FMU keeps its address
  fmi2Component c_ = nullptr;
};

} // namespace

std::unique_ptr<FmuSlave> make_fmu2_slave(const FmuDescription& fmu, const FmuLibrary& library,
                                          const std::string& resources, const std::string& name) {
  return std::make_unique<Slave2>(fmu, library, resources, name);
}

} // namespace hydrodae::cosim
