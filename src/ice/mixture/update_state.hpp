// What the updates of mixtures have in common, with one velocity (update.cpp) or several
// (multi_velocity/update.cpp): what they read and write, cells of one material, the end of a row.
#pragma once
#include <algorithm>

#include "ice/closure/cell_closure.hpp"
#include "ice/mixture/diffusion_rates.hpp"
#include "ice/mixture/surface.hpp"
#include "ice/mixture/tasks.hpp"
#include "ice/one_material/update_rows.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {

struct MaterialState {
  In mass, volume;
  Out mass_new, volume_new, energy_new;
};

// Cells that solids touch: they take no part in the rules here. What is left in them are amounts
// per volume of the cell, and, in place of theta, what momentum leaves to kinetic energy and heat.
struct CutCells {
  bool any = false;
  In cells, gives_old, volume_L, energy_L, frame, before, next, old_momentum;
  std::array<In, 3> velocity;  // of each material at faces, where each has its own
  std::vector<In> old_energy;
  Out kinetic;
};

struct UpdateState {
  UpdateHandles common;
  In stretch, energy_L, pure;
  In strain;               // where the materials of a cell relax before the remap
  In surface;              // where a gas slips along one
  bool closes = true;      // else one pressure is found later: one_pressure.cpp
  std::array<In, 3> flux;  // of each material
  std::vector<MaterialState> state;
  Out end, pressure, closure;  // density and modulus of the new mixture; closure of one material
  std::vector<Out> slip_new;   // where each material has a velocity of its own
  SourceHandles sources;
  CutCells cut;  // beside solids
};
void declare_update(TaskBuilder& task, const UpdateInput& v, const SchemeOptions& o,
                    UpdateState& h);

// The options of each material alone.
std::vector<SchemeOptions> options_of_materials(const SchemeOptions& o);
// What the update of material m alone calls its own.
UpdateHandles handles_of(const UpdateState& h, int m);
// What of a surface a cell holds, for the heat that passes it.
inline HeatExchange::Surface surface_of(const Row& row, const UpdateState& h,
                                        const SchemeOptions& o, int i) {
  if (!o.materials.multi_velocity_exchange) return {};
  return {row(h.surface, SurfaceParts::share)[i], row(h.surface, SurfaceParts::heat)[i]};
}
// Where material m is alone the others have nothing.
void leave_alone(const Row& row, const UpdateState& h, int m, int components);
// Density, pressure and modulus of the mixture where `fluid` is alone.
void end_alone(const Row& row, const UpdateState& h, const UpdateHandles& u, const Fluid& fluid);

// Adds the sources to the new state; the density of the mixture follows.
enum class Motion { apart, bound };
void add_sources(const Row& row, const UpdateState& h, const SchemeOptions& o,
                 Motion motion = Motion::apart);

// Rows where material m is alone, and its neighbours; `o`: the options of that material. True: they
// may hold others now, and need one pressure.
template <int D, int C>
bool update_alone(const Row& row, const UpdateState& h, const SchemeOptions& o, int m) {
  const UpdateHandles u = handles_of(h, m);
  update_row<D, C>(row, u);
  leave_alone(row, h, m, C);
  if (h.closes) mark_alone(row, o.forces.sources == nullptr ? m : -1);
  if (o.forces.sources != nullptr) {
    add_sources(row, h, o);
    if (o.forces.sources->takes_from(m, row.step())) return true;
  }
  if (!h.closes) return false;
  check_row(row, u, o, m);
  end_alone(row, h, u, o.materials.fluid);
  return false;
}

// Tells the step what is not admissible about the new state of cell i. rho: kg/m^3; inverse_J: 1/J,
// a ratio of volumes; `E`: energy of each material per volume of the cell, J/m^3.
void tell_faults(const Row& row, const Axes& axes, int i, double rho, double inverse_J,
                 const Equilibration::Result& closed, const double* E);

// Finds the one pressure of cell i, whose new state is there but for that.
class ClosingCells {
 public:
  ClosingCells(const Row& row, const UpdateState& h, const SchemeOptions& o);
  void close(int i, const CellClosure& closure) const;

 private:
  const Row& row_;
  const UpdateState& h_;
  const SchemeOptions& o_;
  int materials_;
  const double *inverse_J_, *density_;
  double *pressure_, *modulus_;
  double *mass_[max_materials], *volume_[max_materials], *energy_[max_materials];
};

// Over the whole row: in runs of one material alone too.
void diffusion_rates_of_row(const Row& row, const UpdateState& h, const DiffusionRates& diffusion);

}  // namespace sluice::ice::mixture
