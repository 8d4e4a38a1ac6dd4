// SPDX-License-Identifier: Apache-2.0
/// The built semview-server, started and listening.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/child_process.hpp"

namespace semview::testing {

class RunningServer : public ChildProcess {
 public:
  RunningServer(std::vector<std::string> arguments, const std::filesystem::path& files)
      : ChildProcess("semview-server", std::move(arguments), files) {
    const std::string prefix = "listening on ";
    EXPECT_TRUE(says(prefix)) << errors();
    const std::string line = output().substr(0, output().find('\n'));
    EXPECT_TRUE(line.starts_with(prefix)) << line;
    if (line.starts_with(prefix)) endpoint_ = line.substr(prefix.size());
  }

  const std::string& endpoint() const { return endpoint_; }

 private:
  std::string endpoint_;
};

}  // namespace semview::testing
