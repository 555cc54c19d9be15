// Reading the ICE blocks of a deck that the schema has checked.
#include "ice/deck/ice_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "framework/scene/empty_pieces.hpp"
#include "ice/deck/read_fluid.hpp"
#include "ice/deck/read_transport.hpp"
#include "ice/deck/schema.hpp"
#include "ice/deck/scheme.hpp"
#include "ice/deck/third_order.hpp"

namespace sluice::ice {
namespace {

Location place(const DeckNode* node) {
  return node != nullptr ? node->where : Location{};
}

std::optional<std::string> formula_text(const DeckNode& formula, std::string_view name) {
  const DeckNode* child = formula.child(name);
  if (child == nullptr || child->text.empty()) return std::nullopt;
  return child->text;
}

std::optional<FormulaFill> read_formula(const DeckNode* ice) {
  const DeckNode* node = ice != nullptr ? ice->find("customInitialization/formula") : nullptr;
  if (node == nullptr) return std::nullopt;
  FormulaFill fill;
  fill.where = node->where;
  fill.over_cells = node->attribute("over").value_or("centre") == "cell";
  fill.density = formula_text(*node, "density");
  fill.pressure = formula_text(*node, "pressure");
  fill.temperature = formula_text(*node, "temperature");
  constexpr const char* velocities[] = {"velocity_x", "velocity_y", "velocity_z"};
  for (std::size_t d = 0; d < 3; ++d) fill.velocity[d] = formula_text(*node, velocities[d]);
  return fill;
}

IceMaterial read_material(const DeckNode& node, int index, const GeometryReader& geometry,
                          std::vector<Fault>& faults) {
  IceMaterial m;
  m.index = index;
  m.name = node.attribute("name").value_or("");
  m.where = node.where;
  m.fluid = read_fluid(node, faults);
  m.viscosity = node.real("dynamic_viscosity");
  m.viscosity_models = read_viscosity_models(node);
  m.viscosity_where = place(node.child("dynamic_viscosity"));
  m.conductivity = node.real("thermal_conductivity");
  m.conductivity_where = place(node.child("thermal_conductivity"));
  m.surrounding = boolean_or(node, "isSurroundingMatl", false);
  for (const DeckNode* object : node.all("geom_object"))
    m.objects.push_back(geometry.object(*object, faults));
  return m;
}

void read_numerics(const DeckNode& root, const DeckNode& cfd, IceScene& s) {
  if (const DeckNode* cfl = cfd.child("cfl")) s.cfl = cfl->as_real();
  s.cfl_where = place(cfd.child("cfl"));
  const DeckNode* ice = cfd.child("ICE");
  if (ice == nullptr) return;
  s.internal_energy_form = scheme_of(root).internal_energy;
  if (const DeckNode* scheme = ice->child("scheme")) s.scheme_where = scheme->where;
  if (const DeckNode* advection = ice->child("advection")) {
    s.third_order = is_third_order(root);
    s.second_order = advection->attribute("type").value_or("SecondOrder") != "FirstOrder";
    s.compatible_fluxes = advection->attribute("useCompatibleFluxes").value_or("true") == "true";
    s.shears_shocks = advection->attribute("shearAlongShocks").value_or("true") == "true";
    s.advection_where = advection->where;
  }
  if (const DeckNode* h = ice->child("applyHydrostaticPressure"))
    s.hydrostatic_start = h->as_boolean();
  if (const DeckNode* control = ice->child("TimeStepControl")) {
    if (const DeckNode* n = control->child("Scheme_for_delT_calc"))
      s.conservative_time_step = n->text == "conservative";
    if (const DeckNode* n = control->child("knob_for_speedSound"))
      s.sound_speed_factor = n->as_real();
    if (const DeckNode* n = control->child("knob_for_diffusion")) s.diffusion_factor = n->as_real();
  }
  s.added_heat = read_added_heat(*ice);
  s.driving_force = read_driving_force(*ice);
  s.formula = read_formula(ice);
  if (const DeckNode* custom = ice->child("customInitialization"))
    s.custom = read_custom_starts(*custom);
}

// `all` materials: one criterion each.
void read_criteria(const DeckNode& root, IceScene& s) {
  const DeckNode* list = root.find("AMR/ICE/Refinement_Criteria_Thresholds");
  if (list == nullptr) return;
  for (const DeckNode* v : list->all("Variable")) {
    RefinementCriterion c;
    c.label = v->attribute("name").value_or("");
    c.value = std::stod(v->attribute("value").value_or("0"));
    const std::string material = v->attribute("matl").value_or("all");
    for (const IceMaterial& m : s.materials) {
      c.material = m.index;
      if (material == "all" || std::stoi(material) == m.number()) s.criteria.push_back(c);
    }
  }
}

// A vortex turns in a plane; what it has along a direction that is no dimension has no place.
void warn_of_flat_plane(const DeckNode& node, int axis, const Scene& scene,
                        std::vector<Fault>& faults) {
  for (const int d : {(axis + 1) % 3, (axis + 2) % 3}) {
    const ActiveDirection& direction = scene.directions[d];
    if (direction.velocity != VelocityComponent::dropped) continue;
    add_warning(faults, node.where,
                fmt::format("<{}> about {} also gives a velocity along {}, which is an inactive "
                            "direction of this run; that part is dropped",
                            node.name, "xyz"[axis], "xyz"[d]),
                "an axis along a direction of one cell gives velocities along the other two");
  }
}

// Fewer cells than four a pair hold no vortices.
void warn_of_narrow_pairs(const DeckNode& node, const VortexPairs& pairs, const Level& coarsest,
                          std::vector<Fault>& faults) {
  constexpr int min_cells = 4;
  const int along = directions_of(pairs, coarsest).along, cells = coarsest.domain.size()[along];
  if (cells / min_cells >= pairs.pairs) return;
  add_warning(faults, node.where,
              fmt::format("<vortexPairs>: {} pairs side by side along {}, where the coarsest level "
                          "has {} cells",
                          pairs.pairs, "xyz"[along], cells),
              fmt::format("use fewer pairs, or {} cells for each", min_cells));
}

void warn_of_vortices(const Deck& deck, const Scene& scene, const IceScene& s,
                      std::vector<Fault>& faults) {
  const DeckNode* custom = deck.root->find("CFD/ICE/customInitialization");
  if (custom == nullptr) return;
  std::size_t n = 0;
  for (const CustomStart& start : s.custom) {
    if (const auto* vortices = std::get_if<Vortices>(&start))
      for (const Vortex& v : vortices->list)
        warn_of_flat_plane(*custom->child("vortices")->all("vortex")[n++], v.axis, scene, faults);
    if (const auto* pairs = std::get_if<VortexPairs>(&start)) {
      const DeckNode& node = *custom->child("vortexPairs");
      warn_of_flat_plane(node, pairs->axis, scene, faults);
      warn_of_narrow_pairs(node, *pairs, scene.grid.levels.front(), faults);
    }
  }
}

// A region is held at a state that its material's law has.
void check_fixed_values(const IceScene& s, std::vector<Fault>& faults) {
  for (const models::FixedValues& f : s.models.fixed_values) {
    const IceMaterial& m = s.materials[f.material];
    const double rho_e = m.fluid.energy_from_temperature(f.density, f.temperature);
    if (m.fluid.admissible(f.density, rho_e)) continue;
    add_error(faults, f.where,
              fmt::format("density_src {1:g} and temperature_src {2:g} are inadmissible for the "
                          "equation of state of '{0}': pressure {3:g} (must be above {4:g}), sound "
                          "speed squared must be above 0",
                          m.name, f.density, f.temperature, m.fluid.pressure(f.density, rho_e),
                          m.fluid.lowest_pressure()),
              "see the range of the equation of state in docs/theory_eos.md");
  }
}

// What a model of a mixed gas leaves to the material, and what the material gets from it: its
// coefficients are then the largest of the mixture's.
void complete_mixed_gas(IceScene& s, std::vector<Fault>& faults) {
  if (!s.models.mixed) return;
  models::MixedGas& gas = *s.models.mixed;
  if (gas.species) return;
  IceMaterial& m = s.materials[gas.material];
  gas.change_nodes([&](models::MixedGas::Node& node) {
    if (!gas.own_heat_capacity) {
      node.cv = m.fluid.specific_heat;
      node.R = (m.fluid.gamma - 1.0) * m.fluid.specific_heat;
    }
    if (!gas.own_viscosity) node.viscosity = m.viscosity;
    if (!gas.own_conductivity) node.conductivity = m.conductivity;
  });
  m.viscosity = gas.most(&models::MixedGas::Node::viscosity);
  m.conductivity = gas.most(&models::MixedGas::Node::conductivity);
  const double ox = gas.oxidizer_temperature, fuel = gas.fuel_temperature;
  for (const GeomObject& object : m.objects) {
    const double T = object.value("temperature");
    if (ox == 0 || T == ox || T == fuel) continue;
    add_warning(
        faults, gas.where,
        fmt::format(
            "<{}> has T(f) of streams at {:g} K and {:g} K; a region of '{}' starts at {:g} K: the "
            "heat released is the same, and temperatures are shifted by the difference",
            gas.type, ox, fuel, m.name, T));
  }
}

// ADD_HEAT counts the solids' materials before those of the fluids.
void place_added_heat(IceScene& s, std::vector<Fault>& faults) {
  for (models::AddedHeat& heat : s.added_heat) {
    heat.material -= s.solids;
    if (heat.material < 0)
      add_error(faults, heat.where,
                "ADD_HEAT heats fluids: material " + std::to_string(heat.material + s.solids) +
                    " is a solid");
  }
}

}  // namespace

bool IceScene::one_velocity() const {
  return materials.size() < 2 || exchange.momentum.min_of_pairs() >= one_velocity_coefficient;
}

double IceScene::courant_number(const Scene& scene) const {
  // threshold: Courant number where the deck says none; unit: 1; test:
  //   CourantNumber.IsUsualWithWhatNoMapProves
  constexpr double usual = 0.4;
  // threshold: the same of one fluid along one direction, where the error is the same at half the
  //   steps; unit: 1; test: CourantNumber.IsLargeWhereOneFluidMovesAlongOneDirectionAlone
  constexpr double along_one_direction = 0.8;
  const IntVec3 cells = scene.grid.levels.front().domain.size();
  const bool one_direction =
      scene.grid.levels.size() == 1 && (cells.x > 1) + (cells.y > 1) + (cells.z > 1) <= 1;
  const bool plain = materials.size() == 1 && !materials[0].viscous() &&
                     materials[0].conductivity == 0 && solids == 0 && !implicit &&
                     !internal_energy_form && !turbulence && !models.mixed &&
                     !models.any_source() && models.scalars.empty();
  return cfl.value_or(one_direction && plain ? along_one_direction : usual);
}

const IceMaterial& IceScene::surrounding() const {
  const auto marked = std::find_if(materials.begin(), materials.end(),
                                   [](const IceMaterial& m) { return m.surrounding; });
  return marked != materials.end() ? *marked : materials.front();
}

IceScene read_ice_scene(const Deck& deck, const Scene& scene, std::vector<Fault>& faults) {
  IceScene s;
  const DeckNode& root = *deck.root;
  if (const DeckNode* cfd = root.child("CFD")) read_numerics(root, *cfd, s);
  const GeometryReader geometry(root, faults);
  s.solids = solid_material_count(root);
  for (const DeckNode* node : ice_materials(root)) {
    s.materials.push_back(
        read_material(*node, static_cast<int>(s.materials.size()), geometry, faults));
    s.materials.back().solids_before = s.solids;
  }
  if (const DeckNode* ice = root.find("CFD/ICE")) {
    s.turbulence = read_turbulence(*ice);
    s.wall_shear = read_wall_shear(*ice, scene, faults);
  }
  for (IceMaterial& m : s.materials) m.subgrid = s.turbulence || !s.wall_shear.empty();
  const auto count = static_cast<int>(s.materials.size());
  if (count < 1) {
    add_error(faults, place(root.child("MaterialProperties")),
              "no <MaterialProperties><ICE><material>: there is no fluid",
              s.solids > 0 ? "add one, or write <SimulationComponent type=\"mpm\"/>" : "");
    return s;
  }
  place_added_heat(s, faults);
  s.exchange = read_exchange(root, s.solids + count);
  s.momentum_of_all = s.exchange.momentum;
  s.heat_of_all = s.exchange.heat;
  s.exchange.momentum = s.exchange.momentum.of(s.solids, count);
  s.exchange.heat = s.exchange.heat.of(s.solids, count);
  std::vector<std::string> names;
  for (const IceMaterial& m : s.materials) names.push_back(m.name);
  s.models = models::read_models(root, {names, names_of_solids(root)}, geometry, faults);
  for (models::TransportedScalar& scalar : s.models.scalars)
    read_field(scalar.decay, scene.grid.levels.front(), faults);
  for (models::TracerParticles& tracers : s.models.tracers)
    if (tracers.scalar) read_field(tracers.scalar->decay, scene.grid.levels.front(), faults);
  complete_mixed_gas(s, faults);
  check_fixed_values(s, faults);
  for (const models::TransportedScalar& scalar : s.models.scalars)
    if (scalar.refine_above >= 0)
      s.criteria.push_back({scalar.value().name(), scalar.refine_above, scalar.material});
  if (const DeckNode* block = root.find("CFD/ICE/ImplicitSolver")) {
    s.implicit = read_implicit(root, *block, faults);
    // hypre has no solver for one dimension; ours takes a few iterations there.
    const std::array<bool, 3>& active = scene.grid.levels.front().active;
    if (std::count(active.begin(), active.end(), true) == 1)
      s.implicit->linear.type = solve::SolverSettings{}.type;
  }
  s.conditions = read_flow_conditions(root);
  if (s.conditions.slip) s.conditions.slip->force = s.driving_force.force;
  read_criteria(root, s);
  warn_of_vortices(deck, scene, s, faults);
  for (const auto& block : root.children)
    if (block->name == "MaterialProperties" || block->name == "Models")
      warn_of_empty_pieces(*block, geometry, scene.grid, faults);
  s.gravity_where = scene.constants.gravity_where;
  return s;
}

}  // namespace sluice::ice
