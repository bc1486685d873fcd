// SPDX-License-Identifier: Apache-2.0
// Another reading of the launch file of a launch that runs: what the file would ask for if it had been read so from the
// beginning of the launch until now.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

// The handlers that have handled all that they will, by their keys: those for one event, after it.
class HandledOnce {
 public:
  void note(const EventHandler& handler);
  // Whether this one has, of all with the same key in one reading.
  bool take(const EventHandler& handler);
  // Another reading begins.
  void begin() { taken_ = handled_; }

 private:
  std::map<std::string, std::size_t> handled_;
  std::map<std::string, std::size_t> taken_;
};

class FileReading {
 public:
  // Loads the launch file. Throws LaunchError.
  using Load = std::function<std::shared_ptr<const LaunchDescription>()>;

  // Reads and visits the file, in a state of the context as at the beginning. A timer that is due after `elapsed` is
  // visited at once, and so is a handler for what has been ready before; of both only processes, components, timers and
  // handlers count, because the rest has been done. Throws LaunchError; the context is as it was then.
  FileReading(LaunchContext& context, const Load& load, Duration elapsed, HandledOnce& handled);
  // Puts the context back, unless keep() was called.
  ~FileReading();
  FileReading(const FileReading&) = delete;
  FileReading& operator=(const FileReading&) = delete;

  // What the file asks for. There are no commands, and no handlers that have handled all.
  Requests& requests() { return requests_; }
  // From now on, handlers and timers are visited with what this reading has set. Its warnings are told.
  void keep();

 private:
  struct Message {
    LogLevel level;
    std::string logger;
    std::string text;
  };

  void visit(const FileReading::Load& load, Duration elapsed, HandledOnce& handled);
  void add(Requests requests);

  LaunchContext& context_;
  LaunchContext::State before_;
  std::vector<Message> messages_;
  std::shared_ptr<const LaunchDescription> description_;
  Requests requests_;
  bool kept_ = false;
};

// Throws LaunchError for names that no process of the requests has.
void check_names(const Requests& requests);

}  // namespace launch
