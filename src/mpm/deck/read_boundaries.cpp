// What the faces of the domain do to solids.
#include <fmt/format.h>

#include <algorithm>

#include "framework/scene/deck_values.hpp"
#include "mpm/deck/readers.hpp"

namespace sluice::mpm {
namespace {

// Index of the scene's material as a local number; -1: all; -2: no solid's.
int local_number(const MpmScene& s, int index) {
  if (index < 0) return -1;
  const auto at = std::find_if(s.materials.begin(), s.materials.end(),
                               [&](const SolidMaterial& m) { return m.index == index; });
  return at == s.materials.end() ? -2 : static_cast<int>(at - s.materials.begin());
}

// False: says nothing to solids.
bool translate(const Condition& c, SolidBoundary& b, std::vector<Fault>& faults) {
  using Kind = SolidBoundary::Kind;
  b.value = c.is_vector ? c.vector : Vec3::all(c.value);
  if (c.variable == "Symmetric" || c.kind == ConditionKind::symmetry) {
    b.kind = Kind::symmetric;
    return c.variable == "Symmetric" || c.variable == "Velocity";
  }
  if (c.variable == "Velocity" && c.kind == ConditionKind::dirichlet) {
    b.kind = Kind::velocity;
    if (!c.has_value)
      add_warning(faults, c.where, "a velocity without <value>: [0,0,0] is used",
                  "write <value>[0.0,0.0,0.0]</value>");
    else if (!c.is_vector && c.value == 0)
      add_warning(faults, c.where, "the velocity at a face is a vector: 0 is read as [0,0,0]",
                  "write [0.0,0.0,0.0]");
    else if (!c.is_vector)
      add_error(faults, c.where, "the velocity at a face is a vector", "write [0.0,0.0,0.0]");
    return true;
  }
  if (c.variable == "Temperature" && c.kind == ConditionKind::dirichlet) {
    b.kind = Kind::temperature;
    return true;
  }
  if (c.variable == "Temperature" && c.kind == ConditionKind::neumann) {
    b.kind = Kind::temperature_gradient;
    return !c.zero_gradient();  // that is what a face without a condition has
  }
  if (c.variable == "SD-Type" && c.kind == ConditionKind::dirichlet) {
    b.kind = Kind::concentration;
    return true;
  }
  if (c.variable == "SD-Type" && c.kind == ConditionKind::neumann) {
    b.kind = Kind::concentration_gradient;
    return !c.zero_gradient();
  }
  // Neumann of the velocity is the free face; pressure and density are a fluid's.
  if (c.variable == "Velocity" && c.kind != ConditionKind::neumann)
    add_error(faults, c.where,
              fmt::format("solids do not support the condition {} of the velocity", c.kind_name),
              "valid: Dirichlet, Neumann (free), or Symmetric");
  if (c.variable == "Velocity" && !c.zero_gradient())
    add_warning(faults, c.where,
                "a gradient of the velocity has no effect on solids: the face is free", "write 0");
  return false;
}

}  // namespace

void read_boundaries(const Scene& scene, MpmScene& s, std::vector<Fault>& faults) {
  for (const Side side : all_sides) {
    const std::vector<BoundaryRegion>& regions = scene.boundary.side(side).regions;
    for (std::size_t r = 0; r < regions.size(); ++r)
      for (const Condition& c : regions[r].conditions) {
        SolidBoundary b;
        b.side = side;
        b.region = regions.size() > 1 ? static_cast<int>(r) : -1;
        b.material = local_number(s, c.material);
        if (b.material == -2) continue;
        if (translate(c, b, faults)) s.boundaries.push_back(b);
      }
  }
}

}  // namespace sluice::mpm
