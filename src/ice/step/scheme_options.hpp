// What the tasks of a step depend on: filled once for a graph, then constant.
#pragma once
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "framework/grid/index_box.hpp"
#include "framework/task/task.hpp"
#include "ice/deck/exchange_settings.hpp"
#include "ice/deck/transport_settings.hpp"
#include "ice/fluid/fluid.hpp"

namespace sluice::models {
class MixedGas;
struct TransportedScalar;
}  // namespace sluice::models

namespace sluice {
struct Level;
struct Scene;
class LevelCoverage;
class VolumeFaces;
struct FluxRecorder;
}  // namespace sluice

namespace sluice::ice {

class BoundaryFill;
struct IceScene;
class Sources;

// The level that a graph is for, and which of its blocks.
struct GridOptions {
  Axes axes;
  int components = 1;                     // of momentum, axes.count <= components <= 3
  std::array<int, 3> direction{0, 1, 2};  // level direction of each component
  const Level* level = nullptr;
  IndexBox domain;  // cells of the physical domain
  std::array<bool, 3> periodic{};
  const BoundaryFill* boundary = nullptr;  // knows the walls
  bool solids = false;                     // some blocks may meet solids
  bool has_cut_cells = false;              // the graph of blocks that solids meet: cut_cells/
  bool meets_coarser = false;  // ghosts of the work pressure may be given by a coarser level
  bool meets_finer = false;    // faces may be given by a finer level: pressure/finer_faces.hpp
  bool shocks_leave = false;   // a level that shocks leave where it ends: recorder->ends
};

// The materials of the scene, what they exchange, and those of a graph.
struct MaterialOptions {
  Fluid fluid;                     // of the one material that this graph is for
  int index = 0;                   // of that material
  bool mixture = false;            // the graph of blocks with several materials
  std::vector<Fluid> fluids;       // of all materials
  PairCoefficients heat_exchange;  // H, W/(m^3 K)
  bool multi_velocity = false;     // several materials that move apart: multi_velocity/tasks.hpp
  PairCoefficients drag;           // K, kg/(m^3 s)
  std::optional<MultiVelocityExchange> multi_velocity_exchange;  // at the surface of one material
  std::optional<ConvectiveExchange> convective;
  std::span<const models::TransportedScalar> scalars;  // of all materials
  // Of the one gas, where its properties follow from a scalar: fluid/mixed_gas.hpp. `fluid` then
  // has its highest gamma and lowest specific heat.
  const models::MixedGas* mixed = nullptr;
  bool releases_heat = false;  // by mixing or reactions
};

// What bounds the density on a face: sharp keeps contacts in slow flow two to three cells wide; as
// energy keeps what is linear in both linear, so that gases of one pressure and temperature raise
// no waves where they mix.
enum class FaceDensityLimiter { sharp, as_energy };

// The numerical scheme and how long its steps may be.
struct MethodOptions {
  bool internal_energy_form = false;  // the classic form, see internal_energy_form/
  bool implicit = false;              // one pressure is solved for, see pressure/
  bool second_order = true;
  bool third_order = false;       // parabolas, see parabolas/; second_order is true too
  bool shears_shocks = false;     // along strong shocks: shock_shear.hpp
  bool compatible_fluxes = true;  // of the classic form
  bool masked = false;            // a redo: slopes vanish where the mask says so
  FaceDensityLimiter density_bound = FaceDensityLimiter::sharp;
  double cfl = 0.4;                     // Courant number
  double sound_speed_factor = 1;        // weight of c in the deck's time-step rule
  double diffusion_factor = 1;          // weight of diffusion in it
  bool conservative_time_step = false;  // Scheme_for_delT_calc
};

// What changes momentum and energy from outside.
struct ForceOptions {
  Vec3 gravity{};   // m/s^2
  Vec3 driving{};   // driving force, N/m^3
  bool on = false;  // one of the two is there
  bool driving_on = false;
  const Sources* sources = nullptr;  // of the level; null: nothing adds to the state
};

// Friction and conduction: one number for all cells, or the cell field of that name in
// SchemeVariables.
struct TransportOptions {
  double viscosity = 0;  // dynamic, Pa s
  bool viscous = false, viscosity_varies = false;
  double conductivity = 0;  // W/(m K)
  bool conducting = false, conductivity_varies = false;
  std::vector<double> viscosities, conductivities;  // of all materials, Pa s and W/(m K)
  TransportModels models;                       // what fills these fields, and friction on walls
  std::vector<TransportModels> models_of_each;  // of all materials
  bool spreads_species = false;                 // mu, k and D of each cell from its species
};

// What a step sums up and records.
struct BudgetOptions {
  IndexOffsets places;   // of this part among those of the component
  int sums = 8;          // exact sums before those of further materials: see StepSlots
  SumGroup source_sums;  // of the step: mass of each material, then those of SourceSums
  SumGroup volume_sums;  // of `volumes`, in the order of VolumeSums
  // With several levels: which cells count in sums, where fluxes are recorded.
  const LevelCoverage* coverage = nullptr;
  const FluxRecorder* recorder = nullptr;
  const VolumeFaces* volumes = nullptr;  // control volumes of analyses; null: none
};

struct SchemeOptions {
  GridOptions grid;
  MaterialOptions materials;
  MethodOptions scheme;
  ForceOptions forces;
  TransportOptions transport;
  BudgetOptions budgets;

  // The scene's number of one of the materials.
  int place(int m) const { return budgets.places.material_of(m); }
  // Whether a material of a mixture conducts heat, in itself or into another.
  bool conducts(int m) const {
    const auto& convective = materials.convective;
    return transport.conductivity_varies || transport.conductivities[m] > 0 ||
           (convective && (convective->fluid == m || convective->solid == m));
  }
  // Whether the molecular viscosity is a cell field: of a mixture it always is.
  bool molecular_varies() const { return materials.mixture || transport.models.molecular_varies(); }
  // Whether that of a material of a mixture is one.
  bool own_viscosity_varies() const {
    return std::any_of(transport.models_of_each.begin(), transport.models_of_each.end(),
                       [](const TransportModels& t) { return t.molecular_varies(); });
  }
  // Whether friction works on the velocity of a sharp front between two viscosities
  // (face_mean.hpp); within one gas on the mean of two cells, which on a wall is the wall's.
  bool friction_tilts() const { return materials.mixture && transport.viscosity_varies; }
  // Is the work of pressures on a mixture a field of its own: elsewhere it is E - E*.
  bool keeps_work() const {
    return materials.mixture &&
           (transport.viscous || transport.conducting || materials.multi_velocity);
  }
};

// Of a scene, on the coarsest level; FluidPart::at_level() and FluidStep::options_of() say what
// differs on others and in each graph.
SchemeOptions scheme_options(const Scene& scene, const IceScene& ice);
// Whether faces along strong shocks exchange shear: step/shock_shear.hpp.
bool shears_shocks(const Scene& scene, const IceScene& ice);
// Of all materials, on the cells of a level.
std::vector<TransportModels> transport_models(const IceScene& ice, const Level& level);
// To the graph of one material, or of several together.
void select_material(SchemeOptions& o, const IceScene& ice, int index);
void select_mixture(SchemeOptions& o);

}  // namespace sluice::ice
