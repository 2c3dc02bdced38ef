// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "disparity_truth.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "spslam/base/error.h"

namespace spslam::bench {
namespace {

namespace fs = std::filesystem;
using Pose = Eigen::Matrix<double, 3, 4>;

constexpr double kWaterHeight = 0.05;  // m; what is lower is water

std::vector<fs::path> sorted_files(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError("no folder " + folder.string() + "; give a KITTI sequence");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<double> numbers_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<double> numbers;
  for (double x = 0; stream >> x;) numbers.push_back(x);
  return numbers;
}

// Rows of 12 numbers; lines that begin with # are left out.
std::vector<Pose> read_poses(const fs::path& path) {
  std::ifstream file(path);
  if (!file) throw InputError("cannot read " + path.string());
  std::vector<Pose> poses;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::vector<double> n = numbers_of(line);
    if (n.size() != 12)
      throw InputError(path.string() + ": a pose has 12 numbers, not " + std::to_string(n.size()));
    poses.push_back(Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(n.data()));
  }
  return poses;
}

cv::Mat disparity_of(const cv::Mat& depth_cm, const StereoRig& rig, const Pose& world_from_first,
                     const Pose& first_from_camera) {
  const Eigen::Vector3d to_up = world_from_first.row(2).head<3>();
  const Eigen::Vector3d up = first_from_camera.leftCols<3>().transpose() * to_up;
  const double height = to_up.dot(first_from_camera.col(3)) + world_from_first(2, 3);
  cv::Mat disparity(depth_cm.size(), CV_32FC1);
  for (int y = 0; y < depth_cm.rows; ++y) {
    for (int x = 0; x < depth_cm.cols; ++x) {
      const double z = depth_cm.at<std::uint16_t>(y, x) * 0.01;
      float& d = disparity.at<float>(y, x);
      d = z > 0 ? static_cast<float>(rig.disparity_per_inverse_depth() / z) : 0.0F;
      if (z > 0 && z * up.dot(rig.bearing(x, y)) + height < kWaterHeight)
        d = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return disparity;
}

// Largest distance of a square's values from its least-squares plane; NaN with water in it.
float departure_from_plane(const cv::Mat& patch, int radius) {
  double sum = 0, along_x = 0, along_y = 0, weight = 0;
  for (int v = -radius; v <= radius; ++v) {
    for (int u = -radius; u <= radius; ++u) {
      const double d = patch.at<float>(v + radius, u + radius);
      sum += d, along_x += d * u, along_y += d * v, weight += u * u;
    }
  }
  double largest = 0;
  for (int v = -radius; v <= radius; ++v)
    for (int u = -radius; u <= radius; ++u)
      largest = std::max(std::abs(patch.at<float>(v + radius, u + radius) - sum / patch.total() -
                                  (along_x * u + along_y * v) / weight),
                         largest);
  return static_cast<float>(largest);
}

cv::Mat read_grey(const fs::path& path) {
  cv::Mat image = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw InputError("cannot decode " + path.string());
  return image;
}

}  // namespace

StereoRig read_rig(const std::string& folder, cv::Size size) {
  std::ifstream file(folder + "/calib.txt");
  StereoRig rig;
  rig.width = size.width, rig.height = size.height;
  for (std::string line; std::getline(file, line);) {
    const std::vector<double> n = line.size() > 3 ? numbers_of(line.substr(3)) : std::vector<double>();
    if (n.size() != 12) continue;
    if (line.starts_with("P0:")) rig.fx = n[0], rig.cx = n[2], rig.fy = n[5], rig.cy = n[6];
    if (line.starts_with("P1:")) rig.baseline = -n[3] / n[0];
  }
  rig.check();
  return rig;
}

std::vector<BenchFrame> read_frames(const std::string& folder, int every) {
  const fs::path root(folder);
  const std::vector<fs::path> left = sorted_files(root / "image_0"), right = sorted_files(root / "image_1");
  const bool truth = fs::is_directory(root / "depth");
  const std::vector<Pose> poses = truth ? read_poses(root / "poses.txt") : std::vector<Pose>();
  const Pose world_from_first = truth ? read_poses(root / "world_from_first_camera.txt").at(0) : Pose::Zero();
  std::vector<BenchFrame> frames;
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); i += truth ? 1 : every) {
    const fs::path depth = root / "depth" / (left[i].stem().string() + ".png");
    if (truth && !fs::exists(depth)) continue;
    BenchFrame frame{static_cast<int>(i), read_grey(left[i]), read_grey(right[i]), {}};
    if (truth) {
      const cv::Mat depth_cm = cv::imread(depth.string(), cv::IMREAD_UNCHANGED);
      if (depth_cm.type() != CV_16UC1) throw InputError(depth.string() + " is not a 16-bit depth map");
      frame.disparity =
          disparity_of(depth_cm, read_rig(folder, frame.left.size()), world_from_first, poses.at(i));
    }
    frames.push_back(frame);
  }
  return frames;
}

TrueDisparity true_disparity(const cv::Mat& disparity, float x, float y, float measured,
                             const EdgeRule& rule) {
  const cv::Point centre(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)));
  const auto square = [&](int radius) {
    return cv::Rect(centre.x - radius, centre.y - radius, 2 * radius + 1, 2 * radius + 1);
  };
  TrueDisparity truth;
  const cv::Rect around = square(rule.plane_radius);
  if ((around & cv::Rect({}, disparity.size())) != around) return truth;
  if (!cv::checkRange(disparity(square(rule.edge_radius)))) return truth;  // water
  truth.known = true;
  const double range = std::max(rule.edge_range, rule.edge_share * disparity.at<float>(centre));
  truth.edge = !(departure_from_plane(disparity(around), rule.plane_radius) <= range);
  if (!truth.edge || std::isnan(measured)) {
    cv::Mat between;
    cv::getRectSubPix(disparity, cv::Size(1, 1), cv::Point2f(x, y), between);
    truth.value = between.at<float>(0);
    return truth;
  }
  truth.value = disparity.at<float>(centre);
  const cv::Mat patch = disparity(square(rule.edge_radius));
  for (auto d = patch.begin<float>(); d != patch.end<float>(); ++d)
    if (std::abs(*d - measured) < std::abs(truth.value - measured)) truth.value = *d;
  return truth;
}

}  // namespace spslam::bench
