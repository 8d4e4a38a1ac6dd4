// SPDX-License-Identifier: Apache-2.0
/// A test that runs `semview` on files of its own.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace semview::testing {

using Arguments = std::vector<std::string>;

class SemviewRuns : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// The exit code; what was printed is in `output_` and `errors_`.
  int run(const Arguments& arguments) {
    ChildProcess process("semview", arguments, folder_ / "streams");
    const int code = process.wait();
    output_ = process.output();
    errors_ = process.errors();
    return code;
  }

  TemporaryFolder folder_;
  std::string output_;
  std::string errors_;
};

}  // namespace semview::testing
