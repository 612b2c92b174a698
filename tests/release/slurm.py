#!/usr/bin/env python3
"""Studies under Slurm: the same study.csv as without, one killed and resumed, bisections, runs on two ranks.

    slurm.py PROGRAM [WORK]     # as root; starts munged, slurmctld and slurmd on loopback, and ends them

Studies are left in WORK; without it they are in a temporary folder and removed.

Needs slurm-wlm (with munge) and the privilege of root; fails, and names it, where one is missing.
"""
import csv
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "end_to_end"))
from study import CASE, check, finish, rows, same_bytes, study  # noqa: E402

STUDIES = Path(__file__).resolve().parents[2] / "studies"
POINTS = """
[study]
case = "case.toml"
[[axis]]
key = "drop.viscosity-ratio"
values = [0.5, 1, 2]
"""
BISECTION = """
[study]
case = "long.toml"
[bisection]
key = "flow.capillary-number"
from = 0.05
to = 0.2
tolerance = 0.3
"""
# The path by which a bare cluster of one node needs no cgroups and no systemd.
SLURM_CONF = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={state}/munge.socket
CredType=cred/munge
StateSaveLocation={state}/ctld
SlurmdSpoolDir={state}/d
SlurmctldPidFile={state}/slurmctld.pid
SlurmdPidFile={state}/slurmd.pid
SlurmctldLogFile={state}/slurmctld.log
SlurmdLogFile={state}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
CommunicationParameters=NoInAddrAny
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1
ReturnToService=2
MailProg=/bin/true
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def fail(text):
    sys.exit(f"FAILED: {text}")


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


class Cluster:
    """munged, slurmctld and slurmd of one node, this machine; they end with the block."""

    def __init__(self):
        for tool in ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "mpirun"):
            check(shutil.which(tool), f"there is no {tool}; apt install slurm-wlm munge openmpi-bin")
        check(os.geteuid() == 0, "the privilege is missing: Slurm's daemons run jobs as root alone")
        self.daemons = []
        self.state = state = Path(tempfile.mkdtemp(prefix="meniscus-slurm-"))
        state.chmod(0o755)  # munged wants its socket to be in reach of all
        self.environment = os.environ | {
            "SLURM_CONF": str(state / "slurm.conf"), "OMPI_ALLOW_RUN_AS_ROOT": "1",
            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}

    def __enter__(self):
        state = self.state
        for folder in ("ctld", "d"):
            (state / folder).mkdir()
        (state / "munge.key").write_bytes(os.urandom(1024))
        (state / "munge.key").chmod(0o600)
        host = socket.gethostname().split(".")[0]
        (state / "slurm.conf").write_text(
            SLURM_CONF.format(host=host, ports=free_ports(2), state=state, cpus=max(2, os.cpu_count())),
            encoding="utf-8")
        try:
            self.start(["munged", "--foreground", f"--key-file={state}/munge.key", f"--socket={state}/munge.socket",
                        f"--pid-file={state}/munged.pid", f"--log-file={state}/munged.log",
                        f"--seed-file={state}/munge.seed"])
            self.wait(lambda: (state / "munge.socket").exists(), "munged")
            self.start(["slurmctld", "-D"])
            self.start(["slurmd", "-D", "-N", host])
            self.wait(lambda: "idle" in self.ask(["sinfo", "-h", "-o", "%T"]), "slurmctld and slurmd")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            if daemon.poll() is None:
                daemon.send_signal(signal.SIGTERM)
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        shutil.rmtree(self.state, ignore_errors=True)

    def start(self, command):
        with open(self.state / f"{command[0]}.said", "wb") as said:
            self.daemons.append(subprocess.Popen(command, env=self.environment, stdout=said, stderr=said))

    def ask(self, command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False).stdout

    def wait(self, is_due, what):
        for _ in range(300):
            for daemon in self.daemons:
                if daemon.poll() is not None:
                    name = daemon.args[0]
                    said = (self.state / f"{name}.said").read_text(encoding="utf-8", errors="replace")
                    log = self.state / f"{name}.log"
                    said += log.read_text(encoding="utf-8", errors="replace") if log.exists() else ""
                    fail(f"{name} ended with {daemon.returncode}:\n{said[-2000:]}")
            if is_due():
                return
            time.sleep(0.1)
        fail(f"{what}: not ready after 30 s")

    def jobs(self):
        """Array tasks in the queue."""
        return self.ask(["squeue", "--noheader", "--array", "-o", "%F_%K %T"]).splitlines()


def scripts(output):
    return sorted(output.glob("slurm/*.sh"))


def check_points(cluster, program, work):
    plain, slurm = work / "points", work / "points-slurm"
    finish(study(program, work / "points.toml", plain, "--jobs", "2"), "three points without Slurm")
    finish(study(program, work / "points.toml", slurm, "--slurm", environment=cluster.environment), "three points by Slurm")
    same_bytes(plain, slurm, "three points by Slurm")
    check(len(scripts(slurm)) == 1, "three points make one job array")
    check(len(list(slurm.glob("slurm/0001-*.out"))) == 3, "not a task for each point")


