// Accounts of control volumes, and their lines.
#include "framework/run/analysis/analysis_volume.hpp"

#include <fmt/format.h>

#include "framework/grid/box_list.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

std::string header(const AnalysisModule& m, const ControlVolume& v, const VolumeCells& cells) {
  const IntVec3 a = cells.cells.lower, b = cells.cells.upper;
  const std::string where =
      fmt::format("# {} '{}': cells [{}, {}, {}] to [{}, {}, {}] of level 0\n", m.name, v.name, a.x,
                  a.y, a.z, b.x, b.y, b.z);
  if (m.name == "controlVolFluxes")
    return where + fmt::format(
                       "# mass of material {} [kg], mass fluxes [kg/s] along the axes\n"
                       "#Time Total X_faces Y_faces Z_faces x- x+ y- y+ z- z+\n",
                       m.material);
  if (m.name == "momentumAnalysis")
    return where +
           "# momentum [kg m/s]; flux and forces [N] that add to it\n"
           "#Time, CV_mom.x, CV_mom.y, CV_mom.z, momFlux.x, momFlux.y, momFlux.z, visFlux.x, "
           "visFlux.y, visFlux.z, pressForce.x, pressForce.y, pressForce.z, bodyForce.x, "
           "bodyForce.y, bodyForce.z\n";
  return where + fmt::format(
                     "# energies [J] and powers [W], times {:.17g}; flux: outward\n"
                     "#Time ICE_totalIntEng MPM_totalIntEng totalIntEng total_ICE_Flux kinEng "
                     "forcePower\n",
                     m.energy_factor);
}

std::string file_name(const AnalysisModule& m, const ControlVolume& v) {
  if (m.name == "firstLawThermo") return "1stLawThermo.dat";
  return v.name + ".dat";
}

// Everything of a level but the uncovered cells of a box.
LevelCoverage all_but(const IndexBox& inside, const Level& level, const Level* finer, int rank) {
  Level rest = level;
  rest.ratio = {1, 1, 1};
  rest.boxes.clear();
  for (const IndexBox& b : subtract(level.domain, inside)) rest.boxes.push_back({b, 0, 0});
  if (finer != nullptr)
    for (const GridBox& b : finer->boxes)
      rest.boxes.push_back({coarsen(b.cells, finer->ratio), 0, 0});
  return LevelCoverage(level, &rest, rank);
}

}  // namespace

bool keeps_budgets(const AnalysisModule& m) {
  return m.name == "controlVolFluxes" || m.name == "momentumAnalysis" || m.name == "firstLawThermo";
}

VolumeBudgets::VolumeBudgets(const AnalysisModule& module, int first, Hierarchy& hierarchy,
                             Communicator& communicator)
    : module_(&module),
      hierarchy_(&hierarchy),
      communicator_(&communicator),
      slots_(*hierarchy.component().budgets().volume_sums()),
      first_slot_(slots_.mass(0, 0, 0)),
      slot_count_(slots_.count(1)) {
  for (std::size_t n = 0; n < module.volumes.size(); ++n) {
    const int number = first + static_cast<int>(n);
    const VolumeCells& cells = hierarchy.levels().volumes()[number];
    if (cells.cells.empty()) continue;
    const ControlVolume& v = module.volumes[n];
    volumes_.push_back({number,
                        AnalysisFile(file_name(module, v), header(module, v, cells), 0),
                        {},
                        std::vector<Double2>(slot_count_),
                        0});
  }
}

void VolumeBudgets::lay_out() {
  const Level& coarsest = hierarchy_->level(0).level();
  for (Volume& v : volumes_) {
    v.coverage.clear();
    const IndexBox& cells = hierarchy_->levels().volumes()[v.number].cells;
    for (int l = 0; l < hierarchy_->level_count(); ++l) {
      const Level& level = hierarchy_->level(l).level();
      IntVec3 ratio;
      for (int d = 0; d < 3; ++d) ratio[d] = level.domain.size()[d] / coarsest.domain.size()[d];
      const Level* finer =
          l + 1 < hierarchy_->level_count() ? &hierarchy_->level(l + 1).level() : nullptr;
      v.coverage.push_back(all_but(refine(cells, ratio), level, finer, communicator_->rank()));
    }
  }
}

void VolumeBudgets::record(double dt, const std::vector<double>& sums) {
  for (Volume& v : volumes_) {
    if (!sampled_) {  // the first line tells of its own step
      v.passed.assign(v.passed.size(), {});
      v.seconds = 0;
    }
    const double* own = sums.data() + first_slot_ + v.number * slot_count_;
    for (std::size_t s = 0; s < v.passed.size(); ++s)
      v.passed[s] = v.passed[s] + as_double2(own[s]);
    v.seconds += dt;
  }
}

