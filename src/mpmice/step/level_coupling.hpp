// The coupling on one level in D active directions.
#pragma once
#include <optional>

#include "framework/run/levels/level_solver.hpp"
#include "ice/closure/equilibrate.hpp"
#include "mpm/shape/axis.hpp"
#include "mpm/transfer/corner_volume.hpp"
#include "mpmice/burn/burned_sums.hpp"
#include "mpmice/burn/burning_cells.hpp"
#include "mpmice/burn/explosive_cells.hpp"
#include "mpmice/burn/exposed_area.hpp"
#include "mpmice/burn/vanished_faces.hpp"
#include "mpmice/step/cell_masks.hpp"
#include "mpmice/step/coupling.hpp"
#include "mpmice/step/coupling_books.hpp"
#include "mpmice/step/exact_lanes.hpp"
#include "mpmice/step/solid_sets.hpp"
#include "mpmice/step/surface_geometry.hpp"

namespace sluice::mpmice {

// The largest values of surfaces in a step: velocity (m/s), stress (Pa), 1/(rho c), 1/rho.
struct SurfaceScales {
  double velocity = 1, pressure = 1, compliance = 1, inverse_density = 1;
};
// Sums over surfaces in cells, by area; places where the fluid rubs on them.
template <int D>
struct SurfaceLanes {
  static constexpr int area = 0, pressure = 1, soft = 2, light = 3, velocity = 4,
                       place = velocity + D;
  static constexpr int count(bool rubs) { return rubs ? place + D : place; }
};

template <int D>
class LevelCoupling final : public Coupling {
 public:
  LevelCoupling(const Level& level, const ice::FluidPart& fluid, const mpm::Mpm& solids,
                std::shared_ptr<mpm::SolidLevels> step, std::vector<models::SolidBurn> burns,
                const BurnReductions& places);

  Verdict find_surfaces(const StageScope& scope) override;
  Verdict press_on_solids(const StageScope& scope) override;
  Verdict find_swept_volumes(const StageScope& scope) override;
  Verdict renew_pressures(const StageScope& scope) override;
  Verdict tell_pressures(const StageScope& scope) override;
  Verdict finish_cells(const StageScope& scope) override;
  Verdict keep_work_pressure(const StageScope& scope) override;
  Verdict limit_step(const StageScope& scope) override;
  Verdict remove_burned(const StageScope& scope) override;

 private:
  // From a rank's boxes cells are asked for: the pressure on walls in ghost layers of boxes (4) and
  // two layers of cells without fluid before them; states and amounts where the parts of own
  // particles lie and two layers before (both checked on ranks by every golden case).
  static constexpr int pressure_reach = 7, state_reach = 4, farthest_asked = pressure_reach + 1;

