"""The checks of this folder find what they are there to find: each is given a small tree with one mistake."""

import pathlib
import tempfile
import unittest

import documents
import include_directions


class Tree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for top in ("include", "src", "apps", "docs", "problems"):
            (self.root / top).mkdir()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


class IncludeDirections(Tree):
    def check(self, source, includes, expected):
        for name in includes:
            self.write(source, f'#pragma once\n#include <vector>\n#include "{name}"\n')
            found, _ = include_directions.violations(self.root)
            self.assertEqual(len(found), int(expected), f"{source} includes {name}: {found}")
        (self.root / source).unlink()

    def setUp(self):
        super().setUp()
        for name in ("error", "trajet", "math/roots", "law/program", "ode/segment", "ode/stepper", "geom/box", "sim/run"):
            self.write(f"include/trajet/{name}.hpp", "")
        self.write("problems/kepler.hpp", "")
        self.write("src/law/lexer.hpp", "")

    def test_allowed(self):
        self.check("src/law/parser.cpp", ["trajet/error.hpp", "trajet/version.hpp", "trajet/math/roots.hpp", "lexer.hpp"], False)
        self.check("include/trajet/event/locate.hpp", ["trajet/ode/segment.hpp"], False)
        self.check("include/trajet/collide/detect/contact_table.hpp", ["trajet/geom/box.hpp", "trajet/math/roots.hpp"], False)
        self.check("src/scene/world.cpp", ["trajet/law/program.hpp", "trajet/ode/stepper.hpp"], False)

    def test_math_includes_a_layer(self):
        self.check("src/math/x.cpp", ["trajet/ode/segment.hpp", "trajet/sim/run.hpp"], True)

    def test_ode_includes_law_geom_sim(self):
        self.check("include/trajet/ode/x.hpp", ["trajet/law/program.hpp", "trajet/geom/box.hpp", "trajet/sim/run.hpp"], True)

    def test_event_includes_more_of_ode_than_the_segment(self):
        self.check("include/trajet/event/locate.hpp", ["trajet/ode/stepper.hpp"], True)

    def test_private_header_of_another_layer(self):
        self.check("src/scene/world.cpp", ["../io/units.hpp"], True)
        self.check("src/ode/x.cpp", ["../law/lexer.hpp", "law/lexer.hpp"], True)

    def test_problems_and_umbrella(self):
        self.check("src/scene/world.cpp", ["../../problems/kepler.hpp", "problems/kepler.hpp", "trajet/trajet.hpp"], True)

    def test_leaf_includes_a_layer(self):
        self.check("include/trajet/error.hpp", ["trajet/math/roots.hpp"], True)

    def test_libraries(self):
        self.write("src/io/x.cpp", "#include <toml++/toml.h>\n#include <udunits2.h>\n")
        self.assertFalse(include_directions.violations(self.root)[0])
        self.write("src/sim/x.cpp", "#include <fmt/format.h>\n#include <udunits2.h>\n#include <CLI/CLI.hpp>\n")
        self.assertEqual(len(include_directions.violations(self.root)[0]), 3)

    def test_doors(self):
        self.write("src/law/x.cpp", "auto i = std::ranges::find(names, name);\nlong double x;\nstd::from_chars(a, b, y);\n")
        self.assertEqual(len(include_directions.violations(self.root)[0]), 3)
        self.write("src/law/x.cpp", "// long double\n")
        self.assertFalse(include_directions.violations(self.root)[0])

    def test_unknown_layer(self):
        self.write("src/misc/x.cpp", "")
        self.assertTrue(include_directions.violations(self.root)[0])


class Documents(Tree):
    def check(self, text, expected):
        self.write("docs/references.bib", "@book{Hairer1993,\n}\n")
        self.write("docs/methods/rk4.md", "[Hairer1993, p. 178]\n")
        self.write("docs/page.md", text)
        found, count = documents.violations(self.root)
        self.assertEqual(count, 2)
        self.assertEqual(len(found), expected, found)

    def test_right(self):
        self.check("`docs/methods/rk4.md` `docs/methods/<name>.md` `x docs/*.md y` [a](methods/rk4.md#top) `v/t` `n/a`", 0)

    def test_missing_path(self):
        self.check("see `docs/methods/rk5.md`", 1)
        self.check("see `make -C docs/nothing/<name>.md`", 1)
        self.check("see `trajet/ode/nothing.hpp`", 1)

    def test_missing_link(self):
        self.check("see [a](rk4.md)", 1)

    def test_unknown_citation(self):
        self.check("as [Jorba2005] says", 1)

    def test_uncited_entry(self):
        self.check("", 0)
        self.write("docs/references.bib", "@book{Hairer1993,\n}\n@book{Nobody2001,\n}\n")
        self.assertEqual(len(documents.violations(self.root)[0]), 1)

    def test_machine_path(self):
        self.check("run " + "/".join(["", "home", "me", "trajet"]), 1)

    def test_page_outside_the_index(self):
        self.check("", 0)
        self.write("docs/README.md", "[rk4](methods/rk4.md)\n")
        self.assertEqual(len(documents.violations(self.root)[0]), 1)
        self.write("docs/README.md", "[rk4](methods/rk4.md) [a page](page.md#part)\n")
        self.assertEqual(documents.violations(self.root)[0], [])

    def test_numbers_of_the_notes(self):
        self.check("Euler's method (F32), but not F# or IF12", 1)
        self.check("as erratum A1 says; A1 alone is a problem of DETEST", 1)
        self.check("`docs/methods/rk4.md`", 0)
        self.write("docs/notes/particles.md", "Euler's method (F32)\n")
        self.write("tests/x_test.cpp", "// F32\n")
        self.assertEqual(documents.violations(self.root)[0], [])


if __name__ == "__main__":
    unittest.main()
