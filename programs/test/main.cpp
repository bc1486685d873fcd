// SPDX-License-Identifier: Apache-2.0
// The program behind `launch test`.
#include "launcher/testing/test_command.hpp"

int main(int argc, char** argv) {
  return launch::test_command({argv + 1, argv + argc});
}
