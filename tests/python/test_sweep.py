"""Sweeps over parameters of parts, as the command has them."""

import json
import pickle

import numpy as np
import pytest
from common import refused, rows_of, run_command

import condyle

VARY = {"cup.inclination": (30, 50, 10), "cup.anteversion": (-20, 40, 10)}
TARGETS = [("sitting", "flexion", 110, -5), condyle.Target("pivoting", "external_rotation", 40)]
TABLE = "name,motion,reach_deg,pelvic_tilt_deg\nsitting,flexion,110,-5\npivoting,external_rotation,40,\n"

pytestmark = pytest.mark.filterwarnings("ignore::condyle.JointRemark")


@pytest.fixture(scope="module")
def hip():
    return condyle.sample_replacement(facets=120).joint


@pytest.fixture(scope="module")
def zone(hip):
    return hip.sweep(VARY, TARGETS, band_samples=20, seed=3)


@pytest.fixture(scope="module")
def by_command(sampled, tmp_path_factory):
    """What the command writes of the same sweep."""
    folder = sampled(tmp_path_factory.mktemp("swept"), "replacement", "--facets", "120")
    (folder / "daily.csv").write_text(TABLE)
    run_command("sweep", folder / "hip.toml", "--vary", "cup.inclination=30:50:10 cup.anteversion=-20:40:10", "--targets", folder / "daily.csv",
                "--band=20", "--seed", "3", "--out", folder / "zone")
    return folder / "zone"


def test_it_is_that_of_the_command(zone, by_command):
    said = json.loads((by_command / "sweep.json").read_text())
    rows = rows_of(by_command / "designs.csv")
    assert list(zone.axes) == [each["name"] for each in said["parameters"]]
    inclination, anteversion = (axis.ravel() for axis in np.meshgrid(*zone.axes.values(), indexing="ij"))
    for i, row in enumerate(rows):
        at = np.unravel_index(i, zone.margin_deg.shape)
        assert (float(row["cup.inclination"]), float(row["cup.anteversion"])) == (inclination[i], anteversion[i])
        assert float(row["probability"]) == zone.probability[at]
        assert int(row["safe"]) == zone.safe[at]
        if row["margin_deg"]:
            assert float(row["margin_deg"]) == zone.margin_deg[at]
        else:
            assert np.isnan(zone.margin_deg[at])
        for t, target in enumerate(zone.targets):
            assert float(row[f"{target.name}_limit_deg"] or "nan") == pytest.approx(zone.limits_deg[at][t], abs=0, nan_ok=True)
            assert row[f"{target.name}_reason"] == condyle.REASONS[zone.reason[at][t]]
            assert row[f"{target.name}_known_by"] == condyle.KNOWN_BY[zone.known_by[at][t]]
            pair = zone.ended_by[at][t]
            by = "" if pair < 0 else f"{zone.pairs[pair].mobile} on {zone.pairs[pair].fixed}"
            assert row[f"{target.name}_ended_by"] == by
    safe = rows_of(by_command / "safe.csv")
    assert len(safe) == len(zone.safe_intervals) > 1
    for row, interval in zip(safe, zone.safe_intervals):
        assert float(row["cup.inclination"]) == interval.values["cup.inclination"]
        assert float(row["cup.anteversion_low"]) == interval.low and float(row["cup.anteversion_high"]) == interval.high
        assert row["low_target"] == (interval.low_target or "") and row["high_target"] == (interval.high_target or "")
    assert (zone.safe_measure, zone.window_measure) == (said["safe_measure"], said["window_measure"])
    assert zone.best.values == said["best"]["values"] and zone.best.margin_deg == said["best"]["margin_deg"]
    assert zone.best.margin_deg == np.nanmax(zone.margin_deg)
    assert zone.here.values == said["here"]["values"]
    assert list(zone.here.limits_deg) == [each["limit_deg"] for each in said["here"]["limits"]]
    assert [note.text for note in zone.notes] == [note["text"] for note in said["sweep_notes"] + said["notes"]]
    assert zone.caveats == said["caveats"]


