#include "hydrodae/cosim/tcp.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/cosim/foreign_text.h"
#include "hydrodae/cosim/protocol.h"

namespace hydrodae::cosim {

namespace {

class TcpLaw final : public control::Law {
public:
  TcpLaw(const control::Tcp& c, const std::string& title, control::Terminals terminals)
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
      in_.assign(in.begin(), in.end());
      for (std::size_t k = 0; k < in_.size(); ++k)
        in_[k] = of_inputs_[k].back(in_[k]);
      protocol_->exchange(socket_, t, reset_, in_, out, timeout_);
      for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = of_outputs_[k].of(out[k]);
      reset_ = false;
    } catch (const Interrupted& error) {
      throw control::Stopped(error.what());
    } catch (const control::Stopped& stopped) {
      socket_.close();
      throw control::Stopped("controller " + in_quotes(subject_.controller) + ": " +
                             stopped.what());
    } catch (const Error& error) {
      const std::string reason =
          "controller " + in_quotes(subject_.controller) + ": " + error.what();
      leave(reason); // and listens on, as `restore` may go on with another connection
      throw SolverError(t, {Reason::controller, reason, "controllers/" + subject_.controller});
    }
  }

  /// Also at the time of the last exchange, which then is made once more.
  void restored(double) override { reset_ = socket_.open(); }

  std::vector<std::string> unit_notes() const override { return unit_notes_; }

  /// The port is free from now on.
  void finish(const std::string& error) override {
    leave(error);
    listener_.reset();
  }

private:
  /// Sends the last frame, whether the other program receives it or not.
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
    const PeerUnits units = protocol_->greet(socket_, subject_, terminals_, t, timeout_);
    unit_notes_.clear();
    of_inputs_ = conversions("input", units.inputs, terminals_.inputs);
    of_outputs_ = conversions("output", units.outputs, terminals_.outputs);
  }

  /// Conversions from the units of the other program, "deg, deg/s", to those of the terminals.
  std::vector<Conversion> conversions(const std::string& what, const std::string& told,
                                      const std::vector<control::Terminal>& terminals) {
    std::vector<Conversion> out(terminals.size());
    if (told.empty())
      return out;
    std::vector<std::string> units;
    std::istringstream text(told);
    for (std::string unit; std::getline(text >> std::ws, unit, ',');)
      units.push_back(unit.substr(0, unit.find_last_not_of(' ') + 1));
    if (units.size() != out.size())
      throw Error("the other program states " + std::to_string(units.size()) + " units of its " +
                  what + "s (" + in_quotes(foreign_text(told)) + "), expected " +
                  std::to_string(out.size()));
    for (std::size_t k = 0; k < out.size(); ++k) {
      const control::Terminal& own = terminals[k];
      if (units[k] == own.unit)
        continue;
      const std::optional<Unit> from = unit_of(units[k]), to = unit_of(own.unit);
      const auto found = from && to ? conversion(*from, *to) : std::nullopt;
      if (!found)
        throw Error("the other program has " + what + " " + std::to_string(k + 1) + " in " +
                    in_quotes(foreign_text(units[k])) + ", which is no unit of " +
                    in_quotes(own.name) + ", in " + in_quotes(own.unit));
      out[k] = *found;
      if (!found->is_none())
        unit_notes_.push_back("controller " + in_quotes(subject_.controller) +
                              ": the other program has " + own.name + " in " + units[k] + ": " +
                              equation(units[k], own.unit, *found));
    }
    return out;
  }

  Subject subject_;
  control::Terminals terminals_;
  std::string host_;
  int port_;
  bool serves_;                      ///< true: listens; false: connects
  double timeout_, connect_timeout_; ///< [s]
  std::unique_ptr<Protocol> protocol_;
  std::optional<Listener> listener_; ///< listener of a server, until the run ends
  /// Conversions from its units to those of the terminals
  std::vector<Conversion> of_inputs_, of_outputs_;
  std::vector<std::string> unit_notes_;
  std::vector<double> in_; ///< inputs in its units
  Socket socket_;          ///< closed before the first sampling instant
  double t_ = 0.0;         ///< time of the last exchange [s]
  bool reset_ = false;
};

} // namespace

void join_tcp(model::Scene& scene) {
  for (model::Controller& c : scene.controllers)
    if (auto* tcp = c.as<control::Tcp>())
      tcp->make = [keys = *tcp, title = scene.title](const control::Terminals& terminals) {
        return std::make_unique<TcpLaw>(keys, title, terminals);
      };
}

} // namespace hydrodae::cosim
