#pragma once
/// What goes over a connection between a run and a controller that is another program: in lock-step
/// one frame there and one back. The bytes are described in docs/tcp.md.

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "hydrodae/control/law.h"
#include "hydrodae/cosim/socket.h"

namespace hydrodae::cosim {

/// Speaker, as the handshake states it.
struct Subject {
  std::string title, controller;
  double period = 0.0, delay = 0.0; ///< [s]
};

/// Units of the other program, "deg, deg/s"; empty: those that it was sent.
struct PeerUnits {
  std::string inputs, outputs;
};

class Protocol {
public:
  virtual ~Protocol() = default;

  /// Before the first exchange. Throws Error.
  /// @returns the units of the other program where it has others than those that it was sent
  virtual PeerUnits greet(Socket& socket, const Subject& subject,
                          const control::Terminals& terminals, double t, double timeout) = 0;

  /// One frame there and one back. Throws Error on anything but an answer, Stopped where the other
  /// program ends the run.
  /// @param reset  the run has gone to this time from another one than that of its last step
  virtual void exchange(Socket& socket, double t, bool reset, std::span<const double> in,
                        std::span<double> out, double timeout) = 0;

  /// The last frame; with the message of the error that ended the run, if any. Throws Error.
  virtual void leave(Socket& socket, double t, std::size_t n_in, const std::string& error,
                     double timeout) = 0;
};

/// A JSON handshake, then numbered frames.
std::unique_ptr<Protocol> make_hydrodae_protocol();

/// Doubles only: there [t, u1 ... un, flag], back [y1 ... ym, flag].
std::unique_ptr<Protocol> make_hotint_protocol();

/// Refuses answers that are no numbers. Throws Error.
void require_finite(std::span<const double> values);

} // namespace hydrodae::cosim
