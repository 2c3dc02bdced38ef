// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// spslam_bench_disparity: which way of measuring disparity is best? Errors against rendered truth by band of
// disparity, for every method of the stereo stage, as Markdown on stdout. On sequences without depth: row
// offset and counts only.

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>
#include <fstream>

#include "disparity_score.h"
#include "disparity_truth.h"
#include "spslam/alignment/row_search.h"
#include "spslam/base/error.h"
#include "spslam/features/orb_extractor.h"
#include "spslam/stereo/refine.h"
#include "spslam/stereo/stereo.h"

namespace {

using namespace spslam;         // NOLINT
using namespace spslam::bench;  // NOLINT

struct Settings {
  std::vector<std::string> sequences;
  std::vector<std::string> methods;
  std::vector<std::string> changes;  // key=value on top of every method
  std::string csv;
  int every = 20;
  int count = 1500;
  int repeat = 1;  // runs a frame, the least time counts
  int threads = 1;
  EdgeRule edges;
};

struct Method {
  std::string name;
  StereoOptions options;
  bool row_search = false;  // patches sought along the row instead of descriptors
};

struct Prepared {
  BenchFrame frame;
  Features left, right;
  std::vector<cv::Mat> left_levels, right_levels;
  AlignmentPyramid left_alignment, right_alignment;
};

Method method(const std::string& name, std::initializer_list<std::pair<const char*, const char*>> changes) {
  Method m{name, {}};
  for (const auto& [key, value] : changes) set_option(m.options, key, value);
  return m;
}

std::vector<Method> all_methods() {
  constexpr std::pair<const char*, const char*> kBlocks{"block_matching", "true"},
      kNotAligned{"alignment", "false"};
  constexpr std::pair<const char*, const char*> kMatchedOnly{"align_unmatched", "false"};
  return {method("coarse", {kNotAligned}),
          method("SAD", {kBlocks, kNotAligned, {"interpolation", "none"}}),
          {"baseline: SAD row, parabola", baseline_stereo_options()},
          {"paper: SAD 2D, quadric", paper_stereo_options()},
          method("SAD 2D, quadric, brightness", {kBlocks, kNotAligned}),
          method("SAD 2D, equiangular, brightness", {kBlocks, kNotAligned, {"interpolation", "equiangular"}}),
          method("SAD 2D, aligned", {kBlocks, kMatchedOnly}),
          method("coarse, aligned", {kMatchedOnly}),
          {"row search, aligned", method("", {kMatchedOnly, {"align_first_level", "1"}}).options, true},
          method("default: coarse + unmatched, aligned", {})};
}

void extract(const cv::Mat& image, int count, Features& features, std::vector<cv::Mat>& levels) {
  OrbOptions options;
  options.count = count;
  OrbExtractor extractor(options);
  features = extractor.extract(image);
  for (int i = 0; i < extractor.pyramid().size(); ++i) levels.push_back(extractor.pyramid()[i].clone());
}

std::vector<Prepared> prepare(const std::string& sequence, const Settings& settings) {
  std::vector<Prepared> all;
  for (BenchFrame& frame : read_frames(sequence, settings.every)) {
    Prepared p;
    extract(frame.left, settings.count, p.left, p.left_levels);
    extract(frame.right, settings.count, p.right, p.right_levels);
    const int levels = AlignmentOptions().levels;
    p.left_alignment = AlignmentPyramid(frame.left, levels),
    p.right_alignment = AlignmentPyramid(frame.right, levels);
    p.frame = std::move(frame);
    all.push_back(std::move(p));
  }
  return all;
}

struct Result {
  Score smooth, edge;
  std::vector<double> row_offsets, milliseconds;
  std::array<int, 10> statuses{};
  int points = 0;
};

void judge(const Prepared& p, const std::vector<StereoMeasurement>& measured, const Settings& settings,
           Result& result, std::string& csv) {
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const StereoMeasurement& m = measured[i];
    ++result.points;
    ++result.statuses[static_cast<int>(m.status)];
    if (m.ok()) result.row_offsets.push_back(m.row_offset);
    if (p.frame.disparity.empty()) continue;
    const Keypoint& k = p.left.keypoints[i];
    const float aim = m.ok() ? m.disparity : std::nanf("");
    const TrueDisparity truth = true_disparity(p.frame.disparity, k.x, k.y, aim, settings.edges);
    if (!truth.known) continue;
    Score& score = truth.edge ? result.edge : result.smooth;
    ++score.points[band_of(truth.value)];
    if (!m.ok()) continue;
    score.errors.push_back({truth.value, m.disparity - truth.value, m.sigma});
    if (!settings.csv.empty())
      csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", p.frame.number, k.x, k.y, static_cast<int>(k.octave),
                         static_cast<int>(truth.edge), truth.value, m.disparity - truth.value, m.sigma,
                         m.row_offset);
  }
}

