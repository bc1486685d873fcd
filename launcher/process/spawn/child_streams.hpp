// SPDX-License-Identifier: Apache-2.0
// Standard input, output and error of a child: pipes, pseudo-terminals, or one terminal for all three.
#pragma once

#include "base/files/unique_fd.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

// Two ends of a pipe or of a pseudo-terminal, both close-on-exec.
struct ChildStream {
  UniqueFd parent;
  UniqueFd child;
};

struct ChildStreams {
  ChildStream in;   // none if the child has the terminal of the launch
  ChildStream out;  // its end here does not block, nor does that of `err`
  ChildStream err;  // of a child with a tty, it has no end here: everything comes from `out`
};

// Throws std::system_error.
ChildStreams make_child_streams(const ProcessSpec& spec, bool has_terminal);

}  // namespace launch
