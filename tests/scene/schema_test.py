"""The JSON Schema of scenes: accepts every example, and refuses the bad scenes whose fault is one
of structure. Usage: schema_test.py PROJECT_FOLDER"""

import json
import pathlib
import sys

import jsonschema
import yaml

# What no schema can see: names, geometry, and the limits of the reader.
BEYOND_SCHEMA = {
    "both-sides-of-solid",
    "camera-looks-at-itself",
    "camera-up-along-view",
    "complement-of-open-shape",
    "csg-of-open-shape",
    "degenerate-shape",
    "disjoint-intersection",
    "height-field-ragged",
    "implicit-empty",
    "implicit-function",
    "infinite-length",
    "inverted-box",
    "light-black",
    "light-of-csg",
    "mesh-index",
    "nested-too-deep",
    "nurbs-knot-count",
    "nurbs-knot-nan",
    "nurbs-knot-repeated",
    "nurbs-knots-fall",
    "nurbs-knots-stand-still",
    "nurbs-ragged",
    "nurbs-weights-missing",
    "prism-in-plane",
    "reflectance-nan",
    "repeated-key",
    "repeated-material",
    "revolution-crosses-itself",
    "singular-matrix",
    "sky-nan",
    "sky-negative",
    "sky-too-bright",
    "sky-without-sun",
    "sweep-radii",
    "sweep-stands-still",
    "unknown-material",
    "yaml-alias-bomb",
    "yaml-tag",
}


def main(project):
    schema = json.loads((project / "docs/scene.schema.json").read_text())
    validator_class = jsonschema.validators.validator_for(schema)
    validator_class.check_schema(schema)
    validator = validator_class(schema)
    faults = []

    examples = sorted(
        path
        for path in (project / "examples").rglob("*.yaml")
        if not path.name.endswith(".lights.yaml")  # beside models of other formats
    )
    for path in examples:
        for error in validator.iter_errors(yaml.safe_load(path.read_text())):
            faults.append(f"{path}: {error.json_path}: {error.message}")

    refused = 0
    for path in sorted((project / "tests/scene/bad").glob("*.yaml")):
        if path.stem in BEYOND_SCHEMA:
            continue
        try:
            scene = yaml.safe_load(path.read_text())
        except (yaml.YAMLError, UnicodeDecodeError):
            continue
        if validator.is_valid(scene):
            faults.append(f"{path}: the schema accepts it")
        refused += 1

    if not examples or refused < 20:
        faults.append(f"only {len(examples)} examples and {refused} bad scenes were found")
    print("\n".join(faults) or f"{len(examples)} examples accepted, {refused} bad scenes refused")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
