// SPDX-License-Identifier: Apache-2.0
// The receiver of the events of a trace.
#pragma once

#include "tracing/decode/reader/event.hpp"

namespace tracing {

// A sink throws it when it needs no more. TraceReader::read then returns as if the trace ended here. It still reports
// the damage that it has found so far.
struct EndOfReading {};

// Receives the events and losses of a trace. Any other exception thrown here ends the reading and leaves
// TraceReader::read.
class TraceSink {
 public:
  virtual ~TraceSink() = default;
  virtual void on_event(const Event& event) = 0;
  virtual void on_loss(const Loss& loss) = 0;
};

}  // namespace tracing
