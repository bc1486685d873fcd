// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/live/live_screen.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "tracing/model/findings/quantity_text.hpp"

namespace tracing {

namespace {

constexpr const char* kClear = "\033[H\033[2J";  // the cursor to the first line; nothing on the screen

sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

}  // namespace

LiveScreen::LiveScreen(const LiveOptions& options) : options_(options) {
  const sigset_t signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals, &previous_mask_);
}

LiveScreen::~LiveScreen() {
  pthread_sigmask(SIG_SETMASK, &previous_mask_, nullptr);
}

void LiveScreen::print(const std::string& text, bool to_errors) const {
  std::FILE* const out = to_errors ? stderr : stdout;
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), out) == text.size() && std::fflush(out) == 0) {
    return;
  }
  throw std::runtime_error(fmt::format("cannot write the output: {}", std::strerror(errno)));
}

void LiveScreen::show(const std::string& title, const std::string& screen, const std::string& line) {
  const std::chrono::nanoseconds now = std::chrono::system_clock::now().time_since_epoch();
  if (draws()) {
    print(fmt::format("{}{}  {}\n", kClear, title, format_time(now.count())) + screen +
              "\nCtrl-C ends this view and prints the report.\n",
          false);
  } else {
    print(format_time(now.count()) + "  " + line + "\n", options_.json);
  }
}

void LiveScreen::note(const std::string& text) {
  print("launch report: " + text + "\n", true);
}

void LiveScreen::finish(const Report& report) {
  if (options_.json) {
    return print(json_report(report), false);
  }
  print((draws() ? kClear : "") + text_report(report, options_.text), false);
}

bool LiveScreen::is_over_after(std::chrono::nanoseconds time) {
  if (is_over_) {
    return true;
  }
  constexpr std::int64_t kSecond = 1'000'000'000;
  const timespec wait{static_cast<time_t>(time.count() / kSecond), static_cast<long>(time.count() % kSecond)};
  const sigset_t signals = ending_signals();
  is_over_ = sigtimedwait(&signals, nullptr, &wait) > 0;
  return is_over_;
}

}  // namespace tracing
