// Waves through open faces, a row of cells at a time.
#include "ice/boundary/wave_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "ice/boundary/waves.hpp"
#include "ice/fluid/closure_rows.hpp"

namespace sluice::ice {
namespace {

constexpr int short_row = 8;  // not worth unit stride

bool too_far(double value, double change) {
  return std::fabs(change) > max_change_by_waves * value;
}

double largest_share(double value, double change) {
  const double share = std::max(max_change_by_waves * value, 0.0) / std::fabs(change);
  return too_far(value, change) ? share : 1.0;
}

// f(far known, carrier known) with constants: rows choose once.
template <class F>
void with_constants(const WaveCell& cell, F&& f) {
  if (cell.far_known)
    f(std::true_type(), std::true_type());
  else if (cell.carrier_known)
    f(std::false_type(), std::true_type());
  else
    f(std::false_type(), std::false_type());
}

}  // namespace

WaveRows::WaveRows(const GhostStates& states, const IndexBox& ghosts)
    : s_(states), a_(s_.d_ == 0 ? 1 : 0), b_(s_.d_ == 2 ? 1 : 2), t_(0) {
  const IntVec3 n = ghosts.size();
  if (n[a_] < short_row && n[b_] > n[a_]) {
    std::swap(a_, b_);
    t_ = 1;
  }
  begin_ = ghosts.lower[a_];
  end_ = ghosts.upper[a_];
  find_neighbours(ghosts.lower[b_]);
  const BoundarySetting& setting = s_.setting_;
  one_law_ = setting.fluids.size() == 1 && s_.laws_.all_plain();
  held_.fill(std::numeric_limits<int>::min());
  allot_room();
  if (one_law_) std::fill_n(lowest_, count_, setting.fluids.front().lowest_pressure());

  const Level& level = *setting.level;
  const LodiSettings& settings = *setting.conditions.lodi;
  common_.spacing = level.spacing[s_.d_];
  common_.domain_size = level.domain.size()[s_.d_] * level.spacing[s_.d_];
  common_.far_known = settings.velocity_infinity && settings.rho_infinity;
  if (common_.far_known) {
    common_.far.rho = *settings.rho_infinity;
    s_.to_face_frame(*settings.velocity_infinity, common_.far);
    common_.carrier_known = true;
    common_.carrier = common_.far;
  }
  common_.far.p = settings.press_infinity;
  common_.pull = settings.scale * settings.sigma;
}

// Along rows: what lies beside their cells is the same in all of them.
void WaveRows::find_neighbours(int row) {
  const auto beside = [&](int i) { return s_.neighbours(cell(i, row, 0), a_); };
  inner_begin_ = begin_;
  while (inner_begin_ < end_ && beside(inner_begin_).steps != 2) ++inner_begin_;
  inner_end_ = end_;
  while (inner_end_ > inner_begin_ && beside(inner_end_ - 1).steps != 2) --inner_end_;
  const bool inner = inner_begin_ < inner_end_;
  first_ = inner ? std::min(begin_, inner_begin_ - 1) : begin_;
  int last = inner ? std::max(end_ - 1, inner_end_) : end_ - 1;
  const double dx = s_.setting_.level->spacing[a_];
  for (int i = begin_; i < end_; ++i) {
    if (i >= inner_begin_ && i < inner_end_) continue;
    const auto at = beside(i);
    outer_.push_back({i, at.low[a_], at.high[a_], at.steps == 0 ? 0.0 : 1.0 / (at.steps * dx)});
    if (at.steps == 0) outer_.back().low = outer_.back().high = i;
    first_ = std::min(first_, outer_.back().low);
    last = std::max(last, outer_.back().high);
  }
  count_ = last + 1 - first_;
}

// All rows in one piece. Components that the run does not have, and derivatives along directions
// that it does not have, stay zero.
void WaveRows::allot_room() {
  constexpr std::size_t rows_of_layer = 3 * 5 + 2 * 3 + 2, others = 5 + 10 + 5;
  const std::size_t n = count_;
  room_.assign((2 * rows_of_layer + others) * n, 0.0);
  double* next = room_.data();
  const auto row = [&] { return std::exchange(next, next + n); };
  const auto state_row = [&]() -> StateRow { return {row(), row(), {row(), row(), row()}}; };
  for (Layer& layer : layers_) {
    for (StateRow& r : layer.rows) r = state_row();
    for (SlopeRow& r : layer.slopes) r = {row(), row(), row()};
    layer.sound_speed = row();
    layer.transverse = row();
  }
  out_ = state_row();
  waves_ = {row(), row(), row(), row(), row(), state_row()};
  for (double** one : {&energy_, &lowest_, &step_, &weight_, &nearer_}) *one = row();
}

IntVec3 WaveRows::cell(int along, int row, int inward) const {
  const IndexBox& domain = s_.setting_.level->domain;
  const int d = s_.d_;
  IntVec3 c;
  c[a_] = along;
  c[b_] = row;
  inward = std::min(inward, domain.size()[d] - 1);  // of one cell nothing changes inward
  c[d] = s_.plus_ ? domain.upper[d] - 1 - inward : domain.lower[d] + inward;
  return c;
}

void WaveRows::load_gas(const StateRow& to, IntVec3 first) {
  const BoundaryViews& v = s_.v_;
  const int n = count_;
  const auto gather = [&](const RealView& view, double* __restrict row) {
    const double* from = &view(first);
    const std::ptrdiff_t stride = view.stride[a_];
    if (stride == 1) std::copy_n(from, n, row);
    for (int i = 0; stride != 1 && i < n; ++i) row[i] = from[i * stride];
  };
  gather(v.mass.front(), to.rho);
  gather(v.energy.front(), energy_);
  pressure_row(s_.setting_.fluids.front(), n, to.rho, energy_, to.p);
  const double* __restrict rho = to.rho;
  for (std::size_t c = 0; c < v.momentum.size(); ++c) {
    const auto [component, sign] = s_.in_face_frame(s_.setting_.directions[c]);
    double* __restrict u = to.u[component];
    gather(v.momentum[c], u);
    for (int i = 0; i < n; ++i) u[i] = sign * (u[i] / rho[i]);
  }
}

void WaveRows::load(int row) {
  if (std::exchange(held_[turn(row)], row) == row) return;
  for (int inward = 0; inward < 2; ++inward) {
    const StateRow& to = layers_[inward].rows[turn(row)];
    if (one_law_) {
      load_gas(to, cell(first_, row, inward));
      continue;
    }
    for (int i = 0; i < count_; ++i) {
      const WaveState s = s_.wave_state(cell(first_ + i, row, inward));
      to.rho[i] = s.rho;
      to.p[i] = s.p;
      for (int t = 0; t < 3; ++t) to.u[t][i] = s.u[t];
    }
  }
}

void WaveRows::find_sound_speeds() {
  for (int inward = 0; inward < 2; ++inward) {
    const Layer& layer = layers_[inward];
    const StateRow& here = layer.rows[turn(row_)];
    if (one_law_) {
      sound_speed_row(s_.setting_.fluids.front(), count_, here.rho, here.p, layer.sound_speed);
      continue;
    }
    for (int i = begin_ - first_; i < end_ - first_; ++i)
      layer.sound_speed[i] = s_.sound_speed(cell(first_ + i, row_, inward), state(here, i));
  }
}

void WaveRows::start(int row) {
  row_ = row;
  load(row);
  if (const auto at = s_.neighbours(cell(begin_, row, 0), b_); at.steps > 0) {
    load(at.low[b_]);
    load(at.high[b_]);
  }
  find_sound_speeds();
  for (const Layer& layer : layers_) {
    differences_along(layer);
    differences_across(layer);
  }
  const StateRow& here = layers_[0].rows[turn(row)];
  for (int i = begin_ - first_; i < end_ - first_; ++i) {
    if (!one_law_) lowest_[i] = s_.lowest_pressure(cell(first_ + i, row, 0));
    weight_[i] = 0.0;
    nearer_[i] = here.rho[i];
  }
}

// Central differences; at the edge of the domain one-sided. Cells beyond it have none.
void WaveRows::differences_along(const Layer& layer) const {
  const StateRow& r = layer.rows[turn(row_)];
  const SlopeRow& to = layer.slopes[t_];
  const double dx = s_.setting_.level->spacing[a_], both = 1.0 / (2 * dx);
  const auto differences = [&](const double* __restrict v, double* __restrict slope) {
#pragma GCC ivdep
    for (int i = inner_begin_ - first_; i < inner_end_ - first_; ++i)
      slope[i] = (v[i + 1] - v[i - 1]) * both;
    for (const Outer& o : outer_)
      slope[o.cell - first_] = (v[o.high - first_] - v[o.low - first_]) * o.scale;
  };
  differences(r.p, to.p);
  differences(r.u[0], to.normal);
  differences(r.u[1 + t_], to.own);
}

void WaveRows::differences_across(const Layer& layer) const {
  const int t = 1 - t_;
  const SlopeRow& to = layer.slopes[t];
  const auto at = s_.neighbours(cell(begin_, row_, 0), b_);
  const int n = count_;
  if (at.steps == 0) {
    for (double* row : {to.p, to.normal, to.own}) std::fill_n(row, n, 0.0);
    return;
  }
  const double scale = 1.0 / (at.steps * s_.setting_.level->spacing[b_]);
  const StateRow &low = layer.rows[turn(at.low[b_])], &high = layer.rows[turn(at.high[b_])];
  const auto differences = [=](const double* a, const double* b, double* __restrict slope) {
    for (int i = 0; i < n; ++i) slope[i] = (b[i] - a[i]) * scale;
  };
  differences(low.p, high.p, to.p);
  differences(low.u[0], high.u[0], to.normal);
  differences(low.u[1 + t], high.u[1 + t], to.own);
}

void WaveRows::find_transverse(const Layer& layer, int begin, int end) const {
  const StateRow here = layer.rows[turn(row_)];
  const SlopeRow lower = layer.slopes[0], upper = layer.slopes[1];
  const double* c = layer.sound_speed;
  double* __restrict transverse = layer.transverse;
  with_constants(common_, [=, &common = common_](auto far, auto carrier) {
    WaveCell cell = common;
    cell.far_known = far;
    cell.carrier_known = carrier;
#pragma GCC ivdep
    for (int i = begin; i < end; ++i) {
      cell.here = state(here, i);
      cell.sound_speed = c[i];
      cell.along[0] = {0, lower.p[i], {lower.normal[i], lower.own[i], 0}};
      cell.along[1] = {0, upper.p[i], {upper.normal[i], 0, upper.own[i]}};
      transverse[i] = transverse_part(cell);
    }
  });
}

void WaveRows::take(const GhostRule& rule, int begin, int end) {
  if (!common_.far_known) {
    common_.carrier_known = false;
    common_.carrier = {};
    if (rule.open_face >= 0 && !s_.moment_.carriers.empty()) {
      const auto& mean = s_.moment_.carriers[rule.open_face];
      common_.carrier_known = mean.has_value();
      if (mean) s_.to_face_frame(*mean, common_.carrier);
    }
  }
  for (const Layer& layer : layers_) find_transverse(layer, begin - first_, end - first_);
  find_waves(begin - first_, end - first_);
}

void WaveRows::find_waves(int begin, int end) const {
  const StateRow here = layers_[0].rows[turn(row_)], in = layers_[1].rows[turn(row_)];
  const double* c = layers_[0].sound_speed;
  const WaveRow waves = waves_;
  const double scale = 1.0 / common_.spacing;
  const double half_weight =
      cell(begin_, row_, 1) == cell(begin_, row_, 0) ? 0.0 : s_.half_weight();
  with_constants(common_, [=, &common = common_](auto far, auto carrier) {
    WaveCell cell = common;
    cell.far_known = far;
    cell.carrier_known = carrier;
#pragma GCC ivdep
    for (int i = begin; i < end; ++i) {
      const WaveState s = state(here, i), inner = state(in, i);
      cell.here = s;
      cell.sound_speed = c[i];
      cell.normal = slope_from(inner, s, scale);
      cell.normal.p = ((s.p - inner.p) - half_weight * (inner.rho + s.rho)) * scale;
      const LeavingWaves w = leaving_waves(cell);
      waves.out[i] = w.out;
      waves.in[i] = w.in;
      waves.hears[i] = w.hears;
      waves.entropy[i] = w.entropy;
      waves.all_leave[i] = w.all_leave;
      put(w.inside, waves.inside, i);
    }
  });
}

// Outward slopes for a layer; does any change density or pressure too much?
bool WaveRows::find_slopes(int layer, int begin, int end) const {
  const StateRow here = layers_[0].rows[turn(row_)], out = out_;
  const double *c = layers_[0].sound_speed, *lowest = lowest_;
  const double *T_here = layers_[0].transverse, *T_in = layers_[1].transverse;
  const WaveRow waves = waves_;
  const double distance = layer * common_.spacing;
  std::int64_t too_steep = 0;
#pragma GCC ivdep
  for (int i = begin; i < end; ++i) {
    const LeavingWaves w = {waves.out[i],     waves.in[i],        waves.hears[i],
                            waves.entropy[i], waves.all_leave[i], state(waves.inside, i)};
    // Along the way out to the ghost, from the two cells next to the face.
    const double size = std::fabs(T_here[i]);
    const double change = std::clamp(T_here[i] - T_in[i], -size, size);
    const WaveState slope = outward_slopes(w, here.rho[i], c[i], T_here[i] + 0.5 * layer * change);
    too_steep += too_far(here.rho[i], distance * slope.rho) ? 1 : 0;
    too_steep += too_far(here.p[i] - lowest[i], distance * slope.p) ? 1 : 0;
    put(slope, out, i);
  }
  return too_steep > 0;
}

void WaveRows::move_out(int layer, int begin, int end) {
  begin -= first_;
  end -= first_;
  const bool limited = find_slopes(layer, begin, end);
  const StateRow here = layers_[0].rows[turn(row_)], out = out_;
  const double distance = layer * common_.spacing;
  double* step = step_;
  std::fill(step + begin, step + end, distance);
  const double* lowest = lowest_;
  if (limited)
    for (int i = begin; i < end; ++i)
      step[i] *= std::min(largest_share(here.rho[i], distance * out.rho[i]),
                          largest_share(here.p[i] - lowest[i], distance * out.p[i]));
  const auto move = [=](const double* __restrict from, double* __restrict to) {
    for (int i = begin; i < end; ++i) to[i] = from[i] + step[i] * to[i];
  };
  move(here.rho, out.rho);
  move(here.p, out.p);
  for (int t = 0; t < 3; ++t) move(here.u[t], out.u[t]);
}

bool WaveRows::writes(const GhostRule& rule) const {
  const bool given = rule.fixed_density || rule.gives_pressure() || rule.fixed_temperature ||
                     rule.velocity_kind != GhostRule::Velocity::copy;
  return one_law_ && !given && s_.setting_.fluids.front().depends_on_energy();
}

void WaveRows::write(int layer, int begin, int end) {
  const BoundaryViews& v = s_.v_;
  const int from = begin - first_, n = end - begin;
  const double half_weight = s_.half_weight();
  double *rho = out_.rho + from, *p = out_.p + from;
  if (half_weight != 0) {
    double *weight = weight_ + from, *nearer = nearer_ + from;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      weight[i] += half_weight * (nearer[i] + rho[i]);
      p[i] += weight[i];
      nearer[i] = rho[i];
    }
  }
  energy_from_pressure_row(s_.setting_.fluids.front(), n, rho, p, energy_);
  const IntVec3 ghost = cell(begin, row_, -layer);
  const auto scatter = [&](const RealView& view, const double* __restrict row) {
    double* to = &view(ghost);
    const std::ptrdiff_t stride = view.stride[a_];
    if (stride == 1) std::copy_n(row, n, to);
    for (int i = 0; stride != 1 && i < n; ++i) to[i * stride] = row[i];
  };
  scatter(v.mass.front(), rho);
  scatter(v.energy.front(), energy_);
  for (std::size_t c = 0; c < v.momentum.size(); ++c) {
    const auto [component, sign] = s_.in_face_frame(s_.setting_.directions[c]);
    double* u = out_.u[component] + from;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) u[i] = rho[i] * (sign * u[i]);
    scatter(v.momentum[c], u);
  }
}

}  // namespace sluice::ice
