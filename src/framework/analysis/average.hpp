// Averages over the planes of cells of one level, and covariances with the velocity there.
//
//   planeAverage        planeAverage/tNNNNN/L-<level>/<label>_<material>
//   planeAvgTurbFluxes  planarAveTurbFluxes/AvgQ/tNNNNN/...         the same
//                       planarAveTurbFluxes/TurbFluxes/tNNNNN/...   <label>_turbFlux_<material>,
//                                          normalTurbStrss_<material>, shearTurbStrss_<material>
// a line a plane: X Y Z, then the values, then the number of cells (or the sum of weights). The
// sums are exact;
// a covariance is mean(Q'u') over the cells with Q' = Q - average of Q, u' likewise,
// computed from exact sums of products: nothing is lost when fluctuations are small.
#pragma once
#include <optional>

#include "framework/analysis/sampler.hpp"
#include "framework/analysis/snapshot.hpp"
#include "framework/base/exact_sum.hpp"
#include "framework/scene/analysis_settings.hpp"

namespace sluice {

struct AveragedQuantity {
  AnalysedQuantity quantity;
  Weighting weighting = Weighting::none;
};

// What is averaged, and how.
struct AveragePlan {
  int normal = 2;  // of the planes
  std::vector<AveragedQuantity> averaged;
  std::optional<AnalysedQuantity> weight;    // of Weighting::mass
  std::optional<AveragedQuantity> velocity;  // then covariances with it are taken as well
};

class AverageSampler final : public LevelSampler {
 public:
  AverageSampler(const Level& level, AveragePlan plan);

  void lay_out(const Level& level) override;
  std::size_t lines() const override;
  void pack(const Warehouse& outputs, int rank, std::vector<double>& numbers) const override;
  void write(RankNumbers& numbers, int step, double time) override;
  void flush(const std::filesystem::path& folder) override;
  void adopt(const std::filesystem::path& earlier, const std::filesystem::path& folder,
             double time) const override;

 private:
  // One component of a quantity.
  struct Channel {
    std::size_t quantity = 0;  // in quantities_
    int component = 0;
    Weighting weighting = Weighting::none;
  };
  // A file of a sample: averages of channels, or covariances of pairs of them.
  struct File {
    std::string name, heads;
    std::vector<std::size_t> entries;
    bool covariances = false;
    Weighting weighting = Weighting::cells;
  };
  // What is known of a plane.
  struct Values {
    double weight = 0;
    std::vector<double> averages;     // by channel
    std::vector<double> covariances;  // by pair
  };

  std::size_t quantity_number(const AnalysedQuantity& q);
  std::vector<std::size_t> add_channels(const AveragedQuantity& q);
  void add_fluxes(const std::vector<std::vector<std::size_t>>& channels);
  std::size_t sum_count() const;
  void add_cells(const Warehouse& outputs, const IndexBox& cells, int box,
                 std::vector<ExactSum>& sums) const;
  Values values_of(RankNumbers& numbers, std::int64_t cells) const;
  std::string text_of(const File& file, const std::vector<Values>& planes, double time) const;

  Level geometry_;  // without boxes
  AveragePlan plan_;
  std::optional<std::size_t> weight_;  // in quantities_
  std::vector<Channel> channels_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;  // of channels
  std::vector<File> files_;
  std::vector<int> planes_;          // indices along the normal that the level holds
  std::vector<std::int64_t> cells_;  // of each of them
  SnapshotFiles averages_, fluxes_;
};

}  // namespace sluice
