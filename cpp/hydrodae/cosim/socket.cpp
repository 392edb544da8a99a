#include "hydrodae/cosim/socket.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include "hydrodae/core/text.h"

namespace hydrodae::cosim {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Waits for one of the events until `deadline`, at least once. @returns whether it came
bool wait_for(int descriptor, short events, double deadline) {
  for (;;) {
    pollfd waited{descriptor, events, 0};
    const double left = std::clamp(deadline - now(), 0.0, 1e6);
    const int found = poll(&waited, 1, static_cast<int>(std::ceil(1e3 * left)));
    if (found > 0)
      return true;
    if (found < 0 && errno == EINTR)
      throw Interrupted("interrupted while waiting for another program");
    if (found == 0 && left == 0.0)
      return false;
    if (found < 0)
      throw Error(std::strerror(errno));
  }
}

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

Addresses addresses(const std::string& host, int port, int flags) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = flags;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (error != 0)
    throw Error("host " + in_quotes(host) + ": " + gai_strerror(error));
  return {found, &freeaddrinfo};
}

std::string place(const std::string& host, int port) { return host + ":" + std::to_string(port); }

/// Frames are small and waited for: none is held back to be sent with the next one.
void prepare(int descriptor) {
  const int yes = 1;
  setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  fcntl(descriptor, F_SETFD, FD_CLOEXEC);
}

/// Sets whether calls block; they must not while connecting and accepting.
void set_waiting(int descriptor, bool waits) {
  const int flags = fcntl(descriptor, F_GETFL);
  fcntl(descriptor, F_SETFL, waits ? flags & ~O_NONBLOCK : flags | O_NONBLOCK);
}

} // namespace

Socket::Socket(int descriptor) : descriptor_(descriptor) {
  prepare(descriptor);
  set_waiting(descriptor, true);
}

Socket::Socket(Socket&& other) noexcept { *this = std::move(other); }

Socket& Socket::operator=(Socket&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(buffer_, other.buffer_);
  std::swap(begin_, other.begin_);
  std::swap(end_, other.end_);
  std::swap(limit_, other.limit_);
  return *this;
}

void Socket::close() {
  if (descriptor_ >= 0)
    ::close(std::exchange(descriptor_, -1));
  begin_ = end_ = 0;
  limit_ = 0.0;
}

void Socket::fail(const std::string& message) {
  close();
  throw Error(message);
}

void Socket::fail_silent(const char* what, double timeout) {
  fail("the other program " + std::string(what) + " for " + number_text(timeout) + " s (timeout)");
}

Socket Socket::connect(const std::string& host, int port, double timeout) {
  const Addresses found = addresses(host, port, 0);
  const double deadline = now() + timeout;
  for (;;) {
    for (const addrinfo* a = found.get(); a; a = a->ai_next) {
      const int descriptor = ::socket(a->ai_family, a->ai_socktype, a->ai_protocol);
      if (descriptor < 0)
        continue;
      Socket out(descriptor);
      set_waiting(descriptor, false);
      if (::connect(descriptor, a->ai_addr, a->ai_addrlen) != 0) {
        if (errno != EINPROGRESS || !wait_for(descriptor, POLLOUT, deadline))
          continue;
        int error = 0;
        socklen_t size = sizeof error;
        getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size);
        if (error != 0)
          continue;
      }
      set_waiting(descriptor, true);
      return out;
    }
    if (now() >= deadline)
      throw Error("nobody listens at " + place(host, port) + " (tried for " + number_text(timeout) +
                  " s)");
    if (poll(nullptr, 0, 50) < 0 && errno == EINTR)
      throw Interrupted("interrupted while waiting for another program");
  }
}

void Socket::wait(short events, double deadline, double timeout, const char* what) {
  bool ready = false;
  try {
    ready = wait_for(descriptor_, events, deadline);
  } catch (const Error&) {
    close();
    throw;
  }
  if (!ready)
    fail_silent(what, timeout);
}

