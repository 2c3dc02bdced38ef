// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/recording_check.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "spslam/base/median.h"
#include "spslam/odometry/options.h"

namespace spslam {
namespace {

constexpr std::size_t kFewMatches = 60;  // of all pairs: fewer do not tell anything about the rig
constexpr int kFewCorners = 60;          // of a pair
constexpr double kRowsFine = 0.3, kRowsCornerFine = 0.5, kRowsBad = 1;  // px
constexpr double kRowsScatterFine = 0.5;                                // px
constexpr double kFewMeasured = 30;  // corners of a pair, of some 300 matched, that have a depth at all
constexpr double kDelayFine = 0.05;  // frames

// The middle of one figure of all pairs.
template <class Figure>
double median_of(std::span<const SampledPair> pairs, Figure figure) {
  std::vector<double> values;
  for (const SampledPair& pair : pairs) values.push_back(static_cast<double>(figure(pair)));
  return median(std::move(values));
}

template <class Condition>
double share_of(std::span<const SampledPair> pairs, Condition condition) {
  const auto count = std::count_if(pairs.begin(), pairs.end(), condition);
  return pairs.empty() ? 0 : static_cast<double>(count) / static_cast<double>(pairs.size());
}

// How much the rows of single pairs lie off the plane of all: 1.4826 times the median deviation.
double scatter_of_pairs(std::span<const SampledPair> pairs, int frames, const RowOffsets& rows) {
  std::vector<double> deviations;
  for (const SampledPair& pair : pairs) {
    std::vector<double> offsets;
    for (const PairMatch& m : matches_with(pair, frames)) offsets.push_back(m.row_offset - rows.at(m.x, m.y));
    if (offsets.size() >= 20) deviations.push_back(std::abs(median(std::move(offsets))));
  }
  return 1.4826 * median(std::move(deviations));
}

Finding judge_pairs(const RecordingSample& sample) {
  const auto read = static_cast<int>(sample.pairs.size()), all = read + sample.unusable;
  Finding finding{.name = "pairs"};
  finding.values = {{"sampled", all}, {"unusable", sample.unusable}};
  finding.text = fmt::format("{} of {} sampled pairs can be used", read, all);
  if (sample.unusable == 0) return finding;
  finding.judgement = read < sample.unusable ? Judgement::kBad : Judgement::kWarning;
  finding.advice = "the first that cannot: " + sample.first_problem;
  return finding;
}

// Pairs that do not show one scene: nothing else need be asked then.
Finding judge_matches(const RecordingSample& sample, std::size_t matches) {
  const double corners = median_of(sample.pairs, [](const auto& pair) { return pair.corners; });
  const double matched = median_of(sample.pairs, [](const auto& pair) { return pair.matches.size(); });
  Finding finding{.name = "matches"};
  finding.values = {{"corners_per_pair", corners}, {"matched_per_pair", matched}};
  finding.text =
      fmt::format("{:.0f} of {:.0f} corners of a left image are found in the right one", matched, corners);
  if (share_of(sample.pairs, [](const auto& pair) { return pair.eyes_are_equal; }) > 0.5) {
    finding.judgement = Judgement::kBad;
    finding.advice = "left and right are the same images, so there is no depth; copy the right eye's again";
  } else if (corners < kFewCorners) {
    finding.judgement = Judgement::kWarning;
    finding.advice =
        "there is hardly any texture (fog, darkness, blur, or water only): little or nothing can be told of "
        "the rig";
  } else if (matches < kFewMatches || matched < 0.03 * corners) {
    finding.judgement = Judgement::kBad;
    finding.advice =
        "left and right hardly show the same: are they of one rig and one instant, both upright, not "
        "mirrored, "
        "and rectified (or their calibration a raw one)?";
  }
  return finding;
}

Finding judge_infinity(const DisparityStatistics& disparities) {
  Finding finding{.name = "infinity"};
  finding.values = {{"quantile_1_px", disparities.quantile_1}, {"quantile_5_px", disparities.quantile_5}};
  finding.text = fmt::format("1 % of the disparities are below {:.2f} px, 5 % below {:.2f} px",
                             disparities.quantile_1, disparities.quantile_5);
  if (disparities.matches < static_cast<int>(kFewMatches) || disparities.quantile_1 >= -kClearDisparity)
    return finding;
  const bool is_bad = disparities.quantile_5 < -2 * kClearDisparity;
  finding.judgement = is_bad ? Judgement::kBad : Judgement::kWarning;
  finding.advice = fmt::format(
      "nothing is farther than infinity, which has disparity 0: the calibration "
      "takes off too much; calibrate anew. A run finds out up to {:.0f} px itself (tracker.rig.max_offset)",
      RigOptions{}.max_offset);
  return finding;
}

// What of the image has a depth, and a good one.
Finding judge_disparities(const StereoRig& rig, const DisparityStatistics& disparities, std::size_t pairs) {
  const double product = rig.disparity_per_inverse_depth();
  const double measured = (1 - disparities.below_1) * disparities.matches / static_cast<double>(pairs);
  Finding finding{.name = "disparities"};
  finding.values = {{"median_px", disparities.median},         {"quantile_95_px", disparities.quantile_95},
                    {"share_below_1_px", disparities.below_1}, {"share_below_3_px", disparities.below_3},
                    {"above_1_px_per_pair", measured},         {"depth_at_1_px_m", product},
                    {"depth_at_3_px_m", product / 3}};
  finding.text = fmt::format(
      "median {:.1f} px, 95 % below {:.1f} px; {:.0f} % below 1 px (beyond {:.1f} m, where 0.1 px is 10 % of "
      "the distance), {:.0f} % "
      "below 3 px (beyond {:.1f} m, 3 %)",
      disparities.median, disparities.quantile_95, 100 * disparities.below_1, product,
      100 * disparities.below_3, product / 3);
  if (measured >= kFewMeasured) return finding;
  finding.judgement = Judgement::kWarning;
  finding.advice = fmt::format(
      "only about {:.0f} of the corners matched in a pair are nearer than {:.1f} m: the scale of the motion "
      "will be uncertain; go "
      "closer to the shore, or widen the baseline",
      measured, product);
  return finding;
}

Finding judge_instants(const Instants& instants, double interval) {
  Finding finding{.name = "instants"};
  finding.values = {{"spread_before_px", instants.spread[0]}, {"spread_own_px", instants.spread[1]},
                    {"spread_after_px", instants.spread[2]},  {"told", instants.is_told},
                    {"delay_frames", instants.delay},         {"delay_sigma_frames", instants.delay_sigma}};
  if (!instants.is_told) {
    finding.text = "cannot be told: the camera hardly moves between the frames, or there are too few matches";
    return finding;
  }
  finding.text = fmt::format(
      "rows of right images scatter by {:.2f} px against their left ones, by {:.2f} and {:.2f} px against "
      "those before and after",
      instants.spread[1], instants.spread[0], instants.spread[2]);
  if (instants.delay_sigma > 0)
    finding.text +=
        fmt::format("; delay {:+.2f} frames, known to {:.2f}", instants.delay, instants.delay_sigma);
  if (instants.fitting != 0) {
    finding.judgement = Judgement::kBad;
    const bool is_one = instants.spread[1 + instants.fitting] < kRowsBad;
    finding.advice = fmt::format(
        "right images fit the left image {} theirs better: one eye is shifted by {}; name or number the "
        "images so that those of one "
        "instant belong together. What else is said of pairs is of those that fit better",
        instants.fitting < 0 ? "before" : "after", is_one ? "a frame" : "more than a frame");
  } else if (std::abs(instants.delay) > kDelayFine + 3 * instants.delay_sigma) {
    finding.judgement = Judgement::kWarning;
    finding.advice = fmt::format(
        "right images seem to be exposed {:.2f} frames ({:.0f} ms) {} the left ones; trigger both eyes "
        "together",
        std::abs(instants.delay), 1000 * std::abs(instants.delay) * interval,
        instants.delay < 0 ? "before" : "after");
  }
  return finding;
}

Finding judge_times(const TimeSteps& steps) {
  Finding finding{.name = "times"};
  finding.values = {{"interval_s", steps.median},
                    {"jitter_s", steps.jitter},
                    {"longest_s", steps.longest},
                    {"gaps", steps.gaps},
                    {"short", steps.short_ones}};
  if (steps.intervals == 0) {
    finding.text = "one frame";
    return finding;
  }
  finding.text = fmt::format(
      "{:.4g} s between frames ({:.1f} Hz), jitter {:.1f} ms, longest {:.3g} s; gaps: {}, too short: {}",
      steps.median, 1 / steps.median, 1000 * steps.jitter, steps.longest, steps.gaps, steps.short_ones);
  if (steps.gaps + steps.short_ones > 0)
    finding.advice = "frames are missing or their times are not those of the exposures";
  if (steps.jitter > 0.2 * steps.median)
    finding.advice = "frames are not evenly spaced: are these times of exposure or of writing?";
  if (steps.median > 0.3)
    finding.advice =
        "frames are far apart: tracking needs most of what it saw in the frame before; record faster";
  if (!finding.advice.empty()) finding.judgement = Judgement::kWarning;
  return finding;
}

Finding judge_images(std::span<const SampledPair> pairs) {
  Finding finding{.name = "images"};
  const auto figure = [&](ImageStatistics SampledPair::*eye, double ImageStatistics::*what) {
    return median_of(pairs, [&](const SampledPair& pair) { return pair.*eye.*what; });
  };
  const auto worse = [&](double ImageStatistics::*what) {
    return std::max(figure(&SampledPair::left, what), figure(&SampledPair::right, what));
  };
  const double saturated = worse(&ImageStatistics::saturated), black = worse(&ImageStatistics::black);
  const double contrast = std::min(figure(&SampledPair::left, &ImageStatistics::contrast),
                                   figure(&SampledPair::right, &ImageStatistics::contrast));
  const double left_repeats = share_of(pairs, [](const auto& pair) { return pair.left_repeats; });
  const double right_repeats = share_of(pairs, [](const auto& pair) { return pair.right_repeats; });
  finding.values = {{"saturated", saturated},
                    {"black", black},
                    {"contrast_grey", contrast},
                    {"mean_left_grey", figure(&SampledPair::left, &ImageStatistics::mean)},
                    {"mean_right_grey", figure(&SampledPair::right, &ImageStatistics::mean)},
                    {"left_repeats", left_repeats},
                    {"right_repeats", right_repeats}};
  finding.text = fmt::format(
      "{:.0f} % white, {:.0f} % black, contrast {:.0f} grey values, {:.0f} % followed by the same again",
      100 * saturated, 100 * black, contrast, 100 * std::max(left_repeats, right_repeats));
  const auto say = [&](Judgement judgement, const char* advice) {
    finding.judgement = std::max(finding.judgement, judgement);
    finding.advice += (finding.advice.empty() ? "" : "; ") + std::string(advice);
  };
  if (saturated > 0.3) say(Judgement::kWarning, "much is white: expose shorter");
  if (black > 0.3) say(Judgement::kWarning, "much is black: expose longer, or cut the borders off");
  if (contrast < 3)
    say(Judgement::kBad, "there is nothing to be seen");
  else if (contrast < 10)
    say(Judgement::kWarning, "there is little contrast");
  if (std::abs(left_repeats - right_repeats) > 0.2)
    say(Judgement::kBad,
        "images of one eye repeat while the other eye's go on: frames were lost while recording");
  else if (std::max(left_repeats, right_repeats) > 0.1)
    say(Judgement::kWarning, "frames repeat: record at the camera's own rate");
  return finding;
}

Finding judge_calibration(const StereoRig& rig) {
  Finding finding{.name = "calibration"};
  const double cx = rig.cx / rig.width, cy = rig.cy / rig.height, ratio = rig.fx / rig.fy;
  const double view = 2 * std::atan(0.5 * rig.width / rig.fx) * 180 / M_PI;
  finding.values = {{"width_px", rig.width},
                    {"height_px", rig.height},
                    {"fx_px", rig.fx},
                    {"fy_px", rig.fy},
                    {"cx_px", rig.cx},
                    {"cy_px", rig.cy},
                    {"baseline_m", rig.baseline},
                    {"view_deg", view}};
  finding.text = fmt::format(
      "{} x {} px, {:.0f} degrees wide, principal point at {:.2f} and {:.2f} of the image, fx / fy {:.3f}, "
      "fx * baseline {:.1f} px m",
      rig.width, rig.height, view, cx, cy, ratio, rig.disparity_per_inverse_depth());
  const auto is_central = [](double at) { return at > 0.35 && at < 0.65; };
  if (!is_central(cx) || !is_central(cy))
    finding.advice =
        "the principal point is far from the middle: is it the calibration of another image size or part?";
  else if (ratio < 0.95 || ratio > 1.05)
    finding.advice = "pixels are hardly so far from square: is the calibration of images of another shape?";
  else if (view < 20 || view > 130)
    finding.advice = "the field of view is unusual: is it the calibration of another image size?";
  if (!finding.advice.empty()) finding.judgement = Judgement::kWarning;
  return finding;
}

// What matches say. One fault, one finding: what is wrong with the pairing, and then with the sides, is put
// right for what is asked next.
std::vector<Finding> judge_rig(const RecordingSample& sample, double interval) {
  const cv::Size image(sample.rig.width, sample.rig.height);
  const Instants instants = measure_instants(sample.pairs, image);
  const std::vector<PairMatch> matches = all_matches(sample.pairs, instants.fitting);
  std::vector<Finding> findings = {judge_matches(sample, matches.size())};
  // Few matches are wrong ones.
  if (findings.front().judgement == Judgement::kBad || matches.size() < kFewMatches) return findings;
  const RowOffsets rows = measure_rows(matches, image);
  std::vector<PairMatch> kept = on_rows(matches, rows);
  Finding sign = judge_sign(measure_disparities(kept));
  if (sign.judgement == Judgement::kBad) {
    for (PairMatch& match : kept) match.disparity = -match.disparity;
    sign.advice += ". What else is said of disparities is of those exchanged";
  }
  const DisparityStatistics disparities = measure_disparities(kept);
  findings.insert(findings.end(), {judge_instants(instants, interval),
                                   judge_rows(rows, scatter_of_pairs(sample.pairs, instants.fitting, rows)),
                                   sign, judge_infinity(disparities),
                                   judge_disparities(sample.rig, disparities, sample.pairs.size())});
  return findings;
}

}  // namespace

std::span<const char* const> option_names(Judgement) {
  static constexpr const char* names[] = {"ok", "warning", "bad"};
  return names;
}

Finding judge_rows(const RowOffsets& rows, double pair_scatter) {
  Finding finding{.name = "rows"};
  finding.values = {{"matches", rows.matches},
                    {"median_px", rows.median},
                    {"spread_px", rows.spread},
                    {"roll_deg", rows.slope_x * 180 / M_PI},
                    {"slope_x_px_per_px", rows.slope_x},
                    {"slope_y_px_per_px", rows.slope_y},
                    {"worst_corner_px", rows.worst_corner},
                    {"worst_corner_sigma_px", rows.corner_sigma},
                    {"pair_scatter_px", pair_scatter}};
  finding.text = fmt::format(
      "those of right images lie {:.2f} px {} (median; spread {:.2f} px), at the worst corner {:.2f} px {}; "
      "roll {:+.2f} degrees, "
      "{:+.2f} px from top to bottom, {:.2f} px from pair to pair",
      std::abs(rows.median), rows.median < 0 ? "higher" : "lower", rows.spread, std::abs(rows.worst_corner),
      rows.worst_corner < 0 ? "higher" : "lower", rows.slope_x * 180 / M_PI, 2 * rows.slope_y * rows.middle.y,
      pair_scatter);
  if (rows.matches < static_cast<int>(kFewMatches)) return finding;
  // As far as it is known: few matches in one part of the image say little about its corners.
  const double corner = std::max(0.0, std::abs(rows.worst_corner) - 2 * rows.corner_sigma);
  const std::string tolerated =
      fmt::format("tracking leaves out points beyond {:.1f} px (tracker.follow.max_row_offset)",
                  FollowOptions{}.max_row_offset);
  const auto say = [&](Judgement judgement, const std::string& advice) {
    finding.judgement = judgement;
    finding.advice = advice;
  };
  if (rows.spread > kRowsBad)
    say(Judgement::kBad,
        "rows do not correspond, and not in one way: the eyes are not of one instant, or the images are not "
        "undistorted (then give the raw ones with their raw calibration); " +
            tolerated);
  else if (std::abs(rows.median) > kRowsBad || corner > FollowOptions{}.max_row_offset)
    say(Judgement::kBad, "rows do not correspond, and " + tolerated +
                             ": calibrate anew, or give the raw images with their raw calibration");
  else if (std::abs(rows.median) > kRowsFine || corner > kRowsCornerFine)
    say(Judgement::kWarning, "the rectification is a little off; " + tolerated);
  else if (std::max(rows.spread, pair_scatter) > kRowsScatterFine)
    say(Judgement::kWarning,
        "rows scatter: the images are not undistorted well, the eyes are not exposed together, or a camera "
        "is loose");
  return finding;
}

Finding judge_sign(const DisparityStatistics& disparities) {
  Finding finding{.name = "sign"};
  finding.values = {{"negative", disparities.negative}, {"positive", disparities.positive}};
  finding.text = fmt::format("{:.1f} % of the disparities are clearly negative, {:.1f} % clearly positive",
                             100 * disparities.negative, 100 * disparities.positive);
  if (disparities.matches < static_cast<int>(kFewMatches)) return finding;
  if (seem_swapped(disparities)) {
    finding.judgement = Judgement::kBad;
    finding.advice = "left and right seem to be swapped: exchange the two folders (or cameras)";
  } else if (disparities.negative > 0.05) {
    finding.judgement = Judgement::kWarning;
    finding.advice =
        "points in front of the cameras have positive ones: the calibration is not of this rig, or the eyes "
        "squint";
  }
  return finding;
}

std::vector<Finding> check_recording(const RecordingSample& sample) {
  const TimeSteps steps = measure_times(sample.times);
  std::vector<Finding> findings = {judge_pairs(sample)};
  if (!sample.pairs.empty()) {
    const std::vector<Finding> rig = judge_rig(sample, steps.median);
    findings.insert(findings.end(), rig.begin(), rig.end());
    findings.push_back(judge_images(sample.pairs));
  }
  findings.push_back(judge_times(steps));
  findings.push_back(judge_calibration(sample.rig));
  return findings;
}

Judgement worst_judgement(std::span<const Finding> findings) {
  Judgement worst = Judgement::kOk;
  for (const Finding& finding : findings) worst = std::max(worst, finding.judgement);
  return worst;
}

}  // namespace spslam
