// SPDX-License-Identifier: Apache-2.0
// What every test expects without saying it: each process starts, none fails by itself, none crashes, none is left.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "launcher/process/process_event.hpp"
#include "launcher/testing/failure.hpp"
#include "launcher/testing/output_tail.hpp"

namespace launch {

class ImpliedCheck {
 public:
  // `failed` is called at the first failure of each process. The tail must outlive this object.
  ImpliedCheck(const OutputTail& tail, std::function<void(Failure)> failed) : tail_(tail), failed_(std::move(failed)) {}

  // An <exit> speaks of the process of this name: its exit is judged there.
  void leave_out(const std::string& name) { left_out_.push_back(name); }

  // A fault sends a signal to the process: it may end by it, or with 0 if the signal asks to end.
  // To be called before the signal is sent.
  void expect_end(const std::string& label, int signal) { killed_[label] = {signal}; }

  void on_process(const ProcessEvent& event);

 private:
  // The last signal that a fault has sent to a process.
  struct Killed {
    int signal = 0;
    int sent = 0;  // signals since then, with that one: others are those of the shutdown, or of the launch file
  };
  // Whether the process of the event has ended as such a signal lets it end; takes note of the end. kNone: the signal
  // is not the reason.
  enum class Kill { kNone, kExpected, kOther };
  Kill take_kill(const ProcessEvent& event, int code);
  bool is_left_out(const ProcessEvent& event) const;
  void fail(const ProcessEvent& event, std::string message, std::string help = {});

  const OutputTail& tail_;
  std::function<void(Failure)> failed_;
  std::vector<std::string> left_out_;
  std::map<std::string, Killed> killed_;  // by label
};

}  // namespace launch
