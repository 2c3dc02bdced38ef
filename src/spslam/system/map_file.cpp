// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/system/map_file.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstring>

#include "spslam/base/atomic_file.h"
#include "spslam/base/mapped_file.h"
#include "spslam/system/byte_stream.h"

namespace spslam {
namespace {

constexpr std::array<char, 8> kMagic = {'S', 'P', 'S', 'L', 'M', 'A', 'P', '\x1A'};
constexpr std::uint32_t kVersion = 2;  // 2: images and the features' level_scale
constexpr std::size_t kHeaderBytes = kMagic.size() + 4 + 4 + 8;

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw InputError(name + ": " + what);
}

std::string described(const StereoRig& rig) {
  return fmt::format("{} x {} px, fx {:.6g}, fy {:.6g}, cx {:.6g}, cy {:.6g} px, baseline {:.6g} m",
                     rig.width, rig.height, rig.fx, rig.fy, rig.cx, rig.cy, rig.baseline);
}

}  // namespace

void save_map(const std::filesystem::path& path, const Map& map, const StereoRig& rig) {
  std::vector<std::byte> file = encode_map(map, rig, kHeaderBytes);
  const auto payload = std::span<const std::byte>(file).subspan(kHeaderBytes);
  ByteWriter header(kHeaderBytes);
  for (const char letter : kMagic) header.put(letter);
  header.put(kVersion);
  header.put(crc32(payload));
  header.put(std::uint64_t{payload.size()});
  const std::vector<std::byte> header_bytes = std::move(header).bytes();
  std::copy(header_bytes.begin(), header_bytes.end(), file.begin());
  write_file_atomically(path, file);
}

SavedMap load_map(const std::filesystem::path& path) {
  const MappedFile file(path);
  return parse_map(file.bytes(), path.string());
}

SavedMap parse_map(std::span<const std::byte> file, const std::string& name) {
  if (file.empty()) refuse(name, "is empty; give a map that --save-map wrote");
  const std::size_t magic = std::min(file.size(), kMagic.size());
  if (std::memcmp(file.data(), kMagic.data(), magic) != 0)
    refuse(name, "is not a map of SP-SLAM; give a map that --save-map wrote");
  const std::string damaged = "; the file is damaged, use another copy or make it anew";
  if (file.size() < kHeaderBytes) refuse(name, "ends within its header" + damaged);
  ByteReader header(file.subspan(magic), name);
  const auto version = header.take<std::uint32_t>(), checksum = header.take<std::uint32_t>();
  const auto size = header.take<std::uint64_t>();
  if (version != kVersion)
    refuse(name,
           fmt::format("is a map of format {}, this program reads format {}; read it with the version of "
                       "spslam that wrote it, or make it anew",
                       version, kVersion));
  const std::span<const std::byte> payload = file.subspan(kHeaderBytes);
  if (payload.size() != size)
    refuse(name,
           fmt::format("has {} bytes behind its header, should have {}", payload.size(), size) + damaged);
  if (crc32(payload) != checksum) refuse(name, "does not have the checksum it was written with" + damaged);
  return decode_map(payload, name);
}

void check_same_rig(const StereoRig& saved, const StereoRig& present) {
  constexpr double kPixels = 0.01, kShare = 1e-4;
  std::string differs;
  const auto compare = [&](const char* what, double a, double b, double tolerance) {
    if (!(std::abs(a - b) <= tolerance)) differs += (differs.empty() ? "" : ", ") + std::string(what);
  };
  compare("width", saved.width, present.width, 0);
  compare("height", saved.height, present.height, 0);
  compare("fx", saved.fx, present.fx, kPixels);
  compare("fy", saved.fy, present.fy, kPixels);
  compare("cx", saved.cx, present.cx, kPixels);
  compare("cy", saved.cy, present.cy, kPixels);
  compare("baseline", saved.baseline, present.baseline, kShare * std::abs(present.baseline));
  if (differs.empty()) return;
  throw InputError("the map was made with another calibration (" + described(saved) +
                   ") than the present one (" + described(present) + "): " + differs +
                   "; give the calibration of the map with --calibration, or make a map with this one");
}

}  // namespace spslam
