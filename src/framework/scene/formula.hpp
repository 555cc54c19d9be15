// Formulas of x, y, z in m (and named constants) that decks use for initial states; the value has
// the unit of what it replaces.
//
// Operators + - * / ^, comparisons, && ||, ?:, functions sin cos tan asin acos atan atan2 sinh cosh
// tanh exp log log10 sqrt abs min max sign floor ceil; constants pi and e; angles in radians.
#pragma once
#include <map>
#include <memory>
#include <string>

#include "framework/deck/deck.hpp"

namespace sluice {

class Formula {
 public:
  // InputError with the text and a mark under the place of the fault.
  explicit Formula(const std::string& text, const std::map<std::string, double>& constants = {});
  ~Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;

  double operator()(Vec3 p) const;  // not for two threads at once
  const std::string& text() const { return text_; }

 private:
  struct Engine;
  std::string text_;
  std::unique_ptr<Engine> engine_;
};

}  // namespace sluice
