// SPDX-License-Identifier: Apache-2.0
// Supervisor, real loop and real processes together.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "launcher/process/process_supervisor.hpp"
#include "memory_screen.hpp"
#include "temporary_directory.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

class RealSupervisor : public testing::Test {
 protected:
  static ProcessSpec script(const std::string& text) {
    ProcessSpec spec;
    spec.name = "script";
    spec.argv = {"/bin/sh", "-c", text};
    spec.environment = {{"PATH", "/usr/bin:/bin"}};
    spec.output = *OutputRouting::from_mode("screen");
    return spec;
  }

  // Runs until no process is active.
  void run() {
    supervisor->observe([this](const ProcessEvent& event) {
      if (const auto* exited = std::get_if<ProcessExited>(&event.what)) {
        codes.push_back(exited->exit.code);
      }
      if (std::holds_alternative<ProcessDone>(event.what) && supervisor->active() == 0) {
        loop->quit();
      }
    });
    if (supervisor->active() > 0) {
      loop->run();
    }
  }
  // Calls back when a script has run signal_ready().
  void when_ready(std::function<void()> callback) {
    ready = loop->on_readable(ready_fifo.get(), [this, callback = std::move(callback)] {
      ready.reset();
      callback();
    });
  }
  std::string signal_ready() const { return "echo ready > " + directory.path() + "/ready"; }

  static UniqueFd make_fifo(const std::string& path) {
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    return UniqueFd(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  }

  TemporaryDirectory directory;
  UniqueFd ready_fifo = make_fifo(directory.path() + "/ready");
  MemoryScreen screen;
  std::unique_ptr<EventLoop> loop = make_sd_event_loop();
  std::unique_ptr<ProcessRunner> runner = make_posix_process_runner();
  OutputRouter output{{.screen_fd = screen.fd()}};
  std::unique_ptr<ProcessSupervisor> supervisor = std::make_unique<ProcessSupervisor>(*loop, *runner, output);
  EventLoop::SourcePtr ready;
  std::vector<int> codes;
};

TEST_F(RealSupervisor, ShowsOutputAndReportsTheExit) {
  supervisor->start(script("echo out; echo err >&2; printf unfinished; exit 3"));
  run();
  EXPECT_EQ(codes, (std::vector<int>{3}));
  const std::string text = screen.text();
  EXPECT_NE(text.find("[script-1] out\n"), std::string::npos) << text;
  EXPECT_NE(text.find("[script-1] err\n"), std::string::npos) << text;
  EXPECT_NE(text.find("[script-1] unfinished\n"), std::string::npos) << text;
}

TEST_F(RealSupervisor, LosesNothingOfALongOutput) {
  supervisor->start(script("seq 200000"));
  run();
  const std::string text = screen.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 200'000);
  EXPECT_TRUE(text.ends_with("[script-1] 200000\n"));
}

TEST_F(RealSupervisor, EscalatesUntilAStubbornProcessIsKilled) {
  ProcessSpec stubborn = script("trap '' INT TERM; " + signal_ready() + "; while :; do sleep 1000; done");
  stubborn.sigterm_timeout = 10ms;
  stubborn.sigkill_timeout = 10ms;
  supervisor->start(stubborn);
  when_ready([this] { supervisor->shutdown(); });
  run();
  EXPECT_EQ(codes, (std::vector<int>{-SIGKILL}));
}

TEST_F(RealSupervisor, HandlesAPseudoTerminal) {
  ProcessSpec spec = script("test -t 1 && echo terminal");
  spec.emulate_tty = true;
  supervisor->start(spec);
  run();
  EXPECT_EQ(screen.text(), "[script-1] terminal\r\n");
  EXPECT_EQ(codes, (std::vector<int>{0}));
}

TEST_F(RealSupervisor, AShellOnATerminalOfItsOwnEndsByTheEndOfTheTerminal) {
  ProcessSpec shell = script("trap '' INT TERM; " + signal_ready() + "; while :; do sleep 1000; done");
  shell.tty = true;
  shell.sigterm_timeout = 10ms;
  supervisor->start(shell);
  when_ready([this] { supervisor->shutdown(); });
  run();
  EXPECT_EQ(codes, (std::vector<int>{-SIGHUP}));
}

TEST_F(RealSupervisor, EndsDescendantsThatOutliveAnInterruptedProcess) {
  // A background job of a shell ignores SIGINT.
  ProcessSpec spec = script("sleep 1000 & trap 'exit 5' INT; " + signal_ready() + "; wait");
  spec.sigterm_timeout = 100ms;  // they have the whole time
  supervisor->start(spec);
  when_ready([this] { supervisor->shutdown(); });
  run();
  EXPECT_EQ(codes, (std::vector<int>{5}));
}

TEST_F(RealSupervisor, AFloodOfOutputDelaysNeitherTimersNorExitsNorPosts) {
  ProcessSpec flood = script("exec yes");
  flood.output = {};
  supervisor->start(flood);
  supervisor->start(script("exit 0"));
  bool posted = false;
  EventLoop::SourcePtr timer;
  supervisor->observe([&](const ProcessEvent& event) {
    if (event.id == 2 && std::holds_alternative<ProcessExited>(event.what)) {
      loop->post([&] {
        posted = true;
        timer = loop->after(1ms, [this] { supervisor->shutdown(); });
      });
    }
  });
  run();
  EXPECT_TRUE(posted);
  EXPECT_EQ(codes.size(), 2U);
}

TEST_F(RealSupervisor, SurvivesTwoHundredProcessesAtOnce) {
  for (int i = 0; i < 200; ++i) {
    supervisor->start(script("exec sleep 1000"));
  }
  EXPECT_EQ(supervisor->active(), 200U);
  supervisor->shutdown();
  run();
  EXPECT_EQ(codes, std::vector<int>(200, -SIGINT));
}

TEST_F(RealSupervisor, LeavesNoProcessAndNoDescriptorBehind) {
  const auto descriptors = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
  };
  const auto before = descriptors();
  pid_t pid = 0;
  supervisor->observe([&](const ProcessEvent& event) {
    if (const auto* started = std::get_if<ProcessStarted>(&event.what)) {
      pid = started->pid;
    }
  });
  supervisor->start(script("trap '' INT TERM; sleep 1000 & wait"));
  EXPECT_EQ(::kill(-pid, 0), 0);
  supervisor.reset();
  EXPECT_EQ(::kill(pid, 0), -1);
  EXPECT_EQ(descriptors(), before);
}

}  // namespace
}  // namespace launch
