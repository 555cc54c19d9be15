#include "ice/start/weight_profile.hpp"

#include <algorithm>

#include "framework/geometry/sampling.hpp"
#include "ice/start/initial_state_parts.hpp"
#include "ice/start/material_fill.hpp"

namespace sluice::ice {
namespace {

// So many cells along each direction of a layer are looked at: bodies are larger than what is
// between them.
constexpr int max_looked_at = 64;

int direction_of_weight(Vec3 g) {
  int found = -1;
  for (int d = 0; d < 3; ++d)
    if (g[d] != 0) found = found < 0 ? d : 3;
  return found == 3 ? -1 : found;
}

// Where to look at layer k of the coarsest level: the cell of which `marked` has most.
IntVec3 place_in_layer(const IceMaterial& marked, const Level& level, int d, int k) {
  IntVec3 from = level.domain.lower;
  from[d] = k;
  IntVec3 best = from;
  std::int32_t most = 0;
  const IntVec3 size = level.domain.size();
  IntVec3 stride{1, 1, 1};
  for (int e = 0; e < 3; ++e)
    if (e != d) stride[e] = (size[e] + max_looked_at - 1) / max_looked_at;
  const int a = d == 0 ? 1 : 0, b = d == 2 ? 1 : 2;
  for (int j = 0; j < size[b]; j += stride[b])
    for (int i = 0; i < size[a]; i += stride[a]) {
      IntVec3 c = from;
      c[a] += i;
      c[b] += j;
      std::int32_t inside = 0;
      for (const GeomObject& o : marked.objects) {
        const std::int32_t of_object = count_inside(o, level, {c, c + IntVec3::all(1)}).front();
        if (of_object > 0 && of_object == o.res.x * o.res.y * o.res.z) return c;  // all of it
        inside += of_object;
      }
      if (inside <= most) continue;
      most = inside;
      best = c;
    }
  return best;
}

// The cell of the level at height j, above or below a cell of the coarsest.
IntVec3 cell_at(const Level& coarsest, IntVec3 place, const Level& level, int d, int j) {
  if (level.index == coarsest.index) return place;
  IntVec3 c = CellLattice{level.anchor, level.spacing}.cell_of(coarsest.centre(place));
  for (int e = 0; e < 3; ++e)
    c[e] = std::clamp(c[e], level.domain.lower[e], level.domain.upper[e] - 1);
  c[d] = j;
  return c;
}

// The materials of one cell, whose densities may follow the pressure.
class WeighedCell {
 public:
  WeighedCell(const IceScene& scene, const PhysicalConstants& constants, MixtureFill& fill)
      : scene_(scene), fill_(fill) {
    for (std::size_t m = 0; m < fill.materials.size(); ++m) {
      const MaterialFill& part = fill.materials[m];
      keeps_.push_back(part.volume_fraction[0] == 0
                           ? Keeps::density
                           : what_is_kept(scene.materials[m], part.density[0], part.temperature[0],
                                          constants.reference_pressure));
    }
  }
  double density() const {
    double sum = 0;
    for (const MaterialFill& m : fill_.materials)
      if (m.volume_fraction[0] > 0) sum += m.volume_fraction[0] * m.density[0];
    return sum;
  }
  // The pressure that balance() gives for the density that it makes: each round is better by
  // g dx/c^2.
  template <class Balance>
  double settle(Balance&& balance) {
    constexpr int max_rounds = 100;
    double pressure = balance(density());
    for (int round = 0; round < max_rounds; ++round) {
      for (std::size_t m = 0; m < keeps_.size(); ++m)
        if (fill_.materials[m].volume_fraction[0] > 0)
          set_pressure(scene_.materials[m], keeps_[m], pressure, 0, fill_.materials[m]);
      const double next = balance(density());
      if (next == pressure) break;
      pressure = next;
    }
    return pressure;
  }

 private:
  const IceScene& scene_;
  MixtureFill& fill_;
  std::vector<Keeps> keeps_;
};

}  // namespace

WeightProfile weight_profile(const IceScene& scene, const PhysicalConstants& constants,
                             const Level& coarsest, const Level& level) {
  WeightProfile profile;
  if (!is_hydrostatic(scene, constants, level)) return profile;
  const Vec3 g = carried_gravity(constants, level);
  const int d = direction_of_weight(g);
  if (d < 0) return profile;
  profile.direction = d;
  profile.first = level.domain.lower[d];
  const double below_reference = depth_below_reference(g, coarsest, level);
  const CellLattice lattice{coarsest.anchor, coarsest.spacing};
  int layer = coarsest.domain.lower[d] - 1;
  IntVec3 place{};
  double p_below = 0, rho_below = 0;
  for (int j = level.domain.lower[d]; j < level.domain.upper[d]; ++j) {
    IntVec3 here = level.domain.lower;
    here[d] = j;
    const int k = level.index == coarsest.index
                      ? j
                      : std::clamp(lattice.cell_of(level.centre(here))[d], coarsest.domain.lower[d],
                                   coarsest.domain.upper[d] - 1);
    if (k != layer) place = place_in_layer(scene.surrounding(), coarsest, d, layer = k);
    const IntVec3 c = cell_at(coarsest, place, level, d, j);
    MixtureFill fill = fill_weightless(scene, constants, coarsest, level, {c, c + IntVec3::all(1)});
    WeighedCell cell(scene, constants, fill);
    p_below = cell.settle([&](double rho) {
      if (j == level.domain.lower[d]) return constants.reference_pressure + below_reference * rho;
      return p_below + 0.5 * g[d] * level.spacing[d] * (rho_below + rho);
    });
    rho_below = cell.density();
    profile.pressure.push_back(p_below);
  }
  return profile;
}

}  // namespace sluice::ice
