#include "hydrodae/element/library_law.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::element {

namespace {

class LibraryList final : public Elements {
public:
  LibraryList(Port port, std::string_view of_type, const std::vector<const LibraryLaw*>& laws) {
    const int states = laws.front()->found->n_states;
    type = of_type;
    shape = {port, width(port), states};
    timed = true;
    for (const LibraryLaw* law : laws) {
      laws_.push_back({law->found, law->parameters});
      names.push_back(law->name);
      for (int k = 0; k < states; ++k) {
        const hydrodae_state& z = law->found->states[k];
        unknowns.push_back({z.name, z.unit, z.scale, z.start});
      }
    }
  }

  void evaluate(double t, const double* in, const double*, double* out) const override {
    for (const Law& law : laws_) {
      call(law, t, in, out);
      in += shape.n_in();
      out += shape.n_out();
    }
  }

  void evaluate(double t, const Dual* in, const double*, Dual* out) const override {
    const int n = shape.n_in(), m = shape.n_out();
    std::vector<double> x(static_cast<std::size_t>(n)), y(static_cast<std::size_t>(m)),
        J(static_cast<std::size_t>(n * m));
    for (const Law& law : laws_) {
      for (int k = 0; k < n; ++k)
        x[static_cast<std::size_t>(k)] = in[k].a;
      call(law, t, x.data(), y.data());
      differentiate(law, t, x.data(), J.data());
      for (int i = 0; i < m; ++i) {
        out[i] = y[static_cast<std::size_t>(i)];
        for (int k = 0; k < n; ++k)
          out[i].b += J[static_cast<std::size_t>(k * m + i)] * in[k].b;
      }
      in += n;
      out += m;
    }
  }

  void jacobian(double t, const double* in, const double*, double* J) const override {
    for (const Law& law : laws_) {
      differentiate(law, t, in, J);
      in += shape.n_in();
      J += shape.n_in() * shape.n_out();
    }
  }

  void energy(const double*, const double*, double* joules) const override {
    std::fill_n(joules, laws_.size(), 0.0);
  }
  void observe(double, const double*, const double*, const double*, double*) const override {}
  bool lost_at_rest(std::size_t) const override { return false; }

private:
  struct Law {
    const hydrodae_law* found;
    std::vector<double> parameters;
  };
  /// Largest number of outputs for differences, on the stack
  static constexpr int most_out = 6 + 64;

  void call(const Law& law, double t, const double* in, double* out) const {
    const int w = shape.width;
    law.found->evaluate(t, in, in + w, in + 2 * w, law.parameters.data(), out, out + w);
  }

  /// d (load, z') / d (x, v, z), column by column.
  void differentiate(const Law& law, double t, const double* in, double* J) const {
    constexpr double part = 6e-6, least = 1e-4;
    const int w = shape.width, n = shape.n_in(), m = shape.n_out();
    if (law.found->jacobian)
      return law.found->jacobian(t, in, in + w, in + 2 * w, law.parameters.data(), J);
    double x[2 * 6 + 64], before[most_out], after[most_out];
    std::copy(in, in + n, x);
    for (int k = 0; k < n; ++k) {
      const double size = k < 2 * w ? least : unknowns[static_cast<std::size_t>(k - 2 * w)].scale;
      const double at = x[k], h = part * std::max(std::abs(at), size);
      x[k] = at - h;
      call(law, t, x, before);
      x[k] = at + h;
      call(law, t, x, after);
      x[k] = at;
      for (int i = 0; i < m; ++i)
        J[k * m + i] = (after[i] - before[i]) / (2.0 * h);
    }
  }

  std::vector<Law> laws_;
};

} // namespace

std::shared_ptr<const Elements> list_of_library(Port port, std::string_view type,
                                                const std::vector<const LibraryLaw*>& laws) {
  return std::make_shared<const LibraryList>(port, type, laws);
}

} // namespace hydrodae::element
