// The table of decks.
#include "properties/property_decks.hpp"

#include <fmt/format.h>

#include "framework/base/test_support/environment.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::properties {
namespace {

const char* const grid = "Grid/Level/Box/resolution=";
const char* const gravity = "PhysicalConstants/gravity=[0.02,-0.03,0.01]";
const char* const pressure = "PhysicalConstants/reference_pressure=1";
const char* const viscous = "MaterialProperties/ICE/material/dynamic_viscosity=0.003";
const char* const smagorinsky = "CFD/ICE/turbulence/@model=Smagorinsky";
const char* const constant = "CFD/ICE/turbulence/model_constant=0.3";
const char* const germano = "CFD/ICE/turbulence/@model=Germano";
const char* const air_conducting = "MaterialProperties/ICE/material/thermal_conductivity=20";
const char* const conducting = "MaterialProperties/ICE/material/thermal_conductivity=0.004";
const char* const first_order = "CFD/ICE/advection/@type=FirstOrder";
const char* const coarsest = "AMR/Regridder/max_levels=1";

struct Entry {
  const char* name;
  const char* deck;
  std::vector<std::string> overrides;
};

const char* const lockstep = "AMR/useLockStep=true";
const char* const greedy = "Time/timestep_multiplier=6";
const char* const unlimited = "Time/delt_max=1e9";
const char* const internal_energy_form = "CFD/ICE/scheme=classic";

std::string cells(const char* triple) {
  return grid + std::string(triple);
}
std::string box(int level, const char* triple) {
  return "Grid/Level[" + std::to_string(level + 1) + "]/Box/resolution=" + triple;
}
std::string ratio(const char* list) {
  return "AMR/Regridder/cell_refinement_ratio=" + std::string(list);
}
std::string tile(const char* list) {
  return "AMR/Regridder/min_patch_size=" + std::string(list);
}

// Shocks, walls, periodic and open faces, uniform parts, each effect alone and together.
std::vector<Entry> own() {
  return {
      {"sod", "riemann_sod", {cells("[120,1,1]")}},
      {"left_blast", "riemann_left_blast", {cells("[90,1,1]")}},
      {"rarefactions", "riemann_123", {cells("[64,1,1]")}},
      {"slow_contact", "riemann_slow_contact", {cells("[70,1,1]")}},
      {"two_blasts", "woodward_colella", {cells("[150,1,1]")}},
      {"periodic_shocks", "periodic_shocks", {cells("[96,1,1]")}},
      {"sound", "sound_wave", {cells("[50,1,1]")}},
      {"shock_tube", "shock_tube", {cells("[100,1,1]")}},
      {"shock_tube_first_order", "shock_tube", {cells("[100,1,1]"), first_order}},
      {"shock_tube_classic", "shock_tube_classic", {cells("[100,1,1]")}},
      {"explosion", "explosion_2d", {cells("[33,29,1]")}},
      {"explosion_first_order", "explosion_2d", {cells("[33,29,1]"), first_order}},
      {"explosion_viscous", "explosion_2d", {cells("[33,29,1]"), viscous}},
      {"explosion_conducting", "explosion_2d", {cells("[33,29,1]"), viscous, conducting}},
      {"explosion_turbulent", "explosion_2d", {cells("[33,29,1]"), smagorinsky, constant}},
      {"explosion_dynamic", "explosion_2d", {cells("[27,29,1]"), germano, conducting}},
      {"layers_of_sutherland", "sutherland_couette", {cells("[1,40,1]")}},
      {"heated_plates", "couette_heated", {cells("[1,40,1]")}},
      {"hot_air_conducting", "hot_air_shock_tube", {cells("[80,1,1]"), air_conducting}},
      {"explosion_deck_rule",
       "explosion_2d",
       {cells("[33,29,1]"), "CFD/ICE/TimeStepControl/Scheme_for_delT_calc=conservative"}},
      {"blast", "blast_2d", {cells("[32,24,1]")}},
      {"vortex", "vortex", {cells("[24,20,1]")}},
      {"vortex_viscous", "vortex", {cells("[24,20,1]"), viscous}},
      {"gresho", "gresho", {cells("[20,20,1]")}},
      {"tracers", "tracers", {cells("[24,20,1]")}},
      {"column", "hydrostatic_column", {}},
      {"pulse_leaving", "pulse_leaving", {cells("[60,1,1]")}},
      {"vortex_leaving", "vortex_leaving", {cells("[24,20,1]")}},
      {"vortex_leaving_unaimed", "vortex_leaving_unaimed", {cells("[20,24,1]")}},
      {"manufactured_vortices", "manufactured_vortices", {cells("[20,14,1]")}},
      {"slip_channel", "slip_channel", {cells("[6,10,1]")}},
      {"rarefied_spot",
       "rarefied_spot",
       {cells("[24,20,1]"), "MaterialProperties/ICE/material/thermal_conductivity=0.02"}},
      {"water", "water_shock_tube", {cells("[110,1,1]")}},
      {"noble_abel", "noble_abel_tube", {cells("[110,1,1]")}},
      {"products", "jwl_products", {cells("[90,1,1]")}},
      {"hot_air", "hot_air_shock_tube", {cells("[80,1,1]")}},
      {"held_region", "held_region", {cells("[24,20,1]")}},
      {"held_region_classic", "held_region", {cells("[24,20,1]"), internal_energy_form}},
      {"implicit_pulse", "implicit_pulse", {cells("[40,1,1]")}},
      {"implicit_channel", "implicit_couette_poiseuille", {}},
      {"implicit_inflow", "implicit_inflow", {cells("[16,12,1]")}},
      {"implicit_cavity", "implicit_cavity", {cells("[12,14,1]")}},
      {"implicit_convection", "implicit_natural_convection", {cells("[12,14,1]")}},
      {"cube", "blast_3d", {cells("[14,12,13]")}},
      {"cube_gravity", "blast_3d", {cells("[14,12,13]"), gravity, pressure}},
      {"cube_all", "blast_3d", {cells("[14,12,13]"), gravity, pressure, viscous, conducting}},
  };
}

// Two and three materials, gases, liquids, solids and products of detonation, on one level and on
// several, with the edge moving across faces where levels meet.
std::vector<Entry> of_materials() {
  const char* const heat = "MaterialProperties/exchange_properties/exchange_coefficients/heat=";
  const auto with_heat = [&](const char* list) { return heat + std::string(list); };
  const auto of_material = [](int m, const char* tag, const char* value) {
    return fmt::format("MaterialProperties/ICE/material[{}]/{}={}", m, tag, value);
  };
  const char* const rubs = "dynamic_viscosity";
  const char* const conducts = "thermal_conductivity";
  // Below 1e10: velocities of their own.
  const auto with_drag = [](const char* list) {
    return "MaterialProperties/exchange_properties/exchange_coefficients/momentum=" +
           std::string(list);
  };
  const auto along = [](const char* tag, const char* value) {  // a surface
    return fmt::format("MaterialProperties/exchange_properties/Model/{}={}", tag, value);
  };
  const auto velocity = [](const char* material, const char* object, const char* u) {
    return "MaterialProperties/ICE/material[" + std::string(material) + "]/geom_object[" + object +
           "]/velocity=" + u;
  };
  return {
      {"implicit_water_air", "implicit_water_air", {}},
      {"implicit_sloshing", "implicit_sloshing", {cells("[16,16,1]")}},
      {"implicit_dam", "implicit_dam", {cells("[24,12,1]")}},
      {"implicit_layers_at_rest", "implicit_layers_at_rest", {}},
      {"amr_implicit_layers_at_rest", "amr_implicit_layers_at_rest", {}},
      {"two_gases", "two_gases_sod", {cells("[80,1,1]")}},
      {"interface_leaving", "interface_leaving", {cells("[60,1,1]")}},
      {"mixture_pulse_leaving", "mixture_pulse_leaving", {cells("[60,1,1]")}},
      {"two_gases_strong", "two_gases_strong", {cells("[90,1,1]")}},
      {"two_gases_heat", "two_gases_sod", {cells("[80,1,1]"), with_heat("[3]")}},
      {"two_gases_transport",
       "two_gases_sod",
       {cells("[80,1,1]"), with_heat("[30]"), of_material(1, rubs, "0.002"),
        of_material(1, conducts, "0.001"), of_material(2, conducts, "0.01")}},
      {"layers_bar", "layers_bar", {cells("[28,1,1]")}},
      {"amr_layers_bar", "amr_layers_bar", {}},
      {"layers_couette", "layers_couette", {cells("[1,10,1]")}},
      {"layers_slip", "layers_slip", {}},
      {"layers_sutherland", "layers_sutherland", {}},
      {"bubble_among_waves", "bubble_among_waves", {cells("[20,18,1]")}},
      {"mixed_ball_among_waves", "mixed_ball_among_waves", {cells("[20,18,1]")}},
      {"driven_mixture", "driven_mixture", {}},
      {"mixed_gases", "mixed_gases", {cells("[18,20,1]")}},
      {"closed_box", "closed_box", {cells("[18,14,1]")}},
      {"closed_box_free", "closed_box", {cells("[14,18,1]"), with_drag("[0,0,0]")}},
      {"exchange_of_two", "exchange_of_two", {"Time/delt_max=0.01"}},
      {"exchange_of_five", "exchange_of_five", {"Time/delt_max=0.01"}},
      {"fragments", "fragments", {}},
      {"cavitation", "cavitation", {cells("[60,1,1]")}},
      {"copper_in_sea_water", "copper_in_sea_water", {cells("[60,1,1]")}},
      {"gas_into_water", "gas_into_water", {cells("[90,1,1]")}},
      {"r22_cylinder", "r22_cylinder", {cells("[40,15,1]")}},
      {"water_dense_air", "water_dense_air", {cells("[100,1,1]")}},
      {"water_air", "water_air", {cells("[100,1,1]")}},
      {"water_air_greedy", "water_air", {cells("[70,1,1]"), greedy}},
      {"air_helium", "air_helium", {cells("[90,1,1]")}},
      {"products_into_air", "products_into_air", {cells("[100,1,1]")}},
      {"products_into_solid", "products_into_solid", {cells("[100,1,1]")}},
      {"rate_stick", "rate_stick", {cells("[80,1,1]")}},
      {"light_time", "light_time", {cells("[80,1,1]")}},
      {"hydrogen_detonation", "hydrogen_detonation", {cells("[50,1,1]"), "Time/maxTime=4e-6"}},
      {"three_in_a_row", "three_in_a_row", {cells("[50,1,1]")}},
      {"three_in_a_row_heat",
       "three_in_a_row",
       {cells("[50,1,1]"), with_heat("[1e3,1e12,0]"),
        "MaterialProperties/ICE/material[3]/geom_object[1]/temperature=320"}},
      {"two_gases_free", "two_gases_strong", {cells("[90,1,1]"), with_drag("[0]")}},
      {"three_in_a_row_drag",
       "three_in_a_row",
       {cells("[50,1,1]"), with_drag("[1e12,100,0]"), with_heat("[1e3,1e12,0]"),
        velocity("3", "1", "[30,0,0]")}},
      {"helium_bubble_drag",
       "helium_bubble",
       {cells("[40,15,1]"), with_drag("[100]"), velocity("2", "1", "[20,5,0]")}},
      {"helium_bubble", "helium_bubble", {cells("[40,15,1]")}},
      {"helium_bubble_gravity",
       "helium_bubble",
       {cells("[40,15,1]"), gravity, "CFD/ICE/applyHydrostaticPressure=false"}},
      {"amr_mass_exchange", "amr_mass_exchange", {cells("[20,16,1]")}},
      {"amr_mass_exchange_heat",
       "amr_mass_exchange",
       {cells("[16,18,1]"), with_heat("[4]"), "CFD/ICE/ADD_HEAT/add_heat_matls=[1]",
        "CFD/ICE/ADD_HEAT/add_heat_coeff=[30]", "CFD/ICE/ADD_HEAT/add_heat_t_start=0.003",
        "CFD/ICE/ADD_HEAT/add_heat_t_final=0.1"}},
      {"mass_exchange_driven",
       "amr_mass_exchange",
       {cells("[20,16,1]"), coarsest, "CFD/ICE/fixedPressureGradient/x_dir=3",
        "CFD/ICE/fixedPressureGradient/y_dir=-2"}},
      {"amr_water_square",
       "amr_water_square",
       {cells("[16,16,1]"), "MaterialProperties/ICE/material[1]/geom_object/velocity=[1500,-600,0]",
        "MaterialProperties/ICE/material[2]/geom_object/velocity=[1500,-600,0]"}},
      {"amr_water_square_ratio_4",
       "amr_water_square",
       {cells("[16,16,1]"), ratio("[[4,4,1]]"), tile("[[8,8,1]]")}},
      {"amr_water_square_three_levels",
       "amr_water_square",
       {cells("[12,14,1]"), "AMR/Regridder/max_levels=3"}},
      {"amr_followed_drop", "amr_followed_drop", {cells("[16,16,1]")}},
      {"amr_water_region", "amr_water_through_region", {box(0, "[16,16,1]"), box(1, "[8,16,1]")}},
      {"amr_water_cylinder", "amr_water_cylinder", {cells("[22,18,1]")}},
      {"amr_dyed_water", "amr_dyed_water", {cells("[22,18,1]")}},
      {"amr_dyed_water_free", "amr_dyed_water", {cells("[22,18,1]"), with_drag("[0]")}},
      {"amr_mass_exchange_drag", "amr_mass_exchange", {cells("[20,16,1]"), with_drag("[10]")}},
      {"amr_drops", "amr_drops", {cells("[16,16,1]")}},
      {"amr_drops_lockstep", "amr_drops", {cells("[16,16,1]"), lockstep, with_drag("[1e6]")}},
      {"amr_drops_free_by_four",
       "amr_drops",
       {cells("[16,16,1]"), ratio("[[4,4,1]]"), tile("[[8,8,1]]"), with_drag("[0]")}},
      {"amr_drops_three_levels",
       "amr_drops",
       {cells("[12,14,1]"), "AMR/Regridder/max_levels=3", with_drag("[0]")}},
      {"amr_water_cylinder_lockstep", "amr_water_cylinder", {cells("[20,20,1]"), lockstep}},
      {"amr_water_cylinder_transport",
       "amr_water_cylinder",
       {cells("[20,20,1]"), with_heat("[1e8]"), of_material(1, rubs, "2"),
        of_material(1, conducts, "6e3"), of_material(2, rubs, "0.1"),
        of_material(2, conducts, "200")}},
      {"amr_mixed_gas_water",
       "amr_mixed_gas_water",
       {cells("[20,20,1]"), with_heat("[1e8]"), of_material(1, rubs, "2")}},
      {"amr_mixed_gas_water_by_four",
       "amr_mixed_gas_water",
       {cells("[16,18,1]"), ratio("[[4,4,1]]"), tile("[[8,8,1]]")}},
      {"amr_water_cylinder_eddies",
       "amr_water_cylinder",
       {cells("[20,20,1]"), smagorinsky, constant, of_material(1, rubs, "2"),
        of_material(2, rubs, "0.1"), of_material(2, conducts, "200"), with_heat("[1e8]"),
        "MaterialProperties/exchange_properties/do_convective_heat_transfer=true",
        "MaterialProperties/exchange_properties/convective_fluid=1",
        "MaterialProperties/exchange_properties/convective_solid=0"}},
      {"amr_water_cylinder_eddies_free",
       "amr_water_cylinder",
       {cells("[20,20,1]"), germano, of_material(1, rubs, "2"), of_material(2, rubs, "0.1"),
        with_drag("[10]")}},
      {"amr_like_gases_all",
       "amr_like_gases",
       {cells("[12,14,1]"), germano, with_drag("[3]"),
        of_material(1, "dynamicViscosityModels/Model/@name", "Sutherland"),
        of_material(1, "dynamicViscosityModels/Model/a", "1e-3"),
        of_material(1, "dynamicViscosityModels/Model/b", "1"),
        of_material(2, "dynamicViscosityModels/Model/@name", "SpongeLayer"),
        of_material(2, "dynamicViscosityModels/Model/maxDynamicViscosity", "0.01"),
        of_material(2, "dynamicViscosityModels/Model/box/min", "[0.2,0.5,-9]"),
        of_material(2, "dynamicViscosityModels/Model/box/max", "[0.6,0.9,9]"),
        "CFD/ICE/wallShearStress/@model=logLawModel", "CFD/ICE/wallShearStress/domainFace=y-",
        "CFD/ICE/wallShearStress/roughnessConstant=0.001"}},
      {"amr_water_cylinder_slip",
       "amr_water_cylinder",
       {cells("[20,20,1]"), with_heat("[1e8]"), with_drag("[1e5]"), of_material(1, rubs, "2"),
        of_material(2, rubs, "0.1"), of_material(2, conducts, "200"), along("@type", "slip"),
        along("fluidMatlIndex", "1"), along("solidMatlIndex", "0"),
        along("momentum_accommodation_coeff", "0.3"), along("thermal_accommodation_coeff", "0.4")}},
      {"amr_water_cylinder_greedy", "amr_water_cylinder", {cells("[20,20,1]"), greedy}},
      {"amr_water_cylinder_three_levels",
       "amr_water_cylinder",
       {cells("[16,16,1]"), "AMR/Regridder/max_levels=3", with_heat("[1e4]")}},
  };
}

// Levels that stay and levels that move, ratios 2 and 4, both ways of stepping, both schemes.
std::vector<Entry> on_levels() {
  return {
      {"amr_shock_tube", "amr_shock_tube", {}},
      {"amr_shock_tube_lockstep", "amr_shock_tube", {lockstep}},
      {"amr_shock_tube_classic", "amr_shock_tube", {internal_energy_form}},
      {"amr_periodic_shocks", "amr_periodic_shocks", {cells("[50,1,1]")}},
      {"amr_dye", "amr_dye", {cells("[50,1,1]")}},
      {"amr_helium", "amr_helium", {cells("[50,1,1]")}},
      {"amr_flame_sheet", "amr_flame_sheet", {cells("[18,20,1]")}},
      {"amr_flame_sheet_eddies",
       "amr_flame_sheet",
       {cells("[18,20,1]"), germano,
        "MaterialProperties/ICE/material/dynamicViscosityModels/Model/@name=Sutherland",
        "MaterialProperties/ICE/material/dynamicViscosityModels/Model/a=2e-3",
        "MaterialProperties/ICE/material/dynamicViscosityModels/Model/b=1"}},
      {"amr_flame_sheet_viscous", "amr_flame_sheet", {cells("[20,16,1]"), viscous}},
      {"amr_implicit_blob", "amr_implicit_blob", {cells("[20,24,1]")}},
      {"amr_implicit_pulse", "amr_implicit_pulse", {}},
      {"amr_explosion", "amr_explosion", {cells("[22,18,1]")}},
      {"amr_explosion_ratio_4", "amr_explosion", {cells("[8,10,1]"), ratio("[[4,2,1],[2,4,1]]")}},
      {"amr_explosion_lockstep", "amr_explosion", {cells("[20,20,1]"), lockstep}},
      {"amr_explosion_viscous", "amr_explosion", {cells("[18,20,1]"), viscous}},
      {"amr_explosion_turbulent",
       "amr_explosion",
       {cells("[18,20,1]"), viscous, smagorinsky, constant}},
      {"amr_cube_dynamic", "amr_blast_3d", {cells("[8,9,8]"), tile("[[4,4,4]]"), germano}},
      {"amr_explosion_conducting", "amr_explosion", {cells("[18,20,1]"), viscous, conducting}},
      {"amr_explosion_first_order", "amr_explosion", {cells("[22,18,1]"), first_order}},
      {"amr_explosion_classic", "amr_explosion", {cells("[20,16,1]"), internal_energy_form}},
      {"amr_explosion_one_level", "amr_explosion", {cells("[22,18,1]"), coarsest}},
      {"amr_explosion_two_levels",
       "amr_explosion",
       {cells("[22,18,1]"), "AMR/Regridder/max_levels=2"}},
      {"amr_explosion_greedy", "amr_explosion", {cells("[20,16,1]"), greedy, unlimited}},
      {"amr_tiny",
       "amr_explosion",
       {cells("[2,2,1]"), "AMR/Regridder/max_levels=5", tile("[[16,16,1]]")}},
      {"amr_vortex", "amr_vortex", {box(0, "[24,20,1]"), box(1, "[24,20,1]")}},
      {"amr_shock_leaving_by_four",
       "amr_shock_leaving",
       {"Grid/Level[2]/Box/upper=[0.15,0.01,0.01]", box(1, "[60,1,1]")}},
      {"amr_shocks_leaving_by_four",
       "amr_vortex",
       {box(0, "[24,20,1]"), box(1, "[48,40,1]"),
        "CFD/ICE/customInitialization/formula/pressure=x^2 + y^2 < 10 ? 5 : 1"}},
      {"amr_vortex_leaving", "amr_vortex_leaving", {cells("[20,24,1]")}},
      {"amr_tracers", "amr_tracers", {cells("[24,20,1]")}},
      {"amr_tracers_lockstep", "amr_tracers", {cells("[20,22,1]"), lockstep}},
      {"amr_tracers_ratio_4", "amr_tracers", {cells("[16,18,1]"), ratio("[[4,2,1]]")}},
      {"amr_tracers_greedy", "amr_tracers", {cells("[20,16,1]"), greedy, unlimited}},
      {"amr_tracers_three_levels",
       "amr_tracers",
       {cells("[16,16,1]"), "AMR/Regridder/max_levels=3"}},
      {"amr_sound_wave", "amr_sound_wave", {}},
      {"amr_uniform_flow",
       "amr_uniform_flow",
       {box(0, "[8,8,8]"), box(1, "[8,8,8]"), box(2, "[16,8,16]")}},
      {"amr_cube", "amr_blast_3d", {cells("[10,9,8]"), tile("[[4,4,4]]")}},
      {"amr_cube_all",
       "amr_blast_3d",
       {cells("[8,9,8]"), tile("[[4,4,4]]"), gravity, pressure, viscous, conducting}},
  };
}

std::vector<Entry> collection() {
  return {
      {"peer_riemann_sm", "ICE/riemann_sm", {cells("[100,1,1]")}},
      {"peer_riemann3D", "ICE/riemann3D", {cells("[16,14,12]")}},
      {"peer_advect", "ICE/advect", {cells("[30,12,1]"), "DataArchiver/checkpoint/@interval="}},
      {"peer_advect_periodic",
       "ICE/advect_periodic",
       {cells("[12,10,8]"), "DataArchiver/checkpoint/@interval="}},
      {"peer_test2", "ICE/test2", {}},
      {"peer_test3", "ICE/test3", {}},
      {"peer_test4", "ICE/test4", {}},
      {"peer_shockTube", "UintahRelease/ICE/shockTube", {cells("[100,1,1]")}},
      {"peer_explosion", "ICE/explosion", {cells("[28,28,1]"), coarsest}},
      {"peer_riemann2D_AMR", "ICE/riemann2D_AMR", {coarsest}},
      {"peer_advect2mat", "ICE/advect2mat", {cells("[20,12,1]")}},
      {"peer_hotBlob2mat_sym",
       "ICE/hotBlob2mat_sym",
       {cells("[16,14,1]"), "DataArchiver/checkpoint/@interval="}},
      {"peer_moveBlock_mm", "ICE/moveBlock_mm", {}},
      {"peer_massX", "ICE/massX", {}},
  };
}

// Outputs and checkpoints by steps, whatever the deck says.
std::vector<std::string> with_control(std::vector<std::string> overrides) {
  const std::string every = std::to_string(interval);
  for (const std::string& one :
       {"Time/max_Timesteps=" + std::to_string(steps), std::string("Time/maxTime=1000"),
        "DataArchiver/outputTimestepInterval=" + every,
        "DataArchiver/checkpoint/@timestepInterval=" + every,
        std::string("DataArchiver/checkpoint/@cycle=0")})
    overrides.push_back(one);
  return overrides;
}

}  // namespace

const std::vector<PropertyDeck>& property_decks() {
  static const std::vector<PropertyDeck> decks = [] {
    std::vector<PropertyDeck> all;
    for (const std::vector<Entry>& table : {own(), of_materials(), on_levels()})
      for (const Entry& e : table) {
        all.push_back({e.name, std::string(SLUICE_SOURCE_DIR "/inputs/ice/") + e.deck + ".ups",
                       with_control(e.overrides)});
        if (!bears_parabolas(e.name)) continue;
        all.push_back({all.back().name + "_third_order", all.back().file, all.back().overrides});
        all.back().overrides.emplace_back("CFD/ICE/advection/@type=ThirdOrder");
      }
    const auto folder = folder_in_environment("SLUICE_DECKS");
    for (const Entry& e : collection())
      all.push_back({e.name, folder ? folder->string() + "/inputs/" + e.deck + ".ups" : "",
                     with_control(e.overrides)});
    return all;
  }();
  return decks;
}

}  // namespace sluice::properties
