#include "hydrodae/build/redundancy.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>

#include "hydrodae/build/closing.h"
#include "hydrodae/build/row_ranks.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/dropped_rows.h"
#include "hydrodae/system/retract.h"

namespace hydrodae::build {

namespace {

constexpr double dependent = 1e-9;  ///< pivot below which a row is redundant
constexpr double suspicious = 0.03; ///< pivot above which a row is independent
/// Ratio to the pivot before, below which a suspicious pivot stands out
constexpr double apart = 0.1;
constexpr int drive_samples = 64;
constexpr double stroke = 0.2; ///< trial motion of a body [arms, rad]

/// Trial motion of the bodies for one unit of each velocity [m, rad], (n_u,): by lengths of the
/// geometry only, because masses and units are arbitrary.
VectorX trial_scale(const system::System& s) {
  std::vector<double> arm(s.bodies.size(), INFINITY);
  for (const system::JointData& j : s.joints)
    for (int body : {j.A.body, j.B.body})
      if (body >= 0)
        arm[static_cast<std::size_t>(body)] =
            std::min(arm[static_cast<std::size_t>(body)], system::smaller_arm(s, j));
  VectorX out(s.n_u);
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const system::BodyData& b = s.bodies[i];
    for (int k = 0; k < b.n_active; ++k)
      out[b.u0 - s.u0 + k] = stroke * (b.active[k] >= 3        ? 1.0
                                       : std::isfinite(arm[i]) ? arm[i]
                                                               : b.arm);
  }
  return out;
}

/// Uniform random number in [-1, 1).
double draw(std::mt19937& random) { return 2.0 * (random() / 4294967296.0) - 1.0; }

/// Start, and up to four closed poses near it for each mechanism. A mechanism that closes in fewer
/// trials is at its start in the last ones.
std::vector<VectorX> poses_near(const system::Regime& s, const VectorX& start) {
  constexpr std::size_t most = 4;
  Constraints constraints(s);
  const VectorX scale = trial_scale(s);
  std::vector<VectorX> out(1 + most, start);
  std::vector<std::size_t> found(static_cast<std::size_t>(constraints.n_mechanisms()), 0);
  std::mt19937 random(7);
  const auto enough = [&](std::size_t count) { return count >= most; };
  for (int sample = 0; sample < 12 && !std::all_of(found.begin(), found.end(), enough); ++sample) {
    VectorX step(s.n_u), y = start;
    for (double& x : step)
      x = (sample < 8 ? 1.0 : 0.25) * draw(random);
    retract(s, step.cwiseProduct(scale), y);
    approach(s, constraints, y);
    const std::vector<bool> closed = closed_mechanisms(constraints, y);
    for (std::size_t m = 0; m < found.size(); ++m)
      if (closed[m] && found[m] < most)
        constraints.copy_mechanism(static_cast<Index>(m), y, out[++found[m]]);
  }
  return out;
}

/// Marks rows of the mask as omitted during its lifetime.
class LeftOut {
public:
  LeftOut(system::System& s, const system::Regime& rows, const Mask& mask) {
    system::for_each_row(s, [&](system::Row& row, bool) {
      const Index lambda = rows.lambda(row);
      if (lambda == system::redundant || !mask[static_cast<std::size_t>(lambda - s.lambda0)])
        return;
      row.dropped = true;
      rows_.push_back(&row);
    });
  }
  LeftOut(const LeftOut&) = delete;
  LeftOut& operator=(const LeftOut&) = delete;
  ~LeftOut() {
    for (system::Row* row : rows_)
      row->dropped = false;
  }

private:
  std::vector<system::Row*> rows_;
};

/// Rows of `asked` that are independent elsewhere, although their gradients nearly depend on the
/// others here: the pose is singular. The bodies move to and fro as the other rows allow. The gap
/// of a redundant row changes as little as its gradient predicts; that of a bar across a dead point
/// curves.
Mask curved_rows(system::System& s, const system::Regime& rows, const Mask& asked,
                 const Mask& left_out, const VectorX& start) {
  constexpr double noise = 10.0 * nearly_closed; // noise of gaps [arms, rad]
  constexpr double curved = 0.3;                 // ratio of second to first difference
  Mask out(asked.size(), false);
  const LeftOut without(s, rows, left_out);
  const system::Regime others(s);
  Constraints constraints(others), all(rows);
  const VectorX scale = trial_scale(s);
  std::mt19937 random(11);
  VectorX gaps[2], rates;
  const auto close_at = [&](VectorX& y, VectorX& gap) {
    const VectorX left = close_positions(s, constraints, y);
    VectorX full = y;
    system::resize(rows, full);
    all.evaluate(full, gap, rates);
    // Without their doubtful rows the bodies may form several mechanisms.
    std::vector<bool> open(static_cast<std::size_t>(all.n_mechanisms()), false);
    for (Index k = 0; k < s.n_u; ++k)
      if (!(left[constraints.owner(k)] < nearly_closed))
        open[static_cast<std::size_t>(all.owner(k))] = true;
    return open;
  };
  for (int sample = 0; sample < 4; ++sample) {
    VectorX step(s.n_u), there = start;
    for (double& x : step)
      x = draw(random);
    system::resize(others, there);
    VectorX back = there;
    retract(s, step.cwiseProduct(scale), there);
    const std::vector<bool> open_there = close_at(there, gaps[0]);
    // the same motion in the opposite direction
    back.head(s.n_q) = 2.0 * back.head(s.n_q) - there.head(s.n_q);
    system::normalise(s, back);
    const std::vector<bool> open_back = close_at(back, gaps[1]);
    // differences of the gaps [arms, rad]
    VectorX second = VectorX::Zero(all.n_rows()), first = second;
    for (Index i = 0; i < all.n_rows(); ++i)
      if (const auto m = static_cast<std::size_t>(all.mechanism(i));
          asked[static_cast<std::size_t>(i)] && !open_there[m] && !open_back[m]) {
        const double unit = all.size(i) / (all.is_angle(i) ? 1.0 : all.lever(i));
        second[i] = 0.5 * unit * std::abs(gaps[0][i] + gaps[1][i]);
        first[i] = 0.5 * unit * std::abs(gaps[0][i] - gaps[1][i]);
      }
    // A misaligned hinge opens e sin(turn) one way, and e (1 - cos(turn)) across it.
    const VectorX least = (curved * all.largest_row(first)).cwiseMax(noise);
    for (Index i = 0; i < all.n_rows(); ++i)
      if (second[i] > least[all.mechanism(i)])
        out[static_cast<std::size_t>(i)] = true;
  }
  return out;
}

/// Returns whether the drive moves its coordinate.
bool moves(const system::CouplerData& c) {
  const Drive& d = c.drive;
  return d.rate != 0.0 || d.amplitude != 0.0 || !d.time.empty() || d.python ||
         (c.velocity_level && d.constant != 0.0);
}

/// Largest k-th pivot over all poses.
std::vector<double> best_pivots(const std::vector<const Ranking*>& poses) {
  std::vector<double> out(poses.front()->rows.size(), 0.0);
  for (const Ranking* pose : poses)
    for (std::size_t k = 0; k < out.size(); ++k)
      out[k] = std::max(out[k], pose->rows[k].pivot);
  return out;
}

/// Pose for the choice of rows: the start, if its rows are as independent as elsewhere.
std::size_t best_pose(const std::vector<const Ranking*>& poses, std::size_t rank) {
  std::size_t best = 0;
  const auto last = [&](std::size_t pose) {
    return rank > 0 ? poses[pose]->rows[rank - 1].pivot : 1.0;
  };
  for (std::size_t pose = 0; pose < poses.size(); ++pose)
    if (last(pose) > 10.0 * last(best))
      best = pose;
  return best;
}

/// Coefficients of a row in terms of the rows `used`; rows are in units of their scales.
/// @param transposed  gradient (n_u, rows)
VectorX coefficients(const SparseMatrix& transposed, const std::vector<Index>& used, Index row) {
  SparseMatrix others(transposed.rows(), static_cast<Index>(used.size()));
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < used.size(); ++k)
    for (SparseMatrix::InnerIterator it(transposed, used[k]); it; ++it)
      entries.emplace_back(it.row(), static_cast<Index>(k), it.value());
  others.setFromTriplets(entries.begin(), entries.end());
  return smallest_solution(others, VectorX(transposed.col(row)));
}

