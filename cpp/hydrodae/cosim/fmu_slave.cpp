#include "hydrodae/cosim/fmu_slave.h"

#include <dlfcn.h>

#include "hydrodae/core/text.h"
#include "hydrodae/cosim/foreign_text.h"

namespace hydrodae::cosim {

FmuLibrary::FmuLibrary(const std::string& path)
    : handle_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (!handle_)
    throw CaseError("its library cannot be loaded: " + std::string(dlerror()));
}

FmuLibrary::~FmuLibrary() { dlclose(handle_); }

void* FmuLibrary::symbol(const char* name) const {
  if (void* found = dlsym(handle_, name))
    return found;
  throw CaseError("its library has no function " + in_quotes(name));
}

std::size_t room_of_state(std::size_t size) {
  constexpr std::size_t most = std::size_t{1} << 30;
  if (size > most)
    throw CaseError("the FMU reports a size of its state of " + std::to_string(size) +
                    " bytes; at most " + std::to_string(most) + " are taken");
  return size;
}

void FmuLog::require(int status, const char* function) {
  static constexpr const char* names[] = {"OK", "Warning", "Discard", "Error", "Fatal"};
  if (status == 0 || status == 1)
    return;
  fatal = status == 4;
  throw CaseError(std::string(function) + " has ended in status " +
                  (status > 0 && status < 5 ? names[status] : std::to_string(status)) +
                  (text.empty() ? "" : ": " + foreign_text(text)));
}

} // namespace hydrodae::cosim
