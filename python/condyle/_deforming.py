"""Contacts whose bodies may deform."""

from __future__ import annotations

from typing import Optional, Union

from numpy.typing import ArrayLike

from . import _native
from ._mesh import TriMesh, merged_positions, refuse_merged
from ._shared_use import SharedUse
from ._words import Body, word


class DeformingContact:
    """A contact of two bodies that any thread may ask and any thread may deform."""

    __slots__ = ("_native", "_fixed", "_mobile", "_shared")

    _native: Union[_native.JointContact, _native.ElasticContact]
    _fixed: TriMesh
    _mobile: TriMesh
    _shared: SharedUse

    def update(self, body: Body, vertices: ArrayLike, *, moved: Optional[ArrayLike] = None) -> None:
        """A body has deformed: (V, 3) new positions of all its vertices in its own frame, or of the K vertices `moved` (K,).

        Answers are then those of a contact made anew, to the bit; vertices inside may come in another order, and thicknesses
        stay with their vertices. UsageError where numbers do not fit, MeshError where a coordinate is not finite or the surface
        now holds the centre of radial depths; the contact is then what it was. Waits for questions of other threads.
        docs/deforming.md has the cost.

        C++: `update` of `condyle::contact::JointContact` and `condyle::contact::ElasticContact`.
        """
        is_fixed = word(body, "body", Body) == "fixed"
        mesh = self._fixed if is_fixed else self._mobile
        with self._shared.change("update"):
            if moved is None:
                self._native.update(is_fixed, merged_positions(mesh, vertices))
            else:
                refuse_merged(mesh)
                self._native.update_some(is_fixed, moved, vertices)

    @property
    def fixed(self) -> TriMesh:
        """The mesh of the fixed body as it is now."""
        with self._shared.use():
            return TriMesh._moved(self._native.fixed, self._fixed)

    @property
    def mobile(self) -> TriMesh:
        """The mesh of the mobile body as it is now."""
        with self._shared.use():
            return TriMesh._moved(self._native.mobile, self._mobile)
