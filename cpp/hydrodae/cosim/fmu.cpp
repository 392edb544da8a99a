#include "hydrodae/cosim/fmu.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "hydrodae/control/law.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/cosim/fmu_archive.h"
#include "hydrodae/cosim/fmu_slave.h"

namespace hydrodae::cosim {

namespace {

[[noreturn]] void refuse_key(const control::Fmu& c, const char* key, const std::string& why) {
  throw ModelError("controller." + c.name + "." + key,
                   "controller " + in_quotes(c.name) + ": " + why);
}

/// Variables of an FMU that a case uses.
struct Mapping {
  FmuDescription fmu;
  FmuGroups inputs, outputs, parameters;
  std::vector<unsigned> text_parameters;
  /// Conversions from its units to those of the terminals
  std::vector<Conversion> of_inputs, of_outputs;
  std::vector<std::string> unit_notes;

  /// @param terminals  what its inputs and outputs are joined to; null: not known yet
  explicit Mapping(const control::Fmu& c, const control::Terminals* terminals = nullptr) {
    const char* key = "file";
    const auto find = [&](const char* of, const std::vector<std::string>& names,
                          const char* causality, FmuGroups& out) {
      key = of;
      for (std::size_t k = 0; k < names.size(); ++k) {
        add(fmu.find(names[k], causality), k, out);
      }
    };
    const auto join = [&](const std::vector<std::string>& names, const char* causality,
                          const std::vector<control::Terminal>& to, std::vector<Conversion>& out) {
      for (std::size_t k = 0; k < names.size(); ++k) {
        const FmuVariable& v = fmu.find(names[k], causality);
        out.push_back(v.to(to[k].unit, to[k].name));
        tell(c, v, to[k], out.back());
      }
    };
    try {
      fmu = describe_fmu(c.path);
      find("fmu_inputs", c.fmu_inputs, "input", inputs);
      if (terminals)
        join(c.fmu_inputs, "input", terminals->inputs, of_inputs);
      find("fmu_outputs", c.fmu_outputs, "output", outputs);
      if (terminals)
        join(c.fmu_outputs, "output", terminals->outputs, of_outputs);
      find("parameters", c.parameters, "parameter", parameters);
      key = "parameter_values";
      for (const FmuGroup& group : parameters)
        for (std::size_t k = 0; k < group.places.size(); ++k)
          group.given(k, c.parameter_values);
      key = "text_parameters";
      for (const std::string& name : c.text_parameters)
        text_parameters.push_back(*fmu.find(name, "parameter", true).reference);
    } catch (const CaseError& error) {
      refuse_key(c, key, error.what());
    }
  }

  /// Notes that values are converted to other units, or that the meaning of a unit is unknown.
  void tell(const control::Fmu& c, const FmuVariable& v, const control::Terminal& to,
            const Conversion& by) {
    const std::string head = "controller " + in_quotes(c.name) + ": variable " + in_quotes(v.name) +
                             " of its FMU is in " + in_quotes(v.unit_name) + ", ";
    const bool known = v.unit || unit_of(v.unit_name) || v.unit_name == to.unit;
    if (!by.is_none())
      unit_notes.push_back(head + equation(v.unit_name, to.unit, by));
    else if (!v.unit_name.empty() && !known)
      unit_notes.push_back(head + "which it does not explain: taken for " + in_quotes(to.unit));
  }

  /// Adds a variable to the group of its type, as number k of the row.
  static void add(const FmuVariable& v, std::size_t k, FmuGroups& out) {
    const auto own =
        std::find_if(out.begin(), out.end(), [&](const auto& g) { return g.type == v.kind; });
    FmuGroup& group = own == out.end() ? out.emplace_back(FmuGroup{v.kind, {}, {}, {}}) : *own;
    group.references.push_back(*v.reference);
    group.places.push_back(k);
    group.names.push_back(v.name);
  }
};

std::string no_states(const std::string& name) {
  return "controller " + in_quotes(name) +
         ": its FMU cannot save and serialise its state, so that a run with it has no states and "
         "no checkpoints";
}

/// At each instant: a step from the last one with what was read there, then new inputs, then what
/// the FMU answers to these.
class FmuLaw final : public control::Law {
public:
  FmuLaw(const control::Fmu& c, const control::Terminals& terminals)
      : name_(c.name), values_(c.parameter_values), factors_(c.fmu_factors), texts_(c.text_values),
        end_time_(terminals.end_time), map_(c, &terminals) {
    try {
      files_.emplace(c.path, map_.fmu.binaries());
      library_.emplace((files_->folder() / map_.fmu.library()).string());
      const auto make = map_.fmu.version == 2 ? make_fmu2_slave : make_fmu3_slave;
      slave_ = make(map_.fmu, *library_, (files_->folder() / "resources").string(), c.name);
      set_parameters();
    } catch (const CaseError& error) {
      refuse_key(c, "file", c.path + ": " + error.what());
    }
  }
  FmuLaw(const FmuLaw&) = delete;
  FmuLaw& operator=(const FmuLaw&) = delete;
  ~FmuLaw() override { FmuLaw::finish(""); }

