// What particles of one kind have at the nodes behind a surface: mass, temperature, velocity.
#pragma once
#include "mpmice/exchange/exchange_terms.hpp"
#include "mpmice/exchange/surface_contacts.hpp"

namespace sluice::mpmice {

template <int D>
class SolidBehind {
 public:
  // `solid`: its constants.
  explicit SolidBehind(const solids::SolidKind& solid) : solid_(&solid) {}

  // The largest of everything of this rank's particles, as the step ends.
  static void include(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets, int kind,
                      ExchangeScales& most);
  // From particles whose middles lie in cells that exchange. Collective.
  void find(const NearCells<D>& near, const CellMask& exchanging,
            const std::vector<SolidSet<D>>& sets, int kind, const ExchangeScales& most,
            Communicator& ranks);

  // By node: kg/m^3 of a cell, K, m/s.
  double mass(std::size_t node) const { return mass_[node]; }
  double temperature(std::size_t node) const { return temperature_[node]; }
  double velocity(std::size_t d, std::size_t node) const { return velocity_[d][node]; }
  // Of rigid solids 0: nothing changes them.
  double inverse_mass(std::size_t node) const { return solid_->rigid ? 0.0 : 1 / mass_[node]; }
  double inverse_capacity(std::size_t node) const {
    return solid_->rigid ? 0.0 : 1 / (mass_[node] * solid_->specific_heat);
  }
  const solids::SolidKind& solid() const { return *solid_; }
  // d_s/k_s of a contact, m^2 K/W; `time` since the run began, s.
  double resistance(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets,
                    const SurfaceContact<D>& c, double time) const;

  // The particles that count of the n-th set of the kind, each with the nodes around it, in ranges
  // that threads may take apart.
  using Nodes = std::array<NodeShare<D>, 1 << D>;
  using Counted = KeptArray<std::pair<std::uint32_t, Nodes>>;
  const std::vector<Counted>& counted(std::size_t n) const { return counted_[n]; }

 private:
  // Particles begin to end - 1.
  static void add(const Frame<D>& frame, const CellMask& exchanging, const SolidSet<D>& s,
                  const ExchangeScales& most, std::size_t begin, std::size_t end, Counted& counted,
                  CellSums<D>& sums);

  const solids::SolidKind* solid_;
  std::vector<std::vector<Counted>> counted_;  // by set of the kind, by range
  CellSums<D> sums_;
  Column mass_, temperature_;
  std::array<Column, D> velocity_;
};

}  // namespace sluice::mpmice
