#include "exact/radial/radial_lagrangian.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

// Area swept per unit of path by a face that moves from a to b.
double mean_area(double a, double b, int dimension) {
  if (dimension == 1) return 1;
  return dimension == 2 ? 0.5 * (a + b) : (a * a + a * b + b * b) / 3;
}

struct Side {
  double rho, u, p, c;
};

struct Push {
  double pressure, slope;  // rise of the pressure, and how it grows with the change of velocity
};

// What a gas of sound speed c answers to being pushed at the velocity du: the shock's pressure
// exactly, an expansion by its acoustic one.
Push push(const Side& side, double du, double gamma) {
  if (du <= 0) return {side.rho * side.c * du, side.rho * side.c};
  const double a = 0.25 * (gamma + 1) * du, root = std::hypot(side.c, a);
  return {side.rho * du * (a + root), side.rho * (a + root) * (1 + a / root)};
}

struct Contact {
  double u, p;
};

// Velocity and pressure of the contact of two states, by Newton's method from the acoustic one.
Contact meet(const Side& l, const Side& r, double gamma) {
  constexpr int most = 20;
  const double zl = l.rho * l.c, zr = r.rho * r.c;
  double u = ((zl * l.u + zr * r.u) + (l.p - r.p)) / (zl + zr);
  Push left{}, right{};
  for (int k = 0; k < most; ++k) {
    left = push(l, l.u - u, gamma);
    right = push(r, u - r.u, gamma);
    const double change =
        ((l.p + left.pressure) - (r.p + right.pressure)) / (left.slope + right.slope);
    u += change;
    if (std::abs(change) <= 1e-14 * (std::abs(u) + l.c + r.c)) break;
  }
  const double p = 0.5 * ((l.p + left.pressure) + (r.p + right.pressure));
  // An acoustic expansion can cross zero.
  return {u, std::max(p, 0.1 * std::min(l.p, r.p))};
}

}  // namespace

