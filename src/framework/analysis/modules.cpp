// Making the samplers of a module.
#include "framework/analysis/modules.hpp"

#include <fmt/format.h>

#include "framework/analysis/average.hpp"
#include "framework/analysis/extremes.hpp"
#include "framework/analysis/line.hpp"
#include "framework/analysis/plane.hpp"
#include "framework/analysis/points.hpp"
#include "framework/analysis/probe.hpp"
#include "framework/deck/faults.hpp"

namespace sluice {
namespace {

bool averages(const AnalysisModule& m) {
  return m.name == "planeAverage" || m.name == "planeAvgTurbFluxes";
}

std::unique_ptr<LevelSampler> line_sampler(const AnalysisModule& m, const Level& level,
                                           std::vector<AnalysedQuantity> quantities) {
  std::vector<SampledLine> lines;
  for (const AnalysedLine& line : m.lines)
    if (LineCells found = cells_on_line(line, level); !found.cells.empty())
      lines.push_back({line.name, std::move(found.cells)});
  if (lines.empty()) return nullptr;
  return std::make_unique<PointsSampler>(level, std::move(quantities), lines);
}

std::unique_ptr<LevelSampler> plane_sampler(const AnalysisModule& m, const Level& level,
                                            std::vector<AnalysedQuantity> quantities) {
  std::vector<SampledPlane> planes;
  for (const AnalysedPlane& plane : m.planes)
    if (const PlaneCells found = cells_in_plane(plane, level); !found.cells.empty())
      planes.push_back({plane.name, found.cells});
  if (planes.empty()) return nullptr;
  return std::make_unique<PlaneSampler>(level, std::move(quantities), planes);
}

// The weight of a module, as if it were an entry of its list.
AnalysedVariable weight_of(const AnalysisModule& m) {
  AnalysedVariable v;
  v.label = m.weight;
  v.material = m.material;
  v.where = m.where;
  return v;
}

std::unique_ptr<LevelSampler> average_sampler(const AnalysisModule& m, const Level& level,
                                              int levels, const FindQuantity& find) {
  AveragePlan plan;
  plan.normal = m.plane_normal;
  bool weighted = m.velocity && m.velocity->weighting == Weighting::mass;
  for (const AnalysedVariable& v : m.variables) {
    if (!v.levels.contains(level.index, levels)) continue;
    plan.averaged.push_back({find(v), v.weighting});
    weighted = weighted || v.weighting == Weighting::mass;
  }
  if (weighted) plan.weight = find(weight_of(m));
  if (m.name == "planeAvgTurbFluxes")
    plan.velocity = AveragedQuantity{find(*m.velocity), m.velocity->weighting};
  if (plan.averaged.empty() && !plan.velocity) return nullptr;
  return std::make_unique<AverageSampler>(level, std::move(plan));
}

void refuse(const AnalysisModule& m, const AnalysedVariable& v, const char* why) {
  throw DeckError(v.where, fmt::format("<Module name=\"{}\">: '{}' {}", m.name, v.label, why),
                  "use another variable");
}

void check_averages(const AnalysisModule& m, const FindQuantity& find) {
  if (m.name == "planeAvgTurbFluxes" && !m.velocity)
    throw DeckError(m.where, fmt::format("<Module name=\"{}\"> needs a velocity", m.name),
                    "write <velocity label=\"vel_CC\"/>");
  std::vector<AnalysedVariable> all = m.variables;
  if (!m.weight.empty() && find(weight_of(m)).components != 1)
    refuse(m, weight_of(m), "is a vector; the weight is a scalar");
  if (m.velocity) {
    if (find(*m.velocity).components != 3) refuse(m, *m.velocity, "is not a vector");
    all.push_back(*m.velocity);
  }
  for (const AnalysedVariable& v : all) {
    const AnalysedQuantity q = find(v);
    if (q.label.info().centring != Centring::cell)
      refuse(m, v, "is on faces or nodes; averages over planes are of cell variables");
    if (m.velocity && q.components != 1 && v.label != m.velocity->label)
      refuse(m, v, "is a vector; fluxes are of scalars and of the velocity itself");
  }
}

}  // namespace

bool sample_is_due(const AnalysisModule& m, std::optional<double> last, double time) {
  if (time < m.time_start || time > m.time_stop) return false;
  if (!last || m.sampling_frequency <= 0) return true;
  return time >= *last + 1.0 / m.sampling_frequency;
}

bool samples_levels(const AnalysisModule& m) {
  return m.name == "minMax" || m.name == "lineExtract" || m.name == "planeExtract" ||
         m.name == "pointExtract" || averages(m);
}

bool writes_one_set_of_files(const AnalysisModule& m) {
  return averages(m);
}

void check_fields(const AnalysisModule& m, const FindQuantity& find) {
  for (const AnalysedVariable& v : m.variables) find(v);  // also if on no level
  if (averages(m)) check_averages(m, find);
  if (m.name != "pointExtract") return;
  for (const AnalysedVariable& v : m.variables)
    if (find(v).label.info().centring != Centring::cell)
      refuse(m, v, "is on faces or nodes; points are between the centres of cells");
}

namespace {

std::unique_ptr<LevelSampler> make_sampler(const AnalysisModule& m, const Level& level, int levels,
                                           const FindQuantity& find) {
  if (averages(m)) return average_sampler(m, level, levels, find);
  std::vector<AnalysedQuantity> quantities;
  for (const AnalysedVariable& v : m.variables)
    if (v.levels.contains(level.index, levels)) quantities.push_back(find(v));
  if (quantities.empty()) return nullptr;
  if (m.name == "minMax") return std::make_unique<ExtremesSampler>(level.index, quantities);
  if (m.name == "planeExtract") return plane_sampler(m, level, std::move(quantities));
  return line_sampler(m, level, std::move(quantities));
}

// All levels read the same variables: the finest one wins.
std::vector<std::unique_ptr<LevelSampler>> probe_samplers(const AnalysisModule& m,
                                                          const std::vector<Level>& levels,
                                                          const FindQuantity& find) {
  std::vector<AnalysedQuantity> quantities;
  for (const AnalysedVariable& v : m.variables) quantities.push_back(find(v));
  std::vector<AnalysedPoint> inside;
  for (const AnalysedPoint& p : m.points)
    if (!stencil_around(p.position, levels.front()).cells.empty()) inside.push_back(p);
  std::vector<std::unique_ptr<LevelSampler>> samplers(levels.size());
  if (quantities.empty() || inside.empty()) return samplers;
  const auto probes = std::make_shared<Probes>(inside, quantities);
  for (std::size_t l = 0; l < levels.size(); ++l)
    samplers[l] = std::make_unique<ProbeSampler>(levels[l], quantities, probes);
  return samplers;
}

}  // namespace

std::vector<std::unique_ptr<LevelSampler>> make_samplers(const AnalysisModule& m,
                                                         const std::vector<Level>& levels,
                                                         const FindQuantity& find) {
  if (m.name == "pointExtract") return probe_samplers(m, levels, find);
  std::vector<std::unique_ptr<LevelSampler>> samplers;
  for (const Level& level : levels)
    samplers.push_back(samples_levels(m)
                           ? make_sampler(m, level, static_cast<int>(levels.size()), find)
                           : nullptr);
  return samplers;
}

}  // namespace sluice
