// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Stereo pairs of known disparity: a band-limited random texture that is a formula, so that it can be sampled
// at any part of a pixel without interpolation.
#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "features/made_up_descriptors.h"
#include "spslam/base/random.h"
#include "spslam/features/types.h"

namespace spslam::test {

// A sum of plane waves of wavelengths 5 to 40 px, mean 128, deviation about 35 grey values.
class Texture {
 public:
  explicit Texture(std::uint64_t seed) {
    Random random(seed);
    for (Wave& w : waves_) {
      const double length = random.uniform(5, 40), direction = random.uniform(0, 2 * M_PI);
      w = {2 * M_PI / length * std::cos(direction), 2 * M_PI / length * std::sin(direction),
           random.uniform(0, 2 * M_PI)};
    }
  }
  double at(double x, double y) const {
    double sum = 0;
    for (const Wave& w : waves_) sum += std::cos(w.kx * x + w.ky * y + w.phase);
    return 128 + 10 * sum;
  }

 private:
  struct Wave {
    double kx = 0, ky = 0, phase = 0;
  };
  Wave waves_[24];
};

struct PairSettings {
  double disparity = 0, row_offset = 0;  // px
  double gain = 1, offset = 0;           // of the right image
  double noise = 0;                      // grey values, both images
  int width = 260, height = 180;
};

inline cv::Mat render(const Texture& texture, double shift_x, double shift_y, double gain, double offset,
                      const PairSettings& s, Random& random) {
  cv::Mat image(s.height, s.width, CV_8UC1);
  for (int y = 0; y < s.height; ++y)
    for (int x = 0; x < s.width; ++x)
      image.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(
          gain * (texture.at(x + shift_x, y + shift_y) - 128) + 128 + offset + s.noise * random.normal());
  return image;
}

struct Pair {
  Features left, right;
  std::vector<cv::Mat> left_levels, right_levels;
};

inline std::vector<cv::Mat> levels_of(const cv::Mat& image, int count = 4) {
  std::vector<cv::Mat> levels{image};
  for (int i = 1; i < count; ++i) {
    cv::Mat level;
    const double shrink = std::pow(1.2, -i);
    cv::resize(levels.back(), level,
               cv::Size(static_cast<int>(std::lround(image.cols * shrink)),
                        static_cast<int>(std::lround(image.rows * shrink))));
    levels.push_back(level);
  }
  return levels;
}

// Images and a grid of keypoints on level `octave`, each with a descriptor of its own, seen at the rounded
// place in the right image (the place of a corner is rough: the fine search has to find the rest).
inline Pair make_pair(const PairSettings& s, std::uint64_t seed, int octave = 0, int spacing = 8) {
  const Texture texture(seed);
  Random random(seed + 1);
  Pair pair;
  pair.left_levels = levels_of(render(texture, 0, 0, 1, 0, s, random));
  pair.right_levels = levels_of(render(texture, s.disparity, -s.row_offset, s.gain, s.offset, s, random));
  const double pixel = static_cast<double>(s.width) / pair.left_levels[octave].cols;
  for (int y = 40; y < s.height - 40; y += spacing) {
    for (int x = 60; x < s.width - 40; x += spacing) {
      const auto snap = [&](double at) {
        return static_cast<float>((std::round((at + 0.5) / pixel - 0.5) + 0.5) * pixel - 0.5);
      };
      const Keypoint l{snap(x), snap(y), 0, 1, static_cast<std::uint8_t>(octave)};
      Keypoint r = l;
      r.x = snap(l.x - s.disparity);
      r.y = snap(l.y + s.row_offset);
      pair.left.keypoints.push_back(l), pair.right.keypoints.push_back(r);
      pair.left.descriptors.push_back(random_descriptor(random));
      pair.right.descriptors.push_back(pair.left.descriptors.back());
    }
  }
  return pair;
}

}  // namespace spslam::test
