// SPDX-License-Identifier: Apache-2.0
// Passes the steps of the launch to its recorder, for a trace of the run, and to the scopes that want records.
#pragma once

#include <cstdint>
#include <string>

#include "launcher/process/process_event.hpp"
#include "launcher/run/handlers/condition_handlers.hpp"
#include "launcher/run/scopes/active_scopes.hpp"
#include "launcher/visit/launch_record.hpp"
#include "launcher/visit/requests.hpp"

namespace launch {

class Recording {
 public:
  // The scopes must outlive this object.
  explicit Recording(ActiveScopes& scopes) : scopes_(scopes) {}

  // The recorder must outlive this object.
  void use_recorder(LaunchRecorder& recorder) { recorder_ = &recorder; }

  void record(const LaunchRecord& record);
  void record(const ProcessEvent& event);
  void record(const ConditionEvent& event);
  // The condition that a process waits for holds.
  void record_ready(const std::string& process, const Dependency& dependency);
  // Records a traversal that began at that time, and the records that it noted.
  void record_visit(std::int64_t begin, const SourceRange& where, const Requests& requests);

  // To be called when the scopes of a round have begun and no process of it has started. When a scope wants records,
  // the recorder passes them on from then on.
  void begin();
  // To be called before the scopes end.
  void end();

 private:
  ActiveScopes& scopes_;
  LaunchRecorder* recorder_ = nullptr;
  bool begun_ = false;
};

}  // namespace launch
