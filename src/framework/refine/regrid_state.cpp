// The state of a regridder as JSON, for checkpoints.
#include "framework/refine/regrid_state.hpp"

#include <nlohmann/json.hpp>

#include "framework/base/error.hpp"

namespace sluice {

using nlohmann::json;

std::string to_json_text(const RegridState& state) {
  json levels = json::array();
  for (std::size_t l = 0; l < state.tiles.size(); ++l) {
    json tiles = json::array();
    for (const IntVec3& t : state.tiles[l].tiles) tiles.push_back({t.x, t.y, t.z});
    levels.push_back({{"tiles", tiles}, {"idle", state.idle[l]}});
  }
  return json{{"last_step", state.last_step}, {"levels", levels}}.dump();
}

RegridState regrid_state_from_json_text(const std::string& text) {
  RegridState state;
  try {
    const json root = json::parse(text);
    state.last_step = root.at("last_step").get<int>();
    for (const json& level : root.at("levels")) {
      TileSet& set = state.tiles.emplace_back();
      for (const json& t : level.at("tiles"))
        set.tiles.push_back({t.at(0).get<int>(), t.at(1).get<int>(), t.at(2).get<int>()});
      state.idle.push_back(level.at("idle").get<std::vector<int>>());
      if (state.idle.back().size() != set.tiles.size())
        throw InputError("the checkpoint's regrid state counts other tiles than it holds");
    }
  } catch (const json::exception& e) {
    throw InputError(std::string("the checkpoint's regrid state cannot be read: ") + e.what());
  }
  return state;
}

}  // namespace sluice
