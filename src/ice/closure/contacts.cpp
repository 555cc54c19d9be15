// Heat through the contacts of materials at a face.
#include "ice/closure/contacts.hpp"

#include <algorithm>
#include <utility>

#include "ice/closure/surface_law.hpp"
#include "ice/fluid/face_mean.hpp"
#include "ice/fluid/material_set.hpp"

namespace sluice::ice::mixture {

HeatContacts::HeatContacts(int materials, const PairCoefficients& heat_exchange,
                           std::optional<MultiVelocityExchange> slip,
                           std::optional<ConvectiveExchange> convective)
    : materials_(materials),
      H_(heat_exchange),
      slip_(std::move(slip)),
      convective_(std::move(convective)) {}

double HeatContacts::conductivity(const ContactSide& low, int a, const ContactSide& high, int b,
                                  double dx) const {
  const double k_a = low.conductivity[a], k_b = high.conductivity[b];
  if (a == b) return harmonic_mean(k_a, k_b);
  double H = H_.materials() > 0 ? H_(a, b) : 0.0;
  const bool film = convective_ && convective_->between(a, b);
  if (!(H > 0.0 && (film || (k_a > 0.0 && k_b > 0.0)))) return 0.0;
  if (H_.varies()) H = H_.between(a, b, low.density[a], high.density[b]);
  double layers = 0.5 * ((k_a > 0.0 ? 1.0 / k_a : 0.0) + (k_b > 0.0 ? 1.0 / k_b : 0.0));
  if (slip_ && slip_->between(a, b)) {
    const double h = a == slip_->fluid ? low.jump : high.jump;
    if (!(h > 0.0)) return 0.0;
    layers += 1.0 / (h * dx);
  }
  return 1.0 / (layers + (film ? 1.0 : 4.0) / (H * (dx * dx)));
}

double HeatContacts::left_to_face(const ContactSide& low, const ContactSide& high) const {
  const auto part = [&](const ContactSide& side) {
    return shared_part(side.share[slip_->fluid], side.share[slip_->solid]);
  };
  return 1.0 - std::max(part(low), part(high));
}

void HeatContacts::conduct(const ContactSide& low, const ContactSide& high, double dx,
                           double* given, double* taken) const {
  const int count = materials_;
  const double inverse_dx = 1.0 / dx;
  double rest_low[max_materials], rest_high[max_materials];
  double sum_low = 0, sum_high = 0;
  const auto share = [](double s) { return s >= min_conducting_share ? s : 0.0; };
  const auto heat = [&](int a, int b) {
    const double k = conductivity(low, a, high, b, dx);
    if (!(k > 0.0)) return 0.0;
    const double bound = std::min(low.max_conductivity[a], high.max_conductivity[b]);
    return std::min(k, bound) * ((low.temperature[a] - high.temperature[b]) * inverse_dx);
  };
  for (int m = 0; m < count; ++m) {
    const double a = share(low.share[m]), b = share(high.share[m]), common = std::min(a, b);
    given[m] = taken[m] = common > 0.0 ? common * heat(m, m) : 0.0;
    sum_low += rest_low[m] = a - common;
    sum_high += rest_high[m] = b - common;
  }
  const double rest = std::max(sum_low, sum_high);
  if (!(rest > 0.0)) return;
  const double inverse_rest = 1.0 / rest;
  for (int a = 0; a < count; ++a) {
    if (!(rest_low[a] > 0.0)) continue;
    for (int b = 0; b < count; ++b) {
      if (!(rest_high[b] > 0.0)) continue;
      double q = rest_low[a] * rest_high[b] * inverse_rest * heat(a, b);
      if (slip_ && slip_->between(a, b)) q *= left_to_face(low, high);
      given[a] += q;
      taken[b] += q;
    }
  }
}

}  // namespace sluice::ice::mixture
