// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/run_signal.h"

#include <csignal>

namespace spslam {
namespace {

// A signal's handler can reach nothing but this.
volatile std::sig_atomic_t signal_received = 0;
extern "C" void on_run_signal(int signal) {
  signal_received = signal;
}

}  // namespace

void watch_for_interruption() {
  struct sigaction action = {};
  action.sa_handler = on_run_signal;
  action.sa_flags = SA_RESTART;  // reads and writes under way go on
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction present = {};
  sigaction(SIGHUP, nullptr, &present);
  if (present.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

int interruption() {
  return signal_received;
}

}  // namespace spslam
