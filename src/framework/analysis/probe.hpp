// pointExtract: points/<name>, a line "Timestep Time Level values".
//
// A value is interpolated linearly between the centres of cells (at the domain's ends it is the
// last cell's, across periodic ends between both) on the finest level that holds all of these
// cells: no choice of boxes or ranks shows, also not when boxes move.
#pragma once
#include <memory>

#include "framework/analysis/sample_file.hpp"
#include "framework/analysis/sampler.hpp"
#include "framework/scene/analysis_settings.hpp"

namespace sluice {

// Cells around a point and how much each counts: shares, which sum to 1.
struct ProbeStencil {
  std::vector<IntVec3> cells;
  std::vector<double> weights;
};
// None outside of the domain; position in m.
ProbeStencil stencil_around(Vec3 position, const Level& level);

// What the levels of a module share: files, and the values of the sample under way.
class Probes {
 public:
  Probes(const std::vector<AnalysedPoint>& points, const std::vector<AnalysedQuantity>& quantities);

  const std::vector<AnalysedPoint>& points() const { return points_; }
  // A finer level comes after a coarser one and takes its place. `values`: all components of all
  // quantities in their order, in the units of their labels.
  void set(std::size_t point, int level, std::vector<double> values);
  void end_sample(int step, double time);
  void flush(const std::filesystem::path& folder);
  void adopt(const std::filesystem::path& earlier, const std::filesystem::path& folder,
             double time) const;

 private:
  struct Current {
    int level = -1;
    std::vector<double> values;
  };
  std::vector<AnalysedPoint> points_;
  std::vector<AnalysisFile> files_;
  std::vector<Current> current_;
};

class ProbeSampler final : public LevelSampler {
 public:
  // The sampler of level 0 looks after the files.
  ProbeSampler(const Level& level, std::vector<AnalysedQuantity> quantities,
               std::shared_ptr<Probes> probes);

  void lay_out(const Level& level) override;
  std::size_t lines() const override { return level_ == 0 ? stencils_.size() : 0; }
  void pack(const Warehouse& outputs, int rank, std::vector<double>& numbers) const override;
  void write(RankNumbers& numbers, int step, double time) override;
  void end_sample(int step, double time) override;
  void flush(const std::filesystem::path& folder) override;
  void adopt(const std::filesystem::path& earlier, const std::filesystem::path& folder,
             double time) const override;

 private:
  // A cell of a stencil in the box that holds it.
  struct Place {
    IntVec3 cell;
    int owner = 0, box = 0;
  };
  int level_ = 0;
  std::vector<ProbeStencil> stencils_;
  std::vector<std::vector<Place>> held_;  // by point; empty where a cell is missing
  std::shared_ptr<Probes> probes_;
};

}  // namespace sluice
