"""tools/check-style: findings, counts and exit codes. Phrases are split here so that the check does not find them."""

import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def check(*arguments):
    return subprocess.run([ROOT / "tools/check-style", *arguments], capture_output=True, text=True)


class CheckStyle(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, text):
        path = pathlib.Path(self.folder.name) / name
        path.write_text(text)
        return str(path)

    def test_clean_text_passes(self):
        clean = self.write("clean.cpp", "// Returns the nearest hit.\n// Where two hits agree, the first.\nint a;  // metres\n"
                                        "// There is no limit. The CIE's ey" "e is allowed. Obeyed.\n")
        result = check(clean)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))

    def test_reports_file_line_and_proposal(self):
        bad = self.write("bad.md", "Fine.\nA pic" "ture.\n")
        result = check(bad)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stdout, r"^\S+bad\.md:2: 'pic" r"ture' -> .*image")
        self.assertEqual(result.stdout.count("\n"), 1)

    def test_finds_every_kind(self):
        lines = ["// Wh" "at a ray hits", "int a;  // ho" "w often", "// this is n" "o list", "// 16 bytes a r" "ay",
                 "f(\"Wh" "ere it is\");", "count" "Of(x);", "Float" "Scene s;", "// the e" "ye", "// it te" "lls"]
        for i, line in enumerate(lines):
            result = check(self.write(f"line{i}.cpp", line + "\n"))
            self.assertEqual((result.returncode, result.stdout.count("\n")), (1, 1), line + result.stdout)
        for i, line in enumerate(["# Wh" "at it does", "x = 1  # wh" "y", "\"\"\"Wh" "at it does.\"\"\""]):
            self.assertEqual(check(self.write(f"line{i}.py", line + "\n")).returncode, 1, line)

    def test_functions_are_at_most_80_lines_long(self):
        # A body of n lines and the lines of the signature and of the closing brace.
        def function(n):
            return "namespace a {\nclass B {\n  int c(\n      int d) {\n" + "    // }\n" * (n - 1) + \
                "    const auto e = [] { return \"{\"; };\n  }\n};\n}\n"
        self.assertEqual(check(self.write("short.h", function(77))).returncode, 0)
        result = check(self.write("long.h", function(78)))
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stdout, r"^\S+long\.h:3: 'int c.*81\n$")
        # Tables are not functions, and text in other languages is not checked.
        table = "constexpr int kTable[] = {" + "\n    1," * 100 + "\n};\n"
        self.assertEqual(check(self.write("table.cpp", table)).returncode, 0)
        self.assertEqual(check(self.write("long.js", function(100))).returncode, 0)
        self.assertEqual(check(self.write("open.cpp", "int a() {\n")).returncode, 1)

    def test_file_names_are_checked(self):
        self.assertEqual(check(self.write("pic" "ture.txt", "")).returncode, 1)

    def test_counts(self):
        self.write("a.md", "pic" "ture pic" "ture\n")
        result = check("--count", self.folder.name)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stdout, r"(?m)^\s+2 in all$")

    def test_wrong_use(self):
        for argument in ["--no-such-option", "/no/such/file"]:
            result = check(argument)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn(argument, result.stderr)


if __name__ == "__main__":
    unittest.main()
