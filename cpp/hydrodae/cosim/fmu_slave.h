#pragma once
/// Instance of an FMU for co-simulation, independent of the version of FMI.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hydrodae/core/error.h"
#include "hydrodae/cosim/fmu_description.h"

namespace hydrodae::cosim {

/// Functions throw CaseError with the name of the function of FMI, its status and what the FMU has
/// logged, where that is worse than a warning.
class FmuSlave {
public:
  virtual ~FmuSlave() = default;

  /// @param values  a row in which each variable has its place
  void set(const FmuGroups& variables, std::span<const double> values) {
    for (const FmuGroup& group : variables)
      set_group(group, values);
  }
  void get(const FmuGroups& variables, std::span<double> values) {
    for (const FmuGroup& group : variables)
      get_group(group, values);
  }
  virtual void set_text(unsigned reference, const std::string& value) = 0;

  /// Initialisation mode from here on, and its end.
  /// @param t, end  start and end of the run [s]
  virtual void begin(double t, double end) = 0;
  virtual void enter() = 0;

  /// @returns whether the FMU wants the run to end
  virtual bool step(double t, double h) = 0;

  /// Terminates the run; call it after `enter`.
  virtual void terminate() = 0;
  virtual void reset() = 0;
  virtual std::vector<char> save() = 0;
  virtual void load(const std::vector<char>& bytes) = 0;

protected:
  virtual void set_group(const FmuGroup& group, std::span<const double> values) = 0;
  virtual void get_group(const FmuGroup& group, std::span<double> values) = 0;
};

/// The functions of a shared library, which stays loaded as long as this object is there.
class FmuLibrary {
public:
  /// Throws CaseError where it cannot be loaded.
  explicit FmuLibrary(const std::string& path);
  FmuLibrary(const FmuLibrary&) = delete;
  FmuLibrary& operator=(const FmuLibrary&) = delete;
  ~FmuLibrary();

  /// Throws CaseError where there is no such function.
  template <class F> void find(const char* name, F*& function) const {
    function = reinterpret_cast<F*>(symbol(name));
  }

private:
  void* symbol(const char* name) const;
  void* handle_;
};

/// Last message that an FMU has logged, and checks of statuses.
struct FmuLog {
  std::string text;
  bool fatal = false; ///< true: no function may be called any more

  /// @param status  0 OK, 1 Warning, 2 Discard, 3 Error, 4 Fatal, in both versions
  void require(int status, const char* function);
};

/// The size of a serialised state, as an FMU gives it. Throws CaseError where it cannot be meant.
std::size_t room_of_state(std::size_t size);

/// Throw CaseError where the FMU cannot be instantiated.
/// @param resources  folder of its resources
std::unique_ptr<FmuSlave> make_fmu2_slave(const FmuDescription& fmu, const FmuLibrary& library,
                                          const std::string& resources, const std::string& name);
std::unique_ptr<FmuSlave> make_fmu3_slave(const FmuDescription& fmu, const FmuLibrary& library,
                                          const std::string& resources, const std::string& name);

} // namespace hydrodae::cosim
