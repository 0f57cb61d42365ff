"""A pvserver in several processes, for tests."""

import os
import re
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
    """A pvserver under mpiexec; simple.Connect() connects to it."""

    def __init__(self, ranks):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = probe.getsockname()[1]
        self.log = tempfile.TemporaryFile("w+")
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
        simple.Connect("127.0.0.1", self.port)
        haptics.load_plugin(PLUGIN)

    def complaints(self):
        """The lines of errors and warnings of its processes."""
        return [line for line in self.output().splitlines() if re.search(r"\b(ERR|WARN)\|", line)]

    def output(self):
        self.log.seek(0)
        return self.log.read()

    def stop(self):
        self.process.kill()
        self.process.wait()
        self.log.close()
