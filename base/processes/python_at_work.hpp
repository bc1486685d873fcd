// SPDX-License-Identifier: Apache-2.0
// Where Python of a launch file is in a launcher. The launcher writes it into memory that launch-guardian reads when
// the launcher has gone, to tell what has ended it: `os._exit()`, `os.abort()`, a null pointer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace launch {

struct PythonAtWork {
  enum class Cause : std::int32_t {
    kNone = 0,
    kOutOfTime = 1,         // one call took longer than `seconds`
    kClosedDescriptors = 2  // Python has closed descriptors of the launcher
  };

  std::int32_t used;     // 1: Python has been started
  std::int32_t running;  // 1: it runs now, for `file`
  std::int32_t ended;    // 1: the launcher ends by itself
  Cause cause;           // why the launcher has ended itself
  std::int32_t seconds;
  // Of an expression. 0 for a launch file in Python: the traces tell the line.
  std::uint32_t line;
  std::uint32_t column;
  std::array<char, 4096> file;  // ends with zero
};

// What Python writes of its stack when it ends the launcher has at most so many bytes.
constexpr std::size_t kPythonTraces = 64UL << 10U;

// The innermost line of `file` in the last of the traces that faulthandler has written, 0 if there is none. With ""
// the innermost line of all.
std::uint32_t line_in_python_traces(const std::string& traces, const std::string& file);
// The file of the innermost line; "" if there is none.
std::string file_in_python_traces(const std::string& traces);

}  // namespace launch
