#include "app/study/study.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>

#include "app/loading/archive_error.hpp"
#include "app/process/json_file.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"
#include "framework/base/text.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/scene/formula.hpp"

namespace sluice {
namespace {

IntVec3 resolution_in(const JsonFile& file, const Json& value) {
  IntVec3 out;
  if (!value.is_array() || value.size() != 3) {
    file.refuse(
        fmt::format("{} in \"resolution\" is not a triple such as [100,1,1]", value.dump()));
  }
  for (int d = 0; d < 3; ++d) {
    const Json& n = value.at(d);
    if (!n.is_whole() || n.get<std::int64_t>() < 1 || n.get<std::int64_t>() > 100000000) {
      file.refuse(
          fmt::format("{} in \"resolution\": cells must be whole numbers from 1 on", value.dump()));
    }
    out[d] = n.get<int>();
  }
  return out;
}

Study::Ladder ladder_in(const JsonFile& file, const Json& value) {
  if (!value.is_object()) file.refuse("each of \"ladders\" must be an object");
  file.refuse_unknown(value, {"name", "default", "values"});
  Study::Ladder ladder;
  ladder.name = file.text(value, "name");
  ladder.default_value = file.text(value, "default");
  if (!value.contains("values") || !value.at("values").is_object() || value.at("values").empty()) {
    file.refuse(
        fmt::format("ladder \"{}\" needs \"values\": names with their overrides", ladder.name));
  }
  std::vector<std::string> names;
  for (const auto& [name, overrides] : value.at("values").members()) {
    ladder.values.push_back({name, file.overrides(overrides)});
    names.push_back(name);
  }
  if (std::find(names.begin(), names.end(), ladder.default_value) == names.end()) {
    file.refuse(fmt::format("ladder \"{}\": the default \"{}\" is none of its values ({})",
                            ladder.name, ladder.default_value,
                            suggest_name(ladder.default_value, names)));
  }
  return ladder;
}

void read_targets(const JsonFile& file, Study& study) {
  study.targets.clear();
  for (const Json& target : file.list(file.root(), "targets")) {
    if (!target.is_number() || !(target.get<double>() > 0)) {
      file.refuse(fmt::format("target {} must be a number above zero", target.dump()));
    }
    study.targets.push_back(target.get<double>());
  }
}

void read_reference(const JsonFile& file, Study& study, const Json& value) {
  if (!value.is_object()) file.refuse("\"reference\" must be an object");
  file.refuse_unknown(value, {"resolution", "set"});
  if (!value.contains("resolution"))
    file.refuse("\"reference\" needs \"resolution\", such as [800,1,1]");
  study.reference = {resolution_in(file, value.at("resolution")), file.overrides(value, "set")};
}

void read_material(const JsonFile& file, Study& study, const Json& value) {
  if (!value.is_whole() || value.get<std::int64_t>() < 0 || value.get<std::int64_t>() > 1000)
    file.refuse(fmt::format("material {} must be a number from 0 on", value.dump()));
  study.material = value.get<int>();
}

// The overrides that give every level of the deck these cells.
void add_resolution(const Study& study, IntVec3 n, std::vector<std::string>& overrides) {
  for (const std::string& path : study.resolution_paths)
    overrides.push_back(fmt::format("{}=[{},{},{}]", path, n.x, n.y, n.z));
}

void read_resolution_paths(const JsonFile& file, Study& study, const Json& value) {
  if (value.is_text()) {
    study.resolution_paths = {value.get<std::string>()};
    return;
  }
  study.resolution_paths.clear();
  for (const Json& one : file.list(file.root(), "resolution_path")) {
    if (!one.is_text()) file.refuse("\"resolution_path\" must be texts");
    study.resolution_paths.push_back(one.get<std::string>());
  }
}

void read_variable(const JsonFile& file, Study& study, const std::string& text) {
  study.variable = text;
  if (is_of_energy(study)) return;
  const bool of_particles = text.starts_with("p.");
  const std::size_t dot = text.find('.', of_particles ? 2 : 0);
  if (dot == std::string::npos) return;
  const std::string component = text.substr(dot + 1);
  study.variable = text.substr(0, dot);
  const auto is_axis = [](char c) { return c >= 'x' && c <= 'z'; };
  if (of_particles && component.size() == 2 && is_axis(component[0]) && is_axis(component[1])) {
    study.component = 3 * (component[0] - 'x') + (component[1] - 'x');
    return;
  }
  if (component.size() != 1 || !is_axis(component[0])) {
    file.refuse(fmt::format("variable {}: the component must be x, y or z{}", text,
                            of_particles ? ", or two of them of a tensor" : ""));
  }
  study.component = component[0] - 'x';
}

// A number, or a formula of x, y, z.
void read_exact(const JsonFile& file, Study& study, const Json& value) {
  if (!value.is_text() && !value.is_number())
    file.refuse(
        fmt::format("\"exact\" is {}; expected a formula of x, y, z such as "
                    "\"0.05*y\", or a number",
                    value.dump()));
  study.exact = value.is_text() ? value.get<std::string>() : exact_text(value.get<double>());
  (void)Formula(*study.exact);  // its faults are told now
}

void read_reduce(const JsonFile& file, Study& study, const std::string& text) {
  const std::vector<std::string> known = {"mean", "largest", "smallest", "last"};
  file.refuse_unless_known(text, "\"reduce\"", known);
  study.reduce = text;
}

Vec3 corner_in(const JsonFile& file, const Json& value) {
  Vec3 out;
  bool good = value.is_array() && value.size() == 3;
  for (int d = 0; good && d < 3; ++d) {
    good = value.at(d).is_number();
    if (good) out[d] = value.at(d).get<double>();
  }
  if (!good)
    file.refuse(fmt::format("{} in \"within\" is not a corner such as [0,0,0]", value.dump()));
  return out;
}

void read_within(const JsonFile& file, Study& study, const Json& value) {
  if (!value.is_array() || value.size() != 2)
    file.refuse("\"within\" must be two corners, such as [[0,0,0], [1,1,1]]");
  study.within = {corner_in(file, value.at(0)), corner_in(file, value.at(1))};
}

const std::vector<std::string>& parts() {
  static const std::vector<std::string> all = {"fluid",    "pressure", "levels",   "solids",
                                               "implicit", "coupled",  "reactions"};
  return all;
}

void read_part(const JsonFile& file, Study& study, const std::string& text) {
  file.refuse_unless_known(text, "component", parts());
  study.part = text;
}

// What measures the error, against each other.
void refuse_contradictions(const JsonFile& file, const Study& study) {
  if (study.exact && study.reference) file.refuse("\"exact\" and \"reference\" exclude each other");
  if (!study.reduce.empty() && !study.exact && !study.reference)
    file.refuse("\"reduce\" needs \"exact\", a number, or a \"reference\"");
  const bool of_particles = study.variable.starts_with("p.");
  if (of_particles && study.reference && study.reduce.empty())
    file.refuse(
        fmt::format("particles of two runs are not the same: {} against a reference needs "
                    "\"reduce\" (mean, largest or smallest)",
                    study.variable));
}

}  // namespace

int StudyPoint::cells() const {
  return std::max({resolution.x, resolution.y, resolution.z});
}

Study read_study(const std::string& name) {
  const JsonFile file = JsonFile::read(name, ".study");
  const Json& json = file.root();
  file.refuse_unknown(
      json, {"title", "deck", "variable", "material", "reference", "exact", "reduce", "within",
             "offset", "norm", "set", "resolution", "resolution_path", "ladders", "targets",
             "component", "default_is_slower_because"});
  Study study;
  study.file = name;
  study.title = file.text(json, "title");
  study.deck = file.deck(file.text(json, "deck"));
  if (json.contains("variable")) read_variable(file, study, file.text(json, "variable"));
  if (json.contains("material")) read_material(file, study, json.at("material"));
  if (json.contains("reference")) read_reference(file, study, json.at("reference"));
  if (json.contains("exact")) read_exact(file, study, json.at("exact"));
  if (json.contains("reduce")) read_reduce(file, study, file.text(json, "reduce"));
  if (json.contains("within")) read_within(file, study, json.at("within"));
  if (json.contains("offset")) {
    if (!json.at("offset").is_number()) file.refuse("\"offset\" must be a number");
    study.offset = json.at("offset").get<double>();
  }
  if (json.contains("component")) read_part(file, study, file.text(json, "component"));
  if (json.contains("default_is_slower_because"))
    study.why_slower = file.text(json, "default_is_slower_because");
  refuse_contradictions(file, study);
  if (json.contains("norm")) study.norm = file.text(json, "norm");
  file.refuse_unless_known(study.norm, "norm", norm_names());
  if (json.contains("set")) study.overrides = file.overrides(json.at("set"));
  if (json.contains("resolution_path")) {
    read_resolution_paths(file, study, json.at("resolution_path"));
  }
  if (!json.contains("resolution") || !json.at("resolution").is_array() ||
      json.at("resolution").empty()) {
    file.refuse("entry \"resolution\" is missing: a list of [cells, cells, cells]");
  }
  for (const Json& one : json.at("resolution").entries()) {
    study.resolutions.push_back(resolution_in(file, one));
  }
  if (json.contains("ladders")) {
    for (const Json& one : file.list(json, "ladders"))
      study.ladders.push_back(ladder_in(file, one));
  }
  if (json.contains("targets")) read_targets(file, study);
  return study;
}

namespace {

StudyPoint reference_with(const Study& study, IntVec3 resolution) {
  StudyPoint point{"reference", false, resolution, study.overrides};
  const auto& more = study.reference.value().overrides;
  point.overrides.insert(point.overrides.end(), more.begin(), more.end());
  add_resolution(study, resolution, point.overrides);
  return point;
}

}  // namespace

StudyPoint reference_point(const Study& study) {
  return reference_with(study, study.reference.value().resolution);
}

std::optional<StudyPoint> coarser_reference_point(const Study& study) {
  IntVec3 resolution = study.reference.value().resolution;
  for (int d = 0; d < 3; ++d) {
    if (resolution[d] == 1) continue;
    if (resolution[d] % 2 != 0) return std::nullopt;
    resolution[d] /= 2;
  }
  return reference_with(study, resolution);
}

std::vector<StudyPoint> points_of(const Study& study) {
  std::vector<StudyPoint> settings(1);
  settings[0].is_default = true;
  settings[0].overrides = study.overrides;
  for (const Study::Ladder& ladder : study.ladders) {
    std::vector<StudyPoint> more;
    for (const StudyPoint& base : settings) {
      for (const Study::Value& value : ladder.values) {
        StudyPoint point = base;
        point.setting += (base.setting.empty() ? "" : ", ") + ladder.name + " " + value.name;
        point.is_default = base.is_default && value.name == ladder.default_value;
        point.overrides.insert(point.overrides.end(), value.overrides.begin(),
                               value.overrides.end());
        more.push_back(std::move(point));
      }
    }
    settings = std::move(more);
  }
  std::vector<StudyPoint> points;
  for (StudyPoint& setting : settings) {
    if (setting.setting.empty()) setting.setting = "as the deck says";
    for (const IntVec3 n : study.resolutions) {
      StudyPoint point = setting;
      point.resolution = n;
      add_resolution(study, n, point.overrides);
      points.push_back(std::move(point));
    }
  }
  return points;
}

bool matches(const StudyPoint& point, const std::string& pattern) {
  const std::string name = fmt::format("{}, N {}", point.setting, point.cells());
  if (pattern.find_first_of("*?") == std::string::npos) {
    return name.find(pattern) != std::string::npos;
  }
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

}  // namespace sluice
