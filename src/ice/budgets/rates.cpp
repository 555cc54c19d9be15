#include "ice/budgets/rates.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "ice/closure/drag.hpp"
#include "ice/closure/equilibrate.hpp"
#include "ice/fluid/closure_rows.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/fluid/laws_in_box.hpp"
#include "ice/mixture/diffusion_rates.hpp"
#include "ice/scalars/variables.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/step/step_bounds.hpp"
#include "ice/transport/species_transport.hpp"
#include "ice/transport/viscosity.hpp"
#include "kinetics/transport.hpp"

namespace sluice::ice {
namespace {

// Density and modulus (rho c^2) of the cells of one box.
class CellStates {
 public:
  CellStates(const Warehouse& state, const SchemeOptions& o, int box)
      : state_(state),
        box_(box),
        fluids_(o.materials.fluids),
        laws_{o.materials.fluids, o.materials.mixed},
        equilibration_(o.materials.fluids) {
    const std::vector<Fluid>& fluids = fluids_;
    const bool multi_velocity = o.materials.multi_velocity;
    const auto view = [&](Label label, int m) {
      return state.view(state.find(label, o.place(m)), 0, box);
    };
    for (int m = 0; m < static_cast<int>(fluids.size()); ++m) {
      mass_.push_back(view(labels().mass, m));
      energy_.push_back(view(labels().energy, m));
      if (fluids.size() > 1) volume_.push_back(view(labels().volume, m));
      if (multi_velocity) slip_.push_back(state.find(labels().slip, o.place(m)));
    }
    if (!laws_.all_plain())
      for (const models::TransportedScalar* f : fractions_of(o))
        laws_.fractions.push_back(view(f->state(), laws_.gas->material));
  }

  struct State {
    double rho = 0, modulus = 0;
  };
  State at(IntVec3 cell) {
    if (fluids_.size() == 1) return of_one(0, mass_[0](cell), energy_[0](cell));
    double M[max_materials], V[max_materials], E[max_materials];
    double rho = 0;
    for (std::size_t m = 0; m < fluids_.size(); ++m) {
      M[m] = mass_[m](cell);
      V[m] = volume_[m](cell);
      E[m] = energy_[m](cell);
      rho += M[m];
    }
    if (!laws_.all_plain()) {
      // Where the gas is alone its largest gamma holds, as in a step.
      const std::size_t gas = laws_.gas->material;
      bool alone = M[gas] != 0.0;
      for (std::size_t m = 0; m < fluids_.size(); ++m) alone = alone && (m == gas || M[m] == 0.0);
      if (alone) return of_one(gas, M[gas], E[gas]);
      laws_.set(equilibration_, cell);
    }
    return {rho, equilibration_.look({M, V, E}).modulus};
  }
  // Those that share the cell and have velocities of their own.
  mixture::DragCell sharing(IntVec3 cell) const {
    mixture::DragCell present;
    if (slip_.empty()) return present;
    const mixture::MaterialRows s = materials(cell);
    mixture::find_present(static_cast<int>(fluids_.size()), s.mass, s.volume, 0, present);
    if (present.count < 2) present.count = 0;
    return present;
  }
  // How much faster than the mixture material n of those is along component c.
  double slip(const mixture::DragCell& present, int n, IntVec3 cell, int c) const {
    const std::size_t m = present.index[n];
    return state_.view(slip_[m], c, box_)(cell) / present.M[n];
  }
  // rho times the largest diffusivity of species that spread.
  double species_totals(IntVec3 cell, kinetics::Transport& transport) const {
    return species_coefficient(*laws_.gas->species->gas, transport, mass_[0](cell),
                               energy_[0](cell), laws_.rows(cell));
  }
  double temperature(IntVec3 cell) const {
    return fluids_.front().temperature(mass_[0](cell), energy_[0](cell));
  }
  double heat_capacity(IntVec3 cell) const {
    const Fluid& fluid = fluids_.front();
    double cv = 0;
    const double rho = mass_[0](cell), E = energy_[0](cell);
    heat_capacity_row(fluid, 1, &rho, &E, &cv);
    return cv;
  }
  double heat_capacity_ratio(IntVec3 cell) const {
    return fluids_.front().heat_capacity_ratio(mass_[0](cell), energy_[0](cell));
  }
  // Of several materials.
  mixture::MaterialRows materials(IntVec3 cell) const {
    mixture::MaterialRows rows{};
    for (std::size_t m = 0; m < fluids_.size(); ++m) {
      rows.mass[m] = &mass_[m](cell);
      rows.volume[m] = &volume_[m](cell);
      rows.energy[m] = &energy_[m](cell);
    }
    return rows;
  }

 private:
  State of_one(std::size_t m, double rho, double E) const {
    return {rho, fluids_[m].modulus_of_state(rho, E)};
  }

