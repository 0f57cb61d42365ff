#!/bin/sh
# What a tick costs over what hands do: times, and with --instructions their exact twin by callgrind.
# Usage: sh Testing/Benchmarks/contact.sh [OPTION...] [FILE]
#        sh Testing/Benchmarks/contact.sh --against COMMIT    compares with another build; --help says more
exec /usr/bin/python3 "$(dirname "$0")/contact.py" "$@"
