// planeExtract on one level: <plane>/tNNNNN/L-<level>/<label>_<material>.dat, a line "X Y Z value".
//
// All cells of the level that the rectangle passes, x fastest; a vector has three columns. The
// plane passes the cells that hold its fixed coordinate (on a face: the upper ones, at the high
// end of the domain the last). A face label has the faces of those cells, with their own places.
#pragma once
#include "framework/analysis/sampler.hpp"
#include "framework/analysis/snapshot.hpp"
#include "framework/scene/analysis_settings.hpp"

namespace sluice {

// The cells of a level that a rectangle passes.
struct PlaneCells {
  IndexBox cells;        // empty: it lies outside the domain
  bool clipped = false;  // a part lies outside
};
PlaneCells cells_in_plane(const AnalysedPlane& plane, const Level& level);

// One rectangle on a level.
struct SampledPlane {
  std::string name;
  IndexBox cells;
};

class PlaneSampler final : public LevelSampler {
 public:
  PlaneSampler(const Level& level, std::vector<AnalysedQuantity> quantities,
               const std::vector<SampledPlane>& planes);

  void lay_out(const Level& level) override;
  std::size_t lines() const override { return lines_; }
  void pack(const Warehouse& outputs, int rank, std::vector<double>& numbers) const override;
  void write(RankNumbers& numbers, int step, double time) override;
  void flush(const std::filesystem::path& folder) override;
  void adopt(const std::filesystem::path& earlier, const std::filesystem::path& folder,
             double time) const override;

 private:
  // What one box holds of a plane.
  struct Piece {
    IndexBox cells;
    int owner = 0;  // rank
    int box = 0;    // local box number there
  };
  struct Plane {
    SampledPlane where;
    std::vector<Piece> pieces;
    SnapshotFiles files;
  };

  // The indices of a label in some cells.
  IndexBox indices_of(const IndexBox& cells, Label label) const;
  std::string text_of(const Plane& plane, const AnalysedQuantity& q, RankNumbers& numbers,
                      double time) const;

  Level geometry_;  // without boxes
  std::vector<Plane> planes_;
  std::size_t lines_ = 0;
};

}  // namespace sluice
