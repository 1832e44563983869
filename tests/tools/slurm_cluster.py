"""A Slurm cluster of two nodes on this machine, without root: munged, slurmctld and two slurmd, with their configuration,
ports and files in one folder. Needs a Slurm with MULTIPLE_SLURMD, as that of Debian: `slurmd -N NAME`."""
import os
import pathlib
import pwd
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import time

from keep_tree import find_descendants

KEEP = str(pathlib.Path(__file__).resolve().parent / "keep_tree.py")
NODES = ("node1", "node2")

# cred_expire bounds the delay of a requeued job [s], SlurmdTimeout the time until a silent node is down [s].
CONFIGURATION = """ClusterName=malus
SlurmctldHost=localhost
SlurmctldPort={ports[0]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
KillWait=5
MaxArraySize=11
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n.log
SlurmdSpoolDir={folder}/%n
StateSaveLocation={folder}/state
SchedulerType=sched/builtin
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
NodeName=node1 NodeAddr=127.0.0.1 NodeHostname=localhost Port={ports[1]} CPUs=1 RealMemory=100
NodeName=node2 NodeAddr=127.0.0.1 NodeHostname=localhost Port={ports[2]} CPUs=1 RealMemory=100
PartitionName=all Nodes=ALL Default=YES MaxTime=60 State=UP
"""


def find_missing() -> list[str]:
    """Programs that are not installed."""
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    return [name for name in ("munged", "slurmctld", "slurmd", "sbatch", "scontrol") if shutil.which(name) is None]


def find_ports(count: int) -> list[int]:
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def wait_for(what, description: str, seconds: float):
    """Returns the first true value of what(). Throws AssertionError after the time."""
    end = time.monotonic() + seconds
    while not (value := what()):
        if time.monotonic() > end:
            raise AssertionError(f"after {seconds} s: no {description}")
        time.sleep(0.1)
    return value


class Cluster:
    """Starts with the constructor. stop() ends every process, by its number."""

    def __init__(self, folder: pathlib.Path):
        self.folder, self.kept = folder, {}
        for name in ("state", *NODES):
            (folder / name).mkdir()
        key = folder / "munge.key"
        key.touch(mode=0o600)
        key.write_bytes(secrets.token_bytes(128))
        (folder / "slurm.conf").write_text(CONFIGURATION.format(
            folder=folder, user=pwd.getpwuid(os.geteuid()).pw_name, ports=find_ports(3)), encoding="utf-8")
        self.environment = os.environ | {"SLURM_CONF": str(folder / "slurm.conf")}
        try:
            self.start_daemons()
        except BaseException:
            self.stop()
            raise

    def start_daemons(self) -> None:
        munge = [f"--{name}={self.folder}/munge.{suffix}" for name, suffix in
                 (("key-file", "key"), ("socket", "socket"), ("pid-file", "pid"), ("log-file", "log"), ("seed-file", "seed"))]
        self.start("munged", "munged", "--foreground", "--force", *munge)
        wait_for((self.folder / "munge.socket").exists, "socket of munged", 30)
        self.start("slurmctld", "slurmctld", "-D", "-i")
        for node in NODES:
            self.start_node(node)
        self.wait_until_idle()

    def wait_until_idle(self) -> None:
        wait_for(lambda: self.states() == {node: "idle" for node in NODES}, "cluster with two idle nodes", 60)

    def recover(self) -> None:
        """Cancels all jobs and starts the nodes again that were killed."""
        self.run("scancel", "--partition=all")
        for node in NODES:
            if node not in self.kept or not self.find_processes(node, "slurmd"):
                if node in self.kept:
                    self.stop_tree(node)
                self.start_node(node)
        wait_for(lambda: not self.queue(), "empty queue", 60)
        self.wait_until_idle()

    def start(self, name: str, *command) -> None:
        with open(self.folder / f"{name}.out", "ab") as output:
            self.kept[name] = subprocess.Popen([sys.executable, KEEP, *command], stdin=subprocess.DEVNULL, stdout=output,
                                               stderr=output, env=self.environment, start_new_session=True)

    def start_node(self, node: str) -> None:
        self.start(node, "slurmd", "-D", "-N", node)

    def stop_tree(self, name: str) -> None:
        """Kills a daemon with all of its descendants: on a node slurmd, the steps and their programs."""
        process = self.kept.pop(name)
        process.send_signal(signal.SIGTERM)
        process.wait()

    def kill_daemon(self, node: str) -> None:
        """Kills slurmd alone: its jobs stay."""
        os.kill(int((self.folder / f"{node}.pid").read_text(encoding="utf-8")), signal.SIGKILL)

    def find_processes(self, node: str, name: str) -> list[int]:
        """Numbers of the programs of that name on a node."""
        found = []
        for pid in find_descendants(self.kept[node].pid):
            try:
                if pathlib.Path(f"/proc/{pid}/comm").read_text(encoding="utf-8").strip() == name:
                    found.append(pid)
            except OSError:  # it ended
                pass
        return found

    def run(self, *command) -> subprocess.CompletedProcess:
        return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False,
                              env=self.environment)

    def states(self) -> dict:
        lines = self.run("sinfo", "--noheader", "--Node", "--format=%N %T").stdout.splitlines()
        return dict(line.split() for line in lines)

    def queue(self) -> list[str]:
        """A line 'NUMBER_TASK STATE NODE' for each job that has not ended."""
        done = self.run("squeue", "--noheader", "--array", "--format=%i %T %N")
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        return done.stdout.splitlines()

    def stop(self) -> None:
        for name in list(self.kept):
            self.stop_tree(name)
