// lineExtract on one level: <line>/L-<level>/i<i>_j<j>_k<k>, a line "X Y Z Timestep Time values".
//
// Of the cells that a line passes on a level, those are sampled that the level holds at the time:
// each gives a file, made when it is first sampled. A cell that an adaptive level gives up and
// takes again goes on with its file. The value on a face label is that of the cell's low face; a
// vector fills three columns. A value comes from the one box that holds the cell.
#pragma once
#include <map>

#include "framework/analysis/sample_file.hpp"
#include "framework/analysis/sampler.hpp"

namespace sluice {

// The cells of one line on a level, whether held or not.
struct SampledLine {
  std::string name;
  std::vector<IntVec3> cells;
};

class PointsSampler final : public LevelSampler {
 public:
  // Nothing is sampled before the first lay_out().
  PointsSampler(const Level& level, std::vector<AnalysedQuantity> quantities,
                const std::vector<SampledLine>& lines);

  void lay_out(const Level& level) override;
  std::size_t lines() const override { return points_.size(); }
  void pack(const Warehouse& outputs, int rank, std::vector<double>& numbers) const override;
  void write(RankNumbers& numbers, int step, double time) override;
  void flush(const std::filesystem::path& folder) override;
  void adopt(const std::filesystem::path& earlier, const std::filesystem::path& folder,
             double time) const override;

 private:
  struct Candidate {
    IntVec3 cell;
    Vec3 centre;
    std::size_t line = 0;
  };
  // A candidate that a box holds.
  struct Point {
    std::size_t candidate = 0;
    int owner = 0;  // rank
    int box = 0;    // local box number there
  };

  AnalysisFile file_of(std::size_t candidate) const;

  int level_ = 0;
  std::size_t columns_ = 0;  // of values
  std::string header_;
  std::vector<std::string> names_;  // of lines
  std::vector<Candidate> candidates_;
  std::vector<Point> points_;
  std::map<std::size_t, AnalysisFile> files_;  // by candidate
};

}  // namespace sluice
