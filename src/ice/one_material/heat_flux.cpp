// Heat conduction (Fourier): temperature of the old state, and what passes through faces.
//
//   q = -k dT/dn,   dT/dn from the two cells of the face, k one number or their harmonic mean
// On a wall with a temperature of its own dT/dn is taken over half a cell; a wall with a given
// gradient has that, one without either lets no heat through. Of rarefied gas that slips the
// temperature on the wall is that of the gas there. A gas that is a mixture has k and cv of its
// fraction, and what spreads of it carries enthalpy: transport/mixed_heat.cpp. Absent without
// conduction.
#include "ice/conditions/wall_slip.hpp"
#include "ice/fluid/face_mean.hpp"
#include "ice/one_material/heat_flux_rows.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/step/variables.hpp"
#include "ice/step/wall_faces.hpp"
#include "ice/transport/mixed_heat.hpp"
#include "ice/transport/species_transport.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In temperature, conductivity;
  In rho, energy, pressure, velocity, viscosity;  // slip alone
  scalars::SpreadingHandles spreading;            // a mixed gas alone
  SpeciesFluxHandles species;                     // of species that spread
  LawsOfCells laws;                               // with eddies or slip
  Out flux;
};

// The temperature of gas that slips on the wall at face i.
double gas_on_wall(const Row& row, const Handles& h, const SchemeOptions& o, int axis,
                   const WallHeat& wall, double conductivity, bool plus, int i) {
  const int inside = plus ? -1 : 0;
  const auto cell = [&](In in, int c, int shift) { return row(in, c, axis, shift)[i]; };
  SlipHeat gas;
  gas.rho = cell(h.rho, 0, inside);
  gas.p = cell(h.pressure, 0, inside);
  gas.temperature = cell(h.temperature, 0, inside);
  Fluid room;
  gas.specific_heat = h.laws.of_one(row, axis, inside)
                          .at(i, room)
                          .heat_capacity(gas.rho, cell(h.energy, 0, inside));
  gas.viscosity = o.molecular_varies() ? cell(h.viscosity, 0, inside) : o.transport.viscosity;
  gas.conductivity = conductivity;
  gas.spacing = row.step().spacing[o.grid.axes.direction[axis]];
  gas.wall_temperature = wall.temperature;
  double change = 0;  // from cell to cell, squared
  for (int c = 0; c < o.grid.components; ++c) {
    if (c == axis) continue;
    const double du = cell(h.velocity, c, 0) - cell(h.velocity, c, -1);
    change += du * du;
  }
  gas.shear = change / (gas.spacing * gas.spacing);
  return slip_temperature(*o.grid.boundary->conditions().slip, gas);
}

template <bool varies>
void flux_row(const Row& row, const Handles& h, const SchemeOptions& o, int axis) {
  const int n = row.count();
  const double dx = row.step().spacing[o.grid.axes.direction[axis]], inverse = 1.0 / dx;
  const double k = o.transport.conductivity;
  const double* __restrict Ta = row(h.temperature, 0, axis, -1);
  const double* __restrict Tb = row(h.temperature);
  const double* __restrict ka = varies ? row(h.conductivity, 0, axis, -1) : nullptr;
  const double* __restrict kb = varies ? row(h.conductivity) : nullptr;
  double* __restrict q = row(h.flux);
  if constexpr (varies)
    heat_flux_row(n, ka, kb, Ta, Tb, inverse, q);
  else
    heat_flux_row(n, k, Ta, Tb, inverse, q);
  // Subgrid motion ends at walls.
  const auto conductivity_on_wall = [&](int i) {
    if (!varies) return k;
    if (!o.transport.models.turbulence) return harmonic_mean(ka[i], kb[i]);
    if (h.laws.all_plain()) return k;
    const auto molecular = [&](int shift) {
      return h.laws.of_one(row, axis, shift).conductivity(i, k);
    };
    return harmonic_mean(molecular(-1), molecular(0));
  };
  for_each_wall_face(row, o, axis, [&](int i, bool plus) {
    IntVec3 cell = row.cell();
    cell[o.grid.axes.direction[0]] += i;
    const WallHeat& wall = o.grid.boundary->wall_heat(side_of(o.grid.axes.direction[axis], plus),
                                                      cell, o.materials.index);
    const double inside = plus ? Ta[i] : Tb[i];
    const double k_wall = conductivity_on_wall(i);
    double outward = 0;
    if (wall.slip) {
      const double rise = 2.0 * (gas_on_wall(row, h, o, axis, wall, k_wall, plus, i) - inside);
      outward = k_wall * (-rise * inverse);
    } else {
      outward = heat_to_wall(wall, k_wall, inside, dx, inverse);
    }
    q[i] = plus ? outward : -outward;
  });
}

void add_temperature(TaskList& list, const HeatFluxInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("temperature", effect);
  const In rho = task.read(v.rho), energy = task.read(v.energy);
  const Out temperature = task.write(v.temperature);
  const LawsOfCells laws(task, list, o);
  task.kernel([=](const Row& row) {
    laws.of_one(row).temperature(row.count(), row(rho), row(energy), row(temperature));
  });
}

}  // namespace

void add_heat_flux(TaskList& list, const HeatFluxInput& v, const SchemeOptions& o, int effect) {
  if (!o.transport.conducting) return;
  add_temperature(list, v, o, effect);
  const bool mixes = o.materials.mixed != nullptr,
             turbulent = o.transport.models.turbulence.has_value();
  if (mixes && !turbulent && !o.materials.mixed->species)
    scalars::add_conductivity(list, v.conductivity, o, effect);
  static const char* names[] = {"heat flux on axis 0", "heat flux on axis 1",
                                "heat flux on axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    TaskBuilder task = list.task(names[axis], effect);
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 1, 0);
    Handles h;
    h.temperature = task.read(v.temperature, both);
    if (o.transport.conductivity_varies) h.conductivity = task.read(v.conductivity, both);
    const bool slips = o.grid.boundary != nullptr && o.grid.boundary->has_heat_slip();
    if (slips) {
      h.rho = task.read(v.rho, both);
      h.energy = task.read(v.energy, both);
      h.pressure = task.read(v.pressure, both);
      h.velocity = task.read(v.velocity, both);
      if (o.molecular_varies())
        h.viscosity = task.read(turbulent ? v.molecular_viscosity : v.viscosity, both);
    }
    if (mixes) h.spreading = scalars::read_spreading(task, list, v.rho, o, axis);
    h.species = read_species_flux(task, list, {v.rho, v.diffusivity}, o, axis);
    if (turbulent || slips) h.laws = LawsOfCells(task, list, o, LawsOfCells::When::old_state, both);
    h.flux = task.write(v.heat_flux[axis]);
    task.kernel([=](const Row& row) {
      if (o.transport.conductivity_varies)
        flux_row<true>(row, h, o, axis);
      else
        flux_row<false>(row, h, o, axis);
      scalars::add_carried_enthalpy(row, h.spreading, h.temperature, o, axis, row(h.flux));
      add_species_enthalpy(row, h.species, h.temperature, o, axis, row(h.flux));
    });
  }
}

}  // namespace sluice::ice
