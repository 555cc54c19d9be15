// Explosive that burns and detonates (models/burn/ddt1.hpp), by the cells in which it lies.
//
// Cells detonate by their own pressure and share; surfaces burn by the cell that they look into,
// cracks by the cell of the particle's middle. All is decided before anything is given.
#pragma once
#include "models/burn/ddt1.hpp"
#include "mpmice/burn/burning_step.hpp"
#include "mpmice/burn/explosive_cells.hpp"

namespace sluice::mpmice {

// Shares of the particles' masses, by set and particle, that go by each way.
struct ExplosiveShares {
  std::vector<Column> detonated, of_surfaces, of_cracks;
};

template <int D>
class Explosive {
 public:
  Explosive(const BurningStep<D>& step, const models::SolidBurn& burn, const models::Ddt1& law)
      : step_(step), burn_(burn), law_(law) {}

  // Collective, as all of it.
  ExplosiveShares burn();
  // Which switches of outputs the step has passed, one after the other.
  void pass_switches(std::span<double> passed) const;
  const Column& detonates() const { return cells_.detonates; }
  // Once its products are among the amounts of cells: the fields that the deck saves.
  void store(const ExplosiveShares& shares);

 private:
  void look_at_cells();
  void find_hot_cells();
  void detonate();
  void burn_open_faces(std::size_t n, Column& shares) const;
  void burn_cracks(std::size_t n, Column& shares) const;
  void mark_burning_surfaces(const std::vector<Column>& shares);
  struct Pieces;
  Pieces pieces_of(const ExplosiveShares& shares) const;
  Column kinds_of_flames(const Pieces& pieces, const CellSums<D>& on_the_way) const;

  const BurningStep<D>& step_;
  const models::SolidBurn& burn_;
  const models::Ddt1& law_;
  ExplosiveCells cells_;
};

}  // namespace sluice::mpmice
