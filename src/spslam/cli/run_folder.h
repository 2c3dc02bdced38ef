// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The folder of a run's results: refused, made and tried before anything is computed; each file appears whole
// or not at all.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace spdlog::sinks {
class sink;
}

namespace spslam {

// Below the results: pictures for the report.
inline constexpr const char* kSamplesFolder = "samples";

class ResultFolder {
 public:
  // Makes the folder and starts its log.txt, to which the process's logger writes as long as this lives.
  // With overwrite the results of an earlier run are removed first, other files stay. Throws OutputError if
  // the folder has anything else in it, or results (unless overwrite), is a file, or cannot be written to.
  ResultFolder(std::filesystem::path folder, bool overwrite);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  // Under a temporary name first; makes the folder that the name lies in. Throws OutputError; nothing is left
  // then.
  void write(const std::string& name, std::string_view text) const;

 private:
  void start_log();

  std::filesystem::path folder_;
  std::shared_ptr<spdlog::sinks::sink> log_;
};

}  // namespace spslam
