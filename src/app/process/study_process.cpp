#include "app/process/study_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <deque>
#include <fstream>
#include <system_error>

#include "framework/base/error.hpp"

extern char** environ;

namespace sluice {
namespace {

// File actions that send stdout and stderr to one file; freed with the object.
class Redirection {
 public:
  explicit Redirection(const std::filesystem::path& output) {
    posix_spawn_file_actions_init(&actions_);
    if (output.empty()) return;
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, output.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
  }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;
  ~Redirection() { posix_spawn_file_actions_destroy(&actions_); }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

// Our own environment, with the request's names set anew.
std::vector<std::string> environment_of(const ProcessRequest& request) {
  std::vector<std::string> out = request.environment;
  for (char** e = environ; *e; ++e) {
    const std::string entry = *e;
    const std::string name = entry.substr(0, entry.find('=') + 1);
    bool replaced = false;
    for (const std::string& given : request.environment) {
      replaced = replaced || given.compare(0, name.size(), name) == 0;
    }
    if (!replaced) out.push_back(entry);
  }
  return out;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> out;
  for (std::string& text : texts) out.push_back(text.data());
  out.push_back(nullptr);
  return out;
}

}  // namespace

int run_process(const ProcessRequest& request) {
  std::vector<std::string> words = request.words, variables = environment_of(request);
  const Redirection redirection(request.output);
  pid_t child = 0;
  const int fault = ::posix_spawn(&child, words.at(0).c_str(), redirection.get(), nullptr,
                                  pointers(words).data(), pointers(variables).data());
  if (fault != 0) {
    throw SystemError(fmt::format("cannot start {}: {}", words[0], std::strerror(fault)));
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      throw SystemError(fmt::format("waiting for {}: {}", words[0], std::strerror(errno)));
    }
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::filesystem::path own_executable() {
  std::error_code fault;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", fault);
  if (fault) {
    throw SystemError("cannot find this executable through /proc/self/exe: " + fault.message());
  }
  return path;
}

std::string last_lines(const std::filesystem::path& file, int count) {
  std::ifstream in(file);
  std::deque<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
    if (lines.size() > static_cast<std::size_t>(count)) lines.pop_front();
  }
  std::string out;
  for (const std::string& line : lines) out += (out.empty() ? "" : "\n") + line;
  return out;
}

}  // namespace sluice
