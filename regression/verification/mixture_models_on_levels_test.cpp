// Models of friction and exchange in mixtures on levels that move: what is kept, and that like
// gases are one gas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/amr_case.hpp"

namespace sluice::verification::mixture_models_on_levels_test {
namespace {

constexpr double allowed_drift = 1e-13;  // of sum |q|, per 1,000 steps; measured 1.2e-15

using Overrides = std::vector<std::string>;

std::string exchange(const std::string& tag, const std::string& value) {
  return "MaterialProperties/exchange_properties/" + tag + "=" + value;
}
std::string drag(const std::string& K) {
  return exchange("exchange_coefficients/momentum", "[" + K + "]");
}
std::string material(int m, const std::string& tag, const std::string& value) {
  return "MaterialProperties/ICE/material[" + std::to_string(m) + "]/" + tag + "=" + value;
}
Overrides both(Overrides all, const Overrides& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// Of the deck amr_water_cylinder: water is material 1 (index 0), air material 2 (index 1).
Overrides rubbing() {
  return {material(1, "dynamic_viscosity", "2"), material(2, "dynamic_viscosity", "0.1"),
          material(1, "thermal_conductivity", "6e3"), material(2, "thermal_conductivity", "200"),
          exchange("exchange_coefficients/heat", "[1e8]")};
}
Overrides slip() {
  return {exchange("Model/@type", "slip"), exchange("Model/fluidMatlIndex", "1"),
          exchange("Model/solidMatlIndex", "0"),
          exchange("Model/momentum_accommodation_coeff", "0.3"),
          exchange("Model/thermal_accommodation_coeff", "0.4")};
}

Overrides turbulence(const char* model) {
  return {std::string("CFD/ICE/turbulence/@model=") + model,
          "CFD/ICE/turbulence/model_constant=0.3"};
}
// Of both materials.
Overrides viscosity_model(const std::vector<std::pair<const char*, const char*>>& tags) {
  Overrides all;
  for (const int m : {1, 2})
    for (const auto& [tag, value] : tags)
      all.push_back(material(m, std::string("dynamicViscosityModels/Model/") + tag, value));
  return all;
}
// mu = a sqrt(T)/(1 + b/T)
Overrides sutherland(const char* a, const char* b) {
  return viscosity_model({{"@name", "Sutherland"}, {"a", a}, {"b", b}});
}
Overrides sponge(const char* viscosity) {
  return viscosity_model({{"@name", "SpongeLayer"},
                          {"maxDynamicViscosity", viscosity},
                          {"box/min", "[0.2,0.5,-9]"},
                          {"box/max", "[0.6,0.9,9]"}});
}
Overrides rough_wall() {
  return {"CFD/ICE/wallShearStress/@model=logLawModel", "CFD/ICE/wallShearStress/domainFace=y-",
          "CFD/ICE/wallShearStress/roughnessConstant=0.001"};
}
Overrides film() {
  return {exchange("do_convective_heat_transfer", "true"), exchange("convective_fluid", "1"),
          exchange("convective_solid", "0")};
}

struct Model {
  const char* name;
  const char* deck;
  Overrides overrides;
};
struct Levels {
  const char* name;
  Overrides overrides;
};
const Levels ways[] = {{"Ratio2", {resolution(24, 24)}},
                       {"Lockstep", {resolution(24, 24), "AMR/useLockStep=true"}},
                       {"Ratio4",
                        {"AMR/Regridder/cell_refinement_ratio=[[4,4,1]]",
                         "AMR/Regridder/min_patch_size=[[8,8,1]]", resolution(16, 16)}},
                       {"ThreeLevels", {"AMR/Regridder/max_levels=3", resolution(16, 16)}}};
struct Case {
  Model model;
  Levels levels;
};

class ModelsOnLevels : public testing::TestWithParam<Case> {};

TEST_P(ModelsOnLevels, KeepMassesMomentumAndEnergy) {
  const Case& c = GetParam();
  const CaseRun run(c.model.deck, both(c.model.overrides, c.levels.overrides));
  const double drift = run.worst_drift() / std::max(1., run.steps() / 1000.);
  record("drift", drift);
  EXPECT_LE(drift, allowed_drift);
  EXPECT_EQ(run.events(), 0) << run.record().at("events").dump();
  ASSERT_GE(max_cells(run).size(), 2u);
  EXPECT_GT(max_cells(run)[1], 0);
  EXPECT_GT(regrids(run), 0);
}

const Model models_of_mixtures[] = {
    {"Smagorinsky", "amr_water_cylinder", both(rubbing(), turbulence("Smagorinsky"))},
    {"Germano", "amr_water_cylinder", both(rubbing(), turbulence("Germano"))},
    {"GermanoFree", "amr_water_cylinder",
     both(rubbing(), both(turbulence("Germano"), {drag("10")}))},
    {"Sutherland", "amr_water_cylinder", both(rubbing(), sutherland("0.02", "100"))},
    {"SutherlandFree", "amr_water_cylinder",
     both(rubbing(), both(sutherland("0.02", "100"), {drag("0")}))},
    {"Sponge", "amr_water_cylinder", both(rubbing(), sponge("20"))},
    {"SpongeFree", "amr_water_cylinder", both(rubbing(), both(sponge("20"), {drag("0")}))},
    {"Film", "amr_water_cylinder", both(rubbing(), film())},
    {"FilmFree", "amr_water_cylinder", both(rubbing(), both(film(), {drag("1e3")}))},
    {"WallLaw", "amr_like_gases", both(turbulence("Smagorinsky"), rough_wall())},
    {"WallLawFree", "amr_like_gases", both(rough_wall(), {drag("0"), "Time/maxTime=0.2"})},
    {"SlipOfOne", "amr_water_cylinder", both(rubbing(), slip())},
    {"SlipOfFree", "amr_water_cylinder", both(rubbing(), both(slip(), {drag("0")}))},
    {"SlipOfDragged", "amr_water_cylinder", both(rubbing(), both(slip(), {drag("1e6")}))},
    {"SlipAmongDrops", "amr_drops",
     both(rubbing(), both(slip(), {drag("100"), "Time/maxTime=1e-3"}))},
    {"MixedGas",
     "amr_mixed_gas_water",
     {exchange("exchange_coefficients/heat", "[1e8]"), material(1, "dynamic_viscosity", "2")}},
};

// Every other row, which has each of the models, on one kind of levels; and all else.
std::vector<Case> cases(bool others) {
  std::vector<Case> all;
  for (std::size_t m = 0; m < std::size(models_of_mixtures); ++m)
    for (std::size_t way = 0; way < std::size(ways); ++way)
      if ((m % 2 == 0 && way == m / 2 % std::size(ways)) != others)
        all.push_back({models_of_mixtures[m], ways[way]});
  return all;
}
const auto name_of_case = [](const auto& test) {
  return std::string(test.param.model.name) + "_" + test.param.levels.name;
};
INSTANTIATE_TEST_SUITE_P(Of, ModelsOnLevels, testing::ValuesIn(cases(false)), name_of_case);
INSTANTIATE_TEST_SUITE_P(Full, ModelsOnLevels, testing::ValuesIn(cases(true)), name_of_case);

// Like gases: what stands for a mixture stands for one gas.
double distance(const std::vector<LevelCell>& a, const std::vector<LevelCell>& b) {
  double most = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t n = 0; n < a.size() && most < INFINITY; ++n)
    most = std::fmax(most, a[n].level == b[n].level && a[n].cell == b[n].cell
                               ? std::fabs(a[n].value - b[n].value)
                               : INFINITY);
  return most;
}

struct Like {
  const char* name;
  Overrides overrides;
};
class LikeGasesOnLevels : public testing::TestWithParam<Like> {};

TEST_P(LikeGasesOnLevels, AreOneGas) {
  constexpr double round_off = 1e-13, acts = 1e-2;  // measured 1.2e-14, 1.6e-2
  Overrides one_gas;
  for (const int m : {1, 2})
    for (const int object : {1, 2})
      one_gas.push_back(material(m, "geom_object[" + std::to_string(object) + "]/volumeFraction",
                                 m == 1 ? "1" : "0"));
  // Mixtures copy coarse values where a level begins: so does the one gas.
  const Overrides copied = {"AMR/ICE/orderOfInterpolation=0", "Time/maxTime=0.25"};
  const auto run_with = [&](const Overrides& more) {
    return CaseRun("amr_like_gases", both(copied, more));
  };
  const CaseRun one = run_with(both(GetParam().overrides, one_gas)), plain = run_with(one_gas);
  EXPECT_GT(regrids(one), 0);
  const double effect = farthest_from(one.field("vel_CC"), plain.field("vel_CC"));
  EXPECT_GT(effect, acts);
  for (const char* K : {"1e15", "1e4", "0"}) {
    const CaseRun two = run_with(both(GetParam().overrides, {drag(K)}));
    double worst = 0;
    for (const int m : {0, 1})
      for (const auto& [variable, component] :
           {std::pair{"vel_CC", 0}, {"vel_CC", 1}, {"temp_CC", 0}})
        worst = std::fmax(worst, distance(level_cells(one, variable, component),
                                          level_cells(two, variable, component, "last", m)));
    std::printf("%s, K = %s: %.1e, effect %.1e\n", GetParam().name, K, worst, effect);
    record(std::string("distance_") + K, worst);
    EXPECT_LE(worst, round_off) << K;
  }
}

const Like models[] = {
    {"All", both(both(turbulence("Germano"), sutherland("0.0003", "1")), rough_wall())},
    {"Smagorinsky", turbulence("Smagorinsky")},
    {"Germano", turbulence("Germano")},
    {"Sutherland", sutherland("0.003", "1")},
    {"Sponge", sponge("0.02")},
    {"WallLaw", both(turbulence("Smagorinsky"), rough_wall())},
};

INSTANTIATE_TEST_SUITE_P(Full, LikeGasesOnLevels, testing::ValuesIn(models),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace sluice::verification::mixture_models_on_levels_test