Totals VolumeBudgets::totals_of(const Volume& v) const {
  Totals t;
  t.mass.resize(hierarchy_->component().material_count());
  for (std::size_t l = 0; l < v.coverage.size(); ++l)
    hierarchy_->component().budgets().add_totals(hierarchy_->level(static_cast<int>(l)).state(),
                                                 v.coverage[l], t);
  Reduction all;
  std::vector<ConservedTotal*> totals;
  for (ConservedTotal& m : t.mass) totals.push_back(&m);
  for (ConservedTotal& m : t.momentum) totals.push_back(&m);
  totals.push_back(&t.internal_energy);
  totals.push_back(&t.kinetic_energy);
  std::vector<Reduction::Sum> places;
  for (const ConservedTotal* q : totals) places.push_back(all.add_sum(q->sum));
  communicator_->reduce(all);
  for (std::size_t q = 0; q < totals.size(); ++q) totals[q]->sum = all.sum(places[q]);
  return t;
}

double VolumeBudgets::rate(const Volume& v, int slot) const {
  if (v.seconds == 0) return 0;
  const Double2 passed = v.passed[slot - first_slot_];
  return (passed.high + passed.low) / v.seconds;
}

// What passes along an axis comes in at the minus side and leaves at the plus side.
double VolumeBudgets::inflow(const Volume& v, int (VolumeSums::*slot)(int, int) const,
                             int component) const {
  Double2 sum;
  for (int side = 0; side < 6; ++side) {
    const int at = (slots_.*slot)(0, side) + component - first_slot_;
    const Double2 passed = v.passed[at];
    sum = side % 2 == 0 ? sum + passed : sum - passed;
  }
  return v.seconds == 0 ? 0.0 : (sum.high + sum.low) / v.seconds;
}

std::string VolumeBudgets::fluxes(const Volume& v, const Totals& totals) const {
  const std::size_t m = module_->material;
  double through[6];
  for (int side = 0; side < 6; ++side)
    through[side] = rate(v, slots_.mass(0, side, module_->material));
  return fmt::format(" {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", totals.mass[m].sum.value(),
                     through[0] - through[1], through[2] - through[3], through[4] - through[5],
                     fmt::join(through, through + 6, " "));
}

std::string VolumeBudgets::momentum(const Volume& v, const Totals& totals) const {
  double columns[15];
  for (int d = 0; d < 3; ++d) {
    columns[d] = totals.momentum[d].sum.value();
    columns[3 + d] = inflow(v, &VolumeSums::momentum, d);
    columns[6 + d] = inflow(v, &VolumeSums::viscous, d);
    // Of the two sides along d alone: pressure acts along their normal.
    columns[9 + d] = rate(v, slots_.pressure(0, 2 * d)) - rate(v, slots_.pressure(0, 2 * d + 1));
    columns[12 + d] = rate(v, slots_.force(0) + d);
  }
  return fmt::format(", {:.17g}", fmt::join(columns, columns + 15, ", "));
}

std::string VolumeBudgets::energy(const Volume& v, const Totals& totals) const {
  const double factor = module_->energy_factor;
  const double internal = factor * totals.internal_energy.sum.value();
  return fmt::format(" {:.17g} 0 {:.17g} {:.17g} {:.17g} {:.17g}", internal, internal,
                     -factor * inflow(v, &VolumeSums::energy, 0) + 0.0,
                     factor * totals.kinetic_energy.sum.value(), factor * rate(v, slots_.work(0)));
}

std::string VolumeBudgets::line_of(const Volume& v, const Totals& totals, double time) const {
  const std::string start = fmt::format("{:.17g}", time);
  if (module_->name == "controlVolFluxes") return start + fluxes(v, totals);
  if (module_->name == "momentumAnalysis") return start + momentum(v, totals);
  return start + energy(v, totals);
}

void VolumeBudgets::sample(double time) {
  for (Volume& v : volumes_) {
    const Totals totals = totals_of(v);
    if (communicator_->is_root()) v.file.append(line_of(v, totals, time));
    v.passed.assign(v.passed.size(), {});
    v.seconds = 0;
  }
  sampled_ = true;
}

void VolumeBudgets::flush(const fs::path& folder) {
  for (Volume& v : volumes_) v.file.flush(folder);
}

void VolumeBudgets::adopt(const fs::path& earlier, const fs::path& folder, double time) const {
  for (const Volume& v : volumes_) v.file.adopt(earlier, folder, time);
}

std::vector<std::vector<double>> VolumeBudgets::state() const {
  std::vector<std::vector<double>> kept;
  for (const Volume& v : volumes_) {
    std::vector<double> own = {sampled_ ? 1.0 : 0.0, v.seconds};
    for (const Double2& p : v.passed) {
      own.push_back(p.high);
      own.push_back(p.low);
    }
    kept.push_back(std::move(own));
  }
  return kept;
}

void VolumeBudgets::restore(const std::vector<std::vector<double>>& kept) {
  for (std::size_t n = 0; n < volumes_.size() && n < kept.size(); ++n) {
    Volume& v = volumes_[n];
    if (kept[n].size() != 2 + 2 * v.passed.size()) continue;  // of another deck
    sampled_ = kept[n][0] != 0;
    v.seconds = kept[n][1];
    for (std::size_t s = 0; s < v.passed.size(); ++s)
      v.passed[s] = {kept[n][2 + 2 * s], kept[n][3 + 2 * s]};
  }
}

}  // namespace sluice
