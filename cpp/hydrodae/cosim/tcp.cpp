#include "hydrodae/cosim/tcp.h"

#include <algorithm>
#include <optional>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/cosim/protocol.h"

namespace hydrodae::cosim {

namespace {

class TcpLaw final : public control::Law {
public:
  TcpLaw(const model::Controller& c, const std::string& title, control::Terminals terminals)
      : subject_{title, c.name, c.period, c.delay}, terminals_(std::move(terminals)), host_(c.host),
        port_(c.port), serves_(c.role != "client"), timeout_(c.timeout),
        connect_timeout_(c.connect_timeout),
        protocol_(c.protocol == "hotint" ? make_hotint_protocol() : make_hydrodae_protocol()) {
    try {
      if (serves_)
        listener_.emplace(host_, port_);
    } catch (const Error& error) {
      throw ModelError("controller." + c.name + ".port",
                       "controller " + in_quotes(c.name) + ": " + error.what());
    }
  }
  TcpLaw(const TcpLaw&) = delete;
  TcpLaw& operator=(const TcpLaw&) = delete;
  ~TcpLaw() override { leave("the run has ended early"); }

  void sample(double t, std::span<const double> in, std::span<double> out) override {
    try {
      if (!socket_.open())
        meet(t);
      t_ = t;
      protocol_->exchange(socket_, t, reset_, in, out, timeout_);
      reset_ = false;
    } catch (const Interrupted& error) {
      throw control::Stopped(error.what());
    } catch (const control::Stopped& stopped) {
      socket_.close();
      throw control::Stopped("controller " + in_quotes(subject_.controller) + ": " +
                             stopped.what());
    } catch (const Error& error) {
      const std::string told = "controller " + in_quotes(subject_.controller) + ": " + error.what();
      leave(told); // and listens on, as `restore` may go on with another connection
      throw SolverError(t, "stopped at t = " + number_text(t) + " s: " + told);
    }
  }

  /// Also at the time of the last exchange, which then is made once more.
  void restored(double) override { reset_ = socket_.open(); }

  /// The port is free from now on.
  void finish(const std::string& error) override {
    leave(error);
    listener_.reset();
  }

private:
  /// Whether the other program hears it or not.
  void leave(const std::string& error) {
    if (!socket_.open())
      return;
    try {
      constexpr double longest = 1.0;
      protocol_->leave(socket_, t_, terminals_.inputs.size(), error, std::min(timeout_, longest));
    } catch (const Error&) {
    }
    socket_.close();
  }

  void meet(double t) {
    if (serves_ && !listener_) // a run that was closed goes on
      listener_.emplace(host_, port_);
    socket_ = listener_ ? listener_->accept(connect_timeout_)
                        : Socket::connect(host_, port_, connect_timeout_);
    protocol_->greet(socket_, subject_, terminals_, t, timeout_);
  }

  Subject subject_;
  control::Terminals terminals_;
  std::string host_;
  int port_;
  bool serves_;                      ///< it listens; else it connects
  double timeout_, connect_timeout_; ///< [s]
  std::unique_ptr<Protocol> protocol_;
  std::optional<Listener> listener_; ///< of a server, until the run ends
  Socket socket_;                    ///< closed before the first sampling instant
  double t_ = 0.0;                   ///< of the last exchange [s]
  bool reset_ = false;
};

} // namespace

void join_tcp(model::Scene& scene) {
  for (model::Controller& c : scene.controllers)
    if (c.type == "tcp")
      c.make = [c, title = scene.title](const control::Terminals& terminals) {
        return std::make_unique<TcpLaw>(c, title, terminals);
      };
}

} // namespace hydrodae::cosim
