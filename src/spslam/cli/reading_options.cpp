// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/reading_options.h"

#include <spdlog/spdlog.h>

#include "spslam/cli/commands.h"

namespace spslam {
namespace {

// Adds the option of a field; --pair-tolerance for pair_tolerance.
struct OptionOfField {
  CLI::App& command;

  template <class T>
  void operator()(T& member, const FieldInfo& info) {
    std::string flag = "--" + std::string(info.name), meaning = info.meaning;
    std::replace(flag.begin(), flag.end(), '_', '-');
    meaning[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(meaning[0])));
    CLI::Option* option = command.add_option(flag, member, meaning);
    if constexpr (std::is_enum_v<T>)
      option->transform(enum_names<T>())->type_name("FORMAT");
    else if constexpr (std::is_arithmetic_v<T>)
      option->check(CLI::Range(info.minimum, info.maximum).description(""))->type_name(info.unit);
    else
      option->type_name("FILE");
  }
};

}  // namespace

void add_reading_options(CLI::App& command, DatasetOptions& reading) {
  OptionOfField visitor{command};
  DatasetOptions::fields(reading, visitor);
}

void log_warnings(const Dataset& dataset) {
  for (const std::string& warning : dataset.warnings()) spdlog::warn("{}", warning);
}

}  // namespace spslam
