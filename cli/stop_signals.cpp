// SPDX-License-Identifier: Apache-2.0
#include "stop_signals.hpp"

#include <csignal>

namespace semview::cli {
namespace {

volatile std::sig_atomic_t g_stop_asked = 0;

}  // namespace

void ask_to_stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { g_stop_asked = 1; };
  action.sa_flags = SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_asked() { return g_stop_asked != 0; }

}  // namespace semview::cli
