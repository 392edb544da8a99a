/// Guard of rotation vectors beyond half a turn.
///
/// Up to 180 degrees a rotation is a vector, whatever its path. Beyond that the vector continues
/// (system/turning.h) while the rotation keeps its axis. A rotation at a small angle d from its
/// axis passes a full turn with a vector that swings round within d, which changes the motion by a
/// part d. The tolerance limits d.

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/run/guards.h"
#include "hydrodae/run/state.h"
#include "hydrodae/system/elements.h"

namespace hydrodae::run {

namespace {

/// Allowed error in units of the tolerance; a sound error test stays below
constexpr double borne = 100.0;

/// Guard that ends the run if a load follows a rotation vector that has no axis.
class TurnGuard final : public EndGuard {
public:
  TurnGuard(const system::Regime& s, double rtol)
      : s_(s), allowed_(borne * rtol), ws_(s), axes_(3 * s.system.rotations.size(), 0.0) {}

  void look(const StepEnd& step) override {
    const system::Turns& turns = step.turns;
    std::vector<bool> lost(s_.system.rotations.size());
    bool any = false;
    for (std::size_t r = 0; r < lost.size(); ++r)
      any = (lost[r] = leaves_axis(
                 Eigen::Map<const Vector3>(turns.value.data() + s_.motions.size() + 3 * r),
                 Eigen::Map<Vector3>(axes_.data() + 3 * r))) ||
            any;
    if (any)
      find(step, turns, lost);
  }
  void save(State& out) const override { out.guards.axes = axes_; }
  void set(const State& from) override { axes_ = from.guards.axes; }

private:
  /// Follows the axis up to half a turn. @returns whether the rotation has left it beyond that
  bool leaves_axis(const Vector3& vector, Eigen::Map<Vector3> axis) const {
    const double angle = vector.norm();
    if (angle <= pi || axis.isZero(0.0)) {
      axis = angle > 0.0 ? Vector3(vector / angle) : Vector3::Zero();
      return false;
    }
    const Vector3 least = (1.0 - 2.0 * pi * std::round(angle / (2.0 * pi)) / angle) * vector;
    return least.cross(axis).norm() > allowed_;
  }

  void find(const StepEnd& step, const system::Turns& turns, const std::vector<bool>& lost) {
    ws_.turns = turns;
    ws_.time = step.end;
    system::unpack<double>(s_, step.y.data(), step.yp.data(), ws_.bodies);
    for (const system::ElementList& list : s_.elements)
      for (std::size_t k = 0; k < list.ports.size(); ++k) {
        const int r = list.ports[k].followed;
        if (r >= 0 && lost[static_cast<std::size_t>(r)] && feels_rotation(list, k, step))
          fail(step.end, list, k);
      }
  }

  /// Returns whether the load of this law changes with the rotation.
  bool feels_rotation(const system::ElementList& list, std::size_t law, const StepEnd& step) {
    const element::Elements& laws = *list.laws;
    system::ElementScratch<double>& scratch = ws_.elements[system::index_of(s_, list)];
    system::gather<double>(s_, list, ws_, step.y.data(), scratch);
    std::vector<double> jacobian(laws.size() * laws.jacobian_size());
    laws.jacobian(step.end, scratch.in.data(), s_.held(list, step.end, scratch.held),
                  jacobian.data());
    const Eigen::Map<const MatrixX> of_law(jacobian.data() + law * laws.jacobian_size(),
                                           laws.shape.n_out(), laws.shape.n_columns());
    return !of_law.middleCols<3>(3).isZero(0.0);
  }

  [[noreturn]] void fail(double t, const system::ElementList& list, std::size_t law) const {
    const system::PortData& port = list.ports[law];
    std::vector<std::string> names;
    system::for_each_body(s_, port, [&](int body) {
      names.push_back(body < 0
                          ? "the ground"
                          : "body " + in_quotes(s_.bodies[static_cast<std::size_t>(body)].name));
    });
    const std::string who =
        names.size() == 1 ? names[0] + " has turned" : names[1] + " has turned against " + names[0];
    throw SolverError(
        t, {Reason::range,
            who +
                " by more than 180 deg about an axis that does not stay. Beyond that the "
                "rotation vector that " +
                std::string(list.laws->type) + " " + in_quotes(list.laws->names[law]) +
                " follows has no meaning; it counts turns about an axis of its own only (a hinge, "
                "or one free rotation)",
            "forces/" + list.laws->names[law]});
  }

  const system::Regime& s_;
  double allowed_; ///< largest angle to the axis [rad]
  system::Workspace<double> ws_;
  /// Axis of each rotation when it was last within half a turn; zero: none
  std::vector<double> axes_;
};

} // namespace

std::unique_ptr<EndGuard> make_turn_guard(const system::Regime& system,
                                          const SolverOptions& options) {
  for (const system::ElementList& list : system.elements)
    for (const system::PortData& port : list.ports)
      if (port.followed >= 0)
        return std::make_unique<TurnGuard>(system, options.rtol);
  return nullptr;
}

} // namespace hydrodae::run
