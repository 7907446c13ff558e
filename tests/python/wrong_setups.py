"""Set-ups as people get them wrong, and what the command and the module are to say of each.

A row is either a note beside the answer (`ends` 0: its code on standard error, a JointWarning in Python) or one line in
place of it (`ends`: the exit code, and with it the exception).
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Optional

import numpy as np

import condyle

ERRORS = {2: condyle.UsageError, 3: condyle.FileError, 4: condyle.MeshError, 6: condyle.ReferenceContactError}


class Scene:
    """A folder with a sample hip, to be spoilt."""

    def __init__(self, folder: Path, bones: condyle.SampleHip, joint_file: str) -> None:
        self.folder, self.bones, self.text = folder, bones, joint_file
        self.mesh("hip_bone.ply", bones.hip_bone)
        self.mesh("femur.ply", bones.femur)
        self.joint()

    def mesh(self, name: str, mesh: condyle.TriMesh, *, scale: float = 1, move: Any = (0, 0, 0), mirror: bool = False,
             flip: bool = False, drop: int = 0) -> None:
        vertices, triangles = mesh.vertices * scale + np.array(move, float), np.array(mesh.triangles)[drop:]
        if mirror:
            vertices[:, 2] *= -1
        condyle.write_mesh(self.folder / name, (vertices, triangles[:, ::-1] if flip else triangles))

    def file(self, name: str, text: str) -> None:
        (self.folder / name).write_text(text, encoding="utf-8")

    def joint(self, *changes: tuple[str, str], more: str = "") -> None:
        """The joint file with the first match of each pattern replaced, and lines at its end."""
        text = self.text
        for pattern, by in changes:
            text, found = re.subn(pattern, lambda _, by=by: by, text, count=1)
            assert found == 1, pattern
        self.file("hip.toml", text + more)

    def path(self, name: str = "hip.toml") -> Path:
        return self.folder / name


Ask = Callable[[Scene], Any]


@dataclass(frozen=True)
class Setup:
    """`spoil` makes it; `command` is asked in its folder, `ask` in Python (None: there is no such thing there)."""

    ends: int
    says: str
    spoil: Callable[[Scene], None] = lambda scene: None
    command: str = "frame hip.toml"
    ask: Optional[Ask] = lambda scene: condyle.read_joint(scene.path()).in_contact(np.eye(4))
    says_in_python: str = ""  # where it differs
    untrue: str = ""  # what neither may say


# The queries.


def changed(*changes: tuple[str, str], more: str = "") -> Callable[[Scene], None]:
    return lambda scene: scene.joint(*changes, more=more)


def deep(**pose: float) -> Ask:
    return lambda scene: condyle.read_joint(scene.path()).depths(pose)


def limits(*motions: str) -> Ask:
    return lambda scene: condyle.read_joint(scene.path()).range_of_motion(motions)


def study(text: str, more: str = "", **options: Any) -> dict[str, Any]:
    return {"spoil": lambda scene: scene.file("table.csv", text), "command": "study table.csv --out out --motion flexion" + more,
            "ask": lambda scene: condyle.run_study(scene.path("table.csv"), scene.path("out"), **options)}


FLEXION = {"motions": ["flexion"]}
IDENTITY = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"

# Loads.
SOFT = {"youngs_modulus_mpa": 12.0, "poisson_ratio": 0.42, "thickness": 1.5}


def layers(fixed: dict[str, Any] = SOFT, mobile: dict[str, Any] = SOFT, *, more: str = "") -> Callable[[Scene], None]:
    """[contact] with these layers on the bones."""
    def table(body: str, layer: dict[str, Any]) -> str:
        return f"[contact.{body}]\n" + "".join(f"{key} = {value}\n" for key, value in layer.items())

    return changed(more=f"[contact]\n{more}" + table("fixed", fixed) + table("mobile", mobile))


def pressed(*given: dict[str, Any], more: str = "") -> dict[str, Any]:
    return {"spoil": layers(*given, more=more), "command": "load hip.toml", "ask": lambda scene: contact(scene).at(np.eye(4))}


def contact(scene: Scene) -> condyle.ElasticContact:
    return condyle.ElasticContact.of_file(condyle.read_joint(scene.path()))


def load(force: str) -> dict[str, Any]:
    """The command refuses a force that the contact does not carry; Python has the reason in its answer."""
    def ask(scene: Scene) -> None:
        balanced = contact(scene).balance([float(each) for each in force.split()])
        if not balanced.carries_load:
            raise condyle.UsageError(balanced.reason)

    return {"spoil": layers(), "command": f"load hip.toml --force {force}", "ask": ask}


# Motions.
COLUMNS = "[recorded_motion]\nflexion = { column = \"flexion\", unit = \"deg\" }\n"


def recorded(table: str, mapping: str = COLUMNS, name: str = "walk.csv") -> dict[str, Any]:
    def spoil(scene: Scene) -> None:
        scene.file(name, table)
        scene.joint(more=mapping)

    def ask(scene: Scene) -> Any:
        joint = condyle.read_joint(scene.path())
        return joint.contact_along(joint.motion(scene.path(name)).X_FM)

    return {"spoil": spoil, "ask": ask, "command": f"motion hip.toml --motion {name} --out out"}


def mesh(name: str, **how: Any) -> Callable[[Scene], None]:
    return lambda scene: scene.mesh(name + ".ply", getattr(scene.bones, name), **how)


def both(**how: Any) -> Callable[[Scene], None]:
    def spoil(scene: Scene) -> None:
        mesh("hip_bone", **how)(scene)
        mesh("femur", **how)(scene)
    return spoil


def axes(anterior: str, superior: str) -> Callable[[Scene], None]:
    return changed((r"anterior = .*", f"anterior = {anterior}"), (r"superior = .*", f"superior = {superior}"))


def axes_named(name: str) -> Callable[[Scene], None]:
    return changed((r"anterior = .*\nsuperior = .*", f'axes = "{name}"'))


def centre(x: str) -> Callable[[Scene], None]:
    return changed((r"centre = .*", f"centre = [{x}, 0.0, 0.0]"))


def line(old: str, new: str) -> Callable[[Scene], None]:
    return changed((f"{re.escape(old)}.*", new))


def copied(of: str, to: str) -> Callable[[Scene], None]:
    return lambda scene: scene.path(to).write_bytes(scene.path(of).read_bytes())  # type: ignore[func-returns-value]


FREE = (('kind = "ball"', 'kind = "free"\njoint = "hip"'),)


def translated(mapping: str, *mm: float) -> dict[str, Any]:
    """A recording of a free joint whose column y holds these values."""
    row = recorded("time,y\n" + "".join(f"{t},{value:g}\n" for t, value in enumerate(mm)))

    def spoil(scene: Scene) -> None:
        row["spoil"](scene)
        scene.joint(*FREE, more=f'[recorded_motion]\ny = {{ column = "y", {mapping} }}\n')

    return {**row, "spoil": spoil}


SETUPS: dict[str, Setup] = {
    # Notes of docs/checks.md.
    "side": Setup(0, "wrong_side", line("side", 'side = "left"')),
    "superior down": Setup(0, "axes_not_upright", axes("[1.0, 0.0, 0.0]", "[0.0, -1.0, 0.0]")),
    "axes turned": Setup(0, "axes_turned", axes("[-1.0, 0.0, 0.0]", "[0.0, 1.0, 0.0]")),
    "LPS for joint axes": Setup(0, "axes_not_upright", axes_named("LPS")),
    "metres": Setup(0, "unlikely_size", line("units", 'units = "m"')),
    "centre 5 mm off": Setup(0, "centre_off_head", centre("5.0")),
    "centre 24 mm off": Setup(0, "centre_off_head", centre("24.0")),
    "centre 30 mm off": Setup(0, "centre_off_head", centre("30.0")),
    "swapped": Setup(0, "swapped_bodies", changed(("hip_bone.ply", "X"), ("femur.ply", "hip_bone.ply"), ("X", "femur.ply"))),
    "mirrored and flipped": Setup(0, "wrong_side", both(mirror=True, flip=True)),
    "mirrored, not flipped": Setup(0, "inverted_mesh", both(mirror=True)),
    "one mirrored": Setup(0, "bodies_disagree", mesh("femur", mirror=True, flip=True)),
    "socket 5 mm off": Setup(0, "head_socket_apart", mesh("hip_bone", move=(0, 5, 0))),
    "open mesh": Setup(0, "open_mesh", mesh("hip_bone", drop=1)),
    "inverted mesh": Setup(0, "inverted_mesh", mesh("femur", flip=True)),
    "head larger than its socket": Setup(0, "socket_smaller_than_head", mesh("femur", scale=1.2)),
    # Joint files.
    "Right": Setup(3, '"right" or "left", not "Right"', line("side", 'side = "Right"')),
    "ras": Setup(3, '"LPS" or "RAS", not "ras"', axes_named("ras")),
    "axis of length 1.005": Setup(3, "length 1.005, not 1", axes("[1.005, 0.0, 0.0]", "[0.0, 1.0, 0.0]")),
    "key twice": Setup(3, "redefine existing", line("side", 'side = "right"\nside = "right"')),
    "misspelt table": Setup(3, 'did you mean "frame"?', changed((r"\[frame\]", "[fraem]"))),
    "misspelt key": Setup(3, 'did you mean "centre"?', changed(("centre", "center"))),
    "misspelt file": Setup(3, "there is no file", changed(("femur.ply", "femr.ply"))),
    "file of json": Setup(3, "unknown extension '.json'", lambda scene: (
        copied("femur.ply", "femur.json")(scene), scene.joint(("femur.ply", "femur.json")))),
    "label map for a mesh": Setup(3, "--label NAME --out BONE.ply makes one of a label", lambda scene: (
        copied("femur.ply", "femur.nii.gz")(scene), scene.joint(("femur.ply", "femur.nii.gz")))),
    "hip as a hinge by name": Setup(3, "a hip is no hinge", line("kind", 'kind = "hinge"\njoint = "hip"')),
    "fit where there is nothing": Setup(4, "no spherical head", changed(
        ("centre = .*", 'centre = "fit"\nfit_within = { centre = [500.0, 0.0, 0.0], radius = 10.0 }'))),
    "no such joint": Setup(3, "nothere.toml: no such file", command="frame nothere.toml",
                           ask=lambda scene: condyle.read_joint(scene.path("nothere.toml"))),
    # Poses and motions.
    "misspelt angle": Setup(2, "flexoin", command="depth hip.toml --pose flexoin=30", ask=deep(flexoin_deg=30)),
    "hinge out of its axis": Setup(2, "a hinge rotates in flexion only", line("kind", 'kind = "hinge"'),
                                   "depth hip.toml --pose adduction=10", deep(adduction_deg=10)),
    "pose that scales": Setup(2, "orthonormal", command="depth hip.toml --pose '2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1'",
                              ask=lambda scene: condyle.read_joint(scene.path()).depths(np.diag([2.0, 2, 2, 1]))),
    "misspelt motion": Setup(2, "flexoin", command="rom hip.toml --motion flexoin", ask=limits("flexoin")),
    "few samples of a band": Setup(2, "20", command="rom hip.toml --band=3", ask=lambda scene: limits("flexion")(scene).bands(samples=3)),
    "map of one angle twice": Setup(
        2, "one is named twice", command="rom hip.toml --map flexion=0:10:5 flexion=0:10:5",
        ask=lambda scene: limits()(scene).map({"flexion": (0, 10, 5)}, {"flexion": (0, 10, 5)})),
    # Loads.
    "Poisson's ratio 0.5": Setup(3, "below 0.5", **pressed({**SOFT, "poisson_ratio": 0.5})),
    "modulus 0": Setup(3, "above 0", **pressed({**SOFT, "youngs_modulus_mpa": 0.0})),
    "thickness -1.5": Setup(3, "above 0", **pressed({**SOFT, "thickness": -1.5})),
    "reach -3": Setup(3, "above 0", **pressed(more="reach = -3.0\n")),
    "unknown law": Setup(3, '"linear" or "logarithmic"', **pressed(more='law = "cubic"\n')),
    "no layers": Setup(2, "layer", command="load hip.toml", ask=lambda scene: condyle.ElasticContact(scene.bones.hip_bone, scene.bones.femur)),
    "thickness and a file of it": Setup(3, "stands beside thickness_file", **pressed({**SOFT, "thickness_file": '"t.txt"'})),
    "moment without rotations": Setup(
        2, "otation", layers(), "load hip.toml --force 0 800 0 --moment 0 0 10",
        lambda scene: contact(scene).balance([0, 800, 0], moment_nmm=[0, 0, 10])),
    "1500 N out of the socket": Setup(2, "pulls the bodies apart", **load("0 -1500 0"), untrue="over the rim"),
    "force of two numbers": Setup(2, "force", layers(), "load hip.toml --force 0 800", lambda scene: contact(scene).balance([0, 800])),
    # Recordings.
    "column without unit": Setup(3, "unit", **recorded("time,flexion\n0,0\n1,10\n", '[recorded_motion]\nflexion = "flexion"\n')),
    "column that is not there": Setup(3, "flexion", **recorded("time,flex\n0,0\n1,10\n")),
    "short row": Setup(3, "line 3", **recorded("time,flexion\n0,0\n1\n")),
    "semicolons": Setup(3, "separated by commas", **recorded("time;flexion\n0;0\n1;10\n")),
    "times equal": Setup(3, "time", **recorded("time,flexion\n0,0\n0,10\n")),
    "unit against the header": Setup(3, "inDegrees", **recorded(
        "walk\nversion=1\nnRows=2\nnColumns=2\ninDegrees=no\nendheader\ntime\tflexion\n0\t0\n1\t0.1\n",
        name="walk.mot")),
    # Studies.
    "misspelt measure": Setup(3, "did you mean 'head_radius_mm'?", **study("id,sample,haed_radius_mm\na,1,25\n", **FLEXION)),
    "matrix for a study": Setup(2, "no matrix", **study("id,joint\na,hip.toml\n", f" --depth '{IDENTITY}'", depth_at=IDENTITY, **FLEXION)),
    "wrong side in a study": Setup(0, "wrong_side", **study("id,fixed,mobile,side\na,hip_bone.ply,femur.ply,left\n", **FLEXION)),
    # Arguments.
    "number after --band": Setup(2, "--band=100", command="rom hip.toml --band 100", ask=None),
    "number after --band, file behind": Setup(2, "--band=100", command="rom --band 100 hip.toml", ask=None),
    "map of one angle": Setup(
        2, "needs two angles", command="rom hip.toml --map flexion=0:10:5",
        ask=lambda scene: condyle.run_study("t.csv", "out", map=({"flexion": (0, 10, 5)},)),  # type: ignore[arg-type]
        says_in_python="two angles are needed"),
    "map of one angle, file behind": Setup(2, "needs two angles", command="rom --map flexion=0:10:5 hip.toml", ask=None),
    "sample knee": Setup(2, "there are hip, cartilages, cohort", command="sample knee --out knee", ask=None),
    "-q": Setup(2, "2>/dev/null", command="depth hip.toml -q", ask=None),
    "misspelt option": Setup(2, 'did you mean "--motion"?', command="rom hip.toml --motoin flexion", ask=None),
    "misspelt command": Setup(2, 'did you mean "depth"?', command="detph hip.toml", ask=None),
    "one argument too many": Setup(2, "'femur.ply' is one argument too many", command="rom hip.toml femur.ply", ask=None),
    "measure that is none": Setup(2, "haed", command="sample hip --haed-radius 24 --out hip",
                                  ask=lambda scene: condyle.sample_hip(haed_radius_mm=24)),
    "measure out of its range": Setup(2, "head_radius_mm", command="sample hip --head-radius 100 --out hip",
                                      ask=lambda scene: condyle.sample_hip(head_radius_mm=100)),
    # Answers without an error.
    "centre 1.5 mm off": Setup(0, "centre_off_head", centre("1.5"), "rom hip.toml", limits("flexion")),
    "hinge on a hip": Setup(0, "unlikely_joint", line("kind", 'kind = "hinge"')),
    "knee on a hip": Setup(0, "unlikely_joint", line("kind", 'kind = "ball"\njoint = "knee"')),
    "same file twice": Setup(0, "same_mesh", changed(("femur.ply", "hip_bone.ply"))),
    "fit with the wrong unit": Setup(0, "unlikely_size", changed(('units = "mm"', 'units = "m"'), ("centre = .*", 'centre = "fit"'))),
    "whole number beyond 2^53": Setup(3, "beyond 2^53", centre("9007199254740993")),
    "centre of 1e17 mm": Setup(3, "rounds the vertices", centre("1e17")),
    "modulus 1e9": Setup(0, "unlikely_modulus", **pressed({**SOFT, "youngs_modulus_mpa": 1e9})),
    "thickness 1500": Setup(0, "unlikely_thickness", **pressed({**SOFT, "thickness": 1500.0})),
    "bone as layer": Setup(0, "layer_on_bone", **pressed({**SOFT, "youngs_modulus_mpa": 17000.0})),
    "1e5 N into the socket": Setup(2, "too large", **load("0 1e5 0"), untrue="over the rim"),
    "90 rad": Setup(0, "unlikely_angle", **recorded("time,flexion\n0,0\n1,30\n2,60\n3,90\n", COLUMNS.replace("deg", "rad"))),
    "mm read as m": Setup(0, "unlikely_translation", **translated('unit = "m"', 0, 1, 2)),
    "sign -1": Setup(0, "mostly_deep", **translated('unit = "mm", sign = -1', -22, -23, -24)),
}
