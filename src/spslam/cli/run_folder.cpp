// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/run_folder.h"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <fstream>

#include "spslam/base/error.h"
#include "spslam/io/text.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLogFile = "log.txt";
constexpr const char* kConfigFile = "config.yaml";
// Whatever a run, or a report on it, leaves.
constexpr const char* kResults[] = {"trajectory_tum.txt",
                                    "trajectory_kitti.txt",
                                    "trajectory_kitti_times.txt",
                                    "frames.csv",
                                    "covariance.csv",
                                    "keyframes.csv",
                                    "mapping.csv",
                                    "loops.csv",
                                    kConfigFile,
                                    "metrics.json",
                                    "timing.json",
                                    "report.html",
                                    kLogFile};

// Pictures only, and their folder if nothing else is in it.
void remove_samples(const fs::path& folder) {
  if (!fs::is_directory(folder)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with("frame_") && entry.path().extension() == ".png")
      fs::remove(entry.path());
  if (fs::is_empty(folder)) fs::remove(folder);
}

std::string first_line(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  std::getline(stream, line);
  return line;
}

bool is_our_log(const fs::path& file) {
  return first_line(file).find(" info spslam ") != std::string::npos;
}

// Names like config.yaml and log.txt are everybody's. Ours begin as ours do.
bool has_results_of_a_run(const fs::path& folder) {
  const fs::path config = folder / kConfigFile, log = folder / kLogFile;
  const bool has_config = fs::exists(config), has_log = fs::exists(log);
  return (has_config || has_log) && (!has_config || first_line(config).starts_with("# spslam ")) &&
         (!has_log || is_our_log(log));
}

// What a run leaves that failed before it began, on a full disk for example. Nothing is lost with it.
bool has_log_only(const fs::path& folder) {
  const fs::path log = folder / kLogFile;
  return std::all_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [&](const fs::directory_entry& entry) { return entry.path() == log; }) &&
         (fs::is_empty(log) || is_our_log(log));
}

void check_folder(const fs::path& folder, bool overwrite) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder))
    throw OutputError(folder.string() + " is a file; give a folder with --output");
  if (fs::is_empty(folder) || has_log_only(folder)) return;
  if (!has_results_of_a_run(folder))
    throw OutputError(
        folder.string() +
        " is not empty and has no results of a run (a config.yaml and a log.txt of spslam) that "
        "could be replaced; give another folder with --output");
  if (!overwrite)
    throw OutputError(folder.string() +
                      " is not empty; give another folder with --output, or --overwrite to replace the "
                      "results that are in it");
}

void prepare_folder(const fs::path& folder, bool overwrite) {
  check_folder(folder, overwrite);
  fs::create_directories(folder);
  for (const char* name : kResults) fs::remove(folder / name);
  remove_samples(folder / kSamplesFolder);
}

}  // namespace

ResultFolder::ResultFolder(fs::path folder, bool overwrite) : folder_(std::move(folder)) {
  try {
    prepare_folder(folder_, overwrite);
    start_log();
  } catch (const fs::filesystem_error& error) {
    throw OutputError(folder_.string() + " cannot be written to (" + error.code().message() +
                      "); give a folder of your own with --output");
  } catch (const spdlog::spdlog_ex& error) {
    throw OutputError(std::string(error.what()) + "; give a folder of your own with --output");
  }
}

// The file gets info and above, the terminal what it got before.
void ResultFolder::start_log() {
  log_ = std::make_shared<spdlog::sinks::basic_file_sink_mt>((folder_ / kLogFile).string(), true);
  log_->set_pattern("%Y-%m-%d %H:%M:%S.%e %l %v");
  log_->set_level(spdlog::level::info);
  spdlog::logger& logger = *spdlog::default_logger();
  for (const auto& sink : logger.sinks()) sink->set_level(std::max(sink->level(), logger.level()));
  logger.set_level(std::min(logger.level(), spdlog::level::info));
  logger.sinks().push_back(log_);
  logger.flush_on(spdlog::level::info);    // a log is read while its run lasts
  spdlog::info("spslam " SPSLAM_VERSION);  // by which the folder is known again as a run's
}

ResultFolder::~ResultFolder() {
  if (log_ == nullptr) return;
  log_->flush();
  std::erase(spdlog::default_logger()->sinks(), log_);
}

void ResultFolder::write(const std::string& name, std::string_view text) const {
  const fs::path temporary = folder_ / (name + ".partial");
  std::error_code code;
  fs::create_directories(temporary.parent_path(), code);
  try {
    write_text_file(temporary, text);
  } catch (const OutputError&) {
    fs::remove(temporary, code);
    throw;
  }
  fs::rename(temporary, folder_ / name, code);
  if (!code) return;
  const std::string why = code.message();
  fs::remove(temporary, code);
  throw OutputError((folder_ / name).string() + " cannot be written (" + why + ")");
}

}  // namespace spslam
