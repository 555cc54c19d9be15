// Rarefied gas that slips along a wall: its velocity and temperature on the wall, from those of the
// cell beside it.
//
//   u_s = u_w + L u' - C lambda^2 u'' + [creep] 3/4 mu/(rho T) dT/ds     ' along the inward normal
//   L = lambda (2 - a)/a,  lambda = mu/(rho sqrt(2 R T/pi)) = mu sqrt(pi/(2 rho p))
//   C = 0 (first order), 9/8 (Deissler), -(2 - a)/(2 a) (Karniadakis and Beskok)
// u' is 2 (u - u_s)/dx, with u_s itself in it: whatever lambda/dx, u_s lies between u_w and u.
// u'' is that of a thin layer in steady flow, mu u'' = dp/ds - rho g. From differences of u it
// would feed back upon itself: the third model then amplifies what is shorter than 2.7 lambda.
//   T_s = T_w + B T' - D lambda^2 T'',  B = lambda (2 - a_T)/a_T 2 k/((gamma + 1) cv mu)
//   D = 0, 9/128 (177 gamma - 145)/(gamma + 1), -B/(2 lambda);  k T'' = -mu u'^2 likewise
// lambda is there that at T_s.
// Limits: Knudsen numbers up to about 0.1; Deissler's derivatives along the wall are left out.
// References: J. C. Maxwell, Phil. Trans. 170 (1879) 231; R. G. Deissler, Int. J. Heat Mass Trans.
// 7 (1964) 681; G. Karniadakis, A. Beskok, N. Aluru, Microflows and Nanoflows (2005), chapter 2.
#pragma once
#include "framework/base/vec3.hpp"

namespace sluice::ice {

struct FaceCondition;

// <microSlip>.
struct SlipSettings {
  enum class Model { first_order, deissler, karniadakis_beskok };
  Model model = Model::first_order;
  double momentum_accommodation = 1, thermal_accommodation = 1;  // a, a_T: shares, 0 to 1
  bool creep = false;                                            // at all its walls
  Vec3 force{};  // that drives the gas beside gravity, N/m^3

  bool second_order() const { return model != Model::first_order; }
};

// Of an ideal gas, m.
double mean_free_path(double viscosity, double rho, double p);

// The cell next to the wall, and one direction along it.
struct SlipCell {
  double rho = 1, p = 1, temperature = 1, viscosity = 0;  // kg/m^3, Pa, K, Pa s
  double spacing = 1;                                     // across the wall, m
  double velocity = 0;                                    // along it, m/s
  double wall_velocity = 0;                               // m/s
  double pull = 0;                                        // dp/ds - rho g, Pa/m
  double warming = 0;                                     // dT/ds, K/m
};

// The same for heat.
struct SlipHeat {
  double rho = 1, p = 1, temperature = 1;  // kg/m^3, Pa, K
  double specific_heat = 1;                // cv, J/(kg K)
  double viscosity = 0, conductivity = 0;  // Pa s, W/(m K)
  double spacing = 1;                      // across the wall, m
  double wall_temperature = 1;             // K
  double shear = 0;                        // u'^2, 1/s^2
};

// On the wall, m/s and K. `creep`: with thermal creep.
double slip_velocity(const SlipSettings& settings, const SlipCell& cell, bool creep);
double slip_temperature(const SlipSettings& settings, const SlipHeat& cell);

FaceCondition slip_condition();
FaceCondition creep_condition();

}  // namespace sluice::ice
