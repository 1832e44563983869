"""tools/fresh-machine: verdict, cleanup and its cache, without root and network: the commands that need them are replaced
by small scripts on PATH."""

import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMANDS = {
    "id": "echo ${FAKE_UID:-0}",
    "unshare": 'while [[ $1 == --* ]]; do shift; done; exec "$@"',
    "mount": "true",
    "debootstrap": '''echo debootstrap >>"$FAKE_LOG"
root=${@: -2:1}
mkdir -p "$root"/{etc/apt/apt.conf.d,tmp,proc}
[ "$FAKE_DEBOOTSTRAP" != fails ] || { echo "E: no such mirror"; exit 1; }
[ "$FAKE_DEBOOTSTRAP" != hangs ] || { echo $$ >"$FAKE_PID"; exec sleep 60; }''',
    "chroot": '''case "$*" in
  *"$FAKE_STEP"*) echo "step $FAKE_STEP" >>"$FAKE_LOG"; [ -z "$FAKE_HANG" ] || { echo $$ >"$FAKE_PID"; exec sleep 60; }; exit $FAKE_STATUS ;;
esac''',
}


class FreshMachine(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        for name in ("bin", "tmp", "cache"):
            (self.folder / name).mkdir()
        for name, text in COMMANDS.items():
            path = self.folder / "bin" / name
            path.write_text("#!/bin/bash\n" + text + "\n")
            path.chmod(0o755)
        self.chroot = self.folder / "cache/malus/fresh-machine/trixie"
        self.environment = os.environ | {
            "PATH": f"{self.folder}/bin:{os.environ['PATH']}", "TMPDIR": f"{self.folder}/tmp",
            "XDG_CACHE_HOME": f"{self.folder}/cache", "FAKE_LOG": f"{self.folder}/log", "FAKE_PID": f"{self.folder}/pid",
            "FAKE_DEBOOTSTRAP": "", "FAKE_STEP": "tools/build", "FAKE_STATUS": "0", "FAKE_HANG": ""}

    def start(self, *arguments, **changes):
        return subprocess.Popen([ROOT / "tools/fresh-machine", *arguments], env=self.environment | changes,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))

    def run_to_end(self, *arguments, **changes):
        process = self.start(*arguments, **changes)
        out, err = process.communicate(timeout=60)
        return process.returncode, out, err

    def log(self):
        path = self.folder / "log"
        return path.read_text().split("\n")[:-1] if path.exists() else []

    def expect_verdict(self, out, passed):
        self.assertEqual(out.count("PASSED"), 1 if passed else 0, out)
        self.assertEqual(out.count("FAILED"), 0 if passed else 1, out)
        self.assertIn("PASSED" if passed else "FAILED", out.splitlines()[-1])
        self.assertEqual(list((self.folder / "tmp").iterdir()), [], "the temporary folder remains")

    def test_passes_after_the_last_step(self):
        for arguments in (["trixie", "--quick"], ["trixie"], ["bookworm"]):
            step = "tools/build" if "--quick" in arguments else "tools/test"
            code, out, err = self.run_to_end(*arguments, FAKE_STEP=step)
            self.assertEqual(code, 0, out + err)
            self.assertIn(f"step {step}", self.log())
            self.expect_verdict(out, True)

    def test_a_failed_step_fails(self):
        for arguments, step in ((["trixie", "--quick"], "tools/build"), (["trixie"], "tools/demo"),
                                (["trixie"], "tools/test")):
            shutil.rmtree(self.folder / "cache", ignore_errors=True)
            code, out, _ = self.run_to_end(*arguments, FAKE_STEP=step, FAKE_STATUS="7")
            self.assertEqual(code, 7, out)
            self.expect_verdict(out, False)

    def test_signals_fail(self):
        hangs = [{"FAKE_DEBOOTSTRAP": "hangs"}, {"FAKE_HANG": "yes"}]
        for sent, code in ((signal.SIGTERM, 143), (signal.SIGINT, 130), (signal.SIGHUP, 129)):
            for changes in hangs:
                pid = self.folder / "pid"
                pid.unlink(missing_ok=True)
                shutil.rmtree(self.folder / "cache", ignore_errors=True)
                process = self.start("trixie", "--quick", **changes)
                deadline = time.monotonic() + 60
                while not (pid.exists() and pid.read_text().strip()) and time.monotonic() < deadline:
                    time.sleep(0.02)
                process.send_signal(sent)
                out, _ = process.communicate(timeout=60)
                self.assertEqual(process.returncode, code, out)
                self.expect_verdict(out, False)
                self.assertFalse(pathlib.Path("/proc", pid.read_text().strip()).exists(), "a process remains")
                self.assertFalse(self.chroot.with_suffix(".partial").exists())

    def test_the_chroot_is_reused(self):
        for _ in range(2):
            code, out, err = self.run_to_end("trixie", "--quick")
            self.assertEqual(code, 0, out + err)
        self.assertEqual(self.log(), ["debootstrap", "step tools/build", "step tools/build"])

    def test_stale_and_half_made_chroots_are_replaced(self):
        self.assertEqual(self.run_to_end("trixie", "--quick")[0], 0)
        key = self.chroot / "malus-chroot"
        text = key.read_text()

        def other_packages():
            key.write_text("other packages\n")

        def old():
            os.utime(key, (time.time() - 40 * 86400,) * 2)

        def half_made():
            self.chroot.rename(self.chroot.with_suffix(".partial"))
            (self.chroot.with_suffix(".partial") / "left").write_text("")

        def no_key():
            key.unlink()

        for spoil in (other_packages, old, half_made, no_key):
            spoil()
            count = self.log().count("debootstrap")
            code, out, err = self.run_to_end("trixie", "--quick")
            self.assertEqual(code, 0, out + err)
            self.assertEqual(self.log().count("debootstrap"), count + 1, spoil.__name__)
            self.assertEqual(key.read_text(), text)
            self.assertFalse(self.chroot.with_suffix(".partial").exists())
            self.assertFalse((self.chroot / "left").exists())

    def test_without_a_chroot_it_fails(self):
        for changes in ({"FAKE_DEBOOTSTRAP": "fails"}, {"FAKE_UID": "1000"},
                        {"FAKE_STEP": "install-deps", "FAKE_STATUS": "7"}):
            code, out, err = self.run_to_end("trixie", "--quick", **changes)
            self.assertEqual(code, 1, out)
            self.assertIn("cannot make a chroot", err)
            self.expect_verdict(out, False)
            self.assertFalse(self.chroot.exists())

    def test_checks_that_debian_13_lacks_are_reported(self):
        out = self.run_to_end("trixie", "--quick")[1]
        for word in ("clang-format-14", "clang-tidy-14", "tests"):
            self.assertIn(word, out)

    def test_wrong_use(self):
        for arguments in ([], ["sid"], ["trixie", "--fast"], ["trixie", "--quick", "more"]):
            code, out, err = self.run_to_end(*arguments)
            self.assertEqual((code, out), (2, ""), arguments)
            self.assertIn("trixie", err)


if __name__ == "__main__":
    unittest.main()
