#!/bin/bash
# in_memory.sh KIB COMMAND...: the command, with no more addresses than that.
ulimit -v "$1"
exec "${@:2}"
