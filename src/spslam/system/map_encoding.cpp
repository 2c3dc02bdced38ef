// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Layout: rig; landmarks, keyframes, loop edges, each list behind its length (u64). Ids i64, measures f64 or
// f32 as in map/types.h, a motion as its rotation row by row and its translation. docs/FORMATS.md has the
// table.

#include "spslam/system/map_encoding.h"

#include <algorithm>

#include "spslam/system/byte_stream.h"
#include "spslam/system/map_soundness.h"

namespace spslam {
namespace {

// The least bytes that an item can have, against counts that no file could hold.
constexpr std::size_t kSightingBytes = 8 + 7 * 8;
constexpr std::size_t kFeatureBytes = 4 * 4 + 1 + 32 + 2 * 4;
constexpr std::size_t kLandmarkBytes = 2 * 8 + 2 * 4 + 7 * 8 + 1 + 32 + 1;
constexpr std::size_t kKeyframeBytes = 3 * 8 + 8 + 12 * 8 + 8 + 1 + 8;
constexpr std::size_t kLoopBytes = 2 * 8 + 12 * 8 + 8;

template <class Vector>
void put_vector(ByteWriter& out, const Vector& vector) {
  for (Eigen::Index i = 0; i < vector.size(); ++i) out.put(vector(i));
}

template <class Vector>
Vector take_vector(ByteReader& in) {
  Vector vector;
  for (Eigen::Index i = 0; i < vector.size(); ++i) vector(i) = in.take<typename Vector::Scalar>();
  return vector;
}

template <class Id>
Id take_id(ByteReader& in) {
  return Id{in.take<std::int64_t>()};
}

void put(ByteWriter& out, const SE3& motion) {
  for (int row = 0; row < 3; ++row) put_vector(out, motion.rotation.row(row));
  put_vector(out, motion.translation);
}

SE3 take_motion(ByteReader& in) {
  SE3 motion;
  for (int row = 0; row < 3; ++row) motion.rotation.row(row) = take_vector<Eigen::RowVector3d>(in);
  motion.translation = take_vector<Eigen::Vector3d>(in);
  return motion;
}

void put(ByteWriter& out, const Descriptor& descriptor) {
  for (const std::uint64_t word : descriptor) out.put(word);
}

Descriptor take_descriptor(ByteReader& in) {
  Descriptor descriptor;
  for (std::uint64_t& word : descriptor) word = in.take<std::uint64_t>();
  return descriptor;
}

void put(ByteWriter& out, const StereoRig& rig) {
  for (const double value : {rig.fx, rig.fy, rig.cx, rig.cy, rig.baseline}) out.put(value);
  out.put(std::int32_t{rig.width});
  out.put(std::int32_t{rig.height});
}

StereoRig take_rig(ByteReader& in) {
  StereoRig rig;
  for (double* value : {&rig.fx, &rig.fy, &rig.cx, &rig.cy, &rig.baseline}) *value = in.take<double>();
  rig.width = in.take<std::int32_t>();
  rig.height = in.take<std::int32_t>();
  return rig;
}

void put(ByteWriter& out, const Landmark& landmark) {
  out.put(landmark.id.value);
  out.put(landmark.host.value);
  put_vector(out, landmark.pixel);
  put_vector(out, landmark.bearing);
  for (const double value : {landmark.inverse_depth, landmark.information, landmark.stereo_inverse_depth,
                             landmark.stereo_information})
    out.put(value);
  out.put(static_cast<std::uint8_t>(landmark.region));
  put(out, landmark.descriptor);
  out.put(landmark.octave);
}

Landmark take_landmark(ByteReader& in) {
  Landmark landmark;
  landmark.id = take_id<LandmarkId>(in);
  landmark.host = take_id<KeyframeId>(in);
  landmark.pixel = take_vector<Eigen::Vector2f>(in);
  landmark.bearing = take_vector<Eigen::Vector3d>(in);
  for (double* value : {&landmark.inverse_depth, &landmark.information, &landmark.stereo_inverse_depth,
                        &landmark.stereo_information})
    *value = in.take<double>();
  landmark.region = static_cast<Region>(in.take<std::uint8_t>());
  landmark.descriptor = take_descriptor(in);
  landmark.octave = in.take<std::uint8_t>();
  return landmark;
}

void put(ByteWriter& out, const Sighting& sighting) {
  out.put(sighting.landmark.value);
  put_vector(out, sighting.measured);
  put_vector(out, sighting.inverse_sigma);
  out.put(sighting.weight);
}

Sighting take_sighting(ByteReader& in) {
  Sighting sighting;
  sighting.landmark = take_id<LandmarkId>(in);
  sighting.measured = take_vector<Eigen::Vector3d>(in);
  sighting.inverse_sigma = take_vector<Eigen::Vector3d>(in);
  sighting.weight = in.take<double>();
  return sighting;
}

void put(ByteWriter& out, const KeyframeFeatures& features) {
  out.put(features.level_scale);
  out.put(std::uint64_t{features.size()});
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Keypoint& keypoint = features.keypoints[i];
    for (const float value : {keypoint.x, keypoint.y, keypoint.angle, keypoint.response}) out.put(value);
    out.put(keypoint.octave);
    put(out, features.descriptors[i]);
    out.put(features.inverse_depths[i]);
    out.put(features.information[i]);
  }
}

std::shared_ptr<const KeyframeFeatures> take_features(ByteReader& in) {
  auto features = std::make_shared<KeyframeFeatures>();
  features->level_scale = in.take<float>();
  const std::size_t count = in.take_count(kFeatureBytes, "features");
  features->keypoints.reserve(count);
  features->descriptors.reserve(count);
  features->inverse_depths.reserve(count);
  features->information.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Keypoint keypoint;
    for (float* value : {&keypoint.x, &keypoint.y, &keypoint.angle, &keypoint.response})
      *value = in.take<float>();
    keypoint.octave = in.take<std::uint8_t>();
    features->keypoints.push_back(keypoint);
    features->descriptors.push_back(take_descriptor(in));
    features->inverse_depths.push_back(in.take<float>());
    features->information.push_back(in.take<float>());
  }
  return features;
}

