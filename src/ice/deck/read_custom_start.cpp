// The tags of customInitialization and what they mean.
#include <algorithm>
#include <cctype>

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/deck/custom_start.hpp"

namespace sluice::ice {
namespace {

TagSpec axis_tag() {
  return tag("axis", "axis of the vortex")
      .once()
      .words({"x", "y", "z"})
      .spelling("X", "x")
      .spelling("Y", "y")
      .spelling("Z", "z");
}

TagSpec direction_tag(const char* name, const char* meaning) {
  return tag(name, meaning).once().integer().at_least(0).at_most(2);
}

TagSpec length_tag(const char* name, const char* meaning) {
  return tag(name, meaning).once().real().above(0).unit("length");
}

std::vector<TagSpec> profile_tags() {
  return {
      tag("logLawProfile", "u = u*/k ln(h/z0), h the height above the floor of the domain")
          .with_children(
              {direction_tag("verticalDir", "direction of the height"),
               direction_tag("principalFlowDir", "direction of the flow"),
               tag("frictionVel", "friction velocity u*, its component along the flow")
                   .once()
                   .vector()
                   .unit("velocity"),
               length_tag("roughness", "height z0 where the velocity vanishes"),
               tag("vonKarmanConstant", "k").real().above(0).at_most(0.5).by_default("0.4")}),
      tag("powerLawProfile", "u = U min(h/H, 1)^n, h the height above the floor of the domain")
          .with_children({direction_tag("verticalDir", "direction of the height"),
                          length_tag("profileHeight", "height H of the profile"),
                          tag("U_infinity", "velocity above it").once().vector().unit("velocity"),
                          tag("exponent", "n").once().real().above(0)}),
      tag("powerLawProfile2",
          "turbulent channel: u = u*/0.4 ln(Re h/H), h to the nearer wall, "
          "u* = mu Re/(rho H)")
          .with_children(
              {tag("Re_tau", "Reynolds number of the friction velocity").once().real().above(0),
               direction_tag("verticalDir", "direction from wall to wall"),
               direction_tag("principalDir", "direction of the flow"),
               length_tag("halfChannelHeight", "half the height, H"),
               tag("channelFloor", "lower wall; absent: end of the domain").real().unit("length"),
               tag("channelCeiling", "upper wall; absent: end of the domain")
                   .real()
                   .unit("length")}),
      tag("DNS_Moser", "laminar channel: u = dp/dx h (h - H)/(2 mu) over the height of the domain")
          .with_children({direction_tag("verticalDir", "direction from wall to wall"),
                          tag("dpdx", "pressure gradient").once().real().unit("pressure/length")})};
}

int axis_of(const DeckNode& node) {
  const std::string text = text_or(node, "axis", "z");
  return text.empty() ? 2 : std::tolower(static_cast<unsigned char>(text[0])) - 'x';
}

Vortices read_vortices(const DeckNode& node) {
  Vortices vortices;
  for (const DeckNode* v : node.all("vortex"))
    vortices.list.push_back(
        {v->vector("origin"), v->real("strength"), v->real("radius"), axis_of(*v)});
  return vortices;
}

LogLawProfile read_log_law(const DeckNode& node) {
  const int flow = node.integer("principalFlowDir");
  return {node.integer("verticalDir"), flow, node.vector("frictionVel")[flow],
          node.real("roughness"), real_or(node, "vonKarmanConstant", 0.4)};
}

ChannelProfile read_channel(const DeckNode& node) {
  ChannelProfile p{node.integer("verticalDir"),
                   node.integer("principalDir"),
                   node.real("Re_tau"),
                   node.real("halfChannelHeight"),
                   {},
                   {}};
  if (node.child("channelFloor") != nullptr) p.floor = node.real("channelFloor");
  if (node.child("channelCeiling") != nullptr) p.ceiling = node.real("channelCeiling");
  return p;
}

std::optional<CustomStart> read_one(const DeckNode& node) {
  if (node.name == "vortices") return read_vortices(node);
  if (node.name == "vortexPairs")
    return VortexPairs{node.real("strength"), axis_of(node), node.integer("numVortexPairs")};
  if (node.name == "gaussianTemperature")
    return GaussianTemperature{node.vector("origin"), node.real("spread_x"), node.real("spread_y"),
                               node.real("amplitude")};
  if (node.name == "manufacturedSolution") {
    if (node.attribute("type") == "mms_1") return ManufacturedVortices{real_or(node, "A", 1.0)};
    return ManufacturedCells{real_or(node, "angle", 0.0)};
  }
  if (node.name == "counterflow") {
    const Vec3 cell = node.vector("referenceCell");
    return Counterflow{
        node.real("strainRate"),
        {static_cast<int>(cell.x), static_cast<int>(cell.y), static_cast<int>(cell.z)}};
  }
  if (node.name == "logLawProfile") return read_log_law(node);
  if (node.name == "powerLawProfile")
    return PowerLawProfile{node.integer("verticalDir"), node.real("profileHeight"),
                           node.real("exponent"), node.vector("U_infinity")};
  if (node.name == "powerLawProfile2") return read_channel(node);
  if (node.name == "DNS_Moser")
    return LaminarChannel{node.integer("verticalDir"), node.real("dpdx")};
  return std::nullopt;
}

}  // namespace

std::vector<TagSpec> custom_start_tags() {
  std::vector<TagSpec> tags = {
      tag("vortices", "Gaussian vortices, truncated at their radius")
          .child(tag("vortex", "one vortex")
                     .at_least_once()
                     .with_children(
                         {axis_tag(),
                          tag("origin", "centre of the vortex").once().vector().unit("length"),
                          tag("strength",
                              "strength C of u = C r w/(rho R^2), "
                              "w = exp(-r^2/(2 R^2))")
                              .once()
                              .real(),
                          length_tag("radius", "R")})),
      tag("vortexPairs",
          "vortices of alternating sense across the domain: u += S sin^2(pi y) cos(2 pi n z) from "
          "side to side, divergence-free and at rest at both sides")
          .with_children({tag("strength", "largest velocity S").once().real().unit("velocity"),
                          axis_tag(),
                          tag("numVortexPairs", "number n of pairs along a periodic direction")
                              .once()
                              .integer()
                              .at_least(1)}),
      tag("gaussianTemperature", "a spot of another temperature, added to the geometry objects")
          .with_children(
              {tag("origin", "centre of the spot").once().vector().unit("length"),
               length_tag("spread_x", "width along x"), length_tag("spread_y", "width along y"),
               tag("amplitude", "increase of the temperature").once().real().unit("temperature")}),
      tag("manufacturedSolution", "state of a manufactured solution at time 0")
          .attribute(
              attribute("type", "which one").once().words({"mms_1", "mms_3"}).not_built({"mms_2"}))
          .with_children({tag("A", "amplitude; absent: 1").real().only_for("type", {"mms_1"}),
                          tag("angle", "phase; absent: 0").real().only_for("type", {"mms_3"})}),
      tag("counterflow", "two jets that meet: u = -s (x - x_m), v = s (y - y_m)")
          .with_children(
              {tag("strainRate", "s").once().real().above(0),
               tag("referenceCell", "cell that has the reference pressure").once().vector()})};
  for (TagSpec& profile : profile_tags()) tags.push_back(std::move(profile));
  return tags;
}

std::vector<CustomStart> read_custom_starts(const DeckNode& custom_initialization) {
  std::vector<CustomStart> starts;
  for (const auto& child : custom_initialization.children)
    if (auto start = read_one(*child)) starts.push_back(std::move(*start));
  std::reverse(starts.begin(), starts.end());
  return starts;
}

}  // namespace sluice::ice
