// SPDX-License-Identifier: Apache-2.0
// Where the core of a process is looked for, for the patterns that core(5) describes.
#include "launcher/crash/core_search.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "launcher/crash/core_file.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

TEST(CoreSetting, TellsTheFilesOfAPattern) {
  EXPECT_EQ((CoreSetting{"core", false}.glob(77, "/work")), "/work/core");
  EXPECT_EQ((CoreSetting{"core", true}.glob(77, "/work")), "/work/core.77");
  EXPECT_EQ((CoreSetting{"core.%p", true}.glob(77, "/work")), "/work/core.77");
  EXPECT_EQ((CoreSetting{"/var/cores/%e.%P.%t-%h", false}.glob(77, "/work")), "/var/cores/*.*.*-*");
  EXPECT_EQ((CoreSetting{"/a/100%%/%E", false}.glob(77, "/work")), "/a/100%/*");
}

TEST(CoreSetting, TakesNoCharacterOfADirectoryForAPattern) {
  EXPECT_EQ((CoreSetting{"core", false}.glob(77, "/a[1]*")), "/a\\[1]\\*/core");
  EXPECT_EQ((CoreSetting{"core%", false}.glob(77, "/a")), "/a/core");
}

TEST(CoreSetting, TellsTheProgramThatGetsTheCores) {
  EXPECT_EQ((CoreSetting{"|/usr/lib/systemd/systemd-coredump %P %u", false}.program()),
            "/usr/lib/systemd/systemd-coredump");
  EXPECT_EQ((CoreSetting{"core", false}.program()), "");
}

TEST(FindCore, SaysWhyThereIsNone) {
  const std::string scratch = testing::TempDir();
  EXPECT_EQ(find_core({"|/usr/bin/keep %p", false}, 77, "/", scratch).missing,
            "the kernel gives cores to '/usr/bin/keep', which is not asked for them; `sysctl "
            "kernel.core_pattern=core.%p` makes them files");
  EXPECT_EQ(find_core({"core.%p", false}, 77, "/missing", scratch).missing,
            "there is no core of process 77 at /missing/core.77 (kernel.core_pattern is 'core.%p')");
}

// A file that is there but of another kind, or cut off.
TEST(ReadCoreFile, TakesNoOtherFile) {
  EXPECT_EQ(read_core_file("/proc/self/exe"), std::nullopt);
  EXPECT_EQ(read_core_file("/missing"), std::nullopt);
  const fs::path cut = fs::path(testing::TempDir()) / "crash_test_cut";
  std::ofstream(cut) << "\177ELF";
  EXPECT_EQ(read_core_file(cut.string()), std::nullopt);
  fs::remove(cut);
}

}  // namespace
}  // namespace launch
