// Every deck of the collection named by SLUICE_DECKS ends as good, as not built yet, or with a
// fault that is really there (listed below, one row a deck).
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "app/loading/sluice_schema.hpp"
#include "framework/base/test_support/environment.hpp"
#include "framework/deck/load_deck.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::peer_decks_test {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t decks_expected = 400;
constexpr std::size_t decks_promised = 137;

// Decks with a real fault, and a piece of the message that each must give.
const std::map<std::string, std::string> faulty = {
    {"inputs/ICE/DNS_Moser_Re_tau395.ups", "there is no variable 'scalar-f'"},  // no model has it
    {"inputs/ICE/impVortex.ups", "there is no material 'atmosphere'"},
    {"inputs/MPM/ARL/AMR_nano_pillar.ups", "'gao_diffusion' is not a valid word"},
    {"inputs/MPM/multidisks.ups", "'inputs/MPM/disks_include1.ups' does not exist"},
    {"inputs/MPM/sidecrack.ups", "<crack> does not exist in <MPM>"},
    {"inputs/MPM/GranularMPM/Silo_empty_MPM_ConialHopper.ups", "XML: StartTag"},
    {"inputs/MPM/GranularMPM/Y_Pipe_05.ups", "does not exist"},
    {"inputs/MPM/Scripts/CylGen/TestCylGen.ups", "included file 'Test2D.xml' does not exist"},
    {"inputs/MPM/Scripts/CylGen/TestMMCylGen.ups", "included file 'Test2D.0.xml' does not exist"},
    {"inputs/Models/CH4Fire_container.ups", "there is no material 4"},
    {"inputs/Models/JP8Fire_containerAddProdMatl.ups", "<momentum> has 6 coefficients"},
    {"inputs/Models/explodeJCVMEPKSPB.ups", "<momentum> has 10 coefficients"},
    {"inputs/MPMICE/NG_nozzle/NG_Nozzle.ups", "'1 0.0' is not a number"},
    {"inputs/UintahRelease/MPM/WSphereIntoSteel.axi.ups", "does not exist"},
};

// Decks that must be good as they stand: the first word of each line that is no comment.
std::vector<std::string> promised_decks() {
  std::ifstream list(SLUICE_SOURCE_DIR "/regression/promised_decks.txt");
  std::vector<std::string> names;
  for (std::string line; std::getline(list, line);) {
    const std::string name = line.substr(0, line.find_first_of(" #"));
    if (!name.empty()) names.push_back("inputs/" + name);
  }
  return names;
}

class PeerDecks : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::optional<fs::path> folder = folder_in_environment("SLUICE_DECKS");
    if (!folder) GTEST_SKIP() << "SLUICE_DECKS is not set: no collection of decks";
    back_ = fs::current_path();
    fs::current_path(*folder);
  }
  void TearDown() override {
    if (!back_.empty()) fs::current_path(back_);
  }

 private:
  fs::path back_;
};

TEST_F(PeerDecks, EndAsGoodNotBuiltOrTrulyFaulty) {
  const Schema schema = sluice_schema();
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator("inputs")) {
    if (entry.path().extension() != ".ups") continue;
    ++count;
    const std::string file = entry.path().string();
    const Deck deck = load_deck(file, {}, schema);
    const auto expected = faulty.find(file);
    bool found = expected == faulty.end();
    for (const Fault& fault : deck.faults) {
      if (!found) found = fault.message.find(expected->second) != std::string::npos;
      const bool real = fault.severity == Severity::error && !fault.not_built;
      EXPECT_FALSE(real && expected == faulty.end()) << to_string(fault);
      EXPECT_FALSE(fault.message.empty());
    }
    EXPECT_TRUE(found) << file << ": expected " << expected->second;
  }
  EXPECT_GE(count, decks_expected);
}

TEST_F(PeerDecks, ThatMustRunAreGood) {
  const Schema schema = sluice_schema();
  EXPECT_GE(promised_decks().size(), decks_promised);
  for (const std::string& file : promised_decks()) {
    const Deck deck = load_deck(file, {}, schema);
    EXPECT_TRUE(deck.good()) << file;
    for (const Fault& fault : deck.faults) {
      EXPECT_NE(fault.severity, Severity::error) << to_string(fault);
    }
  }
}

TEST(OwnDecks, AreGoodWithoutAWarning) {
  const Schema schema = sluice_schema();
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(SLUICE_SOURCE_DIR "/inputs")) {
    if (entry.path().extension() != ".ups") continue;
    if (entry.path().parent_path().filename() == "drive") continue;  // of `sluice drive`
    ++count;
    const Deck deck = load_deck(entry.path().string(), {}, schema);
    EXPECT_TRUE(deck.good()) << entry.path();
    for (const Fault& fault : deck.faults) ADD_FAILURE() << to_string(fault);
  }
  EXPECT_GT(count, 0u);
}

// Tags that were dropped, old names of tags, values and variables, and names of files that lie
// elsewhere are not in what is written.
std::ptrdiff_t lasting_faults(const Deck& deck) {
  return std::count_if(deck.faults.begin(), deck.faults.end(), [](const Fault& fault) {
    return fault.message.find("; dropped") == std::string::npos &&
           fault.message.find("; read as") == std::string::npos &&
           fault.message.find("; merged with") == std::string::npos &&
           fault.message.find("is an integer; read as") == std::string::npos &&
           fault.message.find("does not exist; '") == std::string::npos &&
           fault.message.find(" is saved, which is ") == std::string::npos &&
           fault.message.find(" is now ") == std::string::npos;
  });
}

// What is read back from the XML of a checked deck is the same deck.
TEST_F(PeerDecks, SurviveBeingWrittenAndReadAgain) {
  const Schema schema = sluice_schema();
  for (const std::string& file : promised_decks()) {
    const Deck deck = load_deck(file, {}, schema);
    ASSERT_NE(deck.root, nullptr);
    const std::string xml = to_xml(*deck.root);
    const Deck again = load_deck_text(xml, file, {}, schema);
    ASSERT_TRUE(again.good()) << file << to_string(again.faults.front());
    EXPECT_EQ(lasting_faults(again), lasting_faults(deck)) << file;
    EXPECT_EQ(to_xml(*again.root), xml) << file;
  }
}

}  // namespace
}  // namespace sluice::peer_decks_test
