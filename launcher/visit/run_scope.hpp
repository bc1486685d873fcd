// SPDX-License-Identifier: Apache-2.0
// Something that must begin before every process of a launch and end after the last has gone, like a trace session.
#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "launcher/base/source.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/visit/launch_record.hpp"

namespace launch {

// One evaluated setting, for --dry-run.
struct ScopeSetting {
  std::string name;
  std::variant<bool, std::int64_t, std::string, std::vector<std::string>> value;
};

// How long a step of beginning or ending took, for --timing.
struct TimedStep {
  std::string name;
  Duration took{0};
};

class RunScope {
 public:
  // Called once, on the loop's thread, later than the call that it answers. The exception is null on success.
  using Completion = std::function<void(std::exception_ptr)>;
  // What it has to tell the user.
  using Tell = std::function<void(bool warning, const std::string& text)>;

  virtual ~RunScope() = default;

  // The processes that will start once the scope has begun. Called before begin(), once.
  virtual void expect(const std::vector<ProcessSpec>&) {}

  // Neither blocks the loop. end() is called once, only after begin() succeeded, and must succeed in releasing what
  // begin() took even when it then reports an error.
  virtual void begin(EventLoop& loop, Tell tell, Completion done) = 0;
  virtual void end(EventLoop& loop, Tell tell, Completion done) = 0;
  // The user is in a hurry: an end() under way shall finish at once, with what is there.
  virtual void hurry() = 0;

  // The program and its arguments that release what begin() takes when the launcher is killed before end(). It runs
  // after the last process has gone. Empty: nothing would be left. Called before begin(), once, and not when nothing is
  // to run.
  virtual std::vector<std::string> clean_up_command() { return {}; }

  // Changes what every process that starts while the scope is active is given, such as LD_PRELOAD.
  virtual void prepare(ProcessSpec& spec) const = 0;

  // What the launcher does from begin() to end(), on the loop's thread. The first returns true when the recorder of the
  // launch shall have it, too: the scope's trace then holds it.
  virtual bool wants_records() const { return false; }
  virtual void record(const LaunchRecord&) {}

  // "trace", and what it was evaluated to.
  virtual std::string kind() const = 0;
  virtual std::vector<ScopeSetting> describe() const = 0;
  virtual std::vector<TimedStep> timing() const = 0;  // of begin(); once that is done, of end()
  virtual const SourceRange& origin() const = 0;
};

}  // namespace launch
