// Declarations of the labels of ICE; docs/labels.md is generated from them.
#include "ice/fluid/labels.hpp"

#include <string>
#include <utility>

namespace sluice::ice {
namespace {

std::vector<Label>& declared() {
  static std::vector<Label> all;
  return all;
}
Label declare(LabelInfo info) {
  return declared().emplace_back(declare_label(std::move(info)));
}
Label cell(const char* name, const char* unit, const char* definition) {
  return declare({name, ValueType::real, Centring::cell, unit, definition});
}
Label cell_vector(const char* name, const char* unit, const char* definition) {
  return declare({name, ValueType::vector, Centring::cell, unit, definition});
}
Label face(const char* name, int d, const char* unit, const char* definition) {
  constexpr Centring centrings[] = {Centring::x_face, Centring::y_face, Centring::z_face};
  return declare({name, ValueType::real, centrings[d], unit, definition});
}
Label reduction(const char* name, ValueType type, const char* unit, const char* definition) {
  return declare({name, type, Centring::reduction, unit, definition});
}

void declare_state(Labels& l) {
  l.mass = cell("state.mass", "kg/m^3", "Conserved state: mass per volume of the cell.");
  l.momentum = cell("state.momentum", "kg/(m^2 s)",
                    "Conserved state: momentum per volume, one component per stored direction.");
  constexpr const char* components[] = {"state.momentum_x", "state.momentum_y", "state.momentum_z"};
  for (int d = 0; d < 3; ++d)
    l.momentum_component[d] = cell(components[d], "kg/(m^2 s)",
                                   "Conserved state: momentum per volume along one direction.");
  l.energy = cell("state.energy", "J/m^3", "Conserved state: internal energy per volume.");
  l.volume =
      cell("state.volume", "1", "Conserved state of several materials: volume fraction of each.");
  l.slip = cell("state.slip", "kg/(m^2 s)",
                "Conserved state with one velocity per material: momentum of each relative to the "
                "mixture, one component per stored direction.");
  constexpr const char* of_slip[] = {"state.slip_x", "state.slip_y", "state.slip_z"};
  for (int d = 0; d < 3; ++d)
    l.slip_component[d] = cell(
        of_slip[d], "kg/(m^2 s)",
        "Conserved state: momentum of a material relative to the mixture along one direction.");
  l.mask = cell("state.slope_mask", "1",
                "1 where slopes are used, 0 in cells whose faces are repeated at first order.");
}

void declare_solve(Labels& l) {
  l.pressure_offset = cell("state.pressure_offset", "Pa",
                           "State of semi-implicit steps: work pressure (the one that is solved "
                           "for) minus the pressure of the equation of state.");
  l.pressure_increment = cell("work.pressure_increment", "Pa",
                              "Semi-implicit steps: change of the work pressure in the step, as it "
                              "is solved for.");
  l.pressure_correction = cell("work.pressure_correction", "Pa",
                               "Semi-implicit steps: increment of the last solve of the step.");
  l.last_correction = cell("imp_delP", "Pa",
                           "Semi-implicit steps: change of the work pressure by the last solve of "
                           "the step.");
  l.sum_of_corrections = cell("sum_imp_delP", "Pa",
                              "Semi-implicit steps: change of the work pressure by all solves of "
                              "the step.");
  l.matrix_cell = cell("pressure_matrix_CC", "1/Pa",
                       "Semi-implicit steps: relative compression of a cell per increase of the "
                       "pressure, 1/(al rho c^2), the diagonal of the system without its faces.");
  constexpr const char* faces[] = {"pressure_matrix_FCX", "pressure_matrix_FCY",
                                   "pressure_matrix_FCZ"};
  for (int d = 0; d < 3; ++d)
    l.matrix_face[d] = face(faces[d], d, "1/Pa",
                            "Semi-implicit steps: coupling of two cells in the pressure's system, "
                            "A dt^2/(rho dx^2); 0 on faces whose velocity is given.");
  l.work_pressure =
      cell("work_press_CC", "Pa", "Semi-implicit steps: the work pressure of the previous step.");
  l.interface_pressure = cell("work.interface_pressure", "Pa",
                              "Semi-implicit steps on levels: the same in ghost cells that are "
                              "filled from a coarser level.");
  constexpr const char* finer_u[] = {"work.finer_face_velocity_x", "work.finer_face_velocity_y",
                                     "work.finer_face_velocity_z"};
  constexpr const char* finer_p[] = {"work.finer_face_pressure_x", "work.finer_face_pressure_y",
                                     "work.finer_face_pressure_z"};
  for (int d = 0; d < 3; ++d) {
    l.finer_face_velocity[d] = cell(finer_u[d], "m/s",
                                    "Semi-implicit steps on levels: mean velocity of the fine "
                                    "faces on the cell's low face, at the edge of a finer level.");
    l.finer_face_pressure[d] = cell(finer_p[d], "Pa",
                                    "Semi-implicit steps on levels: mean pressure of the fine "
                                    "faces on the cell's low face, at the edge of a finer level.");
  }
  l.right_side = cell("rhs", "1",
                      "Semi-implicit steps: right-hand side of the first solve of the step, the "
                      "relative volume error of a cell without it.");
  l.volume_error = cell("volume_error", "1",
                        "Semi-implicit steps: relative volume error of a cell after the last "
                        "solve; the largest is kept below outer_iteration_tolerance.");
}

void declare_walls(Labels& l) {
  l.solid_fraction =
      cell("solid.fraction", "1", "Volume fraction of solids in the cell; the rest is fluid.");
  l.solid_fraction_next = cell("work.solid_fraction_next", "1", "The same at the end of the step.");
  l.wall_pressure = cell("solid.wall_pressure", "Pa",
                         "Pressure between the fluid of a cell and the solid in it.");
  const auto at_surfaces = [](const char* saved, const char* kept, const char* unit,
                              const char* definition) {
    return Labels::AtSurfaces{cell(saved, unit, definition),
                              cell(kept, unit, "The same, within a step.")};
  };
  l.burning_steady =
      at_surfaces("SteadyBurn.BurningCell", "work.burning", "1",
                  "1 where surfaces of the solid of Steady_Burn lost mass in the step.");
  l.burning_unsteady =
      at_surfaces("UnsteadyBurn.BurningCell", "work.burning_unsteady", "1",
                  "1 where surfaces of the solid of Unsteady_Burn lost mass in the step.");
  l.surface_temperature =
      at_surfaces("UnsteadyBurn.SurfTemp", "work.surface_temperature", "K",
                  "Temperature of surfaces of that solid where they burn, mean over the pieces in "
                  "the cell; 0 elsewhere.");
  l.surface_gradient = at_surfaces("UnsteadyBurn.SurfTempGrad", "work.surface_gradient", "K/m",
                                   "Gradient of temperature in the solid at these surfaces, mean "
                                   "over the pieces in the cell; 0 elsewhere.");
  l.detonating = at_surfaces("detonating", "work.detonating", "1",
                             "1 where the explosive of DDT1 detonated in the step.");
  l.burning = at_surfaces("burning", "work.burning_explosive", "1",
                          "State of the explosive of DDT1 in a cell: 1 a flame approaches, 2 its "
                          "surface burns, 3 its cracks burn; 0: none of these.");
  l.induction_time = at_surfaces("inductionTime", "work.induction_time", "s",
                                 "Induction time of flames at the present pressure, mean over the "
                                 "particles of DDT1 in the cell that a flame approaches; 0: none.");
  l.count_time = at_surfaces("countTime", "work.count_time", "s",
                             "Elapsed induction time of flames, mean over the particles of DDT1 in "
                             "the cell that a flame has approached.");
  l.kept_burned_share = cell("work.F", "1", "F, within a step.");
  l.kept_burned_in_step = cell("work.delF", "1", "delF, within a step.");
  l.kept_model_mass =
      cell("work.burned_mass", "kg", "Mass transferred from burning solids to fluids in the step.");
  constexpr const char* axes[] = {"x", "y", "z"};
  for (int d = 0; d < 3; ++d) {
    const std::string axis = axes[d];
    l.covered[d] = cell(("work.covered_" + axis).c_str(), "1",
                        "Fraction of the low face covered by solids at the start of the step.");
    l.mean_covered[d] =
        cell(("work.mean_covered_" + axis).c_str(), "1", "The same, its mean over the step.");
    l.swept[d] = cell(("work.swept_" + axis).c_str(), "1",
                      "Volume that surfaces of solids sweep through the low face, cells.");
    l.solid_face_velocity[d] = cell(("work.solid_velocity_" + axis).c_str(), "m/s",
                                    "Velocity of the solid at the low face.");
  }
}

void declare_primitives(Labels& l) {
  l.rho = cell("rho_CC", "kg/m^3", "Mass of the material per volume of the cell.");
  l.rho_micro = cell("rho_micro_CC", "kg/m^3", "True density: mass per volume of the material.");
  l.velocity = cell_vector("vel_CC", "m/s", "Velocity, momentum over mass.");
  l.temperature = cell("temp_CC", "K", "Temperature from density and internal energy.");
  l.pressure = cell("press_CC", "Pa", "Pressure of the equation of state.");
  l.specific_volume = cell("sp_vol_CC", "m^3/kg", "Specific volume, the inverse true density.");
  l.volume_fraction = cell("vol_frac_CC", "1", "Volume fraction of the material.");
  l.sound_speed = cell("speedSound_CC", "m/s", "Speed of sound.");
  l.mach = cell("mach", "1", "Speed over speed of sound.");
  l.sum_rho = cell("sum_rho_CC", "kg/m^3", "Mass of all materials per volume of the cell.");
  l.mass_of_cell = cell("mass_adv", "kg", "Mass of the material in the cell.");
  l.momentum_of_cell = cell_vector("mom_adv", "kg m/s", "Momentum of the material in the cell.");
  l.energy_of_cell = cell("eng_adv", "J", "Internal energy of the material in the cell.");
  l.volume_of_cell = cell("sp_vol_adv", "m^3", "Volume of the material in the cell.");
  l.compressibility =
      cell("compressiblity", "1/Pa", "Specific volume over the speed of sound squared.");
  l.compressibility_of_cell =
      cell("sumKappa", "1/Pa", "Compressibility of the cell: sum of vol_frac_CC compressiblity.");
  l.compressibility_share = cell("f_theta", "1",
                                 "Fraction of the material in the compressibility of the cell, "
                                 "vol_frac_CC compressiblity/sumKappa.");
  l.viscosity = cell("viscosity", "Pa s", "Dynamic viscosity of the material itself.");
  l.eddy_viscosity =
      cell("turb_viscosity_CC", "Pa s", "Subgrid viscosity of the turbulence model.");
  l.total_viscosity = cell("total_viscosity_CC", "Pa s", "Sum of viscosity and turb_viscosity_CC.");
  l.subgrid_normal = cell_vector("SGS_uu_vv_ww", "m^2/s^2",
                                 "Decks with a turbulence model: deviatoric part of the modelled "
                                 "covariances uu, vv, ww of the subgrid velocity.");
  l.subgrid_shear = cell_vector(
      "SGS_uv_vw_wu", "m^2/s^2",
      "Decks with a turbulence model: modelled covariances uv, vw, wu of the subgrid velocity.");
  l.thermal_conductivity = cell("thermalCond", "W/(m K)", "Thermal conductivity.");
  l.specific_heat = cell("specific_heat", "J/(kg K)", "Specific heat at constant volume.");
  l.gamma = cell("gamma", "1", "Ratio of specific heats.");
}

void declare_waves(Labels& l) {
  constexpr const char* names[] = {"Li1", "Li2", "Li3", "Li4", "Li5"};
  constexpr const char* units[] = {"Pa/s", "kg/(m^3 s)", "m/s^2", "m/s^2", "Pa/s"};
  constexpr const char* definitions[] = {
      "(u - c)(dp - rho c du)/2 along the axis.", "u (drho - dp/c^2) along the axis.",
      "u du_t along the axis, first tangent.", "u du_t along the axis, second tangent.",
      "(u + c)(dp + rho c du)/2 along the axis."};
  const std::string where = "Waves at LODI faces of decks of one material, by direction: ";
  for (int n = 0; n < 5; ++n)
    l.wave_amplitude[n] = cell_vector(names[n], units[n], (where + definitions[n]).c_str());
}

void declare_derivatives(Labels& l) {
  l.gradient_rho = cell("mag_grad_rho_CC", "kg/m^4", "Magnitude of the density gradient.");
  l.gradient_temperature =
      cell("mag_grad_temp_CC", "K/m", "Magnitude of the temperature gradient.");
  l.gradient_pressure = cell("mag_grad_press_CC", "Pa/m", "Magnitude of the pressure gradient.");
  l.gradient_volume_fraction =
      cell("mag_grad_vol_frac_CC", "1/m", "Magnitude of the volume-fraction gradient.");
  l.divergence_velocity = cell("mag_div_vel_CC", "1/s",
                               "Norm of the diagonal velocity derivatives, "
                               "sqrt(sum (du_d/dx_d)^2).");
  l.refine_flag =
      declare({"refineFlag", ValueType::integer, Centring::cell, "1",
               "1 where a refinement criterion of the deck flags the cell, 0 elsewhere."});
  l.vorticity = cell_vector("vorticity", "1/s", "Curl of the velocity, central differences.");
}

// The Lagrangian phase: pressure, friction, conduction and forces; before exchange and advection.
void declare_phase_labels(Labels& l) {
  l.lagrangian_mass = cell("mass_L_CC", "kg",
                           "Mass of the material in the cell before advection: that of the start "
                           "of the step, because models add mass at its end.");
  l.momentum_before_exchange = cell_vector(
      "mom_L_CC", "kg m/s",
      "Momentum of the material in the cell after pressure, friction and forces, before exchange "
      "between materials and advection.");
  l.lagrangian_momentum =
      cell_vector("mom_L_ME_CC", "kg m/s",
                  "Momentum of the material in the cell after pressure, friction, forces and the "
                  "exchange between materials that precedes advection (all of it where they have "
                  "one velocity, else half of the step's).");
  l.momentum_source =
      cell_vector("mom_source_CC", "kg m/s",
                  "Momentum that the material gets in the step: from pressure and a driving force "
                  "by volume, from gravity by mass, from friction.");
  l.lagrangian_velocity =
      cell_vector("vel_CC_Xchange", "m/s",
                  "Velocity of the material before advection: mom_L_ME_CC over mass_L_CC.");
  l.stress_velocity = cell_vector(
      "velTau_CC", "m/s",
      "Velocity of the material from which friction is computed: that of the start of the step.");
  l.energy_before_exchange = cell("int_eng_L_CC", "J",
                                  "Internal energy of the material in the cell after pressure and "
                                  "forces, before exchange between materials and advection.");
  l.lagrangian_energy = cell("eng_L_ME_CC", "J",
                             "Internal energy of the material in the cell after pressure and "
                             "forces, before advection.");
  l.energy_source = cell("intE_source_CC", "J",
                         "Internal energy that the material gets in the step from work of pressure "
                         "and friction and from conduction, before advection.");
  l.lagrangian_volume =
      cell("sp_vol_L_CC", "m^3",
           "Volume of the material before advection, mass_L_CC times its specific volume then: "
           "that of the start of the step times 1 + term2.");
  l.volume_source =
      cell("sp_vol_src_CC", "m^3/kg", "Change of the specific volume that leads to sp_vol_L_CC.");
  l.dilation = cell("term2", "1",
                    "Net volume of all materials that flows out of the cell in the step, as a "
                    "fraction of the cell.");
  l.lagrangian_heating = cell("Tdot", "K/s",
                              "Rate of change of the temperature before advection, in the cell as "
                              "it moves, by work and conduction.");
}

// Table: a row for each label of what exists within a step.
void declare_step_labels(Labels& l) {
  l.equilibrium_pressure = cell("press_equil_CC", "Pa", "Pressure at the start of the step.");
  l.pressure_change =
      cell("delP_Dilatate", "Pa", "Change of the pressure over the step by compression and flow.");
  l.source_pressure = cell("delP_MassX", "Pa",
                           "Change of the pressure over the step by mass and energy that models "
                           "add or transfer, to first order.");
  l.burned_share = cell(
      "F", "1",
      "Burned fraction of an explosive in the cell, product over reactant and product by mass; for "
      "the models JWLpp and DDT1, with the reactant; for the latter 0 in cells without explosive.");
  l.burned_in_step = cell("delF", "1", "Increase of that fraction by burning in the step.");
  l.model_mass = cell("modelMass_src", "kg", "Mass that models add to the material in the step.");
  l.model_momentum = cell_vector("modelMom_src", "kg m/s",
                                 "Momentum that models add to the material in the step.");
  l.model_energy =
      cell("modelEng_src", "J", "Internal energy that models add to the material in the step.");
  l.model_volume = cell(
      "modelVol_src", "m^3",
      "Volume that models add to the material in the step, before the common pressure is found.");
  constexpr const char* velocity[] = {"uvel_FC", "vvel_FC", "wvel_FC"};
  constexpr const char* exchanged[] = {"uvel_FCME", "vvel_FCME", "wvel_FCME"};
  constexpr const char* pressure[] = {"pressX_FC", "pressY_FC", "pressZ_FC"};
  constexpr const char* stress[] = {"tau_X_FC", "tau_Y_FC", "tau_Z_FC"};
  for (int d = 0; d < 3; ++d) {
    l.face_velocity[d] = face(velocity[d], d, "m/s", "Normal velocity of the face.");
    l.face_velocity_exchanged[d] =
        face(exchanged[d], d, "m/s",
             "Normal velocity of the face after momentum exchange between materials.");
    l.face_pressure[d] = face(pressure[d], d, "Pa", "Pressure on the face.");
    l.face_stress[d] = declare({stress[d], ValueType::vector, l.face_pressure[d].info().centring,
                                "Pa", "Viscous stress on the face: force on the cell below it."});
  }
  constexpr const char* temperature[] = {"TempX_FC", "TempY_FC", "TempZ_FC"};
  constexpr const char* fraction[] = {"vol_fracX_FC", "vol_fracY_FC", "vol_fracZ_FC"};
  constexpr const char* gradient[] = {"grad_P_XFC", "grad_P_YFC", "grad_P_ZFC"};
  for (int d = 0; d < 3; ++d) {
    l.face_temperature[d] = face(temperature[d], d, "K",
                                 "Mean by mass of the temperatures that the material has in the "
                                 "two cells at the start of the step.");
    l.face_volume_fraction[d] = face(fraction[d], d, "1",
                                     "Fraction of the material in the volume flux through the face "
                                     "in the step; without flux, the mean of the two cells.");
    l.face_pressure_gradient[d] =
        face(gradient[d], d, "Pa/m",
             "Difference of press_equil_CC between the two cells over their distance.");
  }
  l.temperature_rate =
      cell("dTdt_CC", "K/s",
           "Change of temp_CC over the step divided by its length: work, heat, exchange and flow, "
           "without later changes by finer levels; 0 where the material is new, gone or a trace.");
  l.velocity_rate = cell_vector(
      "dVdt_CC", "m/s^2",
      "Change of vel_CC over the step divided by its length: forces, exchange and flow, without "
      "later changes by finer levels; 0 where the material is new or gone.");
  l.viscous_source =
      cell_vector("viscous_src_CC", "N", "Viscous force on the cell, from its faces.");
  l.heat_source =
      cell("heatCond_src_CC", "J", "Heat conducted into the cell in the step, from its faces.");
}

void declare_reductions(Labels& l) {
  l.total_mass = reduction("TotalMass", ValueType::real, "kg", "Mass in the domain.");
  l.total_momentum =
      reduction("TotalMomentum", ValueType::vector, "kg m/s", "Momentum in the domain.");
  l.total_internal_energy =
      reduction("TotalIntEng", ValueType::real, "J", "Internal energy in the domain.");
  l.kinetic_energy = reduction("KineticEnergy", ValueType::real, "J",
                               "Kinetic energy in the domain, sum of |m|^2/(2 rho) V.");
  l.total_model_mass = reduction("TotalModelMass_src", ValueType::real, "kg",
                                 "Mass that models have added since the start, of all materials.");
  l.total_model_momentum = reduction("TotalModelMom_src", ValueType::vector, "kg m/s",
                                     "Momentum that models have added since the start.");
  l.total_model_energy = reduction("TotalModelEng_src", ValueType::real, "J",
                                   "Total energy that models have added since the start.");
  l.total_mass_exchanged = reduction("totalMassExchanged", ValueType::real, "kg",
                                     "Mass transferred between materials since the start.");
  l.total_energy_exchanged =
      reduction("totalIntEngExchanged", ValueType::real, "J",
                "Internal energy transferred with that mass since the start.");
  l.total_mass_burned = reduction("totalMassBurned", ValueType::real, "kg",
                                  "Mass that models have burned since the start.");
  const auto of_solves = [](const char* name, const char* text) {
    return reduction(name, ValueType::real, "1", text);
  };
  l.pressure_passes =
      of_solves("pressure_passes", "Semi-implicit steps: pressure solves that the step took.");
  l.pressure_iterations = of_solves("pressure_iterations",
                                    "Semi-implicit steps: iterations of the linear solver in all "
                                    "pressure solves of the step.");
  l.pressure_residual = of_solves("pressure_residual",
                                  "Semi-implicit steps: residual of the last linear solve of the "
                                  "step over its right-hand side.");
  l.largest_volume_error = of_solves("largest_volume_error",
                                     "Semi-implicit steps: the largest volume_error after the last "
                                     "solve of the step.");
  l.total_heat_released = reduction("totalHeatReleased", ValueType::real, "J",
                                    "Heat of reaction given to the products since the start, in "
                                    "addition to the energy of the burned mass.");
}

}  // namespace

const Labels& labels() {
  static const Labels all = [] {
    Labels l;
    declare_state(l);
    declare_solve(l);
    declare_walls(l);
    declare_primitives(l);
    declare_derivatives(l);
    declare_waves(l);
    declare_phase_labels(l);
    declare_step_labels(l);
    declare_reductions(l);
    return l;
  }();
  return all;
}

std::vector<Label> state_functions() {
  const Labels& l = labels();
  std::vector<Label> all = {l.rho,
                            l.rho_micro,
                            l.sum_rho,
                            l.velocity,
                            l.pressure,
                            l.temperature,
                            l.sound_speed,
                            l.compressibility,
                            l.specific_volume,
                            l.compressibility_of_cell,
                            l.compressibility_share,
                            l.volume_fraction,
                            l.gradient_volume_fraction,
                            l.viscosity,
                            l.eddy_viscosity,
                            l.total_viscosity,
                            l.thermal_conductivity,
                            l.gamma,
                            l.specific_heat,
                            l.mach,
                            l.gradient_rho,
                            l.gradient_temperature,
                            l.gradient_pressure,
                            l.divergence_velocity,
                            l.vorticity,
                            l.mass_of_cell,
                            l.momentum_of_cell,
                            l.energy_of_cell,
                            l.volume_of_cell};
  all.insert(all.end(), std::begin(l.wave_amplitude), std::end(l.wave_amplitude));
  return all;
}

const std::vector<Label>& own_labels() {
  labels();
  return declared();
}

}  // namespace sluice::ice
