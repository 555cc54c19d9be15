// The state of a regridder as JSON, for checkpoints.
#include "framework/refine/regrid_state.hpp"

#include "framework/base/error.hpp"
#include "framework/base/json.hpp"

namespace sluice {

std::string to_json_text(const RegridState& state) {
  Json levels = Json::array();
  for (std::size_t l = 0; l < state.tiles.size(); ++l) {
    Json tiles = Json::array();
    for (const IntVec3& t : state.tiles[l].tiles) tiles.push_back({t.x, t.y, t.z});
    levels.push_back({{"tiles", tiles}, {"idle", state.idle[l]}});
  }
  return Json{{"last_step", state.last_step}, {"levels", levels}}.dump();
}

RegridState regrid_state_from_json_text(const std::string& text) {
  RegridState state;
  try {
    const Json root = Json::parse(text);
    state.last_step = root.at("last_step").get<int>();
    for (const Json& level : root.at("levels").entries()) {
      TileSet& set = state.tiles.emplace_back();
      for (const Json& t : level.at("tiles").entries())
        set.tiles.push_back({t.at(0).get<int>(), t.at(1).get<int>(), t.at(2).get<int>()});
      state.idle.push_back(level.at("idle").get<std::vector<int>>());
      if (state.idle.back().size() != set.tiles.size())
        throw InputError(
            "the number of tiles in the checkpoint's regrid state differs from its list of tiles");
    }
  } catch (const JsonError& e) {
    throw InputError(std::string("the checkpoint's regrid state cannot be read: ") + e.what());
  }
  return state;
}

}  // namespace sluice
