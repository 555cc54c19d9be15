// Boundary conditions as plain data: per side of the domain regions, per region what holds for
// which variable of which material.
//
// Region 0 of a side is the whole side minus the union of its shapes; shapes follow in deck order.
// A boundary cell belongs to the first shape that contains the centre of its boundary face
// (comparisons inclusive; annulus and rectangulus: outside the inner, inside or on the outer).
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/grid/level.hpp"
#include "framework/grid/side.hpp"
#include "framework/scene/grid_settings.hpp"

namespace sluice {

enum class ConditionKind {
  dirichlet,             // boundary value = value
  neumann,               // gradient along the inward normal = value
  symmetry,              // mirror: normal velocity zero, everything else even
  free_slip_wall,        // velocity only
  compute_from_density,  // specific volume only
  open_face,             // waves leave; its value has no meaning
  other                  // kinds of a component: kind_name says which
};

struct Condition {
  ConditionKind kind = ConditionKind::neumann;
  std::string kind_name;  // as the deck writes it
  std::string variable;   // Pressure, Density, Temperature, Velocity, SpecificVol, Symmetric, ...
  int material = -1;      // -1: all
  bool has_value = false;
  // In the SI unit of the variable; neumann: per m.
  double value = 0;  // scalars; of a vector: unused
  Vec3 vector{};     // of a scalar: the scalar in every component
  bool is_vector = false;
  std::string text;  // the value when it is neither
  Location where;

  bool zero_gradient() const {
    return kind == ConditionKind::neumann && (is_vector ? vector == Vec3{} : value == 0);
  }
};

// Points and lengths in m.
struct RegionShape {
  enum class Kind { side, circle, annulus, ellipse, rectangle, rectangulus };
  Kind kind = Kind::side;
  Vec3 origin{};
  double radius = 0, inner_radius = 0;                  // circle; annulus (radius: outer)
  double major_radius = 0, minor_radius = 0;            // ellipse
  double angle = 0;                                     // ellipse, degrees
  Vec3 lower{}, upper{}, inner_lower{}, inner_upper{};  // rectangle, rectangulus (lower: outer)

  // `normal`: direction of the side; only the two other components of p count.
  bool contains(int normal, Vec3 p) const;
};

struct BoundaryRegion {
  std::string name;  // attribute name, or "side x-", "circle x-", ...
  RegionShape shape;
  std::vector<Condition> conditions;  // deck order
  Location where;

  // What holds for a variable of a material: an entry for the material beats one for all, the
  // first listed wins; where the variable is not named, a Symmetric entry stands for it.
  const Condition* find(std::string_view variable, int material) const;
};

struct BoundarySide {
  bool periodic = false;
  std::vector<BoundaryRegion> regions;  // empty on a periodic side
};

struct BoundaryConditions {
  std::array<BoundarySide, 6> sides;

  const BoundarySide& side(Side s) const { return sides[index_of(s)]; }
};

// A variable that needs a condition on every boundary face, for each of these materials.
struct BoundaryNeed {
  std::string variable;
  std::vector<int> materials;
};

// `node` is <BoundaryConditions>, or nullptr when the deck has none.
BoundaryConditions read_boundary_conditions(const DeckNode* node, const GridSettings& grid,
                                            int materials, const std::vector<BoundaryNeed>& needs,
                                            std::vector<Fault>& faults);

// Region number of every boundary cell of one side of a level.
class RegionMap {
 public:
  RegionMap(const BoundarySide& conditions, Side side, const Level& level);

  // Transverse cell indices in rising order of direction: (j,k), (i,k) or (i,j).
  int region(int a, int b) const {
    return uniform_ ? 0 : regions_[a - lower_a_ + (b - lower_b_) * size_a_];
  }
  bool uniform() const { return uniform_; }  // region 0 everywhere
  // How many boundary cells of the domain belong to each region.
  const std::vector<std::int64_t>& counts() const { return counts_; }

 private:
  bool uniform_ = true;
  int lower_a_ = 0, lower_b_ = 0;
  std::size_t size_a_ = 0;
  std::vector<std::uint8_t> regions_;
  std::vector<std::int64_t> counts_;
};

}  // namespace sluice
