// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Runs the built program as a user does.
#pragma once

#include <string>
#include <vector>

#include "base/temporary_folder.h"

namespace spslam {

struct ProcessResult {
  int exit_code = -1;  // 128 + the signal if one ended it
  std::string out;
  std::string err;
};

using test::TemporaryFolder;

std::string read_file(const std::string& path);

// `spslam arguments...` while it runs. wait() must be called once.
class RunningSpslam {
 public:
  // out: where stdout goes instead of to the result.
  explicit RunningSpslam(const std::vector<std::string>& arguments, const std::string& out = "");
  RunningSpslam(const RunningSpslam&) = delete;
  RunningSpslam& operator=(const RunningSpslam&) = delete;
  void send(int signal) const;
  ProcessResult wait();

 private:
  TemporaryFolder scratch_;
  int process_ = 0;
};

// Runs `spslam arguments...` and waits for its end.
ProcessResult run_spslam(const std::vector<std::string>& arguments, const std::string& out = "");

}  // namespace spslam
