#include "mpm/budgets/history_sums.hpp"

#include <algorithm>

#include "mpm/budgets/face_sums.hpp"

namespace sluice::mpm {
namespace {

constexpr int components_of(HistorySum kind) {
  return kind == HistorySum::centre_of_mass || kind == HistorySum::face_force ? 3 : 1;
}

constexpr bool is_on_side(HistorySum kind) {
  return kind == HistorySum::face_force || kind == HistorySum::face_area;
}

}  // namespace

int HistorySums::place(HistorySum kind, Side side) const {
  for (const Entry& e : entries_)
    if (e.kind == kind && (!is_on_side(kind) || e.side == side)) return e.first;
  return -1;
}

void HistorySums::need(HistorySum kind, Side side) {
  if (place(kind, side) >= 0) return;
  entries_.push_back({kind, side, count_});
  count_ += components_of(kind);
}

void HistorySums::add_set(const Entry& entry, const Level& level, int kind, const ParticleSet& set,
                          const Carried& carried, Totals& totals) const {
  const SolidMaterial& material = solids_->materials[kind];
  const Columns& c = carried.columns;
  ConservedTotal* to = totals.amounts.data() + entry.first;
  const double* m = set.column(c.mass);
  const double* volume = set.column(c.volume);
  const double* T = set.column(c.temperature);
  switch (entry.kind) {
    case HistorySum::centre_of_mass:
      for (int d = 0; d < 3; ++d)
        for (std::size_t p = 0; p < set.size(); ++p) to[d].add(m[p] * set.coordinate(d)[p]);
      break;
    case HistorySum::volume:
      for (std::size_t p = 0; p < set.size(); ++p) to->add(volume[p]);
      break;
    case HistorySum::count:
      to->add(static_cast<double>(set.size()));
      break;
    case HistorySum::heat:
      for (std::size_t p = 0; p < set.size(); ++p)
        to->add(m[p] * material.constants.specific_heat * T[p]);
      break;
    case HistorySum::face_force:
      add_face(*solids_, level, entry.side, is_mirror(*solids_, entry.side, kind), set, carried, to,
               nullptr);
      break;
    case HistorySum::face_area:
      add_face(*solids_, level, entry.side, is_mirror(*solids_, entry.side, kind), set, carried,
               nullptr, to);
      break;
  }
}

void HistorySums::add(const ParticleCloud& cloud, const std::vector<Carried>& carried,
                      Totals& totals) const {
  totals.amounts.resize(std::max(totals.amounts.size(), static_cast<std::size_t>(count_)));
  for (const Entry& e : entries_)
    for (int k = 0; k < static_cast<int>(carried.size()); ++k) {
      const ParticleStore& store = cloud.store(k);
      for (int l = 0; l < store.level_count(); ++l)
        for (int b = 0; b < store.box_count(l); ++b)
          add_set(e, cloud.level(l), k, store.set(l, b), carried[k], totals);
    }
}

}  // namespace sluice::mpm
