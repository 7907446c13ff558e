"""Every example of help() runs."""

import doctest
import functools
import importlib
import pkgutil

import numpy as np
import pytest

import condyle

MODULES = ["condyle"] + [f"condyle.{found.name}" for found in pkgutil.iter_modules(condyle.__path__)
                         if found.name.startswith("_") and not found.name.startswith(("_native", "__"))]


# Nothing can change a mesh, so that the examples share theirs.
shared_hip = functools.cache(condyle.sample_hip)


@pytest.mark.parametrize("name", MODULES)
def test_examples(name, monkeypatch):
    monkeypatch.setattr(condyle, "sample_hip", shared_hip)
    module = importlib.import_module(name)
    with np.printoptions(legacy=False):
        assert doctest.testmod(module, optionflags=doctest.ELLIPSIS).failed == 0
