#!/usr/bin/python3
"""Tests of tools/cluster/submit without Slurm: its scripts run one after the other as Slurm would start them, and its
errors with programs that answer as Slurm does. Environment: MALUS, the command."""
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
kRoot = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(kRoot / "tools/cluster"))
import batch_options  # noqa: E402

kModel = kRoot / "scenes/models/watch.glb"
kSmall = ["--width", "16", "--camera", "frame"]

# The programs of Slurm: sbatch numbers the jobs from 7 and refuses the job named REFUSED, squeue lists QUEUED.
kPrograms = {
    "sbatch": 'echo "sbatch $*" >>"$RECORD"\n[ "${!###*/}" != "$REFUSED" ] || { echo "sbatch: error: refused" >&2; exit 1; }\n'
              'echo "$((6 + $(grep -c ^sbatch "$RECORD")));cluster"\n',
    "scancel": 'echo "scancel $*" >>"$RECORD"\n',
    "squeue": 'echo "$QUEUED"\n',
    "sinfo": 'echo "$NODES"\n',
    "scontrol": 'echo "MaxArraySize            = 5"\n',
    "stat": 'echo "$FILE_SYSTEM"\n',
}


class Submit(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.jobs = self.folder / "jobs.jsonl"
        self.jobs.write_text('{"repeat": 5, "polarizer": {"uniform": [0, 180]}}\n', encoding="utf-8")
        self.output = self.folder / "frames of a scene"
        self.record = self.folder / "record"
        self.record.touch()
        programs = self.folder / "bin"
        programs.mkdir()
        for name, text in kPrograms.items():
            (programs / name).write_text("#!/bin/bash\n" + text, encoding="utf-8")
            (programs / name).chmod(0o755)
        self.environment = {"PATH": f"{programs}:/usr/bin:/bin", "RECORD": str(self.record), "REFUSED": "", "QUEUED": "",
                            "NODES": "far1 far2", "FILE_SYSTEM": "nfs", "HOME": temporary.name,
                            "XDG_CACHE_HOME": str(self.folder / "cache")}

    def submit(self, *more, scene=kModel, tasks="2", **environment):
        return subprocess.run([str(w) for w in (kRoot / "tools/cluster/submit", scene, self.jobs, "-o", self.output, "--tasks",
                                                tasks, "--malus", os.environ["MALUS"], *more)], capture_output=True, text=True,
                              check=False, env=self.environment | environment, cwd=self.folder)

    def expect_error(self, done, code, *words):
        self.assertEqual((done.returncode, done.stdout), (code, ""), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def run_script(self, name, **environment):
        return subprocess.run([self.output / "cluster" / name], capture_output=True, text=True, check=False,
                              env=self.environment | environment)

    def test_scripts_render_the_batch(self):
        self.expect_batch()

    def test_scripts_render_tiles(self):
        self.jobs.write_text('{"width": 300, "height": 3}\n' * 5, encoding="utf-8")
        self.expect_batch("--tiles")

    def expect_batch(self, *more):
        """The scripts make the files of the command without `more`."""
        done = self.submit(*kSmall, *more, "--dry-run")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.record.read_text(encoding="utf-8"), "")
        runs = [("prepare.sh", {"SLURM_JOB_ID": "1"})]
        runs += [("frames.sh", {"SLURM_JOB_ID": str(k + 1), "SLURM_ARRAY_TASK_ID": str(k), "SLURM_CPUS_ON_NODE": "1"})
                 for k in (1, 2)]
        for name, environment in [*runs, ("merge.sh", {})]:
            done = self.run_script(name, **environment)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        subprocess.run([os.environ["MALUS"], "batch", kModel, self.jobs, "-o", self.folder / "single", *kSmall], check=True,
                       capture_output=True, env=self.environment)
        names = sorted(p.name for p in (self.folder / "single").iterdir())
        self.assertEqual(len(names), 6)
        self.assertEqual(sorted(p.name for p in self.output.iterdir() if p.is_file()), names)
        for name in names:
            self.assertEqual((self.output / name).read_bytes(), (self.folder / "single" / name).read_bytes(), name)

    def test_jobs_depend_on_each_other(self):
        done = self.submit(*kSmall, "--slurm", "--partition=long", "--slurm-frames", "--time=1:00:00 --mem=2G", tasks="4")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = [shlex.split(line)[1:] for line in self.record.read_text(encoding="utf-8").splitlines()]
        self.assertEqual([[w for w in line if w.startswith("--dependency")] for line in lines],
                         [[], ["--dependency=afterok:7"], ["--dependency=afterok:8"]])
        scripts = {p.name: p.read_text(encoding="utf-8") for p in (self.output / "cluster").glob("*.sh")}
        for text in scripts.values():
            self.assertIn("#SBATCH --requeue\n", text)
            self.assertIn("#SBATCH --partition=long\n", text)
        self.assertIn("#SBATCH --array=1-4\n", scripts["frames.sh"])
        self.assertEqual([name for name, text in scripts.items() if "--mem=2G" in text], ["frames.sh"])
        self.assertIn("squeue --jobs=7,8,9", done.stdout)
        self.assertEqual(json.loads((self.output / "cluster/submitted.json").read_text(encoding="utf-8")), ["7", "8", "9"])

    def test_refused_job_cancels_those_before(self):
        self.expect_error(self.submit(REFUSED="merge.sh"), 1, "sbatch", "refused")
        self.assertEqual(self.record.read_text(encoding="utf-8").splitlines()[-1], "scancel 7 8")

    def test_queued_batch(self):
        self.assertEqual(self.submit().returncode, 0)
        self.expect_error(self.submit(QUEUED="8"), 1, "scancel 7 8 9")
        self.assertEqual(self.submit().returncode, 0)

    def test_folders(self):
        self.expect_error(self.submit(FILE_SYSTEM="tmpfs"), 1, "tmpfs", "--shared")
        self.expect_error(self.submit(FILE_SYSTEM="ext2/ext3"), 1, "--shared")
        self.assertEqual(self.submit("--shared", FILE_SYSTEM="tmpfs").returncode, 0)
        self.assertEqual(self.submit(FILE_SYSTEM="tmpfs", NODES="localhost").returncode, 0)
        self.output = self.jobs / "below-a-file"
        self.expect_error(self.submit(), 1, "cannot write", "-o FOLDER")
        self.output = self.folder / "100%"
        self.expect_error(self.submit(), 1, "100%", "--output")

    def test_model_is_read_by_its_full_path(self):
        (self.folder / "room.hdr").write_bytes(b"#?RADIANCE\n")
        (self.folder / "watch.glb").write_bytes(kModel.read_bytes())
        self.assertEqual(self.submit("--environment", "room.hdr", "--dry-run", scene="watch.glb").returncode, 0)
        text = (self.output / "cluster/prepare.sh").read_text(encoding="utf-8")
        self.assertIn(f" {self.folder.resolve()}/watch.glb ", text)
        self.assertIn(f"--environment {self.folder.resolve()}/room.hdr", text)

    def test_no_slurm(self):
        for name in ("sbatch", "squeue"):
            (self.folder / "bin" / name).unlink()
        path = f"{self.folder}/bin:{self.make_path('python3', 'stat')}"
        self.expect_error(self.submit(PATH=path), 1, "sbatch", "--dry-run")
        self.assertFalse(self.output.exists())

    def make_path(self, *names) -> pathlib.Path:
        """A folder with these programs alone."""
        path = self.folder / "few"
        path.mkdir()
        for name in names:
            (path / name).symlink_to(f"/usr/bin/{name}")
        return path

    def test_negative_values(self):
        self.assertEqual(self.submit("--polarizer", "-30", "--exposure=-1.5", "--dry-run").returncode, 0)
        self.assertIn("--polarizer -30 ", (self.output / "cluster/frames.sh").read_text(encoding="utf-8"))
        self.assertIn("--exposure -1.5", (self.output / "cluster/frames.sh").read_text(encoding="utf-8"))

    def test_wrong_arguments(self):
        self.expect_error(self.submit("--wdith", "3"), 2, "--wdith")
        self.expect_error(self.submit("--shard", "1/2"), 2, "--shard")
        self.expect_error(self.submit("--slurm", "long"), 2, "--slurm", "long")
        self.expect_error(self.submit("--slurm-frames=--array=1-9"), 2, "--array")
        for tasks, code in (("0", 2), ("-1", 2), ("x", 2), ("5", 1)):
            self.expect_error(self.submit(tasks=tasks), code, "--tasks")
        self.expect_error(self.submit(tasks="5"), 1, "1 to 4")
        self.expect_error(self.submit("--width", "0"), 2, "--width", "16384")
        self.expect_error(self.submit("--malus", self.jobs), 1, "--malus")
        self.expect_error(self.submit(scene=self.folder / "none.pack"), 1, "none.pack")
        pack = self.folder / "a.pack"
        pack.write_bytes(b"MALUSPAK")
        self.expect_error(self.submit("--camera", "frame", scene=pack), 1, "--camera", "model")
        self.jobs = self.folder / "jobs.txt"
        self.expect_error(self.submit(), 1, "jobs.txt", ".jsonl")


class BatchOptions(unittest.TestCase):
    def test_options_of_the_program(self):
        options = {o.name: o for o in batch_options.read_options(os.environ["MALUS"])}
        self.assertFalse(batch_options.RESERVED & set(options))
        self.assertLess(batch_options.FOR_BAKING, set(options))
        self.assertEqual({name: options[name].values for name in ("--allow-open-glass", "--width", "--region", "--effects")},
                         {"--allow-open-glass": 0, "--width": 1, "--region": 4, "--effects": 1})
        self.assertTrue(options["--environment"].is_file)


if __name__ == "__main__":
    unittest.main()
