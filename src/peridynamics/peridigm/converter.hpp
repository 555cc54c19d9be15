// What a deck of Peridigm means, block by block.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "peridynamics/peridigm/mesh.hpp"

namespace sluice::peridynamics {

struct MaterialOfDeck {
  std::string name;
  bool bond_based = false;
  double density = 0, bulk = 0, shear = 0;
};

struct BlockOfDeck {
  int number = 1;
  double horizon = 0;
  const MaterialOfDeck* material = nullptr;
  double critical_stretch = 0;  // 0: no bond breaks
};

struct OutputOfDeck {
  std::string file;
  int frequency = 1;
  std::vector<std::string> labels;
};

class PeridigmReader {
 public:
  PeridigmReader(const Parameter& deck, std::string folder, std::vector<Fault>& faults)
      : deck_(&deck), folder_(std::move(folder)), faults_(&faults) {}
  void read();

  Mesh mesh;
  std::vector<Vec3> displacement, velocity;  // of each point at the start
  bool displaced = false;
  std::map<std::string, MaterialOfDeck> materials;
  std::vector<BlockOfDeck> blocks;
  double initial_time = 0, final_time = 0, fixed_dt = 0, safety_factor = 0;
  OutputOfDeck output;

 private:
  const Parameter* need(const Parameter& list, const char* name);
  double number(const Parameter& list, const char* name, double fallback);
  void read_materials(const Parameter& list);
  void read_damage(const Parameter& list);
  void read_blocks(const Parameter& list);
  void read_conditions(const Parameter& list);
  void read_condition(const Parameter& condition, const Parameter& all);
  void read_solver(const Parameter& list);
  void read_output(const Parameter& list);
  void refuse_unknown(const Parameter& list);

  const Parameter* deck_;
  std::string folder_;
  std::vector<Fault>* faults_;
  std::map<std::string, double> critical_stretches_;
};

}  // namespace sluice::peridynamics
