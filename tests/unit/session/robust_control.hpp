// SPDX-License-Identifier: Apache-2.0
// A tracer in a sandbox, and what tests of problems around a session do to it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/sandbox.hpp"
#include "tests/unit/session/listed_session.hpp"
#include "tests/unit/session/trace_reading.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/tracer.hpp"

namespace trace_test {

namespace fs = std::filesystem;

using tracing::LossAccount;
using tracing::TraceConfig;
using tracing::TraceError;

inline bool never() {
  return false;
}

struct RobustControl : testing::Test {
  TraceConfig config(const std::string& name = "run") const {
    TraceConfig made;
    made.session_name = name;
    made.base_path = sandbox.trace_directory();
    return made;
  }

  // An application that does not wait, a megabyte, and a session that ends and reports its losses.
  LossAccount record_more_than_fits(const std::string& base_path) {
    TraceConfig full = config();
    full.base_path = base_path;
    tracer->start(full);
    TracedApp app(2000, 200);
    app.fire_again();
    app.end();
    LossAccount losses = tracer->finish(full, never);
    EXPECT_FALSE(losses.complete());
    EXPECT_FALSE(losses.channels.at(0).unwritten.empty());
    EXPECT_EQ(listed_sessions(), "");
    return losses;
  }

  // Whether the first packet of one of them fits depends on the processor of the application.
  static auto lacks_events(const std::string& why) {
    return testing::MatchesRegex(why +
                                 ": (events after 0\\.[0-9]+ s of [0-9.]+ s are missing|no event could be written); "
                                 "make room there, or choose another base-path");
  }

  // "what\nremedy" of the error that `work` throws.
  template <typename Work>
  static std::string error_of(Work work) {
    try {
      work();
    } catch (const TraceError& error) {
      return std::string(error.what()) + "\n" + error.remedy();
    }
    return "no error";
  }

  // The processes of this test with this name.
  static std::vector<pid_t> processes(const std::string& name) {
    std::vector<pid_t> found;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
      std::string comm;
      std::getline(std::ifstream(entry.path() / "comm") >> std::ws, comm);
      if (comm == name &&
          fs::read_symlink(entry.path() / "ns" / "net", ignored) == fs::read_symlink("/proc/self/ns/net")) {
        found.push_back(std::stoi(entry.path().filename()));
      }
    }
    return found;
  }

  // Kills them and waits until they have ended.
  static void kill_processes(const std::string& name) {
    for (const pid_t pid : processes(name)) {
      const int pidfd = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
      kill(pid, SIGKILL);
      pollfd death{pidfd, POLLIN, 0};
      EXPECT_EQ(poll(&death, 1, 10000), 1);
      close(pidfd);
    }
  }

  test_support::Sandbox sandbox;
  std::unique_ptr<tracing::Tracer> tracer = tracing::make_lttng_tracer();
};

}  // namespace trace_test
