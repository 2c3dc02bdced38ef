// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The one Dataset behind all folders of images.

#include <algorithm>

#include "spslam/base/error.h"
#include "spslam/io/image.h"
#include "spslam/io/image_sequence.h"
#include "spslam/io/text.h"

namespace spslam {
namespace {

std::string size_text(cv::Size size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height) + " px";
}

struct FirstPair {
  cv::Size size;
  bool sixteen_bit = false;
  std::filesystem::path left;
};

// The first pair whose images can both be read and are more than a speck.
FirstPair first_readable_pair(const ImageSequence& sequence) {
  constexpr int kSmallest = 8;  // px
  constexpr std::size_t kTries = 100;
  std::string problem;
  for (std::size_t i = 0; i < std::min(kTries, sequence.left.size()); ++i) {
    const GreyImage left = read_grey_raw(sequence.left[i]), right = read_grey_raw(sequence.right[i]);
    if (problem.empty() && !left.problem.empty()) problem = sequence.left[i].string() + ": " + left.problem;
    if (problem.empty() && !right.problem.empty())
      problem = sequence.right[i].string() + ": " + right.problem;
    if (std::min({left.pixels.cols, left.pixels.rows, right.pixels.cols, right.pixels.rows}) < kSmallest)
      continue;
    if (left.pixels.size() != right.pixels.size())
      throw InputError(sequence.left[i].string() + " is " + size_text(left.pixels.size()) + " and " +
                       sequence.right[i].string() + " is " + size_text(right.pixels.size()) +
                       "; both eyes must have one size, are these two of one rig?");
    return {left.pixels.size(), left.pixels.depth() == CV_16U, sequence.left[i]};
  }
  throw InputError(sequence.folder.string() + ": none of the first pairs can be read" +
                   (problem.empty() ? " (images are too small)" : " (" + problem + ")"));
}

// One scale for the whole sequence, so that brightness stays comparable: the depth that a few images spread
// over it use.
int sequence_bit_depth(const ImageSequence& sequence, const DatasetOptions& options) {
  if (options.bit_depth > 0) return options.bit_depth;
  int depth = 8;
  const std::size_t last = sequence.left.size() - 1;
  for (std::size_t part = 0; part <= 8; ++part) {
    const GreyImage image = read_grey_raw(sequence.left[last * part / 8]);
    if (image.problem.empty() && image.pixels.depth() == CV_16U)
      depth = std::max(depth, used_bit_depth(image.pixels));
  }
  return depth;
}

// KITTI's calibration does not say its image size; a principal point far from the middle is the sign of
// another one.
void check_unstated_size(const StereoRig& rig, const ImageSequence& sequence) {
  const bool central = rig.cx > 0.2 * rig.width && rig.cx < 0.8 * rig.width && rig.cy > 0.2 * rig.height &&
                       rig.cy < 0.8 * rig.height;
  if (!central)
    throw InputError(sequence.calibration_file.string() + ": the principal point " + fixed_text(rig.cx, 1) +
                     ", " + fixed_text(rig.cy, 1) + " px is far from the middle of images of " +
                     size_text({rig.width, rig.height}) + "; is this the calibration of another image size?");
}

class ImageDataset final : public Dataset {
 public:
  ImageDataset(ImageSequence sequence, const DatasetOptions& options) : sequence_(std::move(sequence)) {
    const FirstPair first = first_readable_pair(sequence_);
    image_size_ = first.size;
    set_rig(first);
    bit_depth_ = first.sixteen_bit ? sequence_bit_depth(sequence_, options) : 16;
    if (rectifier_ && sequence_.ground_truth && !sequence_.planar_ground_truth)
      for (StampedPose& pose : *sequence_.ground_truth)
        pose.world_from_camera = pose.world_from_camera * rectifier_->raw_left_from_rectified();
  }

