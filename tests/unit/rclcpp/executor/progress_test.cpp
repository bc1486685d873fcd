// SPDX-License-Identifier: Apache-2.0
// What executors tell a launcher of their progress.
#include <gmock/gmock.h>
#include <sys/mman.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <executor_progress/progress_page.hpp>
#include <future>
#include <memory>
#include <rclcpp/experimental/executors/events_executor/events_executor.hpp>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace std::chrono_literals;
using executor_progress::Doing;
using executor_progress::Page;
using executor_progress::Slot;

// The page of this process. It is made before main(), because a process looks for it once.
struct OwnPage {
  OwnPage() {
    const int file = ::memfd_create("progress", 0);
    EXPECT_EQ(::ftruncate(file, 2 * Page::kSize), 0);
    page = static_cast<Page*>(
        ::mmap(nullptr, Page::kSize, PROT_READ | PROT_WRITE, MAP_SHARED, file, static_cast<off_t>(Page::kSize)));
    const std::string place = "4096:/proc/self/fd/" + std::to_string(file);
    ::setenv(executor_progress::kVariable, place.c_str(), 1);
  }
  Page* page = nullptr;
};
const OwnPage own;  // NOLINT(cert-err58-cpp)

// What the threads of this process do.
std::vector<Doing> doing() {
  std::vector<Doing> found;
  for (const Slot& slot : own.page->slots) {
    if (slot.pid.load() != 0) {
      found.push_back(executor_progress::doing_of(slot.state.load()));
    }
  }
  return found;
}

class Progress : public testing::Test {
 protected:
  void SetUp() override { rclcpp::init(0, nullptr); }
  void TearDown() override { rclcpp::shutdown(); }

  // What the threads do while a timer's callback runs in a thread that spins, and then while it waits for the next one.
  template <typename Executor>
  void expect_timer_and_wait() {
    const auto node = std::make_shared<rclcpp::Node>("node");
    std::promise<std::vector<Doing>> in_callback;
    const auto timer = node->create_wall_timer(1ms, [&, told = false]() mutable {
      if (!std::exchange(told, true)) {
        in_callback.set_value(doing());
      }
    });
    Executor executor;
    executor.add_node(node);
    std::thread thread([&] { executor.spin(); });
    EXPECT_THAT(in_callback.get_future().get(), testing::Contains(Doing::kTimer));
    timer->cancel();
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    while (!testing::Value(doing(), testing::Contains(Doing::kWaiting)) &&
           std::chrono::steady_clock::now() < deadline) {
      std::this_thread::yield();
    }
    EXPECT_THAT(doing(), testing::Contains(Doing::kWaiting));
    executor.cancel();
    thread.join();
  }
};

TEST_F(Progress, OfTheSingleThreadedExecutor) {
  EXPECT_EQ(own.page->joined.load(), 1U);
  expect_timer_and_wait<rclcpp::executors::SingleThreadedExecutor>();
  EXPECT_TRUE(doing().empty()) << "the thread has given its slot back";
}

TEST_F(Progress, OfTheMultiThreadedExecutor) {
  expect_timer_and_wait<rclcpp::executors::MultiThreadedExecutor>();
}

TEST_F(Progress, OfTheEventsExecutor) {
  expect_timer_and_wait<rclcpp::experimental::executors::EventsExecutor>();
}

TEST_F(Progress, AThreadIsAwayAfterSpinSome) {
  std::thread([] {
    rclcpp::spin_some(std::make_shared<rclcpp::Node>("node"));
    EXPECT_THAT(doing(), testing::ElementsAre(Doing::kAway));
  }).join();
}

TEST_F(Progress, AThreadDoesNothingAfterItHasWaitedForAFuture) {
  std::thread([] {
    const auto node = std::make_shared<rclcpp::Node>("node");
    const auto timer = node->create_wall_timer(1ms, [&] {});
    std::promise<void> never;
    rclcpp::spin_until_future_complete(node, never.get_future(), 20ms);
    EXPECT_THAT(doing(), testing::ElementsAre(Doing::kNothing));
  }).join();
}

TEST_F(Progress, ACallbackThatSpinsGoesOn) {
  const auto node = std::make_shared<rclcpp::Node>("node");
  std::vector<Doing> after_inner_spin;
  const auto timer = node->create_wall_timer(1ms, [&] {
    rclcpp::spin_some(std::make_shared<rclcpp::Node>("inner"));
    after_inner_spin = doing();
    rclcpp::shutdown();
  });
  std::thread([&] { rclcpp::spin(node); }).join();
  EXPECT_THAT(after_inner_spin, testing::Contains(Doing::kTimer));
}

}  // namespace
