// The exact solution that a deck names, and the error of an archived state against it.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "exact/base/error_norms.hpp"
#include "exact/base/exact_solution.hpp"
#include "framework/archive/archive.hpp"
#include "framework/deck/deck.hpp"

namespace sluice {

struct DeckReference {
  std::unique_ptr<exact::ExactSolution> solution;
  double specific_heat = 1;  // of the first ICE material, J/(kg K), for temperatures
};

// Nothing when the deck has no <Meta><exact_solution>; InputError when it makes no sense.
std::optional<DeckReference> reference_of_deck(const DeckNode& root);

// l1, l2, linf, relative_l1: what studies and cases may name, and that one of them.
const std::vector<std::string>& norm_names();
double in_norm(const exact::ErrorNorms& norms, const std::string& name);

// Does a cell of this level lie under the next finer one.
bool covered(const Grid& grid, std::size_t level, IntVec3 cell);

// The same of the deck that an archive keeps as input.xml.
std::optional<DeckReference> reference_of_archive(const Archive& archive);

// Error norms of a cell variable of a material (component 0, 1, 2 of a vector) from the mean of the
// exact solution over each cell (exact/base/cell_mean.hpp), each place counted once, on the finest
// level there. The means are integrated until the norms are known to .1 %. Where the exact solution
// has several materials, density and velocity are those of the mixture of all, whatever `material`
// says; vol_frac_CC is that of `material`. `offset`: see error_norms().
exact::ErrorNorms archive_error(const ArchiveStep& step, const DeckReference& reference,
                                const std::string& variable, int component, int material,
                                double offset = 0);

// One value of a cell variable: where no finer level lies over the cell.
struct CellValue {
  double value;
  Vec3 centre, spacing;            // m
  std::array<bool, 3> directions;  // those that are dimensions of the run
};
std::vector<CellValue> uncovered_values(const ArchiveStep& step, const std::string& variable,
                                        int component, int material);

// The same against a smooth function of place, by its mean over each cell (Gauss's rule with 4
// points along each direction), of cells whose centres lie in the box `within`.
exact::ErrorNorms archive_error(const ArchiveStep& step, const std::function<double(Vec3)>& exact,
                                const std::string& variable, int component, int material,
                                const std::optional<std::pair<Vec3, Vec3>>& within = {},
                                double offset = 0);

// Distances of the particles of a material from where a motion has them, by volume; relative_l1:
// over their mean distance from the origin. The step holds p.x and p.displacement (and p.volume,
// else all count alike).
exact::ErrorNorms place_error(const ArchiveStep& step, const DeckReference& reference,
                              int material);

// The same against another state of the same scene, on one level: its mean over each cell. Throws
// InputError where its cells do not divide those of `step`, or its time is another.
exact::ErrorNorms archive_error(const ArchiveStep& step, const ArchiveStep& reference,
                                const std::string& variable, int component, int material,
                                double offset = 0);

}  // namespace sluice
