#include "peridynamics/deck/read_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/deck/faults.hpp"
#include "framework/run/component/plain_component.hpp"
#include "framework/scene/deck_values.hpp"
#include "framework/scene/geometry_reader.hpp"
#include "mpm/deck/readers.hpp"
#include "peridynamics/deck/schema.hpp"

namespace sluice::peridynamics {
namespace {

Influence influence_of(const std::string& word) {
  return word == "one"       ? Influence::one
         : word == "inverse" ? Influence::inverse
                             : Influence::linear;
}

// d, h and the state along directions that are none of the run.
void read_dimensions(const DeckNode& block, const Level& level, PeriScene& s,
                     std::vector<Fault>& faults) {
  s.dimensions = level.active_count();
  s.thickness = 1;
  for (int d = 0; d < 3; ++d)
    if (!level.active[d]) s.thickness *= level.spacing[d];
  const DeckNode* plane = block.child("plane");
  s.plane = s.dimensions == 3 ? Plane::space : s.dimensions == 1 ? Plane::line : Plane::strain;
  if (plane == nullptr) return;
  if (s.dimensions != 2)
    add_error(faults, plane->where,
              fmt::format("<plane> is for two dimensions; this run has {}", s.dimensions),
              "remove it, or make the grid one cell thick between symmetric or periodic faces");
  else if (plane->text == "stress")
    s.plane = Plane::stress;
}

// k in as many dimensions as the run has, and mu, of Young's modulus and Poisson's ratio.
void set_moduli(double E, double nu, Plane plane, PeriMaterial& m) {
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
  m.shear = E / (2 * (1 + nu));
  m.bulk = plane == Plane::stress   ? E / (2 * (1 - nu))
           : plane == Plane::strain ? lambda + m.shear
           : plane == Plane::line   ? E
                                    : lambda + 2 * m.shear / 3;
}

void read_model(const DeckNode& node, const PeriScene& s, PeriMaterial& m,
                std::vector<Fault>& faults) {
  m.law = node.attribute("type") == "linear_elastic_bond" ? Law::pmb : Law::lps;
  if (m.law == Law::lps && s.plane == Plane::line)
    add_error(faults, node.where,
              "linear_elastic_state needs two or three dimensions; this run has one",
              "linear_elastic_bond, or a grid of more cells");
  if (m.law == Law::pmb) {
    const double nu = s.plane == Plane::stress ? 1.0 / 3 : 0.25;
    if (node.has("poisson_ratio") && std::fabs(node.real("poisson_ratio") - nu) > 1e-3)
      add_error(faults, node.need("poisson_ratio").where,
                fmt::format("<poisson_ratio> of linear_elastic_bond is {:.4g}, not {:g}: it has "
                            "one stiffness per bond",
                            nu, node.real("poisson_ratio")),
                "linear_elastic_state has any ratio");
    set_moduli(node.has("young_modulus") ? node.real("young_modulus")
                                         : 3 * (1 - 2 * nu) * node.real("bulk_modulus"),
               nu, s.plane, m);
    return;
  }
  double E = 0, nu = 0;
  if (node.has("young_modulus")) {
    E = node.real("young_modulus");
    nu = node.real("poisson_ratio");
  } else {
    const double K = node.real("bulk_modulus"), G = node.real("shear_modulus");
    E = 9 * K * G / (3 * K + G);
    nu = (3 * K - 2 * G) / (2 * (3 * K + G));
    if (s.plane == Plane::space) {
      m.bulk = K;
      m.shear = G;
    }
  }
  if (!(nu > -1 && nu < 0.5)) {
    add_error(faults, node.where,
              fmt::format("Poisson's ratio is {:g}; it must be above -1 and below 1/2", nu));
    return;
  }
  if (nu > 0.49)
    add_warning(faults, node.where,
                fmt::format("Poisson's ratio {:g}: the step is short, and nearly incompressible "
                            "bodies were not tested",
                            nu));
  if (m.bulk == 0) set_moduli(E, nu, s.plane, m);
}

void read_damage(const DeckNode& node, const GeometryReader& geometry, const PeriScene& s,
                 PeriMaterial& m, std::vector<Fault>& faults) {
  using Criterion = DamageModel::Criterion;
  const std::string type = node.attribute("type").value_or("none");
  m.damage.where = node.where;
  m.damage.criterion = type == "critical_stretch"          ? Criterion::stretch
                       : type == "spherical_strain_energy" ? Criterion::energy
                                                           : Criterion::none;
  m.damage.critical_stretch = real_or(node, "s0", 0);
  m.damage.fracture_energy = real_or(node, "G_Ic", 0);
  if (m.damage.critical_stretch >= 0.3)
    add_warning(faults, node.need("s0").where,
                fmt::format("<s0> {:g}: bonds break at 30 % and more", m.damage.critical_stretch));
  for (const DeckNode* piece : node.all("no_fail"))
    if (GeomObject object = geometry.object(*piece, faults); object.piece != nullptr)
      m.damage.no_fail.push_back(std::move(object.piece));
  if (m.damage.criterion != Criterion::none && m.damage.fracture_energy > 0 &&
      s.influence == Influence::one)
    add_warning(faults, node.where, "<influence> one: a crack needs about 1.6 times the given G_Ic",
                "linear keeps it");
}

PreCrack read_precrack(const DeckNode& node, const PeriScene& s, std::vector<Fault>& faults) {
  PreCrack c;
  c.where = node.where;
  if (const DeckNode* segment = node.child("segment")) {
    c.a = segment->vector("p1");
    c.b = segment->vector("p2");
    if (s.dimensions != 2)
      add_error(faults, segment->where, "<segment> cuts bodies in two dimensions only",
                "rectangle or disk");
  } else if (const DeckNode* rectangle = node.child("rectangle")) {
    c.shape = PreCrack::Shape::rectangle;
    c.a = rectangle->vector("corner");
    c.b = rectangle->vector("edge1");
    c.c = rectangle->vector("edge2");
    const Vec3 n = cross(c.b, c.c);
    if (!(dot(n, n) > 0))
      add_error(faults, rectangle->where, "<rectangle>: edge1 and edge2 are parallel");
  } else if (const DeckNode* disk = node.child("disk")) {
    c.shape = PreCrack::Shape::disk;
    c.a = disk->vector("centre");
    c.b = disk->vector("normal");
    c.radius = disk->real("radius");
    if (!(dot(c.b, c.b) > 0)) add_error(faults, disk->where, "<disk>: normal is zero");
  }
  return c;
}

// Sides with images: those that are symmetric for all.
void read_sides(const Scene& scene, PeriScene& s, std::vector<Fault>& faults) {
  for (const Side side : all_sides) {
    if (!scene.grid.levels.front().active[static_cast<std::size_t>(direction_of(side))]) continue;
    for (const BoundaryRegion& region : scene.boundary.side(side).regions)
      for (const Condition& c : region.conditions)
        if (c.kind == ConditionKind::symmetry) {
          if (std::find(s.mirrors.begin(), s.mirrors.end(), side) == s.mirrors.end())
            s.mirrors.push_back(side);
        } else {
          add_warning(faults, c.where,
                      fmt::format("condition of {} at side {} has no effect: sides of peridynamic "
                                  "solids are free, symmetric or periodic",
                                  c.variable, name_of(side)),
                      "remove it");
        }
  }
}

void read_materials(const DeckNode& root, const DeckNode& block, const Scene& scene,
                    const GeometryReader& geometry, PeriScene& s, std::vector<Fault>& faults) {
  const Level& level = scene.grid.levels.front();
  double edge = 0;
  for (int d = 0; d < 3; ++d) edge = std::max(edge, level.spacing[d]);
  const double by_cells = real_or(block, "num_cells_in_horizon", 3) * edge;
  for (const DeckNode* node : materials_of(root)) {
    PeriMaterial& m = s.materials.emplace_back();
    mpm::SolidMaterial& seeds = s.seeds.materials.emplace_back();
    m.name = seeds.name = node->attribute("name").value_or("");
    m.index = seeds.index = static_cast<int>(s.materials.size()) - 1;
    m.where = seeds.where = node->where;
    m.density = seeds.constants.density = node->real("density");
    m.horizon = real_or(*node, "horizon", by_cells);
    read_model(node->need("material_model"), s, m, faults);
    if (const DeckNode* damage = node->child("damage_model"))
      read_damage(*damage, geometry, s, m, faults);
    for (const DeckNode* object : node->all("geom_object"))
      seeds.objects.push_back(mpm::read_seed_object(*object, geometry, faults));
  }
}

}  // namespace

PeriScene read_peri_scene(const Deck& deck, const Scene& scene, std::vector<Fault>& faults) {
  PeriScene s;
  const DeckNode& root = *deck.root;
  need_one_level(scene, faults);
  const DeckNode* block = need_block(deck, scene, "Peridynamics", faults);
  if (block == nullptr || any_error(faults)) return s;
  const GeometryReader geometry(root, faults);
  read_dimensions(*block, scene.grid.levels.front(), s, faults);
  s.influence = influence_of(text_or(*block, "influence", "linear"));
  s.partial_volume = text_or(*block, "partial_volume", "ramp") == "none" ? PartialVolume::none
                                                                         : PartialVolume::ramp;
  s.surface_weights = text_or(*block, "surface_weights", "volume") == "none"
                          ? SurfaceWeights::none
                          : SurfaceWeights::volume;
  s.all_bonded = text_or(*block, "family_search", "same_material") == "all";
  s.breaks_before_force = text_or(*block, "damage_order", "after_force") == "before_force";
  s.damping = real_or(*block, "damping", 0);
  s.gravity = vector_or(*block, "gravity", scene.constants.gravity);
  s.gravity_where =
      block->has("gravity") ? block->need("gravity").where : scene.constants.gravity_where;
  if (text_or(*block, "time_integrator", "") == "forward_euler")
    add_warning(faults, block->need("time_integrator").where,
                "<time_integrator> forward_euler is unstable at any step; velocity_verlet runs");
  if (block->has("interpolator"))
    add_warning(faults, block->need("interpolator").where,
                "<interpolator> has no effect: nothing is interpolated", "remove it");
  read_sides(scene, s, faults);
  read_materials(root, *block, scene, geometry, s, faults);
  for (const DeckNode* properties : root.all("MaterialProperties"))
    if (const DeckNode* solids = properties->child("Peridynamics"))
      for (const DeckNode* crack : solids->all("precrack"))
        s.precracks.push_back(read_precrack(*crack, s, faults));
  return s;
}

}  // namespace sluice::peridynamics
