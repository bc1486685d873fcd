// SPDX-License-Identifier: Apache-2.0
// Watches one expectation of a test while the system runs.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/process/process_event.hpp"
#include "launcher/testing/failure.hpp"
#include "launcher/testing/output_tail.hpp"
#include "launcher/visit/test_request.hpp"

namespace launch {

// Why the run of a test is over.
enum class RunEnd {
  kNothingLeft,  // the system has ended by itself, or by an action of its launch file
  kMet,          // everything that was waited for has happened
  kTimeout,
  kFailure  // another expectation has failed: what is still open is not judged
};

// "when the system had ended", "within 60 s".
std::string describe(RunEnd end, Duration timeout);

class Check {
 public:
  explicit Check(Expectation expectation) : expectation_(std::move(expectation)) {}
  virtual ~Check() = default;
  Check(const Check&) = delete;
  Check& operator=(const Check&) = delete;

  // Begins to watch. `changed` is called when the check is decided. The arguments must outlive the check.
  void begin(EventLoop& loop, const OutputTail& tail, std::function<void()> changed);

  virtual void on_process(const ProcessEvent&) {}
  virtual void on_line(const ProcessSpec&, const std::string& /*label*/, OutputStream, std::string_view) {}
  // The shutdown begins. Processes end from now on because they are told to.
  void on_shutdown() { in_shutdown_ = true; }
  // All processes have ended. `when` is describe(end) of the run.
  void finish(RunEnd end, const std::string& when);

  // Whether the test goes on until this is met.
  virtual bool is_waited_for() const { return true; }
  // Whether that was so at the begin.
  bool was_waited_for() const { return was_waited_for_; }

  bool is_met() const { return state_ == State::kMet; }
  bool is_open() const { return state_ == State::kOpen; }
  // Null if it has not failed.
  const Failure* failure() const { return failure_ ? &*failure_ : nullptr; }
  const Expectation& expectation() const { return expectation_; }

 protected:
  virtual void on_begin(EventLoop&) {}
  // The time of `within` is over, or the run is, as `when` says: the failure of what is still open; nullopt if it is
  // met now.
  virtual std::optional<Failure> verdict(const std::string& when) = 0;

  // Whether the expectation speaks of this process.
  bool concerns(const ProcessSpec& spec, const std::string& label) const;
  void meet();
  void fail(Failure failure);
  // is_waited_for() has changed.
  void reconsider() { changed_(); }
  const OutputTail& tail() const { return *tail_; }
  bool in_shutdown() const { return in_shutdown_; }
  std::vector<std::string> labels_;  // of the processes that it concerns, so far

 private:
  enum class State { kOpen, kMet, kFailed };

  Expectation expectation_;
  const OutputTail* tail_ = nullptr;
  std::function<void()> changed_;
  EventLoop::SourcePtr limit_;
  State state_ = State::kOpen;
  bool in_shutdown_ = false;
  bool was_waited_for_ = false;
  std::optional<Failure> failure_;
};

// The check of an expectation; null for one that is judged by the trace (trace_check.hpp).
std::unique_ptr<Check> make_check(const Expectation& expectation);
std::unique_ptr<Check> make_exit_check(const Expectation& expectation);
std::unique_ptr<Check> make_output_check(const Expectation& expectation);
std::unique_ptr<Check> make_sequence_check(const Expectation& expectation);
std::unique_ptr<Check> make_graph_check(const Expectation& expectation);
std::unique_ptr<Check> make_message_check(const Expectation& expectation);
std::unique_ptr<Check> make_resource_check(const Expectation& expectation);

// "'talker'", "any process".
std::string subject_of(const Expectation& expectation);
// "code 3", "signal SIGSEGV".
std::string exit_text(int code);

}  // namespace launch
