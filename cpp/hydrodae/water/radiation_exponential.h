#pragma once
/// Radiation by a fitted memory of exponentials:
///
///   F = C z,   z' = A_r z + B_r U
///
/// A_r holds one real number for each real pole, and a block of two states for each pair. For
/// bodies whose memory is blended over their pose, each state has a weight: F = C w(s) z.

#include "hydrodae/water/radiation_law.h"

namespace hydrodae::water {

struct ExponentialRadiation : RadiationLaw {
  static constexpr std::string_view type = "exponential", doc = "the fitted memory";
  static constexpr bool reads_fit = true;
  struct Keys {
    std::optional<std::string> fit;
  };
  template <class H> static Fields<H> keys() {
    return {{"fit", &H::fit, "-",
             "Name of the exponential fit; by default the one with the fewest states that covers "
             "the coordinates that move."}};
  }

  struct Block { ///< z' = a z + ..., or the pair (x + i y)' = (a + i b)(x + i y) + ...
    int state = 0;
    double a = 0.0, b = 0.0;
    bool pair = false;
    bool operator==(const Block&) const = default;
  };
  struct Input { ///< nonzero entry of B_r
    int state = 0, coordinate = 0;
    double value = 0.0;
    bool operator==(const Input&) const = default;
  };
  std::vector<Block> blocks;
  std::vector<Input> inputs;
  MatrixX output, output_all; ///< C (n_moving, n_states), (6 n_bodies, n_states)
  /// (n_states,) weight that multiplies the load of the state; -1: none
  std::vector<int> weight_of_state;
  bool blended = false;                    ///< true: some states have weights
  BlockMatrix input, product, product_all; ///< B_r, C and C of all coordinates
  struct Links {
    std::vector<int> states; ///< states that load this body
    std::vector<int> inputs; ///< entries of `inputs` that this body drives
  };
  std::vector<Links> links;   ///< (n_bodies,)
  std::vector<int> component; ///< (n_moving,) component of each entry of U

  std::vector<std::string> read(const RadiationSource& from, const Keys&, AddedMass& added);
  void link(const WetBodies& wet);
  void add_pose(const ExponentialRadiation& there, const WetBodies&, int, int weight,
                bool blends_memory) {
    if (blends_memory)
      append(there, weight);
  }
  void add_rest(const ExponentialRadiation& there) { append(there, -1); }
  MatrixX input_matrix() const; ///< B_r (n_states, n_moving)

  bool operator==(const ExponentialRadiation& other) const {
    return n_states() == other.n_states() && output.rows() == other.output.rows() &&
           blocks == other.blocks && inputs == other.inputs && output == other.output;
  }
  int n_states() const { return static_cast<int>(output.cols()); }
  int n_condensed() const { return n_states(); }
  std::vector<element::Unknown> unknowns(const VectorX& velocities) const;
  Index n_scratch(const WetBodies&) const { return blended ? n_states() : 0; }
  bool acts() const { return n_states() > 0; }

  template <class S> void add_loads(const WaterMotion<S>& m, S* force) const {
    product.add_product(weighted(m), force);
  }
  void add_all_loads(const WaterMotion<double>& m, double* force) const {
    product_all.add_product(weighted(m), force);
  }
  template <class S> void add_rates(const WaterMotion<S>& m, double factor, S* rates) const {
    const S* z = m.z;
    for (const Block& block : blocks) {
      const int k = block.state;
      const S a(factor * block.a), b(factor * block.b);
      if (block.pair) {
        rates[k] = rates[k] + a * z[k] - b * z[k + 1];
        rates[k + 1] = rates[k + 1] + a * z[k + 1] + b * z[k];
      } else {
        rates[k] += a * z[k];
      }
    }
    input.add_product(m.U, rates, factor);
  }

  void add_by_pose(const WaterMotion<double>& m, std::size_t i, Vector6& force) const;
  template <class Visit>
  void for_each_state_load(const WaterMotion<double>& m, std::size_t i, Visit&& visit) const {
    const HydroBody& hb = m.wet.bodies[i];
    for (const int z : links[i].states) {
      Vector6 column = hb.gather<double>(output.col(z).data());
      if (const int weight = weight_of_state[static_cast<std::size_t>(z)]; weight >= 0)
        column *= m.weights[weight];
      visit(z, column);
    }
  }
  template <class Visit> void for_each_rate_by_state(Visit&& visit) const {
    for (const Block& b : blocks) {
      const int k = b.state;
      visit(k, k, b.a);
      if (!b.pair)
        continue;
      visit(k + 1, k + 1, b.a);
      visit(k, k + 1, -b.b);
      visit(k + 1, k, b.b);
    }
  }
  template <class Visit> void for_each_drive(std::size_t i, Visit&& visit) const {
    for (const int number : links[i].inputs) {
      const Input& in = inputs[static_cast<std::size_t>(number)];
      visit(in.state, component[static_cast<std::size_t>(in.coordinate)], in.value);
    }
  }

private:
  void append(const ExponentialRadiation& from, int weight);
  /// States times their weights.
  template <class S> const S* weighted(const WaterMotion<S>& m) const {
    if (!blended)
      return m.z;
    for (int k = 0; k < n_states(); ++k) {
      const int weight = weight_of_state[static_cast<std::size_t>(k)];
      m.scratch[k] = weight < 0 ? m.z[k] : m.weights[weight] * m.z[k];
    }
    return m.scratch;
  }
};

} // namespace hydrodae::water
