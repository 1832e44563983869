"""A display without a screen, and the window of `malus view` on it: keys, mouse, screenshots."""

import os
import pathlib
import shutil
import signal
import struct
import subprocess
import time


def is_available():
    """Whether Xvfb and xdotool are installed."""
    return all(shutil.which(program) for program in ("Xvfb", "xdotool"))


class Image:
    """Rows of RGB bytes."""

    def __init__(self, width, height, rgb):
        self.width, self.height, self.rgb = width, height, rgb

    def columns(self, first, last):
        """The part from column first to last - 1."""
        rows = [self.rgb[3 * (y * self.width + first):3 * (y * self.width + last)] for y in range(self.height)]
        return Image(last - first, self.height, b"".join(rows))

    def share_that_differs(self, other, most=1):
        """Share of the pixels with a colour that differs by more than `most` of 255."""
        assert (self.width, self.height) == (other.width, other.height), (self.width, self.height, other.width)
        if self.rgb == other.rgb:
            return 0
        different = sum(any(abs(a - b) > most for a, b in zip(self.rgb[i:i + 3], other.rgb[i:i + 3]))
                        for i in range(0, len(self.rgb), 3) if self.rgb[i:i + 3] != other.rgb[i:i + 3])
        return different / (self.width * self.height)


class Display:
    """Xvfb whose framebuffer is a file. Use it in a `with` block."""

    def __init__(self, folder, width, height):
        self.folder, self.size = pathlib.Path(folder), (width, height)

    def __enter__(self):
        read, write = os.pipe()
        screen = f"{self.size[0]}x{self.size[1]}x24"
        self.process = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", screen, "-nolisten", "tcp",
                                         "-noreset", "-fbdir", str(self.folder)], pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as numbers:
            self.name = ":" + numbers.readline().strip()
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()

    def screenshot(self):
        """The framebuffer, which is in the format of xwd."""
        data = (self.folder / "Xvfb_screen0").read_bytes()
        header = struct.unpack(">25I", data[:100])
        width, height, stride, start = header[4], header[5], header[12], header[0] + 12 * header[19]
        rgb = bytearray(3 * width * height)
        for y in range(height):
            row = data[start + y * stride:start + y * stride + 4 * width]
            part = slice(3 * y * width, 3 * (y + 1) * width)
            pixels = bytearray(3 * width)
            pixels[0::3], pixels[1::3], pixels[2::3] = row[2::4], row[1::4], row[0::4]
            rgb[part] = pixels
        return Image(width, height, bytes(rgb))

    def xdotool(self, *arguments):
        return subprocess.run(["xdotool", *map(str, arguments)], env=dict(os.environ, DISPLAY=self.name), check=True,
                              capture_output=True, text=True).stdout

    def still_screenshot(self, seconds=60):
        """The first screenshot that does not change for a second."""
        end = time.monotonic() + seconds
        last, since = self.screenshot(), time.monotonic()
        while time.monotonic() < end:
            time.sleep(0.2)
            now = self.screenshot()
            if now.rgb != last.rgb:
                last, since = now, time.monotonic()
            elif time.monotonic() - since > 1:
                return now
        raise AssertionError("the window does not come to rest")


class Viewer:
    """`malus view` on a display. Use it in a `with` block."""

    def __init__(self, display, malus, *arguments, environment=None, width=None, height=None):
        self.display = display
        size = (width or display.size[0], height or display.size[1])
        self.command = [malus, "view", *map(str, arguments), "--width", str(size[0]), "--height", str(size[1])]
        self.environment = dict(os.environ, DISPLAY=display.name, MALUS_DEVICE="llvmpipe", **(environment or {}))

    def __enter__(self):
        self.process = subprocess.Popen(self.command, env=self.environment, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, cwd=self.display.folder)
        end = time.monotonic() + 60
        while self.process.poll() is None and time.monotonic() < end:
            try:
                self.window = self.display.xdotool("search", "--onlyvisible", "--name", "^malus: ").split()[0]
                return self
            except (subprocess.CalledProcessError, IndexError):
                time.sleep(0.05)
        return self  # it has ended already

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGKILL)
        self.process.communicate()

    def key(self, *keys):
        self.display.xdotool("key", "--delay", 30, *keys)

    def drag(self, start, end, button=1):
        self.display.xdotool("mousemove", *start)
        time.sleep(0.1)
        self.display.xdotool("mousedown", button)
        for i in range(1, 9):
            self.display.xdotool("mousemove", *(round(a + (b - a) * i / 8) for a, b in zip(start, end)))
            time.sleep(0.02)
        self.display.xdotool("mouseup", button)

    def wait(self, seconds):
        """Waits for the end. Returns exit code, messages and seconds waited."""
        start = time.monotonic()
        _, messages = self.process.communicate(timeout=seconds)
        return self.process.returncode, messages, time.monotonic() - start

    def resident_bytes(self):
        """Resident memory: private (heap, compiled shaders), and shared, which has the pixels of lavapipe's images."""
        with open(f"/proc/{self.process.pid}/status") as lines:
            fields = dict(line.split(":", 1) for line in lines)
        return tuple(1024 * int(fields[name].split()[0]) for name in ("RssAnon", "RssShmem"))
