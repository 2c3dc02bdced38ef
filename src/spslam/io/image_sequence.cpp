// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/image_sequence.h"

#include <algorithm>
#include <map>

#include "spslam/base/error.h"
#include "spslam/io/text.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool all_digits(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

// "9" before "10": runs of digits are compared as numbers.
struct NaturalLess {
  bool operator()(const std::string& a, const std::string& b) const {
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
      if (!is_digit(a[i]) || !is_digit(b[j])) {
        if (a[i] != b[j]) return a[i] < b[j];
        ++i, ++j;
        continue;
      }
      const std::string x = digits(a, i), y = digits(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    }
    if ((i < a.size()) != (j < b.size())) return j < b.size();
    return a < b;  // "01" and "1"
  }
  static std::string digits(const std::string& text, std::size_t& at) {
    while (at + 1 < text.size() && text[at] == '0' && is_digit(text[at + 1])) ++at;
    const std::size_t begin = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return text.substr(begin, at - begin);
  }
};

using Images = std::map<std::string, fs::path, NaturalLess>;  // by name without extension

Images list_images(const fs::path& folder) {
  std::error_code code;
  if (!fs::is_directory(folder, code))
    throw InputError(folder.string() + " is missing; it must hold the images of one eye");
  Images images;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::string extension = entry.path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    if (extension != ".png" && extension != ".jpg" && extension != ".jpeg") continue;
    const auto [at, is_new] = images.emplace(entry.path().stem().string(), entry.path());
    if (!is_new)
      throw InputError(folder.string() + " holds both " + at->second.filename().string() + " and " +
                       entry.path().filename().string() + "; remove one");
  }
  if (images.empty()) throw InputError(folder.string() + " holds no PNG or JPEG images");
  return images;
}

std::string counts(const Images& left, const fs::path& left_folder, const Images& right,
                   const fs::path& right_folder) {
  return left_folder.string() + " has " + std::to_string(left.size()) + " images and " +
         right_folder.string() + " has " + std::to_string(right.size());
}

struct Frames {
  std::vector<std::string> names;
  std::vector<fs::path> left, right;
};

// Names that have nothing in common (left_0001, right_0001): the n-th left belongs to the n-th right image.
Frames pair_in_order(const Images& left, const Images& right) {
  Frames frames;
  for (const auto& [name, path] : left) frames.names.push_back(name), frames.left.push_back(path);
  for (const auto& [name, path] : right) frames.right.push_back(path);
  return frames;
}

Frames pair_by_name(const Images& left, const Images& right, const fs::path& left_folder,
                    const fs::path& right_folder, const std::vector<std::string>& names) {
  const std::string extension = left.begin()->second.extension().string();
  const auto path_in = [&](const Images& images, const fs::path& folder, const std::string& name) {
    const auto at = images.find(name);
    return at == images.end() ? folder / (name + extension) : at->second;
  };
  Frames frames;
  for (const std::string& name : names) {
    frames.names.push_back(name);
    frames.left.push_back(path_in(left, left_folder, name));
    frames.right.push_back(path_in(right, right_folder, name));
  }
  return frames;
}

// All names of both eyes. An eye that ends before the other is a broken copy, not a lost image.
std::vector<std::string> all_names(const Images& left, const Images& right, const std::string& what) {
  Images both = left;
  both.insert(right.begin(), right.end());
  for (const Images* eye : {&left, &right})
    if (both.rbegin()->first != eye->rbegin()->first)
      throw InputError(what + "; the " + (eye == &left ? "left" : "right") + " ones end at " +
                       eye->rbegin()->first + ", the others at " + both.rbegin()->first +
                       ". Copy what is missing or remove what is too much");
  std::vector<std::string> names;
  for (const auto& [name, path] : both) names.push_back(name);
  return names;
}

// 000000 to the last number when both eyes lack the same images and the times tell so; nothing otherwise.
std::vector<std::string> numbered_names(const std::vector<std::string>& names, std::size_t count) {
  const std::string& last = names.back();
  const bool numbers = std::all_of(names.begin(), names.end(), all_digits) && last.size() < 10;
  if (!numbers || std::stoul(last) + 1 != count) return {};
  std::map<std::size_t, std::string> known;
  for (const std::string& name : names) known[std::stoul(name)] = name;
  std::vector<std::string> all;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string digits = std::to_string(i);
    const auto at = known.find(i);
    all.push_back(at != known.end() ? at->second : std::string(last.size() - digits.size(), '0') + digits);
  }
  return all;
}

std::vector<double> times_of(const fs::path& file, std::size_t frames, const DatasetOptions& options) {
  std::vector<double> times;
  if (options.rate > 0) {
    for (std::size_t i = 0; i < frames; ++i) times.push_back(static_cast<double>(i) / options.rate);
    return times;
  }
  if (!fs::exists(file))
    throw InputError(
        file.string() +
        " is missing; it holds the time of each frame in seconds, one a line, or give the frame rate (rate)");
  return parse_times(read_text_file(file), file.string());
}

}  // namespace

void find_frames(ImageSequence& sequence, const fs::path& left_folder, const fs::path& right_folder,
                 const fs::path& times, const DatasetOptions& options) {
  const Images left = list_images(left_folder), right = list_images(right_folder);
  const std::string what = counts(left, left_folder, right, right_folder);
  const bool common =
      std::any_of(left.begin(), left.end(), [&](const auto& image) { return right.contains(image.first); });
  if (!common && left.size() != right.size())
    throw InputError(what +
                     ", and no names in common; left and right of a pair must have the same name, or the "
                     "same place in the order");
  Frames frames = common ? pair_by_name(left, right, left_folder, right_folder, all_names(left, right, what))
                         : pair_in_order(left, right);
  sequence.times = times_of(times, frames.names.size(), options);
  if (sequence.times.size() != frames.names.size()) {
    const std::vector<std::string> names =
        common ? numbered_names(frames.names, sequence.times.size()) : std::vector<std::string>();
    if (names.empty())
      throw InputError(times.string() + " has " + std::to_string(sequence.times.size()) +
                       " times, there are " + std::to_string(frames.names.size()) + " frames (" + what +
                       "); each frame needs one line");
    frames = pair_by_name(left, right, left_folder, right_folder, names);
  }
  sequence.left = std::move(frames.left), sequence.right = std::move(frames.right);
}

void find_calibration(ImageSequence& sequence, std::span<const fs::path> candidates,
                      const DatasetOptions& options) {
  if (!options.calibration.empty()) {
    sequence.calibration_file = options.calibration;
  } else {
    const auto found = std::find_if(candidates.begin(), candidates.end(),
                                    [](const fs::path& path) { return fs::exists(path); });
    if (found == candidates.end())
      throw InputError("calibration is missing: there is no " + candidates.front().string() +
                       "; add it or give another file with the option calibration");
    sequence.calibration_file = *found;
  }
  sequence.calibration = read_calibration(sequence.calibration_file);
}

}  // namespace spslam
