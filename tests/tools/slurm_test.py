#!/usr/bin/python3
"""tools/cluster/submit on a Slurm cluster of two nodes on this machine: the merged frames are those of a single run, hash
by hash, although a node, a daemon or a renderer is killed. Environment: MALUS the program. Exit code 77 without Slurm."""
import atexit
import json
import hashlib
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import slurm_cluster  # noqa: E402
from slurm_cluster import wait_for  # noqa: E402

kRoot = pathlib.Path(__file__).resolve().parents[2]
kModel = kRoot / "scenes/models/watch.glb"
kJobs = ('{"repeat": 39, "polarizer": {"uniform": [0, 180]}, "materials": {"polished steel": {"roughness": {"uniform": [0, 0.3]}}}}\n'
         '{"name": "last", "camera": {"position": [0.1, 0.2, 0.2], "target": [0, 0, 0]}}\n')
kFrames = 40
kOptions = ["--seed", "5", "--width", "96", "--outputs", "exr,truth,camera"]


def count_frames(shard: pathlib.Path) -> int:
    manifest = shard / "manifest.jsonl"
    return manifest.read_text(encoding="utf-8").count('"index":') if manifest.exists() else 0


def hash_files(folder: pathlib.Path) -> dict:
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in folder.iterdir() if p.is_file()}


