// Friction and conduction of a gas that is a mixture of two: where one of them is alone they are
// its own, with laws of viscosity, sponge layers and turbulence.
#include <gtest/gtest.h>

#include <cmath>

#include "ice/test_support/transport.hpp"

namespace sluice::ice::mixed_gas_transport_test {
namespace {

constexpr double cv[] = {1, 3}, mu[] = {2e-3, 5e-3}, k[] = {3e-3, 1e-2}, gas_ratio = .4;

// With both gases' viscosities, or without.
std::string binary(bool viscosities) {
  std::string constants;
  for (int n = 0; n < 2; ++n) {
    const char* of = n == 0 ? "_A" : "_B";
    constants +=
        fmt::format("<cv{0}>{1}</cv{0}><R{0}>{2}</R{0}><thermalCond{0}>{3}</thermalCond{0}>", of,
                    cv[n], gas_ratio * cv[n], k[n]);
    if (viscosities)
      constants += fmt::format("<dynamic_viscosity{0}>{1}</dynamic_viscosity{0}>", of, mu[n]);
  }
  return "<Model type='BinaryProperties'><BinaryProperties><material>gas</material>"
         "<scalar name='f'><constants>" +
         constants +
         "</constants><geom_object><box label='all'><min>[-9,-9,-9]</min><max>[9,9,9]</max></box>"
         "<scalar>0</scalar></geom_object></scalar></BinaryProperties></Model>";
}

MixtureCell start(Vec3 x) {
  return moving_waves(x, {1});
}

struct Case {
  const char* name;
  bool own_viscosity;  // of the model
  Transport transport;
};
std::vector<Case> cases() {
  ViscosityModels sutherland, sponge;
  sutherland.sutherland = Sutherland{.005, 1};
  sponge.sponges.push_back({{{{.3, .2, -1}, {.7, .6, 2}}}, .02});
  Turbulence smagorinsky, germano;
  smagorinsky.constant = .4;
  germano.dynamic = true;
  return {{"Sutherland", false, {{0}, {}, 0, {sutherland}, {}, {}, {}}},
          {"sponge", true, {{}, {}, 0, {sponge}, {}, {}, {}}},
          {"Smagorinsky", true, {{}, {}, 0, {}, smagorinsky, {}, {}}},
          {"Germano with Sutherland", false, {{0}, {}, 0, {sutherland}, germano, {}, {}}}};
}

TEST(MixedGasTransport, IsThatOfTheGasThatIsAlone) {
  constexpr double round_off = 1e-14, acts = 1e-3;  // measured 5.6e-16, 1.8e-3
  for (const Case& c : cases())
    for (const int n : {0, 1}) {
      GasBox box;
      box.cells = {24, 20, 1};
      box.scheme = "conservative";
      box.advection = "type='FirstOrder'";  // slopes of a mixed gas have bounds of their own
      GasBox with_model = box;
      with_model.models = binary(c.own_viscosity);
      Transport mixed = c.transport, alone = c.transport, without;
      if (c.own_viscosity) {
        mixed.viscosity = {mu[1]};  // the larger
        alone.viscosity = without.viscosity = {mu[n]};
      }
      mixed.conductivity = {k[1]};
      alone.conductivity = without.conductivity = {k[n]};
      const Fluid gas = ideal_gas(1 + gas_ratio, cv[n]);
      MixtureBox one(box, {gas}, start, {}, {}, alone), plain(box, {gas}, start, {}, {}, without);
      MixtureBox two(with_model, {gas}, start, {}, {}, mixed);
      const Label fraction = two.ice().state().slots().back().label;
      ASSERT_NE(fraction.name().find('f'), std::string::npos);
      for_each_cell(two.domain(), [&](IntVec3 i) { two.view(fraction, 0, 0, i)(i) = n; });
      two.solver().mark_modified();
      for (int step = 0; step < 40; ++step)
        for (MixtureBox* run : {&one, &two, &plain}) run->step(.3 / 24 / 1.6);
      double velocity = 0, energy = 0, change = 0;
      for_each_cell(one.domain(), [&](IntVec3 i) {
        velocity = std::fmax(velocity, std::fabs(two.velocity(i) - one.velocity(i)));
        energy = std::fmax(energy, std::fabs(two.energy(0, i) / one.energy(0, i) - 1));
        change = std::fmax(change, std::fabs(plain.velocity(i) - one.velocity(i)));
      });
      std::printf("%s, gas %d: u %.1e E %.1e, effect %.1e\n", c.name, n, velocity, energy, change);
      EXPECT_GT(change, acts) << c.name;
      EXPECT_LE(velocity, round_off) << c.name;
      EXPECT_LE(energy, round_off) << c.name;
    }
}

}  // namespace
}  // namespace sluice::ice::mixed_gas_transport_test
