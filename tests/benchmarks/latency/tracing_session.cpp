// SPDX-License-Identifier: Apache-2.0
#include "tracing_session.hpp"

#include <sched.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "latency_run.hpp"

namespace latency {
namespace {

namespace fs = std::filesystem;

void enter_mount_namespace() {
  if (unshare(CLONE_NEWNS) != 0 || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount("tmpfs", "/run", "tmpfs", 0, "mode=1777") != 0 ||
      mount("tmpfs", "/dev/shm", "tmpfs", 0, "mode=1777") != 0) {
    fail("no mount namespace of its own");
  }
}

}  // namespace

TracingSession::TracingSession() {
  std::string directory = (fs::temp_directory_path() / "bench_latency-XXXXXX").string();
  if (mkdtemp(directory.data()) == nullptr) {
    fail("cannot create " + directory);
  }
  directory_ = directory;
  setenv("LTTNG_HOME", directory.c_str(), 1);
  if (geteuid() == 0) {
    enter_mount_namespace();
  }
  run("lttng-sessiond --daemonize --pidfile=" + directory + "/pid");
  run("lttng create latency --output=" + directory + "/trace");
  run("lttng enable-channel -u ros2 --num-subbuf=8 --subbuf-size=1M");
  run("lttng add-context -u -c ros2 -t vpid -t vtid -t procname");
  run("lttng enable-event -u -c ros2 'ros2:*'");
}

TracingSession::~TracingSession() {
  run("lttng destroy --no-wait latency");
  pid_t daemon = 0;
  if (std::ifstream(directory_ / "pid") >> daemon) {
    kill(daemon, SIGTERM);
  }
  std::error_code ignored;
  fs::remove_all(directory_, ignored);
}

void TracingSession::start() {
  run("lttng start latency");
}

void TracingSession::stop() {
  run("lttng stop --no-wait latency");
}

void TracingSession::run(const std::string& command) {
  if (std::system((command + " >/dev/null").c_str()) != 0) {
    fail("failed: " + command);
  }
}

}  // namespace latency
