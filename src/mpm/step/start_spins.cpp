// Spins at the start of the midpoint transfer, where the deck gives particles velocities one by
// one: SolidLevels::start_spins.
#include <algorithm>

#include "mpm/step/midpoint_stage.hpp"
#include "mpm/step/thread_report.hpp"

namespace sluice::mpm {

std::vector<KindRates> SolidStep::hold_start(const StageScope& scope, bool spins) {
  std::vector<ThreadReport> reports = new_reports(scope);
  scope.levels.front()->team()->for_each(work_.size(), [&](std::size_t i, int thread) {
    BlockWork& w = work_[i];
    const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
    const Columns& c = body.carried->columns;
    if (body.material->rigid) return;
    ThreadReport& report = reports[static_cast<std::size_t>(thread)];
    report.up = report.down = KindRates::none();
    const std::size_t count = w.run.end - w.run.begin;
    for (int d = 0; d < 3; ++d) {
      const auto keep = [&](const double* from, double* to) {
        std::copy_n(from + w.run.begin, count, to + w.run.begin);
      };
      const auto velocity = static_cast<std::size_t>(c.velocity + d);
      const auto spin = static_cast<std::size_t>(c.spin + d);
      keep(w.set->column(velocity), w.next->column(velocity));
      keep(w.set->column(spin), w.next->column(spin));
      if (!spins) std::fill_n(w.next->column(spin) + w.run.begin, count, 0.0);
    }
    stay(w, w.run.begin, static_cast<int>(count));
    find_nodes_of(w);
    add_bounds(w, w.run.begin, static_cast<int>(count), report);
    find_middle_nodes(w, report);
  });
  std::vector<KindRates> rates(bodies_.size());
  for (const ThreadReport& r : reports)
    for (std::size_t k = 0; k < rates.size(); ++k) rates[k].add(r.rates[k]);
  return rates;
}

void SolidStep::take_spins(const StageScope& scope) {
  std::vector<ThreadReport> reports = new_reports(scope);
  scope.levels.front()->team()->for_each(work_.size(), [&](std::size_t i, int thread) {
    const BlockWork& w = work_[i];
    const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
    const Columns& c = body.carried->columns;
    if (body.material->rigid) return;
    ThreadReport& report = reports[static_cast<std::size_t>(thread)];
    report.window.load(w.middle_lowest, w.middle_highest, body.table, body.mapped);
    ParticleSet& set = scope.particles->store(w.kind).set(level_.index, w.box);
    for (std::size_t at = w.run.begin; at < w.run.end; at += chunk_size) {
      const int n = static_cast<int>(std::min<std::size_t>(chunk_size, w.run.end - at));
      read_velocities(solids_->basis, body.grid, places_of_gradients(w), shape_of_gradients(w),
                      static_cast<int>(at), n, report.window, report.read);
      for (int k = 0; k < 3; ++k) {
        double* spin = set.column(static_cast<std::size_t>(c.spin + k)) + at;
        for (int q = 0; q < n; ++q) spin[q] = turns(level_, k) ? spin_of(report.read, k, q) : 0.0;
      }
    }
  });
}

}  // namespace sluice::mpm
