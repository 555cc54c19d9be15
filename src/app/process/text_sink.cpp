// Checked writing to a file or to standard output.
#include "app/process/text_sink.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "framework/base/error.hpp"

namespace sluice {

TextSink::TextSink(const std::string& target)
    : target_(target == "-" ? "standard output" : target),
      file_(target == "-" ? stdout : std::fopen(target.c_str(), "w")) {
  if (!file_) fail();
}

TextSink::~TextSink() {
  if (file_ && file_ != stdout) std::fclose(file_);
}

void TextSink::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
}

void TextSink::close() {
  std::FILE* file = std::exchange(file_, nullptr);
  if ((file == stdout ? std::fflush(file) : std::fclose(file)) != 0) fail();
}

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault)
    throw SystemError(fmt::format("cannot make the folder {}: {}; name another with -o",
                                  folder.string(), fault.message()));
}

void write_text(const std::string& target, std::string_view text) {
  TextSink sink(target);
  sink.write(text);
  sink.close();
}

void TextSink::fail() const {
  throw SystemError(fmt::format("cannot write {}: {}; check the path and the free space", target_,
                                std::strerror(errno)));
}

}  // namespace sluice
