"""Every example of help() runs."""

import doctest
import importlib
import pkgutil

import numpy as np
import pytest

import condyle

MODULES = ["condyle"] + [f"condyle.{found.name}" for found in pkgutil.iter_modules(condyle.__path__)
                         if found.name.startswith("_") and not found.name.startswith(("_native", "__"))]


@pytest.mark.parametrize("name", MODULES)
def test_examples(name):
    module = importlib.import_module(name)
    with np.printoptions(legacy=False):
        assert doctest.testmod(module, optionflags=doctest.ELLIPSIS).failed == 0