  void sample(double t, std::span<const double> in, std::span<double> out) override {
    try {
      if (!begun_)
        slave_->begin(t, end_time_);
      else if (t > t_ && slave_->step(t_, t - t_))
        throw control::Stopped("controller " + in_quotes(name_) + ": its FMU ends the run");
      t_ = t;
      in_.assign(in.begin(), in.end());
      for (std::size_t k = 0; k < in_.size(); ++k)
        in_[k] = map_.of_inputs[k].back(in_[k]);
      slave_->set(map_.inputs, in_);
      if (!begun_)
        slave_->enter();
      begun_ = true;
      slave_->get(map_.outputs, out);
      for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = map_.of_outputs[k].of(out[k]);
      for (std::size_t k = 0; k < factors_.size(); ++k)
        out[k] *= factors_[k];
    } catch (const CaseError& error) {
      throw SolverError(
          t, {Reason::controller,
              "controller " + in_quotes(name_) + ": " + map_.fmu.path + ": " + error.what(),
              "controllers/" + name_});
    }
  }

  std::string state() override {
    if (!map_.fmu.saves_states)
      throw CaseError(no_states(name_));
    const std::vector<char> own = begun_ ? slave_->save() : std::vector<char>();
    return to_bytes(State{begun_, t_, std::string(own.begin(), own.end())});
  }
  void set(const std::string& bytes) override {
    if (!map_.fmu.saves_states)
      throw CaseError(no_states(name_));
    const auto from = from_bytes<State>(bytes);
    if (from.begun)
      slave_->load({from.own.begin(), from.own.end()});
    else if (begun_) {
      slave_->reset();
      set_parameters();
    }
    begun_ = from.begun;
    t_ = from.t;
  }

  std::vector<std::string> unit_notes() const override { return map_.unit_notes; }

  void finish(const std::string&) override {
    if (!begun_)
      return;
    begun_ = false;
    try {
      slave_->terminate();
    } catch (const CaseError&) { // the run has ended, well or not
    }
  }

private:
  struct State {
    bool begun = false;
    double t = 0.0;  ///< [s]
    std::string own; ///< state of the FMU, as it serialises it
  };

  void set_parameters() {
    slave_->set(map_.parameters, values_);
    for (std::size_t k = 0; k < texts_.size(); ++k)
      slave_->set_text(map_.text_parameters[k], texts_[k]);
  }

  std::string name_;
  /// Values of the parameters; factors of the outputs, if any
  std::vector<double> values_, factors_;
  std::vector<std::string> texts_;
  std::vector<double> in_; ///< inputs in the units of the FMU
  double end_time_;        ///< [s]
  Mapping map_;
  std::optional<UnpackedFmu> files_;
  std::optional<FmuLibrary> library_;
  std::unique_ptr<FmuSlave> slave_; ///< goes before its library, and that before its file
  bool begun_ = false;
  double t_ = 0.0; ///< time of the FMU [s]
};

} // namespace

void join_fmus(model::Scene& scene) {
  for (model::Controller& c : scene.controllers)
    if (auto* fmu = c.as<control::Fmu>())
      fmu->make = [keys = *fmu](const control::Terminals& terminals) {
        return std::make_unique<FmuLaw>(keys, terminals);
      };
}

std::vector<std::string> check_fmu(const control::Fmu& c, const control::Terminals& terminals) {
  return Mapping(c, &terminals).unit_notes;
}

void require_fmu_states(const model::Scene& scene) {
  for (const model::Controller& c : scene.controllers)
    if (const auto* fmu = c.as<control::Fmu>(); fmu && !Mapping(*fmu).fmu.saves_states)
      throw CaseError(no_states(fmu->name));
}

} // namespace hydrodae::cosim
