// An accuracy study: which deck, which error, over which ladders of resolution and settings.
//
// A .study file is JSON with // comments:
//   {
//     "title": "Sod's shock tube",
//     "deck": "../../inputs/ice/riemann_sod.ups",       from the study's folder, else from here
//     "variable": "rho_CC",                             also "vel_CC.x"; "lost energy": of solids,
//                                                       what a run's energy account says is lost,
//                                                       over the scale of its energy
//     "material": 0,                                    number in the archive
//     "reference": {"resolution": [800,1,1], "set": []} a run of the deck in place of the exact
//                                                       solution that it names
//     "norm": "l1",                                     l1, l2, linf, relative_l1
//     "set": ["DataArchiver/outputInterval=0.2"],       for every run
//     "resolution": [[100,1,1], [200,1,1]],
//     "ladders": [{"name": "order", "default": "2",
//                  "values": {"1": "CFD/ICE/advection/@type=FirstOrder",
//                             "2": "CFD/ICE/advection/@type=SecondOrder"}}],
//     "targets": [0.01, 0.003, 0.001]                   of the relative L1 error
//   }
// Every combination of the ladders' values is a setting; every setting runs at each resolution.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice {

struct Study {
  struct Value {
    std::string name;                    // as shown
    std::vector<std::string> overrides;  // PATH=VALUE
  };
  struct Ladder {
    std::string name;
    std::string default_value;  // name of the value that a deck gets when it says nothing
    std::vector<Value> values;
  };
  struct Reference {
    IntVec3 resolution;
    std::vector<std::string> overrides;  // beside those of every run
  };

  std::string file, title, deck;
  std::string variable = "rho_CC";
  int component = 0, material = 0;
  std::optional<Reference> reference;
  std::string norm = "l1";
  std::vector<std::string> overrides;
  std::string resolution_path = "Grid/Level/Box/resolution";
  std::vector<IntVec3> resolutions;  // coarse to fine
  std::vector<Ladder> ladders;
  std::vector<double> targets = {0.01, 0.003, 0.001};  // of the relative error
};

// One run of a study.
struct StudyPoint {
  std::string setting;  // "order 2, CFL 0.4"
  bool is_default = false;
  IntVec3 resolution;
  std::vector<std::string> overrides;

  // The number of cells that names the rung: along the longest direction.
  int cells() const;
};

// InputError with file and place on what is not JSON, unknown, missing or out of range.
Study read_study(const std::string& file);

// The run that stands for the exact solution; of a study that has one.
StudyPoint reference_point(const Study& study);

// Is what the energy account of each run says the error.
inline bool is_of_energy(const Study& study) {
  return study.variable == "lost energy";
}

// All runs, setting by setting, coarse to fine.
std::vector<StudyPoint> points_of(const Study& study);

// "order 2, CFL 0.4, N 200" matched by a pattern with * and ?, or containing it.
bool matches(const StudyPoint& point, const std::string& pattern);

}  // namespace sluice
