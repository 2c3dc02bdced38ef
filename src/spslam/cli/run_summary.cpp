// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/run_summary.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <map>

namespace spslam {
namespace {

constexpr std::size_t kMostReasons = 3;

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// What reasons are counted by: "only 12 points agree" as "only # points agree"; "2.1" is one number.
std::string without_numbers(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_digit(text[i])) {
      out += text[i];
      continue;
    }
    out += '#';
    while (i + 1 < text.size() &&
           (is_digit(text[i + 1]) || (text[i + 1] == '.' && i + 2 < text.size() && is_digit(text[i + 2]))))
      ++i;
  }
  return out;
}

std::string text_of(const ReasonCount& count) {
  return count.reason + (count.others ? " (or with other numbers)" : "");
}

// How long a frame has been lost says nothing of why.
std::string reason_of(const FrameRecord& frame) {
  const std::string& reason = frame.result.reason;
  const std::size_t behind = reason.starts_with("lost for ") ? reason.find(" s: ") : std::string::npos;
  if (reason.empty()) return "no reason given";
  return behind == std::string::npos ? reason : reason.substr(behind + 4);
}

std::string reasons_line(const RunRecord& record) {
  const std::vector<ReasonCount> reasons = reasons_of_untracked(record);
  std::string text;
  for (std::size_t i = 0; i < std::min(kMostReasons, reasons.size()); ++i)
    text +=
        fmt::format("{:<12} {} x {}\n", i == 0 ? "not tracked" : "", reasons[i].frames, text_of(reasons[i]));
  if (reasons.size() > kMostReasons)
    text += fmt::format("{:<12} and {} other reasons, in frames.csv\n", "", reasons.size() - kMostReasons);
  return text;
}

std::string way_line(const RunRecord& record) {
  const int parts = stretches(record.trajectory);
  return fmt::format(
      "way          {:.3f} m{}\n", path_length(stamped_trajectory(record.trajectory)),
      parts > 1 ? fmt::format(" in {} stretches, between which the camera was lost", parts) : "");
}

}  // namespace

std::string state_counts(const RunRecord& record) {
  std::string text;
  for (const TrackStatus status :
       {TrackStatus::kTracking, TrackStatus::kCoasting, TrackStatus::kLost, TrackStatus::kInitializing}) {
    const auto count = std::count_if(record.frames.begin(), record.frames.end(),
                                     [&](const FrameRecord& f) { return f.result.status == status; });
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, state_name(status));
  }
  return text.empty() ? "none" : text;
}

std::vector<ReasonCount> reasons_of_untracked(const RunRecord& record) {
  std::map<std::string, ReasonCount> by_kind;
  for (const FrameRecord& frame : record.frames) {
    if (frame.result.status == TrackStatus::kTracking) continue;
    const std::string reason = reason_of(frame), kind = without_numbers(reason);
    ReasonCount& count = by_kind.try_emplace(kind, ReasonCount{reason, 0, false}).first->second;
    count.others = count.others || reason != count.reason;
    ++count.frames;
  }
  std::vector<ReasonCount> all;
  for (const auto& [kind, count] : by_kind) all.push_back(count);
  std::stable_sort(all.begin(), all.end(),
                   [](const ReasonCount& a, const ReasonCount& b) { return a.frames > b.frames; });
  return all;
}

int stretches(const std::vector<TrajectoryPose>& trajectory) {
  int count = 0;
  const TrajectoryPose* before = nullptr;  // of the present stretch
  for (const TrajectoryPose& pose : trajectory) {
    // While localizing, frames that were lost are not in the trajectory.
    const bool goes_on = before && pose.frame.value == before->frame.value + 1;
    before = pose.status == TrackStatus::kLost ? nullptr : &pose;
    if (before && !goes_on) ++count;
  }
  return count;
}

std::string nothing_tracked(const RunRecord& record) {
  for (const FrameRecord& frame : record.frames)
    if (frame.result.status == TrackStatus::kTracking) return "";
  const std::vector<ReasonCount> reasons = reasons_of_untracked(record);
  if (reasons.empty()) return "no frame was given";
  return fmt::format("none of the {} frames could be tracked; {} of them because: {}", record.frames.size(),
                     reasons.front().frames, text_of(reasons.front()));
}

std::string report_text(const std::string& folder, const RunRecord& record,
                        const std::optional<Evaluation>& evaluation) {
  std::string text = fmt::format("frames       {} ({}); {} keyframes, {} landmarks\n", record.frames.size(),
                                 state_counts(record), record.keyframes.size(), record.landmarks);
  text += reasons_line(record) + way_line(record);
  text += fmt::format("speed        {:.1f} frames/s, median {:.1f} ms a frame, peak memory {:.0f} MB\n",
                      static_cast<double>(record.frames.size()) / std::max(1e-9, record.wall_seconds),
                      median_frame_ms(record), peak_memory_mb());
  if (evaluation) text += brief_report(*evaluation);
  return text + "results      " + folder + "\n";
}

}  // namespace spslam
