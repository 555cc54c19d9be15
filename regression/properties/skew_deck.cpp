// Writing the decks.
#include "properties/skew_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sluice::properties {
namespace {

constexpr double thickness = 0.0625;  // of a domain along an inactive direction

std::string text(Vec3 v) {
  return fmt::format("[{},{},{}]", v.x, v.y, v.z);
}

// Two corners, put in order again after a mirror.
std::string corners(const char* low, const char* high, Vec3 a, Vec3 b, const Orientation& o) {
  const Vec3 p = o.turn(a), q = o.turn(b);
  Vec3 least, most;
  for (int d = 0; d < 3; ++d) {
    least[d] = std::min(p[d], q[d]);
    most[d] = std::max(p[d], q[d]);
  }
  return fmt::format("<{0}>{1}</{0}> <{2}>{3}</{2}>\n", low, text(least), high, text(most));
}

std::string condition(const char* label, const char* kind, const std::string& value) {
  return fmt::format(
      "    <BCType id=\"all\" label=\"{}\" var=\"{}\"> <value>{}</value> </BCType>\n", label, kind,
      value);
}

Vec3 along_wall(int normal) {
  Vec3 u = {0.3, -0.2, 0.15};
  u[normal] = 0;
  return u;
}

// Conditions of one side whose normal is axis `normal` of the case.
std::string conditions(SideKind kind, int normal, bool plus, bool heated, const Orientation& o) {
  if (kind == SideKind::symmetry)
    return "    <BCType id=\"all\" label=\"Symmetric\" var=\"symmetry\"/>\n";
  if (kind == SideKind::waves) {
    std::string all = condition("Velocity", "LODI", "[0,0,0]");
    for (const char* label : {"Pressure", "Density", "Temperature"})
      all += condition(label, "LODI", "0");
    return all;
  }
  std::string all = condition("Pressure", "Neumann", "0");
  const bool inflow = kind == SideKind::inflow;
  all += condition("Density", inflow ? "Dirichlet" : "Neumann", inflow ? "1.25" : "0");
  const bool warm = heated && (kind == SideKind::wall || kind == SideKind::moving_wall);
  if (kind == SideKind::slip)
    return all + condition("Temperature", "slip", "1.4") +
           condition("Velocity", "creep", text(o.turn(along_wall(normal))));
  all += condition("Temperature", inflow || warm ? "Dirichlet" : "Neumann",
                   inflow ? "0.9"
                   : warm ? "1.4"
                          : "0");
  if (kind == SideKind::open) return all + condition("Velocity", "Neumann", "[0,0,0]");
  Vec3 u{};
  if (kind == SideKind::moving_wall) u = along_wall(normal);
  if (inflow) u[normal] = plus ? -0.25 : 0.25;
  return all + condition("Velocity", "Dirichlet", text(o.turn(u)));
}

std::string boundary(const SkewCase& c, const Orientation& o) {
  std::string faces;
  for (int d = 0; d < 3; ++d)
    for (const bool plus : {false, true}) {
      const int normal = o.shows[static_cast<std::size_t>(d)];
      const bool there = plus != o.mirrored[static_cast<std::size_t>(d)];
      const SideKind kind = c.sides[static_cast<std::size_t>(2 * normal + (there ? 1 : 0))];
      if (kind == SideKind::periodic) continue;
      faces += fmt::format("  <Face side=\"{}{}\">\n{}  </Face>\n", "xyz"[d], plus ? '+' : '-',
                           conditions(kind, normal, there, c.conductivity > 0, o));
    }
  const std::string far =
      fmt::format(" <rho_infinity>1</rho_infinity>\n<vel_infinity>{}</vel_infinity>",
                  text(o.turn({0.1, -0.2, 0.3})));
  const std::string waves =
      fmt::format("<LODI> <press_infinity>0.4</press_infinity>{} </LODI>\n", c.far_flow ? far : "");
  const std::string slip =
      "<microSlip> <alpha_momentum>0.8</alpha_momentum> <alpha_temperature>1</alpha_temperature>\n"
      "<SlipModel type=\"SecondOrder_Deissler\"/> </microSlip>\n";
  return "<BoundaryConditions>\n" + (c.has(SideKind::waves) ? waves : "") +
         (c.has(SideKind::slip) ? slip : "") + faces + "</BoundaryConditions>\n";
}

// One box of a level. Cells of the whole domain would be `cells`; no part of a cell is cut.
std::string box(const std::string& label, Vec3 low, Vec3 high, IntVec3 cells, const SkewCase& c,
                const Orientation& o) {
  IntVec3 n;
  Vec3 extra;
  for (int d = 0; d < 3; ++d) {
    if (c.cells[d] == 1) {
      low[d] = -thickness / 2;
      high[d] = thickness / 2;
    }
    n[d] = c.cells[d] == 1 ? 1 : static_cast<int>(std::lround(cells[d] * (high[d] - low[d]) / 2));
    extra[d] = c.sides[static_cast<std::size_t>(2 * d)] == SideKind::periodic ? 0 : 1;
  }
  n = o.turn_extents(n);
  return fmt::format("<Box label=\"{}\">\n", label) + corners("lower", "upper", low, high, o) +
         fmt::format(
             "<extraCells>{}</extraCells> <patches>[1,1,1]</patches>\n"
             "<resolution>[{},{},{}]</resolution> </Box>\n",
             text(o.turn_along(extra)), n.x, n.y, n.z);
}

std::string grid_levels(const SkewCase& c, const Orientation& o) {
  Vec3 periodic{};
  for (int d = 0; d < 3; ++d)
    periodic[d] = c.sides[static_cast<std::size_t>(2 * d)] == SideKind::periodic ? 1 : 0;
  const std::string end = "<periodic>" + text(o.turn_along(periodic)) + "</periodic> </Level>\n";
  std::string all =
      "<Level> " + box("domain", Vec3{-1, -1, -1}, Vec3{1, 1, 1}, c.cells, c, o) + end;
  for (std::size_t l = 0; l < c.levels.fixed.size(); ++l) {
    all += "<Level>\n";
    for (const auto& [low, high] : c.levels.fixed[l])
      all += box(fmt::format("fine {} {}", l, all.size()), low, high,
                 c.cells_of(static_cast<int>(l) + 1), c, o);
    all += end;
  }
  return all;
}

// A box of the case.
std::string piece(const SkewCase& c, const Orientation& o, const char* label, Vec3 low, Vec3 high) {
  for (int d = 0; d < 3; ++d) {
    if (c.cells[d] > 1) continue;
    low[d] = -1;
    high[d] = 1;
  }
  return fmt::format("<box label=\"{}\"> {} </box>", label, corners("min", "max", low, high, o));
}

// Density, temperature and velocity in a piece.
std::string object(const SkewCase& c, const Orientation& o, const std::string& shape,
                   double density, double temperature, Vec3 velocity) {
  Vec3 u = velocity;
  for (int d = 0; d < 3; ++d)
    if (c.cells[d] == 1 && !c.cross_flow) u[d] = 0;
  // gamma - 1 = 0.4, cv = 1
  return fmt::format("<geom_object> {} <res>[2,2,2]</res>\n", shape) +
         fmt::format(
             "<velocity>{}</velocity> <density>{}</density> <pressure>{}</pressure>\n"
             "<temperature>{}</temperature> </geom_object>\n",
             text(o.turn(u)), density, 0.4 * density * temperature, temperature);
}

std::string material(const SkewCase& c, const char* name, const std::string& eos, double gamma,
                     const std::string& objects) {
  return fmt::format(
      "<material name=\"{}\">{}\n"
      "<dynamic_viscosity>{}</dynamic_viscosity><thermal_conductivity>{}</thermal_conductivity>\n"
      "<specific_heat>1</specific_heat><gamma>{}</gamma>\n{}</material>\n",
      name, eos, c.viscosity, c.conductivity, gamma, objects);
}

// A gas with a dense and a thin part; the dense one may be of the second material.
std::string materials(const SkewCase& c, const Orientation& o) {
  constexpr Vec3 wind = {0.1, -0.2, 0.3}, dense_wind = {0.5, 0.4, -0.3};
  const std::string everywhere = piece(c, o, "everywhere", {-2, -2, -2}, {2, 2, 2});
  const std::string dense = piece(c, o, "dense", {-0.6, -0.3, -0.7}, {0.2, 0.5, 0.1});
  const std::string thin = piece(c, o, "thin", {0.3, -0.8, 0.2}, {0.7, -0.1, 0.9});
  const std::string thin_gas = object(c, o, thin, 0.2, 1.5, {-0.7, 0.2, 0.6});
  const char* const ideal = "<EOS type=\"ideal_gas\"/>";
  if (c.materials() == 1)
    return material(
        c, "gas", ideal, 1.4,
        object(c, o, everywhere, 1, 1, wind) + object(c, o, dense, 4, 2, dense_wind) + thin_gas);
  const std::string around =
      "<difference>" + everywhere + "<union>" + dense + thin + "</union></difference>";
  return material(c, "gas", ideal, 1.4, object(c, o, around, 1, 1, wind) + thin_gas) +
         material(c, "second", c.second.eos, c.second.gamma,
                  object(c, o, dense, 4, c.second.temperature, dense_wind));
}

std::string exchange(const SkewCase& c) {
  if (c.materials() == 1) return {};
  return fmt::format(
      "<exchange_properties><exchange_coefficients><momentum>[{}]</momentum><heat>[{}]</heat>\n"
      "</exchange_coefficients>{}</exchange_properties>\n",
      c.second.drag, c.second.heat, c.second.exchange);
}

std::string list(const std::vector<IntVec3>& entries, const SkewCase& c, const Orientation& o) {
  std::string all;
  for (IntVec3 e : entries) {
    for (int d = 0; d < 3; ++d)
      if (c.cells[d] == 1) e[d] = 1;
    e = o.turn_extents(e);
    all += fmt::format("{}[{},{},{}]", all.empty() ? "" : ",", e.x, e.y, e.z);
  }
  return "[" + all + "]";
}

std::string triple(const char* tag, IntVec3 v, const Orientation& o) {
  v = o.turn_extents(v);
  return fmt::format("<{0}>[{1},{2},{3}]</{0}>\n", tag, v.x, v.y, v.z);
}

std::string refinement(const SkewCase& c, const Orientation& o) {
  const SkewLevels& l = c.levels;
  if (l.most == 1) return {};
  if (!l.fixed.empty())
    return fmt::format(
        "<AMR type=\"StaticGridML\"><useLockStep>{}</useLockStep><ICE>\n"
        "<orderOfInterpolation>{}</orderOfInterpolation></ICE></AMR>\n",
        l.lock_step, l.order);
  return fmt::format(
             "<AMR><useLockStep>{}</useLockStep><ICE>\n"
             "<orderOfInterpolation>{}</orderOfInterpolation>\n"
             "<Refinement_Criteria_Thresholds>\n"
             "<Variable name=\"rho_CC\" value=\"{}\" matl=\"0\"/>\n"
             "<Variable name=\"press_CC\" value=\"{}\" matl=\"0\"/>\n"
             "</Refinement_Criteria_Thresholds></ICE>\n"
             "<Regridder type=\"Tiled\"><max_levels>{}</max_levels>\n"
             "<cell_refinement_ratio>{}</cell_refinement_ratio>\n"
             "<min_patch_size>{}</min_patch_size>\n"
             "<max_timestep_interval>{}</max_timestep_interval>\n",
             l.lock_step, l.order, l.threshold, l.threshold, l.most, list(l.ratios, c, o),
             list(l.tiles, c, o), l.interval) +
         triple("cell_stability_dilation", l.stability, o) +
         triple("cell_regrid_dilation", l.regrid, o) +
         triple("cell_deletion_dilation", l.deletion, o) +
         triple("min_boundary_cells", l.margin, o) + "</Regridder></AMR>\n";
}

}  // namespace

