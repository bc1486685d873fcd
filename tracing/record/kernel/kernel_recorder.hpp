// SPDX-License-Identifier: Apache-2.0
// Records events of the kernel without LTTng's modules: runs launch-kernel-recorder beside a session.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tracing/record/plan/channel_plan.hpp"

namespace tracing {

inline constexpr const char* kKernelRecorder = "launch-kernel-recorder";
inline constexpr const char* kKernelRecorderChannel = "kernel";

enum class KernelRecording {
  kEverything,  // into `recording`/kernel
  kSnapshots,   // the newest events are kept for take_kernel_snapshot()
};

// Starts the recorder for the kernel channels of `plans`, and returns when it records. What the recorder itself and the
// processes `left_out` do is not recorded. The result is a warning that names the events that the kernel does not have,
// or "". Throws TraceError, also when there is nothing to record.
std::string start_kernel_recorder(const std::filesystem::path& program, const std::string& lttng_session_name,
                                  const std::filesystem::path& recording, const std::vector<ChannelPlan>& plans,
                                  KernelRecording what, const std::vector<pid_t>& left_out);

// Writes the events that the recorder of `recording` has kept beside the userspace part of the snapshot. With `clear`
// the next snapshot begins after this one. Does nothing when no recorder runs there. Throws TraceError.
void take_kernel_snapshot(const std::filesystem::path& recording, const std::filesystem::path& snapshot, bool clear);

// Throws TraceError if a kernel channel has a context field that tracefs does not give.
void check_kernel_recorder_fields(const std::vector<ChannelPlan>& plans);

// Pauses the recorder of `recording`, with everything written, or lets it go on. Does nothing when no recorder runs
// there. Throws TraceError when the recorder does not answer within seconds.
void pause_kernel_recorder(const std::filesystem::path& recording);
void resume_kernel_recorder(const std::filesystem::path& recording);

// The process of the recorder of `recording`; 0 when none runs there.
pid_t kernel_recorder_process(const std::filesystem::path& recording);

// Ends the recorder of `recording`, waits until everything is written, and returns how many events it has lost. Returns
// nothing when no recorder runs there.
std::optional<std::uint64_t> finish_kernel_recorder(const std::filesystem::path& recording);

}  // namespace tracing
