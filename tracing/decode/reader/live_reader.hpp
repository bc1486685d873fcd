// SPDX-License-Identifier: Apache-2.0
// Reads a live session of LTTng from its relay daemon, while the session runs.
//
// The relay daemon hands a viewer what is recorded after the viewer has attached: all of the streams that begin later,
// and the new packets of the others. It has one viewer for a session.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "tracing/decode/reader/event.hpp"

namespace tracing {

// Where a live session is: net://RELAY[:PORT]/host/HOST/SESSION
struct LiveAddress {
  std::string relay = "localhost";  // with ":PORT" if it is not the usual one
  std::string host;                 // the machine that is traced
  std::string session;

  std::string url() const { return "net://" + relay + "/host/" + host + "/" + session; }
};

// A URL, or the name of a session of this machine with a relay daemon of this machine. Throws TraceReadError.
LiveAddress live_address(const std::string& text);

// What a relay daemon says of a session.
enum class RelayState { kNoDaemon, kNoSession, kSession };
RelayState ask_relay_daemon(const LiveAddress& address);

class LiveReader {
 public:
  explicit LiveReader(LiveAddress address);
  ~LiveReader();
  LiveReader(const LiveReader&) = delete;
  LiveReader& operator=(const LiveReader&) = delete;

  // To be called before anything else, until it returns true: false when the relay daemon does not have the session
  // yet, or when the session cannot be read yet. Throws TraceReadError when there is no relay daemon, when another
  // viewer has the session, or when the session could not be read for 10 s.
  bool attach();
  // How often the session had streams already when this reader attached: what they held so far is not read. next()
  // may attach anew, as long as it has given no item.
  std::size_t late_attachments() const;

  enum class State {
    kItem,
    kNothingYet,  // ask again later
    kEnd,         // the session is destroyed, and all of it was read
  };
  // The next item in the order of time; it is valid until the next call. Throws TraceReadError, also when the relay
  // daemon has died.
  State next(TraceItem& item);
  // Everything up to this time of the trace was given, in nanoseconds since the epoch: the relay daemon also tells when
  // nothing has happened. Nullopt as long as nothing was recorded at all.
  std::optional<std::int64_t> told_until_ns() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tracing
