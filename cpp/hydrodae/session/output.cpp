#include "hydrodae/session/output.h"

#include "hydrodae/core/text.h"

namespace hydrodae {

std::string lines_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines)
    text += line + "\n";
  return text;
}

io::Attributes header(const model::Scene& scene, const std::vector<std::string>& notes) {
  return {{"title", scene.title},
          {"case_text", scene.text},
          {"case_path", scene.path},
          {"case_overrides", lines_of(scene.overrides)},
          {"hydro_sha256", scene.database ? scene.files.front().sha256 : ""},
          {"input_files", model::text_of_files(scene.files)},
          {"version", std::string(version)},
          {"notes", lines_of(notes)}};
}

namespace {

void write_interval(const std::string& of, const std::optional<Interval>& interval,
                    io::Attributes& out) {
  if (!interval)
    return;
  out["mean_power_low" + of] = interval->low;
  out["mean_power_high" + of] = interval->high;
}

void write_power(const RunStatistics& s, io::Attributes& out) {
  if (s.sea_period > 0.0)
    out["sea_period"] = s.sea_period;
  double total = 0.0;
  for (std::size_t k = 0; k < s.mean_power.size(); ++k) {
    const auto& [name, power] = s.mean_power[k];
    out["mean_power_absorbed." + name] = power;
    if (k < s.mean_power_interval.size())
      write_interval("." + name, s.mean_power_interval[k], out);
    total += power;
  }
  if (s.end_time > s.mean_power_from)
    out["mean_power_from"] = s.mean_power_from;
  if (!s.mean_power.empty())
    out["mean_power_absorbed"] = total;
  write_interval("", s.total_power_interval, out);
  if (!s.interval_missing.empty())
    out["mean_power_interval_missing"] = s.interval_missing;
}

} // namespace

io::Attributes attributes(const RunStatistics& s) {
  io::Attributes out{{"steps", std::int64_t{s.steps}},
                     {"residual_calls", std::int64_t{s.residual_calls}},
                     {"jacobian_calls", std::int64_t{s.jacobian_calls}},
                     {"newton_iterations", std::int64_t{s.newton_iterations}},
                     {"error_test_failures", std::int64_t{s.error_test_failures}},
                     {"convergence_failures", std::int64_t{s.convergence_failures}},
                     {"events", std::int64_t{s.events}},
                     {"unknowns", std::int64_t{s.unknowns}},
                     {"nonzeros", std::int64_t{s.nonzeros}},
                     {"setup_time", s.setup_time},
                     {"solver_time", s.solver_time},
                     {"wall_time", s.wall_time},
                     {"end_time", s.end_time},
                     {"at_rest", std::int64_t{s.at_rest}}};
  out["accuracy"] = s.accuracy.how;
  out["accuracy_missing"] = s.accuracy.missing;
  if (const accuracy::MoverError* worst = s.accuracy.worst()) {
    out["estimated_error"] = worst->largest;
    out["estimated_error_of"] = worst->name;
    out["estimated_error_time"] = worst->when;
    out["estimated_until"] = s.accuracy.until;
  }
  write_power(s, out);
  for (const RunStatistics::ControllerCost& c : s.controllers) {
    out["controller_calls." + c.name] = std::int64_t{c.calls};
    out["controller_mean_time." + c.name] = c.mean_time;
  }
  return out;
}

io::Attributes attributes(const RunStatistics& s, const model::Scene& scene,
                          const run::Simulation& done) {
  io::Attributes out = attributes(s);
  out["relative_balance_error"] = done.relative_balance_error();
  out["energy_scale"] = done.energy_scale();
  out["method"] = scene.solver.method;
  out["rtol"] = scene.solver.rtol;
  return out;
}

void write_methods(const run::MethodChoice& choice, io::Attributes& out) {
  std::vector<std::string> methods, from, reasons;
  for (const run::MethodChoice::Part& part : choice.parts()) {
    methods.push_back(part.method);
    from.push_back(number_text(part.from));
    reasons.push_back(part.reason);
  }
  out["method_in_use"] = choice.method();
  if (!choice.chosen())
    return;
  out["methods"] = lines_of(methods);
  out["method_from"] = lines_of(from);
  out["method_reason"] = lines_of(reasons);
}

void write_accuracy(const accuracy::Estimate& estimate, io::ResultsFile& file) {
  for (const accuracy::MoverError& m : estimate.movers) {
    std::vector<double> values;
    for (std::size_t k = 0; k < estimate.time.size(); ++k)
      values.insert(values.end(), {estimate.time[k], m.error[k], m.part[k]});
    if (values.empty())
      continue;
    file.write_table("accuracy/" + m.name, 3, values,
                     {{"columns", std::string("time, error, part of the motion")},
                      {"unit", std::string("s, m, -")},
                      {"motion", m.motion},
                      {"reproducible_until", m.reproducible_until},
                      {"runs_part_at", m.parted},
                      {"description",
                       std::string("Estimated error of the motion: displacement, or turn times the "
                                   "lever of the body; and as a part of the largest motion of its "
                                   "mechanism. An infinite time means never.")}});
  }
}

void write_impacts(const run::Simulation& simulation, io::ResultsFile& file) {
  for (const run::ImpactOutput::Stop& stop : simulation.impacts().stops()) {
    const std::vector<events::Switching::Impact>& impacts =
        simulation.switching()->struck()[stop.index].impacts;
    if (impacts.empty())
      continue;
    std::vector<double> values;
    for (const events::Switching::Impact& i : impacts) {
      values.insert(values.end(), {i.time, i.impulse, i.energy_lost});
      if (stop.contact_time)
        values.push_back(stop.peak(i.impulse));
    }
    const std::string columns = "time, impulse, energy lost", unit = stop.angle ? "N m" : "N";
    file.write_table("impacts/" + stop.name, stop.contact_time ? 4 : 3, values,
                     {{"columns", stop.contact_time ? columns + ", peak force" : columns},
                      {"unit", "s, " + unit + " s, J" + (stop.contact_time ? ", " + unit : "")},
                      {"description", "The impacts on this stop, one a row."}});
  }
}

} // namespace hydrodae
