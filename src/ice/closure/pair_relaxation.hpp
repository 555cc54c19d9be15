// Exchange between the materials of a cell: C_m dv_m/dt = sum_n k_mn (v_n - v_m), over one step.
//
// C is a heat capacity or a mass, v a temperature or a velocity, k symmetric and not negative.
// Two materials: the exponential itself,
//   v_1 - v_2 -> (v_1 - v_2) exp(-k dt (1/C_1 + 1/C_2)).
// More: two stages of an L-stable method of second order (Alexander, SIAM J. Numer. Anal. 14 (1977)
// 1006), g = 1 - 1/sqrt(2):
//   (C + g dt K) a = C v,   (C + g dt K) v' = C (v + (1 - g)/g (a - v)).
// Each system is eliminated without a subtraction (Grassmann, Taksar and Heyman, Oper. Res. 33
// (1985) 1107), so that coefficients from 0 to 1e20 keep all digits; both limits are exact.
#pragma once

namespace sluice::ice::mixture {

// `k`: dt k_mn, row by row, n * n, in the unit of C; changed. `gain`: C_m (v_m' - v_m), which sums
// to zero. All capacities above zero; 2 <= n <= max_materials. `push`, where given, is what each
// gets besides over the step, evenly in time, in the unit of `gain`; it sums to zero. Units: C in
// J/(m^3 K) with v in K, or kg/m^3 with m/s.
void relax_pairs(int n, const double* capacity, const double* value, double* k, double* gain,
                 const double* push = nullptr);

// (C + K) v = right, in place of `right`; C and `k` as above.
void solve_pairs(int n, const double* capacity, double* k, double* right);

}  // namespace sluice::ice::mixture
