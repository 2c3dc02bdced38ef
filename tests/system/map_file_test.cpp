// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/system/map_file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <limits>
#include <variant>

#include "base/temporary_folder.h"
#include "spslam/base/atomic_file.h"
#include "spslam/system/byte_stream.h"
#include "system/made_up_map.h"

namespace spslam {
namespace {

using test::made_up_map;
using test::made_up_rig;
using testing::AllOf;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class MapFile : public testing::Test {
 protected:
  std::filesystem::path path(const char* name = "river.map") const { return folder_.path() / name; }
  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }

 private:
  const test::TemporaryFolder folder_;
};

Bytes read_all(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto* data = reinterpret_cast<const std::byte*>(text.data());
  return {data, data + text.size()};
}

// A payload under a right header.
Bytes sealed(const Bytes& payload) {
  ByteWriter file;
  for (const char letter : std::string_view("SPSLMAP\x1A")) file.put(letter);
  file.put(std::uint32_t{2});
  file.put(crc32(payload));
  file.put(std::uint64_t{payload.size()});
  for (const std::byte byte : payload) file.put(static_cast<std::uint8_t>(byte));
  return std::move(file).bytes();
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string refusal(const Bytes& file) {
  return message_of([&] { parse_map(file, "river.map"); });
}

void expect_same(const Map& a, const Map& b) {
  EXPECT_EQ(encode_map(a, made_up_rig()), encode_map(b, made_up_rig()));  // every bit of every field
  for (const auto& [id, landmark] : a.landmarks()) EXPECT_EQ(a.observers(id), b.observers(id));
  for (const auto& [id, keyframe] : a.keyframes()) EXPECT_EQ(a.covisible(id), b.covisible(id));
}

TEST_F(MapFile, GivesBackEverythingButThePyramids) {
  const Map map = made_up_map();
  save_map(path(), map, made_up_rig());
  EXPECT_EQ(files_in_folder(), 1U);
  const SavedMap saved = load_map(path());
  expect_same(map, saved.map);
  EXPECT_EQ(saved.rig.fy, 361);
  EXPECT_EQ(saved.rig.width, 640);
  ASSERT_EQ(saved.map.keyframes().size(), 6U);
  ASSERT_EQ(saved.map.loops().size(), 1U);
  const Keyframe &written = *map.find(KeyframeId{5}), &read = *saved.map.find(KeyframeId{5});
  EXPECT_EQ(read.frame, written.frame);
  EXPECT_EQ(read.timestamp, written.timestamp);
  EXPECT_EQ(read.parent, written.parent);
  EXPECT_EQ(read.camera_from_world.rotation, written.camera_from_world.rotation);
  ASSERT_EQ(read.sightings.size(), written.sightings.size());
  EXPECT_EQ(read.sightings[1].inverse_sigma, written.sightings[1].inverse_sigma);
  EXPECT_EQ(read.features->descriptors, written.features->descriptors);
  EXPECT_EQ(read.features->inverse_depths, written.features->inverse_depths);
  EXPECT_EQ(read.features->information, written.features->information);
  EXPECT_EQ(read.features->level_scale, 1.25F);
  ASSERT_TRUE(read.image);
  EXPECT_EQ(*read.image, *written.image);
  EXPECT_EQ(saved.map.keyframes().rbegin()->second.image, nullptr);
  EXPECT_EQ(saved.map.keyframes().rbegin()->second.features, nullptr);
  const Landmark &there = *map.find(LandmarkId{9}), &here = *saved.map.find(LandmarkId{9});
  EXPECT_EQ(here.bearing, there.bearing);
  EXPECT_EQ(here.stereo_information, there.stereo_information);
  EXPECT_EQ(here.descriptor, there.descriptor);
  EXPECT_EQ(here.region, there.region);
  EXPECT_EQ(here.octave, there.octave);
}

TEST_F(MapFile, AnEmptyMapIsAMap) {
  save_map(path(), Map(), made_up_rig());
  EXPECT_TRUE(load_map(path()).map.keyframes().empty());
}

TEST_F(MapFile, TheRootNeedNotBeTheOldestKeyframe) {
  Map map;
  Keyframe root, other;
  root.id = {7};
  other.id = {3};
  map.add(root);
  map.add(other);
  ASSERT_EQ(map.find(KeyframeId{3})->parent, KeyframeId{7});
  save_map(path(), map, made_up_rig());
  expect_same(map, load_map(path()).map);
}

TEST_F(MapFile, ReplacesTheOldOne) {
  save_map(path(), made_up_map(), made_up_rig());
  const Map other = made_up_map({.keyframes = 2, .seed = 9});
  save_map(path(), other, made_up_rig());
  expect_same(other, load_map(path()).map);
}

TEST_F(MapFile, MissingOrNoFile) {
  EXPECT_THAT(message_of([&] { load_map(path("nothing")); }),
              AllOf(HasSubstr("nothing"), HasSubstr("exist")));
  EXPECT_THAT(message_of([&] { load_map(path().parent_path()); }), HasSubstr("is a folder"));
}

TEST(MapBytes, RefusesForeignAndNewerFiles) {
  const Bytes good = sealed(encode_map(made_up_map(), made_up_rig()));
  EXPECT_EQ(refusal(good), "no error");
  EXPECT_THAT(refusal({}), HasSubstr("river.map: is empty"));
  EXPECT_THAT(refusal(Bytes(5000, std::byte{'x'})), HasSubstr("not a map of SP-SLAM"));
  Bytes newer = good;
  newer[8] = std::byte{3};
  EXPECT_THAT(refusal(newer), AllOf(HasSubstr("format 3"), HasSubstr("reads format 2")));
  Bytes longer = good;
  longer.push_back(std::byte{0});
  EXPECT_THAT(refusal(longer), HasSubstr("behind its header"));
}

TEST(MapBytes, RefusesWhatIsTruncatedAtAnyByte) {
  const Bytes payload = encode_map(made_up_map({.keyframes = 3}), made_up_rig()), good = sealed(payload);
  for (std::size_t size = 0; size < good.size(); ++size)
    ASSERT_NE(refusal({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)}), "no error") << size;
  // Even under a header made for what is left.
  for (std::size_t size = 0; size < payload.size(); ++size)
    ASSERT_NE(refusal(sealed({payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(size)})),
              "no error")
        << size;
}

TEST(MapBytes, RefusesABitFlippedAnywhere) {
  Bytes file = sealed(encode_map(made_up_map({.keyframes = 3}), made_up_rig()));
  for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
    const std::byte mask{static_cast<unsigned char>(1U << (bit % 8))};
    file[bit / 8] ^= mask;
    ASSERT_NE(refusal(file), "no error") << bit;
    file[bit / 8] ^= mask;
  }
}

