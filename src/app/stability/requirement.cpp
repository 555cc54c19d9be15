#include "app/stability/requirement.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "app/loading/archive_error.hpp"
#include "app/process/deck_process.hpp"
#include "app/stability/extremes.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

// A number of a report; what is not finite is null there.
double number_in(const Json& object, const char* key) {
  const Json& value = object.at(key);
  return value.is_number() ? value.get<double>() : NAN;
}

const std::vector<std::string>& kind_names() {
  static const std::vector<std::string> names = {"quantity", "lost_energy_at_most", "variable",
                                                 "error_of", "event"};
  return names;
}

// Of a conserved quantity, as a share of its scale.
class DriftRequirement : public Requirement {
 public:
  DriftRequirement(std::string quantity, double most, bool only_growth)
      : quantity_(std::move(quantity)), most_(most), only_growth_(only_growth) {}

  std::string text() const override {
    return fmt::format("{} {} at most {:g} of its scale", quantity_,
                       only_growth_ ? "grows" : "drifts", most_);
  }
  Finding check(const Evidence& evidence) const override {
    const Json& quantities = evidence.report.at("conservation");
    if (!quantities.contains(quantity_)) {
      std::string known;
      for (const auto& [name, value] : quantities.members())
        known += (known.empty() ? "" : ", ") + name;
      throw InputError(fmt::format("the run has no conserved quantity \"{}\"; it has {}", quantity_,
                                   known.empty() ? "none" : known));
    }
    const double drift = number_in(quantities.at(quantity_), "drift");
    return {(only_growth_ ? drift : std::fabs(drift)) <= most_, drift, {}};
  }

 private:
  std::string quantity_;
  double most_;
  bool only_growth_;
};

class LostEnergyRequirement : public Requirement {
 public:
  explicit LostEnergyRequirement(double most) : most_(most) {}

  std::string text() const override {
    return fmt::format(
        "energy that transfer, integration and contact took and did not turn into "
        "heat is at most {:g} of the scale",
        most_);
  }
  Finding check(const Evidence& evidence) const override {
    const double share = lost_energy(evidence.report);
    return {share <= most_, share, {}};
  }

 private:
  double most_;
};

class ExtremesRequirement : public Requirement {
 public:
  ExtremesRequirement(const JsonFile& file, const Json& object)
      : label_{file.text(object, "variable"), file.whole(object, "material", 0, 1000, 0),
               file.whole(object, "component", 0, 8, 0)} {
    file.refuse_unknown(object,
                        {"variable", "material", "component", "at_least", "at_most", "when"});
    if (object.contains("at_least")) least_ = file.number(object, "at_least");
    if (object.contains("at_most")) most_ = file.number(object, "at_most");
    if (!least_ && !most_)
      file.refuse(fmt::format("bounds of {} are missing: give \"at_least\", \"at_most\" or both",
                              label_.name));
    const std::string when = file.text(object, "when", "end");
    file.refuse_unless_known(when, "time of a bound", {"end", "always"});
    always_ = when == "always";
  }

  std::string text() const override {
    std::string bounds;
    if (least_) bounds += fmt::format("at least {:g}", *least_);
    if (most_) bounds += fmt::format("{}at most {:g}", least_ ? ", " : "", *most_);
    return fmt::format("{} of material {}: {}{}", label_.name, label_.material, bounds,
                       always_ ? ", in every output" : " at the end");
  }
  Finding check(const Evidence& evidence) const override {
    Finding finding;
    for (const Extremes& e : extremes_of(evidence.archive, label_, always_)) {
      if (least_ && !(e.least.value >= *least_)) return {false, e.least.value, e.least.place};
      if (most_ && !(e.most.value <= *most_)) return {false, e.most.value, e.most.place};
      finding.value = most_ ? e.most.value : e.least.value;
    }
    return finding;
  }

 private:
  LabelRequest label_;
  std::optional<double> least_, most_;
  bool always_ = false;
};

