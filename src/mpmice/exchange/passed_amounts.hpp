// What passes the pairs of a surface in a step, and who gets it: each pair gives the same integer
// to both of its sides.
#pragma once
#include "mpmice/exchange/conductances.hpp"
#include "mpmice/fields/coupling_books.hpp"

namespace sluice::mpmice {

template <int D>
class PassedAmounts {
 public:
  PassedAmounts(const FluidInFront<D>& front, const SolidBehind<D>& behind,
                const ExchangeScales& most)
      : front_(front), behind_(behind), most_(most) {}

  // Of all pairs in dt. Collective.
  void pass(const NearCells<D>& near, const KeptArray<SurfaceContact<D>>& contacts,
            const Conductances<D>& joined, const FilmCoefficients& films, double dt,
            Communicator& ranks);
  // Changes amounts of the fluid; velocities and temperatures of the particles, as the step ends,
  // of the n-th set of the kind; the books, where the solid is rigid.
  void give_to_fluid(const NearCells<D>& near, CellAmounts<D>& amounts) const;
  void give_to_set(const NearCells<D>& near, SolidSet<D>& s, std::size_t n,
                   CouplingBooks& books) const;
  void book_rigid(const Frame<D>& frame, CouplingBooks& books) const;

 private:
  // Lanes of what passes; -1: none.
  struct Lanes {
    int heat_of_fluid = -1, momentum = -1, energy = -1;        // of cells in front
    int heat = -1, relaxation = -1, impulse = -1, given = -1;  // of nodes behind
    int count = 0;

    Lanes(const FilmCoefficients& films, int fluids);
    Lanes() = default;
  };
  // Of one mass at a node: kick, temperature gained, share of relaxation, energy beyond u.kick.
  struct Gain {
    std::array<double, D> kick{};
    double warm = 0, relaxation = 0, energy = 0;
  };
  // One of the pairs: the cell in front, the step, s and m^3.
  struct OnePair {
    std::size_t number, cell;
    double dt, cell_volume;
  };
  // Of pairs with rigid solids: impulses on the fluid and energy given to it.
  struct ByRigid {
    std::array<ExactSum, D> impulse;
    ExactSum work;
  };
  void pass_heat(const Conductances<D>& joined, const OnePair& pair, CellSums<D>& sums,
                 ByRigid& given) const;
  void pass_drag(const Conductances<D>& joined, const OnePair& pair, CellSums<D>& sums,
                 ByRigid& given) const;
  Gain gain_of(std::size_t node) const;
  void give_to_particles(const Frame<D>& frame, SolidSet<D>& s,
                         const typename SolidBehind<D>::Counted& counted, ExactSum& heated,
                         ExactSum& moved) const;
  double value(int lane, std::size_t cell, double scale) const {
    return lane < 0 ? 0.0 : from_sum(sums_.lane(lane)[cell]) * scale;
  }
  double unit_of_heat() const;
  double unit_of_impulse() const;

  const FluidInFront<D>& front_;
  const SolidBehind<D>& behind_;
  const ExchangeScales& most_;
  Lanes lanes_;
  CellSums<D> sums_;
  ByRigid by_rigid_;
};

}  // namespace sluice::mpmice
