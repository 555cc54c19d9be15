// A <material> of solids and its <geom_object>s.
#include <fmt/format.h>

#include <cmath>

#include "framework/scene/deck_values.hpp"
#include "mpm/deck/material_law.hpp"
#include "mpm/deck/pore_water.hpp"
#include "mpm/deck/readers.hpp"

namespace sluice::mpm {
namespace {

MaterialConstants read_constants(const DeckNode& node, double reference_pressure) {
  MaterialConstants c;
  c.density = node.real("density");
  c.conductivity = node.real("thermal_conductivity");
  c.specific_heat = node.real("specific_heat");
  c.thermal_expansion = real_or(node, "linear_thermal_expansion_coef", 0);
  c.room_temperature = real_or(node, "room_temp", c.room_temperature);
  c.melt_temperature = real_or(node, "melt_temp", c.melt_temperature);
  c.reference_pressure = reference_pressure;
  return c;
}

double det_of_map(const std::array<double, 9>& a) {
  return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) +
         a[2] * (a[3] * a[7] - a[4] * a[6]);
}

void read_map(const DeckNode& node, SeedObject& o, std::vector<Fault>& faults) {
  constexpr const char* rows[] = {"affineTransformation_A0", "affineTransformation_A1",
                                  "affineTransformation_A2"};
  for (std::size_t r = 0; r < 3; ++r) {
    o.mapped = o.mapped || node.has(rows[r]);
    const Vec3 row =
        vector_or(node, rows[r], {r == 0 ? 1.0 : 0, r == 1 ? 1.0 : 0, r == 2 ? 1.0 : 0});
    o.map[3 * r] = row.x;
    o.map[3 * r + 1] = row.y;
    o.map[3 * r + 2] = row.z;
  }
  o.shift = vector_or(node, "affineTransformation_b", {});
  o.mapped = o.mapped || node.has("affineTransformation_b");
  if (!(det_of_map(o.map) > 0))
    add_error(faults, node.where,
              fmt::format("affineTransformation_A0, A1, A2 have the determinant {:g}; particles "
                          "need a positive volume",
                          det_of_map(o.map)),
              "swap two rows, or give another transformation");
}

}  // namespace

SeedObject read_seed_object(const DeckNode& node, const GeometryReader& geometry,
                            std::vector<Fault>& faults) {
  SeedObject o;
  GeomObject g = geometry.object(node, faults);
  o.piece = std::move(g.piece);
  o.where = node.where;
  o.per_cell = g.res;
  o.velocity = g.velocity;
  o.temperature = g.has("temperature") ? g.value("temperature") : 0;
  if (g.has("volumeFraction")) o.volume_fraction = g.value("volumeFraction");
  o.filling_levels = integer_or(node, "numLevelsParticleFilling", 1);
  o.cut_cells = boolean_or(node, "cut_cells", false);
  o.concentration = real_or(node, "concentration", 0);
  o.colour = g.has("color") ? g.value("color") : 0;
  read_map(node, o, faults);
  return o;
}

SolidMaterial read_material(const DeckNode& node, int index, const PhysicalConstants& physical,
                            bool holds_water, const GeometryReader& geometry,
                            std::vector<Fault>& faults) {
  SolidMaterial m;
  m.name = node.attribute("name").value_or("");
  m.index = index;
  m.where = node.where;
  m.constants = read_constants(node, physical.reference_pressure);
  if (holds_water) m.water = read_pore_water(node, physical.gravity);
  if (m.water) m.constants.density *= 1 - m.water->porosity;  // what is there without water
  m.specific_heat_p = real_or(node, "C_p", m.constants.specific_heat);
  m.law = read_law(node, m.constants, faults);
  if (const DeckNode* model = node.child("diffusion_model")) {
    m.diffusion = Diffusion{model->real("diffusivity")};
    m.diffusion->least = real_or(*model, "min_concentration", m.diffusion->least);
    m.diffusion->most = real_or(*model, "max_concentration", m.diffusion->most);
  }
  m.rigid = boolean_or(node, "is_rigid", false) || has_rigid_law(node);
  m.force_transmitting = boolean_or(node, "is_force_transmitting_material", false);
  m.may_give_normals = boolean_or(node, "possible_alpha_material", true);
  m.active_at_start = boolean_or(node, "is_active", true);
  m.activation_time = real_or(node, "activation_time", 0);
  m.deactivation_time = real_or(node, "deactivation_time", 1e8);
  if (m.force_transmitting && !m.rigid)
    add_error(faults, node.need("is_force_transmitting_material").where,
              "<is_force_transmitting_material> of a deforming material",
              "it is for rigid materials: <is_rigid>true</is_rigid>");
  for (const DeckNode* object : node.all("geom_object"))
    m.objects.push_back(read_seed_object(*object, geometry, faults));
  return m;
}

}  // namespace sluice::mpm
