// SPDX-License-Identifier: Apache-2.0
#include "semview/service/shipped_weights.hpp"

#include <system_error>

#include "semview/io/text_file.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::service {

Result<std::string> shipped_weights_csv(const std::filesystem::path& map_directory) {
  const std::filesystem::path path = map_directory / "weights.csv";
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::string();
  return io::read_text_file(path, similarity::kMaxWeightFileBytes);
}

}  // namespace semview::service
