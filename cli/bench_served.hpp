// SPDX-License-Identifier: Apache-2.0
/// The server that `semview bench` measures.
#pragma once

#include "semview/benchmark/served_site.hpp"

namespace semview::cli {

/// In this process, on loopback and a free port, with clients over TCP.
benchmark::Serve serve_on_loopback();

}  // namespace semview::cli
