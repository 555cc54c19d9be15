// Mirrored decks give mirrored bits; permuted axes equal bits where no sum has three terms, of
// directions or of components of the velocity, and 1e-12 elsewhere.
#include <gtest/gtest.h>

#include <algorithm>

#include "framework/grid/index_box.hpp"
#include "properties/skew_flow.hpp"
#include "quick_cases.hpp"

namespace sluice::properties::symmetry_property_test {
namespace {

constexpr double allowed_of_three = 1e-12;  // of the largest value of the field
class Symmetry : public testing::TestWithParam<SkewCase> {
 protected:
  // Directions along which the gas moves: gravity and walls that move make some of their own, and
  // `along_wall` has a part along every axis.
  static int components(const SkewCase& c) {
    if (c.cross_flow || c.has(SideKind::moving_wall) || c.has(SideKind::slip)) return 3;
    int count = 0;
    for (int d = 0; d < 3; ++d) count += c.active(d);
    return count;
  }
  // The flow is not trivial: everything moves.
  static void expect_flow(const SkewCase& c, const Flow& flow) {
    const auto [low, high] = std::minmax_element(flow.density.begin(), flow.density.end());
    if (c.materials() == 1) {
      EXPECT_GT(*low, 0);
    } else {
      EXPECT_TRUE(std::any_of(flow.share.begin(), flow.share.end(),
                              [](double v) { return v > 0.1 && v < 0.9; }));
    }
    EXPECT_GT(*high, 1.5 * *low);
    for (int l = 1; l < c.levels.most; ++l) {
      const std::int64_t cells = flow.cells[static_cast<std::size_t>(l * c.materials())];
      EXPECT_GT(cells, 0) << "level " << l;
      EXPECT_LT(cells, (IndexBox{{0, 0, 0}, c.cells_of(l)}.volume())) << "level " << l;
    }
  }
};

TEST_P(Symmetry, MirroredDecksGiveMirroredBits) {
  const SkewCase& c = GetParam();
  const Flow plain = flow_of(c, {});
  expect_flow(c, plain);
  for (int d = 0; d < 3; ++d) {
    if (c.cells[d] == 1 && !c.cross_flow) continue;
    Orientation o;
    o.mirrored[static_cast<std::size_t>(d)] = true;
    EXPECT_EQ(difference(plain, flow_of(c, o), 0), "") << "mirrored along axis " << d;
  }
  EXPECT_EQ(difference(plain, flow_of(c, {{0, 1, 2}, {true, true, true}}), 0), "") << "all three";
}

TEST_P(Symmetry, PermutedAxesGiveTheSameFlow) {
  const SkewCase& c = GetParam();
  const double allowed = components(c) == 3 ? allowed_of_three : 0;
  const Flow plain = flow_of(c, {});
  for (const std::array<int, 3> shows :
       {std::array{1, 0, 2}, std::array{0, 2, 1}, std::array{2, 1, 0}, std::array{1, 2, 0},
        std::array{2, 0, 1}})
    EXPECT_EQ(difference(plain, flow_of(c, {shows, {}}), allowed), "")
        << "axes " << shows[0] << shows[1] << shows[2];
}

// Gravity acts along directions of one cell only: a hydrostatic start has its pressure in cell
// (0,0,0), which a mirror moves to the other end.
using enum SideKind;
const SkewCase cases[] = {
    {.name = "tube",
     .cells = {64, 1, 1},
     .sides = {wall, open, symmetry, symmetry, symmetry, symmetry}},
    {.name = "tube_first_order",
     .cells = {64, 1, 1},
     .sides = {inflow, wall, symmetry, symmetry, symmetry, symmetry},
     .second_order = false},
    {.name = "tube_cross_flow",
     .cells = {64, 1, 1},
     .sides = {open, wall, periodic, periodic, periodic, periodic},
     .gravity = {0, 0.01, -0.02},
     .viscosity = 0.01,
     .cross_flow = true},
    {.name = "square",
     .cells = {32, 32, 1},
     .sides = {wall, open, inflow, symmetry, symmetry, symmetry}},
    {.name = "square_first_order",
     .cells = {32, 32, 1},
     .sides = {wall, open, periodic, periodic, symmetry, symmetry},
     .second_order = false},
    {.name = "square_viscous",
     .cells = {32, 32, 1},
     .sides = {moving_wall, wall, open, inflow, symmetry, symmetry},
     .viscosity = 0.02},
    {.name = "square_all",
     .cells = {32, 32, 1},
     .sides = {wall, moving_wall, symmetry, open, periodic, periodic},
     .gravity = {0, 0, 0.01},
     .viscosity = 0.02,
     .cross_flow = true},
    {.name = "square_waves",
     .cells = {32, 32, 1},
     .sides = {waves, waves, waves, open, symmetry, symmetry}},
    {.name = "square_means",
     .cells = {32, 32, 1},
     .sides = {waves, waves, waves, open, symmetry, symmetry},
     .far_flow = false},
    {.name = "square_slip",
     .cells = {32, 32, 1},
     .sides = {slip, wall, slip, waves, symmetry, symmetry},
     .viscosity = 0.02},
    {.name = "tube_classic",
     .cells = {64, 1, 1},
     .sides = {wall, inflow, symmetry, symmetry, symmetry, symmetry},
     .internal_energy_form = true},
    {.name = "square_classic",
     .cells = {32, 32, 1},
     .sides = {wall, open, inflow, symmetry, symmetry, symmetry},
     .internal_energy_form = true},
    {.name = "square_classic_viscous",
     .cells = {32, 32, 1},
     .sides = {moving_wall, wall, open, inflow, periodic, periodic},
     .gravity = {0, 0, 0.01},
     .viscosity = 0.02,
     .cross_flow = true,
     .internal_energy_form = true},
    {.name = "cube",
     .cells = {16, 16, 16},
     .sides = {wall, open, inflow, symmetry, periodic, periodic}},
    {.name = "cube_all",
     .cells = {16, 16, 16},
     .sides = {moving_wall, wall, symmetry, open, inflow, wall},
     .viscosity = 0.02},
    {.name = "square_conducting",
     .cells = {32, 32, 1},
     .sides = {moving_wall, wall, open, wall, symmetry, symmetry},
     .viscosity = 0.02,
     .conductivity = 0.03},
    {.name = "square_turbulent",
     .cells = {32, 32, 1},
     .sides = {moving_wall, wall, open, wall, symmetry, symmetry},
     .viscosity = 0.005,
     .turbulence = "Smagorinsky"},
    {.name = "square_dynamic",
     .cells = {32, 32, 1},
     .sides = {moving_wall, wall, open, inflow, periodic, periodic},
     .gravity = {0, 0, 0.01},
     .viscosity = 0.005,
     .cross_flow = true,
     .levels = {.most = 2, .threshold = 8},
     .turbulence = "Germano"},
    {.name = "cube_dynamic",
     .cells = {16, 16, 16},
     .sides = {moving_wall, wall, symmetry, open, inflow, wall},
     .viscosity = 0.005,
     .conductivity = 0.01,
     .turbulence = "Germano"},
    {.name = "square_levels_conducting",
     .cells = {32, 32, 1},
     .sides = {wall, moving_wall, symmetry, open, periodic, periodic},
     .gravity = {0, 0, 0.01},
     .viscosity = 0.02,
     .cross_flow = true,
     .levels = {.most = 2, .threshold = 8},
     .conductivity = 0.03},
    {.name = "square_slip_conducting",
     .cells = {32, 32, 1},
     .sides = {slip, slip, slip, wall, symmetry, symmetry},
     .viscosity = 0.02,
     .conductivity = 0.03},
    {.name = "cube_waves",
     .cells = {16, 16, 16},
     .sides = {waves, waves, slip, slip, waves, wall},
     .viscosity = 0.02},
    {.name = "cube_means",
     .cells = {16, 16, 16},
     .sides = {waves, waves, open, waves, waves, wall},
     .far_flow = false},
    {.name = "cube_classic",
     .cells = {16, 16, 16},
     .sides = {wall, open, inflow, symmetry, periodic, periodic},
     .internal_energy_form = true},
    {.name = "tube_levels",
     .cells = {64, 1, 1},
     .sides = {wall, open, symmetry, symmetry, symmetry, symmetry},
     .levels = {.most = 3, .ratios = {{2, 2, 2}, {4, 4, 4}}, .threshold = 8}},
    {.name = "tube_levels_lockstep",
     .cells = {64, 1, 1},
     .sides = {periodic, periodic, symmetry, symmetry, symmetry, symmetry},
     .levels = {.most = 3, .threshold = 8, .order = 0, .lock_step = true}},
    {.name = "square_levels",
     .cells = {32, 32, 1},
     .sides = {wall, open, inflow, symmetry, symmetry, symmetry},
     .levels = {.most = 3, .threshold = 8}},
    {.name = "square_levels_ratio_4",
     .cells = {16, 16, 1},
     .sides = {periodic, periodic, wall, open, symmetry, symmetry},
     .viscosity = 0.02,
     .levels = {.most = 3,
                .ratios = {{4, 4, 4}, {2, 2, 2}},
                .threshold = 8,
                .stability = {2, 2, 2},
                .deletion = {},
                .interval = 5,
                .order = 2}},
    {.name = "square_levels_skew",
     .cells = {16, 32, 1},
     .sides = {periodic, periodic, wall, open, symmetry, symmetry},
     .second_order = false,
     .levels = {.most = 3,
                .ratios = {{4, 2, 2}, {2, 4, 2}},
                .tiles = {{8, 4, 8}},
                .threshold = 8,
                .stability = {1, 2, 0},
                .regrid = {1, 0, 0},
                .deletion = {},
                .margin = {2, 1, 1},
                .interval = 5}},
    {.name = "square_levels_classic",
     .cells = {32, 32, 1},
     .sides = {wall, open, inflow, symmetry, symmetry, symmetry},
     .internal_energy_form = true,
     .levels = {.most = 2, .threshold = 8}},
    {.name = "square_levels_all",
     .cells = {32, 32, 1},
     .sides = {wall, moving_wall, symmetry, open, periodic, periodic},
     .gravity = {0, 0, 0.01},
     .viscosity = 0.02,
     .cross_flow = true,
     .levels = {.most = 2, .threshold = 8}},
    // in a corner, at a periodic end, with a corner that points inwards
    {.name = "square_fixed",
     .cells = {32, 32, 1},
     .sides = {wall, open, periodic, periodic, symmetry, symmetry},
     .levels = {.most = 3,
                .ratios = {{2, 2, 1}, {4, 2, 1}},
                .fixed = {{{{-1, -1, 0}, {0, -0.5, 0}}, {{-0.5, -0.5, 0}, {0.5, 0.25, 0}}},
                          {{{-0.375, -0.25, 0}, {0.25, 0.125, 0}},
                           {{-1, -0.875, 0}, {-0.5, -0.625, 0}}}}}},
    {.name = "cube_levels",
     .cells = {16, 16, 16},
     .sides = {wall, open, inflow, symmetry, periodic, periodic},
     .levels = {.most = 2, .threshold = 4}},
};

// The dense part is of another material: a gas or a liquid, that moves with the gas or by itself.
const SkewSecond gas{"<EOS type=\"ideal_gas\"/>"};
SkewSecond liquid(double drag, double heat) {
  return {"<EOS type=\"StiffenedGas\"><pinf>0.6</pinf></EOS>", 4.4, 0.5, drag, heat};
}
SkewSecond free_gas() {
  SkewSecond second = gas;
  second.drag = 0;
  return second;
}

// Hard spheres under drag and heat that grow with the ratio of masses.
const SkewSecond hard_spheres{"<EOS type=\"hard_sphere_gas\"><b>0.05</b></EOS>",
                              1.5,
                              2,
                              0.5,
                              0.2,
                              "<CoefficientModel><momentum>linearVariation</momentum>"
                              "<heat>linearVariation</heat></CoefficientModel>"};
// A liquid along whose surface the gas slips, or that it heats through a film.
SkewSecond slippery_liquid() {
  SkewSecond second = liquid(10, 2);
  second.exchange =
      "<Model type=\"slip\"><fluidMatlIndex>0</fluidMatlIndex><solidMatlIndex>1</solidMatlIndex>"
      "<momentum_accommodation_coeff>0.3</momentum_accommodation_coeff>"
      "<thermal_accommodation_coeff>0.4</thermal_accommodation_coeff></Model>";
  return second;
}
SkewSecond heated_liquid() {
  SkewSecond second = liquid(1e15, 2);
  second.exchange =
      "<do_convective_heat_transfer>true</do_convective_heat_transfer>"
      "<convective_fluid>0</convective_fluid><convective_solid>1</convective_solid>";
  return second;
}

const SkewCase mixtures[] = {
    {.name = "tube_of_gases",
     .cells = {64, 1, 1},
     .sides = {wall, open, symmetry, symmetry, symmetry, symmetry},
     .second = gas},
    {.name = "tube_of_liquid_dragged",
     .cells = {64, 1, 1},
     .sides = {wall, open, symmetry, symmetry, symmetry, symmetry},
     .second = liquid(10, 2)},
    {.name = "square_of_gases_viscous",
     .cells = {32, 32, 1},
     .sides = {moving_wall, wall, open, wall, symmetry, symmetry},
     .viscosity = 0.02,
     .conductivity = 0.03,
     .second = gas},
    {.name = "square_of_liquid",
     .cells = {32, 32, 1},
     .sides = {wall, open, waves, wall, symmetry, symmetry},
     .second = liquid(1e15, 3)},
    {.name = "square_of_liquid_among_means",
     .cells = {32, 32, 1},
     .sides = {waves, open, waves, waves, symmetry, symmetry},
     .second = liquid(1e15, 3),
     .far_flow = false},
    {.name = "square_of_free_gases",
     .cells = {32, 32, 1},
     .sides = {wall, open, periodic, periodic, symmetry, symmetry},
     .viscosity = 0.01,
     .second = free_gas()},
    {.name = "square_of_liquid_on_levels",
     .cells = {32, 32, 1},
     .sides = {wall, open, open, wall, symmetry, symmetry},
     .levels = {.most = 2, .threshold = 8},
     .second = liquid(1e15, 0)},
    {.name = "square_of_free_gases_on_levels",
     .cells = {32, 32, 1},
     .sides = {wall, open, open, wall, symmetry, symmetry},
     .levels = {.most = 3, .threshold = 8},
     .second = free_gas()},
    {.name = "square_of_hard_spheres_on_levels",
     .cells = {32, 32, 1},
     .sides = {wall, open, periodic, periodic, symmetry, symmetry},
     .levels = {.most = 2, .threshold = 8},
     .second = hard_spheres},
    {.name = "square_of_slippery_liquid",
     .cells = {32, 32, 1},
     .sides = {wall, open, open, wall, symmetry, symmetry},
     .viscosity = 0.02,
     .conductivity = 0.03,
     .second = slippery_liquid()},
    {.name = "square_of_heated_liquid",
     .cells = {32, 32, 1},
     .sides = {wall, open, open, wall, symmetry, symmetry},
     .viscosity = 0.02,
     .conductivity = 0.03,
     .second = heated_liquid()},
    {.name = "square_of_gases_turbulent",
     .cells = {32, 32, 1},
     .sides = {wall, open, periodic, periodic, symmetry, symmetry},
     .viscosity = 0.005,
     .levels = {.most = 2, .threshold = 8},
     .turbulence = "Germano",
     .second = gas},
    {.name = "cube_of_free_gases_turbulent",
     .cells = {16, 16, 16},
     .sides = {moving_wall, wall, open, wall, periodic, periodic},
     .viscosity = 0.005,
     .turbulence = "Smagorinsky",
     .second = free_gas()},
    {.name = "cube_of_liquid_dragged",
     .cells = {16, 16, 16},
     .sides = {wall, open, open, wall, periodic, periodic},
     .viscosity = 0.02,
     .second = liquid(10, 3)},
};

// In ./dev test: every kind of side and of effect, levels that move and that stay.
const CaseNames quick = {
    "tube_first_order", "tube_cross_flow", "tube_classic", "tube_levels",  "tube_levels_lockstep",
    "square",           "square_waves",    "square_all",   "square_means", "square_slip_conducting",
    "square_turbulent", "square_fixed",    "cube_all"};
const CaseNames quick_mixtures = {"tube_of_gases",
                                  "tube_of_liquid_dragged",
                                  "square_of_free_gases",
                                  "square_of_liquid_on_levels",
                                  "square_of_slippery_liquid",
                                  "square_of_heated_liquid"};
const auto name_of_case = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Cases, Symmetry, testing::ValuesIn(cases_named(cases, quick)),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Mixtures, Symmetry,
                         testing::ValuesIn(cases_named(mixtures, quick_mixtures)), name_of_case);
INSTANTIATE_TEST_SUITE_P(Full, Symmetry, testing::ValuesIn(cases_besides(cases, quick)),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(FullMixtures, Symmetry,
                         testing::ValuesIn(cases_besides(mixtures, quick_mixtures)), name_of_case);

}  // namespace
}  // namespace sluice::properties::symmetry_property_test
