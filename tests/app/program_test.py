"""The program as its user meets it: what it prints, writes and returns."""

import csv
import json
import os
import pty
import re
import select
import signal
import struct
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["ISOLUX_PROGRAM"]
ROOM = PROJECT / "examples" / "lalonde1993" / "room.yaml"
COARSE = ["--preset", "paper", "--rays", "8", "--eye-rays", "8", "--max-edge", "0.25"]
SHORT = [*COARSE, "--iterations", "4"]
FLOOR = "x,y,z,nx,ny,nz\n0.3,0.3,0,0,0,1\n0.7,0.3,0.001,0,0,1\n"


class ProgramTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="isolux_app_")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def run_program(self, *arguments, **options):
        return subprocess.run(
            [PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True,
            text=True, timeout=600, cwd=self.folder, **options)

    def succeed(self, *arguments):
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def fail_with(self, pattern, *arguments):
        """The program refuses: exit 1, one line that matches, no stdout, nothing written."""
        before = self.listing()
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertRegex(result.stderr, "^isolux: " + pattern)
        self.assertEqual(self.listing(), before)

    def solve(self, name, *arguments):
        path = self.folder / name
        self.succeed("solve", ROOM, "-o", path, "--quiet", *SHORT, *arguments)
        return path

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    def listing(self):
        return {path.name: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}


class Usage(ProgramTest):
    COMMANDS = ["solve", "render", "measure", "info", "check", "convert"]

    def test_help_fits_a_screen(self):
        text = self.succeed("--help").stdout
        self.assertLessEqual(len(text.splitlines()), 24, text)
        for command in self.COMMANDS:
            self.assertIn(command, text)

    def test_help_is_80_columns_wide(self):
        for command in [[], *([c] for c in self.COMMANDS)]:
            result = self.succeed(*command, "--help")
            self.assertEqual(result.stderr, "")
            self.assertLessEqual(max(map(len, result.stdout.splitlines())), 80, result.stdout)

    def test_solve_help_has_the_symbols_of_the_paper(self):
        text = self.succeed("solve", "--help").stdout
        for symbol in ["δ", "Δ", "α_n", "α_s"]:
            self.assertIn(symbol, text)

    def test_version(self):
        self.assertRegex(self.succeed("--version").stdout, r"^isolux \d+\.\d+\.\d+\n$")

    def test_wrong_usage_is_one_line(self):
        output = ["-o", "a.glb"]
        for arguments in [
            [], ["nonsense"], ["--nonsense"], ["solve"], ["solve", ROOM], ["solve", *output],
            ["render", "a.glb"], ["measure", "a.glb"], ["info"], ["check"],
            ["convert", ROOM], ["convert", *output],
            ["solve", ROOM, *output, "--nonsense"], ["solve", ROOM, ROOM, *output],
        ]:
            with self.subTest(arguments=arguments):
                self.fail_with(".+", *arguments)

    def test_numbers_are_read_strictly(self):
        for option, value in [
            ("--max-edge", "nan"), ("--max-edge", "inf"), ("--max-edge", "0"),
            ("--max-edge", "0.1m"), ("--max-edge", ""), ("--min-area", "-1"),
            ("--normal-tolerance", "180"), ("--contrast", "1e999"), ("--iterations", "1.5"),
            ("--iterations", "99999999999999999999"), ("--seed", "0x10"), ("--threads", "0"),
            ("--threads", "1025"), ("--rays", "1000000"), ("--selection", "bright"),
            ("--preset", "fast"), ("--distribution", "1"),
        ]:
            with self.subTest(option=option, value=value):
                self.fail_with(f".*{option}", "solve", ROOM, "-o", "a.glb", f"{option}={value}")

    def test_an_unknown_camera_is_told_the_known_ones(self):
        self.fail_with(".*nobody", "solve", ROOM, "-o", "a.glb", "--camera", "nobody", *SHORT)


class BadScenes(ProgramTest):
    def test_each_gives_its_place_and_writes_nothing(self):
        scenes = sorted((PROJECT / "tests" / "scene" / "bad").glob("*.yaml"))
        self.assertGreaterEqual(len(scenes), 20)
        for scene in scenes:
            with self.subTest(scene=scene.name):
                place = re.escape(str(scene)) + r":\d+:\d+: .+"
                self.fail_with(place, "solve", scene, "-o", "a.glb", "--stats", "a.json")
                self.fail_with(place, "check", scene)
                self.fail_with(place, "convert", scene, "-o", "a.yaml")

    def test_a_bad_scene_leaves_the_old_solution(self):
        self.write("a.glb", "old")
        self.fail_with(".+", "solve", self.write("bad.yaml", "isolux: 2\n"), "-o", "a.glb")

    def test_no_scene(self):
        for scene in ["none.yaml", self.folder, self.write("binary.yaml", bytes(range(256)))]:
            with self.subTest(scene=scene):
                self.fail_with(".+", "solve", scene, "-o", "a.glb")


class BadFiles(ProgramTest):
    @staticmethod
    def foreign_glb():
        text = b'{"asset":{"version":"2.0"}}'.ljust(28)
        return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text

    def refuse(self, path):
        points = self.write("points.csv", FLOOR)
        place = re.escape(str(path)) + ": .+"
        self.fail_with(place, "info", path)
        self.fail_with(place, "render", path, "-o", "a.png")
        self.fail_with(place, "measure", path, "--points", points, "-o", "a.csv")

    def test_truncated_and_foreign_solutions(self):
        whole = self.solve("whole.glb").read_bytes()
        size = len(whole)
        for length in [0, 3, 12, 19, 20, 100, size // 3, size // 2, size - 4, size - 1]:
            with self.subTest(length=length):
                self.refuse(self.write("cut.glb", whole[:length]))
        for name, content in [
            ("foreign.glb", self.foreign_glb()), ("text.glb", "isolux: 1\n"),
            ("longer.glb", whole + b"\0\0\0\0"), ("random.glb", os.urandom(1000)),
        ]:
            with self.subTest(name=name):
                self.refuse(self.write(name, content))
        self.refuse(self.folder / "none.glb")
        self.refuse(self.folder)

    def test_bad_points(self):
        solution = self.solve("a.glb")
        header = "x,y,z,nx,ny,nz\n"
        for name, content in [
            ("empty", ""), ("no_normal", "x,y,z\n0,0,0\n"), ("short", header + "0,0,0,0,0\n"),
            ("text", header + "0,0,zero,0,0,1\n"), ("nan", header + "0,0,nan,0,0,1\n"),
            ("no_direction", header + "0,0,0,0,0,0\n"), ("binary", bytes(range(256))),
        ]:
            with self.subTest(name=name):
                points = self.write("points.csv", content)
                place = re.escape(str(points)) + ":.+"
                self.fail_with(place, "measure", solution, "--points", points, "-o", "out.csv")


class Outputs(ProgramTest):
    """Outputs are checked before the work: here the input does not even exist."""

    def test_wrong_extension(self):
        self.fail_with(r"a\.txt: .*\.glb", "solve", "none", "-o", "a.txt")
        self.fail_with(r"a\.txt: .*\.json", "solve", "none", "-o", "a.glb", "--stats", "a.txt")
        self.fail_with(r"a\.jpg: .*\.png", "render", "none", "-o", "a.jpg")
        self.fail_with(r"a\.obj: .*\.mgf", "convert", "none", "-o", "a.obj")

    def test_no_such_folder(self):
        self.fail_with(r"no/a\.glb: .*folder 'no'", "solve", "none", "-o", "no/a.glb")
        self.fail_with(r"no/a\.json: ", "solve", "none", "-o", "a.glb", "--stats", "no/a.json")
        self.fail_with(r"no/a\.png: ", "render", "none", "-o", "no/a.png")
        self.fail_with(r"no/a\.csv: ", "measure", "none", "--points", "none", "-o", "no/a.csv")

    def test_a_folder_in_the_way(self):
        (self.folder / "a.glb").mkdir()
        self.fail_with(r"a\.glb: .*not a file", "solve", "none", "-o", "a.glb")

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_a_closed_folder(self):
        closed = self.folder / "closed"
        closed.mkdir(mode=0o555)
        self.fail_with(r"closed/a\.glb: ", "solve", "none", "-o", "closed/a.glb")

    def test_measured_points_are_not_overwritten(self):
        points = self.write("points.csv", FLOOR)
        self.fail_with(".*input", "measure", "none", "--points", points, "-o", points)

    def test_full_stdout_is_an_error(self):
        solution = self.solve("a.glb")
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "info", solution], stdout=full,
                                    stderr=subprocess.PIPE, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertIn("standard output", result.stderr)


class Work(ProgramTest):
    def test_from_scene_to_picture_and_figures(self):
        self.assertRegex(self.succeed("check", ROOM).stdout,
                         r"\nmemory: [\d.e-]+ MB for the scene, [\d.]+ MB at most until now\n")
        solution = self.folder / "room.glb"
        result = self.succeed("solve", ROOM, "-o", solution, "--stats", "stats.json", *SHORT)
        self.assertRegex(result.stderr, r"^isolux: .*room\.glb: 4 iterations, .*\n"
                         r"isolux: caution: \d+ % of the light is still unshot .*\n$")
        statistics = json.loads((self.folder / "stats.json").read_text())
        self.assertEqual(statistics["iterations"], 4)
        self.assertGreater(statistics["triangles"], 0)
        self.assertGreater(statistics["cpu_seconds"], 0)
        if statistics["scene_bytes"] != 0:  # it is not known under sanitizers
            self.assertGreater(statistics["scene_bytes"], 1000)
        self.assertGreater(statistics["peak_bytes"], statistics["scene_bytes"])
        self.assertLess(statistics["unshot_flux"], statistics["emitted_flux"])

        for arguments in [[], ["--mesh"]]:
            self.succeed("render", solution, "-o", "a.png", "--size", "32x24", *arguments)
            picture = (self.folder / "a.png").read_bytes()
            self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(struct.unpack(">II", picture[16:24]), (32, 24))
        self.succeed("render", solution, "-o", "a.exr", "--size", "32x24")
        self.assertEqual((self.folder / "a.exr").read_bytes()[:4], b"\x76\x2f\x31\x01")

        points = self.write("points.csv", FLOOR)
        to_stdout = self.succeed("measure", solution, "--points", points).stdout
        self.succeed("measure", solution, "--points", points, "-o", "out.csv")
        self.assertEqual((self.folder / "out.csv").read_text(), to_stdout)
        rows = list(csv.DictReader(to_stdout.splitlines()))
        self.assertEqual(list(rows[0]), "x y z nx ny nz Er Eg Eb E error".split())
        self.assertEqual(len(rows), 2)
        for row in rows:
            self.assertGreater(float(row["E"]), 0)

        text = self.succeed("info", solution).stdout
        for word in ["isolux 0.", "4 iterations", f"{statistics['triangles']} triangles", "lx"]:
            self.assertIn(word, text)
        self.assertEqual([name for name in self.listing() if ".part" in name], [])

    def test_bad_sizes(self):
        solution = self.solve("a.glb")
        for size in ["0x10", "10", "10x", "x10", "-1x10", "10x10x10", "1e9x1e9", "99999999x99999999"]:
            with self.subTest(size=size):
                self.fail_with(".*--size", "render", solution, "-o", "a.png", f"--size={size}")


class Conversion(ProgramTest):
    def test_a_written_scene_is_solved_like_the_one_it_was(self):
        self.succeed("convert", ROOM, "-o", "room.yaml")
        self.succeed("solve", "room.yaml", "-o", "again.glb", "--quiet", *SHORT)
        first, again = self.solve("first.glb"), self.folder / "again.glb"
        energy = re.compile(r"^energy .* lm emitted.*$", re.MULTILINE)
        lines = [energy.findall(self.succeed("info", solution).stdout)
                 for solution in [first, again]]
        self.assertEqual(len(lines[0]), 1)
        self.assertEqual(lines[0], lines[1])

    def test_writing_twice_changes_nothing(self):
        scenes = sorted((PROJECT / "examples").rglob("*.yaml"))
        for scene in (path for path in scenes if not path.name.endswith(".lights.yaml")):
            with self.subTest(scene=scene.name):
                self.succeed("convert", scene, "-o", "once.yaml")
                self.succeed("convert", "once.yaml", "-o", "twice.yaml")
                self.assertEqual((self.folder / "once.yaml").read_text(),
                                 (self.folder / "twice.yaml").read_text())

    def test_the_extension_names_the_format(self):
        for name, start in [("a.mgf", "m "), ("a.rad", "void plastic ")]:
            result = self.succeed("convert", ROOM, "-o", name)
            self.assertTrue((self.folder / name).read_text().startswith(start))
            self.assertEqual(result.stdout, "")
            self.assertRegex(result.stderr, "^isolux: note: cameras are left out")

    def test_what_a_format_lacks_is_named(self):
        die = PROJECT / "examples" / "csg" / "die.yaml"
        result = self.succeed("convert", die, "-o", "die.mgf")
        self.assertRegex(result.stderr, "triangles stand for what MGF does not have, up to .* m off")

    def test_the_format_may_be_given(self):
        scene = self.write("room.txt", ROOM.read_text())
        self.succeed("convert", "--format", "isolux", scene, "-o", "a.yaml")
        self.succeed("check", "--format", "isolux", scene)
        self.fail_with("unknown format 'isolox': did you mean 'isolux'", "check",
                       "--format", "isolox", scene)

    def test_the_input_is_not_overwritten(self):
        scene = self.write("room.yaml", ROOM.read_text())
        self.fail_with(".*input", "convert", scene, "-o", scene)


class Determinism(ProgramTest):
    def test_threads_change_no_byte(self):
        solutions = [self.solve(f"{n}.glb", "--threads", n).read_bytes() for n in (1, 2, 4)]
        self.assertEqual(solutions[0], solutions[1])
        self.assertEqual(solutions[0], solutions[2])

    def test_the_seed_does(self):
        first, second = (self.solve(f"{s}.glb", "--seed", s).read_bytes() for s in (1, 2))
        self.assertNotEqual(first, second)


class Terminal(ProgramTest):
    """A solve that would last for hours, on a terminal."""

    ENDLESS = ["--iterations", "100000000", "--stop-at-unshot", "0"]

    def interrupt(self, number):
        terminal, inside = pty.openpty()
        solver = subprocess.Popen(
            [PROGRAM, "solve", ROOM, "-o", "a.glb", *COARSE, *self.ENDLESS], cwd=self.folder,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=inside)
        os.close(inside)
        self.addCleanup(solver.stdout.close)
        self.addCleanup(solver.kill)
        shown = b""
        sent = False
        deadline = time.monotonic() + 300
        while time.monotonic() < deadline:
            if not select.select([terminal], [], [], 1)[0]:
                continue
            try:
                shown += os.read(terminal, 65536)
            except OSError:  # the other end is closed
                break
            if not sent and shown.count(b"\r") > 3:
                solver.send_signal(number)
                sent = True
        os.close(terminal)
        self.assertEqual(solver.wait(timeout=60), 3, shown)
        return shown.decode()

    def test_reading_shows_how_far_it_is_and_can_be_interrupted(self):
        points = ", ".join(f"[{k}, {k * k}, 0]" for k in range(12))
        objects = "".join(f"  - shape: {{polygon: {{points: [{points}, [0, {i + 1000}, 0]]}}}}\n"
                          "    material: grey\n" for i in range(180_000))
        scene = self.write("large.yaml", "isolux: 1\nmaterials: {grey: {reflectance: 0.5}}\n"
                           f"objects:\n{objects}")
        terminal, inside = pty.openpty()
        reader = subprocess.Popen([PROGRAM, "convert", scene, "-o", "b.yaml"], cwd=self.folder,
                                  stderr=inside)
        os.close(inside)
        self.addCleanup(reader.kill)
        shown = b""
        sent = False
        while True:
            try:
                shown += os.read(terminal, 65536)
            except OSError:  # the other end is closed
                break
            if not sent and b"\r" in shown:
                reader.send_signal(signal.SIGINT)
                sent = True
        os.close(terminal)
        self.assertEqual(reader.wait(timeout=60), 3, shown)
        self.assertRegex(shown.decode(), r"(parsing|making objects) \d+ %")
        self.assertIn("interrupted while reading the scene; nothing is written", shown.decode())
        self.assertEqual(list(self.listing()), ["large.yaml"])

    def test_interrupted_solves_save_what_they_have(self):
        for number in [signal.SIGINT, signal.SIGTERM]:
            with self.subTest(signal=number):
                shown = self.interrupt(number)
                self.assertRegex(shown, r"\d+/100000000 iterations, [\d.]+ % unshot, \d+ triangles")
                self.assertIn("interrupted", shown)
                self.assertEqual(list(self.listing()), ["a.glb"])
                self.assertIn("interrupted", self.succeed("info", "a.glb").stdout)

    def test_no_progress_line_into_a_file(self):
        result = self.succeed("solve", ROOM, "-o", "a.glb", *SHORT)
        self.assertNotIn("\r", result.stderr)
        result = self.succeed("solve", ROOM, "-o", "a.glb", "--quiet", *SHORT)
        self.assertEqual(result.stderr + result.stdout, "")


class Check(ProgramTest):
    BOXES = """isolux: 1
materials: {grey: {reflectance: 0.5}}
objects:
  - {name: a, shape: {box: {lower: [0, 0, 0], upper: [1, 1, 1]}}, material: grey}
  - {name: b, shape: {box: {lower: [0.5, 0.5, 0.5], upper: [2, 2, 2]}}, material: grey}
"""

    def test_says_what_it_read_and_whether_it_is_closed(self):
        text = self.succeed("check", ROOM).stdout
        self.assertIn("objects 4, materials 2, cameras 2, lights 1 with 500 lm", text)
        self.assertIn("primitives: box 1, cylinder 1, parallelogram 1, sphere 1\n", text)
        self.assertRegex(text, r"\nclosed: of \d{5} rays of light, none leaves it\n")
        self.assertIn("\nnothing doubtful\n", text)

    def test_the_sky_is_a_light(self):
        text = self.succeed("check", self.write("boxes.yaml", self.BOXES + (
            "sky: {type: clear, sun: z, illuminance: 12000, ground: 300}\n"))).stdout
        self.assertIn("lights 1 with 0 lm", text)
        self.assertIn("\nsky: 12000 lx on an open horizontal surface, ground 300 cd/m²\n", text)
        self.assertNotIn("nothing gives light", text)

    def test_what_is_doubtful_is_no_refusal(self):
        text = self.succeed("check", self.write("boxes.yaml", self.BOXES)).stdout
        self.assertIn("closed or open: not known", text)
        self.assertIn("\nwarning: 'a' and 'b' run through each other\n", text)

    def test_long_lists_of_objects_are_cut(self):
        balls = "".join(
            f"  - {{shape: {{sphere: {{center: [{3 * i}, 9, 0], radius: 1}}}}, material: grey}}\n"
            for i in range(200))
        text = self.succeed("check", self.write("balls.yaml", self.BOXES + balls)).stdout
        self.assertIn("and 102 more\n", text)
        self.assertLess(text.count("\n"), 230)

    def test_a_furnace_has_the_same_light_everywhere(self):
        text = self.succeed("check", "--furnace", ROOM, "--tolerance", "5").stdout
        rms, worst = (float(re.search(pattern, text)[1]) for pattern in
                      [r"\n *deviation +(\S+) %", r"\n +([+-]\S+) % at worst, on '\S+' at \("])
        self.assertLess(rms, 0.5)
        self.assertLess(abs(worst), 3)
        self.assertIn("escaped 0.000 %", text)
        self.assertEqual(self.listing(), {})

    def test_a_furnace_that_is_stopped_says_so(self):
        result = self.run_program("check", "--furnace", self.write("boxes.yaml", self.BOXES),
                                  "--tolerance", "0.01", "--time", "0.01")
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("interrupted", result.stdout)
        self.assertNotIn("deviation", result.stdout, "there was no light yet")

    def test_options_of_the_furnace_need_it(self):
        for option in ["--tolerance", "--time"]:
            self.fail_with(".*--furnace", "check", ROOM, option, "1")


class Tolerance(ProgramTest):
    """The default method: no parameter but how good the solution shall be."""

    def test_without_a_parameter(self):
        result = self.succeed("solve", ROOM, "-o", "a.glb", "--stats", "a.json")
        self.assertRegex(result.stderr, r"a\.glb: [\d.]+ lx on average, ± [\d.]+ % estimated")
        statistics = json.loads((self.folder / "a.json").read_text())
        self.assertTrue(statistics["converged"])
        self.assertLessEqual(statistics["error"], 0.01)
        self.assertIn("tolerance met", self.succeed("info", "a.glb").stdout)

        self.write("floor.csv", FLOOR)
        table = self.succeed("measure", "a.glb", "--points", "floor.csv").stdout
        for row in csv.DictReader(table.splitlines()):
            self.assertLess(0, float(row["error"]))
            self.assertLess(float(row["error"]), 0.05 * float(row["E"]))

    def test_bounds_end_it_with_exit_code_3(self):
        for bound in ["--time=0.001", "--max-triangles=100", "--max-memory=1"]:
            with self.subTest(bound=bound):
                result = self.run_program("solve", ROOM, "-o", "a.glb", "--tolerance", "0.1%", bound)
                self.assertEqual(result.returncode, 3, result.stderr)
                self.assertIn("not met", result.stderr)
                self.assertIn("tolerance", self.succeed("info", "a.glb").stdout)

    def test_the_papers_parameters_are_the_papers(self):
        self.fail_with(".*--max-edge", "solve", ROOM, "-o", "a.glb", "--max-edge", "0.1")
        self.fail_with(".*--tolerance", "solve", ROOM, "-o", "a.glb", "--preset", "paper",
                       "--tolerance", "1")
        self.fail_with(".*--tolerance", "solve", ROOM, "-o", "a.glb", "--tolerance", "0")
        self.fail_with(".*--tolerance", "solve", ROOM, "-o", "a.glb", "--tolerance", "1 %")

    def test_goes_on_after_a_kill_as_if_never_stopped(self):
        goal = ["--tolerance", "0.3", "--quiet"]
        self.succeed("solve", ROOM, "-o", "whole.glb", *goal)
        solver = subprocess.Popen(
            [PROGRAM, "solve", ROOM, "-o", "killed.glb", *goal, "--checkpoint", "a.checkpoint"],
            cwd=self.folder, stdin=subprocess.DEVNULL)
        checkpoint = self.folder / "a.checkpoint"
        deadline = time.monotonic() + 300
        while not checkpoint.exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        solver.kill()
        solver.wait()
        self.assertTrue(checkpoint.exists())
        self.succeed("solve", ROOM, "-o", "rest.glb", *goal, "--resume", "a.checkpoint")
        self.assertEqual((self.folder / "rest.glb").read_bytes(),
                         (self.folder / "whole.glb").read_bytes())

        bytes_of = checkpoint.read_bytes()
        for damaged in [b"", b"x", bytes_of[:-1], bytes_of[:1000], bytes_of + b"x"]:
            self.write("bad.checkpoint", damaged)
            self.fail_with(".*bad.checkpoint", "solve", ROOM, "-o", "b.glb", *goal,
                           "--resume", "bad.checkpoint")
        self.fail_with(".*other options", "solve", ROOM, "-o", "b.glb", "--seed", "2", *goal,
                       "--resume", "a.checkpoint")


if __name__ == "__main__":
    unittest.main()
