// How well the fluid in front of a surface and the solid behind it are joined: G of all pairs of a
// contact and one node behind it, and their sums in cells and at nodes.
#pragma once
#include "mpmice/exchange/fluid_in_front.hpp"
#include "mpmice/exchange/solid_behind.hpp"

namespace sluice::mpmice {

template <int D>
class Conductances {
 public:
  struct Pair {
    std::uint32_t contact;
    std::size_t node;  // its place
    double drag;       // G of momentum, kg/(m^3 s)
  };

  // At the end of a step. Collective.
  void find(const NearCells<D>& near, const std::vector<SolidSet<D>>& sets,
            const KeptArray<SurfaceContact<D>>& contacts, const CellAmounts<D>& amounts,
            const FluidInFront<D>& front, const SolidBehind<D>& behind,
            const FilmCoefficients& films, double time, Communicator& ranks);

  const KeptArray<Pair>& pairs() const { return pairs_; }
  // G of heat of the n-th pair with fluid m, W/(m^3 K).
  double heat(std::size_t n, std::size_t m) const { return heat_[n * fluids_ + m]; }
  // Sums of G: of the cell of a contact, with each fluid; of a node.
  double drag_in_front(std::size_t cell) const { return drag_in_front_[cell]; }
  double heat_in_front(std::size_t m, std::size_t cell) const { return heat_in_front_[m][cell]; }
  double drag_behind(std::size_t node) const { return drag_behind_[node]; }
  double heat_behind(std::size_t node) const { return heat_behind_[node]; }

 private:
  // Of contacts begin to end - 1.
  struct Joined {
    KeptArray<Pair> pairs;
    KeptArray<double> heat;
  };
  struct Sides {
    const FluidInFront<D>& front;
    const SolidBehind<D>& behind;
    const FilmCoefficients& films;
  };
  void pair_up(const Frame<D>& frame, const SolidSet<D>& s, const SurfaceContact<D>& c,
               std::size_t contact, double volume, const Sides& sides, double resistance,
               double time, Joined& to) const;
  void sum(const CellBlocks<D>& cells, const KeptArray<SurfaceContact<D>>& contacts,
           Communicator& ranks);

  std::size_t fluids_ = 0;
  KeptArray<Pair> pairs_;
  KeptArray<double> heat_;
  Column drag_in_front_, drag_behind_, heat_behind_;
  std::vector<Column> heat_in_front_;  // by fluid
  CellSums<D> sums_;
};

}  // namespace sluice::mpmice
