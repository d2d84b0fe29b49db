"""Validates problems.json, and all metadata and tables of results/, by their schemas; spoilt ones have to be refused."""
import csv
import json
import pathlib
import sys

import jsonschema

folder = pathlib.Path(sys.argv[1])
Validator = jsonschema.Draft202012Validator


def validator_of(schema):
    Validator.check_schema(schema)
    return Validator(schema)


def read(name):
    return json.loads((folder / name).read_text())


def declares_all(name, schema):
    """Every column has a type and a meaning."""
    columns = schema["properties"].items()
    untyped = [column for column, of in columns if "enum" not in of and {"number", "string"} <= set(of["type"])]
    unexplained = [column for column, of in columns if "description" not in of]
    assert not untyped and not unexplained, (name, untyped, unexplained)


def as_json(field, schema):
    """A field of a table as the schema of its column says that it is read."""
    if field == "":
        return None
    types = schema.get("type", [])
    if "number" not in types and "string" in types:
        return field
    try:
        return float(field)
    except ValueError:
        return field


def refuses(validator, spoilt):
    assert not validator.is_valid(spoilt), "a spoilt one is valid"


cards = read("problems.json")
of_cards = validator_of(read("problems.schema.json"))
of_cards.validate(cards)
assert len(cards["problems"]) > 15
certified = [card for card in cards["problems"] if card["optimum"]]
assert len(certified) > 10 and all(card["optimum"]["digits"] > 2 for card in certified)
for spoil in (lambda c: c.pop("horizon"), lambda c: c.update(colour=1), lambda c: c["start"]["q"].append("far")):
    spoilt = json.loads(json.dumps(cards))
    spoil(spoilt["problems"][0])
    refuses(of_cards, spoilt)

of_metadata = validator_of(read("metadata.schema.json"))
validated = 0
for file in sorted((folder / "results").glob("*.json")):
    metadata = json.loads(file.read_text())
    if "command_line" not in metadata:
        continue  # a solution kept by the indirect method
    of_metadata.validate(metadata)
    refuses(of_metadata, {**metadata, "complete": "yes"})
    refuses(of_metadata, {**metadata, "wall_seconds": -1})
    assert metadata.get("wall_seconds", 0) > 0 or file.name == "speed_solves_tables.json"  # bench/speed/page read other files
    for name, told in metadata["tables"].items():
        of_row = validator_of(told["schema"])
        declares_all(name, told["schema"])
        with open(folder / "results" / name, newline="") as table:
            for row in csv.DictReader(table):
                row = {column: as_json(field, told["schema"]["properties"][column]) for column, field in row.items()}
                of_row.validate(row)
                validated += 1
        refuses(of_row, {**row, "colour": 1})
        if name.endswith("_picture.csv"):
            assert all(("_in_" in column) == ("unit" in of) for column, of in told["schema"]["properties"].items()), name
        if name.endswith(("_nodes.csv", "_stages.csv", "_picture.csv")):
            for column in row:
                refuses(of_row, {**row, column: "far"})
        refuses(of_row, {column: row[column] for column in list(row)[1:]})
        if name in ("solve.csv", "convergence.csv"):
            for column, wrong in [("status", "splendid"), ("stages", 1.5), ("stages", None), ("intervals", "many"),
                                  ("objective", "low"), ("method", 7), ("free_variables", 0.5)]:
                refuses(of_row, {**row, column: wrong})
            of_row.validate({**row, "objective": None, "seconds": None})
            properties = told["schema"]["properties"]
            assert properties["seconds"]["unit"] == "s"
for name in ("claims", "findings", "claims_rows"):  # which no metadata of a run describe
    schema = read(name + ".schema.json")
    declares_all(name, schema)
    with open(folder / "results" / (name + ".csv"), newline="") as table:
        rows = list(csv.DictReader(table))
    for row in rows:
        validator_of(schema).validate({column: as_json(field, schema["properties"][column]) for column, field in row.items()})
    assert rows and rows[0].keys() == schema["properties"].keys(), name
assert validated > 5, validated
