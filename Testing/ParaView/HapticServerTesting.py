"""A pvserver in several processes, for tests."""

import os
import re
import signal
import socket
import subprocess
import tempfile
import time

from HapticSceneTesting import PLUGIN, PVPYTHON, haptics
from paraview import simple


def clean_environment():
    """Of this process, without what makes mpiexec think that it was started by MPI."""
    started_by_mpi = ("PMIX_", "PMI_", "OMPI_COMM", "OMPI_UNIVERSE", "OMPI_MCA_ess", "OMPI_MCA_orte")
    kept = {name: value for name, value in os.environ.items()
            if not name.startswith(started_by_mpi)}
    kept["OMPI_MCA_mpi_yield_when_idle"] = "1"  # more ranks than cores
    kept["OMPI_ALLOW_RUN_AS_ROOT"] = kept["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1"  # in a container
    return kept


class Server:
    """A pvserver under mpiexec; simple.Connect() connects to it.

    delay: how long what is sent takes each way [s]. with_link: that may change, see set_link().
    """

    def __init__(self, ranks, delay=0.0, with_link=False):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = probe.getsockname()[1]
        # Read by a file of its own: a seek in the processes' own would move where they write.
        self.log = tempfile.NamedTemporaryFile()
        self.process = subprocess.Popen(
            ["mpiexec", "--oversubscribe", "-n", str(ranks),
             os.path.join(os.path.dirname(PVPYTHON), "pvserver"),
             f"--server-port={self.port}", "--force-offscreen-rendering"],
            stdout=self.log, stderr=subprocess.STDOUT, env=clean_environment())
        end = time.monotonic() + 120.0
        while "Accepting connection" not in self.output():
            if self.process.poll() is not None or time.monotonic() > end:
                raise RuntimeError(f"pvserver did not start: {self.output()}")
            time.sleep(0.1)
        self.relay = None
        port = self.port
        if delay > 0.0 or with_link:
            script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "late_relay.py")
            self.relay = subprocess.Popen(
                ["python3", script, str(self.port), str(delay)], text=True, bufsize=1,
                stdin=subprocess.PIPE, stdout=subprocess.PIPE)
            port = int(self.relay.stdout.readline())
        simple.Connect("127.0.0.1", port)
        haptics.load_plugin(PLUGIN)

    def set_link(self, delay, loss=0.0):
        """From now on: how long what is sent takes each way [s], and what share is lost and sent again."""
        self.relay.stdin.write(f"{delay} {loss}\n")

    def complaints(self):
        """The lines of errors and warnings of its processes."""
        return [line for line in self.output().splitlines() if re.search(r"\b(ERR|WARN)\|", line)]

    def output(self):
        with open(self.log.name, errors="replace") as log:
            return log.read()

    def end_a_rank(self):
        """Kills the last of its processes, after which MPI ends the others."""
        ranks = subprocess.run(["pgrep", "-P", str(self.process.pid)], capture_output=True, text=True)
        os.kill(int(ranks.stdout.split()[-1]), signal.SIGKILL)
        self.process.wait()

    def stop(self):
        self.process.kill()
        self.process.wait()
        if self.relay:
            self.relay.kill()
            self.relay.wait()
            self.relay.stdin.close()
            self.relay.stdout.close()
        self.log.close()
