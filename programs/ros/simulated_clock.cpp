// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/simulated_clock.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace launch {

namespace {

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

}  // namespace

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

}  // namespace launch
