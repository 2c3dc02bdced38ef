// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// `spslam simulate`: renders what a stereo rig on a small boat sees, with the truth beside it.

#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "spslam/cli/commands.h"
#include "spslam/cli/run_signal.h"
#include "spslam/sim/dataset_writer.h"

namespace spslam {
namespace {

struct SimulateArguments {
  std::string scene, output;
  sim::Layout layout = sim::Layout::kKitti;
  std::uint32_t seed = 1;
  int frames = 0;
  std::vector<std::string> settings;
  bool overwrite = false;
  bool print = false;
};

int print_scene(const sim::SceneDescription& scene) {
  for (const OptionText& option : list_options(scene))
    std::printf("%-32s %-12s %s%s%s\n", option.key.c_str(), option.value.c_str(), option.unit.c_str(),
                option.unit.empty() ? "" : "; ", option.meaning.c_str());
  return 0;
}

int simulate(const SimulateArguments& arguments) {
  sim::SimulationRequest request{sim::load_scene(arguments.scene),
                                 arguments.output,
                                 arguments.layout,
                                 arguments.seed,
                                 arguments.frames,
                                 arguments.overwrite};
  for (const std::string& setting : arguments.settings) sim::apply_setting(request.scene, setting);
  request.scene.check();
  if (arguments.print) return print_scene(request.scene);
  if (arguments.output.empty())
    throw OptionError("--output is missing; give the folder to write the data set to");
  watch_for_interruption();
  const bool terminal = isatty(fileno(stderr)) != 0;
  const auto start = std::chrono::steady_clock::now();
  const sim::SimulationSummary summary = sim::simulate_dataset(request, [&](int written, int wanted) {
    if (terminal) std::fprintf(stderr, "\r%d of %d pairs", written, wanted);
    return interruption() == 0;
  });
  if (terminal) std::fputc('\n', stderr);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (summary.stopped) {
    std::fprintf(stderr,
                 "spslam: stopped after %d pairs; %s is incomplete and marked so, repeat with --overwrite\n",
                 summary.frames, arguments.output.c_str());
    return 128 + interruption();
  }
  std::printf("%s: %d pairs (%d dropped), %.1f m, %.1f s, rendered in %.1f s (%.1f pairs/s)\n",
              arguments.output.c_str(), summary.frames, summary.dropped, summary.length, summary.duration,
              seconds, summary.frames / seconds);
  return 0;
}

std::string scene_list() {
  std::string list;
  for (const std::string& name : sim::scene_names()) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

void add_simulate(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("simulate", "Render a stereo sequence near a shore, with ground truth");
  const auto arguments = std::make_shared<SimulateArguments>();
  command
      ->add_option("SCENE", arguments->scene, "A scene (" + scene_list() + ") or the path of its YAML file")
      ->required();
  command->add_option("--output,-o", arguments->output, "Folder to write the data set to")->type_name("DIR");
  command->add_option("--frames", arguments->frames, "At most so many pairs; the whole way unless given")
      ->check(above_zero());
  command->add_option("--seed", arguments->seed, "Of everything random")->capture_default_str();
  command->add_option("--format", arguments->layout, "Layout: kitti (default), euroc or usvinland")
      ->transform(enum_names<sim::Layout>())
      ->type_name("FORMAT");
  command
      ->add_option("--set", arguments->settings,
                   "Change an option of the scene, e.g. air.visibility=100; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--overwrite", arguments->overwrite,
                    "Replace the simulated data set that is in the folder");
  command->add_flag("--print", arguments->print, "Only print the scene's options with units and meanings");
  command->callback([arguments, &chosen] { chosen = [arguments] { return simulate(*arguments); }; });
}

}  // namespace spslam
