// SPDX-License-Identifier: Apache-2.0
/// A built program, run as its users run it.
#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

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
    if (!running_) return;
    ::kill(pid_, SIGKILL);
    wait();
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void signal(int number) const { ::kill(pid_, number); }

  /// The exit code, or minus the signal that ended it.
  int wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    running_ = false;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  std::string output() const { return file_bytes(out_); }
  std::string errors() const { return file_bytes(err_); }

  /// Waits until standard output or standard error holds `text`; false if it never does.
  bool says(std::string_view text, std::chrono::seconds patience = std::chrono::seconds(60)) const {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < end) {
      if (output().find(text) != std::string::npos || errors().find(text) != std::string::npos) {
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }

 private:
  std::filesystem::path out_;
  std::filesystem::path err_;
  pid_t pid_ = -1;
  bool running_ = true;
};

}  // namespace semview::testing
