#include "app/study/study.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "framework/base/error.hpp"
#include "framework/base/json.hpp"
#include "framework/base/text.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/scene/formula.hpp"

namespace sluice {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw InputError(fmt::format("{}: {}", file, what));
}

void refuse_unknown(const std::string& file, const Json& object,
                    const std::vector<std::string>& known) {
  for (const auto& [key, value] : object.members()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    refuse(file, fmt::format("unknown entry \"{}\" ({})", key, suggest_name(key, known)));
  }
}

std::string need_text(const std::string& file, const Json& object, const std::string& key) {
  if (!object.contains(key)) refuse(file, fmt::format("entry \"{}\" is missing", key));
  if (!object.at(key).is_text()) refuse(file, fmt::format("\"{}\" must be a text", key));
  return object.at(key).get<std::string>();
}

const std::vector<Json>& list_in(const std::string& file, const Json& value, const char* name) {
  if (!value.is_array()) refuse(file, fmt::format("\"{}\" must be a list", name));
  return value.entries();
}

// A text or a list of texts, each PATH=VALUE.
std::vector<std::string> overrides_in(const std::string& file, const Json& value) {
  std::vector<std::string> out;
  const auto add = [&](const Json& one) {
    if (!one.is_text() || one.get<std::string>().find('=') == std::string::npos) {
      refuse(file, fmt::format("{} is not an override; expected \"PATH=VALUE\" as for --set",
                               one.dump()));
    }
    out.push_back(one.get<std::string>());
  };
  if (value.is_array()) {
    for (const Json& one : value.entries()) add(one);
  } else {
    add(value);
  }
  return out;
}

IntVec3 resolution_in(const std::string& file, const Json& value) {
  IntVec3 out;
  if (!value.is_array() || value.size() != 3) {
    refuse(file,
           fmt::format("{} in \"resolution\" is not a triple such as [100,1,1]", value.dump()));
  }
  for (int d = 0; d < 3; ++d) {
    const Json& n = value.at(d);
    if (!n.is_whole() || n.get<std::int64_t>() < 1 || n.get<std::int64_t>() > 100000000) {
      refuse(file, fmt::format("{} in \"resolution\": cells must be whole numbers from 1 on",
                               value.dump()));
    }
    out[d] = n.get<int>();
  }
  return out;
}

Study::Ladder ladder_in(const std::string& file, const Json& value) {
  if (!value.is_object()) refuse(file, "each of \"ladders\" must be an object");
  refuse_unknown(file, value, {"name", "default", "values"});
  Study::Ladder ladder;
  ladder.name = need_text(file, value, "name");
  ladder.default_value = need_text(file, value, "default");
  if (!value.contains("values") || !value.at("values").is_object() || value.at("values").empty()) {
    refuse(file,
           fmt::format("ladder \"{}\" needs \"values\": names with their overrides", ladder.name));
  }
  std::vector<std::string> names;
  for (const auto& [name, overrides] : value.at("values").members()) {
    ladder.values.push_back({name, overrides_in(file, overrides)});
    names.push_back(name);
  }
  if (std::find(names.begin(), names.end(), ladder.default_value) == names.end()) {
    refuse(file,
           fmt::format("ladder \"{}\": the default \"{}\" is none of its values ({})", ladder.name,
                       ladder.default_value, suggest_name(ladder.default_value, names)));
  }
  return ladder;
}

// From the folder of the study, else from the working directory, as includes in decks are found.
std::string deck_path(const std::string& file, const std::string& deck) {
  namespace fs = std::filesystem;
  const fs::path beside = fs::path(file).parent_path() / deck;
  if (fs::exists(beside)) return beside.lexically_normal().string();
  if (fs::exists(deck)) return deck;
  refuse(file, fmt::format("the deck {} is neither at {} nor in the working directory", deck,
                           beside.lexically_normal().string()));
}

