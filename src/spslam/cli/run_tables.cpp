// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/run_tables.h"

#include <spdlog/fmt/fmt.h>
#include <sys/resource.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "spslam/io/text.h"

namespace spslam {
namespace {

using Json = nlohmann::ordered_json;

struct Stage {
  const char* name;
  double StageTimes::*seconds;
};
constexpr Stage kStages[] = {{"front_end", &StageTimes::front_end}, {"follow", &StageTimes::follow},
                             {"motion", &StageTimes::motion},       {"window", &StageTimes::window},
                             {"keyframe", &StageTimes::keyframe},   {"total", &StageTimes::total}};

// In quotes if it must be; on one line.
std::string csv_text(std::string text) {
  for (char& c : text) c = c == '\n' || c == '\r' ? ' ' : c;
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// An empty field for what is not a number.
std::string csv_number(double value, int digits) {
  return std::isfinite(value) ? fixed_text(value, digits) : std::string();
}
std::string csv_small(double value) {
  return std::isfinite(value) ? scientific_text(value, 4) : std::string();
}

std::string frame_line(const FrameRecord& frame) {
  const TrackResult& r = frame.result;
  std::string line = std::to_string(frame.index);
  const auto add = [&](const std::string& field) { line.append(",").append(field); };
  add(fixed_text(r.timestamp, 9));
  add(state_name(r.status));
  add(csv_text(r.reason));
  for (const int count : {r.near, r.far, r.followed, r.with_disparity, r.on_trial, r.moving, r.inliers})
    add(std::to_string(count));
  add(csv_number(r.entropy, 4));
  add(csv_number(r.far_weight, 4));
  add(r.keyframe_id.valid() ? "1" : "0");
  add(r.keyframe_id.valid() ? csv_text(r.keyframe.reason()) : "");
  const bool has_pose = r.status != TrackStatus::kInitializing;
  add(has_pose ? csv_small(std::sqrt(r.covariance.topLeftCorner<3, 3>().trace())) : "");
  add(has_pose ? csv_small(std::sqrt(r.covariance.bottomRightCorner<3, 3>().trace())) : "");
  add(csv_number(1e3 * frame.decode_seconds, 3));
  for (const Stage& stage : kStages) add(csv_number(1e3 * r.seconds.*stage.seconds, 3));
  return line + "\n";
}

const FrameRecord* find_frame(const RunRecord& record, FrameId id) {
  for (const FrameRecord& frame : record.frames)
    if (frame.result.frame == id) return &frame;
  return nullptr;
}

bool was_usable(const FrameRecord& frame) {
  return frame.result.seconds.front_end > 0;
}

// The smallest value that a share of all does not exceed.
double quantile(const std::vector<double>& ascending, double share) {
  const double rank = std::ceil(share * static_cast<double>(ascending.size()));
  return ascending[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

Json spread_of(std::vector<double> seconds) {
  if (seconds.empty()) return nullptr;
  std::sort(seconds.begin(), seconds.end());
  double sum = 0;
  for (const double s : seconds) sum += s;
  return {{"mean", 1e3 * sum / static_cast<double>(seconds.size())},
          {"p50", 1e3 * quantile(seconds, 0.5)},
          {"p95", 1e3 * quantile(seconds, 0.95)},
          {"max", 1e3 * seconds.back()}};
}

std::vector<double> stage_seconds(const RunRecord& record, double StageTimes::*stage) {
  std::vector<double> seconds;
  for (const FrameRecord& frame : record.frames)
    if (was_usable(frame)) seconds.push_back(frame.result.seconds.*stage);
  return seconds;
}

double cpu_seconds() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

const char* state_name(TrackStatus status) {
  return option_names(status)[static_cast<std::size_t>(status)];
}

std::string frames_csv(const RunRecord& record) {
  std::string text =
      "frame,timestamp,state,reason,near,far,followed,with_disparity,on_trial,moving,inliers,entropy,"
      "far_weight,keyframe,keyframe_reason,sigma_translation_m,sigma_rotation_rad,decode_ms";
  for (const Stage& stage : kStages) text += fmt::format(",{}_ms", stage.name);
  text += "\n";
  for (const FrameRecord& frame : record.frames) text += frame_line(frame);
  return text;
}

std::string covariance_csv(const RunRecord& record) {
  constexpr const char* kAxes[] = {"tx", "ty", "tz", "rx", "ry", "rz"};
  std::string text = "frame,timestamp";
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) text += fmt::format(",{}_{}", kAxes[i], kAxes[j]);
  text += "\n";
  for (const FrameRecord& frame : record.frames) {
    const TrackResult& r = frame.result;
    text += fmt::format("{},{:.9f}", frame.index, r.timestamp);
    for (int i = 0; i < 6; ++i)
      for (int j = i; j < 6; ++j) {
        text += ",";
        if (r.status != TrackStatus::kInitializing) text += scientific_text(r.covariance(i, j), 9);
      }
    text += "\n";
  }
  return text;
}

std::string keyframes_csv(const RunRecord& record) {
  std::string text = "keyframe,frame,timestamp,tx,ty,tz,qx,qy,qz,qw,sightings,reason\n";
  for (const KeyframeInfo& keyframe : record.keyframes) {
    // A loaded keyframe's frame is one of the run that made it; the numbers begin anew with each run.
    const bool loaded = record.loaded.contains(keyframe.id);
    const FrameRecord* frame = loaded ? nullptr : find_frame(record, keyframe.frame);
    const Eigen::Vector3d& t = keyframe.world_from_camera.translation;
    const Eigen::Quaterniond q(keyframe.world_from_camera.rotation);
    const double sign = q.w() < 0 ? -1 : 1;
    text += fmt::format("{},{},{:.9f}", keyframe.id.value, frame ? std::to_string(frame->index) : "",
                        keyframe.timestamp);
    for (const double value : {t.x(), t.y(), t.z(), sign * q.x(), sign * q.y(), sign * q.z(), sign * q.w()})
      text += fmt::format(",{:.9e}", value);
    text += fmt::format(",{},{}\n", keyframe.sightings,
                        frame    ? csv_text(frame->result.keyframe.reason())
                        : loaded ? "loaded"
                                 : "");
  }
  return text;
}

std::string mapping_csv(const RunRecord& record) {
  std::string text =
      "keyframe,ms,retriangulated,iterations,initial_cost,final_cost,outliers,culled_landmarks,culled_"
      "keyframes,"
      "map_keyframes,map_landmarks,triangulated,fused\n";
  for (const MappingInfo& m : record.mapping)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", m.keyframe.value,
                        csv_number(1e3 * m.seconds, 3), m.retriangulated, m.iterations,
                        csv_small(m.initial_cost), csv_small(m.final_cost), m.outliers, m.culled_landmarks,
                        m.culled_keyframes, m.keyframes, m.landmarks, m.triangulated, m.fused);
  return text;
}

std::string loops_csv(const RunRecord& record) {
  std::string text =
      "keyframe,older,score,stage,verification,matches,consensus,inliers,translation_sigma_m,rotation_sigma_"
      "deg,"
      "scale,"
      "gap,turn_gap,way,closed,timestamp,older_timestamp,x,y,z\n";
  for (const LoopAttempt& attempt : record.loops)
    for (const LoopCandidate& c : attempt.candidates) {
      const Verification& v = c.verification;
      const bool closed = attempt.closure && attempt.closure->edge.older == c.keyframe;
      const Eigen::Vector3d at = v.newer_from_older.inverse().translation;
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{:.9f},{:.9f},{:.4f},{:.4f},{:.4f}\n",
                          attempt.keyframe.value, c.keyframe.value, csv_number(c.score, 4),
                          option_names(c.stage)[static_cast<std::size_t>(c.stage)],
                          option_names(v.stage)[static_cast<std::size_t>(v.stage)], v.matches, v.consensus,
                          v.inliers, csv_number(v.translation_sigma, 4), csv_number(v.rotation_sigma, 4),
                          csv_number(v.scale, 4), csv_number(c.gap, 3), csv_number(c.turn_gap, 3),
                          csv_number(c.way, 2), closed ? 1 : 0, attempt.timestamp, c.timestamp, at.x(),
                          at.y(), at.z());
    }
  return text;
}

Trajectory stamped_trajectory(const std::vector<TrajectoryPose>& poses) {
  Trajectory trajectory;
  for (const TrajectoryPose& pose : poses) trajectory.push_back({pose.timestamp, pose.world_from_camera});
  return trajectory;
}

Trajectory trajectory_of_every_frame(const RunRecord& record) {
  Trajectory trajectory;
  if (record.trajectory.empty()) return trajectory;
  auto pose = record.trajectory.begin();
  for (const FrameRecord& frame : record.frames) {
    while (std::next(pose) != record.trajectory.end() && std::next(pose)->frame <= frame.result.frame) ++pose;
    trajectory.push_back({frame.result.timestamp, pose->world_from_camera});
  }
  return trajectory;
}

std::string times_text(const Trajectory& rows) {
  std::string text;
  for (const StampedPose& row : rows) text += fixed_text(row.timestamp, 9) + "\n";
  return text;
}

std::string timing_json(const RunRecord& record, const std::string& dataset) {
  Json stages = Json::object();
  std::vector<double> decode;
  double decode_sum = 0;
  for (const FrameRecord& frame : record.frames) {
    decode.push_back(frame.decode_seconds);
    decode_sum += frame.decode_seconds;
  }
  stages["decode"] = spread_of(decode);
  for (const Stage& stage : kStages) stages[stage.name] = spread_of(stage_seconds(record, stage.seconds));
  std::vector<double> mapping;
  for (const MappingInfo& m : record.mapping) mapping.push_back(m.seconds);
  stages["mapping"] = spread_of(mapping);
  const double count = static_cast<double>(record.frames.size());
  const Json json = {{"dataset", dataset},
                     {"frames_given", record.frames.size()},
                     {"landmarks", record.landmarks},
                     {"wall_seconds", record.wall_seconds},
                     {"cpu_seconds", cpu_seconds()},
                     {"decode_seconds", decode_sum},
                     {"frames_per_second", record.wall_seconds > 0 ? count / record.wall_seconds : 0},
                     {"peak_rss_mb", peak_memory_mb()},
                     {"stages", stages}};
  // A file's name need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

double peak_memory_mb() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KiB
}

double median_frame_ms(const RunRecord& record) {
  std::vector<double> seconds = stage_seconds(record, &StageTimes::total);
  if (seconds.empty()) return 0;
  std::sort(seconds.begin(), seconds.end());
  return 1e3 * quantile(seconds, 0.5);
}

}  // namespace spslam
