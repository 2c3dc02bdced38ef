// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <malloc.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <iostream>

#include "spslam/base/error.h"
#include "spslam/cli/commands.h"

namespace spslam {
namespace {

// The only place that configures logging: the library uses whatever logger its process has.
void configure_logging(const std::string& level) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("spslam"));
  spdlog::set_pattern("%H:%M:%S.%e %^%l%$ %v");
  spdlog::set_level(spdlog::level::from_str(level));
}

// Memory that a frame gives back is needed again by the next one: fetching it from the kernel anew each time
// costs more than all of the arithmetic on machines where page faults are dear. Only a program may decide
// this, a library may not.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
}

int fail(const char* message, int exit_code) {
  std::fprintf(stderr, "spslam: %s\n", message);
  return exit_code;
}

void add_commands(CLI::App& app, Command& chosen) {
  add_run(app, chosen);
  add_check(app, chosen);
  add_config(app, chosen);
  add_evaluate(app, chosen);
  add_report(app, chosen);
  add_export_map(app, chosen);
  add_segment(app, chosen);
  add_simulate(app, chosen);
  add_vocabulary(app, chosen);
}

// Before a subcommand and behind it, wherever one looks for it.
void add_log_level(CLI::App& app, std::string& level) {
  app.add_option("--log-level", level, "What is logged to the terminal (stderr)")
      ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error", "off"}))
      ->capture_default_str();
  for (CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
    add_log_level(*subcommand, level);
}

// What was printed has arrived, unless the disk that it went to is full.
int checked_output(int exit_code) {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return exit_code;
  const int failed = fail("what was to be printed could not be written to stdout; check where it goes", 1);
  return exit_code == 0 ? failed : exit_code;
}

int run(int argc, char** argv) {
  keep_freed_memory();
  CLI::App app("SP-SLAM: stereo visual SLAM for boats close to the shore", "spslam");
  app.set_version_flag("--version", "spslam " SPSLAM_VERSION);
  app.set_help_all_flag("--help-all", "Print the help of every subcommand too");
  std::string level = "warning";
  Command chosen;
  add_commands(app, chosen);
  add_log_level(app, level);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return checked_output(app.exit(help_or_version));
  } catch (const CLI::ParseError& error) {
    return fail(usage_message(app, error).c_str(), kUsageError);
  }
  if (!chosen) {
    std::fputs(app.help().c_str(), stderr);
    return kUsageError;
  }
  configure_logging(level);
  return checked_output(chosen());
}

}  // namespace
}  // namespace spslam

int main(int argc, char** argv) {
  try {
    return spslam::run(argc, argv);
  } catch (const spslam::OptionError& error) {
    return spslam::fail(error.what(), spslam::kUsageError);
  } catch (const std::exception& error) {
    return spslam::fail(error.what(), 1);
  }
}
