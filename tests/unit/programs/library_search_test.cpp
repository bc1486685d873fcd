// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/programs/library_search.hpp"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <filesystem>

#include "tests/support/command.hpp"

namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::IsEmpty;
using tracing::ElfFile;
using tracing::LibrarySearch;

constexpr const char* kLibrary = "libtracetools.so";

// The path that the dynamic linker itself takes; "" if it finds none or needs none.
std::string taken_by_linker(const std::string& program, const std::string& library_path) {
  ::setenv("LD_TRACE_LOADED_OBJECTS", "1", 1);
  ::setenv("LD_LIBRARY_PATH", library_path.c_str(), 1);
  const test_support::CommandResult listed = test_support::run_command({program});
  ::unsetenv("LD_TRACE_LOADED_OBJECTS");
  ::unsetenv("LD_LIBRARY_PATH");
  const std::string begin = std::string(kLibrary) + " => /";
  const std::size_t at = listed.out.find(begin);
  if (at == std::string::npos) {
    return "";
  }
  const std::size_t path = at + begin.size() - 1;
  return listed.out.substr(path, listed.out.find(' ', path) - path);
}

std::string canonical(const std::string& path) {
  return path.empty() ? path : fs::canonical(path).string();
}

// Finds the library, and expects that the linker finds the same one.
std::string found(const std::string& program, const std::string& library_path) {
  LibrarySearch search;
  const std::string path = canonical(search.library_of(program, kLibrary, {{"LD_LIBRARY_PATH", library_path}}));
  EXPECT_EQ(path, canonical(taken_by_linker(program, library_path))) << program << " " << library_path;
  return path;
}

const std::string kOther = OTHER_ROS2;

TEST(LibrarySearch, TheEnvironmentTellsWhereALibraryOfALibraryIs) {
  const std::string program = kOther + "/jazzy/lib/demo/talker";
  EXPECT_THAT(found(program, kOther + "/jazzy/lib"), EndsWith("/other_ros2/jazzy/lib/libtracetools.so"));
  EXPECT_THAT(found(program, "/nowhere:" + kOther + "/iron/lib:" + kOther + "/jazzy/lib"),
              EndsWith("/iron/lib/libtracetools.so"));
  EXPECT_THAT(found(program, ""), IsEmpty()) << "its library is not found, so nothing needs the other one";
}

TEST(LibrarySearch, ARunPathComesAfterTheEnvironmentAndIsForTheFileAlone) {
  const std::string program = kOther + "/runpath_node";
  EXPECT_THAT(found(program, kOther + "/iron/lib"), EndsWith("/iron/lib/libtracetools.so"));
  EXPECT_THAT(found(program, ""), IsEmpty()) << "librclcpp.so has no folder of its own";
}

TEST(LibrarySearch, AnRPathComesBeforeTheEnvironmentAndIsForAllThatTheProgramLoads) {
  const std::string program = kOther + "/rpath_node";
  EXPECT_THAT(found(program, kOther + "/iron/lib"), EndsWith("/jazzy/lib/libtracetools.so"));
  EXPECT_THAT(found(program, ""), EndsWith("/jazzy/lib/libtracetools.so"));
}

TEST(LibrarySearch, ProgramsOfTheStackHaveTheirOwnWhateverTheEnvironmentSays) {
  EXPECT_THAT(found(FIRE_ALL_EVENTS, kOther + "/iron/lib"), EndsWith("/prefix/lib/libtracetools.so"));
}

TEST(LibrarySearch, AProgramThatNeedsItNotHasNone) {
  EXPECT_THAT(found("/bin/true", kOther + "/iron/lib"), IsEmpty());
  LibrarySearch search;
  EXPECT_THAT(search.library_of("/nowhere", kLibrary, {}), IsEmpty());
  EXPECT_THAT(search.library_of("/etc/passwd", kLibrary, {}), IsEmpty());
}

TEST(ElfFile, DamagedFilesHaveLess) {
  const std::string whole = test_support::read_file(kOther + "/jazzy/lib/libtracetools.so");
  const fs::path path = fs::temp_directory_path() / ("damaged_elf_" + std::to_string(::getpid()));
  for (std::size_t size = 0; size < whole.size(); size += size < 4096 ? 61 : 4099) {
    test_support::write_file(path, whole.substr(0, size));
    if (const auto file = ElfFile::read(path.string())) {
      file->exported_symbols();
      EXPECT_LE(file->needed.size(), 10U);
    }
  }
  for (std::size_t place = 16; place < 4096; place += 7) {
    std::string changed = whole;
    changed.replace(place, 8, 8, '\xff');
    test_support::write_file(path, changed);
    if (const auto file = ElfFile::read(path.string())) {
      file->exported_symbols();
    }
  }
  fs::remove(path);
}

}  // namespace
