// Filling cells from geometry objects and formulas; hydrostatic pressure.
//
// A cell takes the values of the last object that holds at least one of its sub-points; with one
// material the volume fraction is one wherever anything is. Under gravity the pressure follows
// from the scheme's own discrete balance along each direction,
//   p_{i+1} - p_i = g dx (rho_i + rho_{i+1})/2,   p = reference_pressure at cell (0,0,0),
// with the density as the deck says; the internal energy follows from both.
#include "ice/initial_state.hpp"

#include <fmt/format.h>

#include "framework/scene/formula.hpp"

namespace sluice::ice {
namespace {

void apply_objects(const IceMaterial& m, const Level& level, PrimitiveFill& fill) {
  std::vector<char> covered(fill.density.size(), 0);
  for (const GeomObject& o : m.objects) {
    const std::vector<std::int32_t> inside = count_inside(o, level, fill.cells);
    for (std::size_t n = 0; n < inside.size(); ++n) {
      if (inside[n] == 0) continue;
      covered[n] = 1;
      fill.density[n] = o.value("density");
      fill.temperature[n] = o.value("temperature");
      for (int d = 0; d < 3; ++d) fill.velocity[d][n] = o.velocity[d];
    }
  }
  std::size_t n = 0;
  for_each_cell(fill.cells, [&](IntVec3 c) {
    if (covered[n++]) return;
    const Vec3 x = level.centre(c);
    throw InputError(fmt::format(
        "{}: no geom_object of ICE material {} covers cell [{}, {}, {}] at ({:g}, {:g}, {:g}); "
        "every cell of the domain needs an initial state: add a geom_object that covers the rest",
        to_string(m.where), m.index, c.x, c.y, c.z, x.x, x.y, x.z));
  });
}

// Evaluates one formula in every cell, into `values`.
void evaluate(const std::optional<std::string>& text, const Level& level, const IndexBox& cells,
              std::vector<double>& values) {
  if (!text) return;
  const Formula formula(*text);
  std::size_t n = 0;
  for_each_cell(cells, [&](IntVec3 c) { values[n++] = formula(level.centre(c)); });
}

void apply_formula(const FormulaFill& f, const IceMaterial& m, const Level& level,
                   PrimitiveFill& fill) {
  evaluate(f.density, level, fill.cells, fill.density);
  evaluate(f.temperature, level, fill.cells, fill.temperature);
  for (std::size_t d = 0; d < 3; ++d) evaluate(f.velocity[d], level, fill.cells, fill.velocity[d]);
  for (std::size_t n = 0; n < fill.density.size(); ++n)
    fill.pressure[n] = m.fluid.pressure(
        fill.density[n], m.fluid.energy_from_temperature(fill.density[n], fill.temperature[n]));
  evaluate(f.pressure, level, fill.cells, fill.pressure);
}

// `fill` must reach down to the domain's low end along every direction of gravity. The lowest cell
// of a finer level lies below that of the coarsest one.
void apply_hydrostatics(const PhysicalConstants& constants, const Level& coarsest,
                        const Level& level, PrimitiveFill& fill) {
  const Vec3 g = constants.gravity;
  double below_reference = 0;  // g times distance
  if (level.index != coarsest.index)
    for (int d = 0; d < 3; ++d)
      below_reference +=
          g[d] * (level.centre(level.domain.lower)[d] - coarsest.centre(coarsest.domain.lower)[d]);
  for_each_cell(fill.cells, [&](IntVec3 c) {
    const std::size_t n = fill.offset(c);
    fill.pressure[n] = constants.reference_pressure;
    if (below_reference != 0) fill.pressure[n] += below_reference * fill.density[n];
    for (int d = 2; d >= 0; --d) {
      if (g[d] == 0 || c[d] == level.domain.lower[d]) continue;
      IntVec3 below = c;
      below[d] -= 1;
      const std::size_t b = fill.offset(below);
      fill.pressure[n] =
          fill.pressure[b] + 0.5 * g[d] * level.spacing[d] * (fill.density[b] + fill.density[n]);
      break;
    }
  });
}

void check_admissible(const IceMaterial& m, const PrimitiveFill& fill) {
  for_each_cell(fill.cells, [&](IntVec3 c) {
    const std::size_t n = fill.offset(c);
    if (fill.density[n] > 0 && fill.pressure[n] > 0) return;
    throw InputError(fmt::format(
        "{}: ICE material {} starts with density {:g} and pressure {:g} in cell [{}, {}, {}]; both "
        "must be above 0",
        to_string(m.where), m.index, fill.density[n], fill.pressure[n], c.x, c.y, c.z));
  });
}

PrimitiveFill cut(const PrimitiveFill& from, const IndexBox& cells) {
  PrimitiveFill fill;
  fill.cells = cells;
  for_each_cell(cells, [&](IntVec3 c) {
    const std::size_t n = from.offset(c);
    fill.density.push_back(from.density[n]);
    fill.temperature.push_back(from.temperature[n]);
    fill.pressure.push_back(from.pressure[n]);
    for (int d = 0; d < 3; ++d) fill.velocity[d].push_back(from.velocity[d][n]);
  });
  return fill;
}

}  // namespace

PrimitiveFill fill_primitives(const IceScene& scene, const PhysicalConstants& constants,
                              const IceMaterial& material, const Level& coarsest,
                              const Level& level, const IndexBox& cells) {
  const bool hydrostatic = scene.hydrostatic_start && !(constants.gravity == Vec3{});
  PrimitiveFill fill;
  fill.cells = cells;
  for (int d = 0; d < 3 && hydrostatic; ++d)
    if (constants.gravity[d] != 0) fill.cells.lower[d] = level.domain.lower[d];
  const auto count = static_cast<std::size_t>(fill.cells.volume());
  for (std::vector<double>* v : {&fill.density, &fill.temperature, &fill.pressure,
                                 &fill.velocity[0], &fill.velocity[1], &fill.velocity[2]})
    v->assign(count, 0.0);
  apply_objects(material, level, fill);
  for (std::size_t n = 0; n < count; ++n)
    fill.pressure[n] = material.fluid.pressure(
        fill.density[n],
        material.fluid.energy_from_temperature(fill.density[n], fill.temperature[n]));
  if (scene.formula) apply_formula(*scene.formula, material, level, fill);
  if (hydrostatic) apply_hydrostatics(constants, coarsest, level, fill);
  check_admissible(material, fill);
  if (fill.cells == cells) return fill;  // moved, not copied
  return cut(fill, cells);
}

}  // namespace sluice::ice
