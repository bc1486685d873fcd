// SPDX-License-Identifier: Apache-2.0
// A disk in memory in place of a directory. Each test is a process of its own that enters its own mounts.
#include "launcher/process/isolation/memory_disk.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <thread>

namespace launch {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMebibyte = 1 << 20;

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The error of the first write that fails, of so many bytes in pieces; 0: all are written.
int error_of_writing(const fs::path& path, std::uint64_t bytes) {
  const UniqueFd file(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
  const std::string piece(4096, 'x');
  for (std::uint64_t written = 0; written < bytes; written += piece.size()) {
    if (::write(file.get(), piece.data(), piece.size()) != static_cast<ssize_t>(piece.size())) {
      return errno;
    }
  }
  return 0;
}

class MemoryDiskTest : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/memory_disk_test.XXXXXX";
    directory_ = fs::canonical(::mkdtemp(name));
    covered_.reset(::open(directory_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    try {
      enter_own_mounts();
    } catch (const std::system_error& error) {
      GTEST_SKIP() << "skipped, because no mount namespace can be made: " << error.what();
    }
  }
  void TearDown() override {
    disk_.reset();
    (void)::umount2(directory_.c_str(), MNT_DETACH);  // the disk stays mounted until this process ends
    fs::remove_all(directory_);
  }

  MemoryDisk& mount() { return disk_.emplace(directory_.string()); }
  // The directory that the disk covers.
  fs::path below() const { return fmt::format("/proc/self/fd/{}/", covered_.get()); }

  fs::path directory_;
  UniqueFd covered_;
  std::optional<MemoryDisk> disk_;
};

TEST_F(MemoryDiskTest, HoldsWhatTheDirectoryHoldsAndChangesNothingThere) {
  write_file(directory_ / "map.yaml", "resolution: 0.05");
  ASSERT_EQ(::chmod((directory_ / "map.yaml").c_str(), 0640), 0);
  fs::create_directory(directory_ / "inner");
  write_file(directory_ / "inner" / "map.pgm", "P5");
  ASSERT_EQ(::chmod((directory_ / "inner").c_str(), 0700), 0);
  fs::create_symlink("inner/map.pgm", directory_ / "latest");
  ASSERT_EQ(::mkfifo((directory_ / "pipe").c_str(), 0600), 0);
  ASSERT_EQ(::chmod(directory_.c_str(), 01777), 0);
  mount();
  EXPECT_EQ(read_file(directory_ / "map.yaml"), "resolution: 0.05");
  EXPECT_EQ(fs::status(directory_ / "map.yaml").permissions(), fs::perms(0640));
  EXPECT_EQ(fs::status(directory_ / "inner").permissions(), fs::perms(0700));
  EXPECT_EQ(fs::status(directory_).permissions(), fs::perms(01777));
  EXPECT_EQ(read_file(directory_ / "latest"), "P5");
  EXPECT_FALSE(fs::exists(directory_ / "pipe"));
  write_file(directory_ / "map.yaml", "resolution: 0.1");
  write_file(directory_ / "new", "");
  fs::remove(directory_ / "latest");
  EXPECT_EQ(read_file(below() / "map.yaml"), "resolution: 0.05");
  EXPECT_FALSE(fs::exists(below() / "new"));
  EXPECT_TRUE(fs::is_symlink(below() / "latest"));
}

TEST_F(MemoryDiskTest, IsFullAndHasRoomAgain) {
  MemoryDisk& disk = mount();
  write_file(directory_ / "before", "kept");
  disk.leave(0);
  EXPECT_EQ(error_of_writing(directory_ / "a", 4096), ENOSPC);
  EXPECT_EQ(read_file(directory_ / "before"), "kept");
  disk.leave(kMebibyte);
  EXPECT_EQ(error_of_writing(directory_ / "a", kMebibyte), 0);
  EXPECT_EQ(error_of_writing(directory_ / "b", 4096), ENOSPC);
  disk.leave(std::nullopt);
  EXPECT_EQ(error_of_writing(directory_ / "b", 4 * kMebibyte), 0);
}

// Nothing has been written to it, and 0 would mean no limit.
TEST_F(MemoryDiskTest, AnEmptyDiskIsFull) {
  mount().leave(0);
  EXPECT_EQ(error_of_writing(directory_ / "a", 4096), ENOSPC);
}

TEST_F(MemoryDiskTest, IsFullWhilePeopleWriteAndRemove) {
  MemoryDisk& disk = mount();
  std::atomic<bool> end = false;
  std::thread writer([&] {
    while (!end) {
      error_of_writing(directory_ / "a", 64 << 10);
      fs::remove(directory_ / "a");
    }
  });
  for (int i = 0; i < 50; ++i) {
    disk.leave(0);
    disk.leave(std::nullopt);
  }
  disk.leave(0);
  // There is no more room than that of the file which comes and goes.
  EXPECT_EQ(error_of_writing(directory_ / "b", kMebibyte), ENOSPC);
  end = true;
  writer.join();
}

TEST_F(MemoryDiskTest, SavesItsFiles) {
  write_file(directory_ / "old", "old");
  MemoryDisk& disk = mount();
  write_file(directory_ / "old", "changed");
  fs::create_directories(directory_ / "one/two");
  write_file(directory_ / "one/two/new", "new");
  fs::create_symlink("one", directory_ / "latest");
  disk.leave(0);
  disk.save();
  EXPECT_EQ(read_file(below() / "old"), "changed");
  EXPECT_EQ(read_file(below() / "one/two/new"), "new");
  EXPECT_EQ(fs::read_symlink(below() / "latest"), "one");
  disk.save();
}

TEST_F(MemoryDiskTest, RefusesADirectoryThatDoesNotFitIntoMemory) {
  write_file(directory_ / "bag", "");
  fs::resize_file(directory_ / "bag", MemoryDisk::kMostCopied + 1);  // sparse
  EXPECT_THAT([&] { mount(); }, testing::Throws<std::system_error>(testing::Property(
                                    &std::system_error::code, std::error_code(EFBIG, std::system_category()))));
  EXPECT_EQ(fs::file_size(directory_ / "bag"), MemoryDisk::kMostCopied + 1) << "nothing covers it";
}

TEST_F(MemoryDiskTest, NamesADirectoryThatIsNotThere) {
  try {
    MemoryDisk disk("/nowhere");
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_STREQ(error.what(), "/nowhere: No such file or directory");
  }
}

}  // namespace
}  // namespace launch
