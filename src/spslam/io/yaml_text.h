// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// YAML with this project's errors: every yaml-cpp exception becomes an InputError that names file and line.
#pragma once

#include <yaml-cpp/yaml.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spslam {

class YamlMap {
 public:
  // Throws InputError unless the text is a YAML map. A first line %YAML:1.0, as OpenCV writes it, is skipped.
  static YamlMap parse(std::string_view text, std::string name);

  bool has(const std::string& key) const { return node_[key].IsDefined(); }
  // All of these throw InputError if the key is missing or of another kind.
  double real(const std::string& key) const;
  int integer(const std::string& key) const;
  std::string word(const std::string& key) const;
  std::vector<double> reals(const std::string& key) const;
  YamlMap map(const std::string& key) const;
  // Throws InputError for a key that is not among `known`, with the nearest that is.
  void require_known(std::span<const std::string> known) const;
  [[noreturn]] void fail(const std::string& key, const std::string& what) const;

 private:
  YamlMap(const YAML::Node& node, std::string name) : node_(node), name_(std::move(name)) {}
  YAML::Node child(const std::string& key) const;
  double real(const YAML::Node& node, const std::string& key) const;

  const YAML::Node node_;  // const: the other operator[] adds keys
  std::string name_;
};

}  // namespace spslam