void Socket::send(const void* bytes, std::size_t count, double timeout) {
  const double deadline = now() + timeout;
  for (const char* next = static_cast<const char*>(bytes); count > 0;) {
    const ssize_t sent = ::send(descriptor_, next, count, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      next += sent;
      count -= static_cast<std::size_t>(sent);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      wait(POLLOUT, deadline, timeout, "has taken nothing");
    } else if (errno != EINTR) {
      fail("the other program has closed the connection");
    }
  }
}

/// A call that waits by itself costs half of two calls: one that finds nothing, and another that
/// waits.
void Socket::limit_receive(double timeout) {
  if (timeout == limit_)
    return;
  constexpr double shortest = 1e-6, longest = 1e6; // s; 0 would be for ever
  const double kept = std::clamp(timeout, shortest, longest), whole = std::floor(kept);
  timeval told{};
  told.tv_sec = static_cast<decltype(told.tv_sec)>(whole);
  told.tv_usec = static_cast<decltype(told.tv_usec)>(1e6 * (kept - whole));
  if (told.tv_sec == 0 && told.tv_usec == 0)
    told.tv_usec = 1;
  if (setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &told, sizeof told) != 0)
    fail(std::strerror(errno));
  limit_ = timeout;
}

/// One call brings all that is there; frames are taken from that.
void Socket::receive(void* bytes, std::size_t count, double timeout) {
  constexpr std::size_t room = 65536;
  buffer_.resize(room);
  char* next = static_cast<char*>(bytes);
  const std::size_t all = count;
  double deadline = 0.0; // of what comes in parts
  for (;;) {
    const std::size_t taken = std::min(count, end_ - begin_);
    std::memcpy(next, buffer_.data() + begin_, taken);
    begin_ += taken;
    next += taken;
    count -= taken;
    if (count == 0)
      return;
    const char* what = count < all ? "has sent part of a frame only" : "has sent nothing";
    if (deadline == 0.0) {
      deadline = now() + timeout;
      limit_receive(timeout);
    } else {
      const double left = deadline - now();
      if (left <= 0.0)
        fail_silent(what, timeout);
      limit_receive(left);
    }
    const ssize_t got = ::recv(descriptor_, buffer_.data(), room, 0);
    begin_ = 0;
    end_ = got > 0 ? static_cast<std::size_t>(got) : 0;
    if (got > 0)
      continue;
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
      fail_silent(what, timeout);
    if (got < 0 && errno == EINTR) {
      close();
      throw Interrupted("interrupted while waiting for another program");
    }
    fail(count < all ? "the other program has closed the connection inside a frame"
                     : "the other program has closed the connection");
  }
}

bool Socket::has_unasked() const {
  char byte = 0;
  return has_more() || ::recv(descriptor_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) > 0;
}

Listener::Listener(const std::string& host, int port) : place_(place(host, port)) {
  const Addresses found = addresses(host, port, AI_PASSIVE);
  descriptor_ = ::socket(found->ai_family, found->ai_socktype, found->ai_protocol);
  if (descriptor_ < 0)
    throw Error("no socket: " + std::string(std::strerror(errno)));
  prepare(descriptor_);
  set_waiting(descriptor_, false);
  const int yes = 1;
  setsockopt(descriptor_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (bind(descriptor_, found->ai_addr, found->ai_addrlen) != 0 || listen(descriptor_, 1) != 0) {
    const std::string why = std::strerror(errno);
    ::close(std::exchange(descriptor_, -1));
    throw Error("cannot listen at " + place_ + ": " + why);
  }
}

Listener::~Listener() {
  if (descriptor_ >= 0)
    ::close(descriptor_);
}

Socket Listener::accept(double timeout) {
  if (!wait_for(descriptor_, POLLIN, now() + timeout))
    throw Error("nobody has connected to " + place_ + " for " + number_text(timeout) +
                " s (connect_timeout)");
  const int descriptor = ::accept(descriptor_, nullptr, nullptr);
  if (descriptor < 0)
    throw Error("the other program has closed the connection");
  return Socket(descriptor);
}

} // namespace hydrodae::cosim
