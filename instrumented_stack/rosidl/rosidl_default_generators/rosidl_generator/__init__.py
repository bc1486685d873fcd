"""Turns .msg and .srv files into C++ (see __main__.py for the command line)."""
