// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/image_names.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "spslam/base/error.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDigits = "0123456789";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::string_view leading_digits(std::string_view text) {
  return text.substr(0, std::min(text.find_first_not_of(kDigits), text.size()));
}

// Keys are made so that their order as text is the order of what they stand for. Of digits: without leading
// zeros, behind their count (file names have at most 255 characters).
std::string integer_key(std::string_view digits) {
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return std::string(1, static_cast<char>(digits.size())).append(digits);
}

std::string decimal_key(std::string_view whole, std::string_view fraction) {
  const std::size_t last = fraction.find_last_not_of('0');
  return integer_key(whole) + std::string(fraction.substr(0, last == fraction.npos ? 0 : last + 1));
}

// "9" before "10". The name itself at the end tells "1" from "01".
std::string natural_key(const std::string& name) {
  std::string key;
  for (std::string_view rest = name; !rest.empty();) {
    const std::string_view digits = leading_digits(rest);
    key += digits.empty() ? rest[0] : '0';
    if (!digits.empty()) key += integer_key(digits);
    rest.remove_prefix(std::max<std::size_t>(1, digits.size()));
  }
  return key + '\0' + name;
}

using Images = std::map<std::string, fs::path>;  // by name without extension, later by key

// Names that begin with a dot are hidden files, such as the ._NAME.jpg of macOS, which are no images.
bool is_image(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const bool known = extension == ".png" || extension == ".jpg" || extension == ".jpeg";
  return known && !file.filename().string().starts_with('.');
}

Images list_images(const fs::path& folder) {
  std::error_code code;
  if (!fs::is_directory(folder, code))
    throw InputError(folder.string() + " is missing; it must hold the images of one eye");
  Images images;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!is_image(entry.path())) continue;
    const auto [at, is_new] = images.emplace(entry.path().stem().string(), entry.path());
    if (!is_new)
      throw InputError(folder.string() + " holds both " + at->second.filename().string() + " and " +
                       entry.path().filename().string() + "; remove one");
  }
  if (images.empty()) throw InputError(folder.string() + " holds no PNG or JPEG images");
  return images;
}

// One eye's images in order.
struct Eye {
  fs::path folder;
  Images images;               // by key
  std::string prefix, suffix;  // of every name, around the number that is its key

  // The part of a name that tells its frame: the number, or all of it.
  std::string label(const fs::path& image) const {
    const std::string name = image.stem().string();
    return name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
  }
  // The image, or where it would be.
  fs::path path(const std::string& key, const std::string& its_label) const {
    const auto at = images.find(key);
    if (at != images.end()) return at->second;
    return folder / (prefix + its_label + suffix + images.begin()->second.extension().string());
  }
};

// The longest beginning that all names have, without a number that it cuts.
std::string common_prefix(const Images& images) {
  std::string_view prefix = images.begin()->first;
  const std::string& last = images.rbegin()->first;  // in the order of text the first and last differ most
  prefix = prefix.substr(
      0, static_cast<std::size_t>(
             std::mismatch(prefix.begin(), prefix.end(), last.begin(), last.end()).first - prefix.begin()));
  const auto drop_digits = [&] {
    while (!prefix.empty() && is_digit(prefix.back())) prefix.remove_suffix(1);
  };
  drop_digits();
  if (prefix.size() > 1 && prefix.back() == '.' && is_digit(prefix[prefix.size() - 2])) {
    prefix.remove_suffix(1);
    drop_digits();
  }
  return std::string(prefix);
}

// Nothing unless each name has a number of its own between what all names have.
std::optional<Eye> numbered_eye(const fs::path& folder, const Images& images) {
  Eye eye{folder, {}, common_prefix(images), {}};
  for (const auto& [name, path] : images) {
    const std::string_view rest = std::string_view(name).substr(eye.prefix.size());
    const std::string_view whole = leading_digits(rest);
    std::string_view fraction;
    if (rest.substr(whole.size()).starts_with('.')) fraction = leading_digits(rest.substr(whole.size() + 1));
    const std::string_view suffix = rest.substr(whole.size() + (fraction.empty() ? 0 : fraction.size() + 1));
    if (eye.images.empty()) eye.suffix = suffix;
    if (whole.empty() || suffix != eye.suffix) return std::nullopt;
    if (!eye.images.emplace(decimal_key(whole, fraction), path).second) return std::nullopt;
  }
  return eye;
}

