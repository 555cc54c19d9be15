// The named values from which an exact solution is made, in SI units, read with the number rules of
// a deck.
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice::exact {

class SolutionParameters {
 public:
  SolutionParameters(std::string type, std::map<std::string, std::string> values)
      : type_(std::move(type)), values_(std::move(values)) {}

  const std::string& type() const { return type_; }
  bool has(const std::string& name) const { return values_.contains(name); }

  // The value of a parameter; InputError when it is missing or not of this form.
  double real(const std::string& name) const;
  double real(const std::string& name, double fallback) const;
  double positive(const std::string& name) const;
  double positive(const std::string& name, double fallback) const;
  int integer(const std::string& name, int fallback, int low, int high) const;
  Vec3 vector(const std::string& name) const;
  Vec3 vector(const std::string& name, Vec3 fallback) const;
  std::vector<double> reals(const std::string& name) const;
  std::vector<double> state(const std::string& name) const;  // [density, velocity, pressure]
  const std::string& words(const std::string& name) const { return text(name); }

  // Throws InputError naming the first given parameter that nobody asked for.
  void refuse_unused() const;

 private:
  const std::string& text(const std::string& name) const;
  [[noreturn]] void refuse(const std::string& name, const std::string& expected) const;

  std::string type_;
  std::map<std::string, std::string> values_;
  mutable std::set<std::string> used_;
};

}  // namespace sluice::exact
