#include "framework/run/simulation/parted_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/json.hpp"
#include "framework/run/simulation/energy_guard.hpp"

namespace sluice {

void SeparatedBodies::accept(const std::vector<BodyEnergy>& step, int number, double time) {
  for (const BodyEnergy& body : step) {
    if (!(body.parted > 0 && body.particles > 1)) continue;  // one alone has no neighbours
    auto known = std::find_if(all_.begin(), all_.end(),
                              [&](const Parting& p) { return p.name == body.name; });
    if (known == all_.end())
      known = all_.insert(known, {body.name, body.material, number, time, 0, time});
    const double share = body.parted / body.particles;
    if (share <= known->largest) continue;
    known->largest = share;
    known->largest_time = time;
  }
}

std::string SeparatedBodies::summary() const {
  std::string text;
  for (const Parting& p : all_)
    text += fmt::format(
        "warning: solid '{}' separates although its material model has not failed (numerical "
        "fracture): since step {} (t = {:g}) particles are stretched so far that neighbours hardly "
        "share a node, at most {:.2g} % of them, at t = {:g}. Use <interpolator> cpdi, "
        "<total_lagrangian> or more particles per cell\n",
        p.name, p.since, p.since_time, 100 * p.largest, p.largest_time);
  return text;
}

Json SeparatedBodies::checkpoint() const {
  Json bodies = Json::array();
  for (const Parting& p : all_)
    bodies.push_back({{"name", p.name},
                      {"material", p.material},
                      {"since", p.since},
                      {"since_time", p.since_time},
                      {"largest", p.largest},
                      {"largest_time", p.largest_time}});
  return bodies;
}

void SeparatedBodies::restore(const Json& json) {
  all_.clear();
  for (const Json& entry : json.entries()) {
    Parting p;
    p.name = entry.at("name").get<std::string>();
    p.material = entry.at("material").get<int>();
    p.since = entry.at("since").get<int>();
    p.since_time = entry.at("since_time").get<double>();
    p.largest = entry.at("largest").get<double>();
    p.largest_time = entry.at("largest_time").get<double>();
    all_.push_back(p);
  }
}

}  // namespace sluice