  const StereoRig& rig() const override { return rig_; }
  int size() const override { return static_cast<int>(sequence_.times.size()); }
  double timestamp(int index) const override { return sequence_.times[checked(index)]; }
  const std::optional<Trajectory>& ground_truth() const override { return sequence_.ground_truth; }
  bool planar_ground_truth() const override { return sequence_.planar_ground_truth; }
  int unpaired() const override { return sequence_.unpaired; }
  const std::vector<std::string>& warnings() const override { return sequence_.warnings; }

  StereoFrame load(int index) const override {
    const std::size_t i = checked(index);
    StereoFrame frame;
    frame.timestamp = sequence_.times[i];
    cv::Mat left = load_image(sequence_.left[i], "left", frame.problem);
    cv::Mat right = load_image(sequence_.right[i], "right", frame.problem);
    if (!frame.problem.empty()) return frame;
    frame.left = rectifier_ ? rectifier_->rectify_left(left) : left;
    frame.right = rectifier_ ? rectifier_->rectify_right(right) : right;
    return frame;
  }

  std::string description() const override {
    const double duration = sequence_.times.back() - sequence_.times.front();
    std::string text = sequence_.folder.string() + " (" +
                       option_names(sequence_.format)[static_cast<int>(sequence_.format)] +
                       "): " + std::to_string(size()) + " pairs of " + size_text(image_size_) +
                       (rectifier_ && rectifier_->resamples() ? ", rectified on loading" : "") + ", " +
                       fixed_text(duration, 1) + " s, fx " + fixed_text(rig_.fx, 1) + " px, baseline " +
                       fixed_text(rig_.baseline, 4) + " m";
    if (sequence_.ground_truth)
      text += ", ground truth of " + std::to_string(sequence_.ground_truth->size()) +
              (sequence_.planar_ground_truth ? " planar poses" : " poses");
    if (sequence_.unpaired > 0)
      text += ", " + std::to_string(sequence_.unpaired) + " images without a partner left out";
    return text;
  }

 private:
  std::size_t checked(int index) const {
    if (index < 0 || index >= size())
      throw InputError("frame " + std::to_string(index) + " does not exist, " + sequence_.folder.string() +
                       " has " + std::to_string(size()) + " (from 0)");
    return static_cast<std::size_t>(index);
  }

  void set_rig(const FirstPair& first) {
    if (sequence_.calibration.raw) {
      rectifier_.emplace(*sequence_.calibration.raw);
      rig_ = rectifier_->rig();
    } else {
      rig_ = sequence_.calibration.rig;
      const bool stated = rig_.width > 0;
      if (!stated) rig_.width = first.size.width, rig_.height = first.size.height;
      rig_.check();
      if (!stated) check_unstated_size(rig_, sequence_);
    }
    if (first.size != cv::Size(rig_.width, rig_.height))
      throw InputError(sequence_.calibration_file.string() + " is for images of " +
                       size_text({rig_.width, rig_.height}) + ", but " + first.left.string() + " is " +
                       size_text(first.size) + "; give the calibration of this image size");
  }

  // The first problem of a pair is told; the other eye's image is then of no use.
  cv::Mat load_image(const std::filesystem::path& path, const char* eye, std::string& problem) const {
    if (!problem.empty()) return {};
    GreyImage image = read_grey(path, bit_depth_);
    if (image.problem.empty() && image.pixels.size() != image_size_)
      image.problem = "is " + size_text(image.pixels.size()) + " instead of " + size_text(image_size_);
    if (!image.problem.empty())
      problem = std::string(eye) + " image " + path.filename().string() + ": " + image.problem;
    return image.pixels;
  }

  ImageSequence sequence_;
  std::optional<Rectifier> rectifier_;
  StereoRig rig_;
  cv::Size image_size_;
  int bit_depth_ = 16;
};

}  // namespace

std::unique_ptr<Dataset> make_image_dataset(ImageSequence sequence, const DatasetOptions& options) {
  return std::make_unique<ImageDataset>(std::move(sequence), options);
}

}  // namespace spslam