  const Warehouse& state_;
  int box_;
  std::vector<int> slip_;
  const std::vector<Fluid>& fluids_;
  LawsInBox laws_;
  mixture::Equilibration equilibration_;
  std::vector<RealView> mass_, energy_, volume_;
};

// The larger of mu and k/cv of one gas (kg/(m s)), or the rate of a mixture. Subgrid viscosity
// needs ghost cells: without them it is left out, and the dynamic model's constant is that of
// isotropic turbulence.
class Diffusion {
 public:
  Diffusion(const Warehouse& state, SchemeOptions options, int box)
      : o_(std::move(options)), spacing_(state.level().spacing) {
    const int mass = state.find(labels().mass, o_.place(0)),
              momentum = state.find(labels().momentum, o_.place(0));
    for (int m = 0; m < static_cast<int>(o_.materials.fluids.size()); ++m)
      mass_.push_back(state.view(state.find(labels().mass, o_.place(m)), 0, box));
    for (int c = 0; c < o_.grid.components; ++c) momentum_.push_back(state.view(momentum, c, box));
    with_eddies_ = o_.transport.models.turbulence.has_value() && state.info(mass).ghosts > 0;
    if (o_.transport.spreads_species)
      species_ = std::make_unique<kinetics::Transport>(*o_.materials.mixed->species->gas);
  }

  double coefficient(const CellStates& states, IntVec3 cell) const {
    if (species_ != nullptr) return states.species_totals(cell, *species_);
    const double mu = molecular(0, cell, [&] { return states.temperature(cell); });
    const double eddy = with_eddies_ ? eddy_viscosity(cell) : 0.0;
    if (!o_.transport.conducting) return mu;
    const double k_over_cv = o_.transport.conductivity / states.heat_capacity(cell);
    if (!o_.transport.models.turbulence) return std::max(mu, k_over_cv);
    const double share = states.heat_capacity_ratio(cell) / o_.transport.models.turbulence->prandtl;
    return std::max(mu + eddy, k_over_cv + share * eddy);
  }
  // Of several materials: 2 D sum 1/dx^2.
  double rate(const CellStates& states, const mixture::DiffusionRates& rates, IntVec3 cell) const {
    mixture::MaterialRows s = states.materials(cell);
    const double eddy = with_eddies_ ? eddy_viscosity(cell) : 0.0, rho = density(cell);
    double viscosity = eddy, conductivity[max_materials] = {};
    s.viscosity = &viscosity;
    for (std::size_t m = 0; m < o_.materials.fluids.size(); ++m) {
      s.conductivity[m] = conductivity + m;
      if (*s.mass[m] == 0.0) continue;
      const double r = *s.mass[m] / *s.volume[m], e = *s.energy[m] / *s.volume[m];
      const Fluid& fluid = o_.materials.fluids[m];
      viscosity += *s.volume[m] * molecular(m, cell, [&] { return fluid.temperature(r, e); });
      conductivity[m] = o_.transport.conductivities[m];
      if (o_.transport.models.turbulence)
        conductivity[m] += fluid.heat_capacity_ratio(r, e) /
                           o_.transport.models.turbulence->prandtl * fluid.heat_capacity(r, e) *
                           (eddy * (r / rho));
    }
    return rates.largest(s, 1, spacing_);
  }

 private:
  // `temperature`(): of the material.
  template <class Temperature>
  double molecular(std::size_t m, IntVec3 cell, Temperature temperature) const {
    const TransportModels& models = o_.transport.models_of_each[m];
    double mu = models.sutherland ? models.sutherland->viscosity(temperature())
                                  : o_.transport.viscosities[m];
    for (const TransportModels::Sponge& sponge : models.sponges)
      if (sponge.cells.contains(cell)) mu = std::max(mu, sponge.viscosity);
    return mu;
  }
  double density(IntVec3 cell) const {
    double sum = 0;
    for (const RealView& mass : mass_) sum += mass(cell);
    return sum;
  }
  double slope(IntVec3 cell, int c, int axis) const {
    if (axis >= o_.grid.axes.count) return 0;
    const int d = o_.grid.axes.direction[axis];
    IntVec3 below = cell, above = cell;
    --below[d];
    ++above[d];
    const RealView& m = momentum_[c];
    return (m(above) / density(above) - m(below) / density(below)) / (2 * spacing_[d]);
  }
  double eddy_viscosity(IntVec3 cell) const {
    // coefficient: Smagorinsky's constant of isotropic turbulence (Lilly 1967); unit: 1
    constexpr double isotropic = 0.17;
    double squared = 0;  // 2 S:S
    for (int a = 0; a < o_.grid.components; ++a)
      for (int b = 0; b < o_.grid.components; ++b) {
        const double twice = slope(cell, a, b) + slope(cell, b, a);
        squared += 0.5 * twice * twice;
      }
    const Turbulence& model = *o_.transport.models.turbulence;
    const double length = (model.dynamic ? isotropic : model.constant) * filter_width(o_, spacing_);
    return density(cell) * length * length * std::sqrt(squared);
  }

