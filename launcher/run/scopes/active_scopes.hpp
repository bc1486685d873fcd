// SPDX-License-Identifier: Apache-2.0
// The scopes of a launch, such as trace sessions: they begin one at a time and end in reverse order.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/visit/run_scope.hpp"

namespace launch {

class Guardian;

class ActiveScopes {
 public:
  // Called in a later turn of the loop, with the error if there was one.
  using Begun = std::function<void(const std::optional<LaunchError>& error)>;

  // `timing` receives the steps of every scope. Both references must outlive this object.
  ActiveScopes(EventLoop& loop, RunScope::Tell tell, std::vector<TimedStep>& timing);

  // Makes the guardian run the scopes' clean-up commands when the launcher is killed. It must outlive this object.
  void use_guardian(Guardian& guardian) { guardian_ = &guardian; }

  // For the snapshots of every scope (run_scope.hpp).
  void observe_snapshots(RunScope::SnapshotObserver observer) { snapshot_observer_ = std::move(observer); }

  // Begins one scope, for the processes that will start after it. The next one may begin when `done` is called. A scope
  // that can't begin is forgotten.
  void begin(std::unique_ptr<RunScope> scope, const std::vector<ProcessSpec>& processes, Begun done);
  // Ends all scopes, the last one first. `failed` gets the error of a scope that ends with one; the others end all the
  // same. `done` follows at once when no scope is active.
  void end(std::function<void(const LaunchError&)> failed, std::function<void()> done);
  // What is beginning or ending now: "trace (system.launch.xml:2:3)"; empty: nothing.
  std::string busy_with() const;
  // The user is in a hurry: ends finish at once, with the data that is there.
  void hurry();

  // Changes the spec of a process that is about to start.
  void prepare(ProcessSpec& spec) const;
  void record(const LaunchRecord& record);
  // Whether the trace of some scope should hold the steps of the launcher.
  bool want_records() const;

 private:
  void on_begun(const std::exception_ptr& error, const Begun& done);
  void end_last();
  void on_ended(const std::exception_ptr& error);
  void keep_timing(const RunScope& scope);
  void guard(RunScope& scope);
  void release(const RunScope& scope);

  EventLoop& loop_;
  RunScope::Tell tell_;
  std::vector<TimedStep>& timing_;
  Guardian* guardian_ = nullptr;
  std::map<const RunScope*, std::int32_t> clean_ups_;  // their numbers at the guardian
  std::unique_ptr<RunScope> beginning_;
  std::vector<std::unique_ptr<RunScope>> active_;
  bool hurried_ = false;
  RunScope::SnapshotObserver snapshot_observer_;
  std::function<void(const LaunchError&)> failed_;  // of end()
  std::function<void()> done_;
};

}  // namespace launch
