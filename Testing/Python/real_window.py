"""A desktop of its own for a test: an X server, a window manager, and a user made of xdotool.

    with Desktop() as desktop:
        program = desktop.start([sys.executable, "-m", "vtkhaptics", "ball.vtp"])
        program.move(0.5, 0.5)
        program.key("q")
        assert program.ended() == 0
"""

import os
import re
import select
import shutil
import signal
import subprocess
import sys
import time

NEEDED = ("Xvfb", "openbox", "xdotool", "setxkbmap")
SKIPPED = 77


def skip_where_it_cannot_run():
    """Ends a test as skipped, with the reason, where a program that it needs is missing."""
    missing = [name for name in NEEDED if not shutil.which(name)]
    if missing:
        print(
            f"skipped: a real window needs {', '.join(missing)}. Install them "
            "(Debian: apt-get install xvfb openbox xdotool x11-xkb-utils)."
        )
        sys.exit(SKIPPED)


def default_signals():
    """In a process that starts: no signal is ignored that its own starter ignores."""
    for number in (signal.SIGINT, signal.SIGHUP, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)


def wait_for(condition, seconds, what):
    """What the condition gives, once that is true. AssertionError after so many seconds."""
    end = time.monotonic() + seconds
    while True:
        value = condition()
        if value:
            return value
        assert time.monotonic() < end, f"waited {seconds:g} s in vain for {what}"
        time.sleep(0.05)


def wait_for_servo(process, seconds=60.0, say=lambda: ""):
    """Waits until a servo runs in a process; `say` is asked where that has ended before."""
    tasks = f"/proc/{process.pid}/task"

    def runs():
        assert process.poll() is None, (process.returncode, say())
        return subprocess.run(
            f"grep -sqx 'haptic servo' {tasks}/*/comm", shell=True, check=False).returncode == 0

    wait_for(runs, seconds, f"the servo of process {process.pid}")


def whole_lines(path):
    """The lines of a file that another process writes, without one that it has not ended yet."""
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.read().rpartition("\n")[0].splitlines()


class Desktop:
    """An X server with openbox; programs that are started in it see a user's keys and mouse."""

    def __init__(self, width=1280, height=1024):
        self.size = width, height
        self.processes = []

    def __enter__(self):
        read, write = os.pipe()
        screen = "x".join(map(str, self.size)) + "x24"
        # A server resets itself once its last client is gone, here a first xdotool, and turns away who
        # comes meanwhile: the window manager.
        self._run(
            ["Xvfb", "-noreset", "-displayfd", str(write), "-screen", "0", screen, "-nolisten", "tcp"],
            os.environ, pass_fds=[write],
        )
        os.close(write)
        number = b""
        while not number.endswith(b"\n"):
            ready, _, _ = select.select([read], [], [], 60.0)
            part = os.read(read, 16) if ready else b""
            assert part, "the X server did not start"
            number += part
        os.close(read)
        self.environment = {**os.environ, "DISPLAY": ":" + number.decode().strip()}
        self.environment.pop("WAYLAND_DISPLAY", None)
        openbox = self._run(["openbox"], self.environment)

        def manages():
            assert openbox.poll() is None, f"openbox ended with {openbox.returncode}"
            return self.xdo("get_num_desktops", check=False)

        wait_for(manages, 60.0, "openbox")
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            if process.poll() is None:
                process.terminate()
            process.wait()

    def _run(self, command, environment, **more):
        process = subprocess.Popen(
            command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **more
        )
        self.processes.append(process)
        return process

    def xdo(self, *words, check=True):
        """Runs xdotool; what it prints. Unchecked it may fail, which gives None."""
        done = subprocess.run(
            ["xdotool", *map(str, words)],
            env=self.environment, capture_output=True, text=True, check=False,
        )
        assert done.returncode == 0 or not check, (words, done.stderr)
        return done.stdout.strip() if done.returncode == 0 else None

    def type(self, text):
        """Types a text. A letter that follows itself comes after a pause: under load a program may take the second of
        them, whose press follows the first's release at once, for a key that was held."""
        for part in re.sub(r"(.)(?=\1)", "\\1\0", text).split("\0"):
            self.xdo("type", "--delay", "50", "--", part)
            time.sleep(0.2)

    def layout(self, name):
        """Chooses a keyboard, by its name for X."""
        subprocess.run(["setxkbmap", name], env=self.environment, check=True)
        time.sleep(0.3)  # for clients to hear of it

    def start(self, command, title="VTK Haptics", seconds=60.0):
        """Starts a program and waits for its window, which `title` finds."""
        log = os.path.join(os.environ.get("HAPTICS_TEST_OUTPUT", "."), f"real_window-{os.getpid()}.log")
        program = Program(self, command, log)
        self.processes.append(program.process)
        program.find_window(title, seconds)
        return program