  void list_sets(const StageScope& scope);
  void share_blocks(const StageScope& scope);
  void mark_own_cells(const StageScope& scope);
  // Is it so on any rank. Collective.
  static bool on_any(const StageScope& scope, bool here);
  void find_all_faces(const StageScope& scope, bool moved);
  void add_cells_of_solids(double dt);
  void add_cells_kept_closed(const StageScope& scope);
  static void take_geometry(SolidInCells<D>& found, Column& theta, std::array<Column, D>& covered);
  void tell_kept_fractions(const StageScope& scope);
  void sum_over_surfaces(const StageScope& scope);
  void mean_over_surfaces();
  void keep_pockets();
  void close_cells_at_sides();
  bool stays_near() const;
  KeptArray<std::uint8_t> blocks_to_tell() const;
  bool sees_any(const CellBox<D>& part, const KeptArray<std::uint8_t>& told) const;
  SeenPlaces places_seen(const IndexBox& box, int along, const KeptArray<std::uint8_t>& told) const;
  Column velocity_at_faces(std::size_t n) const;
  void tell_fluid_states(const StageScope& scope, bool solved);
  void find_pressures(const StageScope& scope, bool solved);
  CellMask cells_beside_walls() const;
  void smooth_normals();
  double length_of_smooth(std::size_t i) const;
  double cells_along_normal(std::size_t i, double size) const;
  double most_cells_in_a_length() const;
  double highest_impedance() const;
  void find_light_walls(const StageScope& scope, const Column& rho, const Column& sound);
  void find_pressures_behind(const StageScope& scope);
  void press_on_walls(const Column& rho, const Column& sound, const std::array<Column, D>& u,
                      double dt);
  void rub_on_walls(const Column& rho, const Column& viscosity, const std::array<Column, D>& u,
                    double dt);
  struct BeforeSurface {
    std::size_t cell;
    double distance;
  };
  BeforeSurface before_surface(const Cell<D>& c, std::size_t i,
                               const std::array<double, D>& unit) const;
  void take_friction(const StageScope& scope);
  double most_impedance(std::size_t i, double size, double rho, double dt) const;
  double approach_at_surface(const Cell<D>& c, std::size_t i, double size,
                             const std::array<Column, D>& u, double du) const;
  double pressure_beside_wall(const Cell<D>& c, std::size_t i, double size) const;
  KeptArray<std::uint8_t> fill_dry(Column& values) const;
  double area_of(const Piece<D>& piece) const;
  Vec3 velocity_of(const SolidSet<D>& s, std::size_t face, const Piece<D>& piece) const;
  bool all_rigid() const;
  void add_forces_of_walls(std::size_t d, double dt, ExactSum& sum) const;
  void find_overlaps();
  void add_forces_on(const SolidSet<D>& s, std::vector<mpm::CornerForce>& forces) const;
  bool exchanges(int kind) const;
  // The largest velocities of a kind, up and down.
  std::array<Vec3, 2> bounds_of_velocities(int kind) const;
  void book_outside(const StageScope& scope);
  void book_surface_work(const StageScope& scope, const Column& moved);
  // Of all ranks: does a cell close with fluid in it, is one in no state; books and bounds.
  struct Agreed {
    bool stuck = false, spoilt = false;
  };
  Agreed agree(const StageScope& scope, bool good, const Column& moved);
  struct Rates {
    double deck = 0, flow = 0, sound = 0;
  };
  Rates rates_of_cells() const;
  void add_growth(ExactSum& work) const;
  double mass_of_heaviest() const;
  double fastest_way(double dt) const;
  void mean_over_cells(const StageScope& scope);
  CellMask cells_beside_fluid() const;
  void tell_fluid(const StageScope& scope);
  void gather(const StageScope& scope);
  void exchange(const StageScope& scope);
  struct FluidHeat {
    double temperature = 0, capacity = 0;
  };
  FluidHeat heat_of(std::size_t i) const;
  static void share_reason(const StageScope& scope);
  void refresh_amounts(const StageScope& scope);
  void share_small_cells();
  void tell_stuck(const StageScope& scope) const;
  // What burns (burning.cpp), of surfaces (burn_surfaces.cpp).
  void burn(const StageScope& scope);
  void begin_burning();
  class Forms;  // what a law of burning asks of the step
  bool burn_by(const StageScope& scope, const models::SolidBurn& burn);
  Column all_products() const;
  void keep_given_mass(const StageScope& scope, const std::vector<Column>& given) const;
  struct BurningPiece {
    std::size_t set, particle, cell;
  };
  std::vector<ExposedArea<D>> exposed_areas(const models::SurfaceLaw& law, std::size_t n,
                                            std::vector<BurningPiece>* pieces) const;
  void delay_burning(const models::SurfaceDelay& law, SolidSet<D>& s,
                     const std::vector<ExposedArea<D>>& exposed, double dt, Column& shares) const;
  void burn_surfaces(const StageScope& scope, const models::SolidBurn& burn,
                     const models::SurfaceLaw& law, std::vector<Column>& shares);
  void mean_of_pieces(const StageScope& scope, const std::vector<BurningPiece>& pieces,
                      const Column& values, const CellSums<D>& counts, double most,
                      Column& mean) const;
  static double most_of(const StageScope& scope, const CellSums<D>& counts);
  double count_pieces(const StageScope& scope, const std::vector<BurningPiece>& pieces,
                      CellSums<D>& counts) const;
  void keep_in_cells(const StageScope& scope, Label kept, int solid, const Column& values) const;
  std::vector<BurningField> saved_fields(const StageScope& scope,
                                         const models::SolidBurn& burn) const;
  void store_burning(const StageScope& scope, const models::SolidBurn& burn,
                     const std::vector<BurningField>& fields,
                     const std::vector<BurningPiece>& pieces) const;
  void burn_particles(const models::SolidBurn& burn, const Column& in_cells,
                      std::vector<Column>& shares) const;
  void burn_cells(const StageScope& scope, const models::SolidBurn& burn,
                  const models::CellLaw& law, Column& shares);
  void mean_in_cells(const StageScope& scope, int kind, Column& mass, Column& pressure);
  double hottest_fluid(const Cell<D>& c, bool around) const;
  // Explosive (explosive.cpp), and flames that come to it (flames.cpp).
  bool burn_ddt(const StageScope& scope, const models::SolidBurn& burn, const models::Ddt1& law);
  ExplosiveCells look_at_explosive(const StageScope& scope, const models::SolidBurn& burn,
                                   const models::Ddt1& law);
  void find_hot_cells(const StageScope& scope, const models::SolidBurn& burn,
                      const models::Ddt1& law, ExplosiveCells& cells) const;
  void detonate(double dt, const models::SolidBurn& burn, const models::Ddt1& law,
                ExplosiveCells& cells) const;
  void burn_open_faces(const models::Ddt1& law, const ExplosiveCells& cells, std::size_t n,
                       double dt, Column& shares) const;
  void burn_cracks(const models::Ddt1& law, const ExplosiveCells& cells, std::size_t n, double dt,
                   Column& shares) const;
  void mark_burning_surfaces(const StageScope& scope, const std::vector<Column>& shares,
                             ExplosiveCells& cells) const;
  void pass_switches(const StageScope& scope, const models::Ddt1& law, const ExplosiveCells& cells);
  void store_explosive(const StageScope& scope, const models::SolidBurn& burn,
                       const models::Ddt1& law, const ExplosiveCells& cells,
                       const std::vector<Column>& of_surfaces,
                       const std::vector<Column>& of_cracks) const;
  void spread_flames(const models::Ddt1& law, const ExplosiveCells& cells, std::size_t n,
                     double dt);
  struct FlameWay {
    double length = 1e300;
    models::Ignition::Kind kind = models::Ignition::none;
  };
  FlameWay way_to(const models::Ddt1& law, const ExplosiveCells& cells, const Cell<D>& c,
                  const std::array<double, D>& normal, bool open, bool hot, bool cracked) const;
  void note_flames(const StageScope& scope);
  Cell<D> middle_of(const ParticleSet& set, std::size_t p) const;
  const double* crack_radii(const SolidSet<D>& s) const;
  // Given to cells (burn_products.cpp).
  // What a particle gives; energy (internal) and kinetic energy per mass.
  struct Given {
    std::size_t set, particle;
    double mass, energy, kinetic;
    Vec3 velocity{};
  };
  std::vector<Given> take_from_particles(int solid, int product, double heat_of_reaction,
                                         const std::vector<Column>& shares);
  double most_parts_given(const StageScope& scope, const std::vector<Given>& given) const;
  bool give_to_cells(const StageScope& scope, int product, const std::vector<Given>& given,
                     const Column& in_cells);
  void add_product(std::size_t i, int product, double mass, double energy, double kinetic,
                   const std::array<double, 3>& momentum);
  void expose_neighbours(const StageScope& scope);
  void note_burned(const StageScope& scope);
  void open_burned_volume(const StageScope& scope);
  // What tears (torn.cpp).
  bool is_drawn_out(const CornerColumns<D>& x, std::size_t p) const;
  bool tears(const mpm::CornerVolume<D>& v) const;
  bool leaves(const SolidSet<D>& s, std::size_t p) const;
  Periods<D> periods() const;
  void part_torn(const StageScope& scope);
  void tell_torn(const StageScope& scope, const SolidSet<D>& s, std::size_t p) const;
  void become_block(const SolidSet<D>& s, std::size_t p, const mpm::CornerVolume<D>& v) const;
  bool settle(const StageScope& scope);
  bool share_spoilt(const StageScope& scope);
  bool settle_cell(std::size_t i, const ice::mixture::Equilibration& laws, double* M, double* V,
                   double* E) const;
  void settle_scalars(std::size_t i);
  void fill_dry_cells();
  void store(const StageScope& scope);

