// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/trajectory.h"

#include <cmath>
#include <limits>

#include "spslam/base/error.h"
#include "spslam/base/log.h"
#include "spslam/io/text.h"

namespace spslam {
namespace {

constexpr double kDegree = M_PI / 180;

Eigen::Matrix3d rotation_of(const LineReader& reader, const Eigen::Quaterniond& q) {
  const double norm = q.norm();
  if (!(std::abs(norm - 1) <= 0.01))
    reader.fail("quaternion has length " + fixed_text(norm, 6) +
                ", not 1; are the columns in another order?");
  return q.normalized().toRotationMatrix();
}

// Files have 7 digits or so; what is further from a rotation than 1 % is none.
Eigen::Matrix3d rotation_of(const LineReader& reader, const Eigen::Matrix3d& m) {
  const double error = (m * m.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= 0.02) || !(m.determinant() > 0))
    reader.fail("the first three columns are not a rotation (off by " + fixed_text(error, 6) +
                "); a row is r11 r12 r13 tx r21 r22 r23 ty r31 r32 r33 tz");
  return Eigen::Quaterniond(m).normalized().toRotationMatrix();
}

void append_increasing(const LineReader& reader, Trajectory& trajectory, const StampedPose& pose) {
  if (!trajectory.empty() && pose.timestamp <= trajectory.back().timestamp)
    reader.fail("time " + fixed_text(pose.timestamp, 9) + " s does not come after " +
                fixed_text(trajectory.back().timestamp, 9) +
                " s before it; sort the file or remove the line");
  trajectory.push_back(pose);
}

// qx qy qz qw with one sign, so that equal poses are equal text.
Eigen::Quaterniond signed_quaternion(const SE3& pose) {
  Eigen::Quaterniond q = pose.quaternion();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return q;
}

std::string joined(std::initializer_list<double> values, char separator) {
  std::string text;
  for (const double value : values) text += separator + fixed_text(value, 9);
  return text;
}

}  // namespace

SE3 planar_pose(double east, double north, double heading_deg) {
  const double s = std::sin(heading_deg * kDegree), c = std::cos(heading_deg * kDegree);
  SE3 pose;
  pose.rotation << c, 0, s,  // columns: right, down, forward
      -s, 0, c,              //
      0, -1, 0;
  pose.translation = {east, north, 0};
  return pose;
}

Trajectory parse_tum(std::string_view text, const std::string& name) {
  Trajectory trajectory;
  for (LineReader reader(text, name); reader.next();) {
    const std::vector<double> v = reader.reals(8, "t tx ty tz qx qy qz qw");
    const StampedPose pose{
        v[0], {rotation_of(reader, Eigen::Quaterniond(v[7], v[4], v[5], v[6])), {v[1], v[2], v[3]}}};
    if (!trajectory.empty() && pose.timestamp == trajectory.back().timestamp)
      spdlog::debug("{}:{}: same time as the line before, dropped", name, reader.number());
    else
      append_increasing(reader, trajectory, pose);
  }
  return trajectory;
}

Trajectory parse_kitti_poses(std::string_view text, const std::string& name, std::span<const double> times) {
  Trajectory trajectory;
  for (LineReader reader(text, name); reader.next();) {
    const std::vector<double> v = reader.reals(12, "r11 r12 r13 tx r21 r22 r23 ty r31 r32 r33 tz");
    const std::size_t row = trajectory.size();
    if (!times.empty() && row >= times.size())
      reader.fail("is pose " + std::to_string(row + 1) + ", there are only " + std::to_string(times.size()) +
                  " times; poses and times must belong to the same frames");
    const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> m(v.data());
    const SE3 pose{rotation_of(reader, Eigen::Matrix3d(m.leftCols<3>())), m.col(3)};
    append_increasing(reader, trajectory, {times.empty() ? static_cast<double>(row) : times[row], pose});
  }
  if (!times.empty() && trajectory.size() != times.size())
    throw InputError(name + ": has " + std::to_string(trajectory.size()) + " poses for " +
                     std::to_string(times.size()) + " times; poses and times must belong to the same frames");
  return trajectory;
}

Trajectory parse_euroc_ground_truth(std::string_view text, const std::string& name,
                                    const SE3& body_from_camera) {
  Trajectory trajectory;
  for (LineReader reader(text, name); reader.next();) {
    const std::vector<std::string_view> words = reader.fields(',');
    if (words.size() < 8)
      reader.fail("has " + std::to_string(words.size()) + " columns, needs t_ns, x, y, z, qw, qx, qy, qz");
    const double time = static_cast<double>(reader.integer(words[0])) * 1e-9;
    double v[8] = {};
    for (int i = 1; i < 8; ++i) v[i] = reader.real(words[i]);
    const SE3 world_from_body{rotation_of(reader, Eigen::Quaterniond(v[4], v[5], v[6], v[7])),
                              {v[1], v[2], v[3]}};
    append_increasing(reader, trajectory, {time, world_from_body * body_from_camera});
  }
  return trajectory;
}

