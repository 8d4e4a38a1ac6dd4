// SPDX-License-Identifier: Apache-2.0
/// The built programs as processes, for end-to-end tests.
#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/paths.hpp"

namespace semview::testing {

/// A started program of the build; ended with SIGKILL if it still runs when this goes.
class Program {
 public:
  /// Starts `bin/<name>` with its standard output and error in `<output>.out` and `<output>.err`.
  Program(const std::string& name,
          const std::vector<std::string>& arguments,
          std::filesystem::path output)
      : output_(std::move(output)) {
    const std::string path = std::string(SEMVIEW_BINARY_DIR) + "/" + name;
    const std::string out = output_.string() + ".out";
    const std::string err = output_.string() + ".err";
    std::vector<char*> argv{const_cast<char*>(path.c_str())};
    for (const std::string& argument : arguments) {
      argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDOUT_FILENO);
      dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDERR_FILENO);
      execv(path.c_str(), argv.data());
      _exit(127);
    }
  }
  ~Program() {
    signal(SIGKILL);
    wait();
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void signal(int number) const {
    if (pid_ > 0) kill(pid_, number);
  }

  /// Waits for its end. @return the exit code; 128 + the signal that ended it
  int wait() {
    if (pid_ > 0) {
      int status = 0;
      waitpid(pid_, &status, 0);
      exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      pid_ = 0;
    }
    return exit_code_;
  }

  std::string out() const { return read(output_.string() + ".out"); }
  std::string err() const { return read(output_.string() + ".err"); }

  static std::string read(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::filesystem::path output_;
  pid_t pid_ = 0;
  int exit_code_ = -1;
};

/// Runs a program to its end.
inline int run(const std::string& name,
               const std::vector<std::string>& arguments,
               const std::filesystem::path& output) {
  return Program(name, arguments, output).wait();
}

/// What follows "listening on " in the server's output: its endpoint. Empty if the server says
/// nothing within half a minute.
inline std::string endpoint_of(const Program& server) {
  constexpr std::string_view kListening = "listening on ";
  for (int i = 0; i < 600; ++i) {
    const std::string out = server.out();
    const std::size_t at = out.find(kListening);
    const std::size_t end =
        at == std::string::npos ? at : out.find_first_of(" \n", at + kListening.size());
    if (end != std::string::npos)
      return out.substr(at + kListening.size(), end - at - kListening.size());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return {};
}

}  // namespace semview::testing