Json parse(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(fmt::format("{}: cannot be read; name a .study file", file));
  try {
    return Json::parse({std::istreambuf_iterator<char>(in), {}}, Json::Comments::skipped);
  } catch (const JsonError& problem) {
    refuse(file, fmt::format("this is not JSON: {}", problem.what()));
  }
}

void read_targets(Study& study, const Json& value) {
  study.targets.clear();
  for (const Json& target : list_in(study.file, value, "targets")) {
    if (!target.is_number() || !(target.get<double>() > 0)) {
      refuse(study.file, fmt::format("target {} must be a number above zero", target.dump()));
    }
    study.targets.push_back(target.get<double>());
  }
}

void read_reference(Study& study, const Json& value) {
  if (!value.is_object()) refuse(study.file, "\"reference\" must be an object");
  refuse_unknown(study.file, value, {"resolution", "set"});
  if (!value.contains("resolution"))
    refuse(study.file, "\"reference\" needs \"resolution\", such as [800,1,1]");
  study.reference = {resolution_in(study.file, value.at("resolution")),
                     value.contains("set") ? overrides_in(study.file, value.at("set"))
                                           : std::vector<std::string>{}};
}

void read_material(Study& study, const Json& value) {
  if (!value.is_whole() || value.get<std::int64_t>() < 0 || value.get<std::int64_t>() > 1000)
    refuse(study.file, fmt::format("material {} must be a number from 0 on", value.dump()));
  study.material = value.get<int>();
}

// The overrides that give every level of the deck these cells.
void add_resolution(const Study& study, IntVec3 n, std::vector<std::string>& overrides) {
  for (const std::string& path : study.resolution_paths)
    overrides.push_back(fmt::format("{}=[{},{},{}]", path, n.x, n.y, n.z));
}

void read_resolution_paths(Study& study, const Json& value) {
  if (value.is_text()) {
    study.resolution_paths = {value.get<std::string>()};
    return;
  }
  study.resolution_paths.clear();
  for (const Json& one : list_in(study.file, value, "resolution_path")) {
    if (!one.is_text()) refuse(study.file, "\"resolution_path\" must be texts");
    study.resolution_paths.push_back(one.get<std::string>());
  }
}

void read_variable(Study& study, const std::string& text) {
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
    refuse(study.file, fmt::format("variable {}: the component must be x, y or z{}", text,
                                   of_particles ? ", or two of them of a tensor" : ""));
  }
  study.component = component[0] - 'x';
}

// A number, or a formula of x, y, z.
void read_exact(Study& study, const Json& value) {
  if (!value.is_text() && !value.is_number())
    refuse(study.file, fmt::format("\"exact\" is {}; expected a formula of x, y, z such as "
                                   "\"0.05*y\", or a number",
                                   value.dump()));
  study.exact = value.is_text() ? value.get<std::string>() : exact_text(value.get<double>());
  (void)Formula(*study.exact);  // its faults are told now
}

void read_reduce(Study& study, const std::string& text) {
  const std::vector<std::string> known = {"mean", "largest", "smallest", "last"};
  if (std::find(known.begin(), known.end(), text) == known.end())
    refuse(study.file,
           fmt::format("unknown \"reduce\" \"{}\" ({})", text, suggest_name(text, known)));
  study.reduce = text;
}

Vec3 corner_in(const Study& study, const Json& value) {
  Vec3 out;
  bool good = value.is_array() && value.size() == 3;
  for (int d = 0; good && d < 3; ++d) {
    good = value.at(d).is_number();
    if (good) out[d] = value.at(d).get<double>();
  }
  if (!good)
    refuse(study.file,
           fmt::format("{} in \"within\" is not a corner such as [0,0,0]", value.dump()));
  return out;
}

void read_within(Study& study, const Json& value) {
  if (!value.is_array() || value.size() != 2)
    refuse(study.file, "\"within\" must be two corners, such as [[0,0,0], [1,1,1]]");
  study.within = {corner_in(study, value.at(0)), corner_in(study, value.at(1))};
}

