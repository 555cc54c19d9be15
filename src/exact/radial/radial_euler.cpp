#include "exact/radial/radial_euler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

constexpr std::size_t ghosts = 2;

// Monotonised central slope of two one-sided differences.
inline double limited(double a, double b) {
  return limited_slope(a, b, 0.5 * (a + b));
}

struct Flux {
  double rho, mom, ene;
};

// HLLC flux with Davis' wave speeds (Toro eqs. 10.37-10.39, 10.48), written without branches.
inline Flux hllc(double rl, double ul, double pl, double rr, double ur, double pr, double g) {
  const double cl = std::sqrt(g * pl / rl), cr = std::sqrt(g * pr / rr);
  const double sl = std::min(ul - cl, ur - cr), sr = std::max(ul + cl, ur + cr);
  const double wl = rl * (sl - ul), wr = rr * (sr - ur);  // mass fluxes through the outer waves
  const double sm = ((pr - pl) + (wl * ul - wr * ur)) / (wl - wr);
  const bool left = sm >= 0;
  const double r = left ? rl : rr, u = left ? ul : ur, p = left ? pl : pr;
  const double s = left ? sl : sr, w = left ? wl : wr;
  const double e = p / (g - 1) + 0.5 * r * u * u;
  const bool star = left ? sl < 0 : sr > 0;
  const double r_star = w / (s - sm);
  const double e_star = r_star * (e / r + (sm - u) * (sm + p / w));
  const double jump = star ? s : 0.0;
  return {r * u + jump * (r_star - r), r * u * u + p + jump * (r_star * sm - r * u),
          u * (e + p) + jump * (e_star - e)};
}

}  // namespace

RadialEuler::RadialEuler(RadialProblem problem) : problem_(std::move(problem)) {
  check(problem_);
  const std::size_t n = problem_.cells;
  const int d = problem_.dimension;
  dr_ = (problem_.high - problem_.low) / static_cast<double>(n);
  const std::size_t all = n + 2 * ghosts;
  for (auto* field : {&rho_, &mom_, &ene_, &u_, &p_, &rho_lo_, &u_lo_, &p_lo_, &rho_hi_, &u_hi_,
                      &p_hi_, &p_half_, &centre_, &volume_}) {
    field->assign(all, 0.0);
  }
  for (auto* field : {&flux_rho_, &flux_mom_, &flux_ene_, &area_}) field->assign(n + 1, 0.0);
  const auto edge = [&](std::size_t face) {
    return problem_.low + dr_ * static_cast<double>(face);
  };
  for (std::size_t f = 0; f <= n; ++f) area_[f] = std::pow(edge(f), d - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t c = i + ghosts;
    volume_[c] = radial_volume(edge(i), edge(i + 1), d);
    const RadialMeans mean = start_means(problem_, edge(i), edge(i + 1));
    rho_[c] = mean.density;
    mom_[c] = mean.momentum;
    ene_[c] = mean.energy;
  }
  for (std::size_t c = 0; c < all; ++c) {
    centre_[c] = problem_.low + dr_ * (static_cast<double>(c) - ghosts + 0.5);
  }
}

void RadialEuler::fill_ghosts(std::vector<double>& q, double sign_at_wall) const {
  const std::size_t n = problem_.cells;
  for (std::size_t g = 0; g < ghosts; ++g) {
    q[ghosts - 1 - g] = sign_at_wall * q[ghosts + g];
    q[n + ghosts + g] = problem_.outflow ? q[n + ghosts - 1] : sign_at_wall * q[n + ghosts - 1 - g];
  }
}

void RadialEuler::find_primitives() {
  const std::size_t end = ghosts + problem_.cells;
  for (std::size_t c = ghosts; c < end; ++c) {
    u_[c] = mom_[c] / rho_[c];
    p_[c] = (problem_.gamma - 1) * (ene_[c] - 0.5 * mom_[c] * u_[c]);
  }
  fill_ghosts(rho_, 1);
  fill_ghosts(u_, -1);
  fill_ghosts(p_, 1);
}

double RadialEuler::stable_step() const {
  const std::size_t end = ghosts + problem_.cells;
  double fastest = 0;
  bool good = true;
  for (std::size_t c = ghosts; c < end; ++c) {
    good = good && rho_[c] > 0 && p_[c] > 0;
    const double speed = std::abs(u_[c]) + std::sqrt(problem_.gamma * p_[c] / rho_[c]);
    fastest = std::max(fastest, speed * area_[c - ghosts + 1] / volume_[c]);
  }
  if (!good || !std::isfinite(fastest)) {
    throw PhysicsError(fmt::format(
        "radial reference: density or pressure not positive at t = {}; try fewer cells or a lower "
        "Courant number",
        time_));
  }
  return problem_.cfl / fastest;
}

