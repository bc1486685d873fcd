// SPDX-License-Identifier: Apache-2.0
// Something that must begin before every process of a launch and end after the last process, like a trace session.
#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/language/setting.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/visit/launch_record.hpp"

namespace launch {

// A node that the scope takes for a part of the launch, for checks.
struct NamedNode {
  std::string name;  // fully qualified; may be a pattern of the shell
  std::string what;  // names it: "chain 'brake'"
  SourceRange where;
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
  // Tells something to the user.
  using Tell = std::function<void(bool warning, const std::string& text)>;

  virtual ~RunScope() = default;

  // The processes that will start once the scope has begun. Called before begin(), once.
  virtual void expect(const std::vector<ProcessSpec>&) {}

  // Neither blocks the loop. end() is called once, and only after begin() succeeded. It must release what begin() took,
  // even if it then reports an error.
  virtual void begin(EventLoop& loop, Tell tell, Completion done) = 0;
  virtual void end(EventLoop& loop, Tell tell, Completion done) = 0;
  // The user is in a hurry: an end() under way must finish at once, with the data that is there.
  virtual void hurry() = 0;

  // The program and its arguments that release what begin() takes when the launcher is killed before end(). It runs
  // after the last process has gone. Empty: nothing would be left. Called once, before begin(), and not when nothing
  // will run.
  virtual std::vector<std::string> clean_up_command() { return {}; }

  // Changes the spec of every process that starts while the scope is active, such as its LD_PRELOAD.
  virtual void prepare(ProcessSpec& spec) const = 0;

  // The steps of the launcher from begin() to end(), on the loop's thread. wants_records() is true when the recorder of
  // the launch should get them, too, so that the scope's trace holds them.
  virtual bool wants_records() const { return false; }
  virtual void record(const LaunchRecord&) {}

  // The observer is called on the loop's thread, before end() is completed, when the scope has written down what
  // happened before something went wrong. A reason that is the end of a process begins with the label of the process.
  // `late` names the events by which processes have told that they missed a deadline, if that is a reason.
  using SnapshotObserver = std::function<void(const std::vector<std::string>& reasons, const std::string& directory,
                                              const std::vector<std::string>& late)>;
  virtual void observe_snapshots(SnapshotObserver) {}

  // "trace", and its evaluated settings.
  virtual std::string kind() const = 0;
  virtual std::vector<ShownSetting> describe() const = 0;
  virtual std::vector<NamedNode> named_nodes() const { return {}; }
  virtual std::vector<TimedStep> timing() const = 0;  // of begin(); when that is done, of end()
  virtual const SourceRange& origin() const = 0;
};

}  // namespace launch
