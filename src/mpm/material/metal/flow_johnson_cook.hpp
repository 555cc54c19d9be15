// johnson_cook (Johnson and Cook 1983):
//
//   sigma_f = (A + B eps_p^n)(1 + C ln max(rate/rate_0, 1))(1 - T*^m),   T* = (T - T_r)/(T_m - T_r)
// Below T_r the last factor is 1 - T*, above T_m it is 0.
#pragma once
#include <algorithm>
#include <cmath>

#include "mpm/material/base/parameters.hpp"
#include "mpm/material/metal/metal_state.hpp"

namespace sluice::mpm {

struct JohnsonCook {
  double A = 0, B = 0, C = 0, n = 0, m = 0;    // Pa, Pa, numbers
  double room = 298, melt = 1793, rate_0 = 1;  // T_r and T_m, K; 1/s

  struct Here {
    double thermal;  // the last factor
  };
  Here at(const MetalState& s) const {
    const double x = (s.temperature - room) / (melt - room);
    return {x <= 0 ? 1 - x : x < 1 ? 1 - std::pow(x, m) : 0};
  }
  double stress(const Here& here, double strain, double rate) const {
    return (A + B * std::pow(strain, n)) * (1 + C * std::log(std::max(rate / rate_0, 1.0))) *
           here.thermal;
  }

  static Tags tags() {
    return {tag("A", "yield stress, Pa").once().real().at_least(0),
            number("B", "hardening, Pa"),
            number("C", "sensitivity to the rate of strain"),
            tag("n", "exponent of hardening").once().real().at_least(0),
            tag("m", "exponent of thermal softening").once().real().at_least(0),
            positive_or("T_r", "temperature without softening, K", 298),
            tag("T_m",
                "melting temperature, K; absent: <melt_temp> of the material, without that "
                "1793")
                .real()
                .above(0),
            positive_or("epdot_0", "rate without effect, 1/s", 1)};
  }
  static JohnsonCook read(const Parameters& p) {
    const double of_material = p.constants().melt_temperature;
    const double melt = p.has("T_m") ? p.real("T_m") : of_material < 1e10 ? of_material : 1793;
    if (!(melt > p.real("T_r")))
      p.error("T_m", "<T_m> must be greater than <T_r>: softening goes from one to the other");
    return {p.real("A"), p.real("B"),   p.real("C"), p.real("n"),
            p.real("m"), p.real("T_r"), melt,        p.real("epdot_0")};
  }
};

}  // namespace sluice::mpm
