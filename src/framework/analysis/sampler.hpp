// What one analysis takes from one level: numbers of this rank, lines of the files on rank 0.
//
// A sample goes: lay_out() whenever boxes have changed, pack() on every rank, write() on rank 0,
// which reads the numbers of all ranks in the order in which each rank has packed its own. Values
// have the units of their labels, places are in m, `time` is that at the end of the step in s.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/field/warehouse.hpp"

namespace sluice {

struct AnalysedQuantity {
  Label label;
  int material = 0;
  int components = 1;
};

// " label_0" or " label_0.x label_0.y label_0.z": the heads of its columns.
std::string columns_of(const AnalysedQuantity& quantity);

// By box of a level: its number among the boxes of its owner.
std::vector<int> local_numbers(const std::vector<GridBox>& boxes);

// The numbers that all ranks have packed.
class RankNumbers {
 public:
  // By rank, as Communicator::gather gives them.
  explicit RankNumbers(const std::vector<std::string>& packed);

  int ranks() const { return static_cast<int>(numbers_.size()); }
  // The next `count` numbers of a rank; std::logic_error where it has packed fewer.
  const double* take(int rank, std::size_t count);

 private:
  std::vector<std::vector<double>> numbers_;
  std::vector<std::size_t> next_;
};

class LevelSampler {
 public:
  explicit LevelSampler(std::vector<AnalysedQuantity> quantities)
      : quantities_(std::move(quantities)) {}
  virtual ~LevelSampler() = default;
  LevelSampler(const LevelSampler&) = delete;
  LevelSampler& operator=(const LevelSampler&) = delete;

  const std::vector<AnalysedQuantity>& quantities() const { return quantities_; }

  // The level's boxes are others than before.
  virtual void lay_out(const Level& level) = 0;
  // How many lines a sample gives now; the same on all ranks.
  virtual std::size_t lines() const = 0;
  virtual void pack(const Warehouse& outputs, int rank, std::vector<double>& numbers) const = 0;
  virtual void write(RankNumbers& numbers, int step, double time) = 0;
  // On rank 0, after all levels have written.
  virtual void end_sample(int /*step*/, double /*time*/) {}

  // As AnalysisFile, for all files.
  virtual void flush(const std::filesystem::path& folder) = 0;
  virtual void adopt(const std::filesystem::path& earlier, const std::filesystem::path& folder,
                     double time) const = 0;

 protected:
  std::vector<AnalysedQuantity> quantities_;
};

}  // namespace sluice
