#pragma once
/// TCP sockets with time limits, for POSIX systems.

#include <cstddef>
#include <string>
#include <vector>

#include "hydrodae/core/error.h"

namespace hydrodae::cosim {

/// A signal (Ctrl-C) came while a socket was waited for.
struct Interrupted : Error {
  using Error::Error;
};

/// A connection. What fails throws Error, and says how; after that it is closed.
class Socket {
public:
  Socket() = default;
  explicit Socket(int descriptor);
  Socket(Socket&& other) noexcept;
  Socket& operator=(Socket&& other) noexcept;
  ~Socket() { close(); }

  /// Tries until somebody listens at host:port, for `timeout` [s].
  static Socket connect(const std::string& host, int port, double timeout);

  bool open() const { return descriptor_ >= 0; }
  void close();

  /// Sends, or receives, exactly so many bytes within `timeout` [s].
  void send(const void* bytes, std::size_t count, double timeout);
  void receive(void* bytes, std::size_t count, double timeout);

  /// Returns whether the last call received unrequested bytes; without a call to the operating
  /// system.
  bool has_more() const { return begin_ < end_; }

  /// Returns whether any unrequested bytes have arrived.
  bool has_unasked() const;

private:
  void wait(short events, double deadline, double timeout, const char* what);
  void limit_receive(double timeout);
  [[noreturn]] void fail(const std::string& message);
  [[noreturn]] void fail_silent(const char* what, double timeout);

  int descriptor_ = -1;
  std::vector<char> buffer_;        ///< bytes received by one call
  std::size_t begin_ = 0, end_ = 0; ///< range of the bytes that are left
  double limit_ = 0.0;              ///< longest wait of a call [s]; 0: not set
};

/// A port that is listened at, for one connection at a time.
class Listener {
public:
  /// Throws Error where the address is invalid, or somebody else has the port.
  Listener(const std::string& host, int port);
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

  /// Accepts the next connection, within `timeout` [s].
  Socket accept(double timeout);

private:
  int descriptor_ = -1;
  std::string place_; ///< "127.0.0.1:50000"
};

} // namespace hydrodae::cosim
