// Collecting what is wrong with a deck.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/deck/deck.hpp"

namespace sluice {

// A fault of the deck that shows only when its run is made ready, or its cells are filled.
class DeckError : public InputError {
 public:
  DeckError(const Location& where, const std::string& message, const std::string& suggestion)
      : InputError(to_string(where) + ": " + message +
                   (suggestion.empty() ? "" : "; " + suggestion)),
        fault_{Severity::error, where, message, suggestion} {}
  const Fault& fault() const { return fault_; }

 private:
  Fault fault_;
};

inline void add_error(std::vector<Fault>& faults, const Location& where, std::string message,
                      std::string suggestion = {}) {
  faults.push_back({Severity::error, where, std::move(message), std::move(suggestion)});
}
inline void add_warning(std::vector<Fault>& faults, const Location& where, std::string message,
                        std::string suggestion = {}) {
  faults.push_back({Severity::warning, where, std::move(message), std::move(suggestion)});
}
// `what` is a part of the format that is not built.
inline void add_not_built(std::vector<Fault>& faults, const Location& where,
                          const std::string& what, std::string suggestion = {}) {
  add_error(faults, where, what + " is known to the format, but not supported yet",
            std::move(suggestion));
  faults.back().not_built = true;
}

}  // namespace sluice