def check_killed(cluster, program, work):
    """The jobs of a study that is killed go on; the same command collects them and starts none twice."""
    killed = work / "points-killed"
    process = study(program, work / "points.toml", killed, "--slurm", environment=cluster.environment)
    while not cluster.jobs():
        check(process.poll() is None, "the study ended before it could be killed")
        time.sleep(0.01)
    process.kill()
    process.communicate()
    check(cluster.jobs(), "the jobs ended with their study")
    finish(study(program, work / "points.toml", killed, "--slurm", environment=cluster.environment), "killed and resumed")
    same_bytes(work / "points", killed, "killed and resumed")
    check(len(scripts(killed)) == 1, "jobs in the queue were submitted again")


def check_cancelled(cluster, program, work):
    """A job that Slurm ends is a failed run; the next call goes on with it."""
    output = work / "points-cancelled"
    process = study(program, work / "points.toml", output, "--slurm", "--jobs", "1", environment=cluster.environment)
    while not list(output.glob("runs/*/checkpoint-*.h5")):
        check(process.poll() is None, "the study ended before its job could be cancelled")
        time.sleep(0.01)
    job = cluster.jobs()[0].split()[0]
    cluster.ask(["scancel", job])
    said = finish(process, "a job cancelled", 1)
    check(f"{job}: CANCELLED" in said, "it does not say what became of the job")
    check([row["outcome"] for row in rows(output)] == ["failed", "done", "done"], "the others did not go on")
    finish(study(program, work / "points.toml", output, "--slurm", environment=cluster.environment), "gone on with")
    same_bytes(work / "points", output, "cancelled and gone on with")


def check_bisection(cluster, program, work):
    plain, slurm = work / "bisection", work / "bisection-slurm"
    finish(study(program, work / "bisection.toml", plain, "--jobs", "2"), "a bisection without Slurm")
    finish(study(program, work / "bisection.toml", slurm, "--slurm", environment=cluster.environment), "a bisection by Slurm")
    same_bytes(plain, slurm, "a bisection by Slurm")
    check(len(scripts(slurm)) > 1, "a bisection submits its rounds one after another")


def check_grace(cluster, program, work):
    """Three points of the shipped study of Grace's curve."""
    for name in ("grace-extension.toml", "extension.toml"):
        text = (STUDIES / name).read_text(encoding="utf-8")
        text = text.replace("values = [110, 60]", "values = [60]")
        text = text.replace("values = [0.01, 0.03, 0.1, 0.3, 1, 3, 10]", "values = [1, 3, 10]")
        (work / name).write_text(text, encoding="utf-8")
    plain, slurm = work / "grace", work / "grace-slurm"
    finish(study(program, work / "grace-extension.toml", plain, "--jobs", "2"), "Grace's curve without Slurm")
    finish(study(program, work / "grace-extension.toml", slurm, "--slurm", environment=cluster.environment),
           "Grace's curve by Slurm")
    same_bytes(plain, slurm, "Grace's curve by Slurm")
    check([row["outcome"] for row in rows(slurm)] == 3 * ["critical"], "not three critical values")


def check_ranks(cluster, program, work):
    output = work / "points-ranks"
    finish(study(program, work / "points.toml", output, "--slurm", "--ranks", "2", environment=cluster.environment),
           "on two ranks")
    for one, two in zip(rows(work / "points"), rows(output)):
        check(abs(float(one["L"]) - float(two["L"])) < 1e-9, "two ranks give another L than one")
    for run in output.glob("runs/*/run.json"):
        check('"ranks": 2' in run.read_text(encoding="utf-8"), f"{run}: not on two ranks")


def check_silence(program, work):
    """Where Slurm does not answer, one line says so, and nothing is written."""
    nowhere = os.environ | {"SLURM_CONF": str(work / "none.conf")}
    said = finish(study(program, work / "points.toml", work / "none", "--slurm", environment=nowhere), "no answer", 1)
    check("Slurm does not answer" in said and said.count("\n") == 1, "not one line that says so")
    check(not (work / "none").exists(), "a folder was made")


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    if len(sys.argv) == 3:
        test(sys.argv[1], Path(sys.argv[2]).resolve())
        return
    with tempfile.TemporaryDirectory() as folder:
        test(sys.argv[1], Path(folder) / "studies")


def test(program, work):
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    (work / "case.toml").write_text(CASE.format(end=1), encoding="utf-8")
    (work / "long.toml").write_text(CASE.format(end=20), encoding="utf-8")
    (work / "points.toml").write_text(POINTS, encoding="utf-8")
    (work / "bisection.toml").write_text(BISECTION, encoding="utf-8")
    with Cluster() as cluster:
        for each in (check_points, check_killed, check_cancelled, check_bisection, check_grace, check_ranks):
            each(cluster, program, work)
    check_silence(program, work)
    print("slurm: studies by Slurm give the tables of those without")


if __name__ == "__main__":
    main()