  bool wet(std::size_t i) const { return fields_.theta[i] < 1; }
  bool has_solid(std::size_t i) const { return fields_.theta[i] > 0 || fields_.theta_next[i] > 0; }
  // act(place): of the cells of the domain beside one; up to so many cells around it.
  template <class F>
  void for_each_neighbour(const Cell<D>& c, F&& act) const;
  template <class F>
  void for_each_around(const Cell<D>& c, int reach, F&& act) const;
  // act(place, cells from c, by direction): likewise.
  template <class F>
  void for_each_offset(const Cell<D>& c, int reach, F&& act) const;
  // act(particle, face, area vector (outward), cell, its place): of the outer faces, as they are at
  // the start of the step, the pieces that look into cells with fluid.
  template <class F>
  void for_each_open_piece(const SolidSet<D>& s, F&& act) const;
  // act(cell, place in the arrays) for the cells of the domain near solids.
  template <class F>
  void for_each_cell_near(F&& act) const {
    frame_.cells.for_each_cell(frame_.domain, act);
  }
  // The same for those that lie at most so many cells from this rank's boxes.
  template <class F>
  void for_each_cell_within(int reach, F&& act) const {
    for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
      if (distance_.empty() || distance_[i] <= reach) act(c, i);
    });
  }
  // The same for those of this rank.
  template <class F>
  void for_each_own_cell(F&& act) const {
    for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
      if (own_[i] != 0) act(c, i);
    });
  }

  Frame<D> frame_;
  std::unique_ptr<BlockSharers<D>> sharers_;  // null: this is the only rank
  CellMask own_;                              // 1: cells of this rank's boxes
  // Of each cell from these, up to farthest_asked; 255: farther. Empty: this is the only rank.
  CellMask distance_;
  std::array<mpm::Axis, D> axes_;  // of the corners
  OccupiedCells<D> occupied_;      // cells in which solids lie, or gaps that they keep
  const ice::FluidPart* fluid_;
  const mpm::Mpm* solids_;
  std::shared_ptr<mpm::SolidLevels> step_;
  double shock_slope_ = 1, reference_pressure_ = 0;
  std::vector<SolidSet<D>> sets_;
  SolidFields<D> fields_;
  std::vector<models::SolidBurn> burns_;
  BurnReductions places_;  // among the sums of the step
  BurnedSums burned_;
  std::size_t next_switch_ = 0;   // among those of the step
  std::vector<Column> products_;  // by fluid: mass per cell volume that burning has made
  // On corners of outer faces, by level and kind of solid.
  std::vector<std::vector<std::vector<mpm::CornerForce>>> corner_forces_;
  bool overlap_ = false;   // do bodies overlap somewhere
  bool vanished_ = false;  // has a particle burned to its end in this step
  SurfaceGeometry<D> geometry_;
  KnownByOne<D> known_, kept_;  // kept_: theta that the last step left
  CellSums<D> means_;           // over surfaces, lanes of SurfaceLanes
  SurfaceScales scales_;        // of its values
  bool may_be_light_ = false;   // may any wall be light in this step
  CouplingBooks books_;
  Rates rates_;                               // of all cells that solids touch
  std::optional<Cell<D>> stuck_;              // a cell of this rank that closes with fluid in it
  KeptArray<std::uint8_t> swept_with_solid_;  // 1: cells of which the sweep has left amounts
  CellAmounts<D> amounts_;
  CellAmounts<D> settled_;          // what becomes their state, per volume of fluid
  KeptArray<std::uint8_t> filled_;  // 1: they are known
  KeptArray<std::uint8_t> spoilt_;  // 1: what is left there is no state
};

