// What all ranks come to behind the exchange: whether cells of the fluid are in a state, the books
// of the coupling, limits of the next step; in one reduction.
#pragma once
#include "mpmice/amounts/fluid_in_cells.hpp"
#include "mpmice/exchange/surface_exchange.hpp"
#include "mpmice/fields/coupling_books.hpp"

namespace sluice::mpmice {

template <int D>
class CellsAgreement {
 public:
  CellsAgreement(solids::CoupledSolids& solids, const SurfaceExchange<D>& exchange)
      : solids_(&solids), exchange_(&exchange) {}

  // Does a cell close with fluid in it; is one in no state.
  struct Outcome {
    bool trapped = false, inadmissible = false;
  };
  // `good`: are all cells of this rank in a state, with these rates. Where all are well, books go
  // to the sums of the step, and solids know the velocities that exchange has left. Collective.
  Outcome find(const SolidSets<D>& sets, bool trapped, bool good, const CellRates& own,
               CouplingBooks& books, std::span<double> sums, Communicator& ranks);
  // Of all ranks.
  const CellRates& rates() const { return rates_; }

 private:
  solids::CoupledSolids* solids_;
  const SurfaceExchange<D>* exchange_;
  CellRates rates_;
};

}  // namespace sluice::mpmice