class Program:
    """A process with a window, and the hands and eyes of its user."""

    def __init__(self, desktop, command, log):
        self.desktop, self.command, self.log = desktop, command, log
        with open(log, "wb") as out:
            self.process = subprocess.Popen(
                command, env=desktop.environment, stdout=out, stderr=subprocess.STDOUT,
                # As a shell starts it: one in the background would have SIGINT ignored, and nohup SIGHUP.
                preexec_fn=default_signals,
            )
        self.window = None

    def output(self):
        """All lines that the program has printed."""
        return "\n".join(whole_lines(self.log))

    def says(self, text, seconds=60.0):
        """Waits until the program has printed a text."""

        def found():
            ended = self.process.poll() is not None
            printed = text in self.output()
            assert printed or not ended, (self.command, self.process.returncode, self.output())
            return printed

        wait_for(found, seconds, f"{text!r} of {self.command}")

    def engages(self, seconds=60.0):
        """Waits until a servo runs in the program."""
        wait_for_servo(self.process, seconds, lambda: (self.command, self.output()))

    def find_window(self, title, seconds):
        def found():
            assert self.process.poll() is None, (self.command, self.output())
            return self.desktop.xdo("search", "--onlyvisible", "--name", title, check=False)

        self.window = wait_for(found, seconds, f"the window of {self.command}").split()[-1]
        lines = self.desktop.xdo("getwindowgeometry", "--shell", self.window).splitlines()
        place = {key: int(value) for key, value in (line.split("=") for line in lines)}
        self.size = place["WIDTH"], place["HEIGHT"]
        self.cursor = 0.5, 0.5

    def move(self, x, y):
        """Moves the mouse to a place in the window, in its widths and heights from the upper left."""
        self.cursor = x, y
        place = int(x * self.size[0]), int(y * self.size[1])
        self.desktop.xdo("mousemove", "--window", self.window, "--", *place)

    def drag(self, x, y, seconds=0.5, steps=30):
        """Moves the mouse there from where it is, as a hand does."""
        begin = self.cursor
        started = time.monotonic()
        for step in range(1, steps + 1):
            share = step / steps
            self.move(begin[0] + share * (x - begin[0]), begin[1] + share * (y - begin[1]))
            time.sleep(max(0.0, started + share * seconds - time.monotonic()))

    def focus(self):
        """Puts the mouse into the window, and the keyboard with it."""
        self.move(0.5, 0.5)
        self.desktop.xdo("windowfocus", self.window)
        time.sleep(0.2)

    def key(self, name):
        self.desktop.xdo("key", name)

    def close_button(self):
        """Closes the window as its button does: the window manager asks it to end."""
        self.desktop.xdo("key", "alt+F4")

    def interrupt(self):
        """Ctrl-C in the program's terminal."""
        self.process.send_signal(signal.SIGINT)

    def ended(self, seconds):
        """The exit status, minus the signal where one ended it; None where it still runs."""
        try:
            return self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return None