template <int D>
template <class F>
void LevelCoupling<D>::for_each_neighbour(const Cell<D>& c, F&& act) const {
  for (std::size_t d = 0; d < D; ++d)
    for (const int side : {-1, 1}) {
      Cell<D> other = c;
      other[d] += side;
      if (!frame_.in_domain(other)) {
        if (!frame_.periodic[d]) continue;
        other = frame_.inside(other);
      }
      act(frame_.cells.index(other));
    }
}

template <int D>
template <class F>
void LevelCoupling<D>::for_each_around(const Cell<D>& c, int reach, F&& act) const {
  for_each_offset(c, reach, [&](std::size_t i, const std::array<int, D>&) { act(i); });
}

template <int D>
template <class F>
void LevelCoupling<D>::for_each_offset(const Cell<D>& c, int reach, F&& act) const {
  const int width = 2 * reach + 1;
  int count = 1;
  for (int d = 0; d < D; ++d) count *= width;
  for (int n = 0; n < count; ++n) {
    Cell<D> other = c;
    std::array<int, D> offset{};
    for (int d = 0, rest = n; d < D; ++d, rest /= width) {
      offset[static_cast<std::size_t>(d)] = rest % width - reach;
      other[static_cast<std::size_t>(d)] += offset[static_cast<std::size_t>(d)];
    }
    bool there = true;
    for (std::size_t d = 0; d < D; ++d)
      there &= frame_.periodic[d] ||
               (other[d] >= frame_.domain.lower[d] && other[d] < frame_.domain.upper[d]);
    if (there) act(frame_.cells.index(frame_.inside(other)), offset);
  }
}

template <int D>
template <class F>
void LevelCoupling<D>::for_each_open_piece(const SolidSet<D>& s, F&& act) const {
  s.pieces.for_each(s.faces, [&](std::size_t i, int, const Piece<D>& piece) {
    const std::size_t p = s.faces.particle[i];
    if ((s.outer[p] >> s.faces.face[i] & 1) == 0 || !(s.filled[p] > 0)) return;
    Cell<D> c = piece.cell;
    for (std::size_t d = 0; d < D; ++d)
      if (!frame_.periodic[d] && (c[d] < frame_.domain.lower[d] || c[d] >= frame_.domain.upper[d]))
        return;  // on a side of the domain
    c = frame_.inside(c);
    const std::size_t k = frame_.cells.index(c);
    if (!wet(k)) return;
    std::array<double, D> area = piece.area;
    for (int d = 0; d < D; ++d) area[static_cast<std::size_t>(d)] *= frame_.face_area(d);
    act(p, s.faces.face[i], area, c, k);
  });
}

}  // namespace sluice::mpmice
