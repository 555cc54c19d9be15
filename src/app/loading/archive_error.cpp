#include "app/loading/archive_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "exact/base/cell_mean.hpp"
#include "exact/exact_solutions.hpp"
#include "framework/base/error.hpp"

namespace sluice {

const std::vector<std::string>& norm_names() {
  static const std::vector<std::string> names = {"l1", "l2", "linf", "relative_l1"};
  return names;
}

double in_norm(const exact::ErrorNorms& norms, const std::string& name) {
  if (name == "l2") return norms.l2;
  if (name == "linf") return norms.linf;
  if (name == "relative_l1") return norms.relative_l1;
  return norms.l1;
}

bool covered(const Grid& grid, std::size_t level, IntVec3 cell) {
  if (level + 1 >= grid.levels.size()) return false;
  const Level& fine = grid.levels[level + 1];
  const IntVec3 low = cell * fine.ratio;
  for (const GridBox& box : fine.boxes) {
    if (box.cells.contains(low)) return true;
  }
  return false;
}

namespace {

struct CellRequest {
  const std::string& variable;
  int component, material, level;
};

// Of one material, in the order of for_each_cell.
std::vector<double> values_of(const ArchiveStep& step, const CellRequest& asked,
                              const IndexBox& cells) {
  const FieldInfo* field = step.find(asked.variable, asked.material, asked.level);
  if (!field || field->centring != Centring::cell || asked.component >= field->components()) {
    throw InputError(fmt::format(
        "{}: no cell variable '{}' with component {} of material {} on level {}; save it with "
        "<save label=\"{}\"/>",
        step.folder().string(), asked.variable, asked.component, asked.material, asked.level,
        asked.variable));
  }
  const DenseField values = step.read(*field, cells);
  std::vector<double> out;
  for_each_cell(cells, [&](IntVec3 c) { out.push_back(values.at(c, asked.component)); });
  return out;
}

// uncovered(cell, its number among values_of its box) of a level.
template <class F>
void for_uncovered(const Grid& grid, std::size_t level, const GridBox& box, F&& uncovered) {
  std::size_t n = 0;
  for_each_cell(box.cells, [&](IntVec3 c) {
    if (!covered(grid, level, c)) uncovered(c, n);
    ++n;
  });
}

// How many cells of a finer level lie along a cell.
IntVec3 cells_within(const Level& level, const Level& finer, const std::string& folder) {
  IntVec3 ratio;
  for (int d = 0; d < 3; ++d) {
    const double cells = level.spacing[d] / finer.spacing[d];
    ratio[d] = static_cast<int>(std::lround(cells));
    if (ratio[d] < 1 || std::fabs(cells - ratio[d]) > 1e-6 * cells)
      throw InputError(fmt::format(
          "{}: {:g} cells of the reference per cell of a run, along {}; a whole number is needed",
          folder, cells, "xyz"[d]));
  }
  return ratio;
}

// Of all materials together: the density is their sum, the velocity their mean by mass.
std::vector<double> mixture_values(const ArchiveStep& step, CellRequest asked,
                                   const IndexBox& cells) {
  if (asked.variable == "press_CC" || asked.variable == "vol_frac_CC")
    return values_of(step, asked, cells);
  const bool velocity = asked.variable == "vel_CC";
  if (!velocity && asked.variable != "rho_CC") {
    throw InputError(fmt::format(
        "a run of several materials has no exact '{}'; known are rho_CC, vel_CC (of the mixture), "
        "press_CC, vol_frac_CC",
        asked.variable));
  }
  std::vector<double> mass, sum;
  for (asked.material = 0;; ++asked.material) {
    if (asked.material > 0 && !step.find("rho_CC", asked.material, asked.level)) break;
    const auto rho = values_of(step, {"rho_CC", 0, asked.material, asked.level}, cells);
    const auto factor = velocity ? values_of(step, asked, cells) : std::vector<double>{};
    mass.resize(rho.size());
    sum.resize(rho.size());
    for (std::size_t n = 0; n < rho.size(); ++n) {
      mass[n] += rho[n];
      if (velocity && rho[n] > 0) sum[n] += rho[n] * factor[n];
    }
  }
  if (!velocity) return mass;
  for (std::size_t n = 0; n < sum.size(); ++n) sum[n] /= mass[n];
  return sum;
}

// Mean of a smooth function over a cell about x, along these directions.
double gauss_mean(const std::function<double(Vec3)>& f, Vec3 x, Vec3 spacing,
                  std::array<bool, 3> directions) {
  constexpr std::array<double, 4> place = {-0.86113631159405258, -0.33998104358485626,
                                           0.33998104358485626, 0.86113631159405258};
  constexpr std::array<double, 4> weight = {0.17392742256872693, 0.32607257743127307,
                                            0.32607257743127307, 0.17392742256872693};
  for (int d = 0; d < 3; ++d) {
    if (!directions[d]) continue;
    directions[d] = false;
    double sum = 0;
    for (std::size_t k = 0; k < place.size(); ++k) {
      Vec3 there = x;
      there[d] += 0.5 * place[k] * spacing[d];
      sum += weight[k] * gauss_mean(f, there, spacing, directions);
    }
    return sum;
  }
  return f(x);
}

struct Place {
  const Level* level;
  IntVec3 cell;
};

// Of the exact mean of a cell, so that the norms of the error are known to .1 %: a thousandth of
// the mean error (means of smooth cells are far better; measured on an explosion, the L1 norm is
// known to 4e-5), and no less than what round-off leaves of the values.
double tolerance_of(const exact::ErrorNorms& at_centres, const std::vector<double>& exact) {
  double largest = 0;
  for (const double value : exact) largest = std::max(largest, std::fabs(value));
  return std::max(1e-3 * at_centres.l1, 1e-12 * largest);
}

}  // namespace

std::optional<DeckReference> reference_of_deck(const DeckNode& root) {
  const DeckNode* node = root.find("Meta/exact_solution");
  if (!node) return std::nullopt;
  std::map<std::string, std::string> values;
  for (const auto& child : node->children) values[child->name] = child->text;
  DeckReference reference;
  try {
    reference.solution =
        exact::make_exact_solution({node->attribute("type").value_or(""), std::move(values)});
  } catch (const InputError& fault) {
    throw InputError(fmt::format("{}: {}", to_string(node->where), fault.what()));
  }
  if (const DeckNode* heat = root.find("MaterialProperties/ICE/material/specific_heat")) {
    reference.specific_heat = heat->as_real();
  }
  return reference;
}

std::optional<DeckReference> reference_of_archive(const Archive& archive) {
  const Deck deck = read_deck((archive.folder() / "input.xml").string());
  if (!deck.root) return std::nullopt;
  return reference_of_deck(*deck.root);
}

exact::ErrorNorms place_error(const ArchiveStep& step, const DeckReference& reference,
                              int material) {
  std::vector<double> off, far, volumes;
  for (int level = 0; level < static_cast<int>(step.grid().levels.size()); ++level) {
    const FieldInfo* place = step.find_particles("p.x", material, level);
    const FieldInfo* moved = step.find_particles("p.displacement", material, level);
    const FieldInfo* volume = step.find_particles("p.volume", material, level);
    if (place == nullptr || moved == nullptr) continue;
    const auto x = step.read_particles(*place), u = step.read_particles(*moved);
    for (std::size_t p = 0; p < x[0].size(); ++p) {
      const Vec3 now{x[0][p], x[1][p], x[2][p]};
      const Vec3 exact =
          reference.solution->place(now - Vec3{u[0][p], u[1][p], u[2][p]}, step.info().time);
      const Vec3 d = now - exact;
      far.push_back(std::sqrt(dot(exact, exact)));
      off.push_back(far.back() + std::sqrt(dot(d, d)));
    }
    if (volume == nullptr) continue;
    const auto V = step.read_particles(*volume);
    volumes.insert(volumes.end(), V[0].begin(), V[0].end());
  }
  if (off.empty())
    throw InputError(
        fmt::format("{}: errors of positions need p.x and p.displacement of material {}; save both",
                    step.folder().string(), material));
  return exact::error_norms(off, far, volumes);
}

exact::ErrorNorms archive_error(const ArchiveStep& step, const DeckReference& reference,
                                const std::string& variable, int component, int material,
                                double offset) {
  if (reference.solution->has_places()) {
    if (variable == "p.x") return place_error(step, reference, material);
    throw InputError(fmt::format("the exact solution is a motion: it gives p.x, not {}", variable));
  }
  const bool mixture = reference.solution->materials() > 1;
  const Grid& grid = step.grid();
  const exact::CellMean of_cell(*reference.solution, step.info().time,
                                {variable, component, material, reference.specific_heat});
  std::vector<Place> places;
  std::vector<double> computed, exact, volumes;
  for (std::size_t level = 0; level < grid.levels.size(); ++level) {
    for (const GridBox& box : grid.levels[level].boxes) {
      const CellRequest request{variable, component, material, static_cast<int>(level)};
      const std::vector<double> values =
          mixture ? mixture_values(step, request, box.cells) : values_of(step, request, box.cells);
      for_uncovered(grid, level, box, [&](IntVec3 c, std::size_t n) {
        places.push_back({&grid.levels[level], c});
        computed.push_back(values[n]);
        exact.push_back(of_cell.at(grid.levels[level].centre(c)));
        volumes.push_back(grid.levels[level].cell_volume());
      });
    }
  }
  if (grid.levels.size() == 1) volumes.clear();
  // The errors at the centres say how well the means must be known.
  const double tolerance = tolerance_of(exact::error_norms(computed, exact, volumes), exact);
  for (std::size_t n = 0; n < places.size(); ++n) {
    const Level& level = *places[n].level;
    const Vec3 middle = level.centre(places[n].cell), half = 0.5 * level.spacing;
    exact[n] = of_cell.over(middle - half, middle + half, level.active, tolerance);
  }
  return exact::error_norms(computed, exact, volumes, offset);
}

std::vector<CellValue> uncovered_values(const ArchiveStep& step, const std::string& variable,
                                        int component, int material) {
  std::vector<CellValue> out;
  const Grid& grid = step.grid();
  for (std::size_t l = 0; l < grid.levels.size(); ++l) {
    const Level& level = grid.levels[l];
    for (const GridBox& box : level.boxes) {
      const CellRequest request{variable, component, material, static_cast<int>(l)};
      const std::vector<double> values = values_of(step, request, box.cells);
      for_uncovered(grid, l, box, [&](IntVec3 c, std::size_t n) {
        if (std::isnan(values[n])) return;  // the material is not there
        out.push_back({values[n], level.centre(c), level.spacing, level.active});
      });
    }
  }
  return out;
}

exact::ErrorNorms archive_error(const ArchiveStep& step, const std::function<double(Vec3)>& exact,
                                const std::string& variable, int component, int material,
                                const std::optional<std::pair<Vec3, Vec3>>& within, double offset) {
  std::vector<double> computed, means, volumes;
  for (const CellValue& cell : uncovered_values(step, variable, component, material)) {
    const Vec3 x = cell.centre;
    bool inside = true;
    for (int d = 0; within && d < 3; ++d)
      inside = inside && x[d] >= within->first[d] && x[d] <= within->second[d];
    if (!inside) continue;
    computed.push_back(cell.value);
    means.push_back(gauss_mean(exact, x, cell.spacing, cell.directions));
    volumes.push_back(cell.spacing.x * cell.spacing.y * cell.spacing.z);
  }
  return exact::error_norms(computed, means, volumes, offset);
}

exact::ErrorNorms archive_error(const ArchiveStep& step, const ArchiveStep& reference,
                                const std::string& variable, int component, int material,
                                double offset) {
  const double time = step.info().time, late = reference.info().time;
  if (!(std::fabs(time - late) <= 1e-9 * std::fabs(late)))
    throw InputError(fmt::format(
        "{}: its last output is at time {:g}, that of a run at {:g}; give both the same maxTime",
        reference.folder().string(), late, time));
  const Level& finest = reference.grid().levels.front();
  const std::string folder = reference.folder().string();
  if (reference.grid().levels.size() > 1)
    throw InputError(folder + ": a reference has one level, this one has several");
  std::vector<double> computed, exact, volumes;
  const Grid& grid = step.grid();
  for (std::size_t l = 0; l < grid.levels.size(); ++l) {
    const Level& level = grid.levels[l];
    const IntVec3 ratio = cells_within(level, finest, folder);
    for (const GridBox& box : level.boxes) {
      const CellRequest request{variable, component, material, static_cast<int>(l)};
      const std::vector<double> values = values_of(step, request, box.cells);
      const IndexBox fine_box{box.cells.lower * ratio, box.cells.upper * ratio};
      const std::vector<double> fine =
          values_of(reference, {variable, component, material, 0}, fine_box);
      const IntVec3 size = fine_box.size();
      for_uncovered(grid, l, box, [&](IntVec3 c, std::size_t n) {
        const IntVec3 low = (c - box.cells.lower) * ratio;
        double sum = 0;
        for_each_cell({low, low + ratio},
                      [&](IntVec3 f) { sum += fine[f.x + size.x * (f.y + size.y * f.z)]; });
        computed.push_back(values[n]);
        exact.push_back(sum / (ratio.x * ratio.y * ratio.z));
        volumes.push_back(level.cell_volume());
      });
    }
  }
  if (grid.levels.size() == 1) volumes.clear();
  return exact::error_norms(computed, exact, volumes, offset);
}

}  // namespace sluice
