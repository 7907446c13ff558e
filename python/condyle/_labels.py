"""Label maps: images that say of each voxel which bone it belongs to, and surfaces made of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional, Sequence, Union, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import JointRemark, UsageError, warn
from ._mesh import TriMesh
from ._native import BodyImage
from ._native import LabelMap as NativeLabelMap
from ._words import Affine, Cavities, ImageAxes, ImageAxis, ImageSide, LabelTask, Path, Pieces, Progress, Side, count
from ._words import number, number_array, path_of, progress_of, text_of, word

LabelLike = Union[int, str]


@dataclass(frozen=True)
class LabelNote:
    """A warning on a label map or on a bone in it: `code` as in files ("cut_by_view"), `text` one sentence."""

    code: str
    text: str


@dataclass(frozen=True)
class Label:
    """One label of a label map, above 0.

    `first` and `size` are of the smallest box of voxels that holds it; `reaches_border`: whether it reaches the image's first
    and last voxels along i, j and k, where the field of view may have cut it.
    """

    label: int
    layer: int
    names: tuple[str, ...]
    voxels: int
    first: tuple[int, int, int]
    size: tuple[int, int, int]
    reaches_border: tuple[bool, bool, bool, bool, bool, bool]


@dataclass(frozen=True)
class LabelPiece:
    """Voxels of a bone that hang together over faces, edges or corners, and whether the surface has them."""

    voxels: int
    volume_mm3: float
    kept: bool


@dataclass(frozen=True)
class SurfaceCut:
    """A flat face that closes a bone where its image ends, normal . p = offset_mm: no contact on it is one of bones."""

    axis: ImageAxis
    side: ImageSide
    normal: NDArray[np.float64]
    offset_mm: float
    area_mm2: float
    triangles: NDArray[np.uint32]


class LabelSurface:
    """The surface of one bone, closed, and where it comes from. Joint() takes it as a mesh.

    Attributes
    ----------
    mesh : TriMesh
        In mm, in the world of its image.
    cuts : tuple of SurfaceCut
    pieces : tuple of LabelPiece
        Most voxels first.
    cavities : (count, voxels, volume in mm3)
        Closed ones, such as marrow; filled if not kept.
    spacing_mm : (3,)
    digitisation_mm : float
        About the largest distance of the surface from the boundary that was digitised; the error of the segmentation is not in it.
    simplification_error_mm : float or None
        For a simplified surface: its distance from the one before.
    name, label, voxels
        Name, label and number of voxels of the bone in its label map; the name is "" for arrays.
    notes : tuple of LabelNote
    """

    __slots__ = ("mesh", "cuts", "pieces", "cavities", "spacing_mm", "digitisation_mm", "simplification_error_mm", "name",
                 "label", "voxels", "notes", "_image")

    mesh: TriMesh
    cuts: tuple[SurfaceCut, ...]
    pieces: tuple[LabelPiece, ...]
    cavities: tuple[int, int, float]
    spacing_mm: NDArray[np.float64]
    digitisation_mm: float
    simplification_error_mm: Optional[float]
    name: str
    label: int
    voxels: int
    notes: tuple[LabelNote, ...]
    _image: BodyImage

    def __repr__(self) -> str:
        return f"LabelSurface({self.name or self.label!r}: {self.voxels} voxels, {self.mesh!r})"


def _surface_of(found: dict[str, Any]) -> LabelSurface:
    made = LabelSurface.__new__(LabelSurface)
    made.mesh = TriMesh._of_native(found["mesh"])
    made.cuts = tuple(SurfaceCut(*cut) for cut in found["cuts"])
    made.pieces = tuple(LabelPiece(*piece) for piece in found["pieces"])
    made.cavities = found["cavities"]
    made.spacing_mm, made.digitisation_mm = found["spacing_mm"], found["digitisation_mm"]
    made.simplification_error_mm = found["simplification_error_mm"]
    made.name, made.label, made.voxels = found.get("name", ""), found["label"], found["voxels"]
    made.notes = label_notes(found.get("notes", ()))
    made._image = found["image"]
    return made


class LabelMap:
    """A label map that was read. Its world is LPS in mm: x to the left, y to posterior, z to superior."""

    __slots__ = ("_native", "_file", "_labels")

    def __init__(self, native: NativeLabelMap, file: str) -> None:
        self._native, self._file = native, file
        self._labels: Optional[tuple[Label, ...]] = None

    @property
    def size(self) -> tuple[int, int, int]:
        """Voxels along i, j and k."""
        i, j, k = self._native.size
        return i, j, k

    @property
    def lps_from_index(self) -> NDArray[np.float64]:
        """(4, 4): the centre of voxel (i, j, k) is at lps_from_index @ (i, j, k, 1), mm."""
        matrix: NDArray[np.float64] = self._native.lps_from_index
        return matrix

    @property
    def labels(self) -> tuple[Label, ...]:
        """Every label above 0, by layer and then by number."""
        if self._labels is None:
            self._labels = tuple(Label(*each) for each in self._native.labels())
        return self._labels

    @property
    def notes(self) -> tuple[LabelNote, ...]:
        return label_notes(self._native.notes)

    def voxels(self, layer: int = 0) -> NDArray[np.uint32]:
        """(I, J, K) the label of each voxel of a layer."""
        voxels: NDArray[np.uint32] = self._native.voxels(count(layer, "layer"))
        return voxels

    def surface(self, label: Optional[LabelLike] = None, *, task: Optional[LabelTask] = None, pieces: Pieces = "largest",
                cavities: Cavities = "fill", triangles: Optional[int] = None, progress: Progress = None) -> LabelSurface:
        """The surface of one bone: of a number, or of a name that the file or the table of `task` has.

        Without `label` the only label of the map. `triangles`: simplified to about so many. UsageError for a label that is not
        there or means several, MeshError for one too small for a bone.

        C++: `condyle::bone_of` in condyle/io/label_file.hpp; `condyle surface`.
        """
        return _surface_of(_native.label_bone(
            self._native, self._file, _label_text(label, "label"), "" if task is None else word(task, "task", LabelTask),
            _surface_options(pieces, cavities, triangles), progress_of(progress)))

    def __repr__(self) -> str:
        return f"LabelMap({self._file!r}: {' x '.join(map(str, self.size))} voxels, {len(self.labels)} labels)"


def read_labels(path: Path, *, affine: Optional[Affine] = None, volume: Optional[int] = None,
                axes: Optional[ImageAxes] = None, elsewhere: bool = False) -> LabelMap:
    """Reads a label map: NIfTI (.nii, .nii.gz, .hdr), NRRD (.nrrd, .nhdr) or MetaImage (.mha, .mhd).

    Parameters
    ----------
    affine : "sform" or "qform", optional
        Which of the two places that a NIfTI file gives its voxels; not given: sform, else qform.
    volume : int, optional
        Number of the label map in a NIfTI file with several, from 0.
    axes : "LPS", "RAS" or "LAS", optional
        The directions of an image that gives none, and is refused otherwise.
    elsewhere : bool
        Whether a header may name data outside its own folder.

    FileError where the file cannot be read, naming the element.

    C++: `condyle::read_labels` in condyle/io/label_file.hpp; `condyle inspect`.
    """
    file = path_of(path, "path")
    return LabelMap(_native.read_labels(
        file, "" if affine is None else word(affine, "affine", Affine),
        None if volume is None else count(volume, "volume"),
        "" if axes is None else word(axes, "axes", ImageAxes), bool(elsewhere)), str(file))


def surface(labels: ArrayLike, affine: ArrayLike, label: Optional[int] = None, *, pieces: Pieces = "largest",
            cavities: Cavities = "fill", triangles: Optional[int] = None, sigma_voxels: float = 0.65,
            progress: Progress = None) -> LabelSurface:
    """The surface of the voxels of an array that have this label, as nibabel and SimpleITK users hold them.

    Parameters
    ----------
    labels : (I, J, K) integers or booleans
        Without `label` every voxel other than 0.
    affine : (4, 4) numbers
        World coordinates in mm of the centre of voxel (i, j, k): those of nibabel are RAS, those of SimpleITK LPS, whose arrays are
        (K, J, I). The surface is in this world; Joint() takes its name as `axes`.
    sigma_voxels : float
        Standard deviation of the Gaussian that smooths the voxels, 0 to 4.

    C++: `condyle::surface_of` in condyle/label_surface.hpp.

    >>> import condyle, numpy as np
    >>> i, j, k = np.indices((60, 60, 60))
    >>> ball = (i - 30) ** 2 + (j - 30) ** 2 + (k - 30) ** 2 < 24 ** 2
    >>> found = condyle.surface(ball, np.eye(4))
    >>> found.mesh.is_closed, len(found.cuts)
    (True, 0)
    """
    voxels = np.asarray(labels)
    if voxels.ndim != 3 or voxels.dtype.kind not in "biu":
        raise UsageError(f"labels: an array of shape (I, J, K) of whole numbers is needed, not {voxels.dtype} of shape "
                         f"{voxels.shape}")
    matrix = number_array(affine, "affine", "numbers of shape (4, 4)")
    if matrix.shape != (4, 4) or (matrix[3] != (0, 0, 0, 1)).any():
        raise UsageError("affine: (4, 4) numbers are needed, with the last row 0, 0, 0, 1")
    inside = voxels != 0 if label is None else voxels == count(label, "label", high=2**32 - 1)
    box = []
    for axis in range(3):
        there = np.flatnonzero(inside.any(axis=tuple(other for other in range(3) if other != axis)))
        if len(there) == 0:
            raise UsageError("labels: no voxel has the label")
        box.append((int(there[0]), int(there[-1]) + 1))
    bone = np.asfortranarray(inside[tuple(slice(*side) for side in box)], dtype=np.uint8)
    options = {**_surface_options(pieces, cavities, triangles), "sigma_voxels": number(sigma_voxels, "sigma_voxels", 0, 4)}
    found = _native.mask_surface(bone, [low for low, _ in box], list(voxels.shape), matrix, options, progress_of(progress))
    return _surface_of({**found, "label": 0 if label is None else label, "voxels": int(np.count_nonzero(bone))})


def joint_bones(labels: Union[LabelMap, Path], fixed: Optional[LabelLike], mobile: Optional[LabelLike],
                mobile_labels: Union[LabelMap, Path, None], task: Optional[LabelTask], side: Optional[str], pieces: Pieces,
                cavities: Cavities, triangles: Optional[int], progress: Progress
                ) -> tuple[LabelSurface, LabelSurface, Side]:
    """Both bones and the side of a joint; warns of the notes."""
    first = labels if isinstance(labels, LabelMap) else read_labels(labels)
    second = mobile_labels if mobile_labels is None or isinstance(mobile_labels, LabelMap) else read_labels(mobile_labels)
    bone, other, found, missing, notes = _native.label_joint(
        first._native, None if second is None else second._native, first._file, None if second is None else second._file,
        [_label_text(fixed, "fixed"), _label_text(mobile, "mobile")], "" if task is None else word(task, "task", LabelTask),
        side or "", _surface_options(pieces, cavities, triangles), progress_of(progress))
    if missing:
        raise UsageError(f"cannot be inferred from the bones: {'; '.join(missing)}")
    for note in label_notes(notes):
        warn(f"{note.code}: {note.text}", JointRemark)
    return _surface_of(bone), _surface_of(other), cast(Side, found)


def label_notes(found: Sequence[tuple[str, str]]) -> tuple[LabelNote, ...]:
    return tuple(LabelNote(code, text) for code, text in found)


def _label_text(label: Optional[LabelLike], what: str) -> str:
    if label is None:
        return ""
    if isinstance(label, str):
        return text_of(label, what)
    return str(count(label, what, high=2**32 - 1))


def _surface_options(pieces: Pieces, cavities: Cavities, triangles: Optional[int]) -> dict[str, Any]:
    return {"all_pieces": word(pieces, "pieces", Pieces) == "all", "keep_cavities": word(cavities, "cavities", Cavities) == "keep",
            "triangles": None if triangles is None else count(triangles, "triangles"), "sigma_voxels": 0.65}
