#include "mpm/start/load_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/deck/faults.hpp"
#include "framework/geometry/sampling.hpp"
#include "mpm/loads/load_curves.hpp"

namespace sluice::mpm {
namespace {

const char* tag_of(const LoadCurve& load) {
  switch (load.kind) {
    case LoadCurve::Kind::torque:
      return "torque";
    case LoadCurve::Kind::heat_flux:
      return "heat_flux";
    case LoadCurve::Kind::force:
      return "force";
    case LoadCurve::Kind::pressure:
      break;
  }
  return load.on_points ? "pressure_pts" : "pressure";
}

// Cells in which particles may feel a load: those of its piece, and one more to each side.
IndexBox cells_around(const GeometryPiece& piece, const Level& level) {
  const Bounds bounds = piece.bounds();
  const CellLattice lattice{level.anchor, level.spacing};
  const Vec3 lower = level.anchor + to_real(level.domain.lower) * level.spacing;
  const Vec3 upper = level.anchor + to_real(level.domain.upper) * level.spacing;
  IndexBox cells;
  for (int d = 0; d < 3; ++d) {
    const auto held = [&](double x) {
      Vec3 at = lower;
      at[d] = std::clamp(x, lower[d], upper[d]);
      return lattice.cell_of(at)[d];
    };
    cells.lower[d] = held(bounds.lower[d]) - 1;
    cells.upper[d] = held(bounds.upper[d]) + 2;
  }
  return intersection(cells, level.domain);
}

class LoadSearch {
 public:
  LoadSearch(const MpmScene& scene, const Grid& grid, const Seeder& seeder)
      : scene_(scene), grid_(grid), seeder_(seeder), loads_(scene) {}

  // Layer by layer of cells: most loads are met in the first of them.
  bool meets_any(std::size_t load) const {
    for (const Level& level : grid_.levels) {
      const IndexBox all = cells_around(*scene_.loads[load].piece, level);
      const int d = all.size().z > 1 ? 2 : 1;
      for (int layer = all.lower[d]; layer < all.upper[d]; ++layer) {
        IndexBox cells = all;
        cells.lower[d] = layer;
        cells.upper[d] = layer + 1;
        for (std::size_t m = 0; m < scene_.materials.size(); ++m)
          if (meets_in(load, static_cast<int>(m), level, cells)) return true;
      }
    }
    return false;
  }

 private:
  bool meets_in(std::size_t load, int material, const Level& level, const IndexBox& cells) const {
    SeededParticles p;
    seeder_.seed(material, level, cells, {}, p);
    for (std::size_t i = 0; i < p.count(); ++i) {
      Vec3 width{};
      for (int d = 0; d < 3; ++d) width[d] = std::fabs(p.edges[4 * d][i]) * level.spacing[d];
      const auto marks =
          loads_.marks_of(material, {p.x[i], p.y[i], p.z[i]}, width, p.surface[i] != 0, {});
      if (std::find(marks.begin(), marks.end(), static_cast<int>(load) + 1) != marks.end())
        return true;
    }
    return false;
  }

  const MpmScene& scene_;
  const Grid& grid_;
  const Seeder& seeder_;
  LoadCurves loads_;
};

// What acts along the direction of a box that is not thin acts on all surfaces inside of it.
void check_thinness(const MpmScene& scene, const LoadCurve& load, std::vector<Fault>& faults) {
  if (load.shape != "box" || load.kind == LoadCurve::Kind::force) return;
  const LoadSurface surface(load, scene.axisymmetric, scene.moves_along);
  if (!surface.is_bulky()) return;
  const Vec3 n = surface.direction({});
  const char along = n.x != 0 ? 'x' : n.y != 0 ? 'y' : 'z';
  const Bounds b = load.piece->bounds();
  const Vec3 size = b.upper - b.lower;
  add_warning(
      faults, load.where,
      fmt::format("<{}> acts along {}, the active direction in which its <box> of {:g} x {:g} x "
                  "{:g} is thinnest, but the box is not thin: it contains more than one surface",
                  tag_of(load), along, size.x, size.y, size.z),
      "write a thin <box> around the loaded surface");
}

}  // namespace

void check_loads(const MpmScene& scene, const Grid& grid, const Seeder& seeder,
                 std::vector<Fault>& faults) {
  const LoadSearch search(scene, grid, seeder);
  for (std::size_t n = 0; n < scene.loads.size(); ++n) {
    const LoadCurve& load = scene.loads[n];
    if (load.on_points || load.piece == nullptr) continue;
    check_thinness(scene, load, faults);
    try {
      if (search.meets_any(n)) continue;
    } catch (const std::length_error& error) {
      return add_error(
          faults, load.where, error.what(),
          fmt::format("write boxes that share no particle; {} may act on one", max_marks));
    }
    const bool by_force = load.kind == LoadCurve::Kind::force;
    add_warning(faults, load.where,
                fmt::format("<{}> acts on nothing: no particle{} is in its <{}>", tag_of(load),
                            by_force ? "" : " at the surface of a body", load.shape),
                by_force ? "move it to where a body is"
                         : "move it onto the surface of a body, or remove it");
  }
}

}  // namespace sluice::mpm
