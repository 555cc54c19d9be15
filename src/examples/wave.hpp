// wave: the wave equation in cells, as two fields of first order in time.
//
//   phi_t = pi,  pi_t = sum over d of (phi(i - e_d) - 2 phi(i) + phi(i + e_d)) / dx_d^2
//   start (Chombo): phi = exp(-d^2 / r0^2) / r0^3, d the distance from the origin; pi = 0
//
// RK4, the classic Runge-Kutta method of fourth order, from the states y1 = y,
//   y2 = y + dt/2 f(y1),  y3 = y + dt/2 f(y2),  y4 = y + dt f(y3):
//   y' = (-y + y2 + 2 y3 + y4) / 3 + dt/6 f(y4)
// All four are found in one sweep: f reads one cell away, so that a block computes each state one
// cell less far beyond its own cells than the one before, and no message is sent between them.
//
// Euler: phi' = phi + dt pi, then pi' = pi + dt Laplacian(phi'); with the old phi it would grow.
//
// Lengths, and times with the wave speed 1, in m.
//
// A side of the domain is a mirror. dt = the smallest spacing, times the deck's multiplier, or the
// longest stable step where that is less. On several levels cells are refined where the change of
// phi from cell to cell exceeds <refine_threshold>.
// J. C. Butcher, Numerical Methods for Ordinary Differential Equations (2016), section 322.
#pragma once
#include <array>
#include <memory>

#include "examples/cell_transfer.hpp"
#include "framework/run/component/plain_component.hpp"

namespace sluice::examples {

struct WaveScene {
  double radius = 0;  // r0, m
  bool runge_kutta = true;
  double refine_threshold = 0;  // change of phi from cell to cell, 1/m^3; 0: nothing is refined
};

struct WaveLabels {
  Label phi, pi;
  std::array<Label, 4> phi_stage, pi_stage;  // y1 to y4
};
WaveLabels claim_wave_labels();

class Wave : public PlainComponent {
 public:
  Wave(const Scene& scene, const WaveScene& settings);

  std::vector<SlotInfo> slots() const override;
  void initialise(Warehouse& state) const override;
  void fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                     const ThreadTeam& team) const override;
  void declare(TaskList& list, const StepVariant& variant) const override;
  void declare_diagnostics(TaskList& list, int level) const override;
  const TransferOperators& transfer() const override { return transfer_; }
  void measure_rates(const Warehouse& state, Reductions& rates) const override;
  StepLimit limit(const std::vector<double>& maxima) const override;

 private:
  double step_of(const Vec3& spacing) const;

  WaveScene settings_;
  WaveLabels labels_ = claim_wave_labels();
  CellTransfer transfer_;
  MaximumGroup rate_ = add_maxima(1);  // 1 / the step that is wanted
};

void add_wave_tags(Schema& schema);
std::unique_ptr<Component> make_wave(const Deck& deck, const Scene& scene,
                                     std::vector<Fault>& faults);

}  // namespace sluice::examples
