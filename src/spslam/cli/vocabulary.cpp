// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// `spslam vocabulary`: trains, converts, describes and measures vocabularies of binary words.

#include "spslam/loop/vocabulary.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "spslam/base/error.h"
#include "spslam/cli/commands.h"
#include "spslam/cli/reading_options.h"
#include "spslam/cli/vocabulary_file.h"
#include "spslam/features/orb_extractor.h"
#include "spslam/io/dataset.h"
#include "spslam/io/text.h"
#include "spslam/loop/vocabulary_recall.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;

struct ImageArguments {
  std::vector<std::string> datasets;
  DatasetOptions reading;
  int every = 1, features = 1000;
};

struct TrainArguments {
  ImageArguments images;
  VocabularyOptions tree;
  std::string output;
};

struct ConvertArguments {
  std::string input, output;
};

struct RecallArguments {
  std::string vocabulary, map;
  ImageArguments images;
  PlaceRecallOptions options;
};

bool is_text(const fs::path& path) {
  return path.extension() == ".txt";
}

void write_vocabulary(const Vocabulary& vocabulary, const std::string& name) {
  is_text(name) ? vocabulary.write_dbow2_text(name) : vocabulary.save(name);
}

// Calls f(index, descriptors) for every n-th frame of a data set, left image.
template <class F>
void for_each_image(const Dataset& dataset, const ImageArguments& arguments, F f) {
  OrbOptions options;
  options.count = arguments.features;
  OrbExtractor extractor(options);
  for (int i = 0; i < dataset.size(); i += arguments.every) {
    const StereoFrame frame = dataset.load(i);
    if (frame.problem.empty()) f(i, extractor.extract(frame.left).descriptors);
  }
}

int train(const TrainArguments& arguments) {
  check_options(arguments.tree);
  std::vector<std::vector<Descriptor>> images;
  std::size_t descriptors = 0;
  for (const std::string& folder : arguments.images.datasets) {
    const std::unique_ptr<Dataset> dataset = open_dataset(folder, arguments.images.reading);
    log_warnings(*dataset);
    for_each_image(*dataset, arguments.images, [&](int, std::vector<Descriptor> found) {
      descriptors += found.size();
      images.push_back(std::move(found));
    });
  }
  const Vocabulary vocabulary = Vocabulary::train(images, arguments.tree);
  write_vocabulary(vocabulary, arguments.output);
  std::printf("%s: %d words from %zu features of %d images\n", arguments.output.c_str(), vocabulary.words(),
              descriptors, vocabulary.images());
  return 0;
}

int convert(const ConvertArguments& arguments) {
  if (is_text(arguments.input) == is_text(arguments.output))
    throw OptionError("give one name that ends in .txt (DBoW2's text) and one that does not");
  const Vocabulary vocabulary = read_vocabulary(arguments.input);
  write_vocabulary(vocabulary, arguments.output);
  std::printf("%s: %d words, %d levels of %d branches\n", arguments.output.c_str(), vocabulary.words(),
              vocabulary.levels(), vocabulary.branching());
  return 0;
}

int info(const std::string& name) {
  const auto start = std::chrono::steady_clock::now();
  const Vocabulary vocabulary = read_vocabulary(name);
  const double opening =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  float heaviest = 0;
  for (const float weight : vocabulary.weights()) heaviest = std::max(heaviest, weight);
  std::printf("%s\n", name.c_str());
  std::printf("  words      %d (nodes of the tree: %d)\n", vocabulary.words(), vocabulary.nodes());
  std::printf("  tree       %d levels of at most %d branches\n", vocabulary.levels(), vocabulary.branching());
  std::printf("  images     %s\n",
              vocabulary.images() > 0 ? std::to_string(vocabulary.images()).c_str() : "not known");
  std::printf("  weights    up to %.3f\n", heaviest);
  std::printf("  bytes      %zu, as a binary file\n", vocabulary.bytes().size());
  std::printf("  opened in  %.1f ms\n", opening);
  return 0;
}

// The poses of simulated runs are in their own first cameras; this file, where there is one, says where in
// the scene that is.
SE3 world_from_first_camera(const fs::path& folder) {
  const fs::path file = folder / "world_from_first_camera.txt";
  if (!fs::exists(file)) return {};
  const Trajectory pose = parse_kitti_poses(read_text_file(file), file.string());
  return pose.empty() ? SE3{} : pose.front().world_from_camera;
}

