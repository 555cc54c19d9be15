// Statistics over time in every cell: fields that are saved, kept over regrids and restarts.
//
//   sum_Q, mean_Q, variance_Q                    of every variable, component by component
//   skewness_Q, kurtosis_Q                       third and fourth central moments
//   uv_vw_wu_prime                               covariances of the components of one velocity
//   covariance_Q                                 (turbulentFluxes) with the velocity: Qu, Qv, Qw
// A cell keeps the first sample q0 and sums of (q - q0)^k: nothing is lost where fluctuations are
// small. The number of samples is the same for all cells: what a regrid adds takes the history of
// the coarse cell below it. Names of labels that checkpoints keep begin
// with the module's.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/analysis/modules.hpp"
#include "framework/archive/field_piece.hpp"
#include "framework/run/levels/hierarchy.hpp"

namespace sluice {

class ArchiveStep;

class Statistics {
 public:
  // DeckError at the line of a variable of which no statistics can be kept.
  Statistics(const AnalysisModule& module, const FindQuantity& find, Hierarchy& hierarchy,
             int rank);
  ~Statistics();

  // What a sample reads.
  const std::vector<AnalysedQuantity>& quantities() const { return quantities_; }
  // The boxes of the levels are others than before: histories move with their cells. Collective.
  void follow_levels();
  // Adds what the outputs of all levels hold.
  void sample();
  int samples() const { return samples_; }

  // The labels that can be saved, and their values into the outputs of all levels.
  const std::vector<Label>& labels() const { return labels_; }
  void store(const std::vector<Label>& wanted);
  void add_checkpoint_pieces(std::vector<FieldPiece>& pieces) const;
  // From a checkpoint that has taken so many samples; one that knows nothing of them leaves
  // all at zero.
  void restore(const ArchiveStep& checkpoint, int samples);

 private:
  // What is kept of two components of quantities, a = b: of one.
  struct Sums {
    std::size_t quantity = 0;
    int component = 0;
    std::string name;
    std::vector<Label> powers;  // of sums of d, d^2, ...
    Label first;                // q0
  };
  struct Product {
    std::size_t a = 0, b = 0;  // numbers of Sums
    Label sum;                 // of d_a d_b
  };
  // A label of three or one components, each a function of what is kept.
  struct Derived {
    Label label;
    int material = 0;
    int moment = 0;                    // 0: sum, 1: mean, 2, 3, 4: central moments; 5: product
    std::vector<std::size_t> entries;  // numbers of Sums, or of Products
  };
  struct LevelStore;

  std::vector<std::size_t> add_quantity(const AnalysedVariable& v, const FindQuantity& find,
                                        int powers);
  std::size_t add_product(std::size_t a, std::size_t b);
  void add_derived(const std::string& name, ValueType type, const std::string& unit, int material,
                   int moment, const std::vector<std::size_t>& entries, const char* text);
  Label keep(const std::string& name, int material);
  double value(const Derived& d, std::size_t entry, const LevelStore& store, int box,
               IntVec3 cell) const;
  void add_box(const LevelStore& store, const Warehouse& outputs, int box);

  const AnalysisModule* module_;
  Hierarchy* hierarchy_;
  int rank_;
  std::vector<AnalysedQuantity> quantities_;
  std::vector<Sums> sums_;
  std::vector<Product> products_;
  std::vector<Derived> derived_;
  std::vector<Label> labels_, kept_;
  std::vector<int> kept_materials_;
  std::vector<std::unique_ptr<LevelStore>> stores_;  // by level that exists
  int samples_ = 0;
};

// Does a module keep statistics.
bool keeps_statistics(const AnalysisModule& module);

// The fields of statistics that a module gives to save, by the names and types of their labels.
// `type_of`: of a variable that it analyses.
using TypeOfVariable = std::function<ValueType(const AnalysedVariable&)>;
std::vector<std::pair<std::string, ValueType>> fields_of_statistics(const AnalysisModule& module,
                                                                    const TypeOfVariable& type_of);

}  // namespace sluice
