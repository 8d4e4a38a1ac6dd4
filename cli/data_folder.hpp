// SPDX-License-Identifier: Apache-2.0
/// The data that are installed with the programs.
#pragma once

#include <filesystem>

namespace semview::cli {

/// `share/semview` beside the folder of this program, installed or in the build tree; it need not
/// be there.
std::filesystem::path data_folder();

}  // namespace semview::cli
