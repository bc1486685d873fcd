// SPDX-License-Identifier: Apache-2.0
// The command of a watch, with real processes.
#include "launcher/health/command_probe.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <vector>

#include "tests/support/emulated.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::StartsWith;

class CommandProbeTest : public testing::Test {
 protected:
  void SetUp() override { NEEDS_VFORK(); }
  std::unique_ptr<CommandProbe> probe_of(const std::string& script, Duration timeout = 30s) {
    ProcessSpec command;
    command.name = "check";
    command.argv = {"sh", "-c", script};
    command.environment = {{"PATH", "/bin:/usr/bin"}};
    return std::make_unique<CommandProbe>(*loop_, *runner_, command, timeout, [this](const Look& look) {
      answers_.push_back(look);
      loop_->quit();
    });
  }
  Look answer(CommandProbe& probe) {
    const Look now = probe.look(0s, 0s);
    if (now.result != Look::Result::kPending) {
      return now;
    }
    loop_->run();
    return answers_.back();
  }

  std::unique_ptr<EventLoop> loop_ = make_sd_event_loop();
  std::unique_ptr<ProcessRunner> runner_ = make_posix_process_runner();
  std::vector<Look> answers_;
};

TEST_F(CommandProbeTest, IsGoodWhenTheCommandEndsWithZero) {
  const auto probe = probe_of("echo fine");
  EXPECT_EQ(answer(*probe).result, Look::Result::kGood);
  EXPECT_EQ(answer(*probe).result, Look::Result::kGood) << "it can be asked again";
}

TEST_F(CommandProbeTest, SaysHowTheCommandHasFailed) {
  const auto probe = probe_of("echo trying; echo 'no answer' >&2; exit 7");
  const Look look = answer(*probe);
  EXPECT_EQ(look.result, Look::Result::kBad);
  EXPECT_EQ(look.why, "the command of its watch has ended with exit code 7 (no answer)");
}

TEST_F(CommandProbeTest, KillsACommandThatDoesNotEnd) {
  const auto probe = probe_of("sleep 1000 & sleep 1000", 200ms);
  EXPECT_EQ(answer(*probe).why, "the command of its watch has not ended within 0.2 s");
}

TEST_F(CommandProbeTest, TakesMuchOutput) {
  const auto probe = probe_of("yes | head -c 1000000; echo; echo last; exit 1");
  EXPECT_THAT(answer(*probe).why, HasSubstr("(last)"));
}

TEST_F(CommandProbeTest, SaysThatTheCommandIsMissing) {
  ProcessSpec command;
  command.name = "check";
  command.argv = {"/no/such/program"};
  CommandProbe probe(*loop_, *runner_, command, 1s, {});
  EXPECT_THAT(probe.look(0s, 0s).why, StartsWith("the command of its watch can't be started: "));
}

TEST_F(CommandProbeTest, IsGivenUpWhenTheProcessEnds) {
  const auto probe = probe_of("sleep 1000");
  EXPECT_EQ(probe->look(0s, 0s).result, Look::Result::kPending);
  probe->end();
  const auto quit = loop_->after(100ms, [this] { loop_->quit(); });
  loop_->run();
  EXPECT_TRUE(answers_.empty());
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "it has been reaped";
}

}  // namespace
}  // namespace launch
