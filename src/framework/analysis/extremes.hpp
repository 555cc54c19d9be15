// minMax on one level: MinMax/L-<level>/<label>_<material>, a line "time minimum maximum".
//
// Component by component, a vector's in brackets. A face label counts all faces of the level's
// cells; -0 is taken as 0. Minima and maxima have no order: neither ranks nor boxes show.
#pragma once
#include "framework/analysis/sample_file.hpp"
#include "framework/analysis/sampler.hpp"

namespace sluice {

class ExtremesSampler final : public LevelSampler {
 public:
  // A quantity that is named twice is taken once.
  ExtremesSampler(int level, const std::vector<AnalysedQuantity>& quantities);

  void lay_out(const Level&) override {}
  std::size_t lines() const override { return files_.size(); }
  void pack(const Warehouse& outputs, int rank, std::vector<double>& numbers) const override;
  void write(RankNumbers& numbers, int step, double time) override;
  void flush(const std::filesystem::path& folder) override;
  void adopt(const std::filesystem::path& earlier, const std::filesystem::path& folder,
             double time) const override;

 private:
  std::vector<AnalysisFile> files_;  // by quantity
};

}  // namespace sluice
