# SPDX-License-Identifier: Apache-2.0
# Completion of launch(1) for fish.
complete -c launch -a '(launch complete (commandline -opc)[2..] (commandline -ct) 2>/dev/null)'
