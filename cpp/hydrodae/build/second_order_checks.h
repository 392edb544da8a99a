#pragma once
/// What the loads of pairs of waves need of the tables and of the waves, and what is refused.

#include <string>
#include <vector>

#include "hydrodae/build/excitation_terms.h"
#include "hydrodae/build/pair_loads.h"
#include "hydrodae/build/parts.h"

namespace hydrodae::build {

inline const std::string second_order_key = "second_order.loads";

/// The waves that the tables cover, as a body meets them.
struct Met {
  VectorX omega, relative;    ///< frequency, heading relative to the body at yaw zero [rad]
  Eigen::VectorXcd amplitude; ///< at the body
};

Met met(const std::vector<sea::Component>& waves, const Meeting& body);

/// A load of the case with the table that it takes.
struct Load {
  std::string word;
  const hydro::SecondOrderTable* table;
  bool pairs() const { return word == "difference" || word == "sum"; }
};

/// The loads that the case names. Throws ModelError where the database has no table for one.
std::vector<Load> find_loads(const model::Scene& scene);

/// The waves whose frequencies all tables have. Throws ModelError where too much is lost.
std::vector<sea::Component> covered_waves(const model::Scene& scene, const Sea& sea,
                                          const std::vector<Load>& loads, system::System& s);

/// Refuses headings that a table lacks, and more waves than a table of pairs can hold.
void check_headings(const PairTable& table, const Load& load,
                    const std::vector<sea::Component>& waves, double yaw);

/// Notes waves against which a device is drifted.
void note_maruo(const PairTable& table, const Load& load, const Met& waves, double yaw,
                const std::string& body, system::System& s);

/// Notes where Newman's approximation stands for large differences of frequencies.
void note_newman(const PairTable& table, const Load& load, const Met& waves, double yaw,
                 const std::string& body, system::System& s);

} // namespace hydrodae::build
