// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/service_manager.hpp"

#include <gmock/gmock.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "launcher/process/fake/fake_event_loop.hpp"

namespace {

using launch::Environment;
using launch::ServiceAddress;
using launch::ServiceManager;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;

class ServiceManagerTest : public testing::Test {
 protected:
  ServiceManagerTest() {
    EXPECT_NE(::mkdtemp(directory_.data()), nullptr);
    path_ = directory_ + "/notify";
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path_.copy(address.sun_path, sizeof address.sun_path - 1);
    socket_.reset(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    EXPECT_EQ(::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~ServiceManagerTest() override { std::filesystem::remove_all(directory_); }

  std::vector<std::string> received() const {
    std::vector<std::string> all;
    std::array<char, 4096> buffer{};
    for (ssize_t size = 0; (size = ::recv(socket_.get(), buffer.data(), buffer.size(), 0)) > 0;) {
      all.emplace_back(buffer.data(), static_cast<std::size_t>(size));
    }
    return all;
  }

  std::string directory_ = testing::TempDir() + "service_manager_test.XXXXXX";
  std::string path_;
  launch::UniqueFd socket_;
  launch::FakeEventLoop loop_;
};

Environment environment_of(const std::map<std::string, std::string>& variables) {
  Environment environment;
  for (const auto& [name, value] : variables) {
    environment.insert_or_assign(name, value);
  }
  return environment;
}

TEST_F(ServiceManagerTest, GetsNews) {
  Environment environment = environment_of({{"NOTIFY_SOCKET", path_}, {"HOME", "/"}});
  const auto address = ServiceAddress::take(environment);
  ASSERT_TRUE(address.has_value());
  EXPECT_FALSE(environment.contains("NOTIFY_SOCKET")) << "processes must not get it";
  EXPECT_TRUE(environment.contains("HOME"));
  ServiceManager manager(*address, loop_);
  manager.status("starting 1 of 2");
  manager.ready();
  manager.stopping();
  loop_.advance(seconds(60));
  EXPECT_THAT(received(), ElementsAre("STATUS=starting 1 of 2", "READY=1", "STOPPING=1"));
}

TEST_F(ServiceManagerTest, TheWatchdogIsFedTwiceInItsTime) {
  Environment environment = environment_of(
      {{"NOTIFY_SOCKET", path_}, {"WATCHDOG_USEC", "10000000"}, {"WATCHDOG_PID", std::to_string(::getpid())}});
  ServiceManager manager(ServiceAddress::take(environment).value(), loop_);
  EXPECT_THAT(received(), ElementsAre("WATCHDOG=1"));
  loop_.advance(seconds(15));
  EXPECT_THAT(received(), ElementsAre("WATCHDOG=1", "WATCHDOG=1", "WATCHDOG=1"));
}

TEST_F(ServiceManagerTest, TheWatchdogOfAnotherProcessIsNotFed) {
  Environment environment =
      environment_of({{"NOTIFY_SOCKET", path_}, {"WATCHDOG_USEC", "10000000"}, {"WATCHDOG_PID", "1"}});
  ServiceManager manager(ServiceAddress::take(environment).value(), loop_);
  loop_.advance(seconds(15));
  EXPECT_THAT(received(), IsEmpty());
}

TEST_F(ServiceManagerTest, ThereIsNoneWithoutASocket) {
  Environment none;
  EXPECT_FALSE(ServiceAddress::take(none).has_value());
  Environment odd = environment_of({{"NOTIFY_SOCKET", "relative"}});
  EXPECT_FALSE(ServiceAddress::take(odd).has_value());
}

TEST_F(ServiceManagerTest, OneThatHasGoneDoesNoHarm) {
  Environment environment = environment_of({{"NOTIFY_SOCKET", path_ + "-gone"}});
  ServiceManager manager(ServiceAddress::take(environment).value(), loop_);
  manager.ready();
  EXPECT_THAT(received(), IsEmpty());
}

}  // namespace
