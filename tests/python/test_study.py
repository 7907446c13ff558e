"""Studies from Python: the same files as of the command, read back as arrays and tables."""

import csv
import json
import math
from pathlib import Path

import numpy as np
import pytest
from common import changed, refused, run_command

import condyle

MOTIONS = ["flexion", "internal_rotation_at_90_flexion"]


@pytest.fixture(scope="module")
def table(hip_file: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("cohort") / "hips.csv"
    path.write_text(f'id,joint,group,age_years\na,{hip_file},"x, y",30\nb,nothere.toml,z,\nc,{hip_file},z,41.5\n', encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def study(table: Path, tmp_path_factory: pytest.TempPathFactory) -> condyle.Study:
    return condyle.run_study(table, tmp_path_factory.mktemp("out"), motions=MOTIONS)


def test_limits_are_those_of_the_joint(study: condyle.Study, hip: condyle.Joint):
    assert repr(study) == "Study(2 joints, 1 failures, 2 motions)"
    limits = [limit.limit_deg for limit in hip.range_of_motion(MOTIONS).limits]
    assert study.limits["limit_deg"].tolist() == limits * 2
    assert study.limits["id"].tolist() == ["a", "a", "c", "c"]
    assert study.limits["group"].tolist() == ["x, y"] * 2 + ["z"] * 2
    assert study.limits["age_years"].tolist() == [30, 30, 41.5, 41.5]
    assert study.limits.units["joint_space_mm"] == "mm" and study.limits.meanings["reason"]


def test_failures_keep_exit_code_and_message(study: condyle.Study):
    assert study.failures["exit_code"].tolist() == [3]
    assert study.failures["message"][0].endswith("nothere.toml: no such file")
    assert study.failures["table_row"].tolist() == [2] and math.isnan(study.failures["age_years"][0])


def test_tables_become_dataframes(study: condyle.Study):
    pytest.importorskip("pandas")
    frame = study.to_dataframe()
    assert len(frame) == 4 and set(frame["side"]) == {"right"}
    assert frame.groupby("group")["limit_deg"].max().tolist() == [max(study.limits["limit_deg"])] * 2
    assert study.limits.to_dataframe()["limit_deg"].tolist() == study.limits["limit_deg"].tolist()


def test_the_command_writes_the_same_bytes(study: condyle.Study, table: Path, tmp_path: Path):
    run_command("study", table, "--out", tmp_path / "a", "--motion", ",".join(MOTIONS))
    condyle.run_study(table, tmp_path / "b", motions=MOTIONS)
    same_files(tmp_path / "a", tmp_path / "b")


def same_files(a: Path, b: Path) -> None:
    for name in ("limits.csv", "hips.csv", "failures.csv", "columns.csv", "study.h5", "study.json"):
        assert (a / name).read_bytes() == (b / name).read_bytes(), name


def test_every_option_of_the_command_is_one_of_python(coarse_hip_file: Path, tmp_path: Path):
    table = tmp_path / "hip.csv"
    table.write_text(f"id,joint\na,{coarse_hip_file}\n", encoding="utf-8")
    run_command("study", table, "--out", tmp_path / "a", "--motion", "flexion", "--bearing", "1.5", "--accept-reference-contact",
                "--exclude-reference-contacts", "--map", "flexion=0:20:10", "internal_rotation=-10:10:10", "--vary", "adduction", "--band=20",
                "--seed", "3", "--sigma-centre", "0.4", "--sigma-axes", "0.5", "--sigma-surface", "0.1", "--depth", "flexion=140", "--measures")
    condyle.run_study(table, tmp_path / "b", motions=["flexion"], bearing_margin_mm=1.5, accept_reference_contact=True,
                      exclude_reference_contacts=True, map=({"flexion": (0, 20, 10)}, {"internal_rotation": (-10, 10, 10)}), vary="adduction",
                      band_samples=20, seed=3, sigma_centre_mm=0.4, sigma_axes_deg=0.5, sigma_surface_mm=0.1, depth_at="flexion=140", measures=True)
    same_files(tmp_path / "a", tmp_path / "b")
    run_command("study", table, "--out", tmp_path / "c", "--motion", "flexion", "--bearing", "count", "--resect",
                "internal_rotation_at_90_flexion=60 flexion=130", "--from", "both", "--share", "0.25", "--margin", "0.2", "--burr", "3", "--deepest",
                "5", "--within", "30", "--edge", "2")
    resection = condyle.StudyResection({"internal_rotation_at_90_flexion": 60, "flexion": 130}, cut="both", share=0.25,
                                       margin_mm=0.2, burr_mm=3, deepest_mm=5, within_mm=30, edge_mm=2)
    condyle.run_study(table, tmp_path / "d", motions=["flexion"], bearing="count", resection=resection)
    same_files(tmp_path / "c", tmp_path / "d")


@pytest.fixture
def knees(hip_file: Path, tmp_path: Path) -> Path:
    """A hinge: the sample's bones, called a knee."""
    changed(hip_file, tmp_path, ('kind = "ball"', 'kind = "hinge"\njoint = "knee"'))
    path = tmp_path / "knees.csv"
    path.write_text("id,joint\nk,changed.toml\n", encoding="utf-8")
    return path


@pytest.mark.filterwarnings("ignore::condyle.JointWarning")
def test_other_joints_are_studied_too(knees: Path, tmp_path: Path):
    run_command("study", knees, "--out", tmp_path / "a", "--anatomy", "knee", "--depth", "flexion=30")
    condyle.run_study(knees, tmp_path / "b", anatomy="knee", depth_at="flexion=30")
    same_files(tmp_path / "a", tmp_path / "b")


@pytest.mark.parametrize("pose", ["flexion=30 adduction=10", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"])
def test_one_pose_is_read_in_one_way_by_depth_and_study(pose: str, knees: Path, tmp_path: Path):
    study = run_command("study", knees, "--out", tmp_path / "a", "--anatomy", "knee", "--depth", pose, check=False)
    assert study.returncode == 2, study.stderr
    for wrong in ({"depth_at": pose}, {"load": condyle.StudyLoad(pose)}):
        with pytest.raises(condyle.UsageError) as raised:
            condyle.run_study(knees, tmp_path / "b", anatomy="knee", **wrong)
        assert f"condyle: {raised.value}\n" == study.stderr
    if "adduction" in pose:
        depth = run_command("depth", tmp_path / "changed.toml", "--pose", pose, check=False)
        said = depth.stderr.splitlines()[-1].removeprefix("condyle: ")
        assert depth.returncode == 2 and study.stderr.endswith(f"joint 'k': {said}\n")
        refused(lambda: condyle.read_joint(tmp_path / "changed.toml").depths({"flexion_deg": 30, "adduction_deg": 10}),
                "a hinge rotates in flexion only")


def test_a_study_without_an_answer_is_an_error(tmp_path: Path):
    (tmp_path / "table.csv").write_text("id,joint\na,nothere.toml\nb,nothere.toml\n")
    refused(lambda: condyle.run_study(tmp_path / "table.csv", tmp_path / "out"), "none of 2 joints was answered; the first one: .*nothere.toml",
            condyle.FileError)
    assert condyle.read_study(tmp_path / "out").failures.rows == 2
    for number in (1, 2):  # what a shard comes to is no answer yet
        assert condyle.run_study(tmp_path / "table.csv", tmp_path / "parts", shard=(number, 2)).failures.rows == 1
    refused(lambda: condyle.merge_study(tmp_path / "parts"), "none of 2 joints was answered", condyle.FileError)


def test_one_long_text_is_read_in_its_own_room(tmp_path: Path):
    rows, remark = 2000, "x" * 1_000_000
    (tmp_path / "table.csv").write_text("id,joint,remark\n" + "".join(f"j{n},nothere.toml,{remark if n == 5 else ''}\n" for n in range(rows)))
    refused(lambda: condyle.run_study(tmp_path / "table.csv", tmp_path / "out"), kind=condyle.FileError)
    # 8 GB in an array of texts of one length, 2 GB in an HDF5 file of such texts.
    read = condyle.read_study(tmp_path / "out").failures["remark"]
    assert read.dtype == object and read[5] == remark and set(read[6:]) == {""}
    assert (tmp_path / "out/study.h5").stat().st_size < 3_000_000


def test_names_that_a_spreadsheet_would_compute_come_back_as_they_were(tmp_path: Path):
    names = ["=1+1", "-x", "@a", "+b", "'=c", "a\x1b[2J"]
    with open(tmp_path / "table.csv", "w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([["id", "joint", "group"]] + [[f"j{n}", "nothere.toml", name] for n, name in enumerate(names)])
    refused(lambda: condyle.run_study(tmp_path / "table.csv", tmp_path / "out"), kind=condyle.FileError)
    written = (tmp_path / "out/failures.csv").read_text()
    assert "\x1b" not in written and ",=" not in written and '"=' not in written
    read = condyle.read_study(tmp_path / "out").failures["group"]
    # A table's own apostrophe marks a text too.
    assert list(read) == ["=1+1", "-x", "@a", "+b", "=c", "a\x1b[2J"]


def test_a_load_is_that_of_elastic_contact(table: Path, hip: condyle.Joint, tmp_path: Path):
    layer = condyle.ElasticLayer(12, 0.42, 1.5)
    load = condyle.StudyLoad("flexion=20", (0, 1500, -200), layer, "mobile", [(0, 1, 0)], "face_centre", 15, "logarithmic")
    study = condyle.run_study(table, tmp_path / "a", motions=["flexion"], load=load)
    contact = condyle.ElasticContact(hip.fixed, hip.mobile, fixed_layer=layer, mobile_layer=layer, casting="mobile",
                                     rule="face_centre", reach_mm=15, law="logarithmic")
    balanced = contact.balance((0, 1500, -200), start=hip.pose(flexion_deg=20), free_directions=[(0, 1, 0)])
    assert study.hips["load_outcome"].tolist() == [balanced.outcome] * 2
    assert balanced.carries_load and balanced.contact.mobile is not None
    assert study.hips["load_mobile_max_pressure_mpa"][0] == balanced.contact.mobile.totals.max_pressure_mpa
    assert [study.hips[f"load_force_{axis}_n"][0] for axis in "xyz"] == balanced.contact.force_n.tolist()
    assert np.isnan(study.hips["load_fixed_area_mm2"]).all()
    assert study.hips.units["load_mobile_max_pressure_mpa"] == "MPa"
    run_command("study", table, "--out", tmp_path / "b", "--motion", "flexion", "--load", "flexion=20", "--force", "0", "1500", "-200", "--e", "12",
                "--nu", "0.42", "--thickness", "1.5", "--casting", "mobile", "--along", "0", "1", "0", "--rule", "face_centre", "--reach", "15",
                "--law", "logarithmic")
    assert (tmp_path / "a/hips.csv").read_bytes() == (tmp_path / "b/hips.csv").read_bytes()


def test_shards_are_merged(study: condyle.Study, table: Path, tmp_path: Path):
    for number in (1, 2, 3):
        shard = condyle.run_study(table, tmp_path, motions=MOTIONS, shard=(number, 3))
        assert shard.hips.rows + shard.failures.rows == 1
    refused(lambda: condyle.read_study(tmp_path), "has shards only", condyle.FileError)
    merged = condyle.merge_study(tmp_path)
    for name in merged.limits:
        np.testing.assert_array_equal(merged.limits[name], study.limits[name])


def test_a_crate_is_that_of_the_command(table: Path, tmp_path: Path):
    condyle.run_study(table, tmp_path / "a", motions=["flexion"], crate_date="2026-01-31")
    run_command("study", table, "--out", tmp_path / "b", "--motion", "flexion", "--crate", "2026-01-31")
    crate = (tmp_path / "b/ro-crate-metadata.json").read_bytes()
    assert (tmp_path / "a/ro-crate-metadata.json").read_bytes() == crate
    for number in (1, 2):
        condyle.run_study(table, tmp_path / "c", motions=["flexion"], shard=(number, 2))
    condyle.merge_study(tmp_path / "c", crate_date="2026-01-31")
    merged = json.loads((tmp_path / "c/ro-crate-metadata.json").read_bytes())
    assert [each["@id"] for each in merged["@graph"]] == [each["@id"] for each in json.loads(crate)["@graph"]]


def test_what_is_not_a_study_is_refused(table: Path, tmp_path: Path):
    refused(lambda: condyle.read_study(tmp_path), "study.json: No such file", condyle.FileError)
    (tmp_path / "study.json").write_text("{}")
    refused(lambda: condyle.read_study(tmp_path), "is not the record of a study", condyle.FileError)
    condyle.run_study(table, tmp_path / "out", motions=MOTIONS)
    with open(tmp_path / "out/limits.csv", "a", encoding="utf-8") as more:
        csv.writer(more).writerow(["x"])
    refused(lambda: condyle.read_study(tmp_path / "out"), "limits.csv: is not the one", condyle.FileError)


def test_arguments_are_checked(table: Path, tmp_path: Path):
    for wrong in ({"shard": (0, 3)}, {"shard": (4, 3)}, {"shard": 3}, {"motions": "flexion"}, {"motions": ["flexoin"]}, {"band_samples": -1},
                  {"band_samples": 7}, {"depth_at": "yaw=3"}, {"motions": [3]}, {"anatomy": "hips"}, {"bearing": "none"},
                  {"map": {"flexion": (0, 1)}}, {"vary": "flexion"}, {"map": ({"flexion": (0, 1)},)},
                  {"map": ({"flexion": 3}, {"adduction": (0, 1)})}, {"map": ({"flexion": (0, 1)}, {"flexion": (0, 1)})}, {"seed": 3},
                  {"sigma_axes_deg": 1.0}, {"crate_date": "today"}, {"crate_date": 20260131}, {"crate_date": "2026-01-31", "shard": (1, 2)},
                  {"load": "flexion=20"}, {"load": condyle.StudyLoad("yaw=3")}, {"load": condyle.StudyLoad(layer=3)},
                  {"load": condyle.StudyLoad(force_n=(1, 2))}, {"load": condyle.StudyLoad(casting="none")},
                  {"load": condyle.StudyLoad(free_directions=(0, 1, 0))}, {"load": condyle.StudyLoad(rule="faces")},
                  {"load": condyle.StudyLoad(force_n=(1, 2, 3), free_directions=(0, 1))}):
        refused(lambda: condyle.run_study(table, tmp_path, **wrong))
    refused(lambda: condyle.run_study(table, tmp_path, strict=True), kind=condyle.FileError)
    refused(lambda: condyle.sample_cohort(tmp_path, 0))


def test_a_cohort_is_a_table(tmp_path: Path):
    condyle.sample_cohort(tmp_path, 50, seed=3)
    with open(tmp_path / "cohort.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 50 and {row["side"] for row in rows} == {"left", "right"}
    assert set(condyle.HIP_PARAMETERS) <= set(rows[0])


