// The numbers that a deck gives a constitutive model, or one of its parts, in the units that the
// descriptions of their tags say.
//
// A model describes its tags once, as a list of TagSpec. Here an element is held against that list:
// what is missing, out of range or misspelt is told with its line, what the model never reads is a
// warning. Then values are asked for by name; defaults come from the description.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "framework/base/vec3.hpp"
#include "framework/deck/deck.hpp"
#include "framework/deck/schema.hpp"
#include "mpm/material/base/material.hpp"

namespace sluice::mpm {

// Tags of the same element in several models.
using Tags = std::vector<TagSpec>;

// A required number greater than 0, one of any size, and one with a default.
TagSpec positive(std::string name, std::string doc);
TagSpec number(std::string name, std::string doc);
TagSpec number(std::string name, std::string doc, double default_value);
TagSpec positive_or(std::string name, std::string doc, double default_value);
TagSpec choice(std::string name, std::string doc, bool default_value);
// <objective>, default true: whether stress turns with the particle in laws of rate form.
TagSpec objective_tag();

// What a model knows of its material beside its own element.
struct MaterialContext {
  MaterialConstants constants;
  bool erodes = false;  // failed particles lose their strength: models look for failure
};

class Parameters {
 public:
  // `owner`: how messages call the model, "comp_neo_hook". The node and the tags must outlive this.
  Parameters(const DeckNode& node, std::string owner, const Tags& tags, MaterialContext context,
             std::vector<Fault>& faults);

  // Whether all that is written and needed can be read; else values must not be asked for.
  bool good() const { return good_; }

  // std::logic_error for a name that the tags do not describe.
  double real(std::string_view name) const;
  bool flag(std::string_view name) const;
  std::string word(std::string_view name) const;
  Vec3 vector(std::string_view name) const;
  std::vector<double> reals(std::string_view name) const;
  bool has(std::string_view name) const { return node_->child(name) != nullptr; }
  const DeckNode* block(std::string_view name) const { return node_->child(name); }

  const DeckNode& node() const { return *node_; }
  const std::string& owner() const { return owner_; }
  const MaterialContext& context() const { return context_; }
  const MaterialConstants& constants() const { return context_.constants; }
  std::vector<Fault>& faults() const { return *faults_; }

  // At the line of the tag, or of the element where it is not written.
  void error(std::string_view name, std::string message, std::string suggestion = {}) const;

 private:
  void check(const DeckNode& child, const TagSpec& spec);
  const TagSpec& described(std::string_view name) const;
  std::string text(std::string_view name) const;

  const DeckNode* node_;
  std::string owner_;
  const Tags* tags_;
  MaterialContext context_;
  std::vector<Fault>* faults_;
  bool good_ = true;
};

// A fault at this place that is an error: the same need not be told twice.
bool error_at(const std::vector<Fault>& faults, const Location& where);

// One of several parts that an element's attribute `type` chooses from; see metal_parts.hpp.
// The union of the tags of all parts, each with what it means to which, for checks of spelling.
TagSpec choice_tag(std::string name, std::string doc,
                   const std::vector<std::pair<std::string, const Tags*>>& parts,
                   const std::vector<std::string>& never_read = {});

}  // namespace sluice::mpm