def test_a_table_is_read_as_the_command_reads_it(hip, zone, tmp_path):
    (tmp_path / "daily.csv").write_text(TABLE)
    read = hip.sweep(VARY, tmp_path / "daily.csv")
    assert read.targets == zone.targets and read.targets[0].pelvic_tilt_deg == -5
    assert np.array_equal(read.limits_deg, zone.limits_deg, equal_nan=True)
    assert read.probability is None


def test_the_best_design_is_by_weights_or_by_least_change_as_the_command_finds_it(hip, zone, by_command):
    (by_command.parent / "weighted.csv").write_text("name,motion,reach_deg,weight\nsitting,flexion,110,4\npivoting,external_rotation,40,\n")
    targets = [condyle.Target("sitting", "flexion", 110, weight=4), ("pivoting", "external_rotation", 40)]
    bests = {}
    for best in ("largest_margin", "least_change"):
        ran = run_command("sweep", by_command.parent / "hip.toml", "--vary", "cup.inclination=30:50:10 cup.anteversion=-20:40:10", "--targets",
                          by_command.parent / "weighted.csv", "--best", best.replace("_", "-"), "--json")
        said = json.loads(ran.stdout)
        swept = hip.sweep(VARY, targets, best=best)
        assert swept.best.values == said["best"]["values"] and swept.best_by == said["best_by"] == best
        assert [each["weight"] for each in said["targets"]] == [each.weight for each in swept.targets] == [4, 1]
        bests[best] = swept
    over = bests["largest_margin"].limits_deg - np.array([110, 40])
    margins = np.minimum(over[..., 0] / 4, over[..., 1])
    at = [list(axis).index(value) for axis, value in zip(zone.axes.values(), bests["largest_margin"].best.values.values())]
    assert margins[tuple(at)] == np.nanmax(margins)
    near = bests["least_change"]
    assert near.best.margin_deg >= 0
    steps = np.array([[abs(a - near.here.values["cup.inclination"]) / 10 + abs(b - near.here.values["cup.anteversion"]) / 10
                       for b in zone.axes["cup.anteversion"]] for a in zone.axes["cup.inclination"]])
    at = [list(axis).index(value) for axis, value in zip(zone.axes.values(), near.best.values.values())]
    assert steps[tuple(at)] == steps[near.safe].min()
    refused(lambda: hip.sweep(VARY, [condyle.Target("sitting", "flexion", 110, weight=0)]), "weight")


def test_its_files_are_those_of_the_command_but_where_it_comes_from(zone, by_command, tmp_path):
    zone.write(tmp_path)
    for name in ("designs.csv", "safe.csv", "zone.vtp"):
        assert (tmp_path / name).read_bytes() == (by_command / name).read_bytes(), name


def test_limits_are_those_of_joints_with_these_parameters(hip, zone):
    for i, inclination in enumerate(zone.axes["cup.inclination"]):
        moved = hip.with_parameters({"cup.inclination": inclination, "cup.anteversion": zone.axes["cup.anteversion"][3]})
        limit = moved.range_of_motion(["external_rotation"]).limits[0]
        # Meshes of 120 facets lie near the closed form that stands for them.
        assert zone.limits_deg[i, 3, 1] == pytest.approx(limit.limit_deg, abs=0.02)


def test_one_parameter_and_a_motion_of_its_own(hip):
    own = condyle.Motion("tailor", "external_rotation", 60, {"flexion": 80, "adduction": -20})
    line = hip.sweep({"stem.version": (0, 30, 10)}, [("tailor", own, 25), ("turning", "internal_rotation_at_90_flexion", 20)])
    assert line.limits_deg.shape == (4, 2) and line.margin_deg.shape == (4,)
    motion = line.targets[0].motion
    assert (motion.name, motion.vary, motion.range_deg) == (own.name, own.vary, pytest.approx(own.range_deg))
    assert motion.start_deg["flexion"] == pytest.approx(80)
    # A stem's version adds itself to internal rotation where neck and liner end it.
    assert line.limits_deg[1, 1] - line.limits_deg[0, 1] == pytest.approx(10, abs=0.01)
    assert all(interval.values == {} for interval in line.safe_intervals)


