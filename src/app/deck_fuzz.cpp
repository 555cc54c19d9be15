// libFuzzer target: no text whatever may crash the reading and checking of a deck.
//
// The input is a deck; what follows a zero byte is an override. Build with the preset `fuzz`, run
//   deck_fuzz -max_len=8192 CORPUS src/framework/deck/bad_decks
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "app/loading/sluice_schema.hpp"
#include "framework/deck/load_deck.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sluice::Schema schema = sluice::sluice_schema();
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::string_view xml = input.substr(0, input.find('\0'));
  std::vector<std::string> overrides;
  if (xml.size() < input.size()) overrides.emplace_back(input.substr(xml.size() + 1));
  const sluice::Deck deck = sluice::load_deck_text(xml, "fuzz.ups", overrides, schema);
  std::size_t length = 0;
  for (const sluice::Fault& fault : deck.faults) length += to_string(fault).size();
  if (deck.good() && deck.root != nullptr) {
    // A good deck stays good when it is written and read again.
    const std::string again = to_xml(*deck.root);
    if (!sluice::load_deck_text(again, "again.ups", {}, schema).good()) __builtin_trap();
    length += again.size();
  }
  return length == static_cast<std::size_t>(-1) ? -1 : 0;
}
