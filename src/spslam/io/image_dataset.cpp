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

struct ReadablePair {
  std::size_t index;
  cv::Size size;
  bool sixteen_bit;
};

// Nothing, and the reason, unless both images can be read, have one size and are more than a speck.
std::optional<ReadablePair> read_pair(const ImageSequence& sequence, std::size_t i, std::string& reason) {
  constexpr int kSmallest = 8;  // px
  const GreyImage left = read_grey_raw(sequence.left[i]), right = read_grey_raw(sequence.right[i]);
  const cv::Size size = left.pixels.size(), right_size = right.pixels.size();
  if (!left.problem.empty())
    reason = sequence.left[i].string() + ": " + left.problem;
  else if (!right.problem.empty())
    reason = sequence.right[i].string() + ": " + right.problem;
  else if (size != right_size)
    reason = sequence.left[i].string() + " is " + size_text(size) + " and " + sequence.right[i].string() +
             " is " + size_text(right_size) + "; both eyes must have one size, are these two of one rig?";
  else if (std::min(size.width, size.height) < kSmallest)
    reason = sequence.left[i].string() + " is only " + size_text(size);
  else
    return ReadablePair{i, size, left.pixels.depth() == CV_16U};
  return std::nullopt;
}

std::vector<ReadablePair> first_readable_pairs(const ImageSequence& sequence) {
  constexpr std::size_t kWanted = 5, kTries = 100;
  std::vector<ReadablePair> pairs;
  std::string first_reason;
  for (std::size_t i = 0; i < std::min(kTries, sequence.left.size()) && pairs.size() < kWanted; ++i) {
    std::string reason;
    if (const std::optional<ReadablePair> pair = read_pair(sequence, i, reason)) pairs.push_back(*pair);
    if (first_reason.empty()) first_reason = reason;
  }
  if (pairs.empty())
    throw InputError(sequence.folder.string() + ": none of the first pairs can be used (" + first_reason +
                     ")");
  return pairs;
}

// One of the first pairs, of the size that the calibration states or, if it does not, that most of them have:
// an odd pair in front must not make all others wrong.
ReadablePair typical_pair(const ImageSequence& sequence, cv::Size stated) {
  const std::vector<ReadablePair> pairs = first_readable_pairs(sequence);
  const auto votes = [&](const ReadablePair& pair) {
    return std::count_if(pairs.begin(), pairs.end(),
                         [&](const auto& other) { return other.size == pair.size; });
  };
  std::string sizes;
  for (const ReadablePair& pair : pairs) {
    if (stated.empty() ? 2 * votes(pair) > std::ssize(pairs) : pair.size == stated) return pair;
    sizes += (sizes.empty() ? "" : ", ") + sequence.left[pair.index].filename().string() + " " +
             size_text(pair.size);
  }
  if (stated.empty())
    throw InputError(sequence.folder.string() +
                     ": the first images have several sizes, none of them more "
                     "than half of the time (" +
                     sizes +
                     "); remove those of another size or give a calibration that states the size "
                     "(--calibration, YAML)");
  throw InputError(sequence.calibration_file.string() + " is for images of " + size_text(stated) + ", but " +
                   sequence.left[pairs[0].index].string() + " is " + size_text(pairs[0].size) +
                   "; give the calibration of this image size (--calibration)");
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
// another one. Rectified images are centred within a few per cent, and twice or half their size would put it
// at 0.25 or at the edge.
void check_unstated_size(const StereoRig& rig, const ImageSequence& sequence) {
  const auto central = [](double at, int length) { return at > 0.35 * length && at < 0.65 * length; };
  if (!central(rig.cx, rig.width) || !central(rig.cy, rig.height))
    throw InputError(
        sequence.calibration_file.string() + ": the principal point " + fixed_text(rig.cx, 1) + ", " +
        fixed_text(rig.cy, 1) + " px is far from the middle of images of " +
        size_text({rig.width, rig.height}) +
        "; if this is the calibration of another image size, give the right one (--calibration FILE); if it "
        "is right, state the size: the same values in a YAML file with width and height");
}

// Values that are right in another unit: nothing can tell for sure, so they are warnings.
void check_units(const ImageSequence& sequence, const StereoRig& rig, std::vector<std::string>& warnings) {
  constexpr double kLongest = 10, kShortest = 0.0005;  // s between frames
  constexpr double kNarrowest = 0.01, kWidest = 5;     // m
  if (const std::size_t frames = sequence.times.size(); frames > 1) {
    const double interval =
        (sequence.times.back() - sequence.times.front()) / static_cast<double>(frames - 1);
    if (interval > kLongest || interval < kShortest)
      warnings.push_back(sequence.folder.string() + ": the mean time between frames is " +
                         detail::print_double(interval) + " s; are the times in seconds?");
  }
  if (rig.baseline < kNarrowest || rig.baseline > kWidest)
    warnings.push_back(sequence.calibration_file.string() + ": the baseline is " +
                       detail::print_double(rig.baseline) + " m; is it in metres?");
}

class ImageDataset final : public Dataset {
 public:
  ImageDataset(ImageSequence sequence, const DatasetOptions& options) : sequence_(std::move(sequence)) {
    set_rig();
    const ReadablePair pair = typical_pair(sequence_, {rig_.width, rig_.height});
    image_size_ = pair.size;
    if (rig_.width == 0) set_unstated_size(pair.size);
    check_units(sequence_, rig_, sequence_.warnings);
    bit_depth_ = pair.sixteen_bit ? sequence_bit_depth(sequence_, options) : 16;
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

  // As the calibration has it: without a size if it states none.
  void set_rig() {
    if (sequence_.calibration.raw) {
      rectifier_.emplace(*sequence_.calibration.raw);
      rig_ = rectifier_->rig();
    } else {
      rig_ = sequence_.calibration.rig;
      if (rig_.width > 0) rig_.check();
    }
  }

  void set_unstated_size(cv::Size size) {
    rig_.width = size.width, rig_.height = size.height;
    rig_.check();
    check_unstated_size(rig_, sequence_);
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
