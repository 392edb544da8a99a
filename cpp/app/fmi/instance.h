#pragma once
/// Common part of the C functions of FMI 2.0 and 3.0.

#include <cstddef>
#include <cstring>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "component.h"
#include "hydrodae/core/error.h"

#define HYDRODAE_FMI extern "C" __attribute__((visibility("default")))

namespace hydrodae::fmi {

/// Status with equal numbers in both versions of the standard.
enum class Status : int { ok, warning, discard, error, fatal };

/// Component with the message callback of the importer.
struct Instance {
  using Log = std::function<void(Status, const char* category, const char* message)>;

  Component component;
  Log log;
  std::optional<double> stop = {}; ///< stop time, which FMI 2.0 gives before the run begins [s]
  double start = 0.0;
};

/// States held by importers. Unknown addresses are refused: importers may free a state twice, or
/// pass another pointer.
class HeldStates {
public:
  static HeldStates& all() {
    static HeldStates held;
    return held;
  }
  void* add(Component::State&& state) {
    auto own = std::make_unique<Component::State>(std::move(state));
    void* const address = own.get();
    const std::lock_guard lock(mutex_);
    states_[address] = std::move(own);
    return address;
  }
  Component::State& find(void* address) {
    const std::lock_guard lock(mutex_);
    const auto found = states_.find(address);
    if (found == states_.end())
      throw CaseError("there is no such state; it has been freed, or was never saved");
    return *found->second;
  }
  void free(void* address) {
    find(address);
    const std::lock_guard lock(mutex_);
    states_.erase(address);
  }

private:
  std::mutex mutex_;
  std::map<void*, std::unique_ptr<Component::State>> states_;
};

inline Instance& instance_of(void* instance) { return *static_cast<Instance*>(instance); }
inline Component::State& state_of(void* state) { return HeldStates::all().find(state); }

inline void require_place(const void* place) {
  if (!place)
    throw CaseError("no place to read from or write to is given");
}

/// Calls `work` on the instance; an exception becomes a message and a status, because C++
/// exceptions must not leave the library.
/// @tparam S  status of either version
template <class S, class Work> S call(void* instance, Work&& work) {
  if (!instance)
    return static_cast<S>(Status::error);
  const auto tell = [&](const char* message) {
    instance_of(instance).log(Status::error, "logStatusError", message);
    return static_cast<S>(Status::error);
  };
  try {
    std::forward<Work>(work)(instance_of(instance));
    return static_cast<S>(Status::ok);
  } catch (const std::bad_alloc&) {
    return tell("not enough memory");
  } catch (const std::exception& error) {
    return tell(error.what());
  }
}

/// Returns an error for `count` > 0 clocks, events, derivatives or variables of other types, which
/// do not exist here.
template <class S> S nothing_of(void* instance, std::size_t count, const char* what) {
  return call<S>(instance, [&](Instance&) {
    if (count > 0)
      throw CaseError(std::string("this FMU has no ") + what);
  });
}

/// Creates an instance; null with a message to the importer if that fails.
/// @param place  gives the folder resources/ from the arguments of the importer
template <class Place>
Instance* make_instance(const Instance::Log& log, const char* token, Place&& place) {
  try {
    Component component(place());
    if (!token || component.token() != token)
      throw CaseError("the model description and the resources are of different FMUs (token)");
    return new Instance{std::move(component), log};
  } catch (const std::exception& error) {
    log(Status::error, "logStatusError", error.what());
    return nullptr;
  }
}

using Type = Variable::Type;

/// @tparam T  double or int; for a boolean bool in FMI 3.0 and int in 2.0
template <class S, class T>
S set_values(void* instance, Type type, const Reference* references, std::size_t count,
             const T* values) {
  return call<S>(instance, [&](Instance& i) {
    if (count > 0)
      require_place(references), require_place(values);
    for (std::size_t k = 0; k < count; ++k)
      i.component.set(references[k], type,
                      type == Type::boolean ? (values[k] ? 1.0 : 0.0)
                                            : static_cast<double>(values[k]));
  });
}

template <class S, class T>
S get_values(void* instance, Type type, const Reference* references, std::size_t count, T* values) {
  return call<S>(instance, [&](Instance& i) {
    if (count > 0)
      require_place(references), require_place(values);
    for (std::size_t k = 0; k < count; ++k)
      values[k] = static_cast<T>(i.component.get(references[k], type));
  });
}

template <class S>
S set_texts(void* instance, const Reference* references, std::size_t count,
            const char* const* values) {
  return call<S>(instance, [&](Instance& i) {
    if (count > 0)
      require_place(references), require_place(values);
    for (std::size_t k = 0; k < count; ++k) {
      require_place(values[k]);
      i.component.set_text(references[k], values[k]);
    }
  });
}

template <class S>
S get_texts(void* instance, const Reference* references, std::size_t count, const char** values) {
  return call<S>(instance, [&](Instance& i) {
    if (count > 0)
      require_place(references), require_place(values);
    for (std::size_t k = 0; k < count; ++k)
      values[k] = i.component.get_text(references[k]).c_str();
  });
}

/// Saves the state into an existing object, or a new one.
template <class S> S get_state(void* instance, void** state) {
  return call<S>(instance, [&](Instance& i) {
    require_place(state);
    if (*state)
      state_of(*state) = i.component.save();
    else
      *state = HeldStates::all().add(i.component.save());
  });
}

template <class S> S set_state(void* instance, void* state) {
  return call<S>(instance, [&](Instance& i) { i.component.load(state_of(state)); });
}

template <class S> S free_state(void* instance, void** state) {
  return call<S>(instance, [&](Instance&) {
    if (!state || !*state)
      return;
    HeldStates::all().free(*state);
    *state = nullptr;
  });
}

template <class S> S size_of_state(void* instance, void* state, std::size_t* size) {
  return call<S>(instance, [&](Instance&) {
    require_place(size);
    *size = state_of(state).bytes().size();
  });
}

template <class S> S write_state(void* instance, void* state, void* out, std::size_t size) {
  return call<S>(instance, [&](Instance&) {
    const std::string bytes = state_of(state).bytes();
    require_place(out);
    if (size < bytes.size())
      throw CaseError("the state needs " + std::to_string(bytes.size()) + " bytes of room, not " +
                      std::to_string(size));
    std::memcpy(out, bytes.data(), bytes.size());
  });
}

template <class S> S read_state(void* instance, const void* bytes, std::size_t size, void** state) {
  return call<S>(instance, [&](Instance&) {
    require_place(bytes);
    require_place(state);
    const std::string text(static_cast<const char*>(bytes), size);
    *state = HeldStates::all().add(Component::State::from_bytes(text));
  });
}

} // namespace hydrodae::fmi
