// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/run_results.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include "spslam/base/error.h"

namespace spslam {

std::optional<Evaluation> evaluate_run(const Dataset& dataset, const RunRecord& record) {
  if (!dataset.ground_truth()) return std::nullopt;
  EvaluationOptions options;
  options.planar = dataset.planar_ground_truth();
  options.association.interpolate = options.planar;  // a GNSS receiver is slower than the camera
  try {
    Evaluation evaluation = evaluate(stamped_trajectory(record.trajectory), *dataset.ground_truth(), options);
    for (const std::string& warning : evaluation.warnings) spdlog::info("errors: {}", warning);
    return evaluation;
  } catch (const InputError& error) {
    spdlog::warn("no errors are computed: {}", error.what());
    return std::nullopt;
  }
}

void Attempts::attempt(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    failures_.emplace_back(error.what());
  }
}

void Attempts::throw_failures() const {
  if (failures_.empty()) return;
  if (failures_.size() == 1) throw OutputError(failures_.front());
  std::string text = fmt::format("{} things failed, the rest is done:", failures_.size());
  for (const std::string& failure : failures_) text += "\n  " + failure;
  throw OutputError(text);
}

void write_results(const ResultFolder& folder, const Dataset& dataset, const RunRecord& record,
                   const std::optional<Evaluation>& evaluation, Attempts& attempts) {
  const auto write = [&](const char* name, const std::string& text) {
    attempts.attempt([&] { folder.write(name, text); });
  };
  write("trajectory_tum.txt", format_tum(stamped_trajectory(record.trajectory)));
  const Trajectory rows = trajectory_of_every_frame(record);
  write("trajectory_kitti.txt", format_kitti_poses(rows));
  write("trajectory_kitti_times.txt", times_text(rows));
  write("frames.csv", frames_csv(record));
  write("covariance.csv", covariance_csv(record));
  write("keyframes.csv", keyframes_csv(record));
  write("mapping.csv", mapping_csv(record));
  write("loops.csv", loops_csv(record));
  write("timing.json", timing_json(record, dataset.description()));
  if (evaluation) write("metrics.json", json_report(*evaluation));
}

}  // namespace spslam
