// Sums over all particles that saved histories need, beside what every run keeps in its books.
//
// Each is exact: no bit depends on the order of particles, boxes or ranks. What no history asks for
// is not summed.
#pragma once
#include <vector>

#include "framework/grid/side.hpp"
#include "framework/run/component/component.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

enum class HistorySum {
  centre_of_mass,  // 3, sum m x, kg m
  volume,          // sum V, m^3
  count,           // of particles
  heat,            // sum m c_v T, J
  face_force,      // 3, of a side, N
  face_area        // of a side, m^2
};

// Where each stands in Totals::amounts.
class HistorySums {
 public:
  explicit HistorySums(const MpmScene& solids) : solids_(&solids) {}

  bool any() const { return !entries_.empty(); }
  int count() const { return count_; }  // of components
  // First of its components; -1: nobody asked for it.
  int place(HistorySum kind, Side side = Side::x_minus) const;
  void need(HistorySum kind, Side side = Side::x_minus);
  // Of this rank's particles; `carried` by kind.
  void add(const ParticleCloud& cloud, const std::vector<Carried>& carried, Totals& totals) const;

 private:
  struct Entry {
    HistorySum kind;
    Side side;
    int first;
  };
  void add_set(const Entry& entry, const Level& level, int kind, const ParticleSet& set,
               const Carried& carried, Totals& totals) const;

  const MpmScene* solids_;
  std::vector<Entry> entries_;
  int count_ = 0;
};

}  // namespace sluice::mpm
