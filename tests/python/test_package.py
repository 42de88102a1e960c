"""The package itself: its docstrings, and its stub, which says what is there."""

import ast
import inspect
import pathlib

import trajet

STUB = ast.parse((pathlib.Path(trajet.__file__).parent / "__init__.pyi").read_text(encoding="utf-8"))


def stubs(kind):
    return {node.name: node for node in STUB.body if isinstance(node, kind)}


def test_every_export_has_a_docstring():
    for name in trajet.__all__:
        thing = getattr(trajet, name)
        assert thing.__doc__, name
        for member, value in vars(thing).items() if inspect.isclass(thing) else ():
            function = getattr(value, "fget", None) or getattr(value, "func", value)
            if inspect.isfunction(function) and not member.startswith("_"):
                assert function.__doc__, f"{name}.{member}"


def test_the_stub_knows_every_export():
    assert (pathlib.Path(trajet.__file__).parent / "py.typed").exists()
    assert set(trajet.__all__) <= stubs(ast.ClassDef).keys() | stubs(ast.FunctionDef).keys()


def test_the_stub_has_the_parameters_of_functions():
    for name, node in stubs(ast.FunctionDef).items():
        real = inspect.signature(getattr(trajet, name)).parameters
        stub = [each.arg for each in (*node.args.args, *node.args.kwonlyargs)]
        ours = [p.name for p in real.values() if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]
        assert stub[: len(ours)] == ours, name
        # `check`, `compare` and `view` hand further options on to `run`
        assert set(stub[len(ours) :]) <= set(inspect.signature(trajet.run).parameters), name


def test_the_stub_has_the_members_of_classes():
    for name, node in stubs(ast.ClassDef).items():
        stub = {each.name for each in node.body if isinstance(each, ast.FunctionDef)}
        stub |= {each.target.id for each in node.body if isinstance(each, ast.AnnAssign)}
        real = {member for member in vars(getattr(trajet, name)) if not member.startswith("_")}
        assert real - {"count", "index"} <= stub, name
