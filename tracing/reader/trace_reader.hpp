// SPDX-License-Identifier: Apache-2.0
// Reads the CTF traces below a directory and gives their events in the order of time.
//
// Several traces below the directory (userspace and kernel, the two halves of a dual session, several snapshots) are
// merged into one sequence. A decoder of our own reads what LTTng writes; libbabeltrace2 reads everything else.
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "tracing/reader/event.hpp"

namespace tracing {

// A trace could not be read. what() is one line that names the directory; remedy() says what to do, may be empty;
// details() are the library's own messages, innermost last, for bug reports.
class TraceReadError : public std::runtime_error {
 public:
  TraceReadError(const std::string& what, std::string remedy, std::string details = {})
      : std::runtime_error(what), remedy_(std::move(remedy)), details_(std::move(details)) {}
  const std::string& remedy() const { return remedy_; }
  const std::string& details() const { return details_; }

 private:
  std::string remedy_;
  std::string details_;
};

// Receives what a trace holds. An exception thrown here ends the reading and comes out of TraceReader::read.
class TraceSink {
 public:
  virtual ~TraceSink() = default;
  virtual void on_event(const Event& event) = 0;
  virtual void on_loss(const Loss& loss) = 0;
};

class TraceReader {
 public:
  enum class Decoder {
    kAny,         // our own, or libbabeltrace2 where our own does not know something of the trace
    kDirect,      // our own; TraceReadError where it does not know something
    kBabeltrace,  // libbabeltrace2
  };

  // Finds the traces. Throws TraceReadError when there is none.
  explicit TraceReader(const std::filesystem::path& directory, Decoder decoder = Decoder::kAny);
  ~TraceReader();
  TraceReader(const TraceReader&) = delete;
  TraceReader& operator=(const TraceReader&) = delete;

  // Reads everything; to be called once. Throws TraceReadError on damaged data, after all events before the damage
  // have been given to the sink, with our own decoder also those of other packets and streams.
  void read(TraceSink& sink);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tracing