class ErrorRequirement : public Requirement {
 public:
  ErrorRequirement(const JsonFile& file, const Json& object)
      : variable_(file.text(object, "error_of")),
        norm_(file.text(object, "norm", "l1")),
        material_(file.whole(object, "material", 0, 1000, 0)),
        component_(file.whole(object, "component", 0, 2, 0)),
        most_(file.number(object, "at_most")) {
    file.refuse_unknown(object, {"error_of", "norm", "material", "component", "at_most"});
    file.refuse_unless_known(norm_, "norm", norm_names());
  }

  std::string text() const override {
    return fmt::format("{} error of {} is at most {:g}", norm_, variable_, most_);
  }
  Finding check(const Evidence& evidence) const override {
    const Archive archive = Archive::open(evidence.archive);
    const auto reference = reference_of_archive(archive);
    if (!reference)
      throw InputError("the deck names no <Meta><exact_solution>, which \"error_of\" needs");
    const ArchiveStep step = archive.read_output(archive.select_output("last"));
    const double error =
        in_norm(archive_error(step, *reference, variable_, component_, material_), norm_);
    return {error <= most_, error, {}};
  }

 private:
  std::string variable_, norm_;
  int material_, component_;
  double most_;
};

class EventRequirement : public Requirement {
 public:
  EventRequirement(std::string name, double most) : name_(std::move(name)), most_(most) {}

  std::string text() const override {
    return fmt::format("event \"{}\" at most {:g} times", name_, most_);
  }
  Finding check(const Evidence& evidence) const override {
    const Json& events = evidence.report.at("events");
    if (!events.contains(name_)) return {true, 0, {}};
    const auto count = static_cast<double>(events.at(name_).at("count").get<std::int64_t>());
    return {count <= most_, count, "first: " + events.at(name_).at("first").dump()};
  }

 private:
  std::string name_;
  double most_;
};

std::shared_ptr<const Requirement> read_drift(const JsonFile& file, const Json& object) {
  file.refuse_unknown(object, {"quantity", "drift_at_most", "grows_at_most"});
  const bool growth = object.contains("grows_at_most");
  if (growth == object.contains("drift_at_most"))
    file.refuse("a \"quantity\" needs one of \"drift_at_most\" and \"grows_at_most\"");
  return std::make_shared<DriftRequirement>(
      file.text(object, "quantity"),
      file.number(object, growth ? "grows_at_most" : "drift_at_most"), growth);
}

}  // namespace

std::shared_ptr<const Requirement> read_requirement(const JsonFile& file, const Json& object) {
  if (!object.is_object() || object.empty())
    file.refuse(
        fmt::format("{} in \"must_hold\" is no object such as {{\"quantity\": \"total "
                    "energy\", \"drift_at_most\": 1e-6}}",
                    object.dump()));
  if (object.contains("quantity")) return read_drift(file, object);
  if (object.contains("variable")) return std::make_shared<ExtremesRequirement>(file, object);
  if (object.contains("error_of")) return std::make_shared<ErrorRequirement>(file, object);
  if (object.contains("lost_energy_at_most")) {
    file.refuse_unknown(object, {"lost_energy_at_most"});
    return std::make_shared<LostEnergyRequirement>(file.number(object, "lost_energy_at_most"));
  }
  if (object.contains("event")) {
    file.refuse_unknown(object, {"event", "at_most"});
    return std::make_shared<EventRequirement>(file.text(object, "event"),
                                              file.number(object, "at_most"));
  }
  file.refuse_unless_known(object.members().front().first, "kind of bound in \"must_hold\"",
                           kind_names());
  file.refuse(fmt::format("{} is no bound", object.dump()));
}

std::shared_ptr<const Requirement> growth_requirement(const std::string& quantity, double most) {
  return std::make_shared<DriftRequirement>(quantity, most, true);
}

}  // namespace sluice
