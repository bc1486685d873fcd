// SPDX-License-Identifier: Apache-2.0
// Tells each way through chains that conditions name, as it ends.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "tracing/model/messages/chain_tracker.hpp"

namespace tracing {

class WatchedChains final : public ChainTracker {
 public:
  // From the begin of the first callback to the end of the last one.
  using Tell = std::function<void(std::size_t definition, std::int64_t input_ns, std::int64_t output_ns)>;

  // The model must outlive it.
  WatchedChains(const ObjectModel& model, std::vector<ChainDefinition> definitions, Tell tell)
      : tell_(std::move(tell)) {
    define(model, std::move(definitions));
  }

 protected:
  void on_response(PathId path, std::int64_t input_ns, std::int64_t output_ns) override {
    for (const NamedPath& named : paths()[path].named) {
      tell_(named.definition, input_ns, output_ns);
    }
  }

 private:
  Tell tell_;
};

}  // namespace tracing
