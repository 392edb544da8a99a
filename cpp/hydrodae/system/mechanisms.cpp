#include "hydrodae/system/mechanisms.h"

#include <algorithm>
#include <numeric>

#include "hydrodae/system/declare.h"

namespace hydrodae::system {

namespace {

/// Disjoint sets of bodies.
class Sets {
public:
  explicit Sets(const System& s) : s_(s), root_(s.bodies.size()) {
    std::iota(root_.begin(), root_.end(), 0);
  }
  void join(int a, int b) {
    if (moves(a) && moves(b))
      root_[static_cast<std::size_t>(find(a))] = find(b);
  }
  void join(const JointData& j) { join(j.A.body, j.B.body); }
  int find(int i) {
    while (root_[static_cast<std::size_t>(i)] != i)
      i = root_[static_cast<std::size_t>(i)];
    return i;
  }
  bool moves(int body) const {
    return body >= 0 && s_.bodies[static_cast<std::size_t>(body)].n_active > 0;
  }
  /// Numbers the sets of moving bodies; other bodies get -1.
  int number(System& s, int BodyData::* which) {
    std::vector<int> numbers(root_.size(), -1);
    int count = 0;
    for (int i = 0; i < static_cast<int>(root_.size()); ++i) {
      int& number = numbers[static_cast<std::size_t>(find(i))];
      if (moves(i) && number < 0)
        number = count++;
      s.bodies[static_cast<std::size_t>(i)].*which = moves(i) ? number : -1;
    }
    return count;
  }

private:
  const System& s_;
  std::vector<int> root_;
};

} // namespace

const JointData& joint_of(const System& s, int motion) {
  return s.joints[static_cast<std::size_t>(s.motions[static_cast<std::size_t>(motion)].joint)];
}

const JointData& joint_of(const System& s, const CouplerData& coupler) {
  return joint_of(s, coupler.terms.front().motion);
}

const BodyData* moving_body(const System& s, const JointData& j) {
  for (int body : {j.B.body, j.A.body})
    if (body >= 0 && s.bodies[static_cast<std::size_t>(body)].n_active > 0)
      return &s.bodies[static_cast<std::size_t>(body)];
  return nullptr;
}

const BodyData* moving_body(const System& s, const PortData& port) {
  const BodyData* last = nullptr;
  for_each_body(s, port, [&](int body) {
    if (body >= 0 && s.bodies[static_cast<std::size_t>(body)].n_active > 0)
      last = &s.bodies[static_cast<std::size_t>(body)];
  });
  return last;
}

void find_mechanisms(System& s) {
  Sets sets(s);
  for (const JointData& j : s.joints)
    if (!j.rows.empty())
      sets.join(j);
  for (const CouplerData& c : s.couplers) { // all couplers, those of switches included
    int first = -1;
    for (const CouplerData::Term& term : c.terms) {
      const JointData& j = joint_of(s, term.motion);
      sets.join(j);
      for (int body : {j.A.body, j.B.body}) {
        if (sets.moves(body) && sets.moves(first))
          sets.join(first, body);
        if (sets.moves(body))
          first = body;
      }
    }
  }
  s.n_mechanisms = sets.number(s, &BodyData::mechanism);
  for (const auto& [a, b] : declare(s).pairs)
    sets.join(a, b);
  s.n_groups = sets.number(s, &BodyData::group);
}

bool has_idle_reactions(const Regime& s) {
  return s.switches.empty() &&
         std::none_of(s.couplers.begin(), s.couplers.end(),
                      [](const CouplerData& c) {
                        return c.velocity_level || c.drive.moves() || c.drive.rate != 0.0;
                      }) &&
         std::none_of(s.elements.begin(), s.elements.end(),
                      [](const ElementList& list) { return list.laws->shape.n_reaction > 0; }) &&
         std::find(s.algebraic.begin() + s.z0, s.algebraic.begin() + s.memory0, true) ==
             s.algebraic.begin() + s.memory0;
}

void set_groups(System& s) {
  s.blocks.clear();
  s.group.assign(static_cast<std::size_t>(s.lambda0), 0);
  for (const BodyData& b : s.bodies) {
    for (Index k = 0; k < b.n_position; ++k)
      s.group[static_cast<std::size_t>(b.q0 + k)] = b.group;
    for (Index k = 0; k < b.n_active; ++k)
      s.group[static_cast<std::size_t>(b.u0 + k)] = b.group;
  }
  for (const StateBlock& block : s.states)
    std::fill_n(s.group.begin() + block.first, block.unknowns.size(),
                block.body < 0 ? 0 : s.bodies[static_cast<std::size_t>(block.body)].group);
  s.error_group = s.group;
  int n = s.n_groups;
  for (const StateBlock& block : s.states)
    if (!block.unknowns.empty() && block.unknowns.front().absolute)
      std::fill_n(s.error_group.begin() + block.first, block.unknowns.size(), n++);
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    s.blocks.push_back(
        {s.bodies[i].name, static_cast<int>(i), -1, s.bodies[i].group, s.bodies[i].n_active > 0});
  for (std::size_t i = 0; i < s.states.size(); ++i)
    if (const StateBlock& block = s.states[i]; !block.unknowns.empty())
      s.blocks.push_back({block.path, -1, static_cast<int>(i),
                          s.error_group[static_cast<std::size_t>(block.first)],
                          block.unknowns.front().length > 0.0});
  s.group_size = VectorX::Zero(n);
  for (const int group : s.error_group)
    ++s.group_size[group];
}

std::vector<bool> guided_mechanisms(const Regime& s) {
  std::vector<Index> left(static_cast<std::size_t>(std::max(s.n_mechanisms, 1)));
  for (const BodyData& b : s.bodies)
    if (b.mechanism >= 0)
      left[static_cast<std::size_t>(b.mechanism)] += b.n_active;
  const auto take = [&](const JointData& j) {
    if (const BodyData* body = moving_body(s, j))
      --left[static_cast<std::size_t>(body->mechanism)];
  };
  for (const JointData& j : s.joints)
    for (const RowData& row : j.rows)
      if (s.holds(row))
        take(j);
  for (const CouplerData& c : s.couplers)
    if (s.holds(c))
      take(joint_of(s, c));
  std::vector<bool> out;
  for (Index free : left)
    out.push_back(free <= 0);
  return out;
}

} // namespace hydrodae::system