IntVec3 SkewLevels::ratio(int level) const {
  return ratios[std::min(static_cast<std::size_t>(level), ratios.size()) - 1];
}

IntVec3 SkewCase::cells_of(int level) const {
  IntVec3 n = cells;
  for (int l = 1; l <= level; ++l)
    for (int d = 0; d < 3; ++d)
      if (cells[d] > 1) n[d] *= levels.ratio(l)[d];
  return n;
}

Vec3 Orientation::turn(Vec3 v) const {
  Vec3 r;
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(d);
    r[d] = mirrored[n] ? 0.0 - v[shows[n]] : v[shows[n]];
  }
  return r;
}

Vec3 Orientation::turn_along(Vec3 v) const {
  return {v[shows[0]], v[shows[1]], v[shows[2]]};
}

IntVec3 Orientation::turn_extents(IntVec3 cells) const {
  return {cells[shows[0]], cells[shows[1]], cells[shows[2]]};
}

IntVec3 Orientation::turn_cell(IntVec3 cell, IntVec3 cells) const {
  IntVec3 r;
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(d);
    r[d] = mirrored[n] ? cells[shows[n]] - 1 - cell[shows[n]] : cell[shows[n]];
  }
  return r;
}

std::string skew_deck(const SkewCase& c, const Orientation& o, int step_count) {
  std::string deck =
      "<Uintah_specification>\n<Meta><title>skew</title></Meta>\n"
      "<SimulationComponent type=\"ice\"/>\n";
  deck += fmt::format(
      "<Time><maxTime>10</maxTime><initTime>0</initTime><delt_min>0</delt_min>\n"
      "<delt_max>1</delt_max><timestep_multiplier>1</timestep_multiplier>\n"
      "<max_Timesteps>{}</max_Timesteps></Time>\n",
      step_count);
  deck += "<Grid>\n" + boundary(c, o) + grid_levels(c, o) + "</Grid>\n" + refinement(c, o);
  deck += fmt::format(
      "<DataArchiver><filebase>skew.uda</filebase>\n"
      "<outputTimestepInterval>{}</outputTimestepInterval>\n"
      "<outputLastTimestep>true</outputLastTimestep>\n"
      "<save label=\"rho_CC\"/><save label=\"temp_CC\"/><save label=\"vel_CC\"/>{}\n"
      "</DataArchiver>\n",
      step_count, c.materials() > 1 ? "<save label=\"vol_frac_CC\"/>" : "");
  std::string eddies;
  if (!c.turbulence.empty())
    eddies =
        fmt::format("<turbulence model=\"{}\">{}</turbulence>", c.turbulence,
                    c.turbulence == "Smagorinsky" ? "<model_constant>0.2</model_constant>" : "");
  deck += fmt::format(
      "<CFD><cfl>0.4</cfl><ICE><scheme>{}</scheme><advection type=\"{}\"/>{}</ICE></CFD>\n",
      c.internal_energy_form ? "classic" : "conservative",
      c.second_order ? "SecondOrder" : "FirstOrder", eddies);
  deck += fmt::format(
      "<PhysicalConstants><gravity>{}</gravity>\n"
      "<reference_pressure>1</reference_pressure></PhysicalConstants>\n",
      text(o.turn(c.gravity)));
  deck += "<MaterialProperties><ICE>" + materials(c, o) + "</ICE>\n" + exchange(c);
  return deck + "</MaterialProperties>\n</Uintah_specification>\n";
}

}  // namespace sluice::properties
