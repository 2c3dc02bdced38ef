// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>

#include <filesystem>

#include "cli/process.h"
#include "spslam/system/map_file.h"
#include "system/made_up_map.h"

namespace spslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string saved_map(const TemporaryFolder& folder) {
  save_map(folder.path("river.map"), test::made_up_map(), test::made_up_rig());
  return folder.path("river.map");
}

TEST(ExportMap, WritesPly) {
  const TemporaryFolder folder;
  const ProcessResult result = run_spslam({"export-map", saved_map(folder), "-o", folder.path("river.ply")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("of 12 landmarks"), HasSubstr("6 keyframes")));
  EXPECT_THAT(read_file(folder.path("river.ply")),
              AllOf(testing::StartsWith("ply\n"), HasSubstr("element edge 5")));
}

TEST(ExportMap, WritesTwoTables) {
  const TemporaryFolder folder;
  const std::string csv = folder.path("river.csv");
  EXPECT_EQ(run_spslam({"export-map", saved_map(folder), "-o", csv}).exit_code, 0);
  EXPECT_THAT(read_file(csv), testing::StartsWith("landmark,x,y,z,sigma"));
  EXPECT_THAT(read_file(folder.path("river_keyframes.csv")), HasSubstr("\n11,50,1700000000.500"));
  const std::string few = read_file(csv);
  EXPECT_EQ(run_spslam({"export-map", saved_map(folder), "-o", csv, "--max-uncertainty", "10",
                        "--min-observers", "0"})
                .exit_code,
            0);
  EXPECT_GT(read_file(csv).size(), few.size());
}

TEST(ExportMap, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string map = saved_map(folder), text = folder.write("no.map", "no map at all, just text");
  const ProcessResult foreign = run_spslam({"export-map", text, "-o", folder.path("a.ply")});
  EXPECT_EQ(foreign.exit_code, 1);
  EXPECT_THAT(foreign.err, AllOf(HasSubstr("no.map"), HasSubstr("not a map of SP-SLAM")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("a.ply")));
  const ProcessResult ending = run_spslam({"export-map", map, "-o", folder.path("a.pcd")});
  EXPECT_EQ(ending.exit_code, 2);
  EXPECT_THAT(ending.err, HasSubstr(".ply or .csv"));
  EXPECT_EQ(run_spslam({"export-map", map, "-o", folder.path("no/folder/a.ply")}).exit_code, 1);
}

}  // namespace
}  // namespace spslam