// Face values in the ghost cells: images behind a wall, copies beyond an open end. (Mirroring the
// cells before the prediction would not do: the geometric term has no mirror image at the high
// end.)
void RadialEuler::mirror_faces() {
  const std::size_t first = ghosts, last = ghosts + problem_.cells - 1;
  rho_hi_[first - 1] = rho_lo_[first];
  u_hi_[first - 1] = -u_lo_[first];
  p_hi_[first - 1] = p_lo_[first];
  rho_lo_[last + 1] = rho_hi_[last];
  u_lo_[last + 1] = problem_.outflow ? u_hi_[last] : -u_hi_[last];
  p_lo_[last + 1] = p_hi_[last];
}

// Limited slopes, and both face values of each cell half a step on (Toro eqs. 14.41-14.43, in
// primitive variables with the geometric terms of 17.1).
void RadialEuler::predict(double dt) {
  const std::size_t end = ghosts + problem_.cells;
  const double half = 0.5 * dt / dr_, g = problem_.gamma;
  const double geometry = 0.5 * dt * (problem_.dimension - 1);
  for (std::size_t c = ghosts; c < end; ++c) {
    const double rho = rho_[c], u = u_[c], p = p_[c];
    const double sr = limited(rho - rho_[c - 1], rho_[c + 1] - rho);
    const double su = limited(u - u_[c - 1], u_[c + 1] - u);
    const double sp = limited(p - p_[c - 1], p_[c + 1] - p);
    const double squeeze = half * su + geometry * u / centre_[c];
    // Near vacuum a prediction could cross zero; a tenth of the cell's value remains then.
    const double rho_half = rho - half * u * sr - rho * squeeze;
    const double p_half = p - half * u * sp - g * p * squeeze;
    const double u_half = u - half * (u * su + sp / rho);
    p_half_[c] = std::max(p_half, 0.1 * p);
    rho_lo_[c] = std::max(rho_half - 0.5 * sr, 0.1 * rho);
    rho_hi_[c] = std::max(rho_half + 0.5 * sr, 0.1 * rho);
    p_lo_[c] = std::max(p_half - 0.5 * sp, 0.1 * p);
    p_hi_[c] = std::max(p_half + 0.5 * sp, 0.1 * p);
    u_lo_[c] = u_half - 0.5 * su;
    u_hi_[c] = u_half + 0.5 * su;
  }
}

void RadialEuler::find_fluxes() {
  const std::size_t faces = problem_.cells + 1;
  const double g = problem_.gamma;
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t a = f + ghosts - 1, b = a + 1;
    const Flux flux = hllc(rho_hi_[a], u_hi_[a], p_hi_[a], rho_lo_[b], u_lo_[b], p_lo_[b], g);
    flux_rho_[f] = flux.rho;
    flux_mom_[f] = flux.mom;
    flux_ene_[f] = flux.ene;
  }
}

void RadialEuler::step(double dt) {
  predict(dt);
  mirror_faces();
  find_fluxes();
  const std::size_t n = problem_.cells;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t c = i + ghosts;
    const double lo = area_[i], hi = area_[i + 1], rate = dt / volume_[c];
    rho_[c] -= rate * (hi * flux_rho_[i + 1] - lo * flux_rho_[i]);
    mom_[c] -= rate * (hi * flux_mom_[i + 1] - lo * flux_mom_[i] - p_half_[c] * (hi - lo));
    ene_[c] -= rate * (hi * flux_ene_[i + 1] - lo * flux_ene_[i]);
  }
}

void RadialEuler::advance_to(double t) {
  find_primitives();
  while (time_ < t) {
    const double dt = stable_step();
    const bool last = time_ + dt >= t;
    step(last ? t - time_ : dt);
    time_ = last ? t : time_ + dt;
    ++steps_;
    find_primitives();
  }
}

RadialState RadialEuler::at(double r) const {
  const double place = std::clamp((r - problem_.low) / dr_ - 0.5, -0.5, problem_.cells - 0.5);
  const double below = std::floor(place), part = place - below;
  const auto c = static_cast<std::size_t>(below + static_cast<double>(ghosts));
  const auto mix = [&](const std::vector<double>& q) { return q[c] + part * (q[c + 1] - q[c]); };
  return {mix(rho_), mix(u_), mix(p_)};
}

double RadialEuler::total_mass() const {
  double sum = 0;
  for (std::size_t c = 0; c < volume_.size(); ++c) sum += volume_[c] * rho_[c];
  return sum;
}

double RadialEuler::total_energy() const {
  double sum = 0;
  for (std::size_t c = 0; c < volume_.size(); ++c) sum += volume_[c] * ene_[c];
  return sum;
}

}  // namespace sluice::exact
