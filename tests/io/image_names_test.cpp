// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/image_names.h"

#include <gmock/gmock.h>

#include "io/synthetic_folder.h"
#include "spslam/io/dataset.h"

namespace spslam {
namespace {

using namespace test;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using Names = std::vector<std::string>;

// Two folders of empty files of these names.
class ImageNames : public testing::Test {
 protected:
  ImagePairs pair(const Names& left, const Names& right, std::size_t frames = 0) const {
    fs::remove_all(folder_.path() / "l"), fs::remove_all(folder_.path() / "r");
    for (const std::string& name : left) folder_.write("l/" + name, "");
    for (const std::string& name : right) folder_.write("r/" + name, "");
    return pair_images(folder_.path() / "l", folder_.path() / "r", frames);
  }
  // The file names of the left and of the right eye.
  static Names files(const std::vector<fs::path>& paths) {
    Names names;
    for (const fs::path& path : paths) names.push_back(path.filename().string());
    return names;
  }
  Names order(const Names& names) const { return files(pair(names, names).left); }

 private:
  TemporaryFolder folder_;
};

TEST_F(ImageNames, TimesAreInTheOrderOfDecimals) {
  EXPECT_THAT(order({"1700000000.1.jpg", "1700000000.05.jpg", "1700000000.0.jpg", "999999999.99.jpg",
                     "1700000000.050000001.jpg", "1700000001.jpg"}),
              ElementsAre("999999999.99.jpg", "1700000000.0.jpg", "1700000000.05.jpg",
                          "1700000000.050000001.jpg", "1700000000.1.jpg", "1700000001.jpg"));
  EXPECT_THAT(order({"left_1.5.png", "left_1.05.png", "left_10.png"}),
              ElementsAre("left_1.05.png", "left_1.5.png", "left_10.png"));
}

TEST_F(ImageNames, DecimalsAreNotRounded) {
  EXPECT_THAT(
      order({"1700000000.0000000002.png", "1700000000.0000000001.png", "12345678901234567890.1.png"}),
      ElementsAre("1700000000.0000000001.png", "1700000000.0000000002.png", "12345678901234567890.1.png"));
}

TEST_F(ImageNames, OthersAreInNaturalOrder) {
  EXPECT_THAT(order({"b10.png", "b9.png", "a11.png", "b9x.png", "2.png"}),
              ElementsAre("2.png", "a11.png", "b9.png", "b9x.png", "b10.png"));
  EXPECT_THAT(order({"1_2_10.png", "1_2_9.png", "1_10_1.png"}),
              ElementsAre("1_2_9.png", "1_2_10.png", "1_10_1.png"));
  EXPECT_THAT(order({"2024-1-2.png", "2024-1-10.png", "2023-12-31.png"}),
              ElementsAre("2023-12-31.png", "2024-1-2.png", "2024-1-10.png"));
}

TEST_F(ImageNames, NumbersMatchWhereNamesDoNot) {
  const ImagePairs pairs = pair({"left_000.png", "left_001.png", "left_003.png", "left_004.png"},
                                {"right_0.jpg", "right_1.jpg", "right_2.jpg", "right_4.jpg"});
  EXPECT_THAT(files(pairs.left),
              ElementsAre("left_000.png", "left_001.png", "left_2.png", "left_003.png", "left_004.png"));
  EXPECT_THAT(files(pairs.right),
              ElementsAre("right_0.jpg", "right_1.jpg", "right_2.jpg", "right_003.jpg", "right_4.jpg"));
  EXPECT_EQ(pairs.warning, "");
}

TEST_F(ImageNames, NumbersStandBetweenWhatAllNamesHave) {
  EXPECT_THAT(files(pair({"cam0_9_rect.png", "cam0_10_rect.png"}, {"cam1_10.png", "cam1_9.png"}).left),
              ElementsAre("cam0_9_rect.png", "cam0_10_rect.png"));
  EXPECT_THAT(files(pair({"l1.50.png", "l2.png"}, {"r1.5.png", "r2.0.png"}).right),
              ElementsAre("r1.5.png", "r2.0.png"));
}

TEST_F(ImageNames, FramesThatNeitherEyeHas) {
  const Names left = {"l_00.png", "l_01.png", "l_03.png"}, right = {"r_00.png", "r_01.png", "r_03.png"};
  EXPECT_THAT(files(pair(left, right, 4).left), ElementsAre("l_00.png", "l_01.png", "l_02.png", "l_03.png"));
  EXPECT_EQ(pair(left, right, 3).left.size(), 3u);
  EXPECT_EQ(pair(left, right, 5).left.size(), 3u);
}

TEST_F(ImageNames, OrderIsTheLastResortAndSaysSo) {
  const ImagePairs pairs = pair({"a.png", "b.png"}, {"c.png", "d.png"});
  EXPECT_THAT(files(pairs.left), ElementsAre("a.png", "b.png"));
  EXPECT_THAT(files(pairs.right), ElementsAre("c.png", "d.png"));
  EXPECT_THAT(pairs.warning,
              AllOf(HasSubstr("no names or numbers in common"), HasSubstr("a.png with c.png")));
  EXPECT_NE(pair({"1.001.png", "1.051.png"}, {"1.002.png", "1.052.png"}).warning, "")
      << "clocks of their own";
  EXPECT_THAT(message_of([&] { pair({"a.png", "b.png"}, {"c.png"}); }), HasSubstr("the same number"));
}

// macOS lays a ._NAME beside each NAME on foreign disks.
TEST_F(ImageNames, HiddenFilesAreNoImages) {
  const ImagePairs pairs = pair({"1.jpg", "2.jpg", "._1.jpg", "._2.jpg", ".trash.png"}, {"1.jpg", "2.jpg"});
  EXPECT_THAT(files(pairs.left), ElementsAre("1.jpg", "2.jpg"));
  EXPECT_THAT(message_of([&] { pair({"._1.jpg"}, {"1.jpg"}); }), HasSubstr("holds no PNG or JPEG"));
}

TEST_F(ImageNames, AnEyeThatEndsEarlyIsRefused) {
  EXPECT_THAT(message_of([&] {
                pair({"l_1.png", "l_2.png"}, {"r_1.png", "r_2.png", "r_3.png"});
              }),
              AllOf(HasSubstr("left ones end at 2"), HasSubstr("others at 3")));
}

// One image lost in each eye, another one: equal counts must not shift the pairs between.
TEST(Dataset, PlainWithAnImageLostInEachEye) {
  const TemporaryFolder folder;
  write_plain(folder.path());
  for (const std::string eye : {"left", "right"})
    for (int i = 0; i < kFrames; ++i)
      fs::rename(folder.path() / eye / frame_name(i), folder.path() / eye / (eye + "_" + frame_name(i)));
  fs::remove(folder.path() / "left" / "left_000001.png");
  fs::remove(folder.path() / "right" / "right_000004.png");
  const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
  ASSERT_EQ(dataset->size(), kFrames);
  EXPECT_THAT(dataset->load(1).problem, HasSubstr("left image left_000001.png: file is missing"));
  EXPECT_THAT(dataset->load(4).problem, HasSubstr("right image right_000004.png: file is missing"));
  for (const int i : {0, 2, 3, 5}) {
    EXPECT_TRUE(same_pixels(dataset->load(i).left, left_image(i))) << i;
    EXPECT_TRUE(same_pixels(dataset->load(i).right, right_image(i))) << i;
  }
  EXPECT_TRUE(dataset->warnings().empty());
}

TEST(Dataset, PairsThatAreGuessedAreAWarning) {
  const TemporaryFolder folder;
  write_plain(folder.path());
  for (int i = 0; i < kFrames; ++i) {
    const std::string letter(1, static_cast<char>('a' + i));
    fs::rename(folder.path() / "left" / frame_name(i), folder.path() / "left" / (letter + "l.png"));
    fs::rename(folder.path() / "right" / frame_name(i), folder.path() / "right" / (letter + "r.png"));
  }
  const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
  EXPECT_THAT(dataset->warnings(), ElementsAre(HasSubstr("al.png with ar.png")));
  EXPECT_TRUE(same_pixels(dataset->load(4).right, right_image(4)));
}

}  // namespace
}  // namespace spslam
