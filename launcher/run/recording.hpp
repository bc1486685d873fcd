// SPDX-License-Identifier: Apache-2.0
// What the launch tells its recorder, for a trace of the run, and the scopes that want to know.
#pragma once

#include <cstdint>

#include "launcher/process/process_event.hpp"
#include "launcher/run/active_scopes.hpp"
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
  // A traversal that began at that time, and what it noted.
  void record_visit(std::int64_t begin, const SourceRange& where, const Requests& requests);

  // The scopes of a round have begun, and no process of it has started: from the first scope that wants records on the
  // recorder gives them away.
  void begin();
  // Before the scopes end.
  void end();

 private:
  ActiveScopes& scopes_;
  LaunchRecorder* recorder_ = nullptr;
  bool begun_ = false;
};

}  // namespace launch
