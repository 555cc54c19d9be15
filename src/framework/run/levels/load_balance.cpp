// Gathering costs and dealing out boxes.
#include "framework/run/levels/load_balance.hpp"

#include <cstring>

#include "framework/refine/box_cost.hpp"

namespace sluice {

std::vector<double> box_seconds(const LevelSolver& solver, const ParticleCloud* particles,
                                Communicator& communicator) {
  std::vector<double> mine = solver.graphs().box_seconds();
  if (particles != nullptr && solver.level().index < particles->level_count()) {
    const std::vector<double>& more = particles->box_seconds(solver.level().index);
    for (std::size_t b = 0; b < mine.size(); ++b) mine[b] += more[b];
  }
  const std::vector<GridBox>& boxes = solver.level().boxes;
  const std::string text(reinterpret_cast<const char*>(mine.data()), mine.size() * sizeof(double));
  const std::vector<std::string> all = communicator.gather_to_all(text);
  std::vector<std::size_t> next(all.size(), 0);  // local boxes are numbered in the order of ids
  std::vector<double> seconds;
  for (const GridBox& b : boxes) {
    const std::size_t rank = b.owner;
    double value = 0;
    std::memcpy(&value, all[rank].data() + next[rank]++ * sizeof value, sizeof value);
    seconds.push_back(value);
  }
  return seconds;
}

void deal_out(std::vector<GridBox>& boxes, const LevelSolver& solver,
              const ParticleCloud* particles, Communicator& communicator) {
  if (communicator.size() == 1) return;
  const std::vector<double> measured = box_seconds(solver, particles, communicator);
  assign_owners(boxes, carried_costs(solver.level().boxes, measured, boxes), communicator.size());
}

std::vector<GridBox> rebalanced(const LevelSolver& solver, const ParticleCloud* particles,
                                double least_gain, Communicator& communicator) {
  if (communicator.size() == 1) return {};
  return better_owners(solver.level().boxes, box_seconds(solver, particles, communicator),
                       communicator.size(), least_gain);
}

}  // namespace sluice
