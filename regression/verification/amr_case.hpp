// Runs on several levels: what every level holds, and the part of it that no finer level covers.
#pragma once
#include <string>
#include <vector>

#include "verification/case_run.hpp"

namespace sluice::verification {

struct LevelCell {
  int level = 0;
  IntVec3 cell;
  Vec3 centre;
  double volume = 0, value = 0;
  bool covered = false;  // by the next finer level
};

// Cells of all levels, coarse to fine.
std::vector<LevelCell> level_cells(const CaseRun& run, const std::string& variable,
                                   int component = 0, const std::string& which = "last",
                                   int material = 0);
// Largest |value - wanted| on any level, covered cells included.
double farthest_on_levels(const CaseRun& run, const std::string& variable, int component,
                          double wanted);

// L1 distance, per volume, of the uncovered cells from the means of a uniform run that is at least
// as fine as the finest level.
double distance_from(const CaseRun& run, const CellValues& finer, const std::string& variable);

// Most cells that a level had, and all levels that there were.
std::vector<long> max_cells(const CaseRun& run);
long regrids(const CaseRun& run);
// Cell updates as a share of those of a grid that is fine everywhere.
double share_of_uniform(const CaseRun& run);

// "Grid/Level[2]/Box/resolution=[nx,ny,nz]", levels from 1.
std::string level_resolution(int level, int nx, int ny = 1, int nz = 1);
// No finer levels, however the deck makes them.
std::string one_level();
std::string dilation(int cells);
std::string threshold(int variable, double value);

}  // namespace sluice::verification
