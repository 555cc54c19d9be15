// Heat through the contacts of materials at a face.
#include "ice/mixture/contacts.hpp"

#include <algorithm>
#include <utility>

#include "ice/mixture/runs.hpp"

namespace sluice::ice::mixture {

HeatContacts::HeatContacts(std::vector<double> conductivity, const PairCoefficients& heat_exchange)
    : k_(std::move(conductivity)), H_(heat_exchange) {}

double HeatContacts::conductivity(int a, int b, double dx) const {
  const double k_a = k_[static_cast<std::size_t>(a)], k_b = k_[static_cast<std::size_t>(b)];
  if (a == b) return k_a;
  const double H = H_.materials() > 0 ? H_(a, b) : 0.0;
  if (!(k_a > 0.0 && k_b > 0.0 && H > 0.0)) return 0.0;
  return 1.0 / (0.5 * (1.0 / k_a + 1.0 / k_b) + 4.0 / (H * (dx * dx)));
}

void HeatContacts::conductivities(double dx, double* k) const {
  for (int a = 0; a < materials(); ++a)
    for (int b = 0; b < materials(); ++b) k[a * materials() + b] = conductivity(a, b, dx);
}

void HeatContacts::conduct(const ContactSide& low, const ContactSide& high, double inverse_dx,
                           const double* k, double* given, double* taken) const {
  const int count = materials();
  double rest_low[most_materials], rest_high[most_materials];
  double sum_low = 0, sum_high = 0;
  const auto share = [](double s) { return s >= least_conducting_share ? s : 0.0; };
  const auto heat = [&](int a, int b) {
    const double bound = std::min(low.most_conductivity[a], high.most_conductivity[b]);
    return std::min(k[a * count + b], bound) *
           ((low.temperature[a] - high.temperature[b]) * inverse_dx);
  };
  for (int m = 0; m < count; ++m) {
    const double a = share(low.share[m]), b = share(high.share[m]), common = std::min(a, b);
    given[m] = taken[m] = common > 0.0 && k[m * count + m] > 0.0 ? common * heat(m, m) : 0.0;
    sum_low += rest_low[m] = a - common;
    sum_high += rest_high[m] = b - common;
  }
  const double rest = std::max(sum_low, sum_high);
  if (!(rest > 0.0)) return;
  const double inverse_rest = 1.0 / rest;
  for (int a = 0; a < count; ++a) {
    if (!(rest_low[a] > 0.0)) continue;
    for (int b = 0; b < count; ++b) {
      if (!(rest_high[b] > 0.0 && k[a * count + b] > 0.0)) continue;
      const double q = rest_low[a] * rest_high[b] * inverse_rest * heat(a, b);
      given[a] += q;
      taken[b] += q;
    }
  }
}

}  // namespace sluice::ice::mixture
