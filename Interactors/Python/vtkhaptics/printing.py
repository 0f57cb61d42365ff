"""What a program prints is not worth its results: where nobody can read it, the program goes on."""

import contextlib
import errno
import os
import sys

READER_GONE = (errno.EPIPE, errno.EIO)  # of a pipe, of a terminal


class _Stream:
    """A stream of text which prints into nothing from the first write on that fails; `error` is why,
    where it is not that the reader has gone."""

    def __init__(self, stream):
        self._stream = stream
        self.error = None

    def __getattr__(self, name):
        return getattr(self._stream, name)

    def write(self, text):
        self._try(self._stream.write, text)
        return len(text)

    def flush(self):
        self._try(self._stream.flush)

    def _try(self, action, *arguments):
        try:
            action(*arguments)
        except OSError as error:
            if error.errno not in READER_GONE:
                self.error = error
            with open(os.devnull, "wb") as nothing:
                os.dup2(nothing.fileno(), self._stream.fileno())


@contextlib.contextmanager
def printing(name):
    """For all that the program of a name does, from its command line on. Where what it prints on standard
    output cannot be written, on a full disk for instance, it says so at the end, with the exit status 1; a
    reader that has gone (`| head -1`), or standard output that is closed, is nobody's fault."""
    # So that no file gets the number of a stream that is closed, and what VTK prints with it.
    while (handle := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass
    os.close(handle)
    before = sys.stdout, sys.stderr
    with open(os.devnull, "w", encoding="utf-8") as nothing:
        sys.stdout, sys.stderr = output, errors = [_Stream(stream or nothing) for stream in before]
        try:
            yield
        finally:
            output.flush()
            if output.error:
                print(f"{name}: standard output could not be written: {output.error.strerror}. Send it "
                      "elsewhere.", file=errors)
            errors.flush()
            sys.stdout, sys.stderr = before
            if output.error:
                raise SystemExit(1)
