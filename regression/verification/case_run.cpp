#include "verification/case_run.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "app/loading/archive_error.hpp"
#include "app/process/study_process.hpp"
#include "framework/archive/archive.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::verification {

namespace fs = std::filesystem;

double lowest(const CellValues& field) {
  return *std::min_element(field.values.begin(), field.values.end());
}

double highest(const CellValues& field) {
  return *std::max_element(field.values.begin(), field.values.end());
}

double farthest_from(const CellValues& field, double wanted) {
  double farthest = 0;
  for (const double value : field.values) farthest = std::max(farthest, std::abs(value - wanted));
  return farthest;
}
double farthest_from(const CellValues& field, const CellValues& wanted) {
  if (field.values.size() != wanted.values.size())
    throw std::runtime_error("fields of other grids cannot be compared");
  double farthest = 0;
  for (std::size_t n = 0; n < field.values.size(); ++n)
    farthest = std::max(farthest, std::abs(field.values[n] - wanted.values[n]));
  return farthest;
}

CaseRun::CaseRun(const std::string& deck, const std::vector<std::string>& overrides,
                 const std::vector<std::string>& options, int ranks) {
  const bool is_path = deck.find('/') != std::string::npos;
  ProcessRequest request;
  if (ranks > 1) {
    request.words = {SLUICE_MPIEXEC, "--allow-run-as-root", "--oversubscribe", "-np",
                     std::to_string(ranks)};
  }
  for (const std::string& word :
       {std::string(SLUICE_COMMAND), std::string("run"),
        is_path ? deck : fmt::format("{}/inputs/ice/{}.ups", SLUICE_SOURCE_DIR, deck)}) {
    request.words.push_back(word);
  }
  for (const std::string& one : overrides) {
    request.words.emplace_back("--set");
    request.words.push_back(one);
  }
  const fs::path json = folder_ / "run.json";
  for (const std::string& word : {std::string("-o"), folder_.string(), std::string("--json"),
                                  json.string(), std::string("--progress"), std::string("none")}) {
    request.words.push_back(word);
  }
  request.words.insert(request.words.end(), options.begin(), options.end());
  request.output = folder_ / "run.log";
  const int status = run_process(request);
  std::ifstream in(json);
  record_ = nlohmann::json::parse(in, nullptr, false);
  const std::string end = record_.is_object() ? record_.value("status", "unknown") : "no record";
  if (status == 0 && (end == "done" || end == "max_steps")) return;
  const std::string said = last_lines(request.output, 20);
  throw std::runtime_error(fmt::format("{}: exit status {}, {}:\n{}", deck, status, end, said));
}

CellValues CaseRun::field(const std::string& variable, int component, const std::string& which,
                          int material) const {
  const Archive opened = Archive::open(archive());
  const ArchiveStep step = opened.read_output(opened.select_output(which));
  const FieldInfo* info = step.find(variable, material, 0);
  if (!info) throw std::runtime_error("the archive holds no " + variable);
  const Level& level = step.grid().levels.at(0);
  CellValues out;
  out.size = level.domain.size();
  out.spacing = level.spacing;
  out.low = level.anchor;
  out.time = step.info().time;
  out.values = step.read(*info, level.domain).components.at(static_cast<std::size_t>(component));
  return out;
}

std::vector<std::vector<double>> CaseRun::particles(const std::string& label,
                                                    const std::string& which, int material) const {
  const Archive a = Archive::open(archive());
  const ArchiveStep step = a.read_output(a.select_output(which));
  const FieldInfo* info = step.find_particles(label, material, 0);
  if (info == nullptr) throw std::runtime_error("no particles have " + label);
  return step.read_particles(*info);
}

double CaseRun::time(const std::string& which) const {
  return Archive::open(archive()).select_output(which).time;
}

CellValues CaseRun::exact_field(const CellValues& like, const std::string& variable,
                                int component) const {
  const auto reference = reference_of_archive(Archive::open(archive()));
  if (!reference) throw std::runtime_error("the deck names no exact solution");
  CellValues out = like;
  std::size_t n = 0;
  for_each_cell({{0, 0, 0}, like.size}, [&](IntVec3 c) {
    const exact::State state = reference->solution->at(like.centre(c.x, c.y, c.z), like.time);
    out.values[n++] = exact::exact_value(state, variable, component, reference->specific_heat);
  });
  return out;
}

exact::ErrorNorms CaseRun::error_at_centres(const std::string& variable, int component) const {
  const CellValues computed = field(variable, component);
  return exact::error_norms(computed.values, exact_field(computed, variable, component).values);
}

exact::ErrorNorms CaseRun::error(const std::string& variable, int component) const {
  const Archive opened = Archive::open(archive());
  const auto reference = reference_of_archive(opened);
  if (!reference) throw std::runtime_error("the deck names no exact solution");
  const ArchiveStep step = opened.read_output(opened.select_output("last"));
  return archive_error(step, *reference, variable, component, 0);
}

double CaseRun::worst_drift() const {
  const auto& totals = record_.at("conservation");
  if (totals.empty()) throw std::runtime_error("the run's record says nothing on conservation");
  double worst = 0;
  for (const auto& total : totals) {
    const double drift = std::abs(total.at("drift").get<double>());
    if (!(drift <= worst)) worst = drift;  // a NaN stays
  }
  return worst;
}

long CaseRun::events() const {
  long count = 0;
  for (const auto& event : record_.at("events")) {
    count += event.at("count").get<long>();
  }
  return count;
}

void record(const std::string& name, double value) {
  testing::Test::RecordProperty(name, fmt::format("{:.4g}", value));
}

std::string resolution(int nx, int ny, int nz) {
  return fmt::format("Grid/Level/Box/resolution=[{},{},{}]", nx, ny, nz);
}

}  // namespace sluice::verification
