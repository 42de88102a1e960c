"""The JSON Schema of scene files: it takes what the reader takes, and knows every key that is documented."""

import copy
import json
import os
import re
import subprocess
import tomllib

import jsonschema
import pytest
from conftest import ROOT

SCHEMA = json.loads(subprocess.run([os.environ["TRAJET_PROGRAM"], "schema"], stdout=subprocess.PIPE, check=True).stdout)
VALIDATOR = jsonschema.Draft4Validator(SCHEMA)
PAGE = (ROOT / "docs/formats/scene.md").read_text(encoding="utf-8")


def properties(schema):
    """The names of all keys, and all words that stand behind them."""
    keys, words = set(), set()
    if isinstance(schema, dict):
        keys |= set(schema.get("properties", {}))
        words |= {word for word in schema.get("enum", ()) if isinstance(word, str)}
    for each in schema.values() if isinstance(schema, dict) else schema if isinstance(schema, list) else ():
        more_keys, more_words = properties(each)
        keys, words = keys | more_keys, words | more_words
    return keys, words


KEYS, WORDS = properties(SCHEMA)


def test_is_a_schema():
    jsonschema.Draft4Validator.check_schema(SCHEMA)
    assert SCHEMA["$schema"] == "http://json-schema.org/draft-04/schema#"


def scenes():
    """Every example, every scene of the tests' corpora, and every complete scene of the pages."""
    for path in [*(ROOT / "examples").rglob("*.toml"), *(ROOT / "tests/fuzz/corpora/scene").glob("*.toml")]:
        yield pytest.param(path.read_text(encoding="utf-8"), id=path.stem)
    for page in (ROOT / "docs").rglob("*.md"):
        for i, text in enumerate(re.findall(r"^```toml\n(.*?)^```$", page.read_text(encoding="utf-8"), re.M | re.S)):
            if "[time]" in text:
                yield pytest.param(text, id=f"{page.stem}-{i}")


@pytest.mark.parametrize("text", scenes())
def test_takes_every_scene(text):
    errors = [f"{'/'.join(map(str, e.absolute_path))}: {e.message}" for e in VALIDATOR.iter_errors(tomllib.loads(text))]
    assert not errors


SCENE = {
    "time": {"end": "5 s"},
    "body": [{"name": "a", "shape": "sphere", "radius": 1, "velocity": [1, "2 m/s", "v"], "acceleration": "-g*r"}],
    "obstacle": [{"name": "o", "shape": "plane", "point": [0, 0, 0], "normal": [0, 0, 1]}],
    "state": [{"name": "s", "value": 1, "rate": "-s"}],
    "event": [{"name": "e", "when": "s - 1", "action": {"set": {"s": 1, "a": {"v": "[0, 0, 0]"}}}}],
    "exact": {"s": "exp(-t)", "a": {"r": "[t, 0, 0]", "orientation": {"axis": [0, 0, 1], "angle": "t"}}},
}


def test_takes_a_scene_with_a_bit_of_all():
    VALIDATOR.validate(SCENE)


@pytest.mark.parametrize(
    "change",
    [
        lambda s: s.pop("time"),
        lambda s: s["time"].pop("end"),
        lambda s: s["time"].update(ned=1),
        lambda s: s.update(bodies=[]),
        lambda s: s["body"][0].pop("name"),
        lambda s: s["body"][0].update(velocty=[0, 0, 0]),
        lambda s: s["body"][0].update(velocity=[0, 0]),
        lambda s: s["body"][0].update(velocity=3),
        lambda s: s["body"][0].update(shape="spere"),
        lambda s: s["body"][0].update(size=[1, 1, 1]),
        lambda s: s["body"][0].pop("radius"),
        lambda s: s["body"][0].pop("shape"),
        lambda s: s["body"][0].update(orientation={"axes": 1}),
        lambda s: s["body"][0].update(collides_with="everything"),
        lambda s: s["obstacle"][0].pop("shape"),
        lambda s: s["obstacle"][0].pop("point"),
        lambda s: s["obstacle"][0].update(orientation={"axis": [0, 0, 1], "angle": 1}),
        lambda s: s["obstacle"][0].update(on_hit="jump"),
        lambda s: s["obstacle"][0].update(restitution=[1]),
        lambda s: s["state"][0].pop("rate"),
        lambda s: s["event"][0].update(direction="up"),
        lambda s: s.update(method={"order": 0}),
        lambda s: s.update(method={"orientation": "euler"}),
        lambda s: s.update(pair=[{"of": ["a"]}]),
    ],
)
def test_marks_what_is_wrong(change):
    wrong = copy.deepcopy(SCENE)
    change(wrong)
    assert not VALIDATOR.is_valid(wrong)


def test_knows_every_key_that_is_documented():
    documented = set()
    for section in re.split(r"^##+ ", PAGE, flags=re.M):
        if not section.startswith(("Tables", "`[[", "Friction")):
            continue
        for row in re.findall(r"^\|(.*)\|$", section, re.M):
            for cell in row.split("|")[:2]:
                documented |= {word for word in re.findall(r"`([a-z_]{2,})(?:`| =)", cell)}
    assert len(documented) > 60
    # names of closed forms, and letters of vectors
    assert documented - KEYS - WORDS == set()


def test_every_key_of_the_schema_is_documented():
    written = set(re.findall(r"[a-z_]+", " ".join(re.findall(r"`([^`\n]+)`", PAGE))))
    written |= set(re.findall(r"^([a-z_]+) *=", PAGE, re.M))
    tables = set(re.findall(r"\[+([a-z]+)\]+", PAGE))
    assert KEYS - written - tables == set()


def test_editors_find_a_description_at_each_key():
    for name, table in SCHEMA["definitions"].items():
        for key, schema in table.get("properties", {}).items():
            texts = [schema.get("description")] + [each.get("description") for each in schema.get("anyOf", ())]
            assert any(texts), f"{name}.{key}"