def test_it_becomes_a_dataset(zone):
    pytest.importorskip("xarray")
    data = zone.to_xarray()
    assert data.limit_deg.dims == ("cup.inclination", "cup.anteversion", "target")
    assert float(data.margin_deg.sel({"cup.inclination": 40, "cup.anteversion": 10})) == zone.margin_deg[1, 3]
    assert set(np.unique(data.known_by)) <= set(condyle.KNOWN_BY)


def test_it_is_pickled_without_its_files(zone, tmp_path):
    copy = pickle.loads(pickle.dumps(zone))
    assert np.array_equal(copy.limits_deg, zone.limits_deg, equal_nan=True) and repr(copy) == repr(zone)
    refused(lambda: copy.write(tmp_path), "pickled")


def test_a_pickled_joint_has_its_implant(hip, zone):
    again = pickle.loads(pickle.dumps(hip)).sweep(VARY, TARGETS)
    assert np.array_equal(again.limits_deg, zone.limits_deg, equal_nan=True)
    assert np.array_equal(again.known_by, zone.known_by)


def test_its_zone_is_noted(hip):
    with pytest.warns(condyle.JointRemark, match="nothing_is_safe"):
        zone = hip.sweep({"cup.anteversion": (-40, -20, 10)}, TARGETS)
    assert [note.code for note in zone.notes] == ["nothing_is_safe"]


@pytest.mark.parametrize("vary, targets, words", [
    ({"cup.inclinaton": (30, 50, 10)}, TARGETS, 'did you mean "cup.inclination"'),
    ({"cup.inclination": (30, 50)}, TARGETS, "a first and a last value and a step"),
    ({"cup.inclination": (30, "a", 1)}, TARGETS, "a number is needed"),
    ({3: (30, 50, 1)}, TARGETS, "a text is needed"),
    ([1], TARGETS, "parameters by their names"),
    ({}, TARGETS, "one to four parameters"),
    (VARY, [("a", "flexoin", 20)], "flexoin"),
    (VARY, [("a", "flexion")], "name, motion and reach_deg"),
    (VARY, [("a", "flexion", "far")], "target a: reach_deg: a number is needed"),
    (VARY, 3, "targets: a path is needed"),
])
def test_what_cannot_be_swept_is_refused(hip, vary, targets, words):
    refused(lambda: hip.sweep(vary, targets), words)


def test_a_wrong_table_is_refused_with_its_line(hip, tmp_path):
    (tmp_path / "daily.csv").write_text("name,motion,reach_deg\na,flexion,far\n")
    refused(lambda: hip.sweep(VARY, tmp_path / "daily.csv"), "daily.csv: line 2: reach_deg: 'far' is no number", condyle.FileError)


def test_it_measures_and_loads_each_design_as_the_joint_at_its_values(sampled, tmp_path):
    sampled(tmp_path, "hip")
    with open(tmp_path / "hip.toml", "a") as file:
        file.write('[contact]\nfixed = { youngs_modulus_mpa = 10.0, poisson_ratio = 0.45, thickness = 2.0 }\n'
                   '[[part]]\nname = "pelvis"\nbody = "fixed"\n[[part.parameter]]\nname = "frontal"\nrange = [-20, 20]\n')
    joint = condyle.read_joint(tmp_path / "hip.toml")
    key = "centre_edge_lateral_section_deg"
    zone = joint.sweep({"pelvis.frontal": (-10, 10, 10)}, [("bent", "flexion", 60)], measures=[key], load="flexion=150")
    measured = zone.quantities["measured_" + key]
    for value, found in zip(zone.axes["pelvis.frontal"], measured):
        assert found == joint.with_parameters({"pelvis.frontal": value}).measures()[key].value
    assert np.diff(measured) == pytest.approx(10, abs=1e-3)  # a frontal turn adds as much to the edge
    assert zone.here.quantities["measured_" + key] == measured[1]
    assert (zone.quantities["load_max_pressure_mpa"] > 0).any()
    refused(lambda: joint.sweep({"pelvis.frontal": (-10, 10, 10)}, [("bent", "flexion", 60)], measures=["edge"]), "there is no measure")
