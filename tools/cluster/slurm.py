"""Commands of Slurm that tools/cluster/submit calls."""
import re
import shutil
import socket
import subprocess

# File systems that other hosts cannot see, by the names of `stat --file-system --format=%T`.
LOCAL = {"tmpfs", "ramfs", "overlayfs", "ext2/ext3", "ext4", "xfs", "btrfs", "zfs", "f2fs"}


class SlurmError(Exception):
    """A message of one line."""


def call(*command) -> str:
    """Standard output of a command. Throws SlurmError with its last line of standard error."""
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    except OSError as error:
        raise SlurmError(f"{command[0]}: cannot run: {error.strerror}") from error
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or ["no message"]
        raise SlurmError(f"{command[0]} failed: {lines[-1]}")
    return done.stdout


def require_installed() -> None:
    for program in ("sbatch", "squeue", "sinfo", "scontrol"):
        if shutil.which(program) is None:
            raise SlurmError(f"{program} is not installed here; expected a login node of a Slurm cluster "
                             "(Debian: slurm-client), or --dry-run")


def most_tasks() -> int:
    """Largest index of a job array."""
    match = re.search(r"^MaxArraySize\s*=\s*(\d+)", call("scontrol", "show", "config"), re.MULTILINE)
    return int(match.group(1)) - 1 if match else 1000


def has_other_hosts() -> bool:
    """Whether a node has another address than this host."""
    here = {"localhost", "127.0.0.1", "::1", socket.gethostname(), socket.gethostname().split(".")[0]}
    return not set(call("sinfo", "--noheader", "--Node", "--format=%o").split()) <= here


def file_system(folder) -> str:
    return call("stat", "--file-system", "--format=%T", folder).strip()


def is_queued(ids: list[str]) -> bool:
    """Whether a job is pending or runs. Slurm forgets finished jobs, and refuses their numbers if all are unknown."""
    if not ids:
        return False
    done = subprocess.run(["squeue", "--noheader", "--format=%A", "--jobs", ",".join(ids)], capture_output=True,
                          text=True, check=False)
    if done.returncode != 0 and "Invalid job id" not in done.stderr:
        raise SlurmError(f"squeue failed: {done.stderr.strip()}")
    return bool(done.stdout.strip())


def submit_chain(scripts: list) -> list[str]:
    """Submits jobs of which each starts after the one before has succeeded. Returns their numbers."""
    ids = []
    for script in scripts:
        after = [f"--dependency=afterok:{ids[-1]}", "--kill-on-invalid-dep=yes"] if ids else []
        try:
            ids.append(call("sbatch", "--parsable", *after, script).strip().split(";")[0])
        except SlurmError:
            if ids:
                subprocess.run(["scancel", *ids], check=False)
            raise
    return ids
