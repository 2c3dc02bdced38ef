// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// `spslam segment`: draws what the distance segmentation makes of images, as the paper's Figures 9 and 10 do.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <span>

#include "spslam/base/error.h"
#include "spslam/cli/commands.h"
#include "spslam/cli/overlay.h"
#include "spslam/features/orb_extractor.h"
#include "spslam/io/image.h"
#include "spslam/segmentation/distance_segmenter.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;

struct SegmentArguments {
  std::vector<std::string> images, settings;
  std::string output;
  bool sequence = false;
  bool elements = false;
  int features = 1500;
};

// Figure 9 from top to bottom: the image, what is bright, and the regions grown by each element.
cv::Mat draw_elements(const cv::Mat& grey, const SegmentationResult& result, SegmentationOptions options) {
  std::vector<cv::Mat> rows = {grey, grey > std::floor(result.threshold)};
  for (const StructuringElement element :
       {StructuringElement::kDisc15, StructuringElement::kDisc25, StructuringElement::kRect25x15}) {
    options.element = element;
    const cv::Mat small = shrink(grey, options.downscale);
    rows.push_back(result.has_far ? find_regions(small, result.threshold, options, grey.size()).mask()
                                  : cv::Mat(grey.size(), CV_8UC1, cv::Scalar(0)));
    const std::string name = option_names(element)[static_cast<int>(element)];
    cv::putText(rows.back(), name, {8, grey.rows - 10}, cv::FONT_HERSHEY_SIMPLEX, 0.6, cv::Scalar(128), 2);
  }
  cv::Mat picture;
  cv::vconcat(rows, picture);
  for (int y = grey.rows; y < picture.rows; y += grey.rows) picture.row(y).setTo(128);
  return picture;
}

void write(const fs::path& path, const cv::Mat& picture) {
  bool written = false;
  try {
    written = cv::imwrite(path.string(), picture);
  } catch (const cv::Exception&) {
  }
  if (!written) throw OutputError(path.string() + " cannot be written; check the folder and the free space");
}

// One name for each image, so that none overwrites another's result.
std::string unused_name(const fs::path& image, std::set<std::string>& used) {
  const std::string stem = image.stem().string();
  std::string name = stem;
  for (int i = 2; !used.insert(name).second; ++i) name = stem + "_" + std::to_string(i);
  return name;
}

void print_line(const std::string& image, const SegmentationResult& result, std::span<const Region> labels) {
  const auto count = [&](Region region) { return std::count(labels.begin(), labels.end(), region); };
  std::printf(
      "%s: threshold %.1f, bimodality %.2f, contrast %.0f, bright %.0f %%; features near %td, far %td, "
      "mirror %td%s\n",
      image.c_str(), result.threshold, result.bimodality, result.contrast, 100 * result.bright_share,
      count(Region::kNear), count(Region::kFar), count(Region::kMirror),
      result.held ? " (regions of the image before)" : "");
}

SegmentationOptions segmentation_options(const SegmentArguments& arguments) {
  SegmentationOptions options;
  for (const std::string& setting : arguments.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) throw OptionError("--set " + setting + ": give it as name=value");
    // As `spslam run` has it, too.
    constexpr std::string_view kPrefix = "tracker.segmentation.";
    std::string key = setting.substr(0, equals);
    if (key.starts_with(kPrefix)) key.erase(0, kPrefix.size());
    set_option(options, key, setting.substr(equals + 1));
  }
  check_options(options);
  return options;
}

int segment(const SegmentArguments& arguments) {
  const SegmentationOptions options = segmentation_options(arguments);
  const fs::path folder = arguments.output;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + " cannot be made: " + error.message());
  OrbOptions orb;
  orb.count = arguments.features;
  OrbExtractor extractor(orb);
  DistanceSegmenter segmenter(options);
  std::set<std::string> used;
  int bad = 0;
  for (const std::string& image : arguments.images) {
    const GreyImage grey = read_grey(image);
    if (!grey.problem.empty()) {
      std::fprintf(stderr, "spslam: %s: %s\n", image.c_str(), grey.problem.c_str());
      ++bad;
      continue;
    }
    if (!arguments.sequence) segmenter = DistanceSegmenter(options);
    const SegmentationResult result = segmenter.update(grey.pixels);
    const std::vector<Keypoint> keypoints = extractor.extract(grey.pixels).keypoints;
    print_line(image, result, label_keypoints(result.regions, keypoints));
    const std::string name = unused_name(image, used);
    write(folder / (name + "_overlay.png"), draw_overlay(grey.pixels, result.regions, keypoints));
    write(folder / (name + "_mask.png"), result.regions.mask());
    if (arguments.elements)
      write(folder / (name + "_elements.png"), draw_elements(grey.pixels, result, options));
  }
  return bad > 0 ? 1 : 0;
}

std::string describe_options() {
  std::string text = "KEYs of --set and their defaults:\n";
  for (const OptionText& option : list_options(SegmentationOptions{})) {
    text += "  " + option.key + "=" + option.value + (option.unit.empty() ? "" : " " + option.unit) + ": " +
            option.meaning + "\n";
  }
  return text;
}

}  // namespace

void add_segment(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("segment", "Tell near from far in images and draw it");
  const auto arguments = std::make_shared<SegmentArguments>();
  command->add_option("IMAGES", arguments->images, "PNG or JPEG files, left images of a rig")->required();
  command
      ->add_option("--output,-o", arguments->output,
                   "Folder for NAME_mask.png and NAME_overlay.png (features: near green, far red, mirror "
                   "image orange)")
      ->required()
      ->type_name("DIR");
  command->add_flag(
      "--sequence", arguments->sequence,
      "The images are consecutive frames: average their histograms, limit the threshold's rate");
  command->add_flag("--elements", arguments->elements,
                    "Also write NAME_elements.png: image, bright pixels, and all three structuring elements");
  command->add_option("--features", arguments->features, "Features to draw")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--set", arguments->settings, "Set an option of the segmentation; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->footer(describe_options);
  command->callback([arguments, &chosen] { chosen = [arguments] { return segment(*arguments); }; });
}

}  // namespace spslam
