"""Calls a function of the modules in this folder and prints what it returns.

    call.py <module>.<function> [arguments]

Arguments are converted by the annotations of the function. Numbers are printed with six
digits, tuples in one line.
"""
import importlib
import inspect
import os
import sys


def converted(function, words):
    """Words of a command as the arguments that the function declares."""
    parameters = list(inspect.signature(function).parameters.values())
    if parameters and parameters[-1].kind is inspect.Parameter.VAR_POSITIONAL:
        parameters += parameters[-1:] * len(words)
    types = [str if p.annotation is inspect.Parameter.empty else p.annotation for p in parameters]
    return [types[i](word) if i < len(types) else word for i, word in enumerate(words)]


def text(value):
    if isinstance(value, (tuple, list)):
        return " ".join(map(text, value))
    return str(value) if isinstance(value, (int, str)) else "%.6g" % value


def main(name, *words):
    module, _, function = name.partition(".")
    function = getattr(importlib.import_module(module), function)
    value = function(*converted(function, words))
    if value is not None:
        print(text(value))


if __name__ == "__main__":
    main(*sys.argv[1:])