std::vector<StereoMeasurement> measure(const Prepared& p, const Method& m) {
  if (!m.row_search)
    return measure_stereo({p.left, p.left_levels, &p.left_alignment},
                          {p.right, p.right_levels, &p.right_alignment}, m.options);
  std::vector<StereoMeasurement> measured(p.left.keypoints.size());
  RowSearchOptions options;
  options.min_disparity = m.options.min_disparity;
  options.max_disparity = m.options.max_disparity_share * p.frame.left.cols;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const Eigen::Vector2f point(p.left.keypoints[i].x, p.left.keypoints[i].y);
    const auto found =
        search_row(p.left_alignment, point, p.right_alignment, m.options.align.patch_radius, options);
    if (found) measured[i] = {*found, 1, 0, StereoStatus::kOk};
  }
  align_stereo(p.left.keypoints, p.left_alignment, p.right_alignment, m.options, measured);
  return measured;
}

Result run(const std::vector<Prepared>& frames, const Method& m, const Settings& settings, std::string& csv) {
  Result result;
  for (const Prepared& p : frames) {
    std::vector<StereoMeasurement> measured;
    double least = 1e9;
    for (int i = 0; i < settings.repeat; ++i) {
      const std::clock_t start = std::clock();  // of the process: other programs do not disturb it
      measured = measure(p, m);
      least = std::min(least, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    result.milliseconds.push_back(least);
    judge(p, measured, settings, result, csv);
  }
  return result;
}

void report_summary(const std::string& sequence, const std::vector<Method>& methods,
                    const std::vector<Result>& results) {
  fmt::print(
      "\n## {}\n\n| method | keypoints a frame | measured % | row offset median px | CPU ms of the stage |",
      sequence);
  fmt::print(" statuses |\n|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Result& r = results[i];
    std::string statuses;
    for (std::size_t s = 0; s < r.statuses.size(); ++s)
      if (r.statuses[s] > 0)
        statuses += fmt::format("{} {} ", to_string(static_cast<StereoStatus>(s)), r.statuses[s]);
    fmt::print("| {} | {:.0f} | {:.0f} | {:+.3f} | {:.2f} | {} |\n", methods[i].name,
               static_cast<double>(r.points) / static_cast<double>(r.milliseconds.size()),
               100.0 * static_cast<double>(r.row_offsets.size()) / r.points, median(r.row_offsets),
               median(r.milliseconds), statuses);
  }
}

void add(Score& all, const Score& one) {
  all.errors.insert(all.errors.end(), one.errors.begin(), one.errors.end());
  for (std::size_t band = 0; band < all.points.size(); ++band) all.points[band] += one.points[band];
}

void report_errors(const std::vector<Method>& methods, const std::vector<Result>& results) {
  for (const bool edge : {false, true}) {
    fmt::print("\n## All sequences with depth: {}\n\n{}",
               edge ? "points at depth edges (error against the nearest surface of the patch)"
                    : "points whose patch is one plane",
               table_head());
    for (std::size_t i = 0; i < methods.size(); ++i)
      fmt::print("{}", table_rows(methods[i].name, edge ? results[i].edge : results[i].smooth));
  }
}

void bench_main(const Settings& settings) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(settings.threads));
  std::vector<Method> methods;
  for (const Method& m : all_methods())
    if (settings.methods.empty() || std::count(settings.methods.begin(), settings.methods.end(), m.name))
      methods.push_back(m);
  for (const std::string& change : settings.changes) {
    const auto equals = change.find('=');
    if (equals == std::string::npos) throw OptionError("--set " + change + ": give key=value");
    for (Method& m : methods) set_option(m.options, change.substr(0, equals), change.substr(equals + 1));
  }
  std::vector<Result> pooled(methods.size());
  std::string csv = "frame,x,y,octave,edge,truth,error,sigma,row_offset\n";
  for (const std::string& sequence : settings.sequences) {
    const std::vector<Prepared> frames = prepare(sequence, settings);
    if (frames.empty()) throw InputError(sequence + " has no frames to judge");
    std::vector<Result> results;
    for (const Method& m : methods) results.push_back(run(frames, m, settings, csv));
    report_summary(sequence.substr(sequence.find_last_of('/') + 1), methods, results);
    for (std::size_t i = 0; i < methods.size(); ++i)
      add(pooled[i].smooth, results[i].smooth), add(pooled[i].edge, results[i].edge);
  }
  if (!pooled.empty() && !pooled[0].smooth.errors.empty()) report_errors(methods, pooled);
  if (!settings.csv.empty() && !(std::ofstream(settings.csv) << csv))
    throw OutputError("cannot write " + settings.csv);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app("Errors of disparity by method and band");
  app.add_option("sequences", settings.sequences, "KITTI folders, with depth/ for errors")->required();
  app.add_option("--method", settings.methods, "only these");
  app.add_option("--set", settings.changes, "stereo option key=value, for all methods");
  app.add_option("--csv", settings.csv, "write every error here");
  app.add_option("--every", settings.every, "frames, where there is no depth");
  app.add_option("--count", settings.count, "features an image");
  app.add_option("--repeat", settings.repeat, "runs a frame, the least time of which counts");
  app.add_option("--threads", settings.threads, "threads at most");
  app.add_option("--plane-radius", settings.edges.plane_radius, "px, square in which a depth edge counts");
  app.add_option("--edge-radius", settings.edges.edge_radius,
                 "px, square whose nearest surface is the truth at an edge");
  app.add_option("--edge-range", settings.edges.edge_range, "px, departure from a plane that makes an edge");
  app.add_option("--edge-share", settings.edges.edge_share,
                 "the same as a share of the disparity; the larger counts");
  CLI11_PARSE(app, argc, argv);
  try {
    bench_main(settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
