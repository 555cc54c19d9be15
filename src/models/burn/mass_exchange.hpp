// Model "Test": mass of one material becomes another's at a constant rate.
//
//   dm/dt = -k m from startTime on: of what is there, the share 1 - exp(-k (t1 - t0)) passes in a
//   step, t0..t1 being the part of the step in which the model acts
// or as JWL++ has it (jwlpp.hpp), or by a prescribed front (light_time.hpp). With it go its volume,
// its momentum and its internal energy: totals stay. The shares of two steps are together the share
// of one as long: the law is exact whatever the steps are.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/deck/deck.hpp"
#include "models/burn/burn_law.hpp"
#include "models/burn/jwlpp.hpp"
#include "models/burn/light_time.hpp"
#include "models/deck/reactant.hpp"
#include "models/sources/time_window.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

struct MassExchange {
  int from = 0, to = 0;  // materials, each among its like
  double rate = 0;       // 1/s
  TimeWindow when;
  Location where;
  std::optional<JwlPp> by_pressure;   // in place of the constant rate
  std::optional<LightTime> by_front;  // likewise

  // Share of the mass at `time` that has passed at time + dt (s).
  double share(double time, double dt) const;
};

TagSpec mass_exchange_tag();
MassExchange read_jwlpp(const DeckNode& parameters, const MaterialNames& names);
MassExchange read_light_time(const DeckNode& parameters, const MaterialNames& names);
MassExchange read_mass_exchange(const DeckNode& parameters, const MaterialNames& names);
// The same two laws for a solid that becomes a fluid.
std::shared_ptr<const BurnLaw> read_solid_exchange(const DeckNode& parameters,
                                                   const MaterialNames& names);
std::shared_ptr<const BurnLaw> read_solid_jwlpp(const DeckNode& parameters,
                                                const MaterialNames& names);

}  // namespace sluice::models
