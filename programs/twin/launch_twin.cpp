// SPDX-License-Identifier: Apache-2.0
// `launch twin DIR`: makes a system of stand-ins from a trace, simulates it, and runs it.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/diagnostics/command_error.hpp"
#include "base/diagnostics/diagnostic.hpp"
#include "base/terminal/terminal.hpp"
#include "programs/twin/run_twin.hpp"
#include "programs/twin/twin_arguments.hpp"
#include "programs/twin/twin_table.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/twin/build_twin.hpp"
#include "tracing/model/twin/contention.hpp"
#include "tracing/model/twin/description/description_file.hpp"
#include "tracing/model/twin/launch_file.hpp"
#include "tracing/model/twin/overhead.hpp"
#include "tracing/model/twin/recording.hpp"
#include "tracing/model/twin/simulation.hpp"
#include "tracing/model/twin/what_if.hpp"

namespace {

using tracing::twin::Figures;
using tracing::twin::System;
using twin_program::Arguments;

constexpr const char* kCommand = "launch twin";

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path);
  stream << text;
  stream.close();
  if (!stream) {
    throw std::runtime_error(fmt::format("'{}' cannot be written", path.string()));
  }
}

std::size_t processors_here() {
  return static_cast<std::size_t>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
}

void write_twin(const Arguments& arguments, const System& system, bool ext_events, bool limits_cpus) {
  std::filesystem::create_directories(arguments.folder);
  tracing::twin::LaunchFileOptions options;
  options.ext_events = ext_events;
  options.cpus = limits_cpus ? system.cpus : 0;
  write_file(arguments.folder / "twin.json", tracing::twin::description_of(system));
  write_file(arguments.folder / "twin.xml", tracing::twin::launch_file_of(system, options));
}

// Runs the twin as it was for a while, and makes its stand-ins as quick as what they stand for.
void calibrate(const Arguments& arguments, const Figures& recorded, double duration_s, bool ext_events,
               System& system) {
  write_twin(arguments, system, ext_events, false);
  fmt::print(stderr, "launch twin: a first run of {:.1f} s shows how quick the stand-ins are; its trace is not kept\n",
             duration_s);
  const std::filesystem::path trace =
      twin_program::run_twin(arguments.folder, duration_s, twin_program::RunOutput::kHidden);
  add_overheads(recorded, figures_of(tracing::twin::read_recording(trace), system), system);
  std::filesystem::remove_all(trace);
}

// The error for a size that was given for a topic that the twin does not have, or "".
std::string unknown_topic_error(const Arguments& arguments, const System& system) {
  std::vector<std::string> topics;
  for (const auto& topic : system.topics) {
    topics.push_back(topic.name);
  }
  for (const auto& [name, bytes] : arguments.sizes) {
    if (std::find(topics.begin(), topics.end(), name) == topics.end()) {
      return launch::usage_error(kCommand, fmt::format("--size: the twin has no topic '{}'", name),
                                 launch::did_you_mean(name, topics));
    }
  }
  return {};
}

std::string head_of(const Arguments& arguments, const System& system) {
  const auto number = [](std::size_t count, const char* noun, const char* ending = "s") {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : ending);
  };
  std::string text = fmt::format("Twin           {}, {}, {}, {}, {}; {:.1f} s on {}\n",
                                 number(system.processes.size(), "process", "es"), number(system.nodes.size(), "node"),
                                 number(system.topics.size(), "topic"), number(system.callbacks.size(), "callback"),
                                 number(system.executors.size(), "executor"),
                                 static_cast<double>(system.duration_ns) / 1e9, number(system.cpus, "processor"));
  if (!arguments.folder.empty()) {
    text += fmt::format("Run it with    launch {}\n", (arguments.folder / "twin.xml").string());
  }
  if (system.up_ns >= 1'000'000) {
    text += fmt::format("Figures        without the first {}, until each callback had run once\n",
                        tracing::format_duration(static_cast<double>(system.up_ns)));
  }
  for (std::size_t i = 0; i < system.missing.size(); ++i) {
    text += fmt::format("{:<14} {}\n", i == 0 ? "Not as it was" : "", system.missing[i]);
  }
  return text;
}

int twin(const Arguments& arguments) {
  using namespace tracing::twin;
  const Recording recording = read_recording(arguments.directory);
  BuildOptions options;
  options.cpus = arguments.cpus > 0 ? arguments.cpus : processors_of(arguments.directory);
  if (options.cpus == 0) {
    options.cpus = processors_here();
  }
  options.seed = arguments.seed;
  options.bytes = arguments.bytes;
  options.sizes = arguments.sizes;
  System system = build_twin(recording, options);
  if (system.callbacks.empty()) {
    throw std::runtime_error(
        fmt::format("the trace in '{}' has no callbacks of nodes to make a twin of", arguments.directory.string()));
  }
  if (const std::string error = unknown_topic_error(arguments, system); !error.empty()) {
    fmt::print(stderr, "{}", error);
    return launch::kWrongCommandLine;
  }
  const auto apply_what_ifs = [&](System& changed) {
    for (const std::string& what_if : arguments.what_ifs) {
      apply_what_if(what_if, changed);
    }
  };
  System changed = system;
  apply_what_ifs(changed);
  const Figures recorded = figures_of(recording, system);
  if (arguments.run && arguments.calibration_s > 0) {
    calibrate(arguments, recorded, arguments.calibration_s, recording.has_ext_events, system);
    for (Index index = 0; index < system.callbacks.size(); ++index) {
      changed.callbacks[index].overhead_ns = system.callbacks[index].overhead_ns;
    }
  }
  if (!arguments.folder.empty()) {
    write_twin(arguments, changed, recording.has_ext_events, changed.cpus != system.cpus);
  }
  const std::int64_t duration_ns =
      arguments.duration_s > 0 ? static_cast<std::int64_t>(arguments.duration_s * 1e9) : system.active_ns;
  twin_program::Comparison comparison;
  comparison.recorded = recorded;
  comparison.left_out_ns = system.up_ns;
  System simulated = system;
  take_off_simulated_waits(simulated);
  comparison.simulated = Simulation(simulated).run(duration_ns);
  if (!arguments.what_ifs.empty()) {
    apply_what_ifs(simulated);
    comparison.changed = Simulation(simulated).run(duration_ns);
  }
  if (arguments.run) {
    if (changed.cpus != system.cpus && changed.cpus > processors_here()) {
      throw std::runtime_error(fmt::format("a run with {} processors needs a machine that has them; this one has {}",
                                           changed.cpus, processors_here()));
    }
    comparison.run = figures_of(read_recording(twin_program::run_twin(arguments.folder, arguments.duration_s)), system);
    comparison.run_is_changed = !arguments.what_ifs.empty();
  }
  const std::string text =
      arguments.json ? json_of(comparison) : head_of(arguments, system) + table_of(comparison, arguments.top);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw std::runtime_error("cannot write the output");
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (const std::optional<int> done = twin_program::parse_arguments(argc, argv, arguments)) {
    return *done;
  }
  try {
    return twin(arguments);
  } catch (const launch::LaunchError& error) {
    fmt::print(stderr, "{}", launch::render(error.diagnostics(), launch::shows_colour(STDERR_FILENO), kCommand));
    return launch::kWrongCommandLine;
  } catch (const tracing::TraceReadError& error) {
    fmt::print(stderr, "{}", launch::command_error(kCommand, error.what(), error.remedy()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}", launch::command_error(kCommand, error.what()));
  }
  return 1;
}
