"""Two bodies that deform."""

from __future__ import annotations

from typing import Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._deforming import DeformingContact
from ._mesh import MeshLike, TriMesh
from ._penetration import Penetration, Penetrations, vertices_inside
from ._pressure import ManyMatrices, OneMatrix
from ._shared_use import SharedUse
from ._words import Bodies, Progress, array, progress_of, word


class JointContact(DeformingContact):
    """A fixed and a mobile body, each in its own frame with the joint centre as origin, which may deform.

    The answers of a :class:`Joint`, which nothing changes, for bodies that a simulation moves vertex by vertex. Tables and
    trees are built when the first question needs them, and follow the bodies. Any number of threads may ask; an update waits
    for those before it.

    Parameters
    ----------
    fixed, mobile : mesh
        Each a :class:`TriMesh` or what :meth:`TriMesh.of` takes.

    C++: `condyle::contact::JointContact` in condyle/contact.hpp.

    >>> import numpy as np
    >>> import condyle
    >>> layers = condyle.sample_cartilages(clearance_mm=0.1)
    >>> contact = condyle.JointContact(layers.acetabular, layers.femoral)
    >>> len(contact.penetration(np.eye(4)).mobile)
    0
    >>> contact.update("mobile", 1.01 * layers.femoral.vertices)
    >>> contact.penetration(np.eye(4)).max_depth_mm > 0.1
    True
    """

    __slots__ = ("__weakref__",)

    _native: _native.JointContact

    def __init__(self, fixed: MeshLike, mobile: MeshLike) -> None:
        self._fixed, self._mobile = TriMesh.of(fixed), TriMesh.of(mobile)
        self._native = _native.JointContact(self._fixed._native, self._mobile._native)
        self._shared = SharedUse()

    @overload
    def penetration(self, pose: OneMatrix, *, bodies: Bodies = "both", progress: Progress = None) -> Penetration: ...

    @overload
    def penetration(self, pose: ManyMatrices, *, bodies: Bodies = "both", progress: Progress = None) -> Penetrations: ...

    def penetration(self, pose: ArrayLike, *, bodies: Bodies = "both", progress: Progress = None) -> Penetration:
        """Which vertices of each body are inside the other one, and how deep along rays from the joint centre.

        X_FM (4, 4), or (N, 4, 4) for :class:`Penetrations`. MeshError where the joint centre lies on a surface.
        """
        word(bodies, "bodies", Bodies)
        with self._shared.use():
            is_one, mobile, fixed = self._native.radial(
                pose, bodies != "fixed", bodies != "mobile", progress_of(progress))
        inside = vertices_inside(mobile, self._mobile, is_one), vertices_inside(fixed, self._fixed, is_one)
        if is_one:
            return Penetration(*inside, "radial")
        return Penetrations(*inside, "radial", count=len(array(pose, "pose", "an array of shape (N, 4, 4)")))

    @overload
    def pairs(self, pose: OneMatrix, *, progress: Progress = None) -> NDArray[np.uint32]: ...

    @overload
    def pairs(self, pose: ManyMatrices, *, progress: Progress = None) -> list[NDArray[np.uint32]]: ...

    def pairs(self, pose: ArrayLike, *, progress: Progress = None
              ) -> Union[NDArray[np.uint32], list[NDArray[np.uint32]]]:
        """The exact set of triangle pairs that meet, (K, 2), ascending; of N poses a list of N. Open meshes too."""
        with self._shared.use():
            is_one, found, offset = self._native.pairs(pose, progress_of(progress))
        return found if is_one else [found[first:last] for first, last in zip(offset[:-1], offset[1:])]

    @overload
    def in_contact(self, pose: OneMatrix, *, progress: Progress = None) -> bool: ...

    @overload
    def in_contact(self, pose: ManyMatrices, *, progress: Progress = None) -> NDArray[np.bool_]: ...

    def in_contact(self, pose: ArrayLike, *, progress: Progress = None) -> Union[bool, NDArray[np.bool_]]:
        """Whether the bodies share a point: a bool, of N poses (N,) bool."""
        with self._shared.use():
            is_one, answers = self._native.in_contact(pose, progress_of(progress))
        return bool(answers[0]) if is_one else answers

    def __repr__(self) -> str:
        return f"JointContact(fixed={self._fixed!r}, mobile={self._mobile!r})"
