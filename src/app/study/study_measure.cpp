#include "app/study/study_measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "app/loading/archive_error.hpp"
#include "framework/archive/archive.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/deck.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/scene/formula.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

ArchiveStep last_output(const Study& study, const fs::path& folder) {
  const Archive archive = Archive::open(folder);
  if (archive.outputs().empty())
    throw InputError(fmt::format("{}: the run of {} wrote no output", study.file, study.deck));
  return archive.read_output(archive.select_output("last"));
}

bool is_of_particles(const Study& study) {
  return study.variable.starts_with("p.");
}

bool inside(const Study& study, Vec3 x) {
  if (!study.within) return true;
  for (int d = 0; d < 3; ++d)
    if (x[d] < study.within->first[d] || x[d] > study.within->second[d]) return false;
  return true;
}

// Values with their places and volumes (all 1 of particles that save none).
struct Sample {
  std::vector<double> values, volumes;
  std::vector<Vec3> places;
};

[[noreturn]] void refuse_missing(const Study& study) {
  throw InputError(fmt::format(
      "{}: the run of {} holds no '{}' of material {} with component {}; save it with <save "
      "label=\"{}\"/>",
      study.file, study.deck, study.variable, study.material, study.component, study.variable));
}

Sample particles_of(const Study& study, const ArchiveStep& step) {
  Sample out;
  for (int level = 0; level < static_cast<int>(step.grid().levels.size()); ++level) {
    const FieldInfo* field = step.find_particles(study.variable, study.material, level);
    const FieldInfo* place = step.find_particles("p.x", study.material, level);
    const FieldInfo* volume = step.find_particles("p.volume", study.material, level);
    if (field == nullptr) continue;
    if (place == nullptr && (study.within || study.exact)) refuse_missing(study);
    const auto v = step.read_particles(*field);
    if (study.component >= static_cast<int>(v.size())) refuse_missing(study);
    const auto x =
        place != nullptr ? step.read_particles(*place) : std::vector<std::vector<double>>(3, v[0]);
    const auto V =
        volume != nullptr ? step.read_particles(*volume)[0] : std::vector<double>(v[0].size(), 1.0);
    // A displacement is a function of where the particle began.
    const bool from_start = study.variable == "p.displacement" && v.size() == 3;
    for (std::size_t p = 0; p < v[0].size(); ++p) {
      Vec3 here{x[0][p], x[1][p], x[2][p]};
      if (from_start) here = here - Vec3{v[0][p], v[1][p], v[2][p]};
      if (!inside(study, here)) continue;
      out.values.push_back(v[study.component][p]);
      out.volumes.push_back(V[p]);
      out.places.push_back(here);
    }
  }
  return out;
}

Sample cells_of(const Study& study, const ArchiveStep& step) {
  Sample out;
  for (const CellValue& cell :
       uncovered_values(step, study.variable, study.component, study.material)) {
    if (!inside(study, cell.centre)) continue;
    out.values.push_back(cell.value);
    out.volumes.push_back(cell.spacing.x * cell.spacing.y * cell.spacing.z);
    out.places.push_back(cell.centre);
  }
  return out;
}

// The last row of LABEL.dat: time and components.
double last_of_history(const Study& study, const fs::path& archive) {
  std::ifstream in(archive / (study.variable + ".dat"));
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty() && line[0] != '#') last = line;
  std::istringstream row(last);
  std::vector<double> numbers;
  for (double x = 0; row >> x;) numbers.push_back(x);
  if (numbers.size() < 2 + static_cast<std::size_t>(study.component)) refuse_missing(study);
  return numbers[1 + study.component];
}

