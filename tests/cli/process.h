// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Runs the built program as a user does.
#pragma once

#include <string>
#include <vector>

namespace spslam {

struct ProcessResult {
  int exit_code = -1;  // 128 + the signal if one ended it
  std::string out;
  std::string err;
};

// A folder for one test's files, removed with it.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string write(const std::string& name, const std::string& text) const;  // returns the path

 private:
  std::string folder_;
};

std::string read_file(const std::string& path);

// `spslam arguments...` while it runs. wait() must be called once.
class RunningSpslam {
 public:
  explicit RunningSpslam(const std::vector<std::string>& arguments);
  RunningSpslam(const RunningSpslam&) = delete;
  RunningSpslam& operator=(const RunningSpslam&) = delete;
  void send(int signal) const;
  ProcessResult wait();

 private:
  ScratchFolder scratch_;
  int process_ = 0;
};

// Runs `spslam arguments...` and waits for its end.
ProcessResult run_spslam(const std::vector<std::string>& arguments);

}  // namespace spslam
