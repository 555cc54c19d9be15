// Files of hard cases and studies with random faults are read, or refused with a message that names
// the file; nothing else happens.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "app/stability/stability_case.hpp"
#include "app/study/study.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::mutated_files_test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> texts_in(const std::string& folder, const std::string& extension) {
  std::vector<std::string> texts;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != extension) continue;
    std::ifstream file(entry.path());
    texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return texts;
}

// A few characters changed, dropped, doubled, or a piece moved.
std::string mutated(std::string text, std::mt19937& random) {
  const auto at = [&] { return random() % (text.size() + 1); };
  for (unsigned n = 0; n < 1 + random() % 4 && !text.empty(); ++n) {
    const std::size_t from = at(), length = random() % 30;
    const std::string piece = text.substr(std::min(from, text.size()), length);
    switch (random() % 4) {
      case 0:
        text.erase(std::min(from, text.size()), length);
        break;
      case 1:
        text.insert(at(), piece);
        break;
      case 2:
        text.insert(at(), 1, "{}[]\":,0e-.\n/"[random() % 13]);
        break;
      default:
        if (from < text.size()) text[from] = static_cast<char>(random() % 256);
    }
  }
  return text;
}

template <class Read>
void expect_read_or_refused(const std::vector<std::string>& texts, const std::string& name,
                            Read&& read) {
  ASSERT_FALSE(texts.empty());
  const TemporaryFolder folder;
  const std::string file = (folder / name).string();
  std::mt19937 random(7);
  int refused = 0;
  constexpr int files = 1500;
  for (int n = 0; n < files; ++n) {
    std::ofstream(file) << mutated(texts[random() % texts.size()], random);
    try {
      read(file);
    } catch (const InputError& fault) {
      EXPECT_NE(std::string(fault.what()).find(name), std::string::npos) << fault.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, files / 4);
}

TEST(MutatedFiles, HardCasesAreReadOrRefused) {
  expect_read_or_refused(texts_in(SLUICE_SOURCE_DIR "/regression/stability", ".stability"),
                         "mutated.stability",
                         [](const std::string& file) { points_of(read_stability_case(file)); });
}

TEST(MutatedFiles, StudiesAreReadOrRefused) {
  expect_read_or_refused(texts_in(SLUICE_SOURCE_DIR "/regression/accuracy", ".study"),
                         "mutated.study",
                         [](const std::string& file) { points_of(read_study(file)); });
}

}  // namespace
}  // namespace sluice::mutated_files_test
