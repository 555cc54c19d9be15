#include "mpm/step/law_batch.hpp"

namespace sluice::mpm {

Batch& LawBatch::between(const ParticleSet& from, std::size_t at, ParticleSet& to,
                         std::size_t to_at, const Carried& carried, int n) {
  const Columns& c = carried.columns;
  const auto old = [&](int first) { return from.column(static_cast<std::size_t>(first)) + at; };
  const auto made = [&](int first) { return to.column(static_cast<std::size_t>(first)) + to_at; };
  Batch& b = batch_;
  b = {};
  b.count = n;
  for (int e = 0; e < 9; ++e) {
    b.old_F[static_cast<std::size_t>(e)] = old(c.F + e);
    b.F[static_cast<std::size_t>(e)] = made(c.F + e);
  }
  for (int e = 0; e < 6; ++e) {
    b.old_stress[static_cast<std::size_t>(e)] = old(c.stress + e);
    b.stress[static_cast<std::size_t>(e)] = made(c.stress + e);
  }
  b.temperature = old(c.temperature);
  b.mass = old(c.mass);
  b.volume_0 = old(c.volume_0);
  b.id = from.ids().data() + at;
  b.old_energy = old(c.energy);
  b.energy = made(c.energy);
  if (c.lost_heat >= 0) b.heat = old(c.lost_heat);
  old_history_.clear();
  history_.clear();
  for (int h = 0; h < carried.history_columns; ++h) {
    old_history_.push_back(old(c.history + h));
    history_.push_back(made(c.history + h));
  }
  b.old_history = old_history_;
  b.history = history_;
  return b;
}

}  // namespace sluice::mpm
