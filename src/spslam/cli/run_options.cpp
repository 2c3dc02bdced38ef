// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/run_options.h"

#include "spslam/cli/commands.h"

namespace spslam {

void add_option_arguments(CLI::App& command, OptionArguments& arguments) {
  command
      .add_option("--preset", arguments.preset, "Options to start from: sp-slam (default), paper or baseline")
      ->transform(enum_names<Preset>())
      ->type_name("NAME");
  command.add_option("--config", arguments.config, "YAML file of options that differ from the preset's")
      ->type_name("FILE");
  command
      .add_option("--set", arguments.settings,
                  "Change one option, e.g. tracker.window_frames=5; repeatable, wins over --config")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

SlamOptions effective_options(const OptionArguments& arguments) {
  SlamOptions options = preset_options(arguments.preset);
  if (!arguments.config.empty()) apply_yaml_file(options, arguments.config);
  for (const std::string& setting : arguments.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      throw OptionError("--set " + setting + ": give it as KEY=VALUE, e.g. --set tracker.window_frames=5");
    set_option(options, setting.substr(0, equals), setting.substr(equals + 1));
  }
  check_options(options);
  return options;
}

const char* preset_name(Preset preset) {
  return option_names(preset)[static_cast<std::size_t>(preset)];
}

}  // namespace spslam
