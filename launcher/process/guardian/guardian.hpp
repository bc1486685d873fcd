// SPDX-License-Identifier: Apache-2.0
// Makes sure that no process survives the launcher, whatever ends the launcher, even kill -9.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "base/processes/python_at_work.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

// The processes above the launcher: launch-guardian, and below it a spare of it. Every process that the launcher starts
// descends from both, and the lowest of the two that lives adopts each process whose parent dies
// (PR_SET_CHILD_SUBREAPER). The guardian passes signals to the launcher, and ends as the launcher ends. When the
// launcher has gone, the guardian ends what is left: SIGINT, then SIGTERM and SIGKILL after the timeouts of each
// process. Then the clean-up commands run. The spare does all that when the guardian has been killed.
class Guardian {
 public:
  // Splits this process: the calling process becomes the guardian, a new one its spare, and this function returns in a
  // third one, which goes on as the launcher. Must be called while there is one thread. When the guardian is killed,
  // the launcher gets SIGTERM; SIGURG is used for that. `command_line` is what ps(1) shows. The guardians keep the
  // descriptors `held` open until the end of the launch. `records` is the memory file of a contained launch
  // (containment.hpp); without it one is made. Throws std::system_error, also when the kernel lacks a system
  // call; a missing program ends the process with exit code 1 and a message.
  static Guardian put_above(const std::vector<std::string>& command_line,
                            const std::string& program = default_program(), const std::vector<int>& held = {},
                            UniqueFd records = {});
  // If guardian and spare have been killed, starts another spare, which ends what this process leaves.
  ~Guardian();
  Guardian(Guardian&&) = default;
  Guardian& operator=(Guardian&&) = default;

  // Waits until guardian and spare are there. A process that is started earlier may survive when all three are killed
  // at once.
  void wait_until_ready();

  // A number for this launch that no other launch has.
  const std::string& id() const { return id_; }

  // False when somebody has killed it.
  bool is_alive() const;

  // The environment variable that tells the guardian and its spare about a process: "LAUNCH_PROCESS=…".
  std::string mark(const std::string& label, const ProcessSpec& spec) const;

  // Notes the process with this number, from 1 on: for a process that does not let its environment be read.
  void note(std::size_t number, pid_t pid, const std::string& label, const ProcessSpec& spec);

  // The guardian writes there when the launcher has gone.
  void set_log(const std::string& path);

  // Adds a command, with the path of its program, that runs when the launcher has gone and the processes have ended.
  // The number that it returns takes the command back. Commands run in the opposite order, each as long as it gets on.
  std::int32_t add_clean_up(const std::vector<std::string>& command);
  void remove_clean_up(std::int32_t number);

  // Memory that the guardian reads when the launcher has gone; nullptr if there is none. Lives until the process ends.
  PythonAtWork* python_at_work() const;
  // Where Python writes its stack when it ends the launcher.
  UniqueFd python_traces() const;
  // The descriptor of the memory file.
  int records() const { return records_.get(); }

  // The process number of the guardian.
  pid_t pid() const { return pid_; }

  // ../lib/launch/launch-guardian, relative to the directory of this program.
  static std::string default_program();

 private:
  Guardian(UniqueFd records, UniqueFd ready, UniqueFd process, std::string id, pid_t pid, std::string program,
           pid_t launcher)
      : records_(std::move(records)),
        ready_(std::move(ready)),
        process_(std::move(process)),
        id_(std::move(id)),
        pid_(pid),
        program_(std::move(program)),
        launcher_(launcher) {}

  bool has_spare() const;

  UniqueFd records_;
  UniqueFd ready_;    // a pipe that is closed when the guardian and its spare are there
  UniqueFd process_;  // the guardian's pidfd
  std::string id_;
  pid_t pid_ = -1;
  std::string program_;
  pid_t launcher_ = -1;         // this process, and not a copy that fork(2) has made of it
  std::int32_t clean_ups_ = 0;  // numbers given so far
};

}  // namespace launch
