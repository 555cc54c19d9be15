// timestep.xml to and from its record: scalars, grid, component state, data files.
#include <fmt/format.h>

#include "framework/archive/archive_record.hpp"

namespace sluice {
namespace {

XmlElement level_xml(const Level& level) {
  XmlElement e("Level");
  auto flags = [](const std::array<bool, 3>& b) { return triple_text(IntVec3{b[0], b[1], b[2]}); };
  e.add("id", std::to_string(level.index));
  e.add("numPatches", std::to_string(level.boxes.size()));
  e.add("totalCells", std::to_string(level.cell_count()));
  e.add("periodic", flags(level.periodic));
  e.add("active", flags(level.active));
  e.add("anchor", triple_text(level.anchor));
  e.add("cellspacing", triple_text(level.spacing));
  e.add("refinementRatio", triple_text(level.ratio));
  e.add("domainLow", triple_text(level.domain.lower));
  e.add("domainHigh", triple_text(level.domain.upper));
  for (const GridBox& b : level.boxes) {
    XmlElement& patch = e.add("Patch");
    patch.add("id", std::to_string(b.id));
    patch.add("proc", std::to_string(b.owner));
    patch.add("lowIndex", triple_text(b.cells.lower));
    patch.add("highIndex", triple_text(b.cells.upper));
  }
  return e;
}

Level parse_level(const XmlElement& e, const std::string& context) {
  auto ints = [&](const char* name) {
    return parse_int_triple(e.need(name, context).text, context);
  };
  auto reals = [&](const char* name) {
    return parse_real_triple(e.need(name, context).text, context);
  };
  Level level;
  level.index = parse_int(e.need("id", context).text, context);
  const IntVec3 periodic = ints("periodic"), active = ints("active");
  for (int d = 0; d < 3; ++d) {
    level.periodic[d] = periodic[d] != 0;
    level.active[d] = active[d] != 0;
  }
  level.anchor = reals("anchor");
  level.spacing = reals("cellspacing");
  level.ratio = ints("refinementRatio");
  for (int d = 0; d < 3; ++d)
    if (!(level.spacing[d] > 0) || level.ratio[d] < 1)
      throw DamageError(context + ": spacing and refinement ratio must be positive");
  level.domain = checked_box(ints("domainLow"), ints("domainHigh"), context);
  for (const XmlElement& p : e.children) {
    if (p.name != "Patch") continue;
    GridBox box;
    box.id = parse_int(p.need("id", context).text, context);
    box.owner = parse_int(p.need("proc", context).text, context);
    box.cells = checked_box(parse_int_triple(p.need("lowIndex", context).text, context),
                            parse_int_triple(p.need("highIndex", context).text, context), context);
    if (!level.domain.contains(box.cells))
      throw DamageError(fmt::format("{}: patch {} lies outside its level", context, box.id));
    level.boxes.push_back(box);
  }
  return level;
}

}  // namespace

IndexBox checked_box(IntVec3 lower, IntVec3 upper, const std::string& context) {
  constexpr int limit = 1 << 30;  // sums and differences of indices stay within an int
  for (int d = 0; d < 3; ++d)
    if (lower[d] < -limit || upper[d] > limit || lower[d] >= upper[d])
      throw DamageError(fmt::format("{}: {} to {} is not a box of cells", context,
                                    triple_text(lower), triple_text(upper)));
  return {lower, upper};
}

XmlElement to_xml(const StepRecord& record) {
  XmlElement root("Uintah_timestep");
  XmlElement& meta = root.add("Meta");
  meta.add("endianness", "little_endian");
  meta.add("nBits", "64");
  meta.add("numProcs", std::to_string(record.ranks));
  XmlElement& time = root.add("Time");
  time.add("timestepNumber", std::to_string(record.info.step));
  time.add("currentTime", real_text(record.info.time));
  time.add("oldDelt", real_text(record.info.old_delt));
  time.add("nextDelt", real_text(record.info.next_delt));
  XmlElement& grid = root.add("Grid");
  grid.add("numLevels", std::to_string(record.grid.levels.size()));
  for (const Level& level : record.grid.levels) grid.children.push_back(level_xml(level));
  XmlElement& state = root.add("State");
  for (const auto& [name, text] : record.info.state)
    state.add("entry").set("name", name).set("value", text);
  XmlElement& data = root.add("Data");
  for (std::size_t rank = 0; rank < record.data_files.size(); ++rank)
    data.add("Datafile").set("href", record.data_files[rank]).set("proc", std::to_string(rank));
  return root;
}

StepRecord parse_step(const XmlElement& root, const std::string& context) {
  if (root.name != "Uintah_timestep")
    throw DamageError(
        fmt::format("{}: the root element is <{}>, not <Uintah_timestep>", context, root.name));
  StepRecord record;
  record.ranks = parse_int(root.need("Meta", context).need("numProcs", context).text, context);
  const XmlElement& time = root.need("Time", context);
  record.info.step = parse_int(time.need("timestepNumber", context).text, context);
  record.info.time = parse_real(time.need("currentTime", context).text, context);
  record.info.old_delt = parse_real(time.need("oldDelt", context).text, context);
  record.info.next_delt = parse_real(time.need("nextDelt", context).text, context);
  for (const XmlElement& e : root.need("Grid", context).children)
    if (e.name == "Level") record.grid.levels.push_back(parse_level(e, context));
  for (std::size_t l = 0; l < record.grid.levels.size(); ++l)
    if (record.grid.levels[l].index != static_cast<int>(l))
      throw DamageError(context + ": the levels are not numbered 0, 1, ... in order");
  for (const Level& level : record.grid.levels) {
    record.level_ids.push_back(level.index);
    std::vector<PatchRecord>& patches = record.patches.emplace_back();
    for (const GridBox& b : level.boxes) patches.push_back({b.id, b.cells, b.cells});
  }
  if (const XmlElement* state = root.child("State"))
    for (const XmlElement& e : state->children)
      record.info.state[e.need_attribute("name", context)] = e.need_attribute("value", context);
  for (const XmlElement& e : root.need("Data", context).children)
    record.data_files.push_back(e.need_attribute("href", context));
  return record;
}

}  // namespace sluice