/// Text "'upper', 'frame'": joints and constraints that a row nearly depends on.
std::string partners(const Constraints& constraints, const SparseMatrix& transposed,
                     const std::vector<Index>& used, Index row) {
  const VectorX c = coefficients(transposed, used, row);
  const double largest = c.size() > 0 ? c.cwiseAbs().maxCoeff() : 0.0;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (std::abs(c[static_cast<Index>(k)]) <= 0.05 * largest)
      continue;
    const std::string key = constraints.key(used[k]);
    const std::string name = in_quotes(key.substr(key.find('.') + 1));
    if (key != constraints.key(row) && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  return names.empty() ? "its own rows" : joined(names);
}

/// Text "0.0001 m" or "0.006 deg" for a pivot.
std::string misfit_text(const Constraints& constraints, const RankedRow& row) {
  return constraints.is_angle(row.row)
             ? rounded_text(row.pivot * 180.0 / pi) + " deg"
             : rounded_text(row.pivot * constraints.lever(row.row)) + " m";
}

[[noreturn]] void refuse_misaligned(const Constraints& constraints, const SparseMatrix& transposed,
                                    const std::vector<Index>& kept, const RankedRow& row) {
  const std::string key = constraints.key(row.row), name = in_quotes(key.substr(key.find('.') + 1));
  throw ModelError(
      key,
      "joints are inconsistent: " + name + " is out of line with " +
          partners(constraints, transposed, kept, row.row) + " by about " +
          misfit_text(constraints, row) + " (" + rounded_text(row.pivot) +
          " of the body's lever, in " + constraints.name(row.row) +
          "). This locks a motion that exact joints leave free. Give points and axes with more "
          "digits; or let the row give way, with solver.tolerance_assembly = " +
          rounded_text(2.0 * row.pivot) +
          "; or make one of the joints one that holds less, or a "
          "spring_damper; solver.force = true holds all rows as they are");
}

[[noreturn]] void refuse_locked(const Constraints& constraints, const SparseMatrix& transposed,
                                const std::vector<Index>& kept, Index row) {
  const std::string key = constraints.key(row), name = in_quotes(key.substr(key.find('.') + 1));
  throw ModelError(
      key,
      "the mechanism is locked in a singular pose: " + name + " and " +
          partners(constraints, transposed, kept, row) +
          " leave bodies no way to move but an infinitely small one (bars in line, as of a flat "
          "triangle), against which no finite reaction holds (" +
          constraints.name(row) +
          "). Move a point or an axis out of line, leave a joint out, or make one of them a "
          "spring_damper; solver.force cannot hold such rows");
}

/// Choice of the rows of a mechanism to keep.
struct Selection {
  std::vector<Index> kept;        ///< kept rows, the most independent first
  std::vector<RankedRow> dropped; ///< dropped rows with their largest pivot
  std::size_t at_start = 0;       ///< number of independent rows at the start
  std::vector<double> pivots;     ///< pivots of the kept rows
  /// Gradient (n_u, rows) at the pose of the choice
  std::shared_ptr<const SparseMatrix> transposed;
};

/// Selection of one mechanism from its rankings in all poses.
/// @param pose  pose in which the rows are chosen
Selection select_in_mechanism(const std::vector<const Ranking*>& rankings, double tolerance,
                              std::size_t& pose) {
  const std::vector<double> pivots = best_pivots(rankings);
  Selection out;
  std::size_t rank = 0;
  while (rank < pivots.size() && pivots[rank] > tolerance)
    ++rank;
  pose = best_pose(rankings, rank);
  for (std::size_t k = 0; k < pivots.size(); ++k)
    if (const Index row = rankings[pose]->rows[k].row; k < rank)
      out.kept.push_back(row);
    else
      out.dropped.push_back({row, pivots[k]});
  out.at_start = rankings.front()->rank(tolerance);
  out.pivots.assign(pivots.begin(), pivots.begin() + static_cast<std::ptrdiff_t>(rank));
  return out;
}

/// Selections of all mechanisms with rows in the mask.
std::vector<Selection> select(const system::Regime& s, const Mask& mask,
                              const std::vector<VectorX>& poses, double tolerance) {
  Constraints constraints(s);
  std::vector<std::vector<Ranking>> rankings; // rankings by pose and mechanism
  std::vector<std::shared_ptr<const SparseMatrix>> gradients;
  for (const VectorX& y : poses) {
    rankings.push_back(rank_at(s, constraints, mask, y));
    gradients.push_back(std::make_shared<const SparseMatrix>(
        constraints.gradient([](Index) { return true; }).transpose()));
  }
  std::vector<Selection> out;
  for (std::size_t m = 0; m < rankings.front().size(); ++m) {
    std::vector<const Ranking*> own;
    for (const std::vector<Ranking>& pose : rankings)
      own.push_back(&pose[m]);
    if (own.front()->rows.empty())
      continue;
    std::size_t pose = 0;
    out.push_back(select_in_mechanism(own, tolerance, pose));
    out.back().transposed = gradients[pose];
  }
  return out;
}

/// Rate of a drive in its row at t, in units of the row.
double drive_rate(const system::CouplerData& c, double t) {
  return c.drive(t)[c.velocity_level ? 0 : 1];
}

/// Checks that a redundant row follows from others with their drives, too, at all times.
void check_drives(const system::Regime& s, const Constraints& constraints, const Selection& chosen,
                  const Fit& fit) {
  std::vector<const system::CouplerData*> drive(static_cast<std::size_t>(s.n_lambda), nullptr);
  bool any = false;
  for (const system::CouplerData& c : s.couplers)
    if (s.holds(c) && moves(c)) {
      drive[static_cast<std::size_t>(s.lambda(c) - s.lambda0)] = &c;
      any = true;
    }
  for (std::size_t k = 0; any && k < chosen.dropped.size(); ++k) {
    const Index row = chosen.dropped[k].row;
    const VectorX c = coefficients(*chosen.transposed, chosen.kept, row);
    const system::CouplerData* own = drive[static_cast<std::size_t>(row)];
    std::vector<std::pair<double, const system::CouplerData*>>
        others; // factor in units of the rows
    for (std::size_t i = 0; i < chosen.kept.size(); ++i) {
      const system::CouplerData* other = drive[static_cast<std::size_t>(chosen.kept[i])];
      const double factor = c[static_cast<Index>(i)];
      if (other && std::abs(factor) > 1e-6)
        others.emplace_back(factor / constraints.size(chosen.kept[i]), other);
    }
    if (!own && others.empty())
      continue;
    const auto refuse = [&](const std::string& why) {
      std::vector<std::string> names;
      if (own)
        names.push_back(in_quotes(own->name));
      for (const auto& other : others)
        names.push_back(in_quotes(other.second->name));
      const bool several = own && !others.empty();
      std::string text = several ? "the drives " : "the drive ";
      text += joined(names);
      text += several ? " move" : " moves";
      throw ModelError("constraint." + (own ? own->name : others.front().second->name),
                       text + " what other constraints hold already (" + constraints.name(row) +
                           " follows from them)" + why + "; leave one of them out");
    };
    for (int i = 0; i <= drive_samples; ++i) {
      // Times that no period of a drive repeats.
      const double t = fit.end_time * std::fmod(0.6180339887498949 * i, 1.0);
      double rate = own ? drive_rate(*own, t) / constraints.size(row) : 0.0, size = std::abs(rate);
      for (const auto& [factor, other] : others) {
        if (other->drive.python || (own && own->drive.python))
          refuse("");
        const double part = factor * drive_rate(*other, t);
        rate -= part;
        size += std::abs(part);
      }
      if (others.empty() && own && own->drive.python)
        refuse("");
      if (std::abs(rate) > 1e-6 * size)
        refuse(": at t = " + rounded_text(t) + " s their rates differ by " +
               rounded_text(std::abs(rate) * constraints.size(row)) +
               (constraints.is_angle(row) ? " rad/s" : " m/s"));
    }
  }
}

/// Refuses nearly dependent rows of a mechanism: misaligned joints, and rows that lock it in a
/// singular pose.
void judge_doubtful_rows(const Constraints& constraints, const Selection& held, const Mask& curved,
                         const Fit& fit) {
  // A closed pose of a locked mechanism is within sqrt(gap) of the singular one.
  const double resolved = 3.0 * std::sqrt(nearly_closed);
  const auto is_curved = [&](Index row) { return curved[static_cast<std::size_t>(row)]; };
  for (const RankedRow& row : held.dropped)
    if (is_curved(row.row))
      refuse_locked(constraints, *held.transposed, held.kept, row.row);
  for (std::size_t k = 1; k < held.kept.size(); ++k) {
    const std::vector<Index> before{held.kept.begin(),
                                    held.kept.begin() + static_cast<std::ptrdiff_t>(k)};
    if (held.pivots[k] < resolved && k >= held.at_start && is_curved(held.kept[k]))
      refuse_locked(constraints, *held.transposed, before, held.kept[k]);
    if (!fit.force && held.pivots[k] < suspicious && held.pivots[k] < apart * held.pivots[k - 1] &&
        !is_curved(held.kept[k]))
      refuse_misaligned(constraints, *held.transposed, before, {held.kept[k], held.pivots[k]});
  }
}

/// Judges the rows of all mechanisms.
void judge_doubtful_rows(system::System& s, const system::Regime& rows,
                         const Constraints& constraints, const std::vector<Selection>& held,
                         const Mask& resting, const VectorX& start, const Fit& fit) {
  Mask doubtful(resting.size(), false), left_out = resting;
  left_out.flip();
  for (const Selection& one : held) {
    for (const RankedRow& row : one.dropped)
      doubtful[static_cast<std::size_t>(row.row)] = true;
    for (std::size_t k = 0; k < one.kept.size(); ++k)
      if (one.pivots[k] < suspicious)
        doubtful[static_cast<std::size_t>(one.kept[k])] = true;
  }
  for (std::size_t i = 0; i < doubtful.size(); ++i)
    left_out[i] = left_out[i] || doubtful[i];
  const Mask curved = curved_rows(s, rows, doubtful, left_out, start);
  for (const Selection& one : held)
    judge_doubtful_rows(constraints, one, curved, fit);
}

/// Messages on rows that were dropped although they are redundant only within the tolerance: one
/// line per joint.
std::vector<std::string> loose_rows(const Constraints& constraints,
                                    const std::vector<Selection>& held) {
  std::set<std::string> named;
  std::vector<std::string> out;
  for (const Selection& one : held)
    for (const RankedRow& row : one.dropped) {
      const std::string key = constraints.key(row.row);
      if (row.pivot > dependent && named.insert(key).second)
        out.push_back(
            key.substr(0, key.find('.')) + " " + in_quotes(key.substr(key.find('.') + 1)) +
            " is out of line with " + partners(constraints, *one.transposed, one.kept, row.row) +
            " by about " + misfit_text(constraints, row) +
            ", less than solver.tolerance_assembly: " + constraints.name(row.row) + " gives way");
    }
  return out;
}

} // namespace

