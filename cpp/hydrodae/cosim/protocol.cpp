#include "hydrodae/cosim/protocol.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "hydrodae/core/text.h"
#include "hydrodae/cosim/foreign_text.h"
#include "hydrodae/cosim/json.h"

namespace hydrodae::cosim {

static_assert(std::endian::native == std::endian::little, "frames are little-endian");

void require_finite(std::span<const double> values) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!std::isfinite(values[k]))
      throw Error("the other program has answered " + number_text(values[k]) + " for output " +
                  std::to_string(k + 1));
}

namespace {

constexpr std::size_t longest_text = 65536;

/// Bytes behind the field `length` of a frame before its values.
struct Head {
  std::uint32_t length = 0, kind = 0;
  std::uint64_t sequence = 0;
  double time = 0.0;
};
constexpr std::size_t head_size = 24, behind_length = 20;
static_assert(sizeof(Head) == head_size);

enum Kind : std::uint32_t { values = 1, reset_values = 2, close_run = 3, error_text = 4 };

std::string terminals_text(const std::vector<control::Terminal>& terminals) {
  std::vector<std::string> parts;
  for (const control::Terminal& t : terminals) {
    char start[40];
    std::snprintf(start, sizeof start, "%.17g", t.start);
    parts.push_back("{\"name\": " + cosim::quoted(t.name) + ", \"unit\": " + cosim::quoted(t.unit) +
                    ", \"start\": " + start + "}");
  }
  return "[" + joined(parts) + "]";
}

class Numbered final : public Protocol {
public:
  PeerUnits greet(Socket& socket, const Subject& subject, const control::Terminals& terminals,
                  double t, double timeout) override {
    const auto number = [](double x) {
      char text[40];
      std::snprintf(text, sizeof text, "%.17g", x);
      return std::string(text);
    };
    const std::string hello =
        "{\"protocol\": \"hydrodae\", \"version\": 1, \"program\": \"hydrodae " HYDRODAE_VERSION
        "\", \"title\": " +
        cosim::quoted(subject.title) + ", \"controller\": " + cosim::quoted(subject.controller) +
        ", \"period\": " + number(subject.period) + ", \"delay\": " + number(subject.delay) +
        ", \"time\": " + number(t) + ", \"end_time\": " + number(terminals.end_time) +
        ", \"inputs\": " + terminals_text(terminals.inputs) +
        ", \"outputs\": " + terminals_text(terminals.outputs) + "}";
    const auto length = static_cast<std::uint32_t>(hello.size());
    std::string bytes(reinterpret_cast<const char*>(&length), sizeof length);
    bytes += hello;
    socket.send(bytes.data(), bytes.size(), timeout);
    return hear(socket, timeout);
  }

  void exchange(Socket& socket, double t, bool reset, std::span<const double> in,
                std::span<double> out, double timeout) override {
    ++sequence_;
    send(socket, reset ? reset_values : values, t, in.data(), 8 * in.size(), timeout);
    Head head;
    socket.receive(&head, head_size, timeout);
    if (head.kind == close_run || head.kind == error_text)
      hear_last_words(socket, head, timeout);
    if (head.kind != values)
      throw Error("the other program has sent a frame of kind " + std::to_string(head.kind) +
                  "; expected 1 (values)");
    if (head.length != behind_length + 8 * out.size())
      throw Error("the other program has sent a frame of length " + std::to_string(head.length) +
                  "; expected " + std::to_string(behind_length + 8 * out.size()) + " for " +
                  std::to_string(out.size()) + " outputs");
    if (head.sequence != sequence_)
      throw Error("the other program has sent frame " + std::to_string(head.sequence) +
                  "; expected frame " + std::to_string(sequence_));
    if (std::bit_cast<std::uint64_t>(head.time) != std::bit_cast<std::uint64_t>(t))
      throw Error("the other program has answered for t = " + number_text(head.time) +
                  " s; expected " + number_text(t) + " s");
    answer_.resize(out.size());
    socket.receive(answer_.data(), 8 * out.size(), timeout);
    if (socket.has_more())
      throw Error("the other program has sent more than one frame");
    require_finite(answer_);
    std::copy(answer_.begin(), answer_.end(), out.begin());
  }

