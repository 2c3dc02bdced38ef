// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// EuRoC MAV (Burri et al., IJRR 2016): mav0/cam0|cam1/{data.csv, data/, sensor.yaml}, raw images, truth of
// the body in mav0/state_groundtruth_estimate0/data.csv.

#include <cmath>

#include "spslam/base/error.h"
#include "spslam/io/euroc.h"
#include "spslam/io/image_sequence.h"
#include "spslam/io/text.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;

// Wraps around instead of overflowing; times of nonsense files are far apart either way.
std::uint64_t distance_ns(std::int64_t a, std::int64_t b) {
  const auto x = static_cast<std::uint64_t>(a), y = static_cast<std::uint64_t>(b);
  return a > b ? x - y : y - x;
}

EurocSensor read_sensor(const fs::path& file) {
  if (!fs::exists(file)) throw InputError("calibration is missing: there is no " + file.string());
  return parse_euroc_sensor(read_text_file(file), file.string());
}

// The errors of a pair name both of its files.
RawStereo raw_pair(const EurocSensor& left, const EurocSensor& right, const fs::path& left_file,
                   const fs::path& right_file) {
  RawStereo raw{left.camera, right.camera, right.body_from_camera.inverse() * left.body_from_camera};
  try {
    raw.check();
  } catch (const InputError& error) {
    throw InputError(left_file.string() + ", " + right_file.string() + ": " + error.what());
  }
  return raw;
}

std::vector<EurocImage> read_images(const fs::path& file) {
  if (!fs::exists(file)) throw InputError(file.string() + " is missing; it lists `t_ns,filename` of one eye");
  std::vector<EurocImage> images = parse_euroc_images(read_text_file(file), file.string());
  if (images.empty()) throw InputError(file.string() + " lists no images");
  return images;
}

void find_pairs(ImageSequence& sequence, const fs::path& root, const DatasetOptions& options) {
  const std::vector<EurocImage> left = read_images(root / "cam0" / "data.csv");
  const std::vector<EurocImage> right = read_images(root / "cam1" / "data.csv");
  const auto pairs = pair_by_time(left, right, std::llround(options.pair_tolerance * 1e9));
  if (pairs.empty())
    throw InputError(root.string() + ": none of " + std::to_string(left.size()) + " left and " +
                     std::to_string(right.size()) + " right images are within " +
                     fixed_text(options.pair_tolerance, 6) +
                     " s of each other; are both of one recording? --pair-tolerance sets the limit");
  for (const auto& [l, r] : pairs) {
    sequence.times.push_back(static_cast<double>(left[l].time_ns) * 1e-9);
    sequence.left.push_back(root / "cam0" / "data" / left[l].file);
    sequence.right.push_back(root / "cam1" / "data" / right[r].file);
  }
  sequence.unpaired = static_cast<int>(left.size() + right.size() - 2 * pairs.size());
}

}  // namespace

std::vector<EurocImage> parse_euroc_images(std::string_view text, const std::string& name) {
  std::vector<EurocImage> images;
  for (LineReader reader(text, name); reader.next();) {
    const std::vector<std::string_view> words = reader.fields(',');
    if (words.size() != 2)
      reader.fail("has " + std::to_string(words.size()) + " columns, needs `t_ns,filename`");
    const std::int64_t time = reader.integer(words[0]);
    if (!images.empty() && time <= images.back().time_ns)
      reader.fail("time " + std::to_string(time) + " ns does not come after " +
                  std::to_string(images.back().time_ns) +
                  " ns before it; times must increase from line to line, correct the file");
    const std::string file = fs::path(words[1]).filename().string();
    if (file.empty() || file != words[1])
      reader.fail(in_quotes(words[1]) + " is not the name of a file in data/");
    images.push_back({time, file});
  }
  return images;
}

std::vector<std::pair<int, int>> pair_by_time(std::span<const EurocImage> left,
                                              std::span<const EurocImage> right, std::int64_t tolerance_ns) {
  const auto limit = static_cast<std::uint64_t>(tolerance_ns);
  std::vector<std::pair<int, int>> pairs;
  std::size_t l = 0, r = 0;
  while (l < left.size() && r < right.size()) {
    const std::int64_t tl = left[l].time_ns, tr = right[r].time_ns;
    const std::uint64_t distance = distance_ns(tl, tr);
    if (distance > limit) {
      ++(tl < tr ? l : r);
    } else if (r + 1 < right.size() && distance_ns(tl, right[r + 1].time_ns) < distance) {
      ++r;
    } else if (l + 1 < left.size() && distance_ns(left[l + 1].time_ns, tr) < distance) {
      ++l;
    } else {
      pairs.emplace_back(static_cast<int>(l++), static_cast<int>(r++));
    }
  }
  return pairs;
}

ImageSequence find_euroc(const fs::path& folder, const DatasetOptions& options) {
  if (options.rate > 0)
    throw OptionError("--rate does not go with EuRoC's folders: each image has its time; remove it");
  ImageSequence sequence(DatasetFormat::kEuroc, folder);
  const fs::path root = fs::is_directory(folder / "mav0") ? folder / "mav0" : folder;
  if (options.calibration.empty()) {
    const fs::path left_file = root / "cam0" / "sensor.yaml", right_file = root / "cam1" / "sensor.yaml";
    const EurocSensor left = read_sensor(left_file);
    sequence.truth_body_from_left = left.body_from_camera;
    sequence.calibration.raw = raw_pair(left, read_sensor(right_file), left_file, right_file);
    sequence.calibration_file = left_file;
  } else {
    find_calibration(sequence, {}, options);
    if (fs::exists(root / "cam0" / "sensor.yaml"))
      sequence.truth_body_from_left = read_sensor(root / "cam0" / "sensor.yaml").body_from_camera;
  }
  find_pairs(sequence, root, options);
  const TruthFile truth[] = {{root / "state_groundtruth_estimate0" / "data.csv", TrajectoryFormat::kEuroc}};
  find_truth(sequence, truth, options);
  return sequence;
}

}  // namespace spslam
