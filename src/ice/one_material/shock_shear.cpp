// Where faces exchange shear along strong shocks, and how much: step/shock_shear.hpp.
//
// Over each face across another axis t, of either of its two cells a and b, with K = rho c^2 the
// smaller of the two cells there:
//   s_t = (|du_t| + |dc|) min(1, 3 max(0, |dp|/K - 1/3))
//   k   = min(.1, l_d/2 max s_t max(0, 1 - 3 |p_b - p_a|/max |dp|)),   l_d = dt/dx_d
// so that k is zero to the bit where no face beside jumps by more than a third of rho c^2 (which is
// more than a third of the pressure), and where the shock is inclined to the grid by more than
// about one in three.
// A grid holds a shock along it by dissipation across it alone: what differs from row to row inside
// the captured shock is no sound, is damped by nothing, and grows (Quirk, Int. J. Numer. Methods
// Fluids 18, 1994; Sanders, Morano and Druguet, J. Comput. Phys. 145, 1998).
// None on walls, nor on faces of cells that solids meet, nor from jumps there.
#include "ice/step/shock_shear.hpp"

#include <algorithm>
#include <utility>

#include "ice/step/wall_faces.hpp"

namespace sluice::ice {
namespace {

constexpr double least_jump = 1.0 / 3, full_jump = 2.0 / 3;  // of rho c^2
constexpr double share = 0.5, most = 0.1;
constexpr double askew = 3;  // no shear where a shock is inclined by more than one in so many

struct JumpReads {
  In pressure, rho, sound;
};

// Whether one of these faces jumps; a little sooner than the strength is above zero. `Modulus`: of
// cell a or b of the face.
template <class Modulus>
bool any_jump(const double* __restrict pa, const double* __restrict pb, int n, Modulus modulus) {
  std::int64_t jumps = 0;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i)
    jumps += std::fabs(pb[i] - pa[i]) > 0.999 * least_jump * modulus(i) ? 1 : 0;
  return jumps != 0;
}

// Whether one of the low faces of these cells along an axis does. `gamma`: of the one ideal gas,
// else 0.
bool jumps_along(const Row& row, const JumpReads& h, int axis, double gamma) {
  const int n = row.count();
  const double *pa = row(h.pressure, 0, axis, -1), *pb = row(h.pressure);
  if (gamma > 0) return any_jump(pa, pb, n, [=](int i) { return gamma * smaller(pa[i], pb[i]); });
  const double *ra = row(h.rho, 0, axis, -1), *rb = row(h.rho);
  const double *ca = row(h.sound, 0, axis, -1), *cb = row(h.sound);
  return any_jump(pa, pb, n,
                  [=](int i) { return smaller(ra[i] * (ca[i] * ca[i]), rb[i] * (cb[i] * cb[i])); });
}

// Marks of the low faces of the cells of a row, of all axes; so many cells share one.
void mark_jumps(const Row& row, const JumpReads& h, int axes, double gamma, Out marks) {
  const int n = row.count();
  const auto any = [&](const Row& cells) {
    for (int d = 0; d < axes; ++d)
      if (jumps_along(cells, h, d, gamma)) return true;
    return false;
  };
  std::fill_n(row(marks), n, 0.0);
  if (!any(row)) return;
  for (int first = 0; first < n; first += marked_cells) {
    const Row part = row.part(first, std::min(marked_cells, n - first));
    if (any(part)) std::fill_n(part(marks), part.count(), 1.0);
  }
}

void add_jumps(TaskList& list, const SchemeVariables& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("where pressure jumps", effect);
  Stencil below;
  for (int d = 0; d < o.axes.count; ++d) below.low[o.axes.direction[d]] = 1;
  const eos::IdealGas* gas = o.mixture || o.mixed != nullptr ? nullptr : o.fluid.ideal();
  JumpReads h;
  h.pressure = task.read(v.pressure, below);
  if (gas == nullptr) {
    h.rho = task.read(v.rho, below);
    h.sound = task.read(v.sound, below);
  }
  const Out marks = task.write(v.jump_marks);
  const double gamma = gas != nullptr ? gas->gamma : 0;
  const int axes = o.axes.count;
  task.kernel([=](const Row& row) { mark_jumps(row, h, axes, gamma, marks); });
}

struct Handles {
  In pressure, rho, sound, velocity, fraction, jumps;
  Out strength, marks;
};

// Of the faces of a part of a row along one axis.
class Strength {
 public:
  Strength(const Row& row, const Handles& h, int axis) : row_(row), h_(h), axis_(axis) {}