TEST(MapBytes, FlippedBitsUnderARightChecksumAreRefusedOrHarmless) {
  Bytes payload = encode_map(made_up_map({.keyframes = 3}), made_up_rig());
  for (std::size_t bit = 0; bit < 8 * payload.size(); ++bit) {
    const std::byte mask{static_cast<unsigned char>(1U << (bit % 8))};
    payload[bit / 8] ^= mask;
    ASSERT_NO_THROW({
      try {
        const SavedMap saved = decode_map(payload, "river.map");
        encode_map(saved.map, saved.rig);
      } catch (const InputError&) {
      }
    }) << bit;
    payload[bit / 8] ^= mask;
  }
}

// Two landmarks (ids 0 and 3, host 1), two keyframes (ids 1 and 3) of one sighting, the first with one
// feature and an image of 5 bytes, one loop.
struct Layout {
  static constexpr std::size_t kLandmark = 48 + 8, kLandmarkSize = 114;
  static constexpr std::size_t kKeyframe = kLandmark + 2 * kLandmarkSize + 8;
  static constexpr std::size_t kSighting = kKeyframe + 136, kFeature = kSighting + 64 + 1 + 4 + 8;
  static constexpr std::size_t kImage = kFeature + 57 + 8;
  static constexpr std::size_t kSecond = kImage + 5;
  static constexpr std::size_t kLoop = kSecond + 136 + 64 + 1 + 8 + 8;
};

struct Damage {
  const char* name;
  std::size_t at;
  std::variant<double, float, std::int64_t, std::uint8_t> value;
  const char* message;
};

