// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Time of feature extraction (whole, and its parts) and of the distance segmentation on the shared images,
// with cv::ORB for comparison. SPSLAM_SHARED_DATA in the environment says where these are; without them
// everything is skipped. For one core: taskset -c 0 spslam_bench_features
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "spslam/features/brief.h"
#include "spslam/features/fast.h"
#include "spslam/features/orb_extractor.h"
#include "spslam/segmentation/distance_segmenter.h"

namespace spslam {
namespace {

struct Input {
  const char* file;
  int count;  // features
};
constexpr Input kInputs[] = {{"nearshore_bank/image_0/000100.jpg", 1500},
                             {"kitti_raw/image_0/000100.jpg", 2000}};

cv::Mat read_input(benchmark::State& state) {
  const char* folder = std::getenv("SPSLAM_SHARED_DATA");
  const std::filesystem::path path =
      std::filesystem::path(folder != nullptr ? folder : "../shared/data") / kInputs[state.range(0)].file;
  const cv::Mat image = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
  if (image.empty()) state.SkipWithError(("no image " + path.string()).c_str());
  state.SetLabel(std::to_string(image.cols) + "x" + std::to_string(image.rows));
  return image;
}

OrbOptions options_for(const benchmark::State& state) {
  OrbOptions options;
  options.count = kInputs[state.range(0)].count;
  return options;
}

void extract(benchmark::State& state) {
  const cv::Mat image = read_input(state);
  OrbExtractor extractor(options_for(state));
  for (auto _ : state) benchmark::DoNotOptimize(extractor.extract(image));
}
BENCHMARK(extract)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void pyramid(benchmark::State& state) {
  const cv::Mat image = read_input(state);
  OrbExtractor extractor(options_for(state));
  for (auto _ : state) extractor.set_image(image);
}
BENCHMARK(pyramid)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void detect(benchmark::State& state) {
  const cv::Mat image = read_input(state);
  OrbExtractor extractor(options_for(state));
  extractor.set_image(image);
  for (auto _ : state) benchmark::DoNotOptimize(extractor.detect());
}
BENCHMARK(detect)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void fast_of_all_levels(benchmark::State& state) {
  const cv::Mat image = read_input(state);
  OrbExtractor extractor(options_for(state));
  extractor.set_image(image);
  cv::Mat scores;
  std::vector<Corner> corners;
  for (auto _ : state) {
    for (int i = 0; i < extractor.pyramid().size(); ++i) {
      fast_scores(extractor.pyramid()[i], 7, scores);
      collect_corners(scores, 16, corners);
    }
  }
}
BENCHMARK(fast_of_all_levels)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void opencv_fast_of_all_levels(benchmark::State& state) {
  const cv::Mat image = read_input(state);
  OrbExtractor extractor(options_for(state));
  extractor.set_image(image);
  std::vector<cv::KeyPoint> corners;
  for (auto _ : state) {
    for (int i = 0; i < extractor.pyramid().size(); ++i) cv::FAST(extractor.pyramid()[i], corners, 7);
  }
}
BENCHMARK(opencv_fast_of_all_levels)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

// With the smoothing of the levels.
void describe(benchmark::State& state) {
  const cv::Mat image = read_input(state);
  OrbExtractor extractor(options_for(state));
  extractor.set_image(image);
  const std::vector<Keypoint> keypoints = extractor.detect();
  for (auto _ : state) {
    state.PauseTiming();
    extractor.set_image(image);
    state.ResumeTiming();
    benchmark::DoNotOptimize(extractor.describe(keypoints));
  }
}
BENCHMARK(describe)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void opencv_orb(benchmark::State& state) {
  const cv::Mat image = read_input(state);
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(kInputs[state.range(0)].count);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  for (auto _ : state) orb->detectAndCompute(image, {}, keypoints, descriptors);
}
BENCHMARK(opencv_orb)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void segment(benchmark::State& state) {
  const cv::Mat image = read_input(state);
  DistanceSegmenter segmenter;
  for (auto _ : state) benchmark::DoNotOptimize(segmenter.update(image));
}
BENCHMARK(segment)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace spslam

BENCHMARK_MAIN();