void put(ByteWriter& out, const Keyframe& keyframe) {
  out.put(keyframe.id.value);
  out.put(keyframe.frame.value);
  out.put(keyframe.parent.value);
  out.put(keyframe.timestamp);
  put(out, keyframe.camera_from_world);
  out.put(std::uint64_t{keyframe.sightings.size()});
  for (const Sighting& sighting : keyframe.sightings) put(out, sighting);
  out.put(std::uint8_t{keyframe.features != nullptr});
  if (keyframe.features) put(out, *keyframe.features);
  out.put(std::uint64_t{keyframe.image ? keyframe.image->size() : 0});
  if (keyframe.image) out.put_bytes(*keyframe.image);
}

Keyframe take_keyframe(ByteReader& in) {
  Keyframe keyframe;
  keyframe.id = take_id<KeyframeId>(in);
  keyframe.frame = take_id<FrameId>(in);
  keyframe.parent = take_id<KeyframeId>(in);
  keyframe.timestamp = in.take<double>();
  keyframe.camera_from_world = take_motion(in);
  const std::size_t sightings = in.take_count(kSightingBytes, "sightings");
  keyframe.sightings.reserve(sightings);
  for (std::size_t i = 0; i < sightings; ++i) keyframe.sightings.push_back(take_sighting(in));
  const auto has_features = in.take<std::uint8_t>();
  if (has_features > 1) in.fail("neither says that features follow nor that none do");
  if (has_features) keyframe.features = take_features(in);
  if (const std::size_t size = in.take_count(1, "bytes of an image"))
    keyframe.image = std::make_shared<const ImageBytes>(in.take_bytes(size));
  return keyframe;
}

void put(ByteWriter& out, const LoopEdge& edge) {
  out.put(edge.older.value);
  out.put(edge.newer.value);
  put(out, edge.newer_from_older);
  out.put(edge.weight);
}

LoopEdge take_loop(ByteReader& in) {
  LoopEdge edge;
  edge.older = take_id<KeyframeId>(in);
  edge.newer = take_id<KeyframeId>(in);
  edge.newer_from_older = take_motion(in);
  edge.weight = in.take<double>();
  return edge;
}

template <class Item>
std::vector<Item> take_all(ByteReader& in, std::size_t least_bytes, const char* what,
                           Item (*take)(ByteReader&)) {
  std::vector<Item> items(in.take_count(least_bytes, what));
  for (Item& item : items) item = take(in);
  return items;
}

