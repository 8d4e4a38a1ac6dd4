// SPDX-License-Identifier: Apache-2.0
/// A built program, run to its end with a line of arguments as in a shell.
#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/wait.h>

#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

namespace semview::testing {

struct Outcome {
  int exit_code = -1;  ///< -1: it did not end by itself
  std::string answer;  ///< standard output, what a script reads
  std::string output;  ///< that, and then standard error; slow runs tell there how far they are
};

inline Outcome run_command(const std::string& command) {
  Outcome outcome;
  const TemporaryFolder folder;
  const std::filesystem::path errors = folder / "errors";
  std::FILE* pipe = ::popen(("{ " + command + "\n} 2>'" + errors.string() + "'").c_str(), "r");
  if (pipe == nullptr) return outcome;
  std::array<char, 4096> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe)) {
    outcome.answer.append(block.data(), count);
  }
  const int status = ::pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  std::ifstream said(errors, std::ios::binary);
  outcome.output = outcome.answer + std::string(std::istreambuf_iterator<char>(said), {});
  return outcome;
}

inline Outcome run_semview(const std::string& arguments) {
  return run_command("'" SEMVIEW_BINARY_DIR "/semview' " + arguments);
}

}  // namespace semview::testing