void drop_dependent_rows(system::System& s, const VectorX& start, const Fit& fit) {
  const system::Regime rows(s);
  if (rows.n_lambda == 0)
    return;
  Constraints constraints(rows);
  Mask all(static_cast<std::size_t>(rows.n_lambda), true), resting = all;
  for (const system::CouplerData& c : s.couplers)
    if (rows.holds(c) && moves(c))
      resting[static_cast<std::size_t>(rows.lambda(c) - s.lambda0)] = false;
  const std::vector<Ranking> now = rank_at(s, constraints, all, start);
  if (std::all_of(now.begin(), now.end(),
                  [](const Ranking& r) { return r.rank(suspicious) == r.rows.size(); }))
    return;
  const std::vector<VectorX> poses = poses_near(rows, start);
  // First the rows at rest, then those that drives move.
  const std::vector<Selection> held =
      select(rows, resting, poses, fit.force ? std::min(dependent, fit.tolerance) : fit.tolerance);
  judge_doubtful_rows(s, rows, constraints, held, resting, start, fit);
  Mask rest(all.size(), false);
  Index n_held = 0;
  for (const Selection& one : held)
    for (Index i : one.kept) {
      rest[static_cast<std::size_t>(i)] = true;
      ++n_held;
    }
  if (n_held == s.n_u)
    s.notes.push_back("the constraints leave nothing to move");
  for (std::size_t i = 0; i < all.size(); ++i)
    rest[i] = rest[i] || !resting[i];
  const std::vector<Selection> moved = resting == all ? held : select(rows, rest, poses, dependent);
  std::vector<Index> kept;
  std::size_t more = 0; // degrees of freedom at the start
  for (const Selection& one : moved) {
    check_drives(rows, constraints, one, fit);
    kept.insert(kept.end(), one.kept.begin(), one.kept.end());
    more += std::max(one.kept.size(), one.at_start) - one.at_start;
  }
  if (more > 0)
    s.notes.push_back("the start is a singular pose: " + std::to_string(more) +
                      " more degrees of freedom there than nearby");
  if (kept.size() == all.size())
    return;
  std::sort(kept.begin(), kept.end());
  std::vector<std::string> names;
  system::for_each_row(s, [&](system::Row& row, bool velocity_level) {
    const Index lambda = rows.lambda(row);
    if (lambda == system::redundant ||
        std::binary_search(kept.begin(), kept.end(), lambda - s.lambda0))
      return; // an open switch has no row now
    names.push_back(rows.row_names[velocity_level ? lambda : rows.mu(row)]);
    row.dropped = true;
  });
  s.notes.push_back(std::to_string(names.size()) +
                    " redundant constraint rows, which follow from the others: " + joined(names));
  for (std::string& loose : loose_rows(constraints, held))
    s.notes.push_back(std::move(loose));
}

} // namespace hydrodae::build
