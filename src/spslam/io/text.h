// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Reading text by line with messages that name file and line, and writing numbers the same way in every
// locale.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spslam {

// The whole file. Throws InputError if it is missing or cannot be read.
std::string read_text_file(const std::filesystem::path& path);
// Replaces the file. Throws OutputError that says why it could not be written.
void write_text_file(const std::filesystem::path& path, std::string_view text);

// A word from a file, made short and printable for a message.
std::string in_quotes(std::string_view word);

// Walks over the lines that are neither blank nor comments (#). Ends of line may be LF or CR LF; a byte order
// mark is skipped. The text must outlive the reader.
class LineReader {
 public:
  // name stands for the file in messages.
  LineReader(std::string_view text, std::string name);

  bool next();  // false at the end of the text
  std::string_view line() const { return line_; }
  int number() const { return number_; }  // of the present line, from 1

  // The words of the line, between white space (separator ' ') or between separators with white space
  // trimmed.
  std::vector<std::string_view> fields(char separator = ' ') const;
  // A finite number, or InputError.
  double real(std::string_view word) const;
  std::int64_t integer(std::string_view word) const;
  // All words of the line as numbers; InputError unless there are `count`, described as `layout` ("t x y z").
  std::vector<double> reals(std::size_t count, const char* layout) const;
  // Throws InputError "name:line: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string_view rest_;
  std::string_view line_;
  std::string name_;
  int number_ = 0;
};

// A time a line, strictly increasing, in seconds or as KITTI's `2011-09-26 13:02:25.964389445` (in seconds
// since 1970). Throws InputError that names the line.
std::vector<double> parse_times(std::string_view text, const std::string& name);

// "-1.500000": a fixed number of digits behind the point.
std::string fixed_text(double value, int digits);
// "-1.500000000e+00": digits behind the point.
std::string scientific_text(double value, int digits);

}  // namespace spslam
