#include "ice/start/initialise.hpp"

#include <fmt/format.h>

#include "framework/deck/faults.hpp"
#include "ice/closure/equilibrate.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/start/initial_state_parts.hpp"
#include "ice/start/material_fill.hpp"
#include "ice/step/laws_of_cells.hpp"

namespace sluice::ice {
namespace {

// No pressure suits the materials of a cell as the deck has them.
[[noreturn]] void refuse_start(const IceScene& scene, const MixtureFill& fill, std::size_t n,
                               IntVec3 cell, int level, int failed) {
  std::string states;
  for (std::size_t m = 0; m < fill.materials.size(); ++m) {
    const MaterialFill& f = fill.materials[m];
    if (f.volume_fraction[n] == 0.0) continue;
    const Fluid& fluid = scene.materials[m].fluid;
    states += fmt::format(
        "\n  material {} ('{}'): volume fraction {:g}, density {:g} kg/m^3, temperature {:g} K, "
        "pressure {:g} Pa (its equation of state allows more than {:g})",
        m, scene.materials[m].name, f.volume_fraction[n], f.density[n], f.temperature[n],
        f.pressure[n], fluid.lowest_pressure() + 0.0);  // no "-0"
  }
  const IceMaterial& material = scene.materials[failed];
  throw DeckError(
      material.where,
      fmt::format("initial state: the materials of cell [{}, {}, {}] of level {} have no common "
                  "pressure; material {} ('{}') has no admissible state:{}\n  ",
                  cell.x, cell.y, cell.z, level, failed, material.name, states),
      "give materials that share a cell densities and temperatures of about the same pressure");
}

// Of a material of a mixture: its fields in the state.
struct Slots {
  int mass = 0, volume = 0, energy = 0, slip = 0;
};

std::vector<Slots> slots_of(const SchemeOptions& options, const Warehouse& state) {
  std::vector<Slots> slots(options.materials.fluids.size());
  for (std::size_t m = 0; m < slots.size(); ++m) {
    const int place = options.place(static_cast<int>(m));
    slots[m] = {state.find(labels().mass, place), state.find(labels().volume, place),
                state.find(labels().energy, place),
                options.materials.multi_velocity ? state.find(labels().slip, place) : -1};
  }
  return slots;
}

// The state of one scene.
class Start {
 public:
  Start(const Scene& scene, const IceScene& ice, const SchemeOptions& options)
      : scene_(&scene), ice_(ice), options_(options) {}

  void one_material(Warehouse& state) const;
  void materials(Warehouse& state) const;
  void scalars(Warehouse& state) const;

 private:
  // The law of material m in the cell with this centre; `room` holds one that is made for it.
  const Fluid& law(std::size_t m, Vec3 centre, Fluid& room) const;
  double energy(std::size_t m, const Fluid& law, const PrimitiveFill& fill, std::size_t n) const;

