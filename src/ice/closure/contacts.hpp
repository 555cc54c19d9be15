// Which materials of two neighbouring cells touch at their face, and what heat passes there.
//
// Of the face's area a material takes its share of the cell on either side. It touches itself over
// the smaller of its two shares; what is left of a on the low side and of b on the high side touch
// over r_a r_b/R, R the sum of what is left. Through each contact passes, per its area,
//   q = k (T_low - T_high)/dx,   k = k_m where a material touches itself,
//   1/k = (1/k_a + 1/k_b)/2 + 4/(H_ab dx^2) where two meet:
// half a cell of each and between them an interface that conducts as one in the middle of a cell
// does by heat exchange, V_a V_b H dx with V = 1/2 each. Without heat exchange it is adiabatic.
// A coefficient that varies with the masses is that of halves of the two cells. Between a surface
// and the fluid beside it (convective exchange) 1/(H_ab dx^2) takes the place of the last term,
// and what does not conduct holds its heat evenly. Gas that slips adds 1/(h dx), over what is left
// to the face (surface.hpp), h the heat that passes for a unit of jump.
// So that no temperature leaves the range of its neighbours, k is at most
//   rho_m cv_m/(2 dt sum 1/dx^2) of each of the two (half of it below a hundredth of a cell).
// Areas of a material sum to its share: the bound holds for the vanishing trace too.
#pragma once
#include "ice/deck/exchange_settings.hpp"

namespace sluice::ice::mixture {

// threshold: share of the cell below which a material neither gives nor takes heat through faces;
//   unit: 1; test: HeatContacts.TracesStayBetweenTheirNeighbours
constexpr double min_conducting_share = 1e-8;
// threshold: share of the cell below which the conduction and friction of a material do not limit
//   the time step; unit: 1; test: none
constexpr double min_limiting_share = 0.01;
// threshold: share of the cell's mass below which they do not limit it either; unit: 1; test: none
constexpr double min_limiting_mass = 1e-9;

// One side of a face, by material.
struct ContactSide {
  const double* share;             // 0: absent
  const double* temperature;       // K
  const double* max_conductivity;  // W/(m K)
  const double* conductivity;      // W/(m K)
  const double* density;           // own, kg/m^3; where exchange varies with it
  double jump = 0;                 // h of the gas that slips, W/(m^2 K)
};

class HeatContacts {
 public:
  HeatContacts(int materials, const PairCoefficients& heat_exchange,
               std::optional<MultiVelocityExchange> slip = {},
               std::optional<ConvectiveExchange> convective = {});

  // Heat per area and time along the axis, W/m^2, by material: what each of the low side gives, and
  // what each of the high side takes.
  void conduct(const ContactSide& low, const ContactSide& high, double dx, double* given,
               double* taken) const;

 private:
  // Of the contact of `a` of the low and `b` of the high side, W/(m K).
  double conductivity(const ContactSide& low, int a, const ContactSide& high, int b,
                      double dx) const;

  // The share of a contact with slip that cells do not take.
  double left_to_face(const ContactSide& low, const ContactSide& high) const;

  int materials_;
  PairCoefficients H_;
  std::optional<MultiVelocityExchange> slip_;
  std::optional<ConvectiveExchange> convective_;
};

}  // namespace sluice::ice::mixture
