// A deck run by the sluice command in a folder of its own, and what its archive says.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "exact/base/error_norms.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/base/vec3.hpp"

namespace sluice::verification {

// A cell variable of one archived time over the whole domain, x fastest.
struct CellValues {
  IntVec3 size;
  Vec3 low, spacing;  // low corner of the domain
  double time = 0;
  std::vector<double> values;

  double at(int i, int j = 0, int k = 0) const {
    return values[static_cast<std::size_t>(i) +
                  static_cast<std::size_t>(size.x) *
                      (static_cast<std::size_t>(j) +
                       static_cast<std::size_t>(size.y) * static_cast<std::size_t>(k))];
  }
  Vec3 centre(int i, int j = 0, int k = 0) const {
    return {low.x + (i + 0.5) * spacing.x, low.y + (j + 0.5) * spacing.y,
            low.z + (k + 0.5) * spacing.z};
  }
};

double lowest(const CellValues& field);
double highest(const CellValues& field);
// Largest |value - wanted|.
double farthest_from(const CellValues& field, double wanted);
double farthest_from(const CellValues& field, const CellValues& wanted);  // of as many cells

// A run that must end as it should: the constructor throws std::runtime_error with the end of the
// run's own messages otherwise. The folder goes away with the object.
class CaseRun {
 public:
  // deck: name of a deck of inputs/ice without ".ups", or a path. options: of sluice run.
  explicit CaseRun(const std::string& deck, const std::vector<std::string>& overrides = {},
                   const std::vector<std::string>& options = {}, int ranks = 1);

  const nlohmann::json& record() const { return record_; }  // of --json
  int steps() const { return record_.at("steps").get<int>(); }
  std::filesystem::path archive() const { return record_.at("archive").get<std::string>(); }
  const std::filesystem::path& folder() const { return folder_.path(); }

  // which: last, first, #N or a time.
  CellValues field(const std::string& variable, int component = 0,
                   const std::string& which = "last", int material = 0) const;
  // Columns of a label of particles, by component.
  std::vector<std::vector<double>> particles(const std::string& label,
                                             const std::string& which = "last",
                                             int material = 0) const;
  double time(const std::string& which = "last") const;
  // What the deck's exact solution has at the centres of these cells at their time.
  CellValues exact_field(const CellValues& like, const std::string& variable,
                         int component = 0) const;
  // Against the deck's exact solution, last output.
  exact::ErrorNorms error(const std::string& variable, int component = 0) const;
  // The same from the exact values at the centres of cells, of one level.
  exact::ErrorNorms error_at_centres(const std::string& variable, int component = 0) const;

  // Largest |drift| of the conserved totals, as the share of sum |q|; boundary fluxes, impulses and
  // sources counted.
  double worst_drift() const;
  // Events of the ledger (retries, repaired faces, fallbacks): their sum.
  long events() const;

 private:
  TemporaryFolder folder_{TemporaryFolder::Place::disk};
  nlohmann::json record_;
};

// Keeps a measured number in the test's report, to stand beside its limit.
void record(const std::string& name, double value);

// "Grid/Level/Box/resolution=[nx,ny,nz]"
std::string resolution(int nx, int ny = 1, int nz = 1);

}  // namespace sluice::verification
