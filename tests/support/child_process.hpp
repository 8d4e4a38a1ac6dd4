// SPDX-License-Identifier: Apache-2.0
/// A built program, run as its users run it.
#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/eventually.hpp"
#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

namespace semview::testing {

/// A child process whose output goes to files; killed at the end if it still runs.
class ChildProcess {
 public:
  /// `program` in the folder of built programs; output goes to `files`.out and `files`.err.
  ChildProcess(const std::string& program,
               std::vector<std::string> arguments,
               const std::filesystem::path& files)
      : out_(files.string() + ".out"), err_(files.string() + ".err") {
    std::string path = std::string(SEMVIEW_BINARY_DIR) + "/" + program;
    std::vector<char*> argv{path.data()};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    std::filesystem::remove(out_);
    std::filesystem::remove(err_);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(::open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDOUT_FILENO);
      ::dup2(::open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDERR_FILENO);
      ::execv(path.c_str(), argv.data());
      ::_exit(127);
    }
  }
  ~ChildProcess() {
    signal(SIGKILL);
    wait();
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Not to one that has ended: its number may be another's by now.
  void signal(int number) {
    if (!ended()) ::kill(pid_, number);
  }

  /// The exit code, or minus the signal that ended it; kNotEnded if it still runs after `patience`.
  int wait(std::chrono::seconds patience = std::chrono::seconds(600)) {
    return eventually([this] { return ended(); }, patience) ? *code_ : kNotEnded;
  }
  static constexpr int kNotEnded = -1000;

  std::string output() const { return file_bytes(out_); }
  std::string errors() const { return file_bytes(err_); }

  /// Waits until standard output or standard error holds `text`; false if it never does.
  bool says(std::string_view text, std::chrono::seconds patience = kPatience) {
    bool said = false;
    // What a program said before its end counts.
    const auto said_or_ended = [&] {
      const bool over = ended();
      said = output().find(text) != std::string::npos || errors().find(text) != std::string::npos;
      return said || over;
    };
    return eventually(said_or_ended, patience) && said;
  }

 private:
  bool ended() {
    if (code_) return true;
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) != pid_) return false;
    code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return true;
  }

  std::filesystem::path out_;
  std::filesystem::path err_;
  pid_t pid_ = -1;
  std::optional<int> code_;
};

}  // namespace semview::testing
