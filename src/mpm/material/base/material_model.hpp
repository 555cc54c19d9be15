// A row of the table of constitutive models (mpm/material/materials.hpp): the name in a deck, the
// tags, and how the law is made of them.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/deck/schema.hpp"
#include "mpm/material/base/material.hpp"
#include "mpm/material/base/parameters.hpp"

namespace sluice::mpm {

struct MaterialModel {
  std::string name;                  // in <constitutive_model type=>
  std::vector<std::string> aliases;  // other spellings of it
  std::string doc;                   // one sentence
  Tags tags;
  // The tags are good when this is called. Null after adding faults.
  std::shared_ptr<const Material> (*make)(const Parameters& parameters);
};

}  // namespace sluice::mpm
