// SPDX-License-Identifier: Apache-2.0
/// A built program, run to its end with a line of arguments as in a shell.
#pragma once

#include <array>
#include <cstdio>
#include <string>

#include <sys/wait.h>

#include "support/paths.hpp"

namespace semview::testing {

struct Outcome {
  int exit_code = -1;  ///< -1: it did not end by itself
  std::string output;  ///< standard output and standard error
};

inline Outcome run_command(const std::string& command) {
  Outcome outcome;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return outcome;
  std::array<char, 4096> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe)) {
    outcome.output.append(block.data(), count);
  }
  const int status = ::pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

inline Outcome run_semview(const std::string& arguments) {
  return run_command("'" SEMVIEW_BINARY_DIR "/semview' " + arguments);
}

}  // namespace semview::testing
