"""readme.py finds what is wrong with a page: each test gives it a small page with one mistake."""

import contextlib
import io
import pathlib
import tempfile
import unittest

import readme


class Page(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "examples").mkdir()
        (self.root / "Makefile").write_text("build:\n")
        consumer = self.root / "tests/install/consumer"
        consumer.mkdir(parents=True)
        (consumer / "CMakeLists.txt").write_text("find_package(trajet 0.1 REQUIRED)\n")
        self.program = self.root / "program"
        self.program.write_text('#!/bin/sh\necho "$@" $(cat scene.toml 2>/dev/null)\n')
        self.program.chmod(0o755)

    def holds(self, text, *examples):
        (self.root / "page.md").write_text(text, encoding="utf-8")
        with contextlib.redirect_stdout(io.StringIO()):
            return readme.page(str(self.root / "page.md"), str(self.program), *examples)

    def test_an_output(self):
        self.assertTrue(self.holds("```sh\ntrajet run\n```\n\n```text\nrun\n```\n"))
        self.assertTrue(self.holds("```sh\nbuild/release/trajet run\n```\n\n```text\nr…n\n```\n"))
        self.assertFalse(self.holds("```sh\ntrajet run\n```\n\n```text\nsaunter\n```\n"))

    def test_a_block_that_fails(self):
        self.assertTrue(self.holds("```sh\ntrue\n```\n"))
        self.assertFalse(self.holds("```sh\nfalse\n```\n"))

    def test_a_file(self):
        scene = "```toml\n# scene.toml\n[time]\n```\n"
        self.assertTrue(self.holds(scene + "```sh\ntrajet run\n```\n\n```text\nrun # scene.toml [time]\n```\n"))
        self.assertFalse(self.holds(scene + "```sh\ntrajet run\n```\n\n```text\nrun\n```\n"))

    def test_a_figure(self):
        self.assertTrue(self.holds("```sh\ntouch f.svg --plot f.svg 2>/dev/null; touch f.svg\n```\n"))
        self.assertFalse(self.holds("```sh\ntrajet run --plot f.svg\n```\n"))

    def test_setting_up_is_not_run(self):
        self.assertTrue(self.holds("```sh\ngit clone nowhere && cd nowhere\nmake build  # all of it\n```\n"))
        self.assertFalse(self.holds("```sh\nmake coffee\n```\n"))

    def test_a_cpp_example(self):
        page = "```cpp\nint main() {}\n```\n\n```text\n```\n"
        self.assertTrue(self.holds(page, "/bin/true"))
        self.assertFalse(self.holds(page.replace("```text\n", "```text\nfour\n"), "/bin/true"))
        self.assertFalse(self.holds(page))
        self.assertFalse(self.holds(page, "/bin/true", "/bin/true"))

    def test_cmake_lines(self):
        self.assertTrue(self.holds("```cmake\nfind_package(trajet 0.1 REQUIRED)\n```\n"))
        self.assertFalse(self.holds("```cmake\nfind_package(trajectory)\n```\n"))

    def test_a_page_without_blocks(self):
        self.assertFalse(self.holds("Words.\n"))


if __name__ == "__main__":
    unittest.main()
