"""The numbers of states and transitions, for launch files."""
