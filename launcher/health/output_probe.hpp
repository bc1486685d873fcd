// SPDX-License-Identifier: Apache-2.0
// Whether a process prints a line at least once in a time.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>

#include "launcher/health/health_probe.hpp"
#include "launcher/health/processor_wait.hpp"
#include "launcher/language/output_pattern.hpp"

namespace launch {

class OutputProbe final : public HealthProbe {
 public:
  OutputProbe(OutputPattern pattern, Duration timeout, ProcessorWait wait = ProcessorWait())
      : pattern_(std::move(pattern)), timeout_(timeout), wait_(std::move(wait)) {}

  void begin(pid_t pid) override {
    pid_ = pid;
    has_printed_ = has_line_ = false;
    age_ = Duration{0};
    silent_since_.reset();
    wait_.forget();
  }

  void on_line(OutputStream stream, std::string_view line) override {
    has_line_ = has_line_ || pattern_.matches(stream, line);
  }

  Look look(Duration now, Duration passed) override {
    if (std::exchange(has_line_, false)) {
      // The silence began after the last look, nobody knows when: it is counted from now on.
      has_printed_ = true;
      age_ = Duration{0};
      silent_since_ = now;
      wait_.forget();
      return {Look::Result::kGood};
    }
    silent_since_ = silent_since_.value_or(now - passed);
    // In the first quarter, which is all that most silences last, it is not worth a look into /proc.
    const bool is_long = age_ >= timeout_ / 4;
    age_ += is_long ? passed - wait_.of_process(pid_, passed) : passed;
    if (age_ < timeout_) {
      return {has_printed_ ? Look::Result::kGood : Look::Result::kPending};
    }
    return {Look::Result::kBad, fmt::format("it has not printed {} for {:.1f} s", pattern_.describe(),
                                            std::chrono::duration<double>(now - *silent_since_).count())};
  }

 private:
  OutputPattern pattern_;
  Duration timeout_;
  ProcessorWait wait_;
  pid_t pid_ = -1;
  bool has_printed_ = false;              // in this run
  bool has_line_ = false;                 // since the last look
  Duration age_{0};                       // of the silence, as far as it counts
  std::optional<Duration> silent_since_;  // on the clock of the loop
};

}  // namespace launch