std::size_t encoded_size(const Map& map) {
  std::size_t size = 256 + map.landmarks().size() * kLandmarkBytes + map.loops().size() * kLoopBytes;
  for (const auto& [id, keyframe] : map.keyframes())
    size += kKeyframeBytes + 12 + keyframe.sightings.size() * kSightingBytes +
            (keyframe.features ? keyframe.features->size() * kFeatureBytes : 0) +
            (keyframe.image ? keyframe.image->size() : 0);
  return size;
}

// What is in a map or is about to be, in the order of the ids.
struct Parts {
  MapIds ids;
  std::vector<const Landmark*> landmarks;
  std::vector<const Keyframe*> keyframes;

  void add(const Landmark& landmark) {
    ids.landmarks.push_back(landmark.id);
    landmarks.push_back(&landmark);
  }
  void add(const Keyframe& keyframe) {
    ids.keyframes.push_back(keyframe.id);
    keyframes.push_back(&keyframe);
  }
};

MapProblem first_problem(const Parts& parts, const std::vector<LoopEdge>& loops) {
  if (MapProblem problem = problem_of(parts.ids)) return problem;
  for (const Landmark* landmark : parts.landmarks)
    if (MapProblem problem = problem_of(*landmark, parts.ids)) return problem;
  std::vector<KeyframeId> parents;
  for (const Keyframe* keyframe : parts.keyframes) {
    if (MapProblem problem = problem_of(*keyframe, parts.ids)) return problem;
    parents.push_back(keyframe->parent);
  }
  for (const LoopEdge& edge : loops)
    if (MapProblem problem = problem_of(edge, parts.ids)) return problem;
  return problem_of_tree(parents, parts.ids);
}

void check(const StereoRig& rig, const std::string& name) {
  try {
    rig.check();
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  }
}

// Parents come first: the map gives a keyframe that has none the newest one as its parent.
Map assemble(const std::vector<Landmark>& landmarks, std::vector<Keyframe> keyframes,
             const std::vector<LoopEdge>& loops) {
  Map map;
  for (const Landmark& landmark : landmarks) map.add(landmark);
  std::stable_partition(keyframes.begin(), keyframes.end(),
                        [](const Keyframe& k) { return !k.parent.valid(); });
  for (Keyframe& keyframe : keyframes) map.add(std::move(keyframe));
  for (const LoopEdge& edge : loops) map.add(edge);
  return map;
}

}  // namespace

std::vector<std::byte> encode_map(const Map& map, const StereoRig& rig, std::size_t header_bytes) {
  rig.check();
  Parts parts;
  for (const auto& [id, landmark] : map.landmarks()) parts.add(landmark);
  for (const auto& [id, keyframe] : map.keyframes()) parts.add(keyframe);
  if (MapProblem problem = first_problem(parts, map.loops()))
    throw OutputError("the map is not saved, for nobody could read it: " + *problem +
                      "; this is an error of the program, please report it");
  ByteWriter out(header_bytes + encoded_size(map));
  for (std::size_t i = 0; i < header_bytes; ++i) out.put(std::uint8_t{0});
  put(out, rig);
  out.put(std::uint64_t{map.landmarks().size()});
  for (const Landmark* landmark : parts.landmarks) put(out, *landmark);
  out.put(std::uint64_t{map.keyframes().size()});
  for (const Keyframe* keyframe : parts.keyframes) put(out, *keyframe);
  out.put(std::uint64_t{map.loops().size()});
  for (const LoopEdge& edge : map.loops()) put(out, edge);
  return std::move(out).bytes();
}

SavedMap decode_map(std::span<const std::byte> bytes, const std::string& name) {
  ByteReader in(bytes, name);
  SavedMap saved;
  saved.rig = take_rig(in);
  check(saved.rig, name);
  std::vector<Landmark> landmarks = take_all(in, kLandmarkBytes, "landmarks", take_landmark);
  std::vector<Keyframe> keyframes = take_all(in, kKeyframeBytes, "keyframes", take_keyframe);
  const std::vector<LoopEdge> loops = take_all(in, kLoopBytes, "loop edges", take_loop);
  if (in.left() > 0) in.fail("the map ends here, the file does not");
  Parts parts;
  for (const Landmark& landmark : landmarks) parts.add(landmark);
  for (const Keyframe& keyframe : keyframes) parts.add(keyframe);
  if (MapProblem problem = first_problem(parts, loops))
    throw InputError(name + ": " + *problem + "; the file is damaged, use another copy or make it anew");
  saved.map = assemble(landmarks, std::move(keyframes), loops);
  return saved;
}

}  // namespace spslam
