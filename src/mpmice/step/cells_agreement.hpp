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

  // Does a cell close with fluid in it; is one in no state; has a solid strayed.
  struct Faults {
    bool trapped = false, inadmissible = false, strayed = false;
    bool any() const { return trapped || inadmissible || strayed; }
  };
  // `here`: on this rank, and the rates of its cells. On all ranks; where all are well, books go to
  // the sums of the step, and solids know the velocities that exchange has left. Collective.
  Faults find(const SolidSets<D>& sets, const Faults& here, const CellRates& own,
              CouplingBooks& books, std::span<double> sums, Communicator& ranks);
  // Of all ranks.
  const CellRates& rates() const { return rates_; }

 private:
  solids::CoupledSolids* solids_;
  const SurfaceExchange<D>* exchange_;
  CellRates rates_;
};

}  // namespace sluice::mpmice