  SchemeOptions o_;
  Vec3 spacing_;
  std::vector<RealView> mass_, momentum_;
  bool with_eddies_ = false;
  std::unique_ptr<kinetics::Transport> species_;  // of species that spread
};

// Adds what a velocity along each axis and sound make of the rates of one cell.
class Waves {
 public:
  Waves(const SchemeOptions& o, const Level& level, const PartReductions& rates)
      : o_(o), rates_(rates) {
    double dx_g = 0;
    for (int a = 0; a < o.grid.axes.count; ++a) {
      const int d = o.grid.axes.direction[a];
      dx_[a] = level.spacing[d];
      dx_g += dx_[a] * std::fabs(o.forces.gravity[d]);
    }
    gravity_speed_ = std::sqrt(dx_g);
  }

  // The deck's conservative rule is about the mixture alone.
  void add_mixture(const double* velocity, double c) const {
    if (o_.scheme.conservative_time_step) {
      double outflow = 0;
      const double margin = o_.scheme.sound_speed_factor * c + gravity_speed_;
      for (int a = 0; a < o_.grid.axes.count; ++a) {
        const double u = std::fabs(velocity[a]);
        outflow += (std::max(0.0, u + margin) + std::max(0.0, margin - u)) / dx_[a];
      }
      rates_.maximum(StepSlots::deck_rate, ordered_bits(outflow));
    }
    add(velocity, c);
  }
  void add(const double* velocity, double c) const {
    double deck = 0, flow = 0, sound = 0, sum = 0;
    for (int a = 0; a < o_.grid.axes.count; ++a) {
      const double u = std::fabs(velocity[a]), dx = dx_[a];
      deck = std::max(deck, (u + o_.scheme.sound_speed_factor * c) / dx);
      flow += u / dx;
      sound = std::max(sound, (u + c) / dx);
      sum += (u + c) / dx;
    }
    sound = std::max(sound, sound_sum_share(o_) * sum);
    if (!o_.scheme.conservative_time_step) rates_.maximum(StepSlots::deck_rate, ordered_bits(deck));
    rates_.maximum(StepSlots::flow_rate, ordered_bits(flow));
    rates_.maximum(StepSlots::sound_rate, ordered_bits(sound));
  }

 private:
  const SchemeOptions& o_;
  const PartReductions& rates_;
  double dx_[3] = {1, 1, 1}, gravity_speed_ = 0;
};

}  // namespace

bool diffusive(const SchemeOptions& o) {
  return o.transport.viscous || o.transport.conducting ||
         std::any_of(o.materials.scalars.begin(), o.materials.scalars.end(),
                     [](const models::TransportedScalar& s) { return s.diffusivity > 0; });
}

void measure_rates(const Warehouse& state, const SchemeOptions& o, const PartReductions& rates) {
  const int momentum = state.find(labels().momentum, o.place(0));
  const Vec3 spacing = state.level().spacing;
  const Waves waves(o, state.level(), rates);
  const mixture::DiffusionRates of_mixtures(o);
  double inverse_dx2 = 0;
  for (int a = 0; a < o.grid.axes.count; ++a) {
    const double dx = spacing[o.grid.axes.direction[a]];
    inverse_dx2 += 1.0 / (dx * dx);
  }
  if (diffusive(o))
    rates.maximum(StepSlots::diffusion_rate, ordered_bits(scalars::diffusion_rate(o, spacing)));
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    CellStates states(state, o, b);
    const Diffusion diffusion(state, o, b);
    for_each_cell(state.local_boxes()[b].cells, [&](IntVec3 cell) {
      const auto [rho, modulus] = states.at(cell);
      double velocity[3] = {}, own[3] = {};
      for (int a = 0; a < o.grid.axes.count; ++a)
        velocity[a] = state.view(momentum, a, b)(cell) / rho;
      waves.add_mixture(velocity, std::sqrt(modulus / rho));
      const mixture::DragCell present = states.sharing(cell);
      const double of_each =
          present.count > 0 ? std::sqrt(modulus * mixture::Drag::inverse_inertia(present)) : 0.0;
      for (int n = 0; n < present.count; ++n) {
        for (int a = 0; a < o.grid.axes.count; ++a)
          own[a] = velocity[a] + states.slip(present, n, cell, a);
        waves.add(own, of_each);
      }
      if (!o.transport.viscous && !o.transport.conducting) return;
      double rate = 0;
      if (of_mixtures.on() && o.materials.fluids.size() > 1)
        rate = diffusion.rate(states, of_mixtures, cell);
      else
        rate = 2.0 * inverse_dx2 * diffusion.coefficient(states, cell) / rho;
      rates.maximum(StepSlots::diffusion_rate, ordered_bits(rate));
    });
  }
}

}  // namespace sluice::ice
