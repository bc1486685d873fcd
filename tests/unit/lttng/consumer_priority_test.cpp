// SPDX-License-Identifier: Apache-2.0
// The priority of LTTng's consumers, tested on a process that only has their name.
#include "tracing/record/lttng/consumer_priority.hpp"

#include <gtest/gtest.h>
#include <linux/capability.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>

#include "tests/support/emulated.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using tracing::kConsumerNice;
using tracing::prefer_daemons;

// A child of this process whose program is called lttng-consumerd.
class Consumer {
 public:
  explicit Consumer(const std::filesystem::path& directory) {
    const std::filesystem::path program = directory / "lttng-consumerd";
    std::filesystem::copy_file("/bin/sleep", program);
    std::string path = program.string();
    std::string seconds = "1000";
    char* const argv[] = {path.data(), seconds.data(), nullptr};
    EXPECT_EQ(posix_spawn(&pid_, path.c_str(), nullptr, nullptr, argv, environ), 0);
  }
  ~Consumer() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

  int nice() const { return getpriority(PRIO_PROCESS, static_cast<id_t>(pid_)); }

 private:
  pid_t pid_ = -1;
};

// Whether this thread may raise priorities.
void set_may_raise_priorities(bool may) {
  __user_cap_header_struct header = {.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
  __user_cap_data_struct data[2] = {};
  ASSERT_EQ(syscall(SYS_capget, &header, data), 0);
  const std::uint32_t bit = 1u << CAP_SYS_NICE;
  data[0].effective = may ? data[0].effective | bit : data[0].effective & ~bit;
  ASSERT_EQ(syscall(SYS_capset, &header, data), 0);
}

TEST(ConsumerPriority, IsRaisedWhereThatIsPermitted) {
  NEEDS_WHAT_QEMU_LACKS("priorities of other processes are told in another form here, as by QEMU");
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because only root may raise priorities";
  }
  const test_support::Sandbox sandbox;
  const Consumer consumer(sandbox.directory());
  EXPECT_EQ(prefer_daemons(getpid()), "");
  EXPECT_EQ(consumer.nice(), kConsumerNice);
}

TEST(ConsumerPriority, ThatMayNotBeRaisedIsSaidWithWhatHelps) {
  const test_support::Sandbox sandbox;
  const Consumer consumer(sandbox.directory());
  const int before = consumer.nice();
  if (geteuid() == 0) {
    set_may_raise_priorities(false);
  }
  const std::string told = prefer_daemons(getpid());
  if (geteuid() == 0) {
    set_may_raise_priorities(true);
  }
  EXPECT_EQ(told,
            "LTTng's consumer keeps its priority (Permission denied): on a machine that is busy all the time it may "
            "come too late, and events are lost; it takes root, CAP_SYS_NICE, or `USER - nice -10` in "
            "/etc/security/limits.conf");
  EXPECT_EQ(consumer.nice(), before);
}

TEST(ConsumerPriority, OfNobodyIsNothingToSpeakOf) {
  EXPECT_EQ(prefer_daemons(getpid()), "");
}

}  // namespace
