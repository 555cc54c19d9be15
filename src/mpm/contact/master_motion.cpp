#include "mpm/contact/master_motion.hpp"

#include <cmath>

namespace sluice::mpm {
namespace {

using Row = std::array<double, 10>;

// R - 1 applied to r: sin(a) k x r + 2 sin(a/2)^2 k x (k x r), k along the spin, a = |spin| dt.
Vec3 turned_by(Vec3 spin, double dt, Vec3 r) {
  const double rate = std::sqrt(dot(spin, spin));
  if (!(rate > 0)) return {};
  const Vec3 k = (1 / rate) * spin, across = cross(k, r);
  const double half = std::sin(0.5 * rate * dt);
  return std::sin(rate * dt) * across + (2 * half * half) * cross(k, across);
}

Row value_at(const std::vector<Row>& rows, std::size_t n, double t) {
  const Row &a = rows[n], &b = rows[n + 1];
  const double share = (t - a[0]) / (b[0] - a[0]);
  Row v{};
  for (std::size_t c = 1; c < v.size(); ++c) v[c] = a[c] + share * (b[c] - a[c]);
  return v;
}

// Mean of the rows over the time from t0 to t1 > t0.
Row mean_of(const std::vector<Row>& rows, double t0, double t1) {
  Row sum{};
  const auto add = [&](const Row& a, const Row& b, double from, double to) {
    for (std::size_t c = 1; c < sum.size(); ++c)
      sum[c] += 0.5 * (a[c] + b[c]) * ((to - from) / (t1 - t0));
  };
  const Row &first = rows.front(), &last = rows.back();
  if (t0 < first[0]) add(first, first, t0, std::min(t1, first[0]));
  for (std::size_t n = 0; n + 1 < rows.size(); ++n) {
    const double from = std::max(t0, rows[n][0]), to = std::min(t1, rows[n + 1][0]);
    if (from < to) add(value_at(rows, n, from), value_at(rows, n, to), from, to);
  }
  if (t1 > last[0]) add(last, last, std::max(t0, last[0]), t1);
  return sum;
}

}  // namespace

Vec3 MasterMotion::at(Vec3 x) const {
  if (!rotates) return velocity;
  return velocity + (1 / dt) * turned_by(spin, dt, x - origin);
}

std::array<double, 9> MasterMotion::gradient() const {
  std::array<double, 9> g{};
  if (!rotates) return g;
  for (int c = 0; c < 3; ++c) {
    Vec3 unit{};
    unit[c] = 1;
    const Vec3 column = (1 / dt) * turned_by(spin, dt, unit);
    for (int r = 0; r < 3; ++r) g[3 * r + c] = column[r];
  }
  return g;
}

bool is_prescribed(const ContactRule& rule, double time, double dt) {
  return !rule.profile.empty() || (rule.stop_time && time + dt > *rule.stop_time);
}

MasterMotion motion_in_step(const ContactRule& rule, double time, double dt) {
  MasterMotion m;
  m.dt = dt;
  const double end = time + dt;
  const double stop = rule.stop_time ? std::clamp(*rule.stop_time, time, end) : end;
  const double moving = (stop - time) / dt;  // share of the step
  m.velocity = (1 - moving) * rule.velocity_after_stop;
  if (!(moving > 0) || rule.profile.empty()) return m;
  const Row mean = mean_of(rule.profile, time, stop);
  m.velocity += moving * Vec3{mean[1], mean[2], mean[3]};
  m.origin = {mean[4], mean[5], mean[6]};
  m.spin = moving * Vec3{mean[7], mean[8], mean[9]};
  m.rotates = rule.rotates;
  return m;
}

}  // namespace sluice::mpm
