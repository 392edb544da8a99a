// Laws of a user for the case beside it: a quadratic damper, and a damper behind a spring.
//
//   c++ -O2 -shared -fPIC -I ../../cpp/hydrodae/element brake.cpp -o brake.so
#include "plugin.h"

#include <cmath>

namespace {

// f = -c v |v|
void brake(double, const double*, const double* v, const double*, const double* parameters,
           double* load, double*) {
  *load = -parameters[0] * *v * std::abs(*v);
}

void brake_slope(double, const double*, const double* v, const double*, const double* parameters,
                 double* derivatives) {
  derivatives[0] = 0.0; // by s
  derivatives[1] = -2.0 * parameters[0] * std::abs(*v);
}

// A damper c in series with a spring k (Maxwell): f = -k z, z' = s' - k z / c
void maxwell(double, const double*, const double* v, const double* z, const double* parameters,
             double* load, double* z_dot) {
  const double k = parameters[0], c = parameters[1];
  *load = -k * *z;
  *z_dot = *v - k / c * *z;
}

const char* const brake_parameters[] = {"damping"};
const char* const maxwell_parameters[] = {"stiffness", "damping"};
const hydrodae_state stretch[] = {{"stretch", "m", 1e-3, 0.0}};

const hydrodae_law laws[] = {
    {"brake", 0, 1, brake_parameters, 0, nullptr, brake, brake_slope},
    {"maxwell", 0, 2, maxwell_parameters, 1, stretch, maxwell, nullptr},
};

} // namespace

HYDRODAE_PLUGIN(laws)
