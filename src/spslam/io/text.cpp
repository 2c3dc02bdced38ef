// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/text.h"

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "spslam/base/error.h"

namespace spslam {
namespace {

constexpr std::string_view kBlank = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

// from_chars knows no leading plus, and calls 1e-400 out of range where zero is meant.
bool parse_real(std::string_view word, double& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [stop, code] = std::from_chars(word.data(), end, value);
  if (stop != end || word.empty()) return false;
  if (code == std::errc::result_out_of_range && word.find_first_of("eE") != std::string_view::npos &&
      word.find('-', word.find_first_of("eE")) != std::string_view::npos) {
    value = 0;
    return true;
  }
  return code == std::errc();
}

std::string number_text(double value, std::chars_format format, int digits) {
  char buffer[400];  // the largest double has 309 digits before the point
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value, format, digits);
  return {buffer, result.ptr};
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

// Of the line `YYYY-MM-DD hh:mm:ss.s`. Which zone it is in does not matter here.
double seconds_since_1970(const LineReader& reader) {
  const std::vector<std::string_view> words = reader.fields();
  const std::vector<std::string_view> date = split(words[0], '-'), clock = split(words[1], ':');
  if (date.size() != 3 || clock.size() != 3)
    reader.fail("is neither one time in seconds nor a date and time as 2011-09-26 13:02:25.964");
  const auto part = [&](std::string_view word, int minimum, int maximum) {
    const std::int64_t value = reader.integer(word);
    if (value < minimum || value > maximum) reader.fail(in_quotes(word) + " is no part of a date and time");
    return static_cast<int>(value);
  };
  const std::chrono::year_month_day day{std::chrono::year(part(date[0], 1970, 9999)),
                                        std::chrono::month(static_cast<unsigned>(part(date[1], 1, 12))),
                                        std::chrono::day(static_cast<unsigned>(part(date[2], 1, 31)))};
  const int hour = part(clock[0], 0, 23), minute = part(clock[1], 0, 59);
  const double second = reader.real(clock[2]);
  if (!day.ok() || second < 0 || second >= 61) reader.fail("is no date and time");
  const auto days = std::chrono::sys_days(day).time_since_epoch().count();
  return 86400.0 * static_cast<double>(days) + 3600.0 * hour + 60.0 * minute + second;
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::exists(path, code))
    throw InputError(path.string() + " does not exist; check the path");
  if (std::filesystem::is_directory(path, code))
    throw InputError(path.string() + " is a folder, a file is needed");
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file || file.bad())
    throw InputError(path.string() + " cannot be read (" + std::strerror(errno) + "); check its permissions");
  return std::move(text).str();
}

void write_text_file(const std::filesystem::path& path, std::string_view text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file)
    throw OutputError(path.string() + " cannot be written (" + std::strerror(errno) +
                      "); check that the folder exists, is writable and has space");
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, kLongest)) text += c >= 0x20 && c < 0x7f ? c : '?';
  return text + (word.size() > kLongest ? "...'" : "'");
}

LineReader::LineReader(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
}

bool LineReader::next() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    line_ = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++number_;
    if (!line_.empty() && line_.front() != '#') return true;
  }
  return false;
}

std::vector<std::string_view> LineReader::fields(char separator) const {
  if (separator != ' ') return split(line_, separator);
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; (begin = line_.find_first_not_of(kBlank, begin)) != std::string_view::npos;) {
    const std::size_t end = std::min(line_.find_first_of(kBlank, begin), line_.size());
    words.push_back(line_.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

double LineReader::real(std::string_view word) const {
  double value = 0;
  if (!parse_real(word, value)) fail(in_quotes(word) + " is not a number; correct or remove the line");
  if (!std::isfinite(value)) fail(in_quotes(word) + " is not finite; correct or remove the line");
  return value;
}

std::int64_t LineReader::integer(std::string_view word) const {
  std::int64_t value = 0;
  const auto [stop, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || stop != word.data() + word.size())
    fail(in_quotes(word) + " is not a whole number; correct or remove the line");
  return value;
}

std::vector<double> LineReader::reals(std::size_t count, const char* layout) const {
  const std::vector<std::string_view> words = fields();
  if (words.size() != count)
    fail("has " + std::to_string(words.size()) + " values, needs " + std::to_string(count) + " (" + layout +
         ")");
  std::vector<double> values;
  values.reserve(count);
  for (const std::string_view word : words) values.push_back(real(word));
  return values;
}

void LineReader::fail(const std::string& what) const {
  throw InputError(name_ + ":" + std::to_string(number_) + ": " + what);
}

std::vector<double> parse_times(std::string_view text, const std::string& name) {
  std::vector<double> times;
  for (LineReader reader(text, name); reader.next();) {
    const double time = reader.fields().size() == 2 ? seconds_since_1970(reader)
                                                    : reader.reals(1, "one time in seconds a line")[0];
    if (!times.empty() && time <= times.back())
      reader.fail("time " + fixed_text(time, 6) + " s does not come after " + fixed_text(times.back(), 6) +
                  " s before it; times must increase from line to line, correct the file");
    times.push_back(time);
  }
  return times;
}

std::string fixed_text(double value, int digits) {
  return number_text(value, std::chars_format::fixed, digits);
}
std::string scientific_text(double value, int digits) {
  return number_text(value, std::chars_format::scientific, digits);
}

}  // namespace spslam