const Damage kDamages[] = {
    {"FocalLength", 0, 0.0, "focal length"},
    {"Baseline", 32, kNaN, "baseline"},
    {"LandmarkCount", 48, std::int64_t{1} << 60, "landmarks, has bytes for"},
    {"NegativeCount", 48, std::int64_t{-1}, "landmarks, has bytes for"},
    {"LandmarkId", Layout::kLandmark, std::int64_t{-4}, "negative id"},
    {"LandmarkOrder", Layout::kLandmark, std::int64_t{3}, "landmarks are not in the order"},
    {"LandmarkHost", Layout::kLandmark + 8, std::int64_t{99}, "keyframe 99"},
    {"LandmarkPixel", Layout::kLandmark + 16, std::numeric_limits<float>::infinity(), "direction"},
    {"LandmarkBearing", Layout::kLandmark + 24, kNaN, "direction"},
    {"LandmarkBearingZ", Layout::kLandmark + 40, 2.0, "(x, y, 1)"},
    {"LandmarkDepth", Layout::kLandmark + 48, kNaN, "inverse depth"},
    {"LandmarkInformation", Layout::kLandmark + 56, -1.0, "information"},
    {"LandmarkRegion", Layout::kLandmark + 80, std::uint8_t{3}, "region"},
    {"KeyframeCount", Layout::kKeyframe - 8, std::int64_t{1} << 40, "keyframes, has bytes for"},
    {"KeyframeOrder", Layout::kKeyframe, std::int64_t{3}, "keyframes are not in the order"},
    {"OrphanParent", Layout::kSecond + 16, std::int64_t{77}, "keyframe 77 as its parent"},
    {"OwnParent", Layout::kSecond + 16, std::int64_t{3}, "own ancestor"},
    {"TwoRoots", Layout::kSecond + 16, std::int64_t{-1}, "without a parent"},
    {"NoRoot", Layout::kKeyframe + 16, std::int64_t{3}, "without a parent"},
    {"KeyframeTime", Layout::kKeyframe + 24, kNaN, "time"},
    {"PoseNaN", Layout::kKeyframe + 32, kNaN, "pose"},
    {"PoseNotARotation", Layout::kKeyframe + 32, 1.01, "no rigid motion"},
    {"PoseMirrored", Layout::kKeyframe + 32, -1.0, "no rigid motion"},
    {"PoseTranslation", Layout::kKeyframe + 32 + 72, kNaN, "pose"},
    {"SightingCount", Layout::kSighting - 8, std::int64_t{1} << 33, "sightings, has bytes for"},
    {"SightingOfNothing", Layout::kSighting, std::int64_t{2}, "landmark 2"},
    {"SightingNaN", Layout::kSighting + 8, kNaN, "position"},
    {"SightingSigma", Layout::kSighting + 32, -2.0, "error"},
    {"SightingWeight", Layout::kSighting + 56, kNaN, "weight"},
    {"FeatureFlag", Layout::kSighting + 64, std::uint8_t{7}, "features"},
    {"FeatureCount", Layout::kFeature - 8, std::int64_t{1} << 50, "features, has bytes for"},
    {"FeatureScale", Layout::kFeature - 12, 0.5F, "pyramid"},
    {"ImageSize", Layout::kImage - 8, std::int64_t{1} << 50, "bytes of an image"},
    {"FeatureNaN", Layout::kFeature, std::numeric_limits<float>::quiet_NaN(), "feature"},
    {"FeatureDepth", Layout::kFeature + 49, std::numeric_limits<float>::quiet_NaN(), "depth"},
    {"LoopEnd", Layout::kLoop, std::int64_t{12}, "keyframe 12"},
    {"LoopToItself", Layout::kLoop, std::int64_t{3}, "itself"},
    {"LoopMotion", Layout::kLoop + 16, kNaN, "loop's motion"},
    {"LoopWeight", Layout::kLoop + 112, -1.0, "loop's weight"},
};

class DamagedMap : public testing::TestWithParam<Damage> {};

TEST_P(DamagedMap, IsRefusedForWhatIsWrong) {
  const Damage& damage = GetParam();
  Bytes payload = encode_map(made_up_map({.keyframes = 2, .features = 1, .sightings = 1}), made_up_rig());
  ASSERT_EQ(payload.size(), Layout::kLoop + 120);
  ByteWriter value;
  std::visit([&](auto number) { value.put(number); }, damage.value);
  const Bytes bytes = std::move(value).bytes();
  std::copy(bytes.begin(), bytes.end(), payload.begin() + static_cast<std::ptrdiff_t>(damage.at));
  EXPECT_THAT(refusal(sealed(payload)), AllOf(HasSubstr("river.map"), HasSubstr(damage.message)));
}

