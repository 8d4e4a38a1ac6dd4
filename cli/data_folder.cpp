// SPDX-License-Identifier: Apache-2.0
#include "data_folder.hpp"

#include <system_error>

namespace semview::cli {

std::filesystem::path data_folder() {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return (program.parent_path() / SEMVIEW_DATA_FROM_BIN).lexically_normal();
}

}  // namespace semview::cli
