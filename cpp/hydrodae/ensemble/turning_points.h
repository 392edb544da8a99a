#pragma once
/// The turning points of a series that comes value by value.

#include <vector>

namespace hydrodae::ensemble {

class TurningPoints {
public:
  /// The next value, at a later time [s].
  void take(double t, double value) {
    if (times.size() >= 2 && (value - values.back()) * direction() >= 0.0) {
      times.back() = t; // on in the same direction
      values.back() = value;
      return;
    }
    if (times.size() == 1 && value == values.back())
      return;
    times.push_back(t);
    values.push_back(value);
  }

  /// The first value, turning points, and the last value.
  std::vector<double> times, values;

private:
  double direction() const { return values.back() - values[values.size() - 2]; }
};

} // namespace hydrodae::ensemble
