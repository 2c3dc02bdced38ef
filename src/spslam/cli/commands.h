// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The subcommands of `spslam`, one file each. To add one: a declaration here, its line in main.cpp's table,
// its file in CMakeLists.txt.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace spslam {

// What the chosen subcommand does once the whole command line is known to be right; returns the exit code of
// the process. It may throw: main prints an Error's message and exits with 1.
using Command = std::function<int()>;

// Each adds its subcommand with its options to app; the subcommand's callback only puts its work into
// `chosen`.
void add_check(CLI::App& app, Command& chosen);
void add_config(CLI::App& app, Command& chosen);
void add_evaluate(CLI::App& app, Command& chosen);
void add_export_map(CLI::App& app, Command& chosen);
void add_report(CLI::App& app, Command& chosen);
void add_run(CLI::App& app, Command& chosen);
void add_segment(CLI::App& app, Command& chosen);
void add_simulate(CLI::App& app, Command& chosen);
void add_vocabulary(CLI::App& app, Command& chosen);

// The exit code of a wrong command line.
inline constexpr int kUsageError = 2;

// What to say about a command line that CLI11 refused: its own message, or for an unknown subcommand or
// option the nearest known one.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

// For ->transform() of an option that is an enum with option_names (base/options.h): takes its names, nothing
// else.
template <class Enum>
CLI::Validator enum_names() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        std::string known;
        int value = 0;
        for (const char* name : option_names(Enum{})) {
          if (text == name) return text = std::to_string(value), std::string();
          known += (value++ ? ", " : "") + std::string(name);
        }
        return "'" + text + "' is not known; give one of " + known;
      },
      "");
}

// For ->check(): CLI11's own message prints the largest double with all of its 309 digits.
inline CLI::Validator above_zero() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value > 0) return "";
        return "'" + text + "' is not a number above 0";
      },
      "");
}

}  // namespace spslam
