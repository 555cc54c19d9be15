// Filling cells of one material from geometry objects, named starts and formulas; hydrostatic
// pressure.
//
// A cell takes the values of the last object that holds at least one of its sub-points; with one
// material the volume fraction is one wherever anything is. Under gravity the pressure follows
// from the scheme's own discrete balance along each direction,
//   p_{i+1} - p_i = g dx (rho_i + rho_{i+1})/2,   p = reference_pressure at cell (0,0,0).
// A gas keeps the density of the deck, and its internal energy follows from both; a liquid or solid
// (law that bears tension, or whose pressure knows density alone) keeps the temperature, and its
// density follows, if that changes it by little (docs/initial_state.md).
#include "ice/start/initial_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/deck/faults.hpp"
#include "ice/start/custom_start.hpp"
#include "ice/start/formula_fill.hpp"
#include "ice/start/initial_state_parts.hpp"

namespace sluice::ice {
namespace {

// threshold: largest relative difference between the density at the reference pressure and the
//   density of the deck; unit: 1; test: MaterialFill.ADensityOfAnotherPressureIsKeptOrRefused
constexpr double density_tolerance = 0.02;

// Cells that solids fill need no fluid; what there is of it beside a surface is that of the cells
// around, and a state that nobody sees is that of the first object.
void fill_beside_solids(const IceMaterial& m, const Level& level, std::vector<char>& covered,
                        PrimitiveFill& fill) {
  constexpr int farthest = 3;
  std::size_t n = 0;
  for_each_cell(fill.cells, [&](IntVec3 c) {
    if (covered[n++]) return;
    const GeomObject* found = &m.objects.front();
    for (int reach = 1; reach <= farthest; ++reach) {
      IndexBox around{c - level.ghosts(reach), c + level.ghosts(reach) + IntVec3{1, 1, 1}};
      around = intersection(around, level.domain);
      const GeomObject* last = nullptr;
      for (const GeomObject& o : m.objects) {
        const std::vector<std::int32_t> inside = count_inside(o, level, around);
        if (std::any_of(inside.begin(), inside.end(), [](auto count) { return count > 0; }))
          last = &o;
      }
      if (last == nullptr) continue;
      found = last;
      break;
    }
    ObjectState(*found).put(n - 1, fill);
  });
}

void apply_objects(const IceMaterial& m, bool with_solids, const Level& level,
                   PrimitiveFill& fill) {
  std::vector<char> covered(fill.density.size(), 0);
  for (const GeomObject& o : m.objects) {
    const std::vector<std::int32_t> inside = count_inside(o, level, fill.cells);
    const ObjectState state(o);
    for (std::size_t n = 0; n < inside.size(); ++n) {
      if (inside[n] == 0) continue;
      covered[n] = 1;
      state.put(n, fill);
    }
  }
  if (with_solids && !m.objects.empty()) return fill_beside_solids(m, level, covered, fill);
  std::size_t n = 0;
  for_each_cell(fill.cells, [&](IntVec3 c) {
    if (covered[n++]) return;
    const Vec3 x = level.centre(c);
    throw DeckError(
        m.where,
        fmt::format(
            "no geom_object of ICE material {} covers cell [{}, {}, {}] at ({:g}, {:g}, {:g})",
            m.index, c.x, c.y, c.z, x.x, x.y, x.z),
        "every cell of the domain needs an initial state: add a geom_object that covers the rest");
  });
}

double law_pressure(const IceMaterial& m, double density, double temperature) {
  return m.fluid.pressure(density, m.fluid.energy_from_temperature(density, temperature));
}

void apply_custom(const IceScene& scene, double reference_pressure, const IceMaterial& m,
                  const Level& coarsest, const Level& level, PrimitiveFill& fill) {
  const CustomPlace place{coarsest, reference_pressure};
  std::size_t n = 0;
  for_each_cell(fill.cells, [&](IntVec3 c) {
    CellStart cell{level.centre(c),
                   fill.density[n],
                   fill.temperature[n],
                   {fill.velocity[0][n], fill.velocity[1][n], fill.velocity[2][n]},
                   m.viscosity,
                   fill.pressure[n],
                   false};
    for (const CustomStart& start : scene.custom) apply(start, place, cell);
    for (int d = 0; d < 3; ++d) fill.velocity[d][n] = cell.velocity[d];
    fill.temperature[n] = cell.temperature;
    if (cell.pressure_given)
      set_pressure(m, what_is_kept(m, fill.density[n], fill.temperature[n], reference_pressure),
                   cell.pressure, n, fill);
    else
      fill.pressure[n] = law_pressure(m, fill.density[n], fill.temperature[n]);
    ++n;
  });
}

}  // namespace

void set_pressure(const IceMaterial& m, Keeps keeps, double pressure, std::size_t n,
                  PrimitiveFill& fill) {
  fill.pressure[n] = pressure;
  if (keeps == Keeps::temperature)
    fill.density[n] = m.fluid.density(pressure, fill.temperature[n]);
  else
    fill.temperature[n] = m.fluid.temperature(
        fill.density[n],
        m.fluid.energy_from_pressure(fill.density[n], pressure, fill.temperature[n]));
}

Keeps what_is_kept(const IceMaterial& m, double density, double temperature,
                   double reference_pressure) {
  if (m.fluid.depends_on_energy() && !(m.fluid.lowest_pressure() < 0)) return Keeps::density;
  const double meant = m.fluid.density(reference_pressure, temperature);
  if (std::abs(meant - density) <= density_tolerance * density) return Keeps::temperature;
  if (m.fluid.depends_on_energy()) return Keeps::density;
  throw DeckError(
      m.where,
      fmt::format(
          "ICE material {} has density {:g} at the start, but {:g} at the reference pressure "
          "{:g}, and no temperature changes that",
          m.index, density, meant, reference_pressure),
      "write a density near it, or <applyHydrostaticPressure>false</applyHydrostaticPressure>");
}

void size_fill(const IndexBox& cells, PrimitiveFill& fill) {
  fill.cells = cells;
  const std::size_t count = cells.volume();
  for (std::vector<double>* v : {&fill.density, &fill.temperature, &fill.pressure,
                                 &fill.velocity[0], &fill.velocity[1], &fill.velocity[2]})
    v->assign(count, 0.0);
}

IndexBox cells_to_fill(const IceScene& scene, const PhysicalConstants& constants,
                       const Level& level, const IndexBox& cells) {
  IndexBox wider = cells;
  for (int d = 0; d < 3 && is_hydrostatic(scene, constants, level); ++d)
    if (carried_gravity(constants, level)[d] != 0) wider.lower[d] = level.domain.lower[d];
  return wider;
}

Vec3 carried_gravity(const PhysicalConstants& constants, const Level& level) {
  Vec3 g = constants.gravity;
  for (int d = 0; d < 3; ++d)
    if (level.periodic[d]) g[d] = 0;
  return g;
}

bool is_hydrostatic(const IceScene& scene, const PhysicalConstants& constants, const Level& level) {
  return scene.hydrostatic_start && !(carried_gravity(constants, level) == Vec3{});
}

void apply_starts(const IceScene& scene, const PhysicalConstants& constants, const IceMaterial& m,
                  const Level& coarsest, const Level& level, PrimitiveFill& fill) {
  for (std::size_t n = 0; n < fill.density.size(); ++n)
    fill.pressure[n] = law_pressure(m, fill.density[n], fill.temperature[n]);
  if (!scene.custom.empty())
    apply_custom(scene, constants.reference_pressure, m, coarsest, level, fill);
  if (scene.formula) apply_formula(*scene.formula, m, level, fill);
}

double depth_below_reference(Vec3 g, const Level& coarsest, const Level& level) {
  double sum = 0;
  if (level.index != coarsest.index)
    for (int d = 0; d < 3; ++d)
      sum +=
          g[d] * (level.centre(level.domain.lower)[d] - coarsest.centre(coarsest.domain.lower)[d]);
  return sum;
}

// The pressure over `below` and its density; a density that follows the pressure is searched for:
// each round is better by g dx/c^2.
void apply_hydrostatics(const PhysicalConstants& constants, const IceMaterial& m,
                        const Level& coarsest, const Level& level, PrimitiveFill& fill) {
  constexpr int max_rounds = 100;
  const Vec3 g = carried_gravity(constants, level);
  const double below_reference = depth_below_reference(g, coarsest, level);
  const auto balanced = [&](IntVec3 c, std::size_t n) {
    for (int d = 2; d >= 0; --d) {
      if (g[d] == 0 || c[d] == level.domain.lower[d]) continue;
      IntVec3 below = c;
      below[d] -= 1;
      const std::size_t b = fill.offset(below);
      return fill.pressure[b] + 0.5 * g[d] * level.spacing[d] * (fill.density[b] + fill.density[n]);
    }
    if (below_reference == 0) return constants.reference_pressure;
    return constants.reference_pressure + below_reference * fill.density[n];
  };
  for_each_cell(fill.cells, [&](IntVec3 c) {
    const std::size_t n = fill.offset(c);
    const Keeps keeps =
        what_is_kept(m, fill.density[n], fill.temperature[n], constants.reference_pressure);
    double pressure = balanced(c, n);
    for (int round = 0; keeps == Keeps::temperature && round < max_rounds; ++round) {
      set_pressure(m, keeps, pressure, n, fill);
      const double next = balanced(c, n);
      if (next == pressure) break;
      pressure = next;
    }
    set_pressure(m, keeps, pressure, n, fill);
  });
}

void check_admissible(const IceMaterial& m, const Level& level, IntVec3 c, std::size_t n,
                      const PrimitiveFill& fill) {
  const double density = fill.density[n], pressure = fill.pressure[n];
  const double energy = m.fluid.energy_from_pressure(density, pressure, fill.temperature[n]);
  if (density > 0 && pressure > m.fluid.lowest_pressure() && m.fluid.admissible(density, energy))
    return;
  const Vec3 x = level.centre(c);
  throw DeckError(
      m.where,
      fmt::format("ICE material {} starts with density {:g} and pressure {:g} in cell [{}, {}, {}] "
                  "at ({:g}, {:g}, {:g}), which is inadmissible for its equation of state: the "
                  "density must be above 0, the pressure above {:g}",
                  m.index, density, pressure, c.x, c.y, c.z, x.x, x.y, x.z,
                  m.fluid.lowest_pressure()),
      "see docs/theory_eos.md");
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

void apply_flame(const models::FlameStart& start, const Level& level, PrimitiveFill& fill) {
  const std::size_t along = start.velocity.axis;
  for_each_cell(fill.cells, [&](IntVec3 c) {
    const std::size_t n = fill.offset(c);
    const Vec3 x = level.centre(c);
    fill.density[n] = start.density.at(x);
    fill.temperature[n] = start.temperature.at(x);
    fill.pressure[n] = start.pressure.at(x);
    for (std::size_t d = 0; d < 3; ++d)
      fill.velocity[d][n] = d == along ? start.velocity.at(x) : 0.0;
  });
}

void apply_mixture(const models::ModelList& models, int material, const Level& level,
                   PrimitiveFill& fill) {
  if (!models.mixed || models.mixed->material != material) return;
  if (models.mixed->species && models.mixed->species->start)
    return apply_flame(*models.mixed->species->start, level, fill);
  if (!models.mixed->start_density) return;
  const auto fraction =
      std::find_if(models.scalars.begin(), models.scalars.end(),
                   [&](const auto& s) { return s.name == models.mixed->fractions.front(); });
  for_each_cell(fill.cells, [&](IntVec3 c) {
    fill.density[fill.offset(c)] =
        models.mixed->density_at_start(fraction->at_start(level.centre(c)));
  });
}

PrimitiveFill fill_primitives(const IceScene& scene, const PhysicalConstants& constants,
                              const IceMaterial& material, const Level& coarsest,
                              const Level& level, const IndexBox& cells) {
  PrimitiveFill fill;
  size_fill(cells_to_fill(scene, constants, level, cells), fill);
  apply_objects(material, scene.solids > 0, level, fill);
  apply_mixture(scene.models, material.index, level, fill);
  apply_starts(scene, constants, material, coarsest, level, fill);
  if (is_hydrostatic(scene, constants, level))
    apply_hydrostatics(constants, material, coarsest, level, fill);
  for_each_cell(fill.cells,
                [&](IntVec3 c) { check_admissible(material, level, c, fill.offset(c), fill); });
  if (fill.cells == cells) return fill;  // moved, not copied
  return cut(fill, cells);
}

}  // namespace sluice::ice