Eye named_eye(const fs::path& folder, const Images& images) {
  Eye eye{folder, {}, {}, {}};
  for (const auto& [name, path] : images) eye.images.emplace(natural_key(name), path);
  return eye;
}

bool have_common_keys(const Eye& left, const Eye& right) {
  return std::any_of(left.images.begin(), left.images.end(),
                     [&](const auto& image) { return right.images.contains(image.first); });
}

using Labels = std::map<std::string, std::string>;  // of the frames, by key

// Those of both eyes.
Labels frame_labels(const Eye& left, const Eye& right, const std::string& found) {
  Labels labels;
  for (const Eye* eye : {&left, &right})
    for (const auto& [key, path] : eye->images) labels.emplace(key, eye->label(path));
  for (const Eye* eye : {&left, &right}) {
    const auto& [key, path] = *eye->images.rbegin();
    if (key != labels.rbegin()->first)
      throw InputError(found + "; the " + (eye == &left ? "left" : "right") + " ones end at " +
                       eye->label(path) + ", the others at " + labels.rbegin()->second +
                       ". Copy what is missing or remove what is too much");
  }
  return labels;
}

// Adds what is lacking of 0 to the last number if that makes `frames` of them.
void add_lost_frames(Labels& labels, std::size_t frames) {
  const std::string last = labels.rbegin()->second;
  const bool integers = std::all_of(labels.begin(), labels.end(), [](const auto& label) {
    return std::all_of(label.second.begin(), label.second.end(), is_digit);
  });
  constexpr std::size_t kMostDigits = 9;
  if (!integers || integer_key(last).size() - 1 > kMostDigits || std::stoull(last) + 1 != frames) return;
  for (std::size_t i = 0; i < frames; ++i) {
    std::string digits = std::to_string(i);
    if (digits.size() < last.size()) digits.insert(0, last.size() - digits.size(), '0');
    labels.emplace(integer_key(digits), digits);
  }
}

ImagePairs pair_by_key(const Eye& left, const Eye& right, const Labels& labels) {
  ImagePairs pairs;
  for (const auto& [key, label] : labels) {
    pairs.left.push_back(left.path(key, label));
    pairs.right.push_back(right.path(key, label));
  }
  return pairs;
}

ImagePairs pair_in_order(const Eye& left, const Eye& right, const std::string& found) {
  if (left.images.size() != right.images.size())
    throw InputError(found +
                     ", and no names or numbers in common; both images of a pair must have the same name or "
                     "the same number in it");
  ImagePairs pairs;
  for (const auto& [key, path] : left.images) pairs.left.push_back(path);
  for (const auto& [key, path] : right.images) pairs.right.push_back(path);
  pairs.warning = left.folder.string() + " and " + right.folder.string() +
                  " have no names or numbers in common, so the n-th left image is taken with the n-th right "
                  "one (" +
                  pairs.left.front().filename().string() + " with " +
                  pairs.right.front().filename().string() +
                  "); one lost image would shift all pairs behind it: give both images of a pair one name";
  return pairs;
}

}  // namespace

ImagePairs pair_images(const fs::path& left_folder, const fs::path& right_folder, std::size_t frames) {
  const Images left = list_images(left_folder), right = list_images(right_folder);
  const std::string found = left_folder.string() + " has " + std::to_string(left.size()) + " images and " +
                            right_folder.string() + " has " + std::to_string(right.size());
  const std::optional<Eye> l = numbered_eye(left_folder, left), r = numbered_eye(right_folder, right);
  const Eye named_l = named_eye(left_folder, left), named_r = named_eye(right_folder, right);
  ImagePairs pairs;
  if (l && r && have_common_keys(*l, *r)) {
    Labels labels = frame_labels(*l, *r, found);
    if (labels.size() != frames) add_lost_frames(labels, frames);
    pairs = pair_by_key(*l, *r, labels);
  } else if (have_common_keys(named_l, named_r)) {
    pairs = pair_by_key(named_l, named_r, frame_labels(named_l, named_r, found));
  } else {
    pairs = pair_in_order(l.value_or(named_l), r.value_or(named_r), found);
  }
  pairs.found = found;
  return pairs;
}

}  // namespace spslam
