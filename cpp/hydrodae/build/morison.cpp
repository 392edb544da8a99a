/// Segments of Morison elements, and their waves and current.

#include "hydrodae/build/initial_pose.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/text.h"
#include "hydrodae/model/claims.h"
#include "hydrodae/water/morison_list.h"

namespace hydrodae::build {

namespace {

/// Sphere of the given diameter, or of the given volume (or area without a volume).
water::MorisonSegment point_law(const water::Morison& m, double rho) {
  const double D = m.diameter.value_or(0.0);
  const double area = m.area.value_or(0.25 * pi * D * D);
  const double volume = m.volume.value_or(pi / 6.0 * D * D * D);
  water::MorisonSegment law;
  law.radius = volume > 0.0 ? std::cbrt(0.75 * volume / pi) : std::sqrt(area / pi);
  law.drag = 0.5 * rho * m.drag_coefficient * area;
  if (m.added_mass_coefficient) {
    law.mass_fluid = rho * volume * (1.0 + *m.added_mass_coefficient);
    law.mass_body = rho * volume * *m.added_mass_coefficient;
  }
  return law;
}

/// Piece of a cylinder of this length.
water::MorisonSegment member_law(const water::Morison& m, double length, double rho) {
  const double D = *m.diameter, volume = 0.25 * pi * D * D * length;
  water::MorisonSegment law;
  law.half_length = 0.5 * length;
  law.radius = 0.5 * D;
  law.drag = 0.5 * rho * m.drag_coefficient * D * length;
  law.drag_axial = 0.5 * rho * m.drag_axial * pi * D * length;
  if (m.added_mass_coefficient) {
    law.mass_fluid = rho * volume * (1.0 + *m.added_mass_coefficient);
    law.mass_body = rho * volume * *m.added_mass_coefficient;
  }
  law.mass_axial = rho * volume * m.added_mass_axial;
  return law;
}

/// Notes the inertia of an element for the user.
void note_inertia(const water::Morison& m, const model::Body& body, bool inside,
                  system::System& s) {
  const std::string name = "morison " + in_quotes(m.name);
  if (inside)
    s.notes.push_back(name + " lies inside the mesh of body " + in_quotes(body.name) +
                      ", which has the load of the undisturbed waves: its inertia force is rho V "
                      "C_a (a_f - a_b)");
  if (body.hydro && m.has_inertia())
    s.notes.push_back(name + " adds its inertia to the loads that the database has of body " +
                      in_quotes(body.name) + ": right for a part outside the panels");
}

} // namespace

void add_morison(const model::Scene& scene, const Sea& sea, system::System& s) {
  if (scene.morison.empty())
    return;
  const model::Water water = model::water(scene);
  auto list = std::make_shared<water::MorisonList>(sea.field);
  std::vector<system::PortData> ports;
  Index pieces = 0;
  for (const water::Morison& m : scene.morison) {
    system::PortData port;
    port.component = m.name;
    port.body = body_index(scene, m.body);
    water::MorisonMember member;
    member.instantaneous = m.surface == "instantaneous";
    member.moves = s.bodies[static_cast<std::size_t>(port.body)].n_active > 0;
    const model::Body& body = scene.bodies[static_cast<std::size_t>(port.body)];
    const Vector3& origin = body.center_of_gravity;
    if (m.point) {
      member.law = point_law(m, water.density);
      member.first = *m.point - origin;
    } else {
      const Vector3 along = *m.point_b - *m.point_a;
      member.segments = m.segments;
      member.step = along / m.segments;
      member.first = *m.point_a - origin + 0.5 * member.step;
      member.axis = along.normalized();
      member.law = member_law(m, member.step.norm(), water.density);
    }
    const bool inside = model::leaves_waves_to_mesh(body, m);
    if (inside)
      member.law.mass_fluid = member.law.mass_body;
    note_inertia(m, body, inside, s);
    if (member.moves)
      pieces += member.segments;
    list->add(m.name, member);
    ports.push_back(std::move(port));
  }
  s.elements.push_back({std::move(list), std::move(ports), {}});
  if (pieces > 0 && !sea.all.empty())
    s.notes.push_back(
        "Morison elements: every evaluation sums " + std::to_string(sea.all.size()) +
        " wave components at " + std::to_string(pieces) + " points that move, about " +
        number_text(0.0015 * static_cast<double>(sea.all.size()) * static_cast<double>(pieces)) +
        " us");
}

} // namespace hydrodae::build
