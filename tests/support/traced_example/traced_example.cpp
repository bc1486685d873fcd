// SPDX-License-Identifier: Apache-2.0
#include "tests/support/traced_example/traced_example.hpp"

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tracing/model/timeline/timeline_recorder.hpp"

namespace tracing::testing {

TracedSystem traced_example(std::uint64_t cycles, ExampleEvents events) {
  const TemporaryDirectory directory;
  write_example_system(directory.path() / "trace", cycles, events);
  timeline::TimelineRecorder recorder;
  TraceAnalysis analysis(&recorder);
  recorder.record_details(analysis);
  TraceReader reader(directory.path());
  reader.read(analysis);
  TracedSystem system;
  system.directory = "/traces/example";
  system.results = analysis.finish();
  system.timeline = recorder.finish(analysis, system.results.overview);
  return system;
}

}  // namespace tracing::testing
