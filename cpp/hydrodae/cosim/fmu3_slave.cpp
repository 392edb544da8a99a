/// An instance of an FMU of FMI 3.0; the standard says what each function does.

#include "hydrodae/core/text.h"
#include "hydrodae/cosim/fmi3.h"
#include "hydrodae/cosim/fmu_slave.h"
#include "hydrodae/cosim/foreign_text.h"

namespace hydrodae::cosim {

namespace {

struct Fmi3 {
  using References = const fmi3ValueReference*;
  /// Gets or sets values of a type.
  template <class Values>
  using Access = fmi3Status(fmi3Instance, References, std::size_t, Values, std::size_t);

  fmi3Instance (*instantiate)(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                              fmi3Boolean, fmi3Boolean, References, std::size_t,
                              fmi3InstanceEnvironment, fmi3LogMessageCallback,
                              fmi3IntermediateUpdateCallback);
  void (*free_instance)(fmi3Instance);
  fmi3Status (*enter)(fmi3Instance, fmi3Boolean, fmi3Float64, fmi3Float64, fmi3Boolean,
                      fmi3Float64);
  fmi3Status (*leave)(fmi3Instance), (*terminate)(fmi3Instance), (*reset)(fmi3Instance);
  fmi3Status (*step)(fmi3Instance, fmi3Float64, fmi3Float64, fmi3Boolean, fmi3Boolean*,
                     fmi3Boolean*, fmi3Boolean*, fmi3Float64*);
  // Functions of FMUs that can save states:
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
      : library_(library), f_(library, fmu.saves_states),
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

  void set_text(unsigned reference, const std::string& value) override {
    const fmi3String text = value.c_str();
    log_.require(function<const fmi3String*>("fmi3SetString")(i_, &reference, 1, &text, 1),
                 "fmi3SetString");
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

protected:
  void set_group(const FmuGroup& group, std::span<const double> values) override {
    of_type(group.type, [&]<class T>(const std::string& name, T) {
      give_as<T>(group, values, [&](const unsigned* references, const T* numbers, std::size_t n) {
        const std::string full = "fmi3Set" + name;
        log_.require(function<const T*>(full.c_str())(i_, references, n, numbers, n), full.c_str());
      });
    });
  }
  void get_group(const FmuGroup& group, std::span<double> values) override {
    of_type(group.type, [&]<class T>(const std::string& name, T) {
      take_as<T>(group, values, [&](const unsigned* references, T* numbers, std::size_t n) {
        const std::string full = "fmi3Get" + name;
        log_.require(function<T*>(full.c_str())(i_, references, n, numbers, n), full.c_str());
      });
    });
  }

private:
  /// Looked up where there is a variable of its type only.
  template <class Values> Fmi3::Access<Values>* function(const char* name) const {
    Fmi3::Access<Values>* out = nullptr;
    library_.find(name, out);
    return out;
  }

  /// Calls `work` with the name of a type in functions and a number of it.
  template <class Work> static void of_type(FmuType type, Work&& work) {
    switch (type) {
    case FmuType::float32:
      return work("Float32", fmi3Float32());
    case FmuType::int8:
      return work("Int8", fmi3Int8());
    case FmuType::uint8:
      return work("UInt8", fmi3UInt8());
    case FmuType::int16:
      return work("Int16", fmi3Int16());
    case FmuType::uint16:
      return work("UInt16", fmi3UInt16());
    case FmuType::int32:
      return work("Int32", fmi3Int32());
    case FmuType::uint32:
      return work("UInt32", fmi3UInt32());
    case FmuType::int64:
      return work("Int64", fmi3Int64());
    case FmuType::uint64:
      return work("UInt64", fmi3UInt64());
    case FmuType::boolean:
      return work("Boolean", fmi3Boolean());
    default:
      return work("Float64", fmi3Float64());
    }
  }

  const FmuLibrary& library_;
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
