// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/base/options.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <numeric>

namespace spslam {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row[b.size()];
}

template <class Number>
Number parse_number(const std::string& key, const std::string& text, const char* kind) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc() || stop != end)
    throw OptionError("option " + key + ": '" + text + "' is not " + kind + "; give one, for example " + key +
                      "=1");
  return value;
}

}  // namespace

std::string nearest_name(std::string_view word, std::span<const std::string> candidates) {
  std::string best;
  std::size_t best_distance = word.size() / 3 + 3;
  for (const std::string& candidate : candidates) {
    std::size_t distance = edit_distance(word, candidate);
    // "patch_radius" is meant as "alignment.patch_radius": compare with the last part of a dotted name too.
    if (const auto dot = candidate.rfind('.');
        dot != std::string::npos && word.find('.') == std::string_view::npos)
      distance = std::min(distance, edit_distance(word, std::string_view(candidate).substr(dot + 1)));
    if (distance < best_distance) best_distance = distance, best = candidate;
  }
  return best;
}

namespace detail {

bool parse_bool(const std::string& key, const std::string& text) {
  if (text == "true" || text == "on" || text == "yes" || text == "1") return true;
  if (text == "false" || text == "off" || text == "no" || text == "0") return false;
  throw OptionError("option " + key + ": '" + text + "' is not a switch; give true or false");
}

int parse_int(const std::string& key, const std::string& text) {
  return parse_number<int>(key, text, "a whole number");
}

double parse_double(const std::string& key, const std::string& text) {
  return parse_number<double>(key, text, "a number");
}

int parse_name(const std::string& key, const std::string& text, std::span<const char* const> names) {
  std::vector<std::string> known(names.begin(), names.end());
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i] == text) return static_cast<int>(i);
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  throw OptionError("option " + key + ": '" + text + "' is not known; give one of " + list);
}

std::string print_double(double value) {
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, result.ptr};
}

void throw_out_of_range(const std::string& key, const std::string& value, const FieldInfo& info) {
  throw OptionError("option " + key + " = " + value + " is out of range; it must be between " +
                    print_double(info.minimum) + " and " + print_double(info.maximum) +
                    (*info.unit ? std::string(" ") + info.unit : "") + " (" + info.meaning + ")");
}

void throw_unknown(const std::string& key, std::span<const std::string> known) {
  const std::string nearest = nearest_name(key, known);
  throw OptionError("unknown option '" + key + "'" +
                    (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") +
                    " `spslam config --print` lists all");
}

}  // namespace detail
}  // namespace spslam