  void leave(Socket& socket, double t, std::size_t, const std::string& error,
             double timeout) override {
    ++sequence_;
    send(socket, error.empty() ? close_run : error_text, t, error.data(),
         std::min(error.size(), longest_text), timeout);
  }

private:
  void send(Socket& socket, Kind kind, double t, const void* rest, std::size_t size,
            double timeout) {
    const Head head{static_cast<std::uint32_t>(behind_length + size), kind, sequence_, t};
    frame_.resize(head_size + size);
    std::memcpy(frame_.data(), &head, head_size);
    if (size > 0)
      std::memcpy(frame_.data() + head_size, rest, size);
    socket.send(frame_.data(), frame_.size(), timeout);
  }

  /// The answer to the handshake.
  static PeerUnits hear(Socket& socket, double timeout) {
    std::uint32_t length = 0;
    socket.receive(&length, sizeof length, timeout);
    if (length > longest_text)
      throw Error("the other program does not speak the protocol: its handshake has " +
                  std::to_string(length) + " bytes, more than " + std::to_string(longest_text));
    std::string text(length, '\0');
    socket.receive(text.data(), length, timeout);
    auto said = read_flat(text);
    if (said["protocol"] != "hydrodae")
      throw Error("the other program speaks the protocol " +
                  in_quotes(foreign_text(said["protocol"])) + "; expected 'hydrodae'");
    if (said["version"] != "1")
      throw Error("the other program speaks version " + in_quotes(foreign_text(said["version"])) +
                  " of the protocol; expected 1");
    return {said["input_units"], said["output_units"]};
  }

  [[noreturn]] static void hear_last_words(Socket& socket, const Head& head, double timeout) {
    if (head.length < behind_length || head.length > behind_length + longest_text)
      throw Error("the other program has sent a frame of length " + std::to_string(head.length));
    std::string text(head.length - behind_length, '\0');
    socket.receive(text.data(), text.size(), timeout);
    if (head.kind == error_text)
      throw Error("the other program has stopped: " + foreign_text(text));
    throw control::Stopped("the other program has ended the run");
  }

  std::uint64_t sequence_ = 0;
  std::vector<char> frame_;
  std::vector<double> answer_;
};

class Bare final : public Protocol {
public:
  PeerUnits greet(Socket&, const Subject&, const control::Terminals&, double, double) override {
    return {};
  }

  void exchange(Socket& socket, double t, bool reset, std::span<const double> in,
                std::span<double> out, double timeout) override {
    answer_.resize(out.size() + 1);
    // Nothing numbers an answer: one too many would be taken for that of the next question.
    if (!socket.has_unasked()) {
      send(socket, t, in, reset ? Flag::reset : Flag::neutral, timeout);
      socket.receive(answer_.data(), 8 * answer_.size(), timeout);
    }
    if (socket.has_unasked())
      throw Error("the other program has sent more than " + std::to_string(answer_.size()) +
                  " numbers (" + std::to_string(out.size()) + " outputs and a flag)");
    const double flag = answer_.back();
    if (flag == as_double(Flag::close))
      throw control::Stopped("the other program has ended the run");
    if (flag == as_double(Flag::error))
      throw Error("the other program has reported an error (flag 2)");
    if (flag != as_double(Flag::neutral))
      throw Error("the other program has sent the flag " + number_text(flag) +
                  "; expected 0 (neutral), 2 (error) or 3 (close)");
    require_finite(std::span(answer_).first(out.size()));
    std::copy_n(answer_.begin(), out.size(), out.begin());
  }

  void leave(Socket& socket, double t, std::size_t n_in, const std::string& error,
             double timeout) override {
    const std::vector<double> nothing(n_in, 0.0);
    send(socket, t, nothing, error.empty() ? Flag::close : Flag::error, timeout);
  }

private:
  enum class Flag { neutral = 0, reset = 1, error = 2, close = 3 };
  static double as_double(Flag flag) { return static_cast<double>(flag); }

  void send(Socket& socket, double t, std::span<const double> in, Flag flag, double timeout) {
    frame_.assign(1, t);
    frame_.insert(frame_.end(), in.begin(), in.end());
    frame_.push_back(as_double(flag));
    socket.send(frame_.data(), 8 * frame_.size(), timeout);
  }

  std::vector<double> frame_, answer_;
};

} // namespace

std::unique_ptr<Protocol> make_hydrodae_protocol() { return std::make_unique<Numbered>(); }

std::unique_ptr<Protocol> make_hotint_protocol() { return std::make_unique<Bare>(); }

} // namespace hydrodae::cosim
