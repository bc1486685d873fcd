// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "launcher/health/blocked_probe.hpp"
#include "launcher/health/output_probe.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

class OutputProbeTest : public testing::Test {
 protected:
  OutputProbeTest() { probe_.begin(1); }
  Look look_for(int seconds) {
    Look look;
    for (int i = 0; i < seconds; ++i) {
      look = probe_.look(now_ += 1s, 1s);
    }
    return look;
  }

  Duration now_ = 100s;
  OutputProbe probe_{OutputPattern("^tick", {}, "stdout", {}), 3s, ProcessorWait("/no such directory")};
};

TEST_F(OutputProbeTest, WaitsForTheFirstLine) {
  EXPECT_EQ(look_for(2).result, Look::Result::kPending);
  const Look look = look_for(1);
  EXPECT_EQ(look.result, Look::Result::kBad);
  EXPECT_EQ(look.why, "it has not printed a line that matches '^tick' on stdout for 3.0 s");
}

TEST_F(OutputProbeTest, EachLineOfThePatternBeginsAnew) {
  for (int i = 0; i < 10; ++i) {
    probe_.on_line(OutputStream::kOut, "tick");
    EXPECT_EQ(look_for(2).result, Look::Result::kGood);
  }
  probe_.on_line(OutputStream::kErr, "tick");
  probe_.on_line(OutputStream::kOut, "tock");
  EXPECT_EQ(look_for(1).result, Look::Result::kGood) << "less than 3 s have certainly gone by since the last line";
  EXPECT_EQ(look_for(1).result, Look::Result::kBad);
}

class BlockedProbeTest : public testing::Test {
 protected:
  BlockedProbeTest() {
    std::filesystem::create_directories(proc_ / "9" / "task" / "9");
    probe_.begin(9);
  }
  ~BlockedProbeTest() override { std::filesystem::remove_all(proc_); }
  Look look_in(char state) {
    std::ofstream(proc_ / "9" / "task" / "9" / "stat") << "9 (a) " << state << " 1\n";
    return probe_.look(0s, 1s);
  }

  std::filesystem::path proc_ =
      std::filesystem::path(testing::TempDir()) / ("blocked_proc_" + std::to_string(::getpid()));
  BlockedProbe probe_{3s, proc_.string()};
};

TEST_F(BlockedProbeTest, FindsAProcessThatIsStopped) {
  EXPECT_EQ(look_in('S').result, Look::Result::kGood);
  EXPECT_EQ(look_in('T').result, Look::Result::kPending);
  EXPECT_EQ(look_in('T').result, Look::Result::kPending);
  EXPECT_EQ(look_in('T').why, "it has been stopped by a signal for 3.0 s");
  EXPECT_EQ(look_in('R').result, Look::Result::kGood);
}

TEST_F(BlockedProbeTest, FindsAProcessThatHangsInTheKernel) {
  for (int i = 0; i < 5; ++i) {
    look_in('D');
    EXPECT_EQ(look_in('S').result, Look::Result::kGood) << "it waits for a disk now and then";
  }
  look_in('D');
  look_in('D');
  EXPECT_EQ(look_in('D').why, "it has hung in the kernel for 3.0 s");
}

TEST_F(BlockedProbeTest, DoesNotJudgeWhatADebuggerHolds) {
  for (int i = 0; i < 9; ++i) {
    const Look look = look_in('t');
    EXPECT_EQ(look.result, Look::Result::kPending);
    EXPECT_EQ(look.note, "a debugger holds it: whether it is blocked is not judged");
  }
}

}  // namespace
}  // namespace launch
