// SPDX-License-Identifier: Apache-2.0
// The directory of a launch's counters is found by the name of a session, and goes, also after a kill.
#include "tracing/record/account/counters/counter_directory.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using tracing::CounterDirectory;

struct CounterDirectories : testing::Test {
  // Of a launch that was killed so long ago.
  static fs::path left(const std::string& name, std::chrono::minutes ago) {
    const fs::path directory = "/dev/shm/launch-event-counters-" + name + std::to_string(getpid());
    fs::create_directory(directory);
    test_support::write_file(directory / "12-34", "");
    fs::last_write_time(directory, fs::file_time_type::clock::now() - ago);
    return directory;
  }

  test_support::Sandbox sandbox;
};

TEST_F(CounterDirectories, OfASessionIsFoundAndGoesWithItsOwner) {
  const std::string session = "session_" + std::to_string(getpid());
  std::shared_ptr<CounterDirectory> directory = CounterDirectory::shared();
  ASSERT_NE(directory, nullptr);
  EXPECT_EQ(CounterDirectory::shared(), directory) << "all traces of a launch share it";
  tracing::note_session(directory->path(), session);
  EXPECT_EQ(CounterDirectory::of_session(session), directory->path());
  EXPECT_EQ(CounterDirectory::of_session(session + "x"), "");
  const fs::path path = directory->path();
  directory.reset();
  EXPECT_FALSE(fs::exists(path));
  EXPECT_EQ(CounterDirectory::of_session(session), "");
}

TEST_F(CounterDirectories, OfKilledLaunchesGoWhenTheNextOneBegins) {
  const fs::path abandoned = left("a", std::chrono::minutes(11));
  const fs::path just_killed = left("b", std::chrono::minutes(9));
  const fs::path in_use = left("c", std::chrono::minutes(11));
  const int user = open(in_use.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(user, LOCK_SH), 0);
  CounterDirectory::shared();
  EXPECT_FALSE(fs::exists(abandoned));
  EXPECT_TRUE(fs::exists(just_killed));
  EXPECT_TRUE(fs::exists(in_use));
  close(user);
  fs::remove_all(just_killed);
  fs::remove_all(in_use);
}

}  // namespace
