// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/end/hurry.hpp"

#include <fmt/format.h>

#include <chrono>
#include <vector>

#include "base/text/names.hpp"

namespace launch {

void Hurry::on_signal(const std::string& signal, bool in_farewell) {
  const auto say = [&](const std::string& text) {
    tell_(LogLevel::kWarning, fmt::format("user interrupted with {} again, {}", signal, text));
  };
  if (in_farewell) {
    say("ending the actions of on_shutdown");
    farewell_.end();
  } else if (const std::vector<std::string> left = supervisor_.alive(); left.empty()) {
    say("ending at once");
    end_scopes_at_once();
  } else if (!std::exchange(terminated_, true)) {
    const Duration until_kill = supervisor_.terminate_all();
    say(fmt::format("sent SIGTERM to {}; SIGKILL follows in {:g} s, or with a third signal", list_some(left),
                    std::chrono::duration<double>(until_kill).count()));
  } else {
    say("killing " + list_some(left));
    supervisor_.kill_all();
    end_scopes_at_once();
  }
}

void Hurry::end_scopes_at_once() {
  scopes_.hurry();
  crashes_.hurry();
  watch();
}

// Gives up later if something that is to begin or end does not.
void Hurry::watch() {
  if (!give_up_ || timer_) {
    return;
  }
  timer_ = loop_.after(kPatience, [this] {
    timer_.reset();
    if (const std::string scope = scopes_.busy_with(); !scope.empty() && supervisor_.alive().empty()) {
      tell_(LogLevel::kError, fmt::format("{} does not answer: giving up, launch-guardian cleans up", scope));
      give_up_();
    } else {
      watch();
    }
  });
}

}  // namespace launch
