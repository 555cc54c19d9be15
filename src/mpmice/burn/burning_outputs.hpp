// Fields of the cells in which solids burn (burning_cells.hpp), of a step: means over what burns
// there, for the archive.
#pragma once
#include "mpmice/burn/burning_cells.hpp"
#include "mpmice/burn/burning_step.hpp"

namespace sluice::mpmice {

// A particle or a piece of its surface that burns in a cell.
struct BurningPiece {
  std::size_t set, particle, cell;
};

// Those of the fields of a law that the deck saves.
template <int D>
std::vector<BurningField> saved_fields(const BurningStep<D>& step, const models::SolidBurn& burn);

// How many pieces, of all ranks, are in each cell. The most of them. Collective.
template <int D>
double count_pieces(const BurningStep<D>& step, const std::vector<BurningPiece>& pieces,
                    CellSums<D>& counts);

// Means in cells of the values of pieces, which were counted. Collective.
template <int D>
void mean_of_pieces(const BurningStep<D>& step, const std::vector<BurningPiece>& pieces,
                    const Column& values, const CellSums<D>& counts, double most, Column& mean);

// What is not 0, of this rank's cells, into the attempted state.
template <int D>
void keep_in_cells(const BurningStep<D>& step, Label kept, int solid, const Column& values);

// Means over the pieces of surface that burn in a cell. Collective.
template <int D>
void store_burning_surfaces(const BurningStep<D>& step, const models::SolidBurn& burn,
                            const std::vector<BurningField>& fields,
                            const std::vector<BurningPiece>& pieces);

// modelMass_src, where the deck saves it: what solids give (by solid) and what fluids get (by
// fluid), mass per cell volume.
template <int D>
void store_given_mass(const BurningStep<D>& step, const std::vector<Column>& given,
                      const std::vector<Column>& made);

}  // namespace sluice::mpmice