INSTANTIATE_TEST_SUITE_P(All, DamagedMap, testing::ValuesIn(kDamages),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST_F(MapFile, AMapThatContradictsItselfIsNotSaved) {
  save_map(path(), made_up_map(), made_up_rig());
  Map bad = made_up_map({.seed = 3});
  bad.set_estimate({0}, kNaN, 1);
  EXPECT_THROW(save_map(path(), bad, made_up_rig()), OutputError);
  expect_same(made_up_map(), load_map(path()).map);  // the old one is whole
}

// A file that may not grow as large as the map: what a full disk does, without filling one.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(MapFile, AFullDiskLeavesTheOldFileWhole) {
  save_map(path(), made_up_map({.seed = 1}), made_up_rig());
  const Map other = made_up_map({.seed = 2});
  for (const rlim_t space : {0U, 1U, 1000U}) {
    const FileSizeLimit limit(space);
    EXPECT_THROW(save_map(path(), other, made_up_rig()), OutputError) << space;
  }
  expect_same(made_up_map({.seed = 1}), load_map(path()).map);
  EXPECT_EQ(files_in_folder(), 1U);  // nothing half-written is left
}

TEST_F(MapFile, AFolderThatIsNotThereIsNamed) {
  try {
    save_map(path("no/such/folder/river.map"), made_up_map(), made_up_rig());
    FAIL() << "no error";
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no/such/folder"));
  }
}

TEST_F(MapFile, AKillWhileSavingLeavesAWholeFile) {
  const Map maps[] = {made_up_map({.seed = 1}), made_up_map({.seed = 2})};
  save_map(path(), maps[0], made_up_rig());
  const Bytes first = sealed(encode_map(maps[0], made_up_rig()));
  const Bytes second = sealed(encode_map(maps[1], made_up_rig()));
  for (int round = 0; round < 20; ++round) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0)
      for (int i = 0;; ++i) save_map(path(), maps[i % 2], made_up_rig());
    usleep(static_cast<useconds_t>(700 * (round + 1)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_THAT(read_all(path()), testing::AnyOf(first, second));
  }
  save_map(path(), maps[0], made_up_rig());  // what a killed one left is not in the way
  EXPECT_EQ(read_all(path()), first);
}

struct RigChange {
  const char* name;
  void (*change)(StereoRig&);
  const char* named;
};

const RigChange kRigChanges[] = {
    {"Width", [](StereoRig& rig) { rig.width = 641; }, ": width;"},
    {"Height", [](StereoRig& rig) { rig.height = 300; }, ": height;"},
    {"FocalLengths", [](StereoRig& rig) { rig.fx += 1, rig.fy += 1; }, ": fx, fy;"},
    {"CentreX", [](StereoRig& rig) { rig.cx -= 0.02; }, ": cx;"},
    {"CentreY", [](StereoRig& rig) { rig.cy += 3; }, ": cy;"},
    {"Baseline", [](StereoRig& rig) { rig.baseline = 0.12; }, "baseline 0.12 m): baseline;"},
    {"NaN", [](StereoRig& rig) { rig.baseline = kNaN; }, ": baseline;"},
};

class OtherRig : public testing::TestWithParam<RigChange> {};

TEST_P(OtherRig, IsRefusedAndTheDifferenceNamed) {
  StereoRig present = made_up_rig();
  GetParam().change(present);
  EXPECT_THAT(message_of([&] { check_same_rig(made_up_rig(), present); }),
              AllOf(HasSubstr(GetParam().named), HasSubstr("baseline 0.08 m"), HasSubstr("--calibration")));
}

INSTANTIATE_TEST_SUITE_P(All, OtherRig, testing::ValuesIn(kRigChanges),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(MapRig, TheSameCalibrationWrittenWithFewerDigitsIsTheSame) {
  StereoRig present = made_up_rig();
  present.fx += 1e-4;
  present.baseline *= 1 + 1e-6;
  EXPECT_NO_THROW(check_same_rig(made_up_rig(), present));
}

}  // namespace
}  // namespace spslam
