// Means and variances of boxes of cells.
#include "framework/run/analysis/analysis_spatial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "framework/deck/faults.hpp"
#include "framework/task/halo.hpp"

namespace sluice {
namespace {

bool listed(const std::vector<Label>& labels, Label label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

// How far a box reaches from its cell; not along directions that are no dimension.
IntVec3 reach_of(const AnalysisModule& m, const Level& level) {
  IntVec3 reach{0, 0, 0};
  for (int d = 0; d < 3; ++d)
    if (level.active[d]) reach[d] = m.average_cells[d] / 2;
  return reach;
}

struct Moments {
  double mean = 0, variance = 0;
};

// Of the cells of a box that the level has.
Moments moments_of(const IndexBox& box, const RealView& held, const RealView& q, double count) {
  Moments m;
  for_each_cell(box, [&](IntVec3 c) { m.mean += held(c) != 0.0 ? q(c) : 0.0; });
  m.mean /= count;
  for_each_cell(box, [&](IntVec3 c) {
    const double d = held(c) != 0.0 ? q(c) - m.mean : 0.0;
    m.variance += d * d;
  });
  m.variance /= count;
  return m;
}

// A variable of one level with the cells around its boxes: 1 where the level has a cell, then its
// components.
class Surroundings {
 public:
  Surroundings(const Warehouse& outputs, const AnalysedQuantity& q, int width, int rank)
      : fields_(outputs.level(), rank) {
    const int from = outputs.find(q.label, q.material);
    slot_ = fields_.add({q.label, q.material, q.components + 1, width});
    for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b) {
      const IndexBox cells = outputs.local_boxes()[b].cells;
      for_each_cell(cells, [&](IntVec3 c) { held(b)(c) = 1.0; });
      for (int k = 0; k < q.components; ++k) {
        const RealView old = outputs.view(from, k, b), here = component(b, k);
        for_each_cell(cells, [&](IntVec3 c) { here(c) = old(c); });
      }
    }
    HaloExchange(outputs.level(), width, rank).run(fields_, {slot_});
  }
  RealView held(int box) const { return fields_.view(slot_, 0, box); }
  RealView component(int box, int k) const { return fields_.view(slot_, k + 1, box); }

 private:
  Warehouse fields_;
  int slot_ = 0;
};

}  // namespace

bool averages_cells(const AnalysisModule& m) {
  return m.name == "spatialAvg";
}

std::vector<std::string> names_of_cell_averages(const std::string& label) {
  return {"spatialAvg_" + label, "spatialAvg_variance_" + label};
}

CellAverages::CellAverages(const AnalysisModule& m, const FindQuantity& find, Hierarchy& hierarchy,
                           int rank)
    : module_(&m), hierarchy_(&hierarchy), rank_(rank) {
  const Level& level = hierarchy.level(0).level();
  for (int d = 0; d < 3; ++d) {
    const int cells = level.domain.size()[d];
    if (level.periodic[d] && reach_of(m, level)[d] > 0 && m.average_cells[d] > cells)
      throw DeckError(
          m.where,
          fmt::format("<avgBoxCells>: {} cells along {}, but the periodic domain has {}",
                      m.average_cells[d], "xyz"[d], cells),
          "use no more than the domain has");
  }
  for (const AnalysedVariable& v : m.variables) {
    const AnalysedQuantity q = find(v);
    const auto refuse = [&](const char* why) {
      throw DeckError(v.where, fmt::format("<Module name=\"{}\">: '{}' {}", m.name, v.label, why),
                      "use another variable");
    };
    const LabelInfo& info = q.label.info();
    if (info.centring != Centring::cell)
      refuse("is on faces or nodes; averages are of cell variables");
    if (!hierarchy.level(0).graphs().is_diagnostic_label(q.label))
      refuse("exists only within a step; averages are of functions of the state");
    const std::vector<std::string> names = names_of_cell_averages(v.label);
    const ValueType type = info.type == ValueType::vector ? ValueType::vector : ValueType::real;
    const std::string square = info.unit == "1" ? "1" : fmt::format("({})^2", info.unit);
    averaged_.push_back(
        {q, declare_label({names[0], type, Centring::cell, info.unit, "Mean of a box of cells."}),
         declare_label({names[1], type, Centring::cell, square, "Variance in a box of cells."})});
    for (const Label l : {averaged_.back().mean, averaged_.back().variance})
      if (!listed(labels_, l)) labels_.push_back(l);
  }
}

bool CellAverages::wants(const Averaged& a, const std::vector<Label>& wanted) const {
  return listed(wanted, a.mean) || listed(wanted, a.variance);
}

std::vector<Label> CellAverages::sources(const std::vector<Label>& wanted) const {
  std::vector<Label> labels;
  for (const Averaged& a : averaged_)
    if (wants(a, wanted) && !listed(labels, a.quantity.label)) labels.push_back(a.quantity.label);
  return labels;
}

void CellAverages::store(const std::vector<Label>& wanted, double time) const {
  const bool in_time = time >= module_->time_start && time <= module_->time_stop;
  for (const Averaged& a : averaged_)
    for (int l = 0; wants(a, wanted) && l < hierarchy_->level_count(); ++l)
      store_level(hierarchy_->level(l), a, in_time);
}

void CellAverages::store_level(LevelSolver& solver, const Averaged& a, bool in_time) const {
  using Where = AnalysisModule::AverageWhere;
  Warehouse& outputs = solver.outputs();
  const AnalysedQuantity& q = a.quantity;
  const int mean = outputs.add({a.mean, q.material, q.components, 0});
  const int variance = outputs.add({a.variance, q.material, q.components, 0});
  const IntVec3 reach = reach_of(*module_, solver.level());
  const Surroundings around(outputs, q, std::max({reach.x, reach.y, reach.z}), rank_);
  const double whole = (2 * reach.x + 1) * (2 * reach.y + 1) * (2 * reach.z + 1);
  for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b)
    for_each_cell(outputs.local_boxes()[b].cells, [&](IntVec3 cell) {
      IndexBox box{cell, cell};
      for (int d = 0; d < 3; ++d) {
        box.lower[d] -= reach[d];
        box.upper[d] += reach[d] + 1;
      }
      double count = 0;
      for_each_cell(box, [&](IntVec3 c) { count += around.held(b)(c); });
      const bool asked =
          in_time && (module_->average_where == Where::everywhere ||
                      (module_->average_where == Where::interior) == (count == whole));
      for (int k = 0; k < q.components; ++k) {
        const Moments m =
            asked ? moments_of(box, around.held(b), around.component(b, k), count) : Moments{};
        outputs.view(mean, k, b)(cell) = m.mean;
        outputs.view(variance, k, b)(cell) = m.variance;
      }
    });
}

}  // namespace sluice
