// SPDX-License-Identifier: Apache-2.0
// `launch serve --nodes`: what nodes do, recorded while somebody looks.
#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr std::chrono::seconds kPatience{120};

// Reads events until one has the text, and prints it; or prints the error that is answered instead.
constexpr const char* kClient = R"py(
import json, sys, urllib.error, urllib.request
request = urllib.request.Request('http://127.0.0.1:7411/api/nodes', headers={'Authorization': 'Bearer ' + sys.argv[1]})
try:
    with urllib.request.urlopen(request, timeout=100) as stream:
        for line in stream:
            if line.startswith(b'data: '):
                shown = json.loads(line[6:])['lines']
                if any(sys.argv[2] in row for row in shown):
                    print('\n'.join(shown))
                    break
except urllib.error.HTTPError as error:
    print(error.code, error.read().decode())
)py";

class ServeNodesTest : public testing::Test {
 protected:
  ServeNodesTest() {
    write_file(sandbox_.directory() / "token", std::string(kToken) + "\n");
    fs::permissions(sandbox_.directory() / "token", fs::perms::owner_read);
  }

  Command serve(std::vector<std::string> options) const {
    Command command{.argv = {LAUNCH_PROGRAM, "serve", "--listen", "127.0.0.1:7411", "--token-file",
                             (sandbox_.directory() / "token").string()},
                    .directory = sandbox_.directory()};
    command.argv.insert(command.argv.end(), options.begin(), options.end());
    return command;
  }
  // What a page is told, as soon as it has the text.
  std::string told(const std::string& text) const {
    return run_command(Command{.argv = {"python3", "-c", kClient, kToken, text}}, kPatience).out;
  }

  static constexpr const char* kToken = "a-token-that-nobody-guesses";
  Sandbox sandbox_;
};

TEST_F(ServeNodesTest, AreRecordedWhileSomebodyLooks) {
  RunningCommand run({.argv = {LAUNCH_PROGRAM, PING_PONG, "count:=1000000"}, .directory = sandbox_.directory()});
  ASSERT_TRUE(run.wait_for_output("process started", kPatience)) << run.out() << run.err();
  RunningCommand service(serve({"--nodes"}));
  ASSERT_TRUE(service.wait_for_output(" launches at ", kPatience)) << service.err();
  EXPECT_THAT(told("/pong"), HasSubstr("Callbacks"));
  // Nobody looks any more: the recording ends, and begins again for the next one.
  const auto watches = [&] {
    return run_command(Command{.argv = {"pgrep", "-P", std::to_string(service.pid()), "-f", "launch-watch"}}).out;
  };
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!watches().empty()) {
    ASSERT_LT(std::chrono::steady_clock::now(), end);
  }
  EXPECT_THAT(told("/ping"), HasSubstr("Callbacks"));
  service.send_signal(SIGINT);
  EXPECT_EQ(service.wait(kPatience).exit_code, 0);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait(kPatience).exit_code, 0);
  sandbox_.wait_until_daemons_are_left();
}

TEST_F(ServeNodesTest, AreInTheMetrics) {
  RunningCommand run({.argv = {LAUNCH_PROGRAM, PING_PONG, "count:=1000000"}, .directory = sandbox_.directory()});
  ASSERT_TRUE(run.wait_for_output("process started", kPatience)) << run.out() << run.err();
  RunningCommand service(serve({"--nodes", "--open-metrics"}));
  ASSERT_TRUE(service.wait_for_output(" launches at ", kPatience)) << service.err();
  std::string metrics;
  const std::string wanted = "launch_message_latency_seconds_bucket{topic=\"/pong\",node=\"/ping\",le=\"+Inf\"} ";
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (metrics.find(wanted) == std::string::npos) {
    ASSERT_LT(std::chrono::steady_clock::now(), end) << metrics;
    metrics = run_command(Command{.argv = {"python3", "-c",
                                           "import urllib.request as u; "
                                           "print(u.urlopen('http://127.0.0.1:7411/metrics').read().decode())"}})
                  .out;
  }
  EXPECT_THAT(metrics, HasSubstr("launch_callback_duration_seconds_count{node=\"/ping\",callback=\"timer "));
  EXPECT_THAT(metrics, HasSubstr("\nlaunch_trace_lost_events_total 0\n"));
  service.send_signal(SIGINT);
  EXPECT_EQ(service.wait(kPatience).exit_code, 0);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait(kPatience).exit_code, 0);
  sandbox_.wait_until_daemons_are_left();
}

TEST_F(ServeNodesTest, NobodyRecordsUnasked) {
  RunningCommand service(serve({}));
  ASSERT_TRUE(service.wait_for_output(" launches at ", kPatience)) << service.err();
  const std::string answer = told("");
  EXPECT_THAT(answer, HasSubstr("403 "));
  EXPECT_THAT(answer,
              HasSubstr("\"error\":\"this service does not record nodes\",\"help\":\"it shows what they do if it is "
                        "started with --nodes\""));
  service.send_signal(SIGINT);
  EXPECT_EQ(service.wait(kPatience).exit_code, 0);
}

}  // namespace