std::vector<PlaceView> load_views(const std::string& folder, const ImageArguments& arguments) {
  const std::unique_ptr<Dataset> dataset = open_dataset(folder, arguments.reading);
  log_warnings(*dataset);
  if (!dataset->ground_truth())
    throw InputError(folder +
                     " has no poses; recall can be measured where it is known what is seen from where");
  const Trajectory& truth = *dataset->ground_truth();
  const SE3 world = world_from_first_camera(folder);
  std::vector<PlaceView> views;
  for_each_image(*dataset, arguments, [&](int index, std::vector<Descriptor> descriptors) {
    const double time = dataset->timestamp(index);
    const auto pose = std::lower_bound(truth.begin(), truth.end(), time - 0.01,
                                       [](const StampedPose& a, double t) { return a.timestamp < t; });
    if (pose == truth.end() || pose->timestamp > time + 0.01) return;
    views.push_back({time, world * pose->world_from_camera, std::move(descriptors)});
  });
  if (views.empty()) throw InputError(folder + " has no poses at the times of its images (within 0.01 s)");
  return views;
}

void print_recall(const std::string& name, const RecallResult& result) {
  const auto share = [&](int count) { return result.revisits > 0 ? 100.0 * count / result.revisits : 0.0; };
  std::printf(
      "%s: %d queries, %d revisits; best answer right %.1f %%, one of five %.1f %%, certain %.1f %% (score "
      "above %.3f); describe %.2f ms, query %.3f ms\n",
      name.c_str(), result.queries, result.revisits, share(result.first), share(result.among_five),
      share(result.certain), result.highest_wrong, result.describe_ms, result.query_ms);
}

int recall(const RecallArguments& arguments) {
  check_options(arguments.options);
  const Vocabulary vocabulary = read_vocabulary(arguments.vocabulary);
  std::vector<PlaceView> map;
  if (!arguments.map.empty()) map = load_views(arguments.map, arguments.images);
  for (const std::string& folder : arguments.images.datasets) {
    const std::vector<PlaceView> views = load_views(folder, arguments.images);
    print_recall(folder, arguments.map.empty() ? measure_recall(views, vocabulary, arguments.options)
                                               : measure_recall(views, map, vocabulary, arguments.options));
  }
  return 0;
}

void add_images(CLI::App& command, ImageArguments& arguments) {
  command.add_option("DATASETS", arguments.datasets, "Folders of sequences; left images are used")
      ->required();
  add_reading_options(command, arguments.reading);
  command.add_option("--every", arguments.every, "Use one frame of so many")
      ->check(above_zero())
      ->capture_default_str();
  command.add_option("--features", arguments.features, "ORB features of an image")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
}

void add_train(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("train", "Train a vocabulary on the images of data sets");
  const auto arguments = std::make_shared<TrainArguments>();
  add_images(*command, arguments->images);
  command->add_option("--output,-o", arguments->output, "The vocabulary; as DBoW2's text if it ends in .txt")
      ->required()
      ->type_name("FILE");
  command->add_option("--branching", arguments->tree.branching, "Children of a node, 2 to 20")
      ->capture_default_str();
  command
      ->add_option("--levels", arguments->tree.levels,
                   "Levels, 1 to 10; there are branching^levels words or less")
      ->capture_default_str();
  command->add_option("--seed", arguments->tree.seed, "Of the first choice of children")
      ->capture_default_str();
  command->callback([arguments, &chosen] { chosen = [arguments] { return train(*arguments); }; });
}

void add_convert(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("convert", "Convert between DBoW2's text (.txt) and the binary file");
  const auto arguments = std::make_shared<ConvertArguments>();
  command->add_option("IN", arguments->input, "A vocabulary, or `built-in`")->required();
  command->add_option("OUT", arguments->output, "File to write")->required();
  command->callback([arguments, &chosen] { chosen = [arguments] { return convert(*arguments); }; });
}

void add_info(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("info", "Say what is in a vocabulary");
  const auto name = std::make_shared<std::string>(kBuiltIn);
  command->add_option("FILE", *name, "A vocabulary, binary or text (.txt)")->capture_default_str();
  command->callback([name, &chosen] { chosen = [name] { return info(*name); }; });
}

void add_recall(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("recall", "Measure how well places are recognized, on data sets with poses");
  const auto arguments = std::make_shared<RecallArguments>();
  command->add_option("FILE", arguments->vocabulary, "A vocabulary, or `built-in`")->required();
  add_images(*command, arguments->images);
  command
      ->add_option(
          "--map", arguments->map,
          "Look for the places in this sequence through the same scene instead of in the data set's own past")
      ->type_name("DATASET");
  command->add_option("--distance", arguments->options.distance, "m; the same place is seen from within")
      ->capture_default_str();
  command->add_option("--angle", arguments->options.angle, "deg; ... looking the same way within")
      ->capture_default_str();
  command->add_option("--gap", arguments->options.gap, "s; only what is older counts as the past")
      ->capture_default_str();
  command->callback([arguments, &chosen] { chosen = [arguments] { return recall(*arguments); }; });
}

}  // namespace

void add_vocabulary(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand(
      "vocabulary", "Train, convert, describe and measure vocabularies for recognizing places");
  command->require_subcommand(1);
  add_train(*command, chosen);
  add_convert(*command, chosen);
  add_info(*command, chosen);
  add_recall(*command, chosen);
}

}  // namespace spslam
