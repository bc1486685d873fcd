// SPDX-License-Identifier: Apache-2.0
// Where the events of a trace go.
#pragma once

#include "tracing/reader/event.hpp"

namespace tracing {

// Receives what a trace holds. An exception thrown here ends the reading and comes out of TraceReader::read.
class TraceSink {
 public:
  virtual ~TraceSink() = default;
  virtual void on_event(const Event& event) = 0;
  virtual void on_loss(const Loss& loss) = 0;
};

}  // namespace tracing
