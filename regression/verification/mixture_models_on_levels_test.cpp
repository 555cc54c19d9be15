// Models of friction and exchange in mixtures on levels that move: what is kept.
#include <gtest/gtest.h>

#include <algorithm>

#include "verification/amr_case.hpp"

namespace sluice::verification {
namespace {

constexpr double allowed_drift = 1e-13;  // of sum |q|, per 1,000 steps

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

struct Case {
  const char* name;
  const char* deck;
  Overrides model;
};

class ModelsOnLevels : public testing::TestWithParam<Case> {};

TEST_P(ModelsOnLevels, KeepMassesMomentumAndEnergy) {
  const Overrides by_four = {"AMR/Regridder/cell_refinement_ratio=[[4,4,1]]",
                             "AMR/Regridder/min_patch_size=[[8,8,1]]", resolution(16, 16)};
  const Overrides three = {"AMR/Regridder/max_levels=3", resolution(16, 16)};
  for (const Overrides& levels :
       {Overrides{resolution(24, 24)}, Overrides{resolution(24, 24), "AMR/useLockStep=true"},
        by_four, three}) {
    const CaseRun run(GetParam().deck, both(GetParam().model, levels));
    const double drift = run.worst_drift() / std::max(1., run.steps() / 1000.);
    record("drift", drift);
    EXPECT_LE(drift, allowed_drift) << levels.back();
    EXPECT_LE(run.events(), 1) << run.record().at("events").dump();
    ASSERT_GE(most_cells(run).size(), 2u);
    EXPECT_GT(most_cells(run)[1], 0);
    EXPECT_GT(regrids(run), 0);
  }
}

const Case cases[] = {
    {"SlipOfOne", "amr_water_cylinder", both(rubbing(), slip())},
    {"SlipOfFree", "amr_water_cylinder", both(rubbing(), both(slip(), {drag("0")}))},
    {"SlipOfDragged", "amr_water_cylinder", both(rubbing(), both(slip(), {drag("1e6")}))},
    {"SlipAmongDrops", "amr_drops",
     both(rubbing(), both(slip(), {drag("100"), "Time/maxTime=1e-3"}))},
};

INSTANTIATE_TEST_SUITE_P(Of, ModelsOnLevels, testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace sluice::verification
