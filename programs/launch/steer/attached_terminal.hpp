// SPDX-License-Identifier: Apache-2.0
// This terminal, or what stands in its place, connected with that of a process: keys there, output here.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"
#include "base/terminal/detach_keys.hpp"
#include "base/terminal/raw_terminal.hpp"
#include "base/terminal/terminal_modes.hpp"
#include "launcher/control/control_client.hpp"

namespace launch {

class AttachedTerminal {
 public:
  struct Options {
    bool read_only = false;
    DetachKeys detach_keys;
    std::string greeting{};  // a line that is shown when keys go to the process
  };

  // The launch has answered "attach" already. It must outlive this object.
  AttachedTerminal(ControlClient& launch, Options options);

  struct End {
    bool detached = false;                            // by keys; the process goes on
    int signal = 0;                                   // that this program has got
    std::optional<ControlClient::Json> process = {};  // how it has ended
    bool cut_line = false;                            // the terminal shows a line without an end
  };
  // Returns when the process has ended, or is left. Nothing of all this: the launch has ended. The terminal is as
  // before then. Throws ControlError.
  End run();

 private:
  void turn();
  void receive();
  void obey(const ControlClient::Json& event);
  void take_keys();
  void take_signal();
  void send_typed();
  void write();
  void set_back();

  ControlClient& launch_;
  Options options_;
  bool keys_are_typed_;  // standard input is a terminal
  bool shows_screen_;    // standard output is one
  UniqueFd output_;
  UniqueFd signals_;
  std::optional<RawTerminal> raw_;
  TerminalModes modes_;  // that the process has asked for
  bool reads_input_ = true;
  std::string typed_;  // that the launch has not got
  bool waits_for_terminal_ = false;
  std::string shown_;  // that standard output has not taken
  bool over_ = false;
  End end_;
};

}  // namespace launch
