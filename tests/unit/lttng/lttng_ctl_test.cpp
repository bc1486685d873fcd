// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/lttng_ctl.hpp"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <string>

#include "tests/support/sandbox.hpp"
#include "tracing/record/lttng/answer_limit.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

TEST(LttngCtl, AFunctionIsThatOfTheLibrary) {
  EXPECT_STREQ(lttng_strerror(-LTTNG_ERR_NO_SESSIOND), "No session daemon is available");
  lttng_endpoint* const endpoint = lttng_notification_endpoint();
  EXPECT_NE(endpoint, nullptr);
}

TEST(LttngCtl, AFunctionThatTheLibraryLacksIsAnError) {
  try {
    lttng_address("lttng_fly");
    FAIL() << "found";
  } catch (const TraceError& error) {
    EXPECT_THAT(error.what(),
                testing::MatchesRegex("cannot use LTTng's control library: .*liblttng-ctl.so.0: undefined "
                                      "symbol: lttng_fly"));
    EXPECT_EQ(error.remedy(), "install lttng-tools");
  }
}

TEST(LttngCtl, ADaemonThatDoesNotAnswerIsAnError) {
  const test_support::Sandbox sandbox;
  const std::filesystem::path socket_path = std::filesystem::path(session_daemon_directory()) / "client-lttng-sessiond";
  std::filesystem::create_directories(socket_path.parent_path());
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  socket_path.string().copy(address.sun_path, sizeof address.sun_path - 1);
  const int silent = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ASSERT_EQ(bind(silent, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0) << std::strerror(errno);
  ASSERT_EQ(listen(silent, 9), 0);
  set_longest_silence(std::chrono::milliseconds(200));
  lttng_session* sessions = nullptr;
  const auto list = [&sessions] { return lttng_list_sessions(&sessions); };
  const auto before = std::chrono::steady_clock::now();
  for (int i = 0; i < 2; ++i) {
    try {
      check_lttng(list(), "list the trace sessions");
      ADD_FAILURE() << "answered";
    } catch (const TraceError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith("cannot list the trace sessions: LTTng does not answer"));
    }
  }
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(9));
  // A set-up that has failed ends its session, and looks whether it has gone.
  set_longest_silence(std::chrono::milliseconds(2000));
  const auto begin = std::chrono::steady_clock::now();
  list();
  lttng_destroy_session_no_wait("run");
  list();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(1500));
  set_longest_silence(kLongestSilence);
  close(silent);
  std::filesystem::remove(socket_path);
  EXPECT_EQ(list(), -LTTNG_ERR_NO_SESSIOND);
  EXPECT_FALSE(AnswerLimit::was_unanswered());
}

}  // namespace
}  // namespace tracing