const std::vector<std::string>& parts() {
  static const std::vector<std::string> all = {"fluid",    "pressure", "levels",   "solids",
                                               "implicit", "coupled",  "reactions"};
  return all;
}

void read_part(Study& study, const std::string& text) {
  if (std::find(parts().begin(), parts().end(), text) == parts().end())
    refuse(study.file,
           fmt::format("unknown component \"{}\" ({})", text, suggest_name(text, parts())));
  study.part = text;
}

// What measures the error, against each other.
void refuse_contradictions(const Study& study) {
  if (study.exact && study.reference)
    refuse(study.file, "\"exact\" and \"reference\" exclude each other");
  if (!study.reduce.empty() && !study.exact && !study.reference)
    refuse(study.file, "\"reduce\" needs \"exact\", a number, or a \"reference\"");
  const bool of_particles = study.variable.starts_with("p.");
  if (of_particles && study.reference && study.reduce.empty())
    refuse(study.file,
           fmt::format("particles of two runs are not the same: {} against a reference needs "
                       "\"reduce\" (mean, largest or smallest)",
                       study.variable));
}

}  // namespace

int StudyPoint::cells() const {
  return std::max({resolution.x, resolution.y, resolution.z});
}

Study read_study(const std::string& file) {
  const Json json = parse(file);
  if (!json.is_object()) refuse(file, "expected an object { ... }");
  refuse_unknown(file, json,
                 {"title", "deck", "variable", "material", "reference", "exact", "reduce", "within",
                  "offset", "norm", "set", "resolution", "resolution_path", "ladders", "targets",
                  "component", "default_is_slower_because"});
  Study study;
  study.file = file;
  study.title = need_text(file, json, "title");
  study.deck = deck_path(file, need_text(file, json, "deck"));
  if (json.contains("variable")) read_variable(study, need_text(file, json, "variable"));
  if (json.contains("material")) read_material(study, json.at("material"));
  if (json.contains("reference")) read_reference(study, json.at("reference"));
  if (json.contains("exact")) read_exact(study, json.at("exact"));
  if (json.contains("reduce")) read_reduce(study, need_text(file, json, "reduce"));
  if (json.contains("within")) read_within(study, json.at("within"));
  if (json.contains("offset")) {
    if (!json.at("offset").is_number()) refuse(file, "\"offset\" must be a number");
    study.offset = json.at("offset").get<double>();
  }
  if (json.contains("component")) read_part(study, need_text(file, json, "component"));
  if (json.contains("default_is_slower_because"))
    study.why_slower = need_text(file, json, "default_is_slower_because");
  refuse_contradictions(study);
  if (json.contains("norm")) study.norm = need_text(file, json, "norm");
  const std::vector<std::string> norms = {"l1", "l2", "linf", "relative_l1"};
  if (std::find(norms.begin(), norms.end(), study.norm) == norms.end()) {
    refuse(file,
           fmt::format("unknown norm \"{}\" ({})", study.norm, suggest_name(study.norm, norms)));
  }
  if (json.contains("set")) study.overrides = overrides_in(file, json.at("set"));
  if (json.contains("resolution_path")) {
    read_resolution_paths(study, json.at("resolution_path"));
  }
  if (!json.contains("resolution") || !json.at("resolution").is_array() ||
      json.at("resolution").empty()) {
    refuse(file, "entry \"resolution\" is missing: a list of [cells, cells, cells]");
  }
  for (const Json& one : json.at("resolution").entries()) {
    study.resolutions.push_back(resolution_in(file, one));
  }
  if (json.contains("ladders")) {
    for (const Json& one : list_in(file, json.at("ladders"), "ladders"))
      study.ladders.push_back(ladder_in(file, one));
  }
  if (json.contains("targets")) read_targets(study, json.at("targets"));
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
