"""Judges run files by a JSON Schema: validate_run_files.py SCHEMA.json FILE...; one line each, `accepted FILE` or
`rejected FILE: why`. An independent reader (PyYAML with the numbers of YAML 1.2) and validator (python3-jsonschema)."""
import json
import re
import sys

import jsonschema
import yaml


class Loader(yaml.SafeLoader):
    pass


KEPT = ("tag:yaml.org,2002:null", "tag:yaml.org,2002:merge")
Loader.yaml_implicit_resolvers = {
    first: [(tag, pattern) for tag, pattern in entries if tag in KEPT]
    for first, entries in yaml.SafeLoader.yaml_implicit_resolvers.items()
}
Loader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile(r"^(true|false)$"), list("tf"))
Loader.add_implicit_resolver("tag:yaml.org,2002:int", re.compile(r"^[-+]?[0-9]+$"), list("-+0123456789"))
Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(r"^[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?$"),
    list("-+0123456789."),
)


def judge(validator, name):
    try:
        with open(name, encoding="utf-8") as stream:
            document = yaml.load(stream, Loader=Loader)
    except (yaml.YAMLError, UnicodeDecodeError, RecursionError, ValueError, OSError) as error:
        return "rejected " + name + ": no YAML: " + type(error).__name__
    try:
        fault = jsonschema.exceptions.best_match(validator.iter_errors(document))
    except RecursionError:
        return "rejected " + name + ": nested too deeply"
    if fault is None:
        return "accepted " + name
    return "rejected " + name + ": " + " ".join(fault.message.split())[:200]


def main():
    with open(sys.argv[1], encoding="utf-8") as stream:
        schema = json.load(stream)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    for name in sys.argv[2:]:
        print(judge(validator, name))


main()