  void find(int axes, double l, double* __restrict k) {
    const int n = row_.count();
    const double *pa = row_(h_.pressure, 0, axis_, -1), *pb = row_(h_.pressure);
    for (int t = 0; t < axes; ++t)
      if (t != axis_)
        for (const int side : {-1, 0})
          for (const int low : {-1, 0}) look_across(t, side, low);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double plane = larger(0.0, largest_[i] - askew * std::fabs(pb[i] - pa[i]));
      const double wanted = fastest_[i] > 0.0 ? share * l * fastest_[i] * plane / largest_[i] : 0.0;
      k[i] = smaller(wanted, most);
    }
  }

 private:
  // The face across axis t between the cells `low` and `low` + 1 from the one on that side.
  void look_across(int t, int side, int low) {
    std::array<int, 3> first{}, second{};
    first[static_cast<std::size_t>(axis_)] = second[static_cast<std::size_t>(axis_)] = side;
    first[static_cast<std::size_t>(t)] = low;
    second[static_cast<std::size_t>(t)] = low + 1;
    const auto both = [&](In in, int c = 0) {
      return std::pair(row_.at_offset(in, c, first), row_.at_offset(in, c, second));
    };
    const auto [pa, pb] = both(h_.pressure);
    const auto [ra, rb] = both(h_.rho);
    const auto [ca, cb] = both(h_.sound);
    const auto [ua, ub] = both(h_.velocity, t);
    const auto [fa, fb] = h_.fraction.index < 0 ? std::pair(clear_, clear_) : both(h_.fraction);
    const int n = row_.count();
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double jump = fa[i] + fb[i] > 0.0 ? 0.0 : std::fabs(pb[i] - pa[i]);
      const double K = smaller(ra[i] * (ca[i] * ca[i]), rb[i] * (cb[i] * cb[i]));
      const double excess = (jump / K - least_jump) / (full_jump - least_jump);
      const double speed = std::fabs(ub[i] - ua[i]) + std::fabs(cb[i] - ca[i]);
      const double weight = larger(0.0, smaller(excess, 1.0));
      fastest_[i] = larger(fastest_[i], jump > least_jump * K ? weight * speed : 0.0);
      largest_[i] = larger(largest_[i], jump);
    }
  }

  const Row& row_;
  const Handles& h_;
  int axis_;
  double fastest_[marked_cells] = {}, largest_[marked_cells] = {}, no_solid_[marked_cells] = {};
  const double* clear_ = no_solid_;
};

void clear_beside_solids(const Row& row, const Handles& h, int axis, double* k) {
  const double *fa = row(h.fraction, 0, axis, -1), *fb = row(h.fraction);
  for (int i = 0; i < row.count(); ++i) k[i] = fa[i] + fb[i] > 0.0 ? 0.0 : k[i];
}

// The rows of marks around a row, of all axes but the one along it.
template <int D>
auto marks_around(const Row& row, In marks) {
  constexpr std::size_t count = D == 2 ? 3 : 9;
  MarkedRows<count> rows;
  for (std::size_t n = 0; n < count; ++n) {
    const int j = static_cast<int>(n % 3) - 1, k = static_cast<int>(n / 3) - 1;
    rows[n] = row.at_offset(marks, 0, {0, j, D == 2 ? 0 : k});
  }
  return rows;
}

template <int D>
void strength_row(const Row& whole, const Handles& h, const SchemeOptions& o) {
  std::fill_n(whole(h.marks), whole.count(), 0.0);
  for_each_marked_part(whole, marks_around<D>(whole, h.jumps), 1, [&](const Row& row) {
    const int n = row.count();
    bool any = false;
    for (int d = 0; d < D; ++d) {
      double* k = row(h.strength, d);
      Strength(row, h, d).find(D, row.step().dt / row.step().spacing[o.axes.direction[d]], k);
      if (h.fraction.index >= 0) clear_beside_solids(row, h, d, k);
      for_each_wall_face(row, o, d, [&](int i, bool) { k[i] = 0.0; });
      for (int i = 0; i < n; ++i) any = any || k[i] != 0.0;
    }
    if (any) std::fill_n(row(h.marks), n, 1.0);
  });
}

}  // namespace

void add_shock_shear(TaskList& list, const SchemeVariables& v, const SchemeOptions& o, int effect) {
  if (!o.shears_shocks) return;
  add_jumps(list, v, o, effect);
  TaskBuilder task = list.task("shear along shocks", effect);
  const Stencil around = Stencil::box(1);
  Handles h;
  h.pressure = task.read(v.pressure, around);
  h.rho = task.read(v.rho, around);
  h.sound = task.read(v.sound, around);
  h.velocity = task.read(v.velocity, around);
  if (o.walled) h.fraction = task.read(v.walls.fraction, around);
  h.jumps = task.read(v.jump_marks, around);
  h.strength = task.write(v.shear);
  h.marks = task.write(v.shear_marks);
  task.kernel([=, axes = o.axes.count](const Row& row) {
    axes == 2 ? strength_row<2>(row, h, o) : strength_row<3>(row, h, o);
  });
}

}  // namespace sluice::ice
