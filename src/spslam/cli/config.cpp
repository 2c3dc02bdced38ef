// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// `spslam config`: every option with its value, unit and meaning.

#include <cstdio>

#include "spslam/cli/commands.h"
#include "spslam/cli/run_options.h"

namespace spslam {
namespace {

// As to_yaml() prints them, with the default behind the options that have another value. `--config` reads it.
std::string options_text(const SlamOptions& options) {
  const std::vector<OptionText> defaults = list_options(SlamOptions{});
  const std::vector<OptionText> present = list_options(options);
  std::string text;
  for (std::size_t i = 0; i < present.size(); ++i) {
    const OptionText& option = present[i];
    text += option.key + ": " + option.value + "  # " + option.meaning;
    if (!option.unit.empty()) text += " [" + option.unit + "]";
    if (option.value != defaults[i].value) text += " (default " + defaults[i].value + ")";
    text += "\n";
  }
  return text;
}

}  // namespace

void add_config(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("config", "Check options and print all of them: value, meaning, unit, default");
  const auto arguments = std::make_shared<OptionArguments>();
  const auto print = std::make_shared<bool>(false);
  add_option_arguments(*command, *arguments);
  command->add_flag("--print", *print, "Print them as YAML that --config reads; without it only check");
  command->callback([arguments, print, &chosen] {
    chosen = [arguments, print] {
      const std::string text = options_text(effective_options(*arguments));
      if (*print) std::fputs(text.c_str(), stdout);
      return 0;
    };
  });
}

}  // namespace spslam
