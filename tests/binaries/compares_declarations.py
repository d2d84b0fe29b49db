"""Compares what the metadata in a folder declare of its tables with a file. --accept: writes that file. --in-part: the
folder need not have all of its tables."""
import json
import pathlib
import sys

folder, file, how = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3:]


def declaration(schema):
    """Key and types, without what is said for readers."""
    types = {name: of.get("type", "enum") for name, of in schema["properties"].items()}
    return {"key": schema["primaryKey"],
            "columns": {name: of if isinstance(of, str) else "|".join(of) for name, of in types.items()}}


found = {}
for metadata in sorted(folder.glob("*.json")):
    for table, told in json.loads(metadata.read_text()).get("tables", {}).items():
        found[table.removesuffix(".csv")] = declaration(told["schema"])
if "--accept" in how:
    file.write_text("{\n" + ",\n".join(f"{json.dumps(table)}: {json.dumps(found[table])}" for table in sorted(found)) + "\n}\n")
declared = json.loads(file.read_text())
tables = found.keys() if "--in-part" in how else found.keys() | declared.keys()
others = [table for table in sorted(tables) if found.get(table) != declared.get(table)]
for table in others:
    print(f"{table}: declared {declared.get(table)}, written {found.get(table)}")
sys.exit(len(others) > 0)
