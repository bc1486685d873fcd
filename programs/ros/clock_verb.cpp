// SPDX-License-Identifier: Apache-2.0
// launch clock
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <rosgraph_msgs/msg/clock.hpp>
#include <string>
#include <string_view>

#include "programs/ros/graph_session.hpp"
#include "programs/ros/verb.hpp"

namespace launch {

namespace {

// Time that runs at a rate of its own, stands still and jumps, as faults of the clock want it.
class SimulatedClock {
 public:
  using Real = std::chrono::steady_clock::time_point;
  using Seconds = std::chrono::duration<double>;

  SimulatedClock(Real now, double start, double rate) : since_(now), then_(start), rate_(rate) {}

  // Never negative.
  Seconds time(Real now) const;

  // "stop" and "go", which may be nested; "scale FACTOR" of the rate; "jump SECONDS". False for anything else.
  bool obey(std::string_view command, Real now);

 private:
  void hold(Real now);

  Real since_;
  Seconds then_;  // at since_
  double rate_;
  int stops_ = 0;
};

std::optional<double> number_behind(std::string_view word, std::string_view command) {
  if (!command.starts_with(word)) {
    return std::nullopt;
  }
  command.remove_prefix(word.size());
  double value = 0;
  const auto [end, error] = std::from_chars(command.data(), command.data() + command.size(), value);
  return error == std::errc() && end == command.data() + command.size() && std::isfinite(value) ? std::optional(value)
                                                                                                : std::nullopt;
}

SimulatedClock::Seconds SimulatedClock::time(Real now) const {
  const Seconds time = stops_ > 0 ? then_ : then_ + Seconds(now - since_) * rate_;
  return std::max(time, Seconds(0));
}

void SimulatedClock::hold(Real now) {
  then_ = time(now);
  since_ = now;
}

bool SimulatedClock::obey(std::string_view command, Real now) {
  hold(now);
  if (command == "stop") {
    ++stops_;
  } else if (command == "go") {
    stops_ = std::max(stops_ - 1, 0);
  } else if (const std::optional<double> factor = number_behind("scale ", command); factor && *factor > 0) {
    rate_ *= *factor;
  } else if (const std::optional<double> seconds = number_behind("jump ", command)) {
    then_ = std::max(then_ + Seconds(*seconds), Seconds(0));
  } else {
    return false;
  }
  return true;
}

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
