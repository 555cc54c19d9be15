// The parameter tree of a deck of Peridigm, from XML (<ParameterList>, <Parameter name type value>)
// or YAML, each entry with its place.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice::peridynamics {

struct Parameter {
  std::string name, text;
  Location where;
  bool is_list = false;
  std::vector<Parameter> children;
  mutable bool known = false;  // somebody has asked for it

  // Null: there is none. What is found counts as known.
  const Parameter* find(std::string_view child) const;
};

// The list that holds Discretization, Materials, ...; InputError where the file cannot be read.
Parameter read_parameters(const std::string& file);
Parameter read_parameters_text(const std::string& text, bool yaml, const std::string& shown_name);

}  // namespace sluice::peridynamics