double reduced(const Study& study, const fs::path& archive) {
  if (study.reduce == "last") return last_of_history(study, archive);
  const ArchiveStep step = last_output(study, archive);
  const Sample sample = is_of_particles(study) ? particles_of(study, step) : cells_of(study, step);
  if (sample.values.empty()) refuse_missing(study);
  const auto [low, high] = std::minmax_element(sample.values.begin(), sample.values.end());
  if (study.reduce == "largest") return *high;
  if (study.reduce == "smallest") return *low;
  double sum = 0, all = 0;
  for (std::size_t n = 0; n < sample.values.size(); ++n) {
    sum += sample.volumes[n] * sample.values[n];
    all += sample.volumes[n];
  }
  return sum / all;
}

// Of one number, all norms are alike.
exact::ErrorNorms of_one(double value, double wanted, double offset) {
  const double d = std::fabs(value - wanted), size = std::fabs(wanted - offset);
  return {d, d, d, size > 0 ? d / size : d, 1};
}

// Particles have the value of the formula at their places.
exact::ErrorNorms particles_against(const Study& study, const ArchiveStep& step) {
  const Formula formula(*study.exact);
  const Sample sample = particles_of(study, step);
  if (sample.values.empty()) refuse_missing(study);
  std::vector<double> exact;
  for (const Vec3 x : sample.places) exact.push_back(formula(x));
  return exact::error_norms(sample.values, exact, sample.volumes, study.offset);
}

// The labels that the deck saves, and those that an override of the study names.
bool saves(const Study& study, const DeckNode& root, const std::string& label,
           std::vector<std::string>& saved) {
  if (const DeckNode* archiver = root.find("DataArchiver"))
    for (const auto& child : archiver->children)
      if (child->name == "save") saved.push_back(child->attribute("label").value_or(""));
  if (std::find(saved.begin(), saved.end(), label) != saved.end()) return true;
  return std::any_of(study.overrides.begin(), study.overrides.end(), [&](const std::string& one) {
    return one.starts_with("DataArchiver") && one.find(label) != std::string::npos;
  });
}

}  // namespace

exact::ErrorNorms measured_error(const Study& study, const fs::path& archive,
                                 const std::optional<fs::path>& reference) {
  if (!study.reduce.empty()) {
    const double wanted =
        study.exact ? Formula(*study.exact)({}) : reduced(study, reference.value());
    return of_one(reduced(study, archive), wanted, study.offset);
  }
  const ArchiveStep step = last_output(study, archive);
  if (study.exact && is_of_particles(study)) return particles_against(study, step);
  if (study.exact) {
    const Formula formula(*study.exact);
    return archive_error(
        step, [&](Vec3 x) { return formula(x); }, study.variable, study.component, study.material,
        study.within, study.offset);
  }
  if (reference)
    return archive_error(step, last_output(study, *reference), study.variable, study.component,
                         study.material, study.offset);
  const auto of_deck = reference_of_archive(Archive::open(archive));
  if (!of_deck)
    throw InputError(fmt::format(
        "{}: the deck names no <Meta><exact_solution>, and the study neither \"exact\" nor "
        "\"reference\"; it needs one of them to measure errors",
        study.deck));
  return archive_error(step, *of_deck, study.variable, study.component, study.material,
                       study.offset);
}

void require_measurable(const Study& study) {
  if (is_of_energy(study)) return;
  const Deck deck = read_deck(study.deck);
  if (!deck.root) return;  // the first run tells what is wrong with it
  std::vector<std::string> saved;
  if (!saves(study, *deck.root, study.variable, saved))
    throw InputError(
        fmt::format("{}: {} does not save \"{}\" ({}); add <save label=\"{}\"/> to "
                    "its <DataArchiver>",
                    study.file, study.deck, study.variable, suggest_name(study.variable, saved),
                    study.variable));
  if (study.exact || study.reference || deck.root->find("Meta/exact_solution") != nullptr) return;
  throw InputError(fmt::format(
      "{}: {} names no <Meta><exact_solution>, and the study neither \"exact\" nor \"reference\"; "
      "it needs one of them to measure errors",
      study.file, study.deck));
}

}  // namespace sluice
