// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The table of bad input: each row breaks a good folder in one way and says what must come of it. What is
// wrong with the whole folder is an InputError on opening; what is wrong with one frame is that frame's
// problem.

#include <gmock/gmock.h>

#include "io/synthetic_folder.h"
#include "spslam/io/dataset.h"

namespace spslam {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

struct BadFolder {
  const char* name;
  std::function<void(const fs::path&)> break_it;
  std::vector<std::string> message;  // parts of it
};

void PrintTo(const BadFolder& row, std::ostream* out) {
  *out << row.name;
}

void times(const fs::path& folder, const std::string& text) {
  write_text_file(folder / "times.txt", text);
}

class RefusedFolder : public testing::TestWithParam<BadFolder> {};

TEST_P(RefusedFolder, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  write_kitti(folder.path());
  ASSERT_NO_THROW(open_dataset(folder.path()));
  GetParam().break_it(folder.path());
  const std::string message = message_of([&] { open_dataset(folder.path()); });
  for (const std::string& part : GetParam().message) EXPECT_THAT(message, HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, RefusedFolder,
    testing::Values(
        BadFolder{"missing_folder", [](const fs::path& f) { fs::remove_all(f); }, {"does not exist"}},
        BadFolder{
            "a_file", [](const fs::path& f) { fs::remove_all(f), write_text_file(f, "x"); }, {"is a file"}},
        BadFolder{"unknown_folder",
                  [](const fs::path& f) { fs::remove_all(f / "image_0"), fs::remove_all(f / "image_1"); },
                  {"kitti: image_0/", "euroc: mav0/", "usvinland: PIC_Left", "plain: left/"}},
        BadFolder{"two_formats",
                  [](const fs::path& f) { fs::create_directories(f / "left"); },
                  {"several formats", "--format"}},
        BadFolder{"half_written",
                  [](const fs::path& f) { write_text_file(f / "INCOMPLETE", ""); },
                  {"half written"}},
        BadFolder{"missing_calibration",
                  [](const fs::path& f) { fs::remove(f / "calib.txt"); },
                  {"calibration is missing", "calib.txt", "--calibration"}},
        BadFolder{
            "calibration_without_right",
            [](const fs::path& f) { write_text_file(f / "calib.txt", "P0: 50 0 31 0 0 50 23 0 0 0 1 0\n"); },
            {"calib.txt", "'P1:'"}},
        BadFolder{"calibration_of_larger_images",
                  [](const fs::path& f) {
                    StereoRig rig = small_rig();
                    rig.cx = 319.5, rig.cy = 159.5;
                    write_text_file(f / "calib.txt", format_kitti_calibration(rig));
                  },
                  {"principal point", "another image size"}},
        BadFolder{"calibration_of_twice_the_size",
                  [](const fs::path& f) {
                    StereoRig rig = small_rig();
                    rig.cx = 62, rig.cy = 47;
                    write_text_file(f / "calib.txt", format_kitti_calibration(rig));
                  },
                  {"calib.txt", "far from the middle", "another image size"}},
        BadFolder{"calibration_of_half_the_size",
                  [](const fs::path& f) {
                    StereoRig rig = small_rig();
                    rig.cx = 15.5, rig.cy = 11.5;
                    write_text_file(f / "calib.txt", format_kitti_calibration(rig));
                  },
                  {"calib.txt", "far from the middle", "64 x 48 px", "--calibration", "width and height"}},
        BadFolder{"calibration_of_half_the_height",
                  [](const fs::path& f) {
                    StereoRig rig = small_rig();
                    rig.cy = 11.5;
                    write_text_file(f / "calib.txt", format_kitti_calibration(rig));
                  },
                  {"far from the middle"}},
        BadFolder{"swapped_eyes",
                  [](const fs::path& f) {
                    StereoRig rig = small_rig();
                    rig.baseline = -0.08;
                    write_text_file(f / "calib.txt", format_kitti_calibration(rig));
                  },
                  {"baseline", "swapped"}},
        BadFolder{"more_left_than_right",
                  [](const fs::path& f) {
                    fs::remove(f / "image_1" / frame_name(4)), fs::remove(f / "image_1" / frame_name(5));
                  },
                  {"image_0 has 6 images", "image_1 has 4", "right ones end at 000003"}},
        BadFolder{
            "no_right_images",
            [](const fs::path& f) { fs::remove_all(f / "image_1"), fs::create_directories(f / "image_1"); },
            {"image_1", "holds no PNG or JPEG"}},
        BadFolder{"no_right_folder",
                  [](const fs::path& f) { fs::remove_all(f / "image_1"); },
                  {"image_1 is missing"}},
        BadFolder{"all_right_of_another_size",
                  [](const fs::path& f) {
                    for (int i = 0; i < kFrames; ++i)
                      write_image(f / "image_1" / frame_name(i), noise_image(1, 32, 48));
                  },
                  {"64 x 48 px", "32 x 48 px", "one size"}},
        BadFolder{"as_many_of_another_size",
                  [](const fs::path& f) {
                    for (const char* eye : {"image_0", "image_1"})
                      for (int i = 0; i < kFrames; i += 2)
                        write_image(f / eye / frame_name(i), noise_image(1, 32, 24));
                    fs::resize_file(f / "image_0" / frame_name(2), 0);  // the first five: two against two
                    fs::resize_file(f / "image_0" / frame_name(5), 0);
                  },
                  {"several sizes", "000000.png 32 x 24 px", "000001.png 64 x 48 px", "--calibration"}},
        BadFolder{"no_readable_image",
                  [](const fs::path& f) {
                    for (int i = 0; i < kFrames; ++i) write_text_file(f / "image_0" / frame_name(i), "");
                  },
                  {"none of the first pairs", "file is empty"}},
        BadFolder{"one_image_twice",
                  [](const fs::path& f) { write_image(f / "image_0" / "000002.jpg", left_image(2)); },
                  {"000002.png", "000002.jpg"}},
        BadFolder{"missing_times",
                  [](const fs::path& f) { fs::remove(f / "times.txt"); },
                  {"times.txt is missing", "--rate"}},
        BadFolder{"fewer_times", [](const fs::path& f) { times(f, "0\n0.1\n"); }, {"2 times", "6 frames"}},
        BadFolder{
            "more_times", [](const fs::path& f) { times(f, times_text() + "0.6\n0.7\n0.8\n"); }, {"9 times"}},
        BadFolder{"equal_times",
                  [](const fs::path& f) { times(f, "0\n0.1\n0.2\n0.2\n0.4\n0.5\n"); },
                  {"times.txt:4", "does not come after"}},
        BadFolder{"decreasing_times",
                  [](const fs::path& f) { times(f, "0\n0.1\n0.05\n0.3\n0.4\n0.5\n"); },
                  {"times.txt:3", "does not come after"}},
        BadFolder{"time_is_not_a_number",
                  [](const fs::path& f) { times(f, "0\n0.1\nnoon\n0.3\n0.4\n0.5\n"); },
                  {"times.txt:3", "'noon' is not a number"}},
        BadFolder{"time_is_nan",
                  [](const fs::path& f) { times(f, "0\n0.1\nnan\n0.3\n0.4\n0.5\n"); },
                  {"times.txt:3", "not finite"}}),
    [](const testing::TestParamInfo<BadFolder>& row) { return std::string(row.param.name); });

struct BadFrame {
  const char* name;
  std::function<void(const fs::path& image)> break_it;
  std::string problem;
};

void PrintTo(const BadFrame& row, std::ostream* out) {
  *out << row.name;
}

// Keeps the first share of a file.
void truncate_file(const fs::path& file, double share) {
  fs::resize_file(file, static_cast<std::uintmax_t>(static_cast<double>(fs::file_size(file)) * share));
}

class BadFrameInTheMiddle : public testing::TestWithParam<BadFrame> {};

TEST_P(BadFrameInTheMiddle, IsThatFramesProblemOnly) {
  for (const char* eye : {"image_0", "image_1"}) {
    const TemporaryFolder folder;
    write_kitti(folder.path());
    GetParam().break_it(folder.path() / eye / frame_name(3));
    const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
    ASSERT_EQ(dataset->size(), kFrames);
    for (int i = 0; i < kFrames; ++i) {
      const StereoFrame frame = dataset->load(i);
      EXPECT_DOUBLE_EQ(frame.timestamp, 0.1 * i);
      if (i == 3) {
        EXPECT_THAT(frame.problem, AllOf(HasSubstr(eye == std::string("image_0") ? "left" : "right"),
                                         HasSubstr("000003"), HasSubstr(GetParam().problem)));
        EXPECT_TRUE(frame.left.empty() && frame.right.empty());
      } else {
        EXPECT_EQ(frame.problem, "");
        EXPECT_TRUE(same_pixels(frame.left, left_image(i)) && same_pixels(frame.right, right_image(i)));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, BadFrameInTheMiddle,
    testing::Values(
        BadFrame{"missing", [](const fs::path& image) { fs::remove(image); }, "file is missing"},
        BadFrame{"empty", [](const fs::path& image) { fs::resize_file(image, 0); }, "file is empty"},
        BadFrame{"truncated", [](const fs::path& image) { truncate_file(image, 0.6); }, "truncated"},
        BadFrame{"truncated_jpeg",
                 [](const fs::path& image) {
                   fs::path jpeg = image;
                   fs::remove(image), write_image(jpeg.replace_extension(".jpg"), noise_image(9)),
                       truncate_file(jpeg, 0.6);
                 },
                 "JPEG is truncated"},
        BadFrame{"one_pixel", [](const fs::path& image) { write_image(image, noise_image(1, 1, 1)); },
                 "1 x 1 px"},
        BadFrame{"another_size", [](const fs::path& image) { write_image(image, noise_image(1, 32, 24)); },
                 "32 x 24 px instead of 64 x 48 px"},
        BadFrame{"text", [](const fs::path& image) { write_text_file(image, "<html>404</html>"); },
                 "neither PNG nor JPEG"},
        BadFrame{"damaged",
                 [](const fs::path& image) {
                   std::string bytes = read_text_file(image);
                   std::fill(bytes.begin() + 12, bytes.end() - 12, '\x11');
                   write_text_file(image, bytes);
                 },
                 "damaged"}),
    [](const testing::TestParamInfo<BadFrame>& row) { return std::string(row.param.name); });

TEST(BadInput, FirstPairUnreadable) {
  const TemporaryFolder folder;
  write_kitti(folder.path());
  fs::resize_file(folder.path() / "image_0" / frame_name(0), 0);
  const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
  EXPECT_THAT(dataset->load(0).problem, HasSubstr("empty"));
  EXPECT_EQ(dataset->load(1).problem, "");
}

// The size is the calibration's, or that of most of the first pairs.
TEST(BadInput, FirstPairOfAnotherSize) {
  for (const bool stated : {false, true}) {
    const TemporaryFolder folder;
    stated ? write_plain(folder.path()) : write_kitti(folder.path());
    for (const char* eye : {stated ? "left" : "image_0", stated ? "right" : "image_1"})
      write_image(folder.path() / eye / frame_name(0), noise_image(1, 32, 24));
    const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
    EXPECT_EQ(dataset->rig().width, kWidth);
    EXPECT_THAT(dataset->load(0).problem, HasSubstr("32 x 24 px instead of 64 x 48 px"));
    for (int i = 1; i < kFrames; ++i) EXPECT_EQ(dataset->load(i).problem, "");
  }
}

TEST(BadInput, PairMissingInBothEyes) {
  const TemporaryFolder folder;
  write_kitti(folder.path());
  for (const char* eye : {"image_0", "image_1"}) fs::remove(folder.path() / eye / frame_name(2));
  const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
  ASSERT_EQ(dataset->size(), kFrames) << "the times tell that a frame is lost";
  EXPECT_THAT(dataset->load(2).problem, HasSubstr("file is missing"));
  EXPECT_TRUE(same_pixels(dataset->load(3).left, left_image(3)));
}

TEST(BadInput, CarriageReturnsInEveryText) {
  const TemporaryFolder folder;
  write_kitti(folder.path());
  write_text_file(folder.path() / "times.txt", times_text("\r\n"));
  const StereoRig rig = small_rig();
  std::string calibration = format_kitti_calibration(rig);
  calibration.insert(calibration.find('\n'), "\r"), calibration.insert(calibration.size() - 1, "\r");
  write_text_file(folder.path() / "calib.txt", calibration);
  const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
  EXPECT_DOUBLE_EQ(dataset->timestamp(5), 0.5);
  EXPECT_DOUBLE_EQ(dataset->rig().baseline, rig.baseline);
}

TEST(BadInput, YamlCalibrationOfAnotherSize) {
  const TemporaryFolder folder;
  write_plain(folder.path());
  StereoRig rig = small_rig();
  rig.width = 640, rig.height = 320;
  write_text_file(folder.path() / "calibration.yaml", format_calibration_yaml(rig));
  EXPECT_THAT(message_of([&] { open_dataset(folder.path()); }),
              AllOf(HasSubstr("640 x 320 px"), HasSubstr("64 x 48 px"), HasSubstr("calibration.yaml")));
}

TEST(BadInput, EurocCalibrationOfAnotherSize) {
  const TemporaryFolder folder;
  write_euroc(folder.path());
  const auto shrink = [&](const char* camera) {
    const fs::path file = folder.path() / "mav0" / camera / "sensor.yaml";
    std::string text = read_text_file(file);
    text.replace(text.find("[64, 48]"), 8, "[60, 44]");
    write_text_file(file, text);
  };
  shrink("cam1");
  EXPECT_THAT(message_of([&] { open_dataset(folder.path()); }),
              AllOf(HasSubstr("cam0/sensor.yaml"), HasSubstr("cam1/sensor.yaml"), HasSubstr("differ in size"),
                    HasSubstr("64 x 48 px"), HasSubstr("60 x 44 px")));
  shrink("cam0");
  EXPECT_THAT(message_of([&] { open_dataset(folder.path()); }),
              AllOf(HasSubstr("cam0/sensor.yaml is for images of 60 x 44 px"), HasSubstr("64 x 48 px")));
}

// A run needs no truth: what came with the folder may be broken, what was asked for may not.
TEST(BadInput, BrokenTruth) {
  const auto without_truth = [](const fs::path& folder, const std::vector<std::string>& parts) {
    const std::unique_ptr<Dataset> dataset = open_dataset(folder);
    EXPECT_FALSE(dataset->ground_truth());
    EXPECT_EQ(dataset->load(1).problem, "");
    ASSERT_EQ(dataset->warnings().size(), 1u);
    for (const std::string& part : parts) EXPECT_THAT(dataset->warnings()[0], HasSubstr(part));
  };
  const char* unsorted = "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n";
  const TemporaryFolder folder;
  write_plain(folder.path());
  write_text_file(folder.path() / "groundtruth.txt", unsorted);
  without_truth(folder.path(), {"no ground truth", "groundtruth.txt:2"});
  write_text_file(folder.path() / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  without_truth(folder.path(), {"poses.txt", "1 poses for 6 times"});
  DatasetOptions options;
  options.truth = folder.write("mine.txt", unsorted);
  EXPECT_THAT(message_of([&] { open_dataset(folder.path(), options); }), HasSubstr("mine.txt:2"));
  options.truth = folder.path("none.txt");
  EXPECT_THAT(message_of([&] { open_dataset(folder.path(), options); }), HasSubstr("does not exist"));
  options.truth = folder.write("mine.txt", "0 0 0 0 0 0 0 1\n0.5 7 0 0 0 0 0 1\n");
  const std::unique_ptr<Dataset> dataset = open_dataset(folder.path(), options);
  EXPECT_EQ(dataset->ground_truth()->at(1).world_from_camera.translation.x(), 7);
  EXPECT_TRUE(dataset->warnings().empty());
}

TEST(BadInput, ImplausibleUnitsAreWarnings) {
  const TemporaryFolder folder;
  write_plain(folder.path());
  EXPECT_TRUE(open_dataset(folder.path())->warnings().empty());
  std::string milliseconds, sparse;
  for (int i = 0; i < kFrames; ++i) milliseconds += std::to_string(33 * i) + "\n";
  times(folder.path(), milliseconds);
  EXPECT_THAT(open_dataset(folder.path())->warnings(),
              testing::ElementsAre(AllOf(HasSubstr("33 s"), HasSubstr("times in seconds?"))));
  DatasetOptions options;
  options.rate = 1000;  // fast, but there are such cameras
  EXPECT_TRUE(open_dataset(folder.path(), options)->warnings().empty());
  std::string hours;
  for (int i = 0; i < kFrames; ++i) hours += fixed_text(i / 72000.0, 9) + "\n";
  times(folder.path(), hours);
  StereoRig rig = small_rig();
  rig.baseline = 80;
  write_text_file(folder.path() / "calibration.yaml", format_calibration_yaml(rig));
  EXPECT_THAT(
      open_dataset(folder.path())->warnings(),
      testing::ElementsAre(HasSubstr("times in seconds?"),
                           AllOf(HasSubstr("calibration.yaml"), HasSubstr("80 m; is it in metres?"))));
}

TEST(BadInput, OptionsOutOfRange) {
  DatasetOptions options;
  options.rate = -1;
  EXPECT_THROW(open_dataset(".", options), OptionError);
}

}  // namespace
}  // namespace spslam
