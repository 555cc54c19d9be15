// Parts of a law that a deck chooses by the attribute `type` of a child.
#pragma once
#include <string>
#include <vector>

#include "mpm/material/base/parameters.hpp"

namespace sluice::mpm {

// One value of `type` and the tags that go with it.
struct Part {
  std::string type;
  Tags tags;
};

// The description of <name type=> for help and spelling. `not_supported`: types of the format.
TagSpec submodel_tag(std::string name, std::string doc, const std::vector<Part>& parts,
                     const std::vector<std::string>& not_supported = {});

// Which part the child <name> of a model chooses; -1 where there is no such child (`by_default`
// then counts) or it is bad, which is told.
struct ChosenSubmodel {
  int index = -1;
  bool written = false;
};
ChosenSubmodel choose_submodel(const Parameters& model, const std::string& name,
                               const std::vector<Part>& parts,
                               const std::vector<std::string>& not_supported = {});
// The numbers inside the chosen part.
Parameters inside_submodel(const Parameters& model, const std::string& name, const Part& part);

}  // namespace sluice::mpm
