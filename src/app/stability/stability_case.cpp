#include "app/stability/stability_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "framework/base/error.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

const std::vector<std::string>& components() {
  static const std::vector<std::string> names = {"fluid", "solids", "coupled", "reactions"};
  return names;
}

const std::vector<std::string>& traits() {
  static const std::vector<std::string> names = {"levels", "implicit"};
  return names;
}

StabilityCase::Sweep read_sweep(const JsonFile& file, const Json& object) {
  if (!object.is_object()) file.refuse("each of \"sweeps\" must be an object");
  file.refuse_unknown(object, {"name", "default", "limit", "values"});
  StabilityCase::Sweep sweep{file.text(object, "name"), file.text(object, "default"), {}};
  if (!object.contains("values") || !object.at("values").is_object() || object.at("values").empty())
    file.refuse(
        fmt::format("sweep \"{}\" needs \"values\": names with their overrides", sweep.name));
  std::optional<double> limit;
  if (object.contains("limit")) limit = file.number(object, "limit");
  std::vector<std::string> names;
  for (const auto& [name, overrides] : object.at("values").members()) {
    const std::optional<double> number = number_of(name);
    if (limit && !number)
      file.refuse(fmt::format("sweep \"{}\" has a \"limit\", but its value \"{}\" is not a number",
                              sweep.name, name));
    sweep.values.push_back({name, file.overrides(overrides), !limit || *number <= *limit});
    names.push_back(name);
  }
  file.refuse_unless_known(sweep.default_value, "default of a sweep, none of its values:", names);
  return sweep;
}

std::vector<std::string> read_traits(const JsonFile& file) {
  std::vector<std::string> read;
  for (const Json& one : file.list(file.root(), "traits")) {
    if (!one.is_text()) file.refuse(fmt::format("trait {} must be a text", one.dump()));
    file.refuse_unless_known(one.get<std::string>(), "trait", traits());
    read.push_back(one.get<std::string>());
  }
  return read;
}

bool read_quick(const JsonFile& file) {
  if (!file.root().contains("quick")) return false;
  const Json& quick = file.root().at("quick");
  if (quick.kind() != Json::Kind::boolean) file.refuse("\"quick\" must be true or false");
  return quick.get<bool>();
}

}  // namespace

std::optional<double> number_of(const std::string& value_name) {
  return parse_real(value_name).value;
}

std::vector<StabilityPoint> points_of(const StabilityCase& hard) {
  std::vector<StabilityPoint> points = {{-1, -1, hard.overrides}};
  for (std::size_t s = 0; s < hard.sweeps.size(); ++s) {
    const StabilityCase::Sweep& sweep = hard.sweeps[s];
    for (std::size_t v = 0; v < sweep.values.size(); ++v) {
      if (sweep.values[v].name == sweep.default_value) continue;
      StabilityPoint point{static_cast<int>(s), static_cast<int>(v), hard.overrides};
      const auto& more = sweep.values[v].overrides;
      point.overrides.insert(point.overrides.end(), more.begin(), more.end());
      points.push_back(std::move(point));
    }
  }
  return points;
}

StabilityCase read_stability_case(const std::string& name) {
  const JsonFile file = JsonFile::read(name, ".stability");
  const Json& root = file.root();
  file.refuse_unknown(root, {"title", "why", "source", "component", "traits", "quick", "deck",
                             "set", "redone_at_most", "must_hold", "sweeps"});
  StabilityCase hard;
  hard.file = name;
  hard.name = std::filesystem::path(name).stem().string();
  hard.title = file.text(root, "title");
  hard.why = file.text(root, "why", "");
  hard.source = file.text(root, "source", "");
  hard.component = file.text(root, "component");
  file.refuse_unless_known(hard.component, "component", components());
  hard.traits = read_traits(file);
  hard.quick = read_quick(file);
  hard.deck = file.deck(file.text(root, "deck"));
  hard.overrides = file.overrides(root, "set");
  if (root.contains("redone_at_most")) hard.redone_at_most = file.number(root, "redone_at_most");
  for (const Json& one : file.list(root, "must_hold"))
    hard.must_hold.push_back(read_requirement(file, one));
  if (hard.must_hold.empty()) file.refuse("\"must_hold\" is missing: a list of bounds");
  for (const Json& one : file.list(root, "sweeps")) hard.sweeps.push_back(read_sweep(file, one));
  return hard;
}

std::vector<StabilityCase> read_stability_cases(const std::string& folder) {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  std::error_code fault;
  for (const auto& entry : fs::directory_iterator(folder, fault))
    if (entry.path().extension() == ".stability") files.push_back(entry.path().string());
  if (files.empty())
    throw InputError(fmt::format("{}: there is no .stability file in this folder", folder));
  std::sort(files.begin(), files.end());
  std::vector<StabilityCase> cases;
  for (const std::string& file : files) cases.push_back(read_stability_case(file));
  return cases;
}

}  // namespace sluice
