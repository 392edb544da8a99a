#include "hydrodae/tree/joint_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <random>

#include "hydrodae/core/text.h"
#include "hydrodae/math/dense.h"

namespace hydrodae::tree {

namespace {

using Turn = TreeLink::Turn;

constexpr double exact = 1e-9; ///< misfit of poses and rows [m or rad] that counts as none
constexpr int samples = 3;     ///< poses drawn to see whether a joint can be a link

/// What a joint leaves free between its markers.
struct Freedom {
  Turn turn = Turn::none;
  std::vector<int> slides;
  bool advances = false;
};

/// By its rows: a slide along each axis of marker A that no row spans, and the turns that its
/// pairs of axes leave; empty for a kind that cannot be a link.
std::optional<Freedom> freedom_of(const joint::JointType& type) {
  using joint::BasicRow, joint::PerpRow, joint::ScrewRow, joint::SpanRow, joint::X, joint::Y,
      joint::Z;
  const auto count = [&](auto test) {
    return std::count_if(type.rows.begin(), type.rows.end(), test);
  };
  const auto has = [&](const BasicRow& wanted) {
    return count([&](const BasicRow& row) { return row == wanted; }) > 0;
  };
  const auto held = count([](const BasicRow& row) { return std::holds_alternative<PerpRow>(row); });
  const auto known =
      held + count([](const BasicRow& row) {
        return std::holds_alternative<SpanRow>(row) || std::holds_alternative<ScrewRow>(row);
      });
  if (known == 0 || known != static_cast<std::ptrdiff_t>(type.rows.size()))
    return std::nullopt;
  Freedom out;
  out.advances = type.has_row<ScrewRow>();
  for (const joint::Axis axis : {X, Y, Z})
    if (!has(joint::span(axis)) && !(out.advances && axis == Z))
      out.slides.push_back(axis);
  if (held == 0)
    out.turn = Turn::ball;
  else if (held == 1 && has(joint::perp(X, Y)))
    out.turn = Turn::crossed;
  else if (held == 2 && has(joint::perp(X, Z)) && has(joint::perp(Y, Z)))
    out.turn = Turn::about_axis;
  else if (held != 3)
    return std::nullopt;
  return out;
}

void count(TreeLink& l) {
  const int turns = l.turn == Turn::none         ? 0
                    : l.turn == Turn::about_axis ? 1
                    : l.turn == Turn::crossed    ? 2
                                                 : 3;
  l.n_u = static_cast<int>(l.slides.size()) + turns;
  l.n_q = l.n_u + (l.turn == Turn::ball ? 1 : 0);
}

bool are_parallel(const Vector3& a, const Vector3& b) { return cross<double>(a, b).norm() < exact; }

/// Takes away the turns that a body with locked rotations does not make; `axes`: those of marker A.
void lock(const system::BodyData& child, const Matrix3& axes, TreeLink& l) {
  if (child.rotation == system::BodyData::Rotation::free)
    return;
  if (child.rotation == system::BodyData::Rotation::locked) {
    l.turn = Turn::none;
    return;
  }
  l.plane_axis = child.axis;
  const Vector3 only = axes.transpose() * Vector3::Unit(child.axis);
  if (l.turn == Turn::ball || (l.turn == Turn::crossed && (are_parallel(only, Vector3::UnitX()) ||
                                                           are_parallel(only, Vector3::UnitY())))) {
    l.turn = Turn::about_axis;
    l.axis = only;
  } else if (l.turn == Turn::crossed || !are_parallel(only, l.axis)) {
    l.turn = Turn::none;
  }
  if (l.turn == Turn::about_axis)
    l.angle_factor = (l.axis.dot(only) > 0.0) == l.turned ? -1.0 : 1.0;
}

/// A joint as a link of `child`, whatever the poses; empty for a kind that cannot be one.
std::optional<TreeLink> link_through(const system::System& s, int joint, int child, int parent) {
  const system::JointData& j = s.joints[static_cast<std::size_t>(joint)];
  const std::optional<Freedom> freedom = freedom_of(*j.type);
  if (!freedom)
    return std::nullopt;
  TreeLink l;
  l.body = child;
  l.parent = parent;
  l.joint = joint;
  l.turned = j.A.body == child;
  l.turn = freedom->turn;
  l.slides = freedom->slides;
  lock(s.bodies[static_cast<std::size_t>(child)], j.A.axes, l);
  if (freedom->advances && l.turn == Turn::about_axis)
    l.advance = j.parameters.pitch / (2.0 * pi);
  const joint::Marker &near = l.turned ? j.B : j.A, &far = l.turned ? j.A : j.B;
  l.parent_axes = near.axes;
  l.child_axes = far.axes;
  l.parent_turn = quaternion_of<double>(near.axes).normalized();
  l.child_turn = quaternion_of<double>(far.axes).normalized();
  l.parent_point = near.point;
  l.child_point = far.point;
  count(l);
  return l;
}

TreeLink own_link(const system::System& s, int body) {
  const system::BodyData& b = s.bodies[static_cast<std::size_t>(body)];
  TreeLink l;
  l.body = body;
  for (int k = 0; k < b.n_translations; ++k)
    l.slides.push_back(b.active[static_cast<std::size_t>(k)]);
  if (b.rotation == system::BodyData::Rotation::about_axis) {
    l.turn = Turn::about_axis;
    l.axis = Vector3::Unit(b.axis);
    l.plane_axis = b.axis;
    l.angle_factor = 1.0;
  } else if (b.rotation == system::BodyData::Rotation::free) {
    l.turn = Turn::ball;
  }
  count(l);
  return l;
}

/// Does the body stay where its locked coordinates hold it?
bool keeps_locks(const system::BodyData& b, const TreeMotion::Body& c) {
  Vector3 way = c.r - b.position;
  for (int k = 0; k < b.n_translations; ++k)
    way[b.active[static_cast<std::size_t>(k)]] = 0.0;
  if (way.norm() > exact * (1.0 + c.r.norm()))
    return false;
  if (b.rotation == system::BodyData::Rotation::about_axis)
    return (c.R.col(b.axis) - Vector3::Unit(b.axis)).norm() < exact;
  return b.rotation == system::BodyData::Rotation::free ||
         (c.R - rotation_matrix<double>(b.orientation)).norm() < exact;
}

/// Do the last link's rows hold, and leave the body those coordinates and no more?
bool meets_rows(const system::System& s, const TreeLink& l, const TreeMotion& m) {
  const system::JointData& j = s.joints[static_cast<std::size_t>(l.joint)];
  const system::BodyData& child = s.bodies[static_cast<std::size_t>(l.body)];
  const auto pose = [&](int body) {
    return body < 0 ? std::pair<Vector3, Matrix3>(Vector3::Zero(), Matrix3::Identity())
                    : std::pair(m.bodies[static_cast<std::size_t>(body)].r,
                                m.bodies[static_cast<std::size_t>(body)].R);
  };
  const auto [r_A, R_A] = pose(j.A.body);
  const auto [r_B, R_B] = pose(j.B.body);
  const joint::Geometry<double> g = joint::geometry<double>(j.B, r_A, R_A, r_B, R_B);
  MatrixX gradient = MatrixX::Zero(child.n_active, static_cast<Index>(j.rows.size()));
  for (std::size_t i = 0; i < j.rows.size(); ++i) {
    const auto row = joint::basic_row<double>(j.rows[i].kind, j.A, j.B, j.parameters, g);
    if (std::abs(row.value) > exact * (1.0 + (r_A - r_B).norm()))
      return false;
    const Vector6 own = l.turned ? row.gradient.head<6>() : row.gradient.tail<6>();
    for (int k = 0; k < child.n_active; ++k)
      gradient(k, static_cast<Index>(i)) = own[child.active[static_cast<std::size_t>(k)]];
  }
  int rank = 0;
  if (gradient.size() > 0) {
    const VectorX pivots = pivoted_columns(gradient).pivots.cwiseAbs();
    rank = static_cast<int>((pivots.array() > exact * pivots.maxCoeff()).count());
  }
  return l.n_u + rank == child.n_active;
}

/// Can `l` follow the links of the tree? By poses drawn at random.
bool can_follow(const system::System& s, const JointTree& tree, const TreeLink& l) {
  JointTree longer = tree;
  longer.links.push_back(l);
  longer.n_q += l.n_q;
  longer.n_u += l.n_u;
  TreeMotion motion(s, static_cast<std::size_t>(longer.n_u));
  std::mt19937 random(1);
  const auto draw = [&] { return 2.0 * (random() / 4294967296.0) - 1.0; };
  VectorX x(longer.n_q + longer.n_u);
  for (int k = 0; k < samples; ++k) {
    for (Index i = 0; i < x.size(); ++i)
      x[i] = draw();
    motion.move(longer, x.data());
    if (!keeps_locks(s.bodies[static_cast<std::size_t>(l.body)],
                     motion.bodies[static_cast<std::size_t>(l.body)]) ||
        !meets_rows(s, l, motion))
      return false;
  }
  return true;
}

} // namespace

JointTree::JointTree(const system::System& s)
    : link_of(s.bodies.size(), -1), guided(s.n_rows, false) {
  const auto moves = [&](int body) {
    return body >= 0 && s.bodies[static_cast<std::size_t>(body)].n_active > 0;
  };
  std::vector<std::vector<int>> joints_of(s.bodies.size());
  std::queue<int> waiting({-1});
  for (std::size_t i = 0; i < s.joints.size(); ++i)
    for (const int body : {s.joints[i].A.body, s.joints[i].B.body})
      if (body >= 0 && freedom_of(*s.joints[i].type))
        joints_of[static_cast<std::size_t>(body)].push_back(static_cast<int>(i));
  for (int body = 0; body < static_cast<int>(s.bodies.size()); ++body)
    if (!moves(body))
      waiting.push(body);
  const auto add = [&](TreeLink l) {
    l.q0 = n_q;
    l.u0 = n_u;
    n_q += l.n_q;
    n_u += l.n_u;
    l.before = l.parent < 0 ? -1 : link_of[static_cast<std::size_t>(l.parent)];
    link_of[static_cast<std::size_t>(l.body)] = static_cast<int>(links.size());
    links.push_back(l);
    waiting.push(l.body);
  };
  const auto follow = [&](int joint, int child, int parent) {
    if (!moves(child) || link_of[static_cast<std::size_t>(child)] >= 0)
      return;
    std::optional<TreeLink> l = link_through(s, joint, child, parent);
    if (!l)
      return;
    l->q0 = n_q;
    l->u0 = n_u;
    if (!can_follow(s, *this, *l))
      return;
    add(*l);
    for (const system::RowData& row : s.joints[static_cast<std::size_t>(joint)].rows)
      guided[row.number] = true;
  };
  for (;;) {
    for (; !waiting.empty(); waiting.pop()) {
      const int parent = waiting.front();
      for (std::size_t i = 0; i < s.joints.size(); ++i) {
        const system::JointData& j = s.joints[i];
        if (j.A.body == parent)
          follow(static_cast<int>(i), j.B.body, parent);
        if (j.B.body == parent)
          follow(static_cast<int>(i), j.A.body, parent);
      }
    }
    int root = -1;
    const auto rank = [&](int body) {
      return std::pair(joints_of[static_cast<std::size_t>(body)].size(),
                       s.bodies[static_cast<std::size_t>(body)].mass);
    };
    for (int body = 0; body < static_cast<int>(s.bodies.size()); ++body)
      if (moves(body) && link_of[static_cast<std::size_t>(body)] < 0 &&
          (root < 0 || rank(body) > rank(root)))
        root = body;
    if (root < 0)
      return;
    add(own_link(s, root));
  }
}

std::string JointTree::in_words(const system::Regime& s) const {
  std::string text = "reduced coordinates: " + std::to_string(n_u) + " velocities in place of " +
                     std::to_string(s.n_u) + ", " + std::to_string(rows_left(s)) + " of " +
                     std::to_string(s.n_lambda) + " constraint rows left";
  std::vector<std::string> left;
  for (const system::JointData& j : s.joints)
    if (std::any_of(j.rows.begin(), j.rows.end(), [&](const system::RowData& row) {
          return s.holds(row) && !guided[row.number];
        }))
      left.push_back("'" + j.name + "'");
  for (const system::CouplerData& c : s.couplers)
    if (s.holds(c))
      left.push_back("'" + c.name + "'");
  return rows_left(s) == 0 ? text : text + " (" + joined(left) + ")";
}

} // namespace hydrodae::tree
