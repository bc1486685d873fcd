// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/system_test/system_test.hpp"

#include <gmock/gmock.h>

#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/process/fake/fake_process_runner.hpp"

namespace launch {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class SystemTestTest : public testing::Test {
 protected:
  void use() {
    test_.use({[this](const TestRequest& test) { journal_.push_back("begin " + test.name); },
               [this](const ProcessSpec& spec, const std::string& label, OutputStream, std::string_view line) {
                 journal_.push_back(spec.name + " " + label + ": " + std::string(line));
               },
               [this] { journal_.emplace_back("ending"); }, [](const FaultEvent&) {}});
  }

  FakeEventLoop loop_;
  FakeProcessRunner runner_{loop_};
  OutputRouter output_{{.screen_fd = -1}};
  ProcessSupervisor supervisor_{loop_, runner_, output_};
  Processes processes_{loop_, supervisor_, {}};
  std::vector<std::string> journal_;
  SystemTest test_{loop_, supervisor_, processes_, [](const std::string&) {}};
};

TEST_F(SystemTestTest, TellsWhatHappens) {
  use();
  EXPECT_TRUE(test_.watch_output());
  std::vector<TestRequest> tests(2);
  tests[0].name = "one";
  tests[1].name = "two";
  test_.begin(std::move(tests), "");
  ProcessSpec spec;
  spec.name = "talker";
  test_.on_line(spec, 1, "talker-1", OutputStream::kOut, "ready");
  test_.on_shutdown();
  test_.on_end();
  EXPECT_THAT(journal_, ElementsAre("begin one", "begin two", "talker talker-1: ready", "ending"));
}

TEST_F(SystemTestTest, MayChangeProcesses) {
  test_.prepare_by([](ProcessSpec& spec) { spec.crash_directory = "/crashes"; });
  ProcessSpec spec;
  test_.prepare(spec, 1);
  EXPECT_EQ(spec.crash_directory, "/crashes");
}

TEST_F(SystemTestTest, IsNothingWithoutATest) {
  EXPECT_FALSE(test_.watch_output());
  ProcessSpec spec;
  test_.prepare(spec, 1);
  EXPECT_THAT(spec.environment.variables(), IsEmpty());
  test_.begin(std::vector<TestRequest>(1), "");
  test_.on_line(spec, 1, "talker-1", OutputStream::kOut, "ready");
  test_.on_shutdown();
  EXPECT_THAT(journal_, IsEmpty());
}

}  // namespace
}  // namespace launch