Trajectory parse_usvinland_gps(std::string_view text, const std::string& name) {
  Trajectory trajectory;
  for (LineReader reader(text, name); reader.next();) {
    const std::vector<std::string_view> words = reader.fields(',');
    if (words.size() < 11)
      reader.fail("has " + std::to_string(words.size()) +
                  " columns, needs 11 (0 time, 1 east, 2 north, 10 heading)");
    const SE3 pose = planar_pose(reader.real(words[1]), reader.real(words[2]), reader.real(words[10]));
    append_increasing(reader, trajectory, {reader.real(words[0]), pose});
  }
  return trajectory;
}

std::string format_tum(const Trajectory& trajectory) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const StampedPose& stamped : trajectory) {
    const Eigen::Vector3d& t = stamped.world_from_camera.translation;
    const Eigen::Quaterniond q = signed_quaternion(stamped.world_from_camera);
    text += fixed_text(stamped.timestamp, 9) +
            joined({t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}, ' ') + "\n";
  }
  return text;
}

std::string format_kitti_poses(const Trajectory& trajectory) {
  std::string text;
  for (const StampedPose& stamped : trajectory) {
    const Eigen::Matrix<double, 3, 4> m = stamped.world_from_camera.matrix3x4();
    for (int i = 0; i < 12; ++i) text.append(i == 0 ? "" : " ").append(scientific_text(m(i / 4, i % 4), 9));
    text += '\n';
  }
  return text;
}

std::string format_euroc_ground_truth(const Trajectory& trajectory, const SE3& body_from_camera) {
  std::string text =
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n";
  for (const StampedPose& stamped : trajectory) {
    const SE3 world_from_body = stamped.world_from_camera * body_from_camera.inverse();
    const Eigen::Vector3d& t = world_from_body.translation;
    const Eigen::Quaterniond q = signed_quaternion(world_from_body);
    text += std::to_string(std::llround(stamped.timestamp * 1e9)) +
            joined({t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()}, ',') + "\n";
  }
  return text;
}

std::string format_usvinland_gps(const Trajectory& trajectory) {
  std::string text;
  for (const StampedPose& stamped : trajectory) {
    const SE3& pose = stamped.world_from_camera;
    double heading = std::atan2(pose.rotation(0, 2), pose.rotation(1, 2)) / kDegree;  // of the optical axis
    if (heading < 0) heading += 360;
    text += fixed_text(stamped.timestamp, 6) + joined({pose.translation.x(), pose.translation.y()}, ',') +
            ",0,0,0,0,0,0,0," + fixed_text(heading, 6) + "\n";
  }
  return text;
}

std::span<const char* const> option_names(TrajectoryFormat) {
  static constexpr const char* names[] = {"auto", "tum", "kitti", "euroc", "usvinland"};
  return names;
}

TrajectoryFormat recognise_trajectory(std::string_view text) {
  LineReader reader(text, "");
  if (!reader.next()) return TrajectoryFormat::kAuto;
  const std::size_t words = reader.fields().size();
  if (reader.line().find(',') == std::string_view::npos) {
    if (words == 8) return TrajectoryFormat::kTum;
    return words == 12 ? TrajectoryFormat::kKitti : TrajectoryFormat::kAuto;
  }
  const std::vector<std::string_view> columns = reader.fields(',');
  const bool nanoseconds =
      columns[0].size() >= 15 && columns[0].find_first_not_of("0123456789") == std::string_view::npos;
  if (nanoseconds && columns.size() >= 8) return TrajectoryFormat::kEuroc;
  return columns.size() >= 11 ? TrajectoryFormat::kUsvinland : TrajectoryFormat::kAuto;
}

Trajectory read_trajectory(const std::filesystem::path& path, const TrajectoryFile& file) {
  const std::string text = read_text_file(path), name = path.string();
  switch (file.format == TrajectoryFormat::kAuto ? recognise_trajectory(text) : file.format) {
    case TrajectoryFormat::kTum:
      return parse_tum(text, name);
    case TrajectoryFormat::kKitti: {
      std::filesystem::path times = file.times;
      if (times.empty() && std::filesystem::exists(path.parent_path() / "times.txt"))
        times = path.parent_path() / "times.txt";
      if (times.empty()) return parse_kitti_poses(text, name);
      return parse_kitti_poses(text, name, parse_times(read_text_file(times), times.string()));
    }
    case TrajectoryFormat::kEuroc:
      return parse_euroc_ground_truth(text, name, file.body_from_camera);
    case TrajectoryFormat::kUsvinland:
      return parse_usvinland_gps(text, name);
    case TrajectoryFormat::kAuto:
      break;
  }
  throw InputError(
      name +
      " is no trajectory that is known: TUM has 8 numbers a line, KITTI 12, EuRoC ground truth >= 8 "
      "columns " +
      "from nanoseconds on, USVInland >= 11 columns separated by commas; say which with the format option");
}

}  // namespace spslam
