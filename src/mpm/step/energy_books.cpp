#include "mpm/step/energy_books.hpp"

#include <algorithm>

namespace sluice::mpm {

void EnergyBooks::to_particles(const Chunk& chunk) {
  if (chunk.body->material->rigid) return;
  add_energies(*chunk.work->set, *chunk.work->next, chunk.columns(), chunk.at, chunk.n,
               chunk.body->energy_units, chunk.sums());
}

PartedBooks::PartedBooks(const MpmScene& solids, const std::vector<Carried>& carried,
                         const Level& level) {
  for (std::size_t m = 0; m < solids.materials.size(); ++m)
    parted_.emplace_back(solids, solids.materials[m], carried[m], level);
}

bool PartedBooks::possible(const MpmScene& solids, const std::vector<Carried>& carried,
                           const Level& level) {
  const PartedBooks books(solids, carried, level);
  return std::any_of(books.parted_.begin(), books.parted_.end(),
                     [](const PartedNeighbours& of) { return of.counts(); });
}

void PartedBooks::to_particles(const Chunk& chunk) {
  const PartedNeighbours& of = parted_[static_cast<std::size_t>(chunk.kind())];
  if (of.counts())
    of.add(*chunk.work->set, *chunk.work->next, chunk.columns(), chunk.at, chunk.n, chunk.sums());
}

}  // namespace sluice::mpm