RadialLagrangian::RadialLagrangian(RadialProblem problem) : problem_(std::move(problem)) {
  check(problem_);
  place_faces();
  const std::size_t n = face_.size() - 1;
  for (auto* field : {&mass_, &energy_}) field->assign(n, 0.0);
  for (auto* field : {&face_u_, &face_p_}) field->assign(n + 1, 0.0);
  for (auto* field : {&centre_, &rho_, &u_, &p_, &u_lo_, &u_hi_, &p_lo_, &p_hi_, &p_half_}) {
    field->assign(n + 2, 0.0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const RadialMeans mean = start_means(problem_, face_[i], face_[i + 1]);
    const std::size_t c = i + 1;
    mass_[i] = mean.density * radial_volume(face_[i], face_[i + 1], problem_.dimension);
    energy_[i] = mean.energy / mean.density;
    rho_[c] = mean.density;
    u_[c] = mean.momentum / mean.density;
    p_[c] = (problem_.gamma - 1) * (mean.energy - 0.5 * mean.momentum * u_[c]);
    centre_[c] = 0.5 * (face_[i] + face_[i + 1]);
  }
  mirror();
}

// Even cells; the face next to an edge of the start moves onto it.
void RadialLagrangian::place_faces() {
  const double dr = (problem_.high - problem_.low) / problem_.cells;
  for (int f = 0; f <= problem_.cells; ++f) face_.push_back(problem_.low + dr * f);
  face_.back() = problem_.high;
  for (std::size_t k = 0; k + 1 < problem_.pieces.size(); ++k) {
    const double edge = problem_.pieces[k].end;
    const double place = std::round((edge - problem_.low) / dr);
    if (place > 0 && place < problem_.cells) face_[static_cast<std::size_t>(place)] = edge;
  }
}

void RadialLagrangian::mirror() {
  const std::size_t n = cells();
  centre_[0] = 2 * face_.front() - centre_[1];
  centre_[n + 1] = 2 * face_.back() - centre_[n];
  for (auto* field : {&rho_, &p_}) {
    field->front() = (*field)[1];
    field->back() = (*field)[n];
  }
  u_.front() = -u_[1];
  u_.back() = problem_.outflow ? u_[n] : -u_[n];
}

// Sound, the shock that the jump of velocity makes, and the one that the jump of pressure is about
// to make must not cross a cell.
double RadialLagrangian::stable_step() const {
  const double gamma = problem_.gamma;
  double step = std::numeric_limits<double>::max();
  bool good = true;
  for (std::size_t c = 1; c <= cells(); ++c) {
    good = good && rho_[c] > 0 && p_[c] > 0;
    const double du = std::max(std::abs(u_[c + 1] - u_[c]), std::abs(u_[c] - u_[c - 1]));
    const double dp = std::max(std::abs(p_[c + 1] - p_[c]), std::abs(p_[c] - p_[c - 1]));
    const double speed =
        std::sqrt(gamma * p_[c] / rho_[c]) + 0.5 * (gamma + 1) * du + std::sqrt(dp / rho_[c]);
    const double size = radial_volume(face_[c - 1], face_[c], problem_.dimension) /
                        mean_area(face_[c], face_[c], problem_.dimension);
    step = std::min(step, size / speed);
  }
  if (!good || !(step > 0)) {
    throw PhysicsError(fmt::format(
        "radial reference: density or pressure not positive at t = {}; try fewer cells or a lower "
        "Courant number",
        time_));
  }
  return problem_.cfl * step;
}

// Values at both faces of each cell, half a step on.
void RadialLagrangian::predict(double dt) {
  const std::size_t n = cells();
  const double half = 0.5 * dt, gamma = problem_.gamma;
  for (std::size_t c = 1; c <= n; ++c) {
    const double size = face_[c] - face_[c - 1];
    const double share = size / (centre_[c + 1] - centre_[c - 1]);
    const auto slope = [&](const std::vector<double>& q) {
      return limited_slope(q[c] - q[c - 1], q[c + 1] - q[c], share * (q[c + 1] - q[c - 1]));
    };
    const double su = slope(u_), sp = slope(p_), p = p_[c];
    const double squeeze = su / size + (problem_.dimension - 1) * u_[c] / centre_[c];
    const double u_half = u_[c] - half * sp / (size * rho_[c]);
    // Near vacuum a prediction could cross zero; a tenth of the cell's value remains then.
    p_half_[c] = std::max(p - half * gamma * p * squeeze, 0.1 * p);
    u_lo_[c] = u_half - 0.5 * su;
    u_hi_[c] = u_half + 0.5 * su;
    p_lo_[c] = std::max(p_half_[c] - 0.5 * sp, 0.1 * p);
    p_hi_[c] = std::max(p_half_[c] + 0.5 * sp, 0.1 * p);
  }
  // Beyond the ends: images behind a wall, copies beyond an open end.
  u_hi_[0] = -u_lo_[1];
  p_hi_[0] = p_lo_[1];
  u_lo_[n + 1] = problem_.outflow ? u_hi_[n] : -u_hi_[n];
  p_lo_[n + 1] = p_hi_[n];
}

void RadialLagrangian::find_faces() {
  const double gamma = problem_.gamma;
  const auto sound = [&](std::size_t c) { return std::sqrt(gamma * p_[c] / rho_[c]); };
  for (std::size_t f = 0; f < face_.size(); ++f) {
    const std::size_t a = f, b = f + 1;
    const Contact contact = meet({rho_[a], u_hi_[a], p_hi_[a], sound(a)},
                                 {rho_[b], u_lo_[b], p_lo_[b], sound(b)}, gamma);
    face_u_[f] = contact.u;
    face_p_[f] = contact.p;
  }
  face_u_.front() = 0;
  if (!problem_.outflow) face_u_.back() = 0;
}

void RadialLagrangian::move(double dt) {
  const int d = problem_.dimension;
  double low_area = mean_area(face_[0], face_[0], d);
  for (std::size_t i = 0; i < cells(); ++i) {
    const std::size_t c = i + 1;
    const double to = face_[c] + dt * face_u_[c], area = mean_area(face_[c], to, d);
    const double low_force = low_area * face_p_[i], force = area * face_p_[c];
    const double rate = dt / mass_[i];
    u_[c] -= rate * ((force - low_force) - p_half_[c] * (area - low_area));
    energy_[i] -= rate * (force * face_u_[c] - low_force * face_u_[i]);
    face_[c] = to;
    low_area = area;
    rho_[c] = mass_[i] / radial_volume(face_[i], to, d);
    p_[c] = (problem_.gamma - 1) * rho_[c] * (energy_[i] - 0.5 * u_[c] * u_[c]);
    centre_[c] = 0.5 * (face_[i] + to);
  }
  mirror();
}

void RadialLagrangian::advance_to(double t) {
  while (time_ < t) {
    const double stable = stable_step();
    const bool last = time_ + stable >= t;
    const double dt = last ? t - time_ : stable;
    predict(dt);
    find_faces();
    move(dt);
    time_ = last ? t : time_ + dt;
  }
}

RadialState RadialLagrangian::at(double r) const {
  const double place = std::clamp(r, centre_.front(), centre_.back());
  const auto above = std::upper_bound(centre_.begin() + 1, centre_.end() - 1, place);
  const std::size_t b = above - centre_.begin(), a = b - 1;
  const double part = (place - centre_[a]) / (centre_[b] - centre_[a]);
  const auto mix = [&](const std::vector<double>& q) { return q[a] + part * (q[b] - q[a]); };
  return {mix(rho_), mix(u_), mix(p_)};
}

double RadialLagrangian::total_mass() const {
  double sum = 0;
  for (std::size_t i = 0; i < cells(); ++i) {
    sum += rho_[i + 1] * radial_volume(face_[i], face_[i + 1], problem_.dimension);
  }
  return sum;
}

double RadialLagrangian::total_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < cells(); ++i) sum += mass_[i] * energy_[i];
  return sum;
}

}  // namespace sluice::exact
