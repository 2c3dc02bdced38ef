// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Options are plain structs with a static fields() that lists every member once: name, unit, meaning, range.
// The YAML loader, --set, --help, `spslam config --print` and check() are all visitors of that one list.
//
//   struct AlignmentOptions {
//     int patch_radius = 6;
//     template <class Self, class Visitor> static void fields(Self& self, Visitor& visit) {
//       visit(self.patch_radius, {"patch_radius", "px", "half width of the square patch", 2, 15});
//     }
//   };
//
// A member that is itself such a struct is visited with visit.group("alignment", self.alignment). An enum E
// is an option if option_names(E) (found by argument) returns its values' names in order, first value 0.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "spslam/base/error.h"

namespace spslam {

struct FieldInfo {
  const char* name;
  const char* unit;     // "" for counts, switches and ratios
  const char* meaning;  // one line
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
};

// One option as text, for printing and for comparing.
struct OptionText {
  std::string key;  // "alignment.patch_radius"
  std::string value;
  std::string unit;
  std::string meaning;
};

// The candidate with the smallest edit distance to word, or "" if none is near enough to be meant.
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

namespace detail {

bool parse_bool(const std::string& key, const std::string& text);
int parse_int(const std::string& key, const std::string& text);
double parse_double(const std::string& key, const std::string& text);
int parse_name(const std::string& key, const std::string& text, std::span<const char* const> names);
std::string print_double(double value);
[[noreturn]] void throw_out_of_range(const std::string& key, const std::string& value, const FieldInfo& info);
[[noreturn]] void throw_unknown(const std::string& key, std::span<const std::string> known);

template <class T>
std::string to_text(const T& value) {
  if constexpr (std::is_same_v<T, bool>)
    return value ? "true" : "false";
  else if constexpr (std::is_enum_v<T>)
    return option_names(value)[static_cast<int>(value)];
  else if constexpr (std::is_integral_v<T>)
    return std::to_string(value);
  else if constexpr (std::is_floating_point_v<T>)
    return print_double(value);
  else
    return value;
}

template <class T>
void from_text(const std::string& key, const std::string& text, T& value) {
  if constexpr (std::is_same_v<T, bool>)
    value = parse_bool(key, text);
  else if constexpr (std::is_enum_v<T>)
    value = static_cast<T>(parse_name(key, text, option_names(value)));
  else if constexpr (std::is_integral_v<T>)
    value = static_cast<T>(parse_int(key, text));
  else if constexpr (std::is_floating_point_v<T>)
    value = parse_double(key, text);
  else
    value = text;
}

// Walks the tree of options and calls f(key, member, info) for each leaf.
template <class F>
struct Walker {
  F f;
  std::string prefix = {};

  template <class T>
  void operator()(T& member, const FieldInfo& info) {
    f(prefix + info.name, member, info);
  }
  template <class T>
  void group(const char* name, T& member) {
    const std::string outer = prefix;
    prefix += std::string(name) + ".";
    std::remove_const_t<T>::fields(member, *this);
    prefix = outer;
  }
};

template <class Options, class F>
void walk(Options& options, F f) {
  Walker<F> walker{f};
  std::remove_const_t<Options>::fields(options, walker);
}

}  // namespace detail

// All options with their present values, in the order of the structs.
template <class Options>
std::vector<OptionText> list_options(const Options& options) {
  std::vector<OptionText> all;
  detail::walk(options, [&](const std::string& key, const auto& member, const FieldInfo& info) {
    all.push_back({key, detail::to_text(member), info.unit, info.meaning});
  });
  return all;
}

// Sets the option `key` ("alignment.patch_radius") from text. Throws OptionError with the nearest known key.
template <class Options>
void set_option(Options& options, const std::string& key, const std::string& text) {
  bool found = false;
  std::vector<std::string> known;
  detail::walk(options, [&](const std::string& name, auto& member, const FieldInfo&) {
    known.push_back(name);
    if (name != key) return;
    found = true;
    detail::from_text(key, text, member);
  });
  if (!found) detail::throw_unknown(key, known);
}

// Throws OptionError that names the field, its value and the range it must be in.
template <class Options>
void check_options(const Options& options) {
  detail::walk(options, [&](const std::string& key, const auto& member, const FieldInfo& info) {
    using T = std::remove_cvref_t<decltype(member)>;
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      const double value = static_cast<double>(member);
      const bool inside = value >= info.minimum && value <= info.maximum;  // false for NaN
      if (!inside) detail::throw_out_of_range(key, detail::to_text(member), info);
    }
  });
}

}  // namespace spslam
