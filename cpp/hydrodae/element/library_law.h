#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"
#include "hydrodae/element/plugin.h"

namespace hydrodae::element {

/// Common part of forces of type library_load and library_wrench.
struct LibraryLaw {
  std::string name;
  std::string law; ///< name of the law in the library
  std::vector<double> parameters;
  /// Function of the law, set by the loader, which keeps the library loaded
  const hydrodae_law* found = nullptr;
};

/// Laws of shared libraries with one port and an equal number of states. Derivatives come from the
/// library, or from central differences with a step of 6e-6 (error 1e-10 for a smooth law).
std::shared_ptr<const Elements> list_of_library(Port port, std::string_view type,
                                                const std::vector<const LibraryLaw*>& laws);

template <class F> std::shared_ptr<const Elements> list_of(const std::vector<F>& forces) {
  std::vector<const LibraryLaw*> laws(forces.size());
  for (std::size_t k = 0; k < forces.size(); ++k)
    laws[k] = &forces[k];
  return list_of_library(F::port, F::type, laws);
}

/// Load along a joint by a law of a shared library.
struct LibraryLoad : LibraryLaw {
  static constexpr std::string_view type = "library_load";
  static constexpr std::string_view doc =
      "Load along a joint by a law of a shared library, which is given to the run.";
  static constexpr Port port = Port::along_joint;
  std::string joint;
  std::optional<std::string> coordinate;

  static std::shared_ptr<const Elements> list(const std::vector<LibraryLoad>& forces) {
    return list_of(forces);
  }
  std::size_t shape() const { return found ? static_cast<std::size_t>(found->n_states) : 0; }

  template <class L = LibraryLoad> static Fields<L> fields() {
    return {
        {"name", &L::name, "-", "Name of this force in the results.", true},
        {"joint", &L::joint, "-", "Joint along which it acts.", true},
        {"coordinate", &L::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
        {"law", &L::law, "-", "Name of the law in its library.", true},
        {"parameters", &L::parameters, "as the law says", "Numbers that the law takes."},
    };
  }
};

/// Force and moment on a body by a law of a shared library.
struct LibraryWrench : LibraryLaw {
  static constexpr std::string_view type = "library_wrench";
  static constexpr std::string_view doc =
      "Force and moment on a body by a law of a shared library, which is given to the run.";
  static constexpr Port port = Port::on_body;
  std::string body;

  static std::shared_ptr<const Elements> list(const std::vector<LibraryWrench>& forces) {
    return list_of(forces);
  }
  std::size_t shape() const { return found ? static_cast<std::size_t>(found->n_states) : 0; }

  template <class L = LibraryWrench> static Fields<L> fields() {
    return {
        {"name", &L::name, "-", "Name of this force in the results.", true},
        {"body", &L::body, "-", "Body that is loaded.", true},
        {"law", &L::law, "-", "Name of the law in its library.", true},
        {"parameters", &L::parameters, "as the law says", "Numbers that the law takes."},
    };
  }
};

} // namespace hydrodae::element
