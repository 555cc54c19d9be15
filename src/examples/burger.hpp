// burger: the equation of Burgers without friction, on nodes.
//
//   u_t + u (u_x + u_y + u_z) = 0,   in its conservative form   u_t + sum over d of (u^2/2)_d = 0
//   start: u = sin(pi x) + sin(2 pi y) + sin(3 pi z); a side of the domain copies its inner nodes
//
// Central differences of u (u_x + ...), as the format's decks were made for, grow without end once
// the solution steepens (burger_4patch does at t = 0.1). So each node is the mean of a cell around
// it, and a step is MUSCL-Hancock: second order where u is smooth, the right speed at shocks.
//
//   1. slope of each direction, limited:  s_d = limited(u(i) - u(i - e_d), u(i + e_d) - u(i))
//   2. half a step:                       h = u - dt/2 sum over d of u s_d / dx_d
//   3. flux at the low side of a node:    F_d = g(h(i - e_d) + s_d(i - e_d)/2, h(i) - s_d(i)/2),
//                                         Godunov's g(l, r) = max(max(l, 0)^2, min(r, 0)^2) / 2
//   4. step:                              u' = u - dt sum over d of (F_d(i + e_d) - F_d(i)) / dx_d
//
// Lengths in m, times in s, u in m/s.
//
// Limits: one level; dt = delt, or 1/2 / max sum |u| / dx_d where that is less.
// E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics (2009), section 14.4.
#pragma once
#include <memory>

#include "framework/run/component/plain_component.hpp"

namespace sluice::examples {

class Burger : public PlainComponent {
 public:
  Burger(const Scene& scene, double dt);

  std::vector<SlotInfo> slots() const override;
  void initialise(Warehouse& state) const override;
  void fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                     const ThreadTeam& team) const override;
  void declare(TaskList& list, const StepVariant& variant) const override;
  void measure_rates(const Warehouse& state, Reductions& rates) const override;
  StepLimit limit(const std::vector<double>& maxima) const override;

  static Label label();                // u
  static double start(const Vec3& x);  // u at time 0

 private:
  double dt_;
  MaximumGroup rate_ = add_maxima(1);  // sum over d of |u| / dx_d
};

void add_burger_tags(Schema& schema);
std::unique_ptr<Component> make_burger(const Deck& deck, const Scene& scene,
                                       std::vector<Fault>& faults);

}  // namespace sluice::examples
