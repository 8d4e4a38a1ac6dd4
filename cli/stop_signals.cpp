// SPDX-License-Identifier: Apache-2.0
#include "stop_signals.hpp"

#include <csignal>

#include <unistd.h>

namespace semview::cli {
namespace {

volatile std::sig_atomic_t g_stop_asked = 0;
/// Made before the signal: a handler may not allocate.
std::string g_last_words;

}  // namespace

void ask_to_stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { g_stop_asked = 1; };
  action.sa_flags = SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void say_when_stopped(const std::string& line) {
  g_last_words = "\nsemview: " + line + "\n";
  struct sigaction action {};
  action.sa_handler = [](int signal) {
    // Nothing can be done about words that do not get through.
    [[maybe_unused]] const ssize_t written =
        ::write(STDERR_FILENO, g_last_words.data(), g_last_words.size());
    ::raise(signal);  // by its default action, so that the caller sees who ended this
  };
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_asked() { return g_stop_asked != 0; }

}  // namespace semview::cli
