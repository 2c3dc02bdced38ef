// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/yaml_text.h"

#include <charconv>
#include <cmath>

#include "spslam/base/error.h"
#include "spslam/base/options.h"
#include "spslam/io/text.h"

namespace spslam {

YamlMap YamlMap::parse(std::string_view text, std::string name) {
  constexpr std::size_t kLargest =
      1 << 20;  // a calibration has a few hundred bytes; the parser is slow on nonsense
  if (text.size() > kLargest) throw InputError(name + ": is larger than 1 MB, this is no calibration");
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string body(text);
  if (body.starts_with("%YAML:")) body[0] = '#';  // keeps the line numbers
  try {
    const YAML::Node node = YAML::Load(body);
    if (!node.IsMap()) throw InputError(name + ": holds no `key: value` lines; is this the right file?");
    return {node, std::move(name)};
  } catch (const YAML::Exception& error) {
    throw InputError(name + ":" + std::to_string(error.mark.line + 1) + ": not valid YAML (" + error.msg +
                     ")");
  }
}

void YamlMap::fail(const std::string& key, const std::string& what) const {
  const YAML::Node node = node_[key];
  const YAML::Mark mark = node.IsDefined() ? node.Mark() : node_.Mark();
  throw InputError(name_ + ":" + std::to_string(mark.line + 1) + ": " + key + " " + what);
}

YAML::Node YamlMap::child(const std::string& key) const {
  YAML::Node node = node_[key];
  if (!node.IsDefined()) throw InputError(name_ + ": " + key + " is missing; add it");
  return node;
}

double YamlMap::real(const YAML::Node& node, const std::string& key) const {
  double value = 0;
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [stop, code] = std::from_chars(begin, text.data() + text.size(), value);
  if (code != std::errc() || stop != text.data() + text.size() || !std::isfinite(value))
    fail(key, "must be a finite number, is " + in_quotes(text));
  return value;
}

double YamlMap::real(const std::string& key) const {
  return real(child(key), key);
}

int YamlMap::integer(const std::string& key) const {
  const double value = real(key);
  if (value != std::floor(value) || std::abs(value) > 1e6)
    fail(key, "must be a whole number, is " + fixed_text(value, 3));
  return static_cast<int>(value);
}

std::string YamlMap::word(const std::string& key) const {
  const YAML::Node node = child(key);
  if (!node.IsScalar()) fail(key, "must be a single word");
  return node.Scalar();
}

std::vector<double> YamlMap::reals(const std::string& key) const {
  const YAML::Node node = child(key);
  if (!node.IsSequence()) fail(key, "must be a list of numbers in [ ]");
  std::vector<double> values;
  for (const YAML::Node& value : node) values.push_back(real(value, key));
  return values;
}

YamlMap YamlMap::map(const std::string& key) const {
  const YAML::Node node = child(key);
  if (!node.IsMap()) fail(key, "must hold `key: value` lines");
  return {node, name_};
}

void YamlMap::require_known(std::span<const std::string> known) const {
  for (const auto& entry : node_) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string nearest = nearest_name(key, known);
    throw InputError(name_ + ":" + std::to_string(entry.first.Mark().line + 1) + ": unknown key " +
                     in_quotes(key) + (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
  }
}

}  // namespace spslam