  const Scene* scene_;
  const IceScene& ice_;
  const SchemeOptions& options_;
};

void Start::one_material(Warehouse& state) const {
  const IceMaterial& m = ice_.materials.front();
  const int mass = state.find(labels().mass, options_.place(0)),
            momentum = state.find(labels().momentum, options_.place(0)),
            energy_slot = state.find(labels().energy, options_.place(0));
  Fluid room;
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const IndexBox cells = state.local_boxes()[b].cells;
    const PrimitiveFill fill = fill_primitives(ice_, scene_->constants, m,
                                               scene_->grid.levels.front(), state.level(), cells);
    std::size_t n = 0;
    for_each_cell(cells, [&](IntVec3 cell) {
      state.view(mass, 0, b)(cell) = fill.density[n];
      state.view(energy_slot, 0, b)(cell) =
          energy(0, law(0, state.level().centre(cell), room), fill, n);
      for (int c = 0; c < options_.grid.components; ++c)
        state.view(momentum, c, b)(cell) =
            fill.density[n] * fill.velocity[options_.grid.direction[c]][n];
      ++n;
    });
  }
}

const Fluid& Start::law(std::size_t m, Vec3 centre, Fluid& room) const {
  if (!is_mixed(options_, m)) return options_.materials.fluids[m];
  double values[models::max_species];
  FractionRows rows;
  std::size_t k = 0;
  for (const models::TransportedScalar* f : fractions_of(options_)) {
    values[k] = f->at_start(centre);
    rows.of[k] = &values[k];
    ++k;
  }
  return room = fluid_of(*options_.materials.mixed, rows);
}

// What holds beside the density is the pressure. That of a law which differs from cell to cell
// follows from the temperature, but where it is that of the weight or of a formula.
double Start::energy(std::size_t m, const Fluid& law, const PrimitiveFill& fill,
                     std::size_t n) const {
  const bool pressure_holds =
      !is_mixed(options_, m) ||
      is_hydrostatic(ice_, scene_->constants, scene_->grid.levels.front()) ||
      (ice_.formula && ice_.formula->pressure);
  if (!pressure_holds) return law.energy_from_temperature(fill.density[n], fill.temperature[n]);
  return law.energy_from_pressure(fill.density[n], fill.pressure[n], fill.temperature[n]);
}

// Writes only what differs: memory of an absent material stays untouched.
void Start::materials(Warehouse& state) const {
  const auto put = [](double& at, double value) {
    if (at != value) at = value;
  };
  mixture::Equilibration equilibration(options_.materials.fluids);
  const WeightProfile weight =
      weight_profile(ice_, scene_->constants, scene_->grid.levels.front(), state.level());
  const std::vector<Slots> slots = slots_of(options_, state);
  const int momentum_slot = state.find(labels().momentum, options_.place(0));
  Fluid room;
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const IndexBox cells = state.local_boxes()[b].cells;
    const MixtureFill fill = fill_materials(ice_, scene_->constants, scene_->grid.levels.front(),
                                            state.level(), cells, weight);
    std::size_t n = 0;
    for_each_cell(cells, [&](IntVec3 cell) {
      double M[max_materials], V[max_materials], E[max_materials];
      double momentum[3] = {0, 0, 0}, rho = 0;
      for (std::size_t m = 0; m < fill.materials.size(); ++m) {
        const MaterialFill& f = fill.materials[m];
        M[m] = V[m] = E[m] = 0.0;
        if (f.volume_fraction[n] == 0.0) continue;
        const Fluid& fluid = law(m, state.level().centre(cell), room);
        if (is_mixed(options_, m)) equilibration.set_law(static_cast<int>(m), fluid);
        V[m] = f.volume_fraction[n];
        M[m] = V[m] * f.density[n];
        rho += M[m];
        E[m] = V[m] * energy(m, fluid, f, n);
        for (int d = 0; d < 3; ++d) momentum[d] += M[m] * f.velocity[d][n];
      }
      const int failed = equilibration.equilibrate({M, V, E}).failed;
      if (failed >= 0) refuse_start(ice_, fill, n, cell, state.level().index, failed);
      for (std::size_t m = 0; m < slots.size(); ++m) {
        put(state.view(slots[m].mass, 0, b)(cell), M[m]);
        put(state.view(slots[m].volume, 0, b)(cell), V[m]);
        put(state.view(slots[m].energy, 0, b)(cell), E[m]);
      }
      for (int c = 0; c < options_.grid.components; ++c)
        state.view(momentum_slot, c, b)(cell) = momentum[options_.grid.direction[c]];
      for (std::size_t m = 0; m < fill.materials.size() && options_.materials.multi_velocity; ++m)
        for (int c = 0; c < options_.grid.components; ++c) {
          const int d = options_.grid.direction[c];
          const double u = fill.materials[m].velocity[d][n];
          const bool apart = M[m] > 0 && M[m] != rho;
          put(state.view(slots[m].slip, c, b)(cell), apart ? M[m] * (u - momentum[d] / rho) : 0.0);
        }
      ++n;
    });
  }
}

// At cell centres; where there is nothing of the material there is no scalar. A mixture has given
// its heat of mixing at the start: the deck says its state. As above, only what differs is written.
void Start::scalars(Warehouse& state) const {
  const auto at_start = [&](const models::TransportedScalar& s, Vec3 x) {
    if (!s.plain_name) return s.at_start(x);
    return options_.materials.mixed->heat(fraction_of(options_).at_start(x));
  };
  for (const models::TransportedScalar& s : ice_.models.scalars)
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
      const RealView value = state.view(state.find(s.state(), options_.place(s.material)), 0, b);
      const RealView mass = state.view(state.find(labels().mass, options_.place(s.material)), 0, b);
      for_each_cell(state.local_boxes()[b].cells, [&](IntVec3 cell) {
        const double start = mass(cell) > 0.0 ? at_start(s, state.level().centre(cell)) : 0.0;
        if (value(cell) != start) value(cell) = start;
      });
    }
}

}  // namespace

void initialise(Warehouse& state, const Scene& scene, const IceScene& ice,
                const SchemeOptions& options) {
  const Start start(scene, ice, options);
  if (options.materials.fluids.size() > 1)
    start.materials(state);
  else
    start.one_material(state);
  start.scalars(state);
}

}  // namespace sluice::ice