class Slurm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="malus-slurm-")
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        (cls.folder / "slurm").mkdir()
        cls.cluster = slurm_cluster.Cluster(cls.folder / "slurm")
        atexit.register(cls.cluster.stop)
        cls.addClassCleanup(cls.cluster.stop)
        cls.jobs = cls.folder / "jobs.jsonl"
        cls.jobs.write_text(kJobs, encoding="utf-8")
        subprocess.run([os.environ["MALUS"], "batch", kModel, cls.jobs, "-o", cls.folder / "single", *kOptions], check=True,
                       capture_output=True, env=os.environ | {"XDG_CACHE_HOME": str(cls.folder / "cache")})
        cls.expected = hash_files(cls.folder / "single")

    def setUp(self):
        self.cluster.recover()
        self.output = self.folder / self.id().rpartition(".")[2]

    def submit(self, *more, scene=kModel, jobs=None, tasks=2):
        return self.cluster.run(kRoot / "tools/cluster/submit", scene, jobs or self.jobs, "-o", self.output, "--tasks", tasks,
                                "--malus", os.environ["MALUS"], *(more or kOptions))

    def start(self, **options):
        done = self.submit(**options)
        self.assertEqual(done.returncode, 0, done.stderr)

    def shard(self, number: int) -> pathlib.Path:
        return self.output / f"cluster/shards/{number}-of-2"

    def log(self, name: str) -> str:
        return (self.output / f"cluster/logs/{name}.log").read_text(encoding="utf-8")

    def find_busy_node(self, tasks=(1, 2), least=2):
        """A node with one of the tasks in its middle, and the number of the task."""
        def find():
            for line in self.cluster.queue():
                number, state, *node = line.split()
                if state == "RUNNING" and "_" in number and node:
                    task = int(number.split("_")[1])
                    if task in tasks and least <= count_frames(self.shard(task)) <= kFrames // 4:
                        return node[0], task
            return None
        return wait_for(find, "task between 2 and 10 frames", 120)

    def expect_merged(self):
        wait_for(lambda: not self.cluster.queue(), "empty queue", 300)
        self.assertTrue((self.output / "manifest.jsonl").exists(), self.read_logs())
        lines = (self.output / "manifest.jsonl").read_text(encoding="utf-8").splitlines()
        self.assertEqual([json.loads(line)["index"] for line in lines[1:]], list(range(kFrames)))
        self.assertEqual(hash_files(self.output), self.expected)

    def expect_continued(self, task: int):
        """The task was started twice, the second start found frames of the first, and the other task was started once."""
        log = self.log(f"frames-{task}")
        self.assertIn("restart 1", log)
        found = int(log.rpartition(" finished before")[0].rpartition(" ")[2])
        self.assertGreaterEqual(found, 2, log)
        self.assertNotIn("restart 1", self.log(f"frames-{3 - task}"))

    def read_logs(self) -> str:
        return "\n".join(p.read_text(encoding="utf-8") for p in (self.output / "cluster/logs").iterdir())

    def test_node_is_killed(self):
        self.start()
        node, task = self.find_busy_node()
        self.cluster.stop_tree(node)
        self.assertLess(count_frames(self.shard(task)), kFrames // 2)
        wait_for(lambda: self.cluster.states()[node].startswith("down"), "node that is down", 60)
        self.expect_merged()
        self.expect_continued(task)

    def test_daemon_is_killed(self):
        """The renderer continues without its slurmd, while the task starts again: the second start waits for the first. It
        is stopped meanwhile, so that it is the slower one."""
        self.start()
        node, task = self.find_busy_node()
        renderers = self.cluster.find_processes(node, "malus")
        for pid in renderers:
            os.kill(pid, signal.SIGSTOP)
        self.cluster.kill_daemon(node)
        self.cluster.run("scontrol", "update", f"NodeName={node}", "State=DOWN", "Reason=test")
        other = next(name for name in slurm_cluster.NODES if name != node)
        wait_for(lambda: "restart 1" in self.log(f"frames-{task}"), "second start", 120)
        wait_for(lambda: self.cluster.find_processes(other, "flock"), "waiting task", 20)
        self.assertEqual(self.cluster.find_processes(other, "malus"), [])
        for pid in renderers:
            os.kill(pid, signal.SIGCONT)
        self.expect_merged()
        self.assertIn(f"{kFrames // 2} finished before", self.log(f"frames-{task}"))

    def test_renderer_is_killed(self):
        """The last task of an array has the number of the array."""
        self.start()
        node, task = self.find_busy_node(tasks=[2])
        for pid in self.cluster.find_processes(node, "malus"):
            os.kill(pid, signal.SIGKILL)
        self.expect_merged()
        self.expect_continued(task)

    def test_time_limit(self):
        """USR1 arrives before the limit. The shell of the task has it from slurmstepd; here from this process."""
        self.start()
        node, task = self.find_busy_node(tasks=[2])
        job = next(line.split()[0] for line in self.cluster.queue() if line.split()[-1] == node)
        self.assertEqual(self.cluster.run("scancel", "--batch", "--signal=USR1", job).returncode, 0)
        self.expect_merged()
        self.expect_continued(task)
        self.assertIn("code 130", self.log(f"frames-{task}"))

    def test_large_image_in_tiles(self):
        """A tiled frame; one renderer is killed at its second tile or later."""
        jobs = self.folder / "large.jsonl"
        jobs.write_text('{"name": "large", "width": 1500, "height": 800}\n', encoding="utf-8")
        options = ["--outputs", "exr,png,truth"]
        subprocess.run([os.environ["MALUS"], "batch", kModel, jobs, "-o", self.folder / "large", *options], check=True,
                       capture_output=True, env=os.environ | {"XDG_CACHE_HOME": str(self.folder / "cache")})
        done = self.submit(*options, "--tiles", jobs=jobs)
        self.assertEqual(done.returncode, 0, done.stderr)
        node, task = self.find_busy_node(least=1)
        for pid in self.cluster.find_processes(node, "malus"):
            os.kill(pid, signal.SIGKILL)
        wait_for(lambda: not self.cluster.queue(), "empty queue", 300)
        self.assertTrue((self.output / "manifest.jsonl").exists(), self.read_logs())
        self.assertEqual(hash_files(self.output), hash_files(self.folder / "large"))
        self.assertIn("restart 1", self.log(f"frames-{task}"))

    def test_queued_batch_is_not_submitted_again(self):
        self.start()
        done = self.submit()
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("scancel", done.stderr)
        ids = json.loads((self.output / "cluster/submitted.json").read_text(encoding="utf-8"))
        self.find_busy_node()
        self.assertEqual(self.cluster.run("scancel", *ids).returncode, 0)
        wait_for(lambda: not self.cluster.queue(), "empty queue", 60)
        self.assertFalse((self.output / "manifest.jsonl").exists())
        self.start()
        self.expect_merged()

    def test_bad_jobs_fail_once(self):
        bad = self.folder / "bad.jsonl"
        bad.write_text('{}\n{"camra": 1}\n', encoding="utf-8")
        self.start(jobs=bad)
        wait_for(lambda: not self.cluster.queue(), "empty queue", 60)
        self.assertIn("camra", self.log("prepare"))
        self.assertEqual([p.name for p in (self.output / "cluster/logs").iterdir()], ["prepare.log"])

    def test_too_many_tasks(self):
        done = self.submit(tasks=11)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("1 to 10", done.stderr)


def raise_interrupt(*_):
    raise KeyboardInterrupt


if __name__ == "__main__":
    if missing := slurm_cluster.find_missing():
        print(f"SKIPPED: {', '.join(missing)} not installed; tools/install-deps --slurm installs Slurm and munge")
        sys.exit(77)
    signal.signal(signal.SIGTERM, raise_interrupt)
    unittest.main(verbosity=2)
