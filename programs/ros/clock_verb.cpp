// SPDX-License-Identifier: Apache-2.0
// launch clock
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <rosgraph_msgs/msg/clock.hpp>
#include <string>

#include "programs/ros/graph_session.hpp"
#include "programs/ros/simulated_clock.hpp"
#include "programs/ros/verb.hpp"

namespace launch {

namespace {

// The lines of standard input, as far as they are there.
class Input {
 public:
  template <typename Use>
  void read_lines(const Use& use) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    std::array<char, 1024> bytes;
    while (is_open_ && ::poll(&input, 1, 0) > 0) {
      const ssize_t size = ::read(STDIN_FILENO, bytes.data(), bytes.size());
      is_open_ = size > 0;
      text_.append(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    }
    for (std::size_t end = 0; (end = text_.find('\n')) != std::string::npos; text_.erase(0, end + 1)) {
      use(text_.substr(0, end));
    }
  }

 private:
  bool is_open_ = true;
  std::string text_;
};

builtin_interfaces::msg::Time to_message(SimulatedClock::Seconds time) {
  builtin_interfaces::msg::Time message;
  const double whole = std::floor(time.count());
  constexpr double kNanoseconds = 1e9;
  message.sec = static_cast<std::int32_t>(whole);
  message.nanosec = static_cast<std::uint32_t>((time.count() - whole) * kNanoseconds);
  return message;
}

class Clock final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("--start", start_, "the first time, in seconds")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_option("--rate", rate_, "seconds of simulated time in a second")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--frequency", frequency_, "messages in a second")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
  }

  int run() override {
    GraphSession session;
    const auto publisher = session.node().create_publisher<rosgraph_msgs::msg::Clock>("/clock", rclcpp::ClockQoS());
    const auto period = std::chrono::duration_cast<SessionClock::duration>(Seconds(1.0 / frequency_));
    SimulatedClock clock(SessionClock::now(), start_, rate_);
    Input input;
    for (auto next = SessionClock::now(); !GraphSession::is_stopped();) {
      input.read_lines([&](const std::string& line) {
        if (!clock.obey(line, SessionClock::now())) {
          put(fmt::format("a clock knows stop, go, scale FACTOR and jump SECONDS, not '{}'\n", line));
        }
      });
      rosgraph_msgs::msg::Clock message;
      message.clock = to_message(clock.time(SessionClock::now()));
      publisher->publish(message);
      next = std::max(next + period, SessionClock::now());
      session.sleep_until(next);
    }
    return 0;
  }

 private:
  double start_ = 0;
  double rate_ = 1;
  double frequency_ = 100;
};

}  // namespace

std::vector<VerbInfo> clock_verbs() {
  return {{"clock", "", "publishes simulated time on /clock", make_verb<Clock>}};
}

}  // namespace launch
