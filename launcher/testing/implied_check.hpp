// SPDX-License-Identifier: Apache-2.0
// What every test expects without saying it: each process starts, none fails by itself, none crashes, none is left.
#pragma once

#include <functional>
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

  void on_process(const ProcessEvent& event);

 private:
  bool is_left_out(const ProcessEvent& event) const;
  void fail(const ProcessEvent& event, std::string message, std::string help = {});

  const OutputTail& tail_;
  std::function<void(Failure)> failed_;
  std::vector<std::string> left_out_;
};

}  // namespace launch
