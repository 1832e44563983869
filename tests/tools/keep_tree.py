#!/usr/bin/python3
"""Runs a command, and kills all of its descendants when it receives SIGTERM or when its parent ends.

  keep_tree.py COMMAND...

Descendants whose parent ends become children of this process, daemons too, so that the tree of a node of a cluster stays
one tree. It stays until SIGTERM, even if the command ends. Linux only (prctl(2)).
"""
import ctypes
import os
import signal
import sys
import time

PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36


def find_descendants(root: int) -> list[int]:
    children = {}
    for name in os.listdir("/proc"):
        if name.isdigit():
            try:
                with open(f"/proc/{name}/stat", encoding="utf-8", errors="replace") as file:
                    state, parent = file.read().rpartition(")")[2].split()[:2]
            except OSError:  # it ended
                continue
            if state != "Z":
                children.setdefault(int(parent), []).append(int(name))
    found, todo = [], [root]
    while todo:
        todo.extend(children.get(todo[0], []))
        found.extend(children.get(todo.pop(0), []))
    return found


def kill_all(root: int) -> None:
    """Repeats until none is left, because a process may start another one meanwhile."""
    while pids := find_descendants(root):
        for pid in pids:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        time.sleep(0.02)


def end(*_) -> None:
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # no zombies
    kill_all(os.getpid())
    os._exit(0)


def main() -> None:
    parent = os.getppid()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, end)
    prctl = ctypes.CDLL(None, use_errno=True).prctl
    if prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0 or prctl(PR_SET_PDEATHSIG, signal.SIGTERM, 0, 0, 0) != 0:
        sys.exit(f"keep_tree.py: prctl: {os.strerror(ctypes.get_errno())}")
    if os.getppid() != parent:  # it ended before prctl
        return
    if os.posix_spawnp(sys.argv[1], sys.argv[1:], os.environ) > 0:
        while True:
            try:
                os.wait()
            except ChildProcessError:
                time.sleep(0.1)


if __name__ == "__main__":
    main()
