// An archive as the public suite's tools look at it: outputs counted from 0, patches from 1.
#pragma once
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "app/classic/classic_arguments.hpp"
#include "framework/archive/archive.hpp"
#include "framework/archive/particle_patches.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {

// From the first to the last output that is asked for, both counted from 0.
struct OutputRange {
  std::size_t first = 0, last = 0, step = 1;
};
// Of the options -timestep, -timesteplow, -timestephigh and -timestepinc under these names, as far
// as the tool has them. InputError where there is no such output.
struct RangeOptions {
  std::string only, low, high, increment;
};
OutputRange outputs_asked(const ClassicArguments& arguments, const Archive& archive,
                          const RangeOptions& names);

// InputError, with the names that there are, where the archive has no such variable.
const VariableEntry& need_variable(const Archive& archive, const std::string& name);

// Lists of a level and material, read when first asked for.
class ParticleLists {
 public:
  explicit ParticleLists(const ArchiveStep& step) : step_(step) {}
  // By component and particle; DamageError where the step does not hold them.
  const std::vector<std::vector<double>>& values(const std::string& name, const PatchParticles& at);
  bool has(const std::string& name, const PatchParticles& at) const;
  ValueType type(const std::string& name, const PatchParticles& at) const;
  const std::vector<std::int64_t>& integers(const std::string& name, const PatchParticles& at);
  Vec3 position(const PatchParticles& at, std::size_t place);

 private:
  using Key = std::tuple<std::string, int, int>;
  const FieldInfo& info(const std::string& name, const PatchParticles& at) const;
  const ArchiveStep& step_;
  std::map<Key, std::vector<std::vector<double>>> values_;
  std::map<Key, std::vector<std::int64_t>> integers_;
};

// As C++ streams print them: 1.50000000e+00; integers of integer variables.
std::string number_text(double value, int digits);
std::string value_text(ValueType type, double value, int digits);
std::string index_text(IntVec3 i);            // [int 1, 2, 3]
std::string point_text(Vec3 p, int digits);   // [1.0e+00 2.0e+00 3.0e+00]
std::string vector_text(Vec3 v, int digits);  // with a blank before and behind
// One value of a variable: a vector as above, nine numbers of a tensor.
std::string value_text(ValueType type, const std::vector<double>& components, int digits);

// Of the tools whose archive is -uda: it is there, and no word belongs to no option.
Archive archive_asked(const ClassicArguments& arguments);
// -pr, 1 to 32; 16 without it.
int digits_asked(const ClassicArguments& arguments);
// The level -l of the step's grid; InputError where it has none of this number.
const Level& level_asked(const ArchiveStep& step, int level);

}  // namespace sluice
